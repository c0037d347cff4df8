//! Blocks of a regular lattice, and what is led through them.

use abrade_adhesive::{Assembly, Element, Hold, Numerics, Simulation, Solid};

/// Diameter of the elements [m].
pub const D: f64 = 25e-6;

/// Numbers of the dashpots off, step small.
pub const QUIET: Numerics = Numerics { courant: 0.2, viscosity: 0.0 };

/// A solid that neither flows nor breaks.
pub fn elastic() -> Solid {
    Solid { yield_stress: 1e15, shear_strength: 1e15, hardening: 0.0, ..Solid::default() }
}

/// Rows of a close-packed lattice about the origin, linked.
pub fn block(columns: usize, rows: usize) -> Assembly {
    let height = 3f64.sqrt() / 2.0;
    let element = |at: usize| {
        let (row, column) = (at / columns, at % columns);
        let x = column as f64 + 0.5 * (row % 2) as f64 - 0.5 * (columns as f64 - 0.5);
        let y = height * (row as f64 - 0.5 * (rows - 1) as f64);
        Element { position: [x * D, y * D], ..Element::default() }
    };
    let elements = (0..rows * columns).map(element).collect();
    let mut assembly = Assembly { diameter: D, period: None, elements, links: Vec::new() };
    assembly.link_within(1.01, |_, _| true);
    assembly
}

/// All elements led by the velocity gradient `rate` [1/s]: rows of the matrix.
pub fn lead(assembly: &mut Assembly, rate: [[f64; 2]; 2]) {
    for element in &mut assembly.elements {
        let [x, y] = element.position;
        element.velocity = rate.map(|row| row[0] * x + row[1] * y);
        element.hold = Hold::ALL;
    }
}

/// The stress of the element nearest to the origin after the strain `strain`, all elements led [Pa].
pub fn led_stress(solid: &Solid, strain: [[f64; 2]; 2], steps: usize) -> [f64; 4] {
    let mut assembly = block(12, 12);
    let step = Simulation::new(solid, &assembly, QUIET).unwrap().step_length();
    let rate = strain.map(|row| row.map(|e| e / (steps as f64 * step)));
    lead(&mut assembly, rate);
    let mut simulation = Simulation::new(solid, &assembly, QUIET).unwrap();
    (0..steps).for_each(|_| simulation.step().unwrap());
    simulation.stress(centre(&assembly))
}

/// The element nearest to the origin.
pub fn centre(assembly: &Assembly) -> usize {
    let square = |at: &usize| {
        let [x, y] = assembly.elements[*at].position;
        x * x + y * y
    };
    (0..assembly.elements.len()).min_by(|a, b| square(a).total_cmp(&square(b))).unwrap()
}

/// A block pressed between its first and last row, which slide along x, at the rate `rate` [1/s] until
/// the strain `strain`: mean stress of the inner part [Pa], mean strains xx and yy there, mean equivalent
/// plastic strain.
pub fn pressed(solid: &Solid, rate: f64, strain: f64, lateral: f64) -> ([f64; 4], [f64; 2], f64) {
    let (columns, rows) = (20, 24);
    let mut assembly = block(columns, rows);
    for (at, element) in assembly.elements.iter_mut().enumerate() {
        let [x, y] = element.position;
        element.velocity = [-lateral * rate * x, rate * y];
        let is_end = at < columns || at >= (rows - 1) * columns;
        element.hold = Hold { x: false, y: is_end, spin: false };
    }
    let mut simulation = Simulation::new(solid, &assembly, Numerics::default()).unwrap();
    while simulation.time() * rate.abs() < strain {
        simulation.step().unwrap();
    }
    let inner: Vec<usize> = (0..rows * columns)
        .filter(|at| (8..16).contains(&(at / columns)) && (6..14).contains(&(at % columns)))
        .collect();
    let mean = |of: &dyn Fn(usize) -> f64| {
        inner.iter().map(|at| of(*at)).sum::<f64>() / inner.len() as f64
    };
    let stress = [0, 1, 2, 3].map(|k| mean(&|at| simulation.stress(at)[k]));
    // Slope of displacement against place, over the inner part.
    let slope = |axis: usize| {
        let place = |at: usize| assembly.elements[at].position[axis];
        let moved = |at: usize| simulation.position(at)[axis] - place(at);
        let (m, u) = (mean(&place), mean(&moved));
        mean(&|at| (place(at) - m) * (moved(at) - u)) / mean(&|at| (place(at) - m).powi(2))
    };
    (stress, [slope(0), slope(1)], mean(&|at| simulation.plastic_strain(at)))
}

/// Asserts that `found` is `expected` to a share `tolerance`.
#[track_caller]
pub fn assert_near(found: f64, expected: f64, tolerance: f64) {
    let error = (found / expected - 1.0).abs();
    assert!(error <= tolerance, "{found:e} for {expected:e}: off by {error:e}");
}
