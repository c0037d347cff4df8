//! The nodes of a wear surface, as columns. Position, normal and area are fixed; `depth` is the
//! only column that evolves: a node only ever moves along minus its normal. A renewal of a closed
//! surface (`renewal`) begins with new ones.

use nalgebra::{Point3, Vector3};

/// Structure of arrays, one entry per node, in the surface's frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Nodes {
    /// Position of the undeformed node [m].
    pub rest_position: Vec<Point3<f64>>,
    /// Outward unit normal [-].
    pub normal: Vec<Vector3<f64>>,
    /// a_s [m2]: area the node stands for.
    pub rest_area: Vec<f64>,
    /// s [m]: worn depth along minus the normal; never decreases.
    pub depth: Vec<f64>,
}

impl Nodes {
    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.depth.len()
    }

    /// True without nodes.
    pub fn is_empty(&self) -> bool {
        self.depth.is_empty()
    }

    /// Present position of node `i` [m].
    pub fn position(&self, i: usize) -> Point3<f64> {
        self.rest_position[i] - self.normal[i] * self.depth[i]
    }

    /// W_V [m3] = sum of rest_area * depth (Eq. 6).
    pub fn wear_volume(&self) -> f64 {
        self.rest_area.iter().zip(&self.depth).map(|(area, depth)| area * depth).sum()
    }
}
