//! A wear surface: nodes, laws, and what has been worn off.

use crate::error::SurfaceError;
use crate::laws::{ElasticLaw, FlowLaw, Removal};
use crate::material::Material;
use crate::nodes::Nodes;

/// The laws a surface obeys.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceLaws {
    /// What it is made of.
    pub material: Material,
    /// Elastic part.
    pub elastic: ElasticLaw,
    /// Flow part.
    pub flow: FlowLaw,
    /// Which part of the displaced volume is debris.
    pub removal: Removal,
}

/// A flat strip of nodes in close-packed rows along y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HexStrip {
    /// Extent along x [m].
    pub length: f64,
    /// Extent along y [m].
    pub width: f64,
    /// Distance of neighbours [m].
    pub pitch: f64,
    /// a_s [m2]; sqrt(3)/2 pitch^2 unless given.
    pub rest_area: Option<f64>,
}

/// Volumes worn off a surface [m3], and its largest load.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Worn {
    /// Displaced by the normal flow.
    pub normal: f64,
    /// Displaced by the lateral flow.
    pub lateral: f64,
    /// Broken off as overhangs, unpaid by the ledger.
    pub chip: f64,
    /// Debris, by the surface's removal rule.
    pub removed: f64,
    /// Largest total force along minus the normals [N].
    pub peak_normal_force: f64,
    /// Largest number of nodes that carried force at one instant.
    pub peak_touching: usize,
}

/// A surface that wears. Its frame has its origin at the node nearest its middle.
#[derive(Clone, Debug)]
pub struct Surface {
    pub(crate) nodes: Nodes,
    pub(crate) laws: SurfaceLaws,
    pub(crate) worn: Worn,
}

impl Surface {
    /// A flat strip in the plane z = 0, normals along +z.
    ///
    /// # Errors
    /// A parameter out of range, no node, too many nodes.
    pub fn hex_strip(_strip: HexStrip, _laws: SurfaceLaws) -> Result<Self, SurfaceError> {
        todo!()
    }

    /// The nodes.
    pub fn nodes(&self) -> &Nodes {
        &self.nodes
    }

    /// The laws.
    pub fn laws(&self) -> &SurfaceLaws {
        &self.laws
    }

    /// Volumes worn off so far.
    pub fn worn(&self) -> &Worn {
        &self.worn
    }

    /// W_V [m3] = sum of rest_area * depth (Eq. 6), chips included.
    pub fn wear_volume(&self) -> f64 {
        self.nodes.wear_volume()
    }

    /// Corners of the box around the undeformed nodes, in the surface's frame [m].
    pub fn bounds(&self) -> [nalgebra::Point3<f64>; 2] {
        todo!()
    }
}
