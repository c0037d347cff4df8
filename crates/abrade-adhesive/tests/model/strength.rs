//! When links fail: the paper's Eqs. 11 and 12 in plane strain.

use abrade_adhesive::{Simulation, Solid};

use crate::lattice::{QUIET, assert_near, block, centre, elastic, lead};

/// Stress of the centre element when its first link fails; no other may [Pa]. Strain grows along `strain`.
fn at_failure(young: f64, ratio: f64, strain: [[f64; 2]; 2], steps: usize) -> [f64; 4] {
    let solid = Solid { young, shear_strength: 4.5e6, strength_ratio: ratio, ..elastic() };
    let mut assembly = block(12, 12);
    let middle = centre(&assembly) as u32;
    for link in &mut assembly.links {
        link.can_break = link.ends.contains(&middle);
    }
    let step = Simulation::new(&solid, &assembly, QUIET).unwrap().step_length();
    lead(&mut assembly, strain.map(|row| row.map(|e| e / (steps as f64 * step))));
    let mut simulation = Simulation::new(&solid, &assembly, QUIET).unwrap();
    for _ in 0..steps {
        let stress = simulation.stress(middle as usize);
        simulation.step().unwrap();
        if simulation.pairs().any(|pair| pair.breaks > 0) {
            return stress;
        }
    }
    panic!("nothing failed")
}

/// Fails for a mean stress of the wrong sign, a strength that forgets the ratio, or a criterion without
/// the stress along the face.
#[test]
fn links_fail_at_the_strengths_of_the_criterion() {
    let (soft, stiff) = (1e9, 1e11);
    for (young, ratio, tension, compression) in [
        (soft, 1.0, 8.769e6, 8.769e6),
        (soft, 1.7, 6.358e6, 14.126e6),
        (stiff, 1.0, 8.769e6, 8.769e6),
        (stiff, 1.7, 6.358e6, 14.126e6),
        // The soft solid would be strained by 6 %, which turns the faces.
        (stiff, 4.0, 4.671e6, 71.6e6),
    ] {
        // Free sides: strain across is -nu / (1 - nu) of that along.
        let pull = |stress: f64| {
            let strain = 1.2 * stress * (1.0 - 0.09) / young;
            at_failure(young, ratio, [[-0.3 / 0.7 * strain, 0.0], [0.0, strain]], 1500)
        };
        assert_near(pull(tension)[1], tension, 0.01);
        assert_near(-pull(-compression)[1], compression, 0.01);
        let strain = 1.2 * 4.5e6 * 1.3 / young;
        let shear = at_failure(young, ratio, [[0.0, strain], [strain, 0.0]], 1500);
        assert_near(shear[2], 4.5e6, 0.01);
    }
}
