//! Forces and torques of the pairs.

use crate::block::Block;
use crate::four::Four;
use crate::lanes::{Ends, Sides};

/// Sums of the forces on the elements.
pub(crate) struct Forces<'a> {
    pub(crate) force_x: Sides<'a>,
    pub(crate) force_y: Sides<'a>,
    pub(crate) torque: Sides<'a>,
    /// Stress of a dashpot per strain of a step [Pa], and the area of a face [m2].
    pub(crate) viscosity: Four,
    pub(crate) face: Four,
}

impl Forces<'_> {
    /// Adds the forces of a block; the dashpots of linked pairs take part. Returns the squares of
    /// their strains.
    #[inline(always)]
    pub(crate) fn act(&mut self, block: &Block, ends: impl Ends, stress: [Four; 2]) -> Four {
        let dashpot = block.live * self.viscosity;
        let ([normal, tangential], stretch, shear) = (stress, block.stretch, block.shear);
        let normal = self.face * (normal + dashpot * stretch);
        let tangential = self.face * (tangential + dashpot * shear);
        let fx = normal * block.nx - tangential * block.ny;
        let fy = normal * block.ny + tangential * block.nx;
        let torque = Four::splat(0.5) * block.distance * tangential;
        ends.add(&mut self.force_x, [fx, -fx]);
        ends.add(&mut self.force_y, [fy, -fy]);
        ends.add(&mut self.torque, [torque, torque]);
        block.live * (stretch * stretch + shear * shear)
    }
}
