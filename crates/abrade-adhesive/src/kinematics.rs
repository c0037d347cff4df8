//! How far each pair moved in a step: along its line and across it, in the frame that turns with it.

use multiversion::multiversion;

use crate::block::Block;
use crate::elements::Elements;
use crate::four::Four;
use crate::lanes::{BlockPass, Ends, Sides, sides};
use crate::pairs::Pairs;
use crate::solid::Constants;

/// Distances, directions and strains of all pairs; sums the strain of the linked faces of each element.
#[multiversion(targets("x86_64+avx2"))]
pub(crate) fn stretch(
    elements: &mut Elements,
    pairs: &mut Pairs,
    constants: &Constants,
    step: f64,
) {
    let count = elements.x.len();
    pairs.ends.sweep(
        &mut pairs.blocks,
        &mut Stretch {
            x: &elements.x[..count],
            y: &elements.y[..count],
            spin: &elements.spin[..count],
            strain: sides(&mut elements.strain, count),
            per_diameter: Four::splat(1.0 / constants.diameter),
            half_step: Four::splat(0.5 * step),
        },
    );
}

struct Stretch<'a> {
    x: &'a [f64],
    y: &'a [f64],
    spin: &'a [f64],
    strain: Sides<'a>,
    per_diameter: Four,
    half_step: Four,
}

impl BlockPass for Stretch<'_> {
    /// Normal strain dr / d; shear: the turn of the pair less the mean turn of its ends, which is the
    /// tensor shear t.eps.n of a material whose elements turn with it.
    #[inline(always)]
    fn block<E: Ends>(&mut self, _: usize, block: &mut Block, ends: E) {
        let ([xi, xj], [yi, yj]) = (ends.get(self.x), ends.get(self.y));
        let (dx, dy) = (xj - xi + block.image, yj - yi);
        let distance = (dx * dx + dy * dy).sqrt();
        let inverse = Four::splat(1.0) / distance;
        let (nx, ny) = (dx * inverse, dy * inverse);
        let strain = (distance - block.distance) * self.per_diameter;
        let turn = block.nx * ny - block.ny * nx;
        let shear = turn - ends.sum(self.spin) * self.half_step;
        let linked = strain * block.live;
        *block = Block { nx, ny, distance, stretch: strain, shear, ..*block };
        ends.add(&mut self.strain, [linked, linked]);
    }
}
