//! Contact query of the return mapping: where a body carves a node.

use nalgebra::{Point3, Vector3};

use crate::body::State;
use crate::clump_query::ClumpQuery;
use crate::mesh_query::MeshQuery;
use crate::shape::{Ball, Piece};
#[cfg(feature = "state")]
use crate::state::{Fault, finite, positive, require};

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
    /// True for a lone ball.
    const IS_BALL: bool = false;

    /// True for several balls and hulls, one of which may come upon a node that gets away from another.
    const HAS_PIECES: bool = false;

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

/// The query of a whole body: a ball alone has a fast path, one with a worn surface of its own goes
/// by that.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub(crate) enum BodyQuery {
    Ball(BallQuery),
    Clump(ClumpQuery),
    Mesh(Box<MeshQuery>),
}

/// A single ball.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct BallQuery {
    ball: Ball,
    coefficient: f64,
    inflated: f64,
    #[cfg_attr(feature = "state", serde(skip))]
    centre: Point3<f64>,
    #[cfg_attr(feature = "state", serde(skip))]
    offset: Vector3<f64>,
}

impl BodyQuery {
    /// A query of the body that `contactors` make up, inflated by `inflation` [m]; it stands
    /// nowhere until it is placed.
    pub(crate) fn new(contactors: &[Contactor], inflation: f64) -> Self {
        match contactors {
            [Contactor { piece: Piece::Ball(ball), coefficient }] => {
                Self::Ball(BallQuery::new(ball, *coefficient, inflation))
            }
            _ => Self::Clump(ClumpQuery::new(contactors, inflation)),
        }
    }

    /// Moves the query to `state`.
    pub(crate) fn place(&mut self, state: &State) {
        match self {
            Self::Ball(ball) => ball.place(state),
            Self::Clump(clump) => clump.place(state),
            Self::Mesh(mesh) => mesh.place(state),
        }
    }
}

impl BallQuery {
    pub(crate) fn new(ball: &Ball, coefficient: f64, inflation: f64) -> Self {
        Self {
            ball: *ball,
            coefficient,
            inflated: ball.radius + inflation,
            centre: ball.centre,
            offset: ball.centre.coords,
        }
    }

    /// k_w [Pa/m], or K sqrt(R_eff) [N/m^1.5].
    pub(crate) fn coefficient(&self) -> f64 {
        self.coefficient
    }

    pub(crate) fn place(&mut self, state: &State) {
        self.offset = state.rotation * self.ball.centre.coords;
        self.centre = state.position + self.offset;
    }
}

impl Query for BallQuery {
    const IS_BALL: bool = true;

    #[inline(always)]
    fn touch(&self, x: &Point3<f64>, n: &Vector3<f64>) -> Touch {
        let to_node = x - self.centre;
        let distance = to_node.norm();
        let m = to_node / distance;
        Touch {
            overlap: self.inflated - distance,
            contact_normal: m,
            arm: self.offset + m * self.ball.radius,
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

#[cfg(feature = "state")]
impl BodyQuery {
    pub(crate) fn check(&self) -> Result<(), Fault> {
        match self {
            Self::Ball(ball) => ball.check(),
            Self::Clump(clump) => clump.check(),
            Self::Mesh(mesh) => mesh.check(),
        }
    }
}

#[cfg(feature = "state")]
impl BallQuery {
    pub(crate) fn check(&self) -> Result<(), Fault> {
        let sizes = [self.ball.radius, self.inflated, self.coefficient];
        let fine = sizes.into_iter().all(positive) && finite(self.ball.centre.coords.iter());
        require(fine, "a ball in contact is out of range")
    }
}
