//! The rows a kilometre from the world's origin, where `f32` tells places 0.06 mm apart.

use crate::plugin::Resolve;
use crate::plugin::rapier::prelude::Real;
use nalgebra::Vector3;

use super::rig::Case;
use super::table::ROWS;

/// Step [s].
const STEP: f64 = 1.0 / 240.0;
/// Change of W by the place [-].
const CHANGE: f64 = 1e-3;
/// Rows whose bodies are held by what Rapier knows of their places, with what a kilometre changes in
/// `f32` at most [-]: a tip that a motor draws, and a stack.
const HELD: [(&str, f64); 2] = [("motor-driven scratch", 0.2), ("struck stack", 0.02)];

/// Fails for wear that depends on where in the world it happens. Prints W of every row at the origin, to
/// be held beside that of the other precision, and what a kilometre changes.
#[test]
fn rows_a_kilometre_away() {
    let is_single = size_of::<Real>() == size_of::<f32>();
    for row in &ROWS {
        let [here, far] = [0.0, 1000.0].map(|away| {
            let origin = Vector3::new(away, 0.0, 0.0);
            let case = Case { dt: STEP, origin, resolve: Resolve::Auto, accuracy: 1e-3 };
            (row.run)(case).volume
        });
        let change = far / here - 1.0;
        println!("{}: W {here:.6e} mm3, a kilometre away {:+.3} %", row.name, 100.0 * change);
        let held = HELD.iter().find(|(name, _)| is_single && *name == row.name);
        let limit = held.map_or(CHANGE, |(_, limit)| *limit);
        assert!(change.abs() <= limit, "{}: {change:e}", row.name);
    }
}
