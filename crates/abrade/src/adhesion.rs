//! Adhesion beside the contact law: what lies within a range of a node is drawn to it by a constant
//! traction (Dugdale 1960), whatever the shape, against the springs of either elastic law.
//!
//! A node of area a at a distance g from the body holds the energy -a sigma_0 (range - g) within the
//! range, and -a w in contact, w = sigma_0 range. In a step it pulls along the shortest way with the
//! mean of -dU/dg over that way, so that the work of the pull is the change of the energy however
//! long the step is. Nothing is dissipated: a body sticks when its springs hold less than the crater
//! costs to leave.
//!
//! A local traction pulls a sphere off a plane with 2 pi w R, as Bradley and DMT have it; the -1.5 pi
//! w R of JKR comes of the elastic half-space, which nodes without neighbours are not.

use nalgebra::{Isometry3, Point3, Vector3};

use crate::body::{Body, State};
use crate::candidates::{Candidates, Slot};
use crate::carried::Grip;
use crate::contact::Contact;
use crate::encounter::{Loads, Placed};
use crate::extent::{Nearest, nearest};
use crate::flight::{acceleration, time_to_close, top_speed};
use crate::integrate::Integrator;
use crate::laws::ElasticLaw;
use crate::node_law::Motion;
use crate::shape::{Piece, Shape};
#[cfg(feature = "state")]
use crate::state::{Fault, not_negative, positive, require};
use crate::surface::{Surface, SurfaceLaws};
use crate::toll::Push;

/// Way of a body in a step, in ranges times eta.
const STEP: f64 = 0.5;
/// Reach of a list of candidates beyond the range, in ranges.
const LIST: f64 = 1.0;
/// Share of the range below which a way counts as none.
const STILL: f64 = 1e-12;

/// Adhesion between one body and one surface.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Glue {
    /// sigma_0 [Pa].
    traction: f64,
    /// [m]
    range: f64,
    /// r_s for `HertzNodes`, by which the body is inflated, zero otherwise [m].
    inflation: f64,
    candidates: Candidates,
    /// Distance of every candidate from the body at the start of the step and at its trial end,
    /// within zero and the range [m]; NaN of one that no step has seen.
    old: Vec<f64>,
    #[cfg_attr(feature = "state", serde(skip))]
    new: Vec<f64>,
    #[cfg_attr(feature = "state", serde(skip))]
    carried: Vec<(u32, f64)>,
    /// Of the last trial.
    #[cfg_attr(feature = "state", serde(skip))]
    pull: Attraction,
    #[cfg_attr(feature = "state", serde(skip))]
    end: Option<State>,
}

/// A node beside a body: the distances from the body over the area of a node are spread evenly about
/// that of its middle.
#[derive(Clone, Copy)]
struct Meeting {
    /// [m]
    distance: f64,
    /// Half of what they differ by [m].
    spread: f64,
    nearest: Nearest,
}

impl Meeting {
    /// Mean over the area of the distance within zero and `range` [m].
    fn gap(&self, range: f64) -> f64 {
        let [low, high] = [self.distance - self.spread, self.distance + self.spread];
        if self.spread <= STILL * range {
            return self.distance.clamp(0.0, range);
        }
        let integral = |x: f64| {
            let within = x.clamp(0.0, range);
            0.5 * within * within + range * (x - range).max(0.0)
        };
        ((integral(high) - integral(low)) / (high - low)).clamp(0.0, range)
    }

    /// Share of the area that the body draws [-].
    fn drawn(&self, range: f64) -> f64 {
        let [low, high] = [self.distance - self.spread, self.distance + self.spread];
        if self.spread <= STILL * range {
            let is_within = self.distance > STILL * range && self.distance < range;
            return f64::from(u8::from(is_within));
        }
        (high.clamp(0.0, range) - low.clamp(0.0, range)) / (high - low)
    }
}

/// What adhesion does over a step.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Attraction {
    /// Force and torque at its end.
    pub grip: Grip,
    /// Impulses over the step.
    pub push: Push,
    /// Change of its energy [J].
    pub energy: f64,
    /// Nodes within the range, those in contact included.
    pub reaching: usize,
}

impl Glue {
    /// None for a surface without adhesion.
    pub(crate) fn new(contact: &Contact, surface: &Surface) -> Option<Self> {
        let adhesion = surface.laws.adhesion.as_ref()?;
        Some(Self {
            traction: adhesion.traction(),
            range: adhesion.range,
            inflation: contact.inflation(),
            candidates: Candidates::default(),
            old: Vec::new(),
            new: Vec::new(),
            carried: Vec::new(),
            pull: Attraction::default(),
            end: None,
        })
    }

    /// How far from a node a body is drawn to it [m].
    pub(crate) fn range(&self) -> f64 {
        self.range
    }

    /// Energy at the present instant [J], below zero while the body adheres.
    fn energy(&self) -> f64 {
        let nodes = self.candidates.slots.iter().zip(&self.old);
        let seen = nodes.filter(|(_, gap)| !gap.is_nan());
        seen.map(|(slot, gap)| slot.area * (gap - self.range)).sum::<f64>() * self.traction
    }

    /// Makes sure that the candidates cover the body at `state`, where a step ends in which it moves
    /// by `way` [m].
    fn cover(&mut self, surface: &Surface, shape: &Shape, state: &State, way: f64) {
        if self.candidates.slack(shape, state) >= 0.0 {
            return;
        }
        self.carried.clear();
        let slots = self.candidates.slots.iter();
        self.carried.extend(slots.map(|slot| slot.id).zip(self.old.iter().copied()));
        let margin = LIST * self.range + 2.0 * way;
        let reach = self.inflation + self.range + surface.pitch();
        self.candidates.collect(surface, shape, state, reach, margin);
        self.old.clear();
        let mut known = self.carried.iter().peekable();
        for slot in &self.candidates.slots {
            while known.next_if(|(id, _)| *id < slot.id).is_some() {}
            let gap = known.next_if(|(id, _)| *id == slot.id).map_or(f64::NAN, |(_, gap)| *gap);
            self.old.push(gap);
        }
        self.new.clear();
        self.new.resize(self.old.len(), self.range);
    }

    /// The candidate `slot` beside the body at `state`.
    fn meet(&self, surface: &Surface, slot: &Slot, shape: &Shape, state: &State) -> Meeting {
        let nearest = nearest(shape, state, &surface.position(slot.id as usize));
        let cosine = nearest.normal.dot(&slot.n);
        Meeting {
            distance: nearest.distance - self.inflation,
            spread: 0.5 * (slot.area * (1.0 - cosine * cosine).max(0.0)).sqrt(),
            nearest,
        }
    }

    /// Takes every candidate through a step that ends at `end`; commits nothing.
    pub(crate) fn trial(
        &mut self,
        surface: &Surface,
        shape: &Shape,
        end: &State,
        motion: &Motion,
    ) -> &Attraction {
        let way =
            (motion.velocity.norm() + motion.spin.norm() * shape.bounding_radius()) * motion.dt;
        self.cover(surface, shape, end, way);
        let mut pull = Attraction::default();
        for (i, slot) in self.candidates.slots.iter().enumerate() {
            let met = self.meet(surface, slot, shape, end);
            let Nearest { normal, arm, .. } = met.nearest;
            let after = met.gap(self.range);
            self.new[i] = after;
            pull.reaching += usize::from(after < self.range);
            let come = normal.dot(&(motion.velocity + motion.spin.cross(&arm))) * motion.dt;
            let before = match self.old[i].is_nan() {
                true => Meeting { distance: met.distance + come, ..met }.gap(self.range),
                false => self.old[i],
            };
            let drawn = met.drawn(self.range);
            let share = match come.abs() > STILL * self.range {
                true => ((before - after) / come).clamp(0.0, 1.0),
                false => drawn,
            };
            let force = slot.area * self.traction;
            pull.energy += force * (after - before);
            pull.grip.force += normal * (force * drawn);
            pull.grip.torque += arm.cross(&normal) * (force * drawn);
            let impulse = normal * (force * share * motion.dt);
            pull.push.impulse += impulse;
            pull.push.torque += arm.cross(&impulse);
        }
        self.pull = pull;
        self.end = Some(*end);
        &self.pull
    }

    /// Makes the last trial the state, once the nodes have sunk. Returns what their sinking away from
    /// the body has added to the energy [J]: nobody paid for that.
    pub(crate) fn commit(&mut self, surface: &Surface, shape: &Shape) -> f64 {
        let Some(end) = self.end.take() else { return 0.0 };
        let mut added = 0.0;
        for i in 0..self.candidates.slots.len() {
            let slot = &self.candidates.slots[i];
            let gap = self.meet(surface, slot, shape, &end).gap(self.range);
            added += slot.area * self.traction * (gap - self.new[i]);
            self.old[i] = gap;
        }
        added
    }

    /// Shortest time [s] in which the body of `state` can come within the range of a node; none of its
    /// points is faster than `speed` [m/s] and nothing accelerates it by more than `acceleration` [m/s2].
    pub(crate) fn time_to_reach(
        &mut self,
        surface: &Surface,
        shape: &Shape,
        state: &State,
        speed: f64,
        acceleration: f64,
    ) -> f64 {
        self.cover(surface, shape, state, 0.5 * surface.pitch());
        let covered = self.candidates.slack(shape, state).max(0.0);
        let covered = time_to_close(covered, speed, acceleration);
        let times = self.candidates.slots.iter().map(|slot| {
            let Meeting { distance, spread, nearest } = self.meet(surface, slot, shape, state);
            // The distance to a ball in straight motion is convex in time: its rate is a bound.
            let approach = match shape.pieces() {
                [Piece::Ball(ball)] if ball.centre == Point3::origin() => {
                    nearest.normal.dot(&state.velocity)
                }
                _ => speed,
            };
            time_to_close(distance - spread - self.range, approach, acceleration)
        });
        times.fold(covered, f64::min)
    }

    /// Box around the undeformed nodes whose depths were read since the last call.
    pub(crate) fn take_read(&mut self) -> Option<[Point3<f64>; 2]> {
        self.candidates.read.take()
    }

    /// Lets the body go, wherever it is. Returns the energy that it held [J].
    pub(crate) fn let_go(&mut self) -> f64 {
        let held = self.energy();
        self.candidates.slots.clear();
        self.candidates.forget();
        self.old.clear();
        self.new.clear();
        self.end = None;
        held
    }
}

impl Attraction {
    /// Force and torque in the mean over a step of `dt` [s].
    pub(crate) fn mean(&self, dt: f64) -> Grip {
        Grip { force: self.push.impulse / dt, torque: self.push.torque / dt }
    }

    pub(crate) fn is_finite(&self) -> bool {
        let Push { impulse, torque, .. } = &self.push;
        impulse.iter().chain(torque).all(|x| x.is_finite())
    }

    /// Adds that of another surface, whose frame is `pose`.
    pub(crate) fn add(&mut self, other: &Self, pose: &Isometry3<f64>) {
        let turned = other.grip.turned(pose);
        self.grip.force += turned.force;
        self.grip.torque += turned.torque;
        self.push.add(&other.push, pose);
        self.energy += other.energy;
        self.reaching += other.reaching;
    }
}

impl SurfaceLaws {
    /// How far from a node a body feels it [m]: r_s of `HertzNodes`, and the range of adhesion.
    pub fn reach(&self) -> f64 {
        let radius = match self.elastic {
            ElasticLaw::HertzNodes { node_radius, .. } => node_radius,
            _ => 0.0,
        };
        radius + self.adhesion.as_ref().map_or(0.0, |adhesion| adhesion.range)
    }
}

impl Integrator {
    /// Boxes around the undeformed nodes whose depths were read since the last call, surface by
    /// surface.
    pub(crate) fn take_reads(&mut self) -> impl Iterator<Item = Option<[Point3<f64>; 2]>> + '_ {
        let glue = &mut self.glue;
        self.contacts.iter_mut().enumerate().map(move |(i, contact)| {
            let drawn = glue.get_mut(i).and_then(Option::as_mut).and_then(Glue::take_read);
            let read = contact.take_read();
            let both = |[a, b]: [Point3<f64>; 2], [c, d]: [Point3<f64>; 2]| [a.inf(&c), b.sup(&d)];
            read.map_or(drawn, |read| Some(drawn.map_or(read, |drawn| both(read, drawn))))
        })
    }

    /// How far from the nodes of the surface `i` a body is drawn to them [m].
    pub(crate) fn range(&self, i: usize) -> f64 {
        self.glue.get(i).and_then(Option::as_ref).map_or(0.0, Glue::range)
    }

    pub(crate) fn adheres(&self) -> bool {
        !self.glue.is_empty()
    }

    /// Longest step in which a body that is `drawn` [N] does not fly past the range of an adhesion
    /// unseen [s].
    #[inline(never)]
    pub(crate) fn adhesion_limit(
        &self,
        body: &Body,
        surfaces: &[Placed<'_>],
        loads: &Loads,
        drawn: &Vector3<f64>,
    ) -> f64 {
        let step = STEP * self.eta;
        let drawn = drawn.norm() * self.dynamics.inverse_mass;
        let limit = |(glue, placed): (&Option<Glue>, &Placed<'_>)| {
            let acceleration = acceleration(placed, body, loads) + drawn;
            Some(time_to_close(step * glue.as_ref()?.range, top_speed(placed, body), acceleration))
        };
        self.glue.iter().zip(surfaces).filter_map(limit).fold(f64::INFINITY, f64::min)
    }

    /// Makes the adhesion of the last trial that of the present instant. Returns the change of its
    /// energy, and the part of it that came of nodes that sank away [J].
    pub(crate) fn adhere(&mut self, body: &Body, surfaces: &[Placed<'_>]) -> [f64; 2] {
        let pairs = self.glue.iter_mut().zip(surfaces);
        let commit = |(glue, placed): (&mut Option<Glue>, &Placed<'_>)| {
            glue.as_mut().map_or(0.0, |glue| glue.commit(placed.surface, &body.shape))
        };
        let added = pairs.map(commit).sum::<f64>();
        [self.attraction.energy + added, added]
    }
}

#[cfg(feature = "state")]
impl Glue {
    pub(crate) fn check(&mut self) -> Result<(), Fault> {
        let sizes = positive(self.traction) && positive(self.range) && not_negative(self.inflation);
        let within = |gap: &f64| gap.is_nan() || (0.0..=self.range).contains(gap);
        require(sizes && self.old.iter().all(within), "an adhesion is out of range")?;
        self.candidates.check()?;
        let count = self.candidates.slots.len();
        require(self.old.len() == count, "gaps and candidates differ in number")?;
        self.new = vec![self.range; count];
        Ok(())
    }

    /// True when every candidate is one of `nodes`.
    pub(crate) fn lies_on(&self, nodes: usize) -> bool {
        self.candidates.lie_on(nodes)
    }
}
