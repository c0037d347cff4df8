//! Elastic trial of a step: mean stress of the elements, then normal and tangential stress of the pairs.

use wide::f64x4;

use crate::elements::Elements;
use crate::lanes::{Ends, LANES, load, store};
use crate::pairs::Pairs;
use crate::solid::Constants;

/// Increment of each element's mean stress, in closed form: c_N times the strain of its linked faces and
/// what parted faces released. In plane strain sigma_zz takes A times it.
pub(crate) fn mean_stress(elements: &mut Elements, constants: &Constants) {
    let coupling = f64x4::splat(constants.coupling);
    let [begun, ended] = &mut elements.strain;
    for at in (0..elements.x.len()).step_by(LANES) {
        let strain = load(begun, at) + load(ended, at) + load(&elements.released, at);
        let mean = load(&elements.response, at) * strain;
        store(&mut elements.mean_step, at, mean);
        let sum = load(&elements.mean_sum, at) + mean;
        store(&mut elements.mean_sum, at, sum);
        let szz = load(&elements.szz, at) + coupling * mean;
        store(&mut elements.szz, at, szz);
        for column in [&mut *begun, &mut *ended, &mut elements.released] {
            store(column, at, f64x4::ZERO);
        }
    }
}

/// Trial stresses of all pairs (the paper's Eq. 8, in increments); sums what makes the stress of the
/// elements (its Eq. 7).
pub(crate) fn trial(elements: &mut Elements, pairs: &mut Pairs, constants: &Constants) {
    for block in 0..pairs.runs.len() {
        let run = pairs.runs[block];
        trial_block(elements, pairs, constants, (block * LANES, run));
    }
    for at in (pairs.runs.len() * LANES..pairs.len()).step_by(LANES) {
        let loose = pairs.loose_block(at);
        trial_block(elements, pairs, constants, (at, loose));
    }
}

/// A pair needs one normal and one tangential stress: of equal materials both sides keep the same mean.
#[inline(always)]
fn trial_block(
    elements: &mut Elements,
    pairs: &mut Pairs,
    constants: &Constants,
    (at, ends): (usize, impl Ends),
) {
    let live = load(&pairs.live, at);
    let stiff = live * f64x4::splat(constants.twice_shear);
    let half_coupling = live * f64x4::splat(0.5 * constants.coupling);
    let [mean_i, mean_j] = ends.get(&elements.mean_step);
    let normal = load(&pairs.normal, at)
        + stiff * load(&pairs.stretch, at)
        + half_coupling * (mean_i + mean_j);
    let tangential = load(&pairs.tangential, at) + stiff * load(&pairs.shear, at);
    store(&mut pairs.normal, at, normal);
    store(&mut pairs.tangential, at, tangential);
    let (nx, ny) = (load(&pairs.nx, at), load(&pairs.ny, at));
    let (nxx, nyy, nxy) = (nx * nx, ny * ny, nx * ny);
    let across = tangential * nxy;
    let xx = normal * nxx - across;
    let yy = normal * nyy + across;
    let xy = normal * nxy + tangential * (nxx - nyy) * f64x4::splat(0.5);
    ends.add(&mut elements.face_xx, [xx, xx]);
    ends.add(&mut elements.face_yy, [yy, yy]);
    ends.add(&mut elements.face_xy, [xy, xy]);
}
