//! A body between the two poses of a step, as the swept rule sees it: where a column's line
//! crosses the body, and through which face a point entered it.

use nalgebra::{Point3, UnitQuaternion, Vector3};

use crate::body::State;
use crate::hull::Hull;
use crate::planes::{self, Block, Blocks, Line};
use crate::shape::{Piece, Shape};

/// Displacement of a face, in displacements of the step, below which it did not move.
pub(crate) const UNMOVED: f64 = 1e-9;

/// Outward normal and offset of a plane [m].
type Facing = (Vector3<f64>, f64);
type Pose = (Point3<f64>, UnitQuaternion<f64>);

/// The face planes and balls of a body, always the same, at the start and the end of a step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Swept {
    /// The normal of every node, where they agree: slopes against it are ready.
    level: Option<Vector3<f64>>,
    /// The planes of all hulls, and where they stand.
    starts: Vec<Facing>,
    ends: Vec<Facing>,
    placed: Option<Pose>,
    balls: Vec<MovedBall>,
    /// The planes at the end of the step, hull by hull in whole blocks.
    blocks: Vec<Block>,
    hulls: Vec<HullEnd>,
}

/// Where the planes and the blocks of a hull end.
#[derive(Clone, Copy, Debug)]
struct HullEnd {
    planes: usize,
    /// Of the blocks, those that a line may lead away from.
    shunned: usize,
    blocks: usize,
}

#[derive(Clone, Copy, Debug)]
struct MovedBall {
    from: Point3<f64>,
    to: Point3<f64>,
    radius: f64,
}

/// Part of a column's line inside the body at the end of a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Span {
    /// Coordinates along the node's normal [m].
    pub low: f64,
    pub high: f64,
    /// Outward normal of the face at the deep end.
    pub deep_normal: Vector3<f64>,
}

/// How a point was entered.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Entry {
    /// Outward normal of the face it entered through, mean of both poses.
    pub normal: Vector3<f64>,
    /// Displacement of that face along its normal [m], > 0.
    pub displacement: f64,
}

impl Swept {
    /// Places `shape` at both ends of a step, over nodes whose normal is `level` if they agree;
    /// reuses the buffers.
    pub(crate) fn place(
        &mut self,
        shape: &Shape,
        from: &State,
        to: &State,
        level: Option<Vector3<f64>>,
    ) {
        self.level = level;
        self.face(shape, from, to);
        self.blocks.clear();
        self.balls.clear();
        self.hulls.clear();
        for piece in shape.pieces() {
            match piece {
                Piece::Ball(ball) => self.balls.push(MovedBall {
                    from: from.position + from.rotation * ball.centre.coords,
                    to: to.position + to.rotation * ball.centre.coords,
                    radius: ball.radius,
                }),
                Piece::Hull(hull) => {
                    let start = self.hulls.last().map_or(0, |hull| hull.planes);
                    let planes = start + hull.planes().len();
                    let ends = self.ends[start..planes].iter().copied();
                    let shunned = planes::add(&mut self.blocks, ends, level);
                    self.hulls.push(HullEnd { planes, shunned, blocks: self.blocks.len() });
                }
            }
        }
    }

    /// Turns the planes of all hulls to where they are at both ends of a step.
    fn face(&mut self, shape: &Shape, from: &State, to: &State) {
        let pose = |state: &State| Some((state.position, state.rotation));
        let is_another =
            self.ends.len() != hulls(shape).map(|hull| hull.planes().len()).sum::<usize>();
        // Mostly a step begins where the last one ended.
        match self.placed == pose(from) && !is_another {
            true => std::mem::swap(&mut self.starts, &mut self.ends),
            false => turn(&mut self.starts, shape, from),
        }
        match pose(from) == pose(to) {
            true => self.ends.clone_from(&self.starts),
            false => turn(&mut self.ends, shape, to),
        }
        self.placed = pose(to);
    }

    /// Where the line x + z n crosses the body at the end of the step, above -`own` [m]. Pieces of
    /// a clump over one column count as one span.
    #[inline]
    pub(crate) fn span(&self, x: &Point3<f64>, n: &Vector3<f64>, own: f64) -> Option<Span> {
        self.whole_span(x, n).filter(|span| span.high > -own)
    }

    #[inline]
    fn whole_span(&self, x: &Point3<f64>, n: &Vector3<f64>) -> Option<Span> {
        match (&*self.hulls, &*self.balls) {
            ([hull], []) => return self.clip(self.lone(hull), x, n),
            ([], [ball]) => return ball.chord(x, n),
            _ => {}
        }
        let mut whole: Option<Span> = None;
        let mut add = |span: Option<Span>| {
            let Some(span) = span else { return };
            let joined = whole.get_or_insert(span);
            if span.low < joined.low {
                (joined.low, joined.deep_normal) = (span.low, span.deep_normal);
            }
            joined.high = joined.high.max(span.high);
        };
        self.blocks().for_each(|blocks| add(self.clip(blocks, x, n)));
        self.balls.iter().for_each(|ball| add(ball.chord(x, n)));
        whole
    }

    #[inline]
    fn clip(&self, blocks: Blocks<'_>, x: &Point3<f64>, n: &Vector3<f64>) -> Option<Span> {
        let line = Line::new(self.level, n);
        let ends = [f64::NEG_INFINITY, f64::INFINITY];
        let [low, high] = planes::inside(blocks, x, line, ends, 0.0)?;
        let deep_normal = planes::crossed_at(blocks, x, line, low)?;
        Some(Span { low, high, deep_normal })
    }

    /// The blocks of a hull that is alone.
    #[inline]
    fn lone(&self, hull: &HullEnd) -> Blocks<'_> {
        Blocks { all: &self.blocks, shunned: hull.shunned }
    }

    /// The blocks of each hull.
    #[inline]
    fn blocks(&self) -> impl Iterator<Item = Blocks<'_>> {
        let mut start = 0;
        self.hulls.iter().map(move |hull| {
            let all = &self.blocks[start..hull.blocks];
            let shunned = hull.shunned - start;
            start = hull.blocks;
            Blocks { all, shunned }
        })
    }

    /// True when the line from `x` down along -n, `reach` [m] long, meets the body, grown by
    /// `margin` [m], at the end of the step.
    pub(crate) fn meets(&self, x: &Point3<f64>, n: &Vector3<f64>, margin: f64, reach: f64) -> bool {
        let line = Line::new(self.level, n);
        if let ([hull], []) = (&*self.hulls, &*self.balls) {
            return planes::meet(self.lone(hull), x, line, reach, margin);
        }
        self.blocks().any(|blocks| planes::meet(blocks, x, line, reach, margin))
            || self.balls.iter().any(|ball| ball.meets(x, n, margin, reach))
    }

    /// A distance [m] that every point of the body may move, at least, before it meets the line
    /// from `depth` [m] below `x` down along -n; below zero where it may have met it.
    #[inline]
    pub(crate) fn clearance(&self, x: &Point3<f64>, n: &Vector3<f64>, depth: f64) -> f64 {
        let line = Line::new(self.level, n);
        if let ([hull], []) = (&*self.hulls, &*self.balls) {
            return planes::clearance(self.lone(hull), x, line, depth);
        }
        let hulls = self.blocks().map(|blocks| planes::clearance(blocks, x, line, depth));
        let balls = self.balls.iter().map(|ball| ball.clearance(&(x - n * depth), n));
        hulls.chain(balls).fold(f64::INFINITY, f64::min)
    }

    /// The face through which `p` came to lie inside the body during the step, if one did.
    #[inline]
    pub(crate) fn entry(&self, p: &Point3<f64>, step: f64) -> Option<Entry> {
        let mut first: Option<(f64, Entry)> = None;
        let mut add = |found: Option<(f64, Entry)>| {
            if let Some((time, entry)) = found
                && first.as_ref().is_none_or(|(earliest, _)| time < *earliest)
            {
                first = Some((time, entry));
            }
        };
        let mut start = 0;
        for hull in &self.hulls {
            let planes = start..hull.planes;
            add(hull_entry(&self.starts[planes.clone()], &self.ends[planes], p, step));
            start = hull.planes;
        }
        self.balls.iter().for_each(|ball| add(ball.entry(p, step)));
        first.map(|(_, entry)| entry)
    }
}

fn hulls(shape: &Shape) -> impl Iterator<Item = &Hull> {
    shape.pieces().iter().filter_map(|piece| match piece {
        Piece::Hull(hull) => Some(hull),
        Piece::Ball(_) => None,
    })
}

/// The planes of all hulls of `shape` at `state`.
fn turn(planes: &mut Vec<Facing>, shape: &Shape, state: &State) {
    planes.clear();
    for hull in hulls(shape) {
        planes.extend(hull.planes().iter().map(|plane| {
            let normal = state.rotation * plane.normal;
            (normal, plane.offset + normal.dot(&state.position.coords))
        }));
    }
}

/// The plane that was crossed last on the way in, and when, as a share of the step.
#[inline]
fn hull_entry(
    starts: &[Facing],
    ends: &[Facing],
    p: &Point3<f64>,
    step: f64,
) -> Option<(f64, Entry)> {
    let mut last: Option<(f64, Vector3<f64>, f64)> = None;
    for (from, to) in starts.iter().zip(ends) {
        let after = to.0.dot(&p.coords) - to.1;
        let before = from.0.dot(&p.coords) - from.1;
        if after > UNMOVED * step {
            // Another piece of the clump took the point.
            return None;
        }
        let displacement = before - after;
        if before > 0.0 && displacement > UNMOVED * step {
            let time = before / displacement;
            if last.is_none_or(|(latest, ..)| time > latest) {
                last = Some((time, from.0 + to.0, displacement));
            }
        }
    }
    last.map(|(time, twice, displacement)| {
        (time, Entry { normal: twice.normalize(), displacement })
    })
}

impl MovedBall {
    fn meets(&self, x: &Point3<f64>, n: &Vector3<f64>, margin: f64, reach: f64) -> bool {
        let to_centre = self.to - x;
        let (along, radius) = (to_centre.dot(n), self.radius + margin);
        let square = radius * radius - (to_centre - n * along).norm_squared();
        let half = square.max(0.0).sqrt();
        square > 0.0 && along - half < margin && along + half > -(reach + margin)
    }

    fn clearance(&self, x: &Point3<f64>, n: &Vector3<f64>) -> f64 {
        let to_centre = self.to - x;
        let along = to_centre.dot(n).min(0.0);
        (to_centre - n * along).norm() - self.radius
    }

    #[inline]
    fn chord(&self, x: &Point3<f64>, n: &Vector3<f64>) -> Option<Span> {
        let to_centre = self.to - x;
        let along = to_centre.dot(n);
        let square = self.radius * self.radius - (to_centre - n * along).norm_squared();
        (square > 0.0).then(|| {
            let half = square.sqrt();
            let low = along - half;
            Span { low, high: along + half, deep_normal: (n * low - to_centre) / self.radius }
        })
    }

    #[inline]
    fn entry(&self, p: &Point3<f64>, step: f64) -> Option<(f64, Entry)> {
        let (before, after) = (p - self.from, p - self.to);
        let (d0, d1) = (before.norm() - self.radius, after.norm() - self.radius);
        let displacement = d0 - d1;
        let entered = d1 <= UNMOVED * step && d0 > 0.0 && displacement > UNMOVED * step;
        entered.then(|| {
            let normal = (before + after).normalize();
            (d0 / displacement, Entry { normal, displacement })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::candidates::travel;
    use crate::hull::Polyhedron;
    use crate::shape::Ball;

    /// Numbers in [-1, 1] that follow no pattern.
    struct Numbers(f64);

    impl Numbers {
        fn next(&mut self) -> f64 {
            self.0 = (self.0 + 0.618_033_988_75 + 0.1 * (37.0 * self.0).sin()).fract();
            2.0 * self.0.abs() - 1.0
        }

        fn vector(&mut self) -> Vector3<f64> {
            Vector3::from_fn(|_, _| self.next())
        }
    }

    /// Fails for a clearance that is larger than the way to the body, over which columns would be
    /// passed through unseen, and for one that is never above zero.
    #[test]
    fn no_body_meets_a_line_within_its_clearance() {
        let (hull, ..) = Hull::solid(&Polyhedron::Icosahedron.vertices(0.6), 1.0).expect("a hull");
        let ball = Ball { centre: Point3::new(0.5, 0.1, -0.2), radius: 0.4 };
        let shapes = [vec![Piece::Hull(hull.clone())], vec![Piece::Ball(ball)]];
        let both = vec![Piece::Hull(hull), Piece::Ball(ball)];
        let mut numbers = Numbers(0.3);
        let n = Vector3::new(0.6, 0.0, 0.8);
        for pieces in shapes.into_iter().chain([both]) {
            let shape = Shape::union(pieces).expect("a shape");
            let (mut clear, mut free, mut swept) = (0, 0, Swept::default());
            for _ in 0..400 {
                let mut at = State::at(numbers.vector().into());
                at.rotation = UnitQuaternion::from_scaled_axis(numbers.vector() * 3.0);
                let x = Point3::from(numbers.vector());
                swept.place(&shape, &at, &at, None);
                let depth = 0.5 * numbers.next();
                let x = x + n * depth;
                let way = swept.clearance(&x, &n, depth);
                let x = x - n * depth;
                free += usize::from(!swept.meets(&x, &n, 0.0, f64::INFINITY));
                clear += usize::from(way > 0.0);
                for _ in 0..if way > 0.0 { 20 } else { 0 } {
                    let mut moved = at;
                    let share = 0.5 * (1.0 + numbers.next());
                    moved.position += numbers.vector().normalize() * (share * way);
                    let turn = (1.0 - share) * way / shape.bounding_radius();
                    let axis = numbers.vector().normalize();
                    moved.rotation = UnitQuaternion::from_scaled_axis(axis * turn) * at.rotation;
                    assert!(travel(&shape, &at, &moved) < way * (1.0 + 1e-9));
                    swept.place(&shape, &moved, &moved, None);
                    let span = swept.span(&x, &n, f64::INFINITY);
                    assert!(span.is_none_or(|span| span.low > -1e-9), "{span:?} after {way}");
                }
            }
            assert!(clear > free / 2, "{clear} of {free} lines that the body does not meet");
        }
    }
}
