//! What the scenes of rigid-plastic theory come to, in the units of the tables: lengths in 1 mm,
//! speeds in 100 m/s, pressures in 1 GPa.

use crate::run::{Row, at, number, rms, run, vector};

/// Landings over a node cell, in parts of its sides.
pub const LANDINGS: [[f64; 2]; 4] = [[0.11, 0.08], [0.32, 0.7], [0.54, 0.31], [0.76, 0.93]];

/// The change that moves `body` to a place of the cell of a lattice of `pitch` [mm].
pub fn landing(body: &str, pitch: f64, [x, y]: [f64; 2]) -> String {
    let (x, y) = (x * pitch * 0.75f64.sqrt(), y * pitch);
    format!("bodies.{body}.position.at=(\"{x} mm\", \"{y} mm\")")
}

/// The end of one run.
pub struct End {
    /// H times the volume that the body paid for, over its energy at the start.
    pub wear: f64,
    /// Depth of the deepest node.
    pub deepest: f64,
    /// Height of the centre of mass.
    pub height: f64,
    pub velocity: [f64; 3],
    pub spin: [f64; 3],
    /// What is left of the energy lost after wear and friction, over that at the start.
    pub unpaid: f64,
}

/// Runs a scene of `body` on `plate` under the given changes.
pub fn land(scene: &str, body: &str, sets: &[String]) -> End {
    let mut sets = sets.to_vec();
    sets.push("outputs=[Energy]".into());
    let summary = run(&format!("theory/{scene}.ron"), &sets);
    let plate = |key: &str| at(&summary, &format!("surfaces.plate.{key}"));
    let energy = |key: &str| at(&summary, &format!("energy.{key}_J"));
    let start = energy("initial");
    let paid = 1e9 * (plate("wear_volume_m3") - plate("chip_volume_m3"));
    let vector = |key: &str| vector(&summary, &format!("bodies.{body}.{key}"));
    End {
        wear: paid / start,
        deepest: 1e3 * plate("max_depth_m"),
        height: 1e3 * vector("position_m")[2],
        velocity: vector("velocity_m_s").map(|v| 1e-2 * v),
        spin: vector("spin_rad_s").map(|w| 1e-5 * w),
        unpaid: (start - energy("kinetic") - energy("friction") - paid).abs() / start,
    }
}

/// Rms over `ends` of the errors of W, v and omega against a row, in the components that are named.
pub fn errors(ends: &[End], row: &Row, velocity: [&str; 3], spin: [&str; 3]) -> [f64; 3] {
    let distance = |got: [f64; 3], names: [&str; 3]| {
        let named = got.iter().zip(names).filter(|(_, name)| !name.is_empty());
        named.map(|(got, name)| (got - number(row, name)).powi(2)).sum::<f64>().sqrt()
    };
    let wear = if row.contains_key("W_over_E0") { "W_over_E0" } else { "WH_over_E0" };
    let over = |error: &dyn Fn(&End) -> f64| rms(&ends.iter().map(error).collect::<Vec<_>>());
    [
        over(&|end| end.wear - number(row, wear)),
        over(&|end| distance(end.velocity, velocity)),
        over(&|end| distance(end.spin, spin)),
    ]
}

/// Largest part of the energy that was lost and not paid for.
pub fn unpaid(ends: &[End]) -> f64 {
    ends.iter().map(|end| end.unpaid).fold(0.0, f64::max)
}

/// True if no error is above its limit.
pub fn holds(errors: [f64; 3], limits: [f64; 3]) -> bool {
    errors.iter().zip(limits).all(|(error, limit)| *error <= limit)
}
