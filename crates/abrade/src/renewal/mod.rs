//! Renewal: the worn solid becomes the undeformed one, so that a surface can wear away to any
//! depth. Normals, areas and reaches are those of the solid as it is now; what was worn before
//! stays in the sums.
//!
//! The volume that a node has been charged with is its rest area times its depth (Eq. 6). What it
//! has swept differs from that by the share depth / radius of curvature, so its place is set right
//! first ([`paid`]): the solid has lost what the sum says. Then the nodes that have moved, and those
//! near them, are spread evenly without a change of volume.

mod paid;
#[cfg(test)]
mod tests;

use std::borrow::Cow;
use std::sync::Arc;

use nalgebra::Point3;
use thiserror::Error;

use crate::grid::Grid;
use crate::layout::Layout;
use crate::mesh::{MeshError, TriangleMesh};
use crate::nodes::Nodes;
use crate::surface::{Surface, small_area};

/// Depth since the last renewal over the pitch at which the next one is due. Until then the volume
/// that nodes have swept differs from the one charged by this share of pitch / radius of curvature:
/// of what is worn in one epoch at most 1 to 5 percent, a third of it at a third of the depth.
const DUE: f64 = 0.2;

/// What a renewal did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Renewal {
    /// Nodes that had worn since the renewal before.
    pub worn_nodes: usize,
    /// Largest share by which the depth of a node was set right for the curvature of the surface
    /// [-].
    pub correction: f64,
}

/// Why a surface was not renewed; it is as it was. Places are in the surface's frame [m].
#[derive(Clone, Debug, PartialEq, Error)]
pub enum RenewError {
    /// A strip has no inside, a leaf no nodes of its own.
    #[error("only the surface of a solid that is no leaf can be renewed")]
    NoSolid,
    /// The surface at a node is bent so much over its depth that the node cannot have swept what it
    /// was charged with.
    #[error(
        "the node at ({}, {}, {}) m has sunk by {depth:e} m since the last renewal, where the \
         surface narrows to {narrowed:.2} of its area",
        at.x, at.y, at.z
    )]
    Spent {
        /// Where it is.
        at: Point3<f64>,
        /// Its depth since the last renewal [m].
        depth: f64,
        /// Mean area on its way over the undeformed one [-].
        narrowed: f64,
    },
    /// The depths at which nodes have swept what they were charged with do not come to rest.
    #[error("{rounds} rounds do not find the depths at which nodes have swept their volume")]
    Unsettled {
        /// Rounds made.
        rounds: usize,
    },
    /// A facet turned over or collapsed.
    #[error("the facet at ({}, {}, {}) m has turned over or collapsed", at.x, at.y, at.z)]
    Spoilt {
        /// Its middle.
        at: Point3<f64>,
    },
    /// The worn facets bound no solid.
    #[error("the worn surface bounds no solid: {0}")]
    Mesh(#[from] MeshError),
}

/// What was worn before the last renewal.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Past {
    /// Number of renewals.
    pub renewals: u32,
    /// Sum over the renewals of rest area * depth [m3].
    pub volume: f64,
    /// The same of the depths, where the nodes are now [m].
    pub depth: Vec<f64>,
}

impl Surface {
    /// True for the surface of a solid on which a node has sunk by a fifth of the pitch since the
    /// last renewal. Costs nothing; never true for strips and leaves.
    pub fn is_due_for_renewal(&self) -> bool {
        self.can_be_renewed() && self.deepest > DUE * self.pitch()
    }

    /// Makes the worn solid the undeformed one. [`Surface::wear_volume`] and [`Surface::worn`] stay
    /// what they are and [`Surface::worn_depth`] goes on; depths begin at zero anew. Nodes keep
    /// their numbers; they and their edges move within the surface where it has worn. What has not
    /// worn stays as it is. The cost goes with the number of nodes, worn or not: 7 microseconds for
    /// each where little has worn, 17 where all has, half of it for facets that might cross. On
    /// round solids the search for reaches dominates, which looks at all nodes for each.
    ///
    /// Blows that sink nodes at edges by more than half a pitch in one epoch, and parts that wear
    /// thinner than the pitch, can leave a surface that is refused.
    ///
    /// A body in contact stands on springs of the surface as it was: [`crate::Encounter::advance`]
    /// refuses a surface that was renewed before the contact was over.
    ///
    /// # Errors
    /// There is nothing to be renewed, or the worn surface cannot be made a sound mesh.
    pub fn renew(&mut self) -> Result<Renewal, RenewError> {
        let Some(triangles) = self.facets().filter(|_| self.can_be_renewed()) else {
            return Err(RenewError::NoSolid);
        };
        let is_worn: Vec<bool> = self.nodes.depth.iter().map(|depth| *depth > 0.0).collect();
        let worn_nodes = is_worn.iter().filter(|worn| **worn).count();
        if worn_nodes == 0 {
            return Ok(Renewal::default());
        }
        let depths = paid::depths(&self.nodes, triangles)?;
        let place = |i: usize| self.nodes.rest_position[i] - self.nodes.normal[i] * depths[i];
        let worn = (0..depths.len()).map(place).collect();
        let worn = TriangleMesh::trusted(worn, triangles.to_vec());
        let before = TriangleMesh::trusted(self.nodes.rest_position.clone(), triangles.to_vec());
        let mut past = self.past.as_deref().cloned().unwrap_or_default();
        past.depth.resize(depths.len(), 0.0);
        past.depth.iter_mut().zip(&self.nodes.depth).for_each(|(past, depth)| *past += depth);
        past.volume += self.nodes.wear_volume();
        past.renewals = past.renewals.saturating_add(1);
        let after = worn.spread(&is_worn, &mut past.depth);
        if let Some(at) = after.spoilt_since(&before) {
            return Err(RenewError::Spoilt { at });
        }
        after.check_since(&before)?;
        let changes = depths.iter().zip(&self.nodes.depth).filter(|(_, depth)| **depth > 0.0);
        let correction = changes.map(|(new, old)| (new / old - 1.0).abs()).fold(0.0, f64::max);
        self.lay_out(&after).ok_or(RenewError::NoSolid)?;
        self.past = Some(Arc::new(past));
        Ok(Renewal { worn_nodes, correction })
    }

    /// How often the surface has been renewed.
    pub fn renewals(&self) -> u32 {
        self.past.as_ref().map_or(0, |past| past.renewals)
    }

    /// Depth of what has been worn off above node `i` since the surface was made [m]. Where a node
    /// has moved within the surface in a renewal it is that of the place where it is now.
    pub fn worn_depth(&self, i: usize) -> f64 {
        self.past_depth(i) + self.depth(i)
    }

    /// The nodes as if all of the wear were one epoch's, to show and to count: `depth` is
    /// [`Surface::worn_depth`], and the undeformed position lies that far above where the node is.
    /// The sum over them is not the wear volume: that is [`Surface::wear_volume`].
    pub fn nodes_since_made(&self) -> Cow<'_, Nodes> {
        let nodes = self.nodes();
        if self.past.is_none() {
            return Cow::Borrowed(nodes);
        }
        let above = |i: usize| nodes.rest_position[i] + nodes.normal[i] * self.past_depth(i);
        Cow::Owned(Nodes {
            rest_position: (0..nodes.len()).map(above).collect(),
            depth: (0..nodes.len()).map(|i| self.worn_depth(i)).collect(),
            ..nodes.clone()
        })
    }

    /// The part of [`Surface::worn_depth`] before the last renewal [m].
    #[inline]
    pub(crate) fn past_depth(&self, i: usize) -> f64 {
        self.past.as_ref().map_or(0.0, |past| past.depth[i])
    }

    /// Makes an unworn `mesh` the undeformed surface; None, and no change, when it bounds no solid.
    fn lay_out(&mut self, mesh: &TriangleMesh) -> Option<()> {
        let nodes = mesh.nodes();
        self.layout = Layout::mesh(&nodes, mesh.triangles())?;
        self.pitch = mesh.pitch();
        self.grid = Grid::new(&nodes.rest_position, 4.0 * self.pitch);
        self.least_area = small_area(&nodes.rest_area);
        self.nodes = nodes;
        self.deepest = 0.0;
        self.sunk.iter_mut().for_each(|sunk| sunk.note_all());
        Some(())
    }
}
