//! Shapes of bodies: a ball, a convex hull, or a clump of either. Coordinates are about the
//! centre of mass of the body.

use nalgebra::{Matrix3, Point3, UnitQuaternion, Vector3};

use crate::body::Inertia;
use crate::error::ShapeError;

/// A union of convex pieces about the centre of mass.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    pieces: Vec<Piece>,
}

/// A convex piece of a shape.
#[derive(Clone, Debug, PartialEq)]
pub enum Piece {
    /// A ball.
    Ball(Ball),
    /// A convex hull.
    Hull(Hull),
}

/// A ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Centre [m].
    pub centre: Point3<f64>,
    /// Radius [m].
    pub radius: f64,
}

/// A convex polyhedron, kept as its vertices and the planes of its faces.
#[derive(Clone, Debug, PartialEq)]
pub struct Hull {
    vertices: Vec<Point3<f64>>,
    /// Outward unit normals of the faces.
    normals: Vec<Vector3<f64>>,
    /// Distance of each face's plane from the origin [m].
    offsets: Vec<f64>,
}

/// The regular polyhedra and the cuboid's like that a scene can name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, schemars::JsonSchema))]
pub enum Polyhedron {
    /// (1,1,1), (1,-1,-1), (-1,1,-1), (-1,-1,1), times edge / sqrt 8.
    Tetrahedron,
    /// Faces along the axes.
    Cube,
    /// (+-1,0,0).., times edge / sqrt 2.
    Octahedron,
    /// (0,+-1,+-phi).., times edge / 2.
    Icosahedron,
}

impl Shape {
    /// A ball about the origin.
    ///
    /// # Errors
    /// A radius that is not finite and above zero.
    pub fn ball(_radius: f64) -> Result<Self, ShapeError> {
        todo!()
    }

    /// A union of pieces; coordinates about the body's centre of mass.
    ///
    /// # Errors
    /// No piece, or a ball whose radius is not finite and above zero.
    pub fn union(_pieces: Vec<Piece>) -> Result<Self, ShapeError> {
        todo!()
    }

    /// The pieces.
    pub fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// Largest distance of a point of the shape from the centre of mass [m].
    pub fn bounding_radius(&self) -> f64 {
        todo!()
    }

    /// Lowest point's coordinate along the unit vector `up` when the shape is turned by
    /// `rotation` [m].
    pub fn lowest(&self, _rotation: &UnitQuaternion<f64>, _up: &Vector3<f64>) -> f64 {
        todo!()
    }
}

impl Hull {
    /// The convex hull of `points` and its inertia at `density` [kg/m3]; the hull is moved so that
    /// its centre of mass is the origin, and the shift is returned (old = new + shift).
    ///
    /// # Errors
    /// No points, points that are not finite, or coplanar points.
    pub fn solid(
        _points: &[Point3<f64>],
        _density: f64,
    ) -> Result<(Self, Inertia, Vector3<f64>), ShapeError> {
        todo!()
    }

    /// Vertices [m].
    pub fn vertices(&self) -> &[Point3<f64>] {
        &self.vertices
    }
}

impl Polyhedron {
    /// Vertices of the polyhedron with this `edge` [m].
    pub fn vertices(self, _edge: f64) -> Vec<Point3<f64>> {
        todo!()
    }
}

/// Vertices of a box with these half extents [m].
pub fn cuboid_vertices(_half_extents: &Vector3<f64>) -> Vec<Point3<f64>> {
    todo!()
}

/// Keeps the signature of inertia tensors in one place.
pub type InertiaTensor = Matrix3<f64>;
