//! Contact query of a body that has a worn surface of its own: the nearest of its facets.

use nalgebra::{Isometry3, Point3, Vector3};

use crate::body::State;
use crate::facets::Facets;
use crate::query::{Query, Touch};
#[cfg(feature = "state")]
use crate::state::{Fault, finite, positive, require};
use crate::surface::Surface;

/// The facets of a body near a contact.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct MeshQuery {
    /// Frame of the mesh in that of the body.
    offset: Isometry3<f64>,
    coefficient: f64,
    #[cfg_attr(feature = "state", serde(skip))]
    facets: Facets,
    #[cfg_attr(feature = "state", serde(skip))]
    pose: Isometry3<f64>,
    #[cfg_attr(feature = "state", serde(skip))]
    centre: Point3<f64>,
}

impl MeshQuery {
    pub(crate) fn new(offset: Isometry3<f64>, coefficient: f64) -> Self {
        let (facets, pose) = (Facets::default(), Isometry3::identity());
        Self { offset, coefficient, facets, pose, centre: Point3::origin() }
    }

    pub(crate) fn place(&mut self, state: &State) {
        self.pose = state.pose() * self.offset;
        self.centre = state.position;
    }

    /// See [`Facets::set`].
    pub(crate) fn set(&mut self, corners: &[[u32; 3]], surface: &Surface, reach: f64) {
        self.facets.set(corners, surface, reach);
    }

    /// Corners of the facet under `x`, and their weights.
    pub(crate) fn seat(&self, x: &Point3<f64>) -> Option<([u32; 3], [f64; 3])> {
        self.facets.seat(&self.pose.inverse_transform_point(x))
    }
}

impl Query for MeshQuery {
    // Out of line: the loop over facets would be copied into every root of every law.
    #[inline(never)]
    fn touch(&self, x: &Point3<f64>, n: &Vector3<f64>) -> Touch {
        let local = self.pose.inverse_transform_point(x);
        let (overlap, m) = match self.facets.foot(&local) {
            Some(foot) => (-foot.height, self.pose.rotation * foot.normal),
            None => (-self.facets.reach(), -n),
        };
        Touch {
            overlap,
            contact_normal: m,
            arm: x + m * overlap - self.centre,
            coefficient: self.coefficient,
            literal_cosine: -m.dot(n),
            radius: f64::INFINITY,
        }
    }

    #[inline]
    fn near(&self, x: &Point3<f64>) -> bool {
        self.facets.near(&self.pose.inverse_transform_point(x))
    }
}

#[cfg(feature = "state")]
impl MeshQuery {
    pub(crate) fn check(&self) -> Result<(), Fault> {
        let place = self.offset.translation.vector.iter().chain(self.offset.rotation.coords.iter());
        let fine = positive(self.coefficient) && finite(place);
        require(fine, "a mesh in contact is out of range")
    }
}
