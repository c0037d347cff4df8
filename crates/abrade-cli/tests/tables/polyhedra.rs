//! Cubes, octahedra and tetrahedra in given attitudes, 100 or 200 nodes per edge.

use crate::run::{Row, Verdict, number, table};
use crate::theory::{End, LANDINGS, errors, holds, land, landing, unpaid};

/// Limits of W, v and omega.
const FACES: [f64; 3] = [1e-3, 8e-3, 3e-2];
/// Those of tetrahedra, against a theory that keeps no memory of the crater.
const TETRAHEDRA: [f64; 3] = [1e-2, 3e-2, 0.1];

/// The four landings of a row, on nodes `pitch` apart [mm].
fn ends(kind: &str, row: &Row, quaternion: &str, pitch: f64) -> Vec<End> {
    // B = m v^2 / (H L^3)
    let (kind, volume) = match &kind[..4] {
        "cube" => ("Cube", 1.0),
        "octa" => ("Octahedron", 2f64.sqrt() / 3.0),
        _ => ("Tetrahedron", 1.0 / 72f64.sqrt()),
    };
    let components: Vec<_> = quaternion.split_whitespace().collect();
    let run = |place| {
        let sets = [
            format!("bodies.grit.shape.kind={kind}"),
            format!("bodies.grit.density={}", 1e5 * number(row, "B") / volume),
            format!("bodies.grit.motion.angle={} deg", number(row, "alpha")),
            format!("bodies.grit.rotation.xyzw=({})", components.join(", ")),
            format!("surfaces.plate.geometry.pitch={pitch} mm"),
            landing("grit", pitch, place),
        ];
        land("polyhedron_generic", "grit", &sets)
    };
    LANDINGS.into_iter().map(run).collect()
}

fn judge(verdict: &mut Verdict, name: &str, target: &Row, limits: [f64; 3], ends: &[End]) {
    let errors = errors(ends, target, ["vx", "vy", "vz"], ["ox", "oy", "oz"]);
    let [w, v, o] = errors;
    verdict.row(
        holds(errors, limits) && unpaid(ends) < 1e-9,
        format!(
            "{name} alpha {}: rms W {w:.1e} v {v:.1e} omega {o:.1e} unpaid {:.0e}",
            target["alpha"],
            unpaid(ends)
        ),
    );
}

/// Every row: cubes and octahedra against the model's own limit, which remembers the crater.
/// Fails for an attitude, an inertia or a frame that is not the table's.
#[test]
fn polyhedra() {
    let mut verdict = Verdict::default();
    let limits = table("swept_limit_polyhedron");
    for row in table("rigid_plastic_polyhedron") {
        let stem = row["case"].split_whitespace().next().expect("a name");
        if stem.starts_with("tetra") {
            let ends = ends(stem, &row, &row["quat"], 0.01);
            judge(&mut verdict, stem, &row, TETRAHEDRA, &ends);
            continue;
        }
        let case = format!("{stem} a{}", row["alpha"]);
        let same = |limit: &&Row| limit["case"] == case && limit["pitch"] == "0.005";
        let limit = limits.iter().find(same).unwrap_or_else(|| panic!("no limit {case}"));
        // Three faces that meet the plate almost at once: L/100 leaves 1.3e-3 in W.
        let pitch = if case == "octa-generic a90" { 0.005 } else { 0.01 };
        judge(&mut verdict, stem, limit, FACES, &ends(stem, &row, &row["quat"], pitch));
    }
    verdict.close();
}

/// Every row of those that meet no crater of their own, against the theory. Fails for an attitude
/// that is read in another order, and for a wrong entry face.
#[test]
fn polyhedra_on_a_fresh_plate() {
    let mut verdict = Verdict::default();
    for row in table("rigid_plastic_polyhedron_fresh") {
        let shape = &row["shape"];
        let (pitch, limits) = match shape.as_str() {
            "tetra" => (0.005, TETRAHEDRA),
            _ => (0.01, FACES),
        };
        judge(&mut verdict, shape, &row, limits, &ends(shape, &row, &row["quat_xyzw"], pitch));
    }
    verdict.close();
}
