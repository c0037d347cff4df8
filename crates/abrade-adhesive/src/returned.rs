//! Pairs follow the plastic return of their ends; which links fail then.

use crate::block::Block;
use crate::four::Four;
use crate::lanes::Ends;
use crate::solid::Constants;

/// What a pair takes of the return of its ends.
pub(crate) struct Return<'a> {
    pub(crate) kept: &'a [f64],
    pub(crate) shifted: &'a [f64],
}

impl Return<'_> {
    /// Normal and tangential stress after both ends' returns, averaged.
    #[inline(always)]
    pub(crate) fn follow(&self, block: &Block, ends: impl Ends) -> [Four; 2] {
        let (half, one) = (Four::splat(0.5), Four::splat(1.0));
        let lost = block.live * (one - half * ends.sum(self.kept));
        let shifted = block.live * half * ends.sum(self.shifted);
        let (normal, tangential) = (block.normal, block.tangential);
        [normal - lost * normal + shifted, tangential - lost * tangential]
    }
}

/// Stress of the elements, and what links bear.
pub(crate) struct Criterion<'a> {
    pub(crate) sxx: &'a [f64],
    pub(crate) syy: &'a [f64],
    pub(crate) sxy: &'a [f64],
    pub(crate) szz: &'a [f64],
    pub(crate) level: &'a [f64],
    pub(crate) constants: &'a Constants,
}

impl Criterion<'_> {
    /// Whether no pair of a block can fail and none of its ends flows, under these stresses.
    #[inline(always)]
    pub(crate) fn is_calm(&self, ends: impl Ends, [normal, tangential]: [Four; 2]) -> bool {
        let [level_i, level_j] = ends.get(self.level);
        let own = (normal * normal).max(tangential * tangential);
        let highest = level_i.max(level_j).max(own);
        !highest.any_above(Four::splat(self.constants.calm * self.constants.calm))
    }

    /// Drucker and Prager's criterion (the paper's Eq. 11) on the stress at the face: normal and tangential
    /// stress of the pair, the others as the mean of its ends. Squared, so that no root is drawn. A bit for
    /// each pair that fails if it is a link that can break.
    #[inline(always)]
    pub(crate) fn fails(&self, block: &Block, ends: impl Ends, stress: [Four; 2]) -> u32 {
        let ([normal, tangential], nx, ny) = (stress, block.nx, block.ny);
        let half = Four::splat(0.5);
        let (sxx, syy, sxy) = (ends.sum(self.sxx), ends.sum(self.syy), ends.sum(self.sxy));
        let along = half * (sxx * (ny * ny) + syy * (nx * nx)) - sxy * (nx * ny);
        let szz = half * ends.sum(self.szz);
        let mean = (normal + along + szz) * Four::splat(1.0 / 3.0);
        let (a, b, c) = (normal - along, along - szz, szz - normal);
        let across = tangential * tangential;
        let square = half * (a * a + b * b + c * c) + Four::splat(3.0) * across;
        let Constants { strength, strength_mean, strength_shear, .. } = *self.constants;
        let left = Four::splat(strength) - Four::splat(strength_mean) * mean;
        let left = left.max(Four::ZERO);
        (left * left).up_to(Four::splat(strength_shear * strength_shear) * square)
    }
}
