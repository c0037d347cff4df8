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

    /// Drucker and Prager's criterion (the paper's Eq. 11) on the stress at the face: normal and
    /// tangential stress of the pair, the others as the mean of its ends. Squared, so that no root
    /// is drawn. A bit for each pair that fails if it is a link that can break.
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

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg32;

    use super::*;
    use crate::block::Line;
    use crate::four::LANES;
    use crate::lanes::Run;
    use crate::solid::Solid;

    /// Four pairs between elements of one stress, whose equivalent and mean stress are `bound` [Pa]
    /// and whose faces bear as much, along any direction: whether they are calm, and which fail.
    fn judge(constants: &Constants, bound: f64, generator: &mut Pcg32) -> (bool, u32) {
        let mut number = || 2.0 * generator.random::<f64>() - 1.0;
        let [xx, yy, zz, xy] = [number(), number(), number(), number()];
        let angle = std::f64::consts::PI * number();
        let [mean, normal, tangential] = [number(), number(), number()].map(|n| bound.copysign(n));
        let third = (xx + yy + zz) / 3.0;
        let [xx, yy, zz] = [xx - third, yy - third, zz - third];
        let scale = bound / (1.5 * (xx * xx + yy * yy + zz * zz + 2.0 * xy * xy)).sqrt();
        let [sxx, syy, szz] = [xx, yy, zz].map(|part| [mean + scale * part; 2 * LANES]);
        let criterion = Criterion {
            sxx: &sxx,
            syy: &syy,
            sxy: &[scale * xy; 2 * LANES],
            szz: &szz,
            level: &[bound * bound; 2 * LANES],
            constants,
        };
        let mut block = Block::EMPTY;
        let direction = [angle.cos(), angle.sin()];
        let line = Line { direction, ..block.line(0) };
        (0..LANES).for_each(|lane| block.put(lane, &line));
        let (ends, stress) = (Run([0, LANES as u32]), [normal, tangential].map(Four::splat));
        (criterion.is_calm(ends, stress), criterion.fails(&block, ends, stress))
    }

    /// Fails for a calm stress under which links fail, and for one so low that it leaves out
    /// nothing.
    #[test]
    fn no_link_fails_under_calm_stress() {
        for strength_ratio in [1.0, 1.7, 4.0, 20.0] {
            let solid = Solid { strength_ratio, ..Solid::default() };
            let constants = Constants::new(&solid, 25e-6);
            let mut generator = Pcg32::seed_from_u64(1);
            let mut failed = 0;
            for _ in 0..100_000 {
                let calm = constants.calm * (1.0 - 1e-12);
                assert_eq!(judge(&constants, calm, &mut generator), (true, 0), "{strength_ratio}");
                let (is_calm, fails) = judge(&constants, 2.0 * constants.calm, &mut generator);
                assert!(!is_calm);
                failed += u32::from(fails != 0);
            }
            assert!(failed > 0, "{strength_ratio}: none of them fails under twice as much either");
        }
    }
}
