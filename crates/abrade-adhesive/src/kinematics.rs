//! How far each pair moved in a step: along its line and across it, in the frame that turns with it.

use multiversion::multiversion;

use crate::elements::Elements;
use crate::four::Four;
use crate::lanes::{BlockPass, Ends, Sides, load, sides, store};
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
    let (count, length) = (elements.x.len(), pairs.nx.len());
    pairs.ends.sweep(&mut Stretch {
        x: &elements.x[..count],
        y: &elements.y[..count],
        spin: &elements.spin[..count],
        strain: sides(&mut elements.strain, count),
        image: &pairs.image[..length],
        live: &pairs.live[..length],
        nx: &mut pairs.nx[..length],
        ny: &mut pairs.ny[..length],
        distance: &mut pairs.distance[..length],
        stretch: &mut pairs.stretch[..length],
        shear: &mut pairs.shear[..length],
        per_diameter: Four::splat(1.0 / constants.diameter),
        half_step: Four::splat(0.5 * step),
    });
}

struct Stretch<'a> {
    x: &'a [f64],
    y: &'a [f64],
    spin: &'a [f64],
    strain: Sides<'a>,
    image: &'a [f64],
    live: &'a [f64],
    nx: &'a mut [f64],
    ny: &'a mut [f64],
    distance: &'a mut [f64],
    stretch: &'a mut [f64],
    shear: &'a mut [f64],
    per_diameter: Four,
    half_step: Four,
}

impl BlockPass for Stretch<'_> {
    /// Normal strain dr / d; shear: the turn of the pair less the mean turn of its ends, which is the
    /// tensor shear t.eps.n of a material whose elements turn with it.
    #[inline(always)]
    fn block<E: Ends>(&mut self, at: usize, ends: E) {
        let ([xi, xj], [yi, yj]) = (ends.get(self.x), ends.get(self.y));
        let [spin_i, spin_j] = ends.get(self.spin);
        let dx = xj - xi + load(self.image, at);
        let dy = yj - yi;
        let distance = (dx * dx + dy * dy).sqrt();
        let inverse = Four::splat(1.0) / distance;
        let (nx, ny) = (dx * inverse, dy * inverse);
        let strain = (distance - load(self.distance, at)) * self.per_diameter;
        let turn = load(self.nx, at) * ny - load(self.ny, at) * nx;
        let shear = turn - (spin_i + spin_j) * self.half_step;
        let linked = strain * load(self.live, at);
        store(self.nx, at, nx);
        store(self.ny, at, ny);
        store(self.distance, at, distance);
        store(self.stretch, at, strain);
        store(self.shear, at, shear);
        ends.add(&mut self.strain, [linked, linked]);
    }
}
