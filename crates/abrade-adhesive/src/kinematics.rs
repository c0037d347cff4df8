//! How far each pair moved in a step: along its line and across it, in the frame that turns with it.

use wide::f64x4;

use crate::elements::Elements;
use crate::lanes::{Ends, LANES, load, store};
use crate::pairs::Pairs;
use crate::solid::Constants;

/// Distances, directions and strains of all pairs; sums the strain of the linked faces of each element.
pub(crate) fn stretch(
    elements: &mut Elements,
    pairs: &mut Pairs,
    constants: &Constants,
    step: f64,
) {
    for block in 0..pairs.runs.len() {
        let run = pairs.runs[block];
        stretch_block(elements, pairs, constants, step, (block * LANES, run));
    }
    for at in (pairs.runs.len() * LANES..pairs.len()).step_by(LANES) {
        let loose = pairs.loose_block(at);
        stretch_block(elements, pairs, constants, step, (at, loose));
    }
}

/// Normal strain dr / d; shear: the turn of the pair less the mean turn of its ends, which is the tensor
/// shear t.eps.n of a material whose elements turn with it.
#[inline(always)]
fn stretch_block(
    elements: &mut Elements,
    pairs: &mut Pairs,
    constants: &Constants,
    step: f64,
    (at, ends): (usize, impl Ends),
) {
    let ([xi, xj], [yi, yj]) = (ends.get(&elements.x), ends.get(&elements.y));
    let [spin_i, spin_j] = ends.get(&elements.spin);
    let dx = xj - xi + load(&pairs.image, at);
    let dy = yj - yi;
    let distance = (dx * dx + dy * dy).sqrt();
    let inverse = f64x4::splat(1.0) / distance;
    let (nx, ny) = (dx * inverse, dy * inverse);
    let strain = (distance - load(&pairs.distance, at)) * f64x4::splat(1.0 / constants.diameter);
    let turn = load(&pairs.nx, at) * ny - load(&pairs.ny, at) * nx;
    let shear = turn - (spin_i + spin_j) * f64x4::splat(0.5 * step);
    let linked = strain * load(&pairs.live, at);
    store(&mut pairs.nx, at, nx);
    store(&mut pairs.ny, at, ny);
    store(&mut pairs.distance, at, distance);
    store(&mut pairs.stretch, at, strain);
    store(&mut pairs.shear, at, shear);
    ends.add(&mut elements.strain, [linked, linked]);
}
