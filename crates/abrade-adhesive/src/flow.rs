//! Plastic flow of the elements: von Mises with linear hardening, by radial return (Wilkins).

use wide::f64x4;

use crate::elements::Elements;
use crate::lanes::{LANES, load, store};
use crate::solid::Constants;

/// Brings the stress of each element back to its yield surface; returns the plastic work [J].
///
/// The work of an element is the energy that the return takes off its deviator: half of trial and
/// returned stress times the strain.
pub(crate) fn flow(elements: &mut Elements, constants: &Constants) -> f64 {
    let mut work = f64x4::ZERO;
    for at in (0..elements.x.len()).step_by(LANES) {
        work += flow_block(elements, constants, at);
    }
    work.reduce_add() * constants.volume
}

/// Work per volume [J/m3] of a block.
#[inline(always)]
fn flow_block(elements: &mut Elements, constants: &Constants, at: usize) -> f64x4 {
    let third = f64x4::splat(1.0 / 3.0);
    let sxx = third * take(&mut elements.face_xx, at);
    let syy = third * take(&mut elements.face_yy, at);
    let sxy = third * take(&mut elements.face_xy, at);
    let szz = load(&elements.szz, at);
    let mean = third * (sxx + syy + szz);
    let (dxx, dyy, dzz) = (sxx - mean, syy - mean, szz - mean);
    let twice_j2 = dxx * dxx + dyy * dyy + dzz * dzz + (sxy * sxy) * f64x4::splat(2.0);
    let plastic_strain = load(&elements.plastic_strain, at);
    let yields = f64x4::splat(constants.yield_stress)
        + f64x4::splat(constants.plastic_modulus) * plastic_strain;
    let excess = twice_j2 * f64x4::splat(1.5);
    store(&mut elements.mean, at, mean);
    if !excess.simd_gt(yields * yields).any() {
        store_stress(elements, at, [sxx, syy, sxy, szz]);
        store(&mut elements.kept, at, f64x4::splat(1.0));
        store(&mut elements.shifted, at, f64x4::ZERO);
        return f64x4::ZERO;
    }
    let elastic = 1.5 * constants.twice_shear;
    let equivalent = excess.sqrt();
    let over = (equivalent - yields).fast_max(f64x4::ZERO);
    let strain = over * f64x4::splat(1.0 / (elastic + constants.plastic_modulus));
    let drop = f64x4::splat(elastic) * strain;
    // Where nothing yields the drop is zero, and the yield stress is no less than the stress.
    let lost = drop / equivalent.fast_max(yields);
    let kept = f64x4::splat(1.0) - lost;
    let shifted = lost * mean;
    store(&mut elements.plastic_strain, at, plastic_strain + strain);
    store(&mut elements.kept, at, kept);
    store(&mut elements.shifted, at, shifted);
    let returned = [sxx * kept + shifted, syy * kept + shifted, sxy * kept, szz * kept + shifted];
    store_stress(elements, at, returned);
    (equivalent - drop * f64x4::splat(0.5)) * strain
}

/// The sum over both sides, which begins anew.
#[inline(always)]
fn take(sum: &mut [Vec<f64>; 2], at: usize) -> f64x4 {
    let total = load(&sum[0], at) + load(&sum[1], at);
    store(&mut sum[0], at, f64x4::ZERO);
    store(&mut sum[1], at, f64x4::ZERO);
    total
}

#[inline(always)]
fn store_stress(elements: &mut Elements, at: usize, [sxx, syy, sxy, szz]: [f64x4; 4]) {
    store(&mut elements.sxx, at, sxx);
    store(&mut elements.syy, at, syy);
    store(&mut elements.sxy, at, sxy);
    store(&mut elements.szz, at, szz);
}
