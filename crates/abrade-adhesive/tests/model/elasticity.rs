//! Hooke's law in plane strain.

use abrade_adhesive::{Hold, Numerics, Simulation};

use crate::lattice::{D, assert_near, block, elastic, led_stress, pressed};

/// Fails for a mean stress that lags, one from another number of faces, or a factor in the stress tensor.
#[test]
fn an_affine_strain_gives_hookes_stress() {
    let [sxx, syy, sxy, szz] = led_stress(&elastic(), [[1e-4, 0.0], [0.0, 0.0]], 50);
    assert_near(sxx, 1.346154e5, 1e-3);
    assert_near(syy, 5.769231e4, 1e-3);
    assert_near(szz, 5.769231e4, 1e-3);
    assert!(sxy.abs() < 1e-3 * sxx, "{sxy}");
    let [sxx, _, sxy, _] = led_stress(&elastic(), [[0.0, 1e-4], [1e-4, 0.0]], 50);
    assert_near(sxy, 7.692308e4, 1e-3);
    assert!(sxx.abs() < 1e-3 * sxy, "{sxx}");
}

/// Fails for a shear strain that forgets the turn of the elements: a turned block would be strained.
#[test]
fn a_turn_leaves_no_stress() {
    let mut assembly = block(12, 12);
    let spin = 200.0;
    for element in &mut assembly.elements {
        let [x, y] = element.position;
        element.velocity = [-spin * y, spin * x];
    }
    // Elements at rest in themselves are taken along by their pairs.
    let mut simulation = Simulation::new(&elastic(), &assembly, Numerics::default()).unwrap();
    let quarter = 0.5 * std::f64::consts::PI / spin;
    while simulation.time() < quarter {
        simulation.step().unwrap();
    }
    let edge = simulation.position(11);
    let [x, y] = assembly.elements[11].position;
    assert!((edge[0] + y).abs() < 0.2 * D && (edge[1] - x).abs() < 0.2 * D, "{edge:?}");
    let spins: Vec<f64> = (0..144).map(|at| simulation.spin(at)).collect();
    let mean = spins.iter().sum::<f64>() / 144.0;
    assert_near(mean, spin, 0.02);
    let stress =
        (0..144).flat_map(|at| simulation.stress(at)).fold(0.0, |m: f64, s| m.max(s.abs()));
    // 2 G times the turn would be 1.2 GPa. What is left holds the corners on their way, of the order of
    // rho (spin r)^2 = 2000 (200 x 2e-4)^2 Pa = 3 Pa.
    assert!(stress < 10.0, "{stress:e}");
}

/// Fails for free faces that bear the mean stress of the element, which would be stiffer at the sides.
#[test]
fn a_pressed_block_with_free_sides_is_as_stiff_as_the_plate() {
    let (stress, [exx, eyy], _) = pressed(&elastic(), -20.0, 1e-3, 0.3 / 0.7);
    assert_near(stress[1] / eyy, 1e9 / (1.0 - 0.09), 0.01);
    assert_near(exx / eyy, -0.3 / 0.7, 0.01);
}

/// Fails for a period that pairs do not see.
#[test]
fn a_sheared_layer_has_the_shear_modulus() {
    let (columns, rows) = (20, 16);
    let mut assembly = block(columns, rows);
    assembly.links.clear();
    assembly.period = Some(columns as f64 * D);
    assembly.link_within(1.01, |_, _| true);
    assert_eq!(assembly.links.len(), columns * (3 * rows - 2), "a layer without ends");
    let rate = 20.0;
    for (at, element) in assembly.elements.iter_mut().enumerate() {
        element.velocity = [rate * element.position[1], 0.0];
        let is_end = at < columns || at >= (rows - 1) * columns;
        element.hold = Hold { x: is_end, y: is_end, spin: false };
    }
    let mut simulation = Simulation::new(&elastic(), &assembly, Numerics::default()).unwrap();
    while simulation.time() * rate < 1e-3 {
        simulation.step().unwrap();
    }
    // The first and last rows have free faces: what is measured is the part between.
    let row = |row: usize, of: &dyn Fn(usize) -> f64| {
        (row * columns..(row + 1) * columns).map(of).sum::<f64>() / columns as f64
    };
    let shift = |at: usize| simulation.position(at)[0] - assembly.elements[at].position[0];
    let height = 6.0 * 3f64.sqrt() / 2.0 * D;
    let strain = (row(11, &shift) - row(5, &shift)) / height;
    let stress = (5..12).map(|at| row(at, &|at| simulation.stress(at)[2])).sum::<f64>() / 7.0;
    assert_near(stress / strain, 1e9 / 2.6, 0.01);
}
