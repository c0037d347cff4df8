//! Where a surface is that is led along a path: to and fro, or through points.

use std::f64::consts::{PI, TAU};

use nalgebra::{Isometry3, Point3, Translation3, Unit, UnitQuaternion, Vector3};

/// How far apart the ends of a path that repeats may be, of its extent [-] and as an angle [rad].
const CLOSED: f64 = 1e-9;
/// How far from half a turn a turn must be whose short way is known [rad].
const HALF_TURN: f64 = 1e-9;

/// Where the frame of a led surface is at any time.
#[derive(Clone, Debug, PartialEq)]
pub struct LedPath {
    /// What it moves about.
    home: Isometry3<f64>,
    way: Way,
}

/// How it leaves its home.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Way {
    /// To and fro along a line; the amplitude [m].
    Reciprocating(Vector3<f64>, Swing),
    /// To and fro about an axis; its direction and the angle [rad].
    Rocking(Unit<Vector3<f64>>, f64, Swing),
    /// From point to point.
    Through(Legs),
}

/// A sine over time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Swing {
    /// [1/s]
    pub(crate) frequency: f64,
    /// [rad]
    pub(crate) phase: f64,
}

/// A point of a path: time [s], way [m] and turn from home.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Waypoint {
    pub(crate) time: f64,
    pub(crate) shift: Vector3<f64>,
    pub(crate) rotation: UnitQuaternion<f64>,
}

/// The legs between points.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Legs {
    points: Vec<Waypoint>,
    /// Turn from each point to the next [rad].
    turns: Vec<Vector3<f64>>,
    repeat: bool,
}

/// Why there is no path through points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum PathFault {
    /// There are fewer than two.
    TooFew,
    /// The point of this number is not later than the one before.
    NotLater(usize),
    /// The point of this number is half a turn from the one before, either way around.
    HalfTurn(usize),
    /// It should repeat, and does not end where it begins.
    Open,
}

impl LedPath {
    /// The path about `home`.
    pub(crate) fn new(home: Isometry3<f64>, way: Way) -> Self {
        Self { home, way }
    }

    /// The frame in the world at `time` [s].
    pub fn at(&self, time: f64) -> Isometry3<f64> {
        let (shift, turn) = self.way.at(time);
        let translation = Translation3::from(self.home.translation.vector + shift);
        Isometry3::from_parts(translation, turn * self.home.rotation)
    }

    /// Velocity of the frame's origin [m/s] and angular velocity [rad/s] from `time` [s] on.
    pub fn velocity_spin(&self, time: f64) -> [Vector3<f64>; 2] {
        match &self.way {
            Way::Reciprocating(amplitude, swing) => {
                [amplitude * swing.rate(time), Vector3::zeros()]
            }
            Way::Rocking(axis, angle, swing) => {
                [Vector3::zeros(), axis.into_inner() * (angle * swing.rate(time))]
            }
            Way::Through(legs) => legs.velocity_spin(time),
        }
    }

    /// Time [s] from `time` to the next corner that is more than `least` [s] away; infinite without
    /// one.
    pub(crate) fn until_corner(&self, time: f64, least: f64) -> f64 {
        match &self.way {
            Way::Through(legs) => legs.until_corner(time, least),
            Way::Reciprocating(..) | Way::Rocking(..) => f64::INFINITY,
        }
    }

    /// True when it stands still from `time` [s] on.
    pub(crate) fn is_over(&self, time: f64) -> bool {
        match &self.way {
            Way::Through(legs) => !legs.repeat && time >= legs.last().time,
            Way::Reciprocating(..) | Way::Rocking(..) => false,
        }
    }

    /// Box in the world [m] that always holds the surface, which is between two corners of its frame.
    pub(crate) fn swept(&self, [low, high]: &[Point3<f64>; 2]) -> [Point3<f64>; 2] {
        let (shifts, turns) = match &self.way {
            Way::Reciprocating(amplitude, _) => (vec![*amplitude, -amplitude], false),
            Way::Rocking(..) => (vec![Vector3::zeros()], true),
            Way::Through(legs) => {
                let shifts = legs.points.iter().map(|point| point.shift).collect();
                (shifts, legs.turns())
            }
        };
        let (centre, half) = match turns {
            true => {
                let reach = low.coords.abs().sup(&high.coords.abs()).norm();
                (Point3::origin(), Vector3::repeat(reach))
            }
            false => {
                let (_, turn) = self.way.at(0.0);
                let rotation = (turn * self.home.rotation).to_rotation_matrix();
                let half = rotation.matrix().abs() * ((high - low) * 0.5);
                (rotation * nalgebra::center(low, high), half)
            }
        };
        let middle = centre + self.home.translation.vector;
        let boxes = shifts.iter().map(|shift| [middle + shift - half, middle + shift + half]);
        boxes
            .reduce(|[a, b], [c, d]| [a.inf(&c), b.sup(&d)])
            .unwrap_or([middle - half, middle + half])
    }
}

impl Way {
    /// Way [m] and turn from home at `time` [s].
    fn at(&self, time: f64) -> (Vector3<f64>, UnitQuaternion<f64>) {
        match self {
            Self::Reciprocating(amplitude, swing) => {
                (amplitude * swing.at(time), UnitQuaternion::identity())
            }
            Self::Rocking(axis, angle, swing) => {
                let turn = UnitQuaternion::from_axis_angle(axis, angle * swing.at(time));
                (Vector3::zeros(), turn)
            }
            Self::Through(legs) => legs.at(time),
        }
    }
}

impl Swing {
    fn at(&self, time: f64) -> f64 {
        (TAU * self.frequency * time + self.phase).sin()
    }

    /// How fast it changes [1/s].
    fn rate(&self, time: f64) -> f64 {
        TAU * self.frequency * (TAU * self.frequency * time + self.phase).cos()
    }
}

impl Legs {
    pub(crate) fn new(points: Vec<Waypoint>, repeat: bool) -> Result<Self, PathFault> {
        let [first, .., last] = &points[..] else { return Err(PathFault::TooFew) };
        let between = |[a, b]: &[Waypoint; 2]| (b.rotation * a.rotation.inverse()).scaled_axis();
        let mut turns = Vec::with_capacity(points.len() - 1);
        for (i, pair) in points.array_windows().enumerate() {
            if pair[1].time <= pair[0].time {
                return Err(PathFault::NotLater(i + 1));
            }
            let turn =
                if pair[0].rotation == pair[1].rotation { Vector3::zeros() } else { between(pair) };
            if turn.norm() > PI - HALF_TURN {
                return Err(PathFault::HalfTurn(i + 1));
            }
            turns.push(turn);
        }
        let extent = points.iter().map(|point| (point.shift - first.shift).norm());
        let apart = (last.shift - first.shift).norm();
        let closes = apart <= CLOSED * extent.fold(0.0, f64::max)
            && first.rotation.angle_to(&last.rotation) <= CLOSED;
        if repeat && !closes {
            return Err(PathFault::Open);
        }
        Ok(Self { points, turns, repeat })
    }

    fn at(&self, time: f64) -> (Vector3<f64>, UnitQuaternion<f64>) {
        let (leg, share) = self.leg(time);
        let [from, to] = [&self.points[leg], &self.points[leg + 1]];
        let turn = UnitQuaternion::from_scaled_axis(self.turns[leg] * share);
        (from.shift.lerp(&to.shift, share), turn * from.rotation)
    }

    fn velocity_spin(&self, time: f64) -> [Vector3<f64>; 2] {
        let moves = self.repeat || time < self.last().time;
        if time < self.points[0].time || !moves {
            return [Vector3::zeros(); 2];
        }
        let (leg, _) = self.leg(time);
        let [from, to] = [&self.points[leg], &self.points[leg + 1]];
        let rate = 1.0 / (to.time - from.time);
        [(to.shift - from.shift) * rate, self.turns[leg] * rate]
    }

    fn until_corner(&self, time: f64, least: f64) -> f64 {
        let now = self.wrapped(time);
        let next = self.points.partition_point(|point| point.time - now <= least);
        match self.points.get(next) {
            Some(point) => point.time - now,
            None if self.repeat => {
                self.last().time - now + self.points[1].time - self.points[0].time
            }
            None => f64::INFINITY,
        }
    }

    /// The leg at `time` [s] and the part of it that is done.
    fn leg(&self, time: f64) -> (usize, f64) {
        let now = self.wrapped(time);
        let after = self.points.partition_point(|point| point.time <= now);
        let leg = after.clamp(1, self.turns.len()) - 1;
        let [from, to] = [self.points[leg].time, self.points[leg + 1].time];
        (leg, ((now - from) / (to - from)).clamp(0.0, 1.0))
    }

    /// `time` [s] in the first round of a path that repeats.
    fn wrapped(&self, time: f64) -> f64 {
        let [begin, end] = [self.points[0].time, self.last().time];
        match self.repeat && time > begin {
            true => begin + (time - begin).rem_euclid(end - begin),
            false => time,
        }
    }

    fn turns(&self) -> bool {
        self.turns.iter().any(|turn| *turn != Vector3::zeros())
    }

    fn last(&self) -> &Waypoint {
        &self.points[self.turns.len()]
    }
}

#[cfg(test)]
mod tests;
