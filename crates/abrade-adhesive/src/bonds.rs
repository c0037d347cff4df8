//! The second half of a pair's step: it follows the return of its ends, its link may fail, and it acts.

use wide::f64x4;

use crate::elements::Elements;
use crate::faces;
use crate::lanes::{Ends, LANES, load, store};
use crate::pairs::Pairs;
use crate::solid::Constants;

/// What a pass took from pairs [J].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Losses {
    pub(crate) viscous: f64,
    pub(crate) released: f64,
}

/// What the pass needs beside the columns.
#[derive(Clone, Copy)]
pub(crate) struct Acting<'a> {
    pub(crate) constants: &'a Constants,
    /// Stress of a dashpot per strain of a step, 2 G tau_v / dt [Pa].
    pub(crate) viscosity: f64,
}

/// Returned stresses, failures and meetings, forces and torques of all pairs.
pub(crate) fn act(elements: &mut Elements, pairs: &mut Pairs, acting: Acting) -> Losses {
    let mut losses = Losses::default();
    let mut square = f64x4::ZERO;
    for block in 0..pairs.runs.len() {
        let run = pairs.runs[block];
        let at = block * LANES;
        correct_block(elements, pairs, acting.constants, (at, run), &mut losses);
        square += force_block(elements, pairs, acting, (at, run));
    }
    for at in (pairs.runs.len() * LANES..pairs.len()).step_by(LANES) {
        let loose = pairs.loose_block(at);
        correct_block(elements, pairs, acting.constants, (at, loose), &mut losses);
        square += force_block(elements, pairs, acting, (at, loose));
    }
    let per_strain = acting.viscosity * acting.constants.face * acting.constants.diameter;
    losses.viscous = square.reduce_add() * per_strain;
    losses
}

/// Both ends' returns, averaged, then the failure of links and the meeting of parted faces.
#[inline(always)]
fn correct_block(
    elements: &mut Elements,
    pairs: &mut Pairs,
    constants: &Constants,
    (at, ends): (usize, impl Ends),
    losses: &mut Losses,
) {
    let half = f64x4::splat(0.5);
    let live = load(&pairs.live, at);
    let [kept_i, kept_j] = ends.get(&elements.kept);
    let [shifted_i, shifted_j] = ends.get(&elements.shifted);
    let lost = live * (f64x4::splat(1.0) - half * (kept_i + kept_j));
    let normal = load(&pairs.normal, at);
    let normal = normal - lost * normal + live * half * (shifted_i + shifted_j);
    let tangential = load(&pairs.tangential, at);
    let tangential = tangential - lost * tangential;
    store(&mut pairs.normal, at, normal);
    store(&mut pairs.tangential, at, tangential);
    let fails = fails(elements, pairs, constants, (at, ends), [normal, tangential]);
    let all_linked = live.simd_eq(f64x4::splat(1.0)).all();
    if fails.any() || !all_linked {
        let fails = fails.to_bitmask();
        for lane in 0..LANES {
            let does_fail = fails & (1 << lane) != 0;
            losses.released +=
                faces::change(elements, pairs, constants, (at + lane, ends.of(lane)), does_fail);
        }
    }
}

/// Drucker and Prager's criterion (the paper's Eq. 11) on the stress at the face: normal and tangential
/// stress of the pair, the others as the mean of its ends. Squared, so that no root is drawn.
#[inline(always)]
fn fails(
    elements: &Elements,
    pairs: &Pairs,
    constants: &Constants,
    (at, ends): (usize, impl Ends),
    [normal, tangential]: [f64x4; 2],
) -> f64x4 {
    let half = f64x4::splat(0.5);
    let both = |column: &[f64]| {
        let [i, j] = ends.get(column);
        half * (i + j)
    };
    let [sxx, syy, sxy] = [&elements.sxx, &elements.syy, &elements.sxy].map(|c| both(c));
    let szz = both(&elements.szz);
    let (nx, ny) = (load(&pairs.nx, at), load(&pairs.ny, at));
    let along = sxx * (ny * ny) + syy * (nx * nx) - (sxy * (nx * ny)) * f64x4::splat(2.0);
    let mean = (normal + along + szz) * f64x4::splat(1.0 / 3.0);
    let (a, b, c) = (normal - along, along - szz, szz - normal);
    let three = f64x4::splat(3.0);
    let square = half * (a * a + b * b + c * c) + three * (tangential * tangential);
    let shear = f64x4::splat(constants.strength_shear * constants.strength_shear) * square;
    let left = load(&pairs.strength, at) - f64x4::splat(constants.strength_mean) * mean;
    let left = left.fast_max(f64x4::ZERO);
    (left * left).simd_le(shear)
}

/// Forces and torques; returns the squares of the strains of dashpots.
#[inline(always)]
fn force_block(
    elements: &mut Elements,
    pairs: &Pairs,
    acting: Acting,
    (at, ends): (usize, impl Ends),
) -> f64x4 {
    let live = load(&pairs.live, at);
    let dashpot = live * f64x4::splat(acting.viscosity);
    let face = f64x4::splat(acting.constants.face);
    let (stretch, shear) = (load(&pairs.stretch, at), load(&pairs.shear, at));
    let normal = face * (load(&pairs.normal, at) + dashpot * stretch);
    let tangential = face * (load(&pairs.tangential, at) + dashpot * shear);
    let (nx, ny) = (load(&pairs.nx, at), load(&pairs.ny, at));
    let fx = normal * nx - tangential * ny;
    let fy = normal * ny + tangential * nx;
    let torque = f64x4::splat(0.5) * load(&pairs.distance, at) * tangential;
    ends.add(&mut elements.force_x, [fx, -fx]);
    ends.add(&mut elements.force_y, [fy, -fy]);
    ends.add(&mut elements.torque, [torque, torque]);
    live * (stretch * stretch + shear * shear)
}
