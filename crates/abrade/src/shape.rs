//! Shapes of bodies: a ball, a convex hull, or a clump of either. Coordinates are about the
//! centre of mass of the body.

use nalgebra::{Point3, UnitQuaternion, Vector3};

use crate::error::{ParameterError, ShapeError};
use crate::hull::Hull;

/// A union of convex pieces about the centre of mass.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "state", serde(try_from = "Vec<Piece>", into = "Vec<Piece>"))]
pub struct Shape {
    pieces: Vec<Piece>,
    bounding_radius: f64,
}

/// A convex piece of a shape.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub enum Piece {
    /// A ball.
    Ball(Ball),
    /// A convex hull.
    Hull(Hull),
}

/// A ball.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub struct Ball {
    /// Centre [m].
    pub centre: Point3<f64>,
    /// Radius [m].
    pub radius: f64,
}

impl Shape {
    /// A ball about the origin.
    ///
    /// # Errors
    /// A radius that is not finite and above zero.
    pub fn ball(radius: f64) -> Result<Self, ShapeError> {
        Self::union(vec![Piece::Ball(Ball { centre: Point3::origin(), radius })])
    }

    /// A hull about the origin.
    pub fn hull(hull: Hull) -> Self {
        let bounding_radius = hull.bounding_radius();
        Self { pieces: vec![Piece::Hull(hull)], bounding_radius }
    }

    /// A union of pieces; coordinates about the body's centre of mass.
    ///
    /// # Errors
    /// No piece, or a ball whose radius is not finite and above zero.
    pub fn union(pieces: Vec<Piece>) -> Result<Self, ShapeError> {
        if pieces.is_empty() {
            return Err(ShapeError::Empty { what: "it has no pieces" });
        }
        for piece in &pieces {
            let Piece::Ball(ball) = piece else { continue };
            let values = ball.centre.coords.iter().map(|&x| ("centre", x, x.is_finite()));
            let radius = ("radius", ball.radius, ball.radius > 0.0 && ball.radius.is_finite());
            if let Some((field, value, _)) = values.chain([radius]).find(|(.., fine)| !fine) {
                let allowed = if field == "radius" { "finite and above zero" } else { "finite" };
                return Err(ParameterError { field, value, allowed: allowed.into() }.into());
            }
        }
        let bounding_radius = pieces.iter().map(Piece::bounding_radius).fold(0.0, f64::max);
        Ok(Self { pieces, bounding_radius })
    }

    /// This shape, `shift` [m] from where it was.
    pub fn moved(&self, shift: &Vector3<f64>) -> Self {
        let pieces: Vec<Piece> = self.pieces.iter().map(|piece| piece.moved(shift)).collect();
        let bounding_radius = pieces.iter().map(Piece::bounding_radius).fold(0.0, f64::max);
        Self { pieces, bounding_radius }
    }

    /// The pieces.
    pub fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// True when a piece has faces.
    pub fn has_faces(&self) -> bool {
        self.pieces.iter().any(|piece| matches!(piece, Piece::Hull(_)))
    }

    /// Largest distance of a point of the shape from the centre of mass [m].
    pub fn bounding_radius(&self) -> f64 {
        self.bounding_radius
    }

    /// Lowest point's coordinate along the unit vector `up` when the shape is turned by
    /// `rotation` [m].
    pub fn lowest(&self, rotation: &UnitQuaternion<f64>, up: &Vector3<f64>) -> f64 {
        let up = rotation.inverse_transform_vector(up);
        self.pieces.iter().map(|piece| piece.lowest(&up)).fold(f64::INFINITY, f64::min)
    }
}

impl Piece {
    fn moved(&self, shift: &Vector3<f64>) -> Self {
        match self {
            Self::Ball(ball) => Self::Ball(Ball { centre: ball.centre + shift, ..*ball }),
            Self::Hull(hull) => Self::Hull(hull.clone().moved(shift)),
        }
    }

    fn bounding_radius(&self) -> f64 {
        match self {
            Self::Ball(ball) => ball.centre.coords.norm() + ball.radius,
            Self::Hull(hull) => hull.bounding_radius(),
        }
    }

    /// Lowest coordinate along `up`, given in the body's frame.
    fn lowest(&self, up: &Vector3<f64>) -> f64 {
        match self {
            Self::Ball(ball) => ball.centre.coords.dot(up) - ball.radius,
            Self::Hull(hull) => {
                hull.vertices().iter().map(|v| v.coords.dot(up)).fold(f64::INFINITY, f64::min)
            }
        }
    }
}

#[cfg(feature = "state")]
impl TryFrom<Vec<Piece>> for Shape {
    type Error = ShapeError;

    fn try_from(pieces: Vec<Piece>) -> Result<Self, ShapeError> {
        Self::union(pieces)
    }
}

#[cfg(feature = "state")]
impl From<Shape> for Vec<Piece> {
    fn from(shape: Shape) -> Self {
        shape.pieces
    }
}
