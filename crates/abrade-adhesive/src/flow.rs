//! Plastic flow of the elements: von Mises with linear hardening, by radial return (Wilkins).

use multiversion::multiversion;

use crate::elements::Elements;
use crate::four::{Four, LANES};
use crate::lanes::{Sides, load, sides, store, take};
use crate::solid::Constants;

/// Brings the stress of each element back to its yield surface; returns the plastic work [J].
///
/// The work of an element is the energy that the return takes off its deviator: half of trial and
/// returned stress times the strain.
#[multiversion(targets("x86_64+avx2"))]
pub(crate) fn flow(elements: &mut Elements, constants: &Constants) -> f64 {
    let count = elements.x.len();
    let mut pass = Flow {
        constants,
        face_xx: sides(&mut elements.face_xx, count),
        face_yy: sides(&mut elements.face_yy, count),
        face_xy: sides(&mut elements.face_xy, count),
        plastic_strain: &mut elements.plastic_strain[..count],
        sxx: &mut elements.sxx[..count],
        syy: &mut elements.syy[..count],
        sxy: &mut elements.sxy[..count],
        szz: &mut elements.szz[..count],
        mean: &mut elements.mean[..count],
        kept: &mut elements.kept[..count],
        shifted: &mut elements.shifted[..count],
        level: &mut elements.level[..count],
    };
    let mut work = Four::ZERO;
    for at in (0..count).step_by(LANES) {
        work += pass.block(at);
    }
    work.sum() * constants.volume
}

struct Flow<'a> {
    constants: &'a Constants,
    face_xx: Sides<'a>,
    face_yy: Sides<'a>,
    face_xy: Sides<'a>,
    plastic_strain: &'a mut [f64],
    sxx: &'a mut [f64],
    syy: &'a mut [f64],
    sxy: &'a mut [f64],
    szz: &'a mut [f64],
    mean: &'a mut [f64],
    kept: &'a mut [f64],
    shifted: &'a mut [f64],
    level: &'a mut [f64],
}

impl Flow<'_> {
    /// Returns the work per volume [J/m3].
    #[inline(always)]
    fn block(&mut self, at: usize) -> Four {
        let constants = self.constants;
        let third = Four::splat(1.0 / 3.0);
        let sxx = third * take(&mut self.face_xx, at);
        let syy = third * take(&mut self.face_yy, at);
        let sxy = third * take(&mut self.face_xy, at);
        let szz = load(self.szz, at);
        let mean = third * (sxx + syy + szz);
        let (dxx, dyy, dzz) = (sxx - mean, syy - mean, szz - mean);
        let twice_j2 = dxx * dxx + dyy * dyy + dzz * dzz + (sxy * sxy) * Four::splat(2.0);
        let plastic_strain = load(self.plastic_strain, at);
        let yields = Four::splat(constants.yield_stress)
            + Four::splat(constants.plastic_modulus) * plastic_strain;
        let excess = twice_j2 * Four::splat(1.5);
        store(self.mean, at, mean);
        if !excess.any_above(yields * yields) {
            self.store_stress(at, [sxx, syy, sxy, szz]);
            self.store_return(at, [Four::splat(1.0), Four::ZERO, excess.max(mean * mean)]);
            return Four::ZERO;
        }
        let elastic = 1.5 * constants.twice_shear;
        let equivalent = excess.sqrt();
        let over = (equivalent - yields).max(Four::ZERO);
        let strain = over * Four::splat(1.0 / (elastic + constants.plastic_modulus));
        let drop = Four::splat(elastic) * strain;
        // Where nothing yields the drop is zero, and the yield stress is no less than the stress.
        let lost = drop / equivalent.max(yields);
        let kept = Four::splat(1.0) - lost;
        let shifted = lost * mean;
        store(self.plastic_strain, at, plastic_strain + strain);
        let returned =
            [sxx * kept + shifted, syy * kept + shifted, sxy * kept, szz * kept + shifted];
        self.store_stress(at, returned);
        self.store_return(at, [kept, shifted, Four::splat(f64::INFINITY)]);
        (equivalent - drop * Four::splat(0.5)) * strain
    }

    #[inline(always)]
    fn store_stress(&mut self, at: usize, [sxx, syy, sxy, szz]: [Four; 4]) {
        store(self.sxx, at, sxx);
        store(self.syy, at, syy);
        store(self.sxy, at, sxy);
        store(self.szz, at, szz);
    }

    #[inline(always)]
    fn store_return(&mut self, at: usize, [kept, shifted, level]: [Four; 3]) {
        store(self.kept, at, kept);
        store(self.shifted, at, shifted);
        store(self.level, at, level);
    }
}
