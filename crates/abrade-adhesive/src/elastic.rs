//! Elastic trial of a step: mean stress of the elements, then normal and tangential stress of the pairs.

use multiversion::multiversion;

use crate::block::Block;
use crate::elements::Elements;
use crate::four::{Four, LANES};
use crate::lanes::{BlockPass, Ends, Sides, load, sides, store};
use crate::pairs::Pairs;
use crate::solid::Constants;

/// Increment of each element's mean stress, in closed form: c_N times the strain of its linked faces and
/// what parted faces released. In plane strain sigma_zz takes A times it.
#[multiversion(targets("x86_64+avx2"))]
pub(crate) fn mean_stress(elements: &mut Elements, constants: &Constants) {
    let count = elements.x.len();
    let coupling = Four::splat(constants.coupling);
    let [begun, ended] = sides(&mut elements.strain, count);
    let released = &mut elements.released[..count];
    let response = &elements.response[..count];
    let mean_step = &mut elements.mean_step[..count];
    let mean_sum = &mut elements.mean_sum[..count];
    let szz = &mut elements.szz[..count];
    for at in (0..count).step_by(LANES) {
        let strain = load(begun, at) + load(ended, at) + load(released, at);
        let mean = load(response, at) * strain;
        store(mean_step, at, mean);
        let sum = load(mean_sum, at) + mean;
        store(mean_sum, at, sum);
        let along = load(szz, at) + coupling * mean;
        store(szz, at, along);
        store(begun, at, Four::ZERO);
        store(ended, at, Four::ZERO);
        store(released, at, Four::ZERO);
    }
}

/// Trial stresses of all pairs (the paper's Eq. 8, in increments); sums what makes the stress of the
/// elements (its Eq. 7).
#[multiversion(targets("x86_64+avx2"))]
pub(crate) fn trial(elements: &mut Elements, pairs: &mut Pairs, constants: &Constants) {
    let count = elements.x.len();
    pairs.ends.sweep(
        &mut pairs.blocks,
        &mut Trial {
            mean_step: &elements.mean_step[..count],
            face_xx: sides(&mut elements.face_xx, count),
            face_yy: sides(&mut elements.face_yy, count),
            face_xy: sides(&mut elements.face_xy, count),
            twice_shear: Four::splat(constants.twice_shear),
            half_coupling: Four::splat(0.5 * constants.coupling),
        },
    );
}

struct Trial<'a> {
    mean_step: &'a [f64],
    face_xx: Sides<'a>,
    face_yy: Sides<'a>,
    face_xy: Sides<'a>,
    twice_shear: Four,
    half_coupling: Four,
}

impl BlockPass for Trial<'_> {
    /// A pair needs one normal and one tangential stress: of equal materials both sides keep the same mean.
    #[inline(always)]
    fn block<E: Ends>(&mut self, _: usize, block: &mut Block, ends: E) {
        let stiff = block.live * self.twice_shear;
        let normal = block.normal
            + stiff * block.stretch
            + block.live * self.half_coupling * ends.sum(self.mean_step);
        let tangential = block.tangential + stiff * block.shear;
        (block.normal, block.tangential) = (normal, tangential);
        let (nx, ny) = (block.nx, block.ny);
        let (nxx, nyy, nxy) = (nx * nx, ny * ny, nx * ny);
        let across = tangential * nxy;
        let xx = normal * nxx - across;
        let yy = normal * nyy + across;
        let xy = normal * nxy + tangential * (nxx - nyy) * Four::splat(0.5);
        ends.add(&mut self.face_xx, [xx, xx]);
        ends.add(&mut self.face_yy, [yy, yy]);
        ends.add(&mut self.face_xy, [xy, xy]);
    }
}
