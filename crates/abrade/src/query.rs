//! Contact query of the return mapping: where a body carves a node.

use nalgebra::{Point3, UnitQuaternion, Vector3};

use crate::body::State;
use crate::hull::Plane;
use crate::shape::{Piece, Shape};

/// A node against the piece that carves it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Touch {
    /// d [m]; below zero without contact.
    pub overlap: f64,
    /// m: unit, from the body into the surface.
    pub contact_normal: Vector3<f64>,
    /// From the centre of mass to the contact point [m].
    pub arm: Vector3<f64>,
    /// The piece's elastic coefficient: k_w [Pa/m], or K sqrt(R_eff) [N/m^1.5].
    pub coefficient: f64,
    /// Height of the piece's centre above the node over its (inflated) radius: the cosine of
    /// Eq. A.1 to the letter; the true c on faces.
    pub literal_cosine: f64,
    /// Radius of the (inflated) piece [m]; infinite for a face.
    pub radius: f64,
}

/// A body at one pose, asked about nodes in the surface's frame.
pub(crate) trait Query {
    /// The touch of the node at `x` with outward normal `n`.
    fn touch(&self, x: &Point3<f64>, n: &Vector3<f64>) -> Touch;

    /// True where the node may overlap the body: cheaper than a touch, never wrongly false.
    fn near(&self, x: &Point3<f64>) -> bool;
}

/// A piece of a body with its elastic coefficient, in the body's frame.
#[derive(Clone, Debug)]
pub(crate) struct Contactor {
    pub piece: Piece,
    pub coefficient: f64,
}

/// A single ball.
pub(crate) struct BallQuery {
    centre: Point3<f64>,
    offset: Vector3<f64>,
    radius: f64,
    inflated: f64,
    coefficient: f64,
}

impl BallQuery {
    /// The ball of `contactor` at `state`, inflated by `inflation` [m].
    fn new(
        centre: &Point3<f64>,
        radius: f64,
        coefficient: f64,
        state: &State,
        inflation: f64,
    ) -> Self {
        let offset = state.rotation * centre.coords;
        Self {
            centre: state.position + offset,
            offset,
            radius,
            inflated: radius + inflation,
            coefficient,
        }
    }
}

impl Query for BallQuery {
    #[inline(always)]
    fn touch(&self, x: &Point3<f64>, n: &Vector3<f64>) -> Touch {
        let to_node = x - self.centre;
        let distance = to_node.norm();
        let m = to_node / distance;
        Touch {
            overlap: self.inflated - distance,
            contact_normal: m,
            arm: self.offset + m * self.radius,
            coefficient: self.coefficient,
            literal_cosine: -to_node.dot(n) / self.inflated,
            radius: self.inflated,
        }
    }

    #[inline(always)]
    fn near(&self, x: &Point3<f64>) -> bool {
        (x - self.centre).norm_squared() < self.inflated * self.inflated
    }
}

/// Face planes of a hull at a pose, inflated.
struct HullQuery {
    planes: Vec<Plane>,
    coefficient: f64,
}

impl HullQuery {
    fn new(planes: &[Plane], coefficient: f64, state: &State, inflation: f64) -> Self {
        let place = |plane: &Plane| {
            let normal = state.rotation * plane.normal;
            let offset = plane.offset + inflation + normal.dot(&state.position.coords);
            Plane { normal, offset }
        };
        Self { planes: planes.iter().map(place).collect(), coefficient }
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

/// Any clump of balls and hulls: the piece with the largest pressure wins, so that the stored
/// energy is continuous where the carving piece changes.
pub(crate) struct ClumpQuery {
    balls: Vec<BallQuery>,
    hulls: Vec<HullQuery>,
    position: Point3<f64>,
}

impl Query for ClumpQuery {
    fn touch(&self, x: &Point3<f64>, n: &Vector3<f64>) -> Touch {
        let balls = self.balls.iter().map(|ball| ball.touch(x, n));
        let hulls = self.hulls.iter().map(|hull| hull.touch(x, n, &self.position));
        let pressure = |touch: &Touch| touch.coefficient * touch.overlap;
        let deepest = balls
            .chain(hulls)
            .reduce(|best, touch| if pressure(&touch) > pressure(&best) { touch } else { best });
        deepest.expect("a shape has at least one piece")
    }

    fn near(&self, _: &Point3<f64>) -> bool {
        true
    }
}

/// The query of a whole body: a ball alone has a fast path.
pub(crate) enum BodyQuery {
    Ball(BallQuery),
    Clump(ClumpQuery),
}

impl BodyQuery {
    pub(crate) fn new(contactors: &[Contactor], state: &State, inflation: f64) -> Self {
        if let [Contactor { piece: Piece::Ball(ball), coefficient }] = contactors {
            let query = BallQuery::new(&ball.centre, ball.radius, *coefficient, state, inflation);
            return Self::Ball(query);
        }
        let mut clump =
            ClumpQuery { balls: Vec::new(), hulls: Vec::new(), position: state.position };
        for Contactor { piece, coefficient } in contactors {
            match piece {
                Piece::Ball(ball) => clump.balls.push(BallQuery::new(
                    &ball.centre,
                    ball.radius,
                    *coefficient,
                    state,
                    inflation,
                )),
                Piece::Hull(hull) => {
                    clump.hulls.push(HullQuery::new(hull.planes(), *coefficient, state, inflation));
                }
            }
        }
        Self::Clump(clump)
    }
}

/// A lower bound of the distance from `x` to the shape at `state` [m].
pub(crate) fn clearance(shape: &Shape, state: &State, x: &Point3<f64>) -> f64 {
    let local = state.rotation.inverse_transform_vector(&(x - state.position));
    shape.pieces().iter().map(|piece| piece_clearance(piece, &local)).fold(f64::INFINITY, f64::min)
}

fn piece_clearance(piece: &Piece, local: &Vector3<f64>) -> f64 {
    match piece {
        Piece::Ball(ball) => (local - ball.centre.coords).norm() - ball.radius,
        Piece::Hull(hull) => hull
            .planes()
            .iter()
            .map(|plane| plane.normal.dot(local) - plane.offset)
            .fold(f64::NEG_INFINITY, f64::max),
    }
}

/// True when the line from `x` down along -n meets the shape grown by `margin` [m].
pub(crate) fn column_meets(
    shape: &Shape,
    state: &State,
    x: &Point3<f64>,
    n: &Vector3<f64>,
    margin: f64,
) -> bool {
    let x = state.rotation.inverse_transform_vector(&(x - state.position));
    let n = state.rotation.inverse_transform_vector(n);
    shape.pieces().iter().any(|piece| match piece {
        Piece::Ball(ball) => {
            let to_centre = ball.centre.coords - x;
            let (along, radius) = (to_centre.dot(&n), ball.radius + margin);
            let square = radius * radius - (to_centre - n * along).norm_squared();
            square > 0.0 && along - square.sqrt() < margin
        }
        Piece::Hull(hull) => {
            let (mut low, mut high) = (f64::NEG_INFINITY, margin);
            for plane in hull.planes() {
                let slope = plane.normal.dot(&n);
                let room = plane.offset + margin - plane.normal.dot(&x);
                if slope < 0.0 {
                    low = low.max(room / slope);
                } else if slope > 0.0 {
                    high = high.min(room / slope);
                } else if room < 0.0 {
                    return false;
                }
            }
            low < high
        }
    })
}

/// Box around the shape at `state`, grown by `margin` [m].
pub(crate) fn bounds(shape: &Shape, state: &State, margin: f64) -> [Point3<f64>; 2] {
    let mut low = Point3::from(Vector3::repeat(f64::INFINITY));
    let mut high = -low;
    for piece in shape.pieces() {
        let [l, h] = piece_bounds(piece, &state.position, &state.rotation);
        low = low.inf(&l);
        high = high.sup(&h);
    }
    [low - Vector3::repeat(margin), high + Vector3::repeat(margin)]
}

fn piece_bounds(
    piece: &Piece,
    position: &Point3<f64>,
    rotation: &UnitQuaternion<f64>,
) -> [Point3<f64>; 2] {
    match piece {
        Piece::Ball(ball) => {
            let centre = position + rotation * ball.centre.coords;
            let reach = Vector3::repeat(ball.radius);
            [centre - reach, centre + reach]
        }
        Piece::Hull(hull) => {
            let mut low = Point3::from(Vector3::repeat(f64::INFINITY));
            let mut high = -low;
            for vertex in hull.vertices() {
                let placed = position + rotation * vertex.coords;
                low = low.inf(&placed);
                high = high.sup(&placed);
            }
            [low, high]
        }
    }
}
