//! Pairs follow the plastic return of their ends; which links fail then, and which faces may meet.

use multiversion::multiversion;

use crate::elements::Elements;
use crate::four::{Four, LANES};
use crate::lanes::{BlockPass, Ends, load, store};
use crate::pairs::Pairs;
use crate::solid::Constants;

/// Blocks with a pair that may change: the first pair, and a bit for each whose link fails.
pub(crate) type Due = Vec<(u32, u32)>;

/// Returns the stresses of all pairs, and notes in `due` which may change.
#[multiversion(targets("x86_64+avx2"))]
pub(crate) fn follow(elements: &Elements, pairs: &mut Pairs, constants: &Constants, due: &mut Due) {
    due.clear();
    let (count, length) = (elements.x.len(), pairs.nx.len());
    pairs.ends.sweep(&mut Follow {
        kept: &elements.kept[..count],
        shifted: &elements.shifted[..count],
        sxx: &elements.sxx[..count],
        syy: &elements.syy[..count],
        sxy: &elements.sxy[..count],
        szz: &elements.szz[..count],
        live: &pairs.live[..length],
        strength: &pairs.strength[..length],
        nx: &pairs.nx[..length],
        ny: &pairs.ny[..length],
        normal: &mut pairs.normal[..length],
        tangential: &mut pairs.tangential[..length],
        strength_mean: Four::splat(constants.strength_mean),
        strength_shear: Four::splat(constants.strength_shear * constants.strength_shear),
        due,
    });
}

struct Follow<'a> {
    kept: &'a [f64],
    shifted: &'a [f64],
    sxx: &'a [f64],
    syy: &'a [f64],
    sxy: &'a [f64],
    szz: &'a [f64],
    live: &'a [f64],
    strength: &'a [f64],
    nx: &'a [f64],
    ny: &'a [f64],
    normal: &'a mut [f64],
    tangential: &'a mut [f64],
    strength_mean: Four,
    strength_shear: Four,
    due: &'a mut Due,
}

impl BlockPass for Follow<'_> {
    /// Both ends' returns, averaged.
    #[inline(always)]
    fn block<E: Ends>(&mut self, at: usize, ends: E) {
        let (half, one) = (Four::splat(0.5), Four::splat(1.0));
        let live = load(self.live, at);
        let [kept_i, kept_j] = ends.get(self.kept);
        let [shifted_i, shifted_j] = ends.get(self.shifted);
        let lost = live * (one - half * (kept_i + kept_j));
        let normal = load(self.normal, at);
        let normal = normal - lost * normal + live * half * (shifted_i + shifted_j);
        let tangential = load(self.tangential, at);
        let tangential = tangential - lost * tangential;
        store(self.normal, at, normal);
        store(self.tangential, at, tangential);
        let fails = self.fails(at, ends, [normal, tangential]);
        if fails != 0 || live != one {
            self.due.push((at as u32, fails));
        }
    }
}

impl Follow<'_> {
    /// Drucker and Prager's criterion (the paper's Eq. 11) on the stress at the face: normal and tangential
    /// stress of the pair, the others as the mean of its ends. Squared, so that no root is drawn.
    #[inline(always)]
    fn fails<E: Ends>(&self, at: usize, ends: E, [normal, tangential]: [Four; 2]) -> u32 {
        let half = Four::splat(0.5);
        let (sxx, syy, sxy, szz) =
            (ends.mean(self.sxx), ends.mean(self.syy), ends.mean(self.sxy), ends.mean(self.szz));
        let (nx, ny) = (load(self.nx, at), load(self.ny, at));
        let along = sxx * (ny * ny) + syy * (nx * nx) - (sxy * (nx * ny)) * Four::splat(2.0);
        let mean = (normal + along + szz) * Four::splat(1.0 / 3.0);
        let (a, b, c) = (normal - along, along - szz, szz - normal);
        let three = Four::splat(3.0);
        let square = half * (a * a + b * b + c * c) + three * (tangential * tangential);
        let left = load(self.strength, at) - self.strength_mean * mean;
        let left = left.max(Four::ZERO);
        (left * left).up_to(self.strength_shear * square)
    }
}

/// Changes the pairs that are `due`; returns the energy that was released [J].
pub(crate) fn change(
    elements: &mut Elements,
    pairs: &mut Pairs,
    constants: &Constants,
    due: &Due,
) -> f64 {
    let mut released = 0.0;
    for (first, fails) in due {
        for lane in 0..LANES {
            let at = *first as usize + lane;
            let does_fail = fails & (1 << lane) != 0;
            released += crate::faces::change(elements, pairs, constants, at, does_fail);
        }
    }
    released
}
