//! Plastic flow of the elements: von Mises with linear hardening, by radial return (Wilkins).

use multiversion::multiversion;

use crate::elements::Elements;
use crate::four::{Four, LANES};
use crate::lanes::{load, store};
use crate::solid::Constants;

/// Brings the stress of each element back to its yield surface; returns the plastic work [J].
///
/// The work of an element is the energy that the return takes off its deviator: half of trial and
/// returned stress times the strain.
#[multiversion(targets("x86_64+avx2"))]
pub(crate) fn flow(elements: &mut Elements, constants: &Constants) -> f64 {
    let mut work = Four::ZERO;
    for at in (0..elements.x.len()).step_by(LANES) {
        work += flow_block(elements, constants, at);
    }
    work.sum() * constants.volume
}

/// Work per volume [J/m3] of a block.
#[inline(always)]
fn flow_block(elements: &mut Elements, constants: &Constants, at: usize) -> Four {
    let third = Four::splat(1.0 / 3.0);
    let sxx = third * take(&mut elements.face_xx, at);
    let syy = third * take(&mut elements.face_yy, at);
    let sxy = third * take(&mut elements.face_xy, at);
    let szz = load(&elements.szz, at);
    let mean = third * (sxx + syy + szz);
    let (dxx, dyy, dzz) = (sxx - mean, syy - mean, szz - mean);
    let twice_j2 = dxx * dxx + dyy * dyy + dzz * dzz + (sxy * sxy) * Four::splat(2.0);
    let plastic_strain = load(&elements.plastic_strain, at);
    let yields = Four::splat(constants.yield_stress)
        + Four::splat(constants.plastic_modulus) * plastic_strain;
    let excess = twice_j2 * Four::splat(1.5);
    store(&mut elements.mean, at, mean);
    if !excess.any_above(yields * yields) {
        store_stress(elements, at, [sxx, syy, sxy, szz]);
        store(&mut elements.kept, at, Four::splat(1.0));
        store(&mut elements.shifted, at, Four::ZERO);
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
    store(&mut elements.plastic_strain, at, plastic_strain + strain);
    store(&mut elements.kept, at, kept);
    store(&mut elements.shifted, at, shifted);
    let returned = [sxx * kept + shifted, syy * kept + shifted, sxy * kept, szz * kept + shifted];
    store_stress(elements, at, returned);
    (equivalent - drop * Four::splat(0.5)) * strain
}

/// The sum over both sides, which begins anew.
#[inline(always)]
fn take(sum: &mut [Vec<f64>; 2], at: usize) -> Four {
    let total = load(&sum[0], at) + load(&sum[1], at);
    store(&mut sum[0], at, Four::ZERO);
    store(&mut sum[1], at, Four::ZERO);
    total
}

#[inline(always)]
fn store_stress(elements: &mut Elements, at: usize, [sxx, syy, sxy, szz]: [Four; 4]) {
    store(&mut elements.sxx, at, sxx);
    store(&mut elements.syy, at, syy);
    store(&mut elements.sxy, at, sxy);
    store(&mut elements.szz, at, szz);
}
