//! The paper's set-ups against independent solutions of the same equations.

use crate::rig::paper;
use crate::table::{number, read};

/// Fails for a wrong gate, geometry, spring, friction or inertia in the paper's law.
#[test]
fn paper_lattice_impacts_agree_with_the_reference() {
    let mut misses = Vec::new();
    for row in read("paper_lattice_impacts") {
        let at = [number(&row, "x_mm") * 1e-3, number(&row, "y_mm") * 1e-3];
        let got = paper(&row["case"], number(&row, "theta"), at).run();
        let (w, expected) = (got.surface.wear_volume() * 1e9, number(&row, "W_mm3"));
        let tolerance = (2e-3 * expected).max(2e-6);
        let fine = (w - expected).abs() <= tolerance
            && (got.restitution - number(&row, "COR")).abs() <= 5e-4
            && (got.rebound_angle - number(&row, "th_r_deg")).abs() <= 0.05;
        let line = format!(
            "{:8} {:>3} {:7} W {w:.7} / {expected:.7}  COR {:.6} / {}  angle {:.4} / {}  spin {:.1} / {}  steps {} nodes {}",
            row["case"],
            row["theta"],
            row["landing"],
            got.restitution,
            row["COR"],
            got.rebound_angle,
            row["th_r_deg"],
            got.body.state.spin.y,
            row["omega_y_rad_s"],
            got.advance.steps,
            got.advance.node_evaluations
        );
        println!("{line}");
        if !fine {
            misses.push(line);
        }
    }
    assert!(misses.is_empty(), "{}", misses.join("\n"));
}
