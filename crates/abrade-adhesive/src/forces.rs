//! Forces and torques of the pairs.

use multiversion::multiversion;

use crate::elements::Elements;
use crate::four::Four;
use crate::lanes::{BlockPass, Ends, Sides, load, sides};
use crate::pairs::Pairs;
use crate::solid::Constants;

/// Sums the forces of all pairs; the dashpots of linked ones add `viscosity` [Pa] times the strain of the
/// step. Returns what the dashpots took [J].
#[multiversion(targets("x86_64+avx2"))]
pub(crate) fn act(
    elements: &mut Elements,
    pairs: &Pairs,
    constants: &Constants,
    viscosity: f64,
) -> f64 {
    let (count, length) = (elements.x.len(), pairs.nx.len());
    let mut pass = Act {
        force_x: sides(&mut elements.force_x, count),
        force_y: sides(&mut elements.force_y, count),
        torque: sides(&mut elements.torque, count),
        live: &pairs.live[..length],
        stretch: &pairs.stretch[..length],
        shear: &pairs.shear[..length],
        nx: &pairs.nx[..length],
        ny: &pairs.ny[..length],
        distance: &pairs.distance[..length],
        normal: &pairs.normal[..length],
        tangential: &pairs.tangential[..length],
        viscosity: Four::splat(viscosity),
        face: Four::splat(constants.face),
        square: Four::ZERO,
    };
    pairs.ends.sweep(&mut pass);
    pass.square.sum() * viscosity * constants.face * constants.diameter
}

struct Act<'a> {
    force_x: Sides<'a>,
    force_y: Sides<'a>,
    torque: Sides<'a>,
    live: &'a [f64],
    stretch: &'a [f64],
    shear: &'a [f64],
    nx: &'a [f64],
    ny: &'a [f64],
    distance: &'a [f64],
    normal: &'a [f64],
    tangential: &'a [f64],
    viscosity: Four,
    face: Four,
    /// Sum of the squares of the strains of dashpots.
    square: Four,
}

impl BlockPass for Act<'_> {
    #[inline(always)]
    fn block<E: Ends>(&mut self, at: usize, ends: E) {
        let live = load(self.live, at);
        let dashpot = live * self.viscosity;
        let (stretch, shear) = (load(self.stretch, at), load(self.shear, at));
        let normal = self.face * (load(self.normal, at) + dashpot * stretch);
        let tangential = self.face * (load(self.tangential, at) + dashpot * shear);
        let (nx, ny) = (load(self.nx, at), load(self.ny, at));
        let fx = normal * nx - tangential * ny;
        let fy = normal * ny + tangential * nx;
        let torque = Four::splat(0.5) * load(self.distance, at) * tangential;
        ends.add(&mut self.force_x, [fx, -fx]);
        ends.add(&mut self.force_y, [fy, -fy]);
        ends.add(&mut self.torque, [torque, torque]);
        self.square += live * (stretch * stretch + shear * shear);
    }
}
