//! Contact query of hulls and of clumps of balls and hulls.

use nalgebra::{Point3, Vector3};

use crate::body::State;
use crate::hull::Plane;
use crate::query::{BallQuery, Contactor, Query, Touch};
use crate::shape::Piece;
#[cfg(feature = "state")]
use crate::state::{Fault, finite, positive, require};

/// Any clump of balls and hulls: the piece whose spring stores the most wins, so that the stored
/// energy is continuous where the carving piece changes.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct ClumpQuery {
    balls: Vec<BallQuery>,
    hulls: Vec<HullQuery>,
    /// Of the balls, then of the hulls: the energy of a spring goes as a power of its weight times
    /// its overlap.
    weights: Vec<f64>,
    #[cfg_attr(feature = "state", serde(skip))]
    position: Point3<f64>,
}

/// Face planes of a hull, inflated: in the body's frame and at the present pose.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
struct HullQuery {
    planes_local: Vec<Plane>,
    planes: Vec<Plane>,
    coefficient: f64,
}

impl ClumpQuery {
    pub(crate) fn new(contactors: &[Contactor], inflation: f64) -> Self {
        let (balls, hulls, weights) = (Vec::new(), Vec::new(), Vec::new());
        let mut clump = Self { balls, hulls, weights, position: Point3::origin() };
        for Contactor { piece, coefficient } in contactors {
            match piece {
                Piece::Ball(ball) => {
                    clump.balls.push(BallQuery::new(ball, *coefficient, inflation));
                }
                Piece::Hull(hull) => {
                    let grown =
                        |plane: &Plane| Plane { offset: plane.offset + inflation, ..*plane };
                    let planes: Vec<_> = hull.planes().iter().map(grown).collect();
                    clump.hulls.push(HullQuery {
                        planes_local: planes.clone(),
                        planes,
                        coefficient: *coefficient,
                    });
                }
            }
        }
        let coefficients = clump.balls.iter().map(BallQuery::coefficient);
        let coefficients = coefficients.chain(clump.hulls.iter().map(|hull| hull.coefficient));
        // Nodes are spheres to Hertz alone, whose springs store K d^2.5 and not k d^2.
        let power = if inflation > 0.0 { 2.5 } else { 2.0 };
        clump.weights = coefficients.map(|k| k.powf(1.0 / power)).collect();
        clump
    }

    pub(crate) fn place(&mut self, state: &State) {
        self.position = state.position;
        self.balls.iter_mut().for_each(|ball| ball.place(state));
        for hull in &mut self.hulls {
            for (placed, local) in hull.planes.iter_mut().zip(&hull.planes_local) {
                placed.normal = state.rotation * local.normal;
                placed.offset = local.offset + placed.normal.dot(&state.position.coords);
            }
        }
    }
}

impl Query for ClumpQuery {
    const HAS_PIECES: bool = true;

    // Out of line: a clump's loops would be copied into every root of every law.
    #[inline(never)]
    fn touch(&self, x: &Point3<f64>, n: &Vector3<f64>) -> Touch {
        let balls = self.balls.iter().map(|ball| ball.touch(x, n));
        let hulls = self.hulls.iter().map(|hull| hull.touch(x, n, &self.position));
        let weighed = balls.chain(hulls).zip(&self.weights);
        let stretched = weighed.map(|(touch, weight)| (weight * touch.overlap, touch));
        let fullest = stretched.reduce(|best, next| if next.0 > best.0 { next } else { best });
        fullest.expect("a shape has at least one piece").1
    }

    #[inline]
    fn near(&self, x: &Point3<f64>) -> bool {
        self.balls.iter().any(|ball| ball.near(x)) || self.hulls.iter().any(|hull| hull.holds(x))
    }
}

impl HullQuery {
    fn holds(&self, x: &Point3<f64>) -> bool {
        self.planes.iter().all(|plane| plane.normal.dot(&x.coords) < plane.offset)
    }

    /// The face at the deep end of the node's line and the overlap with it; of a node outside,
    /// the face it is farthest from.
    fn touch(&self, x: &Point3<f64>, n: &Vector3<f64>, position: &Point3<f64>) -> Touch {
        let mut outside: Option<(f64, &Plane)> = None;
        let mut deep: Option<(f64, &Plane)> = None;
        for plane in &self.planes {
            let inside = plane.offset - plane.normal.dot(&x.coords);
            if inside <= outside.map_or(0.0, |(least, _)| least) {
                outside = Some((inside, plane));
            }
            let down = -plane.normal.dot(n);
            if down > 0.0 && deep.is_none_or(|(reach, _)| inside < reach * down) {
                deep = Some((inside / down, plane));
            }
        }
        let face = outside.or(deep).map(|(_, plane)| *plane);
        // A closed hull has a face below any line; the fallback is never in contact.
        let plane = face.unwrap_or(Plane { normal: -n, offset: f64::NEG_INFINITY });
        let overlap = plane.offset - plane.normal.dot(&x.coords);
        Touch {
            overlap,
            contact_normal: plane.normal,
            arm: x + plane.normal * overlap - position,
            coefficient: self.coefficient,
            literal_cosine: -plane.normal.dot(n),
            radius: f64::INFINITY,
        }
    }
}

#[cfg(feature = "state")]
impl ClumpQuery {
    pub(crate) fn check(&self) -> Result<(), Fault> {
        self.balls.iter().try_for_each(BallQuery::check)?;
        let hulls = self.hulls.iter().all(|hull| {
            let planes = hull.planes_local.iter().flat_map(|p| p.normal.iter().chain([&p.offset]));
            let same = hull.planes.len() == hull.planes_local.len();
            same && finite(planes) && positive(hull.coefficient)
        });
        let some = !(self.balls.is_empty() && self.hulls.is_empty());
        let all = self.weights.len() == self.balls.len() + self.hulls.len();
        let weighed = all && self.weights.iter().all(|&weight| positive(weight));
        require(hulls && some && weighed, "a clump in contact is out of range")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Ball;

    /// Fails for a piece that wins by its pressure: where a small ball takes over from a large one, the
    /// energy of the spring then jumps.
    #[test]
    fn the_energy_of_a_node_goes_on_where_another_piece_takes_it_over() {
        let piece = |x: f64, radius: f64| Contactor {
            piece: Piece::Ball(Ball { centre: Point3::new(x, 0.0, 0.9), radius }),
            coefficient: 1e3 / radius,
        };
        let mut query = ClumpQuery::new(&[piece(-0.3, 1.0), piece(0.2, 0.93)], 0.0);
        query.place(&State::at(Point3::origin()));
        let at = |x: f64| query.touch(&Point3::new(x, 0.0, 0.0), &Vector3::z());
        let stored = |touch: &Touch| 0.5 * touch.coefficient * touch.overlap.powi(2);
        let (mut left, mut right) = (-0.3, 0.2);
        assert_ne!(at(left).coefficient, at(right).coefficient);
        for _ in 0..60 {
            let middle = 0.5 * (left + right);
            match at(middle).coefficient == at(left).coefficient {
                true => left = middle,
                false => right = middle,
            }
        }
        let [before, after] = [left, right].map(|x| stored(&at(x)));
        assert!((after / before - 1.0).abs() < 1e-9, "{before:e} {after:e}");
    }
}
