//! Rigid-plastic theory through the command line.

use crate::run::{Verdict, at, number, rms, run, table, vector};

/// Landings over a node cell, in pitches.
const LANDINGS: [[f64; 2]; 4] = [[0.11, 0.08], [0.32, 0.7], [0.54, 0.31], [0.76, 0.93]];

fn landing(body: &str, pitch_mm: f64, [x, y]: [f64; 2]) -> String {
    let (x, y) = (x * pitch_mm * 0.75f64.sqrt(), y * pitch_mm);
    format!("bodies.{body}.position.at=(\"{x} mm\", \"{y} mm\")")
}

/// Fails for a prism whose rotation, width or stop rule is not the theory's.
#[test]
fn square_prisms() {
    let mut verdict = Verdict::default();
    let rows = table("rigid_plastic_polygon");
    let certified =
        rows.iter().filter(|row| row["shape"] == "square" && number(row, "fresh_err").abs() < 3e-6);
    for row in certified {
        let (b, alpha, theta) = (number(row, "B"), number(row, "alpha"), number(row, "theta"));
        let mut errors = [Vec::new(), Vec::new(), Vec::new()];
        for place in LANDINGS {
            let summary = run(
                "theory/square_edge.ron",
                &[
                    format!("bodies.prism.density={}", 192.450_089_73 * b),
                    format!("bodies.prism.motion.angle={alpha} deg"),
                    format!("bodies.prism.rotation.angle={} deg", 45.0 - theta),
                    landing("prism", 0.005_773_502_69, [place[0], 0.25]),
                ],
            );
            let e0 = at(&summary, "energy.initial_J");
            let paid = at(&summary, "surfaces.plate.wear_volume_m3")
                - at(&summary, "surfaces.plate.chip_volume_m3");
            let v = vector(&summary, "bodies.prism.velocity_m_s");
            let spin = at(&summary, "bodies.prism.spin_rad_s.1");
            errors[0].push(1e9 * paid / e0 - number(row, "W_over_E0"));
            errors[1]
                .push((v[0] / 100.0 - number(row, "vx")).hypot(v[2] / 100.0 - number(row, "vz")));
            errors[2].push(-spin * 1e-3 / 100.0 - number(row, "omega"));
        }
        let [w, v, omega] = errors.map(|e| rms(&e));
        // The page's limits: slow rows first.
        let [w_limit, v_limit, omega_limit] = match (alpha as i32, theta as i32) {
            (90, 40) => [5e-3, 3e-2, 3e-2],
            (90, 30) if b > 0.05 => [2e-3, 5e-3, 1.5e-2],
            _ => [2e-3, 5e-3, 5e-3],
        };
        verdict.row(
            w <= w_limit && v <= v_limit && omega <= omega_limit,
            format!("B {b} alpha {alpha} theta {theta}: rms W {w:.1e} v {v:.1e} omega {omega:.1e}"),
        );
    }
    verdict.close();
}

/// Fails for a shape, an inertia or a summary that is not the theory's; the energy theorem holds
/// to round-off through every layer.
#[test]
fn polyhedra() {
    let mut verdict = Verdict::default();
    let cases = [
        ("cube", "Cube", 2000.0, 90.0, "cube-generic a90"),
        ("cube", "Cube", 2000.0, 30.0, "cube-generic a30"),
        ("octahedron", "Octahedron", 4_242.640_687_119, 90.0, "octa-generic a90"),
        ("octahedron", "Octahedron", 4_242.640_687_119, 30.0, "octa-generic a30"),
        ("tetrahedron", "Tetrahedron", 16_970.562_748_477, 30.0, "tetra-generic a30"),
    ];
    let limits = table("swept_limit_polyhedron");
    let theory = table("rigid_plastic_polyhedron");
    for (name, kind, density, alpha, case) in cases {
        // Three faces that meet the plate almost at once: L/100 leaves 1.3e-3 in W.
        let pitch = if case == "octa-generic a90" { 0.005 } else { 0.01 };
        let tetra = name == "tetrahedron";
        let row = match tetra {
            true => theory.iter().find(|row| row["case"].starts_with("tetra")),
            false => limits.iter().find(|row| row["case"] == case && row["pitch"] == "0.005"),
        };
        let row = row.expect("a row");
        let mut errors = [Vec::new(), Vec::new(), Vec::new()];
        let mut balance: f64 = 0.0;
        for place in LANDINGS {
            let summary = run(
                "theory/polyhedron_generic.ron",
                &[
                    format!("bodies.grit.shape.kind={kind}"),
                    format!("bodies.grit.density={density}"),
                    format!("bodies.grit.motion.angle={alpha} deg"),
                    format!("surfaces.plate.geometry.pitch={pitch} mm"),
                    landing("grit", pitch, place),
                ],
            );
            let e0 = at(&summary, "energy.initial_J");
            let paid = at(&summary, "surfaces.plate.wear_volume_m3")
                - at(&summary, "surfaces.plate.chip_volume_m3");
            let lost = e0 - at(&summary, "energy.kinetic_J");
            balance = balance.max((1e9 * paid - lost).abs() / e0);
            let distance = |path: &str, scale: f64, names: [&str; 3]| {
                let got = vector(&summary, path);
                let squares =
                    got.iter().zip(names).map(|(x, n)| (x * scale - number(row, n)).powi(2));
                squares.sum::<f64>().sqrt()
            };
            errors[0].push(1e9 * paid / e0 - number(row, "W_over_E0"));
            errors[1].push(distance("bodies.grit.velocity_m_s", 1e-2, ["vx", "vy", "vz"]));
            errors[2].push(distance("bodies.grit.spin_rad_s", 1e-5, ["ox", "oy", "oz"]));
        }
        let [w, v, omega] = errors.map(|e| rms(&e));
        let [w_limit, v_limit, omega_limit] =
            if tetra { [1e-2, 3e-2, 0.1] } else { [1e-3, 8e-3, 3e-2] };
        verdict.row(
            w <= w_limit && v <= v_limit && omega <= omega_limit && balance < 1e-9,
            format!("{name} alpha {alpha}: rms W {w:.1e} v {v:.1e} omega {omega:.1e} balance {balance:.0e}"),
        );
    }
    verdict.close();
}

/// Fails for a sphere whose crater is not Rickerby & Macmillan's.
#[test]
fn spheres_without_rotation() {
    let mut verdict = Verdict::default();
    let plain = table("rigid_plastic_sphere_oblique");
    let rubbed = table("rigid_plastic_sphere_oblique_friction");
    let rows = plain.iter().chain(&rubbed);
    for row in rows.filter(|row| number(row, "beta") == 0.01) {
        let (alpha, mu) = (number(row, "alpha"), number(row, "mu"));
        let sets = [
            format!("bodies.ball.motion.angle={alpha} deg"),
            format!("materials.plate.friction={mu}"),
            format!("bodies.ball.rotation_locked={}", row["rot"] == "0"),
        ];
        let summary = run("theory/sphere_oblique.ron", &sets);
        let e0 = at(&summary, "energy.initial_J");
        let w = 1e9 * at(&summary, "surfaces.plate.wear_volume_m3") / e0;
        let v = vector(&summary, "bodies.ball.velocity_m_s");
        let (dw, dvx, dvz) = (
            w - number(row, "WH_over_E0"),
            v[0] / 100.0 - number(row, "vx"),
            v[2] / 100.0 - number(row, "vz"),
        );
        verdict.row(
            dw.abs() < 1e-3 && dvx.abs() < 1e-3 && dvz.abs() < 1e-3,
            format!(
                "alpha {alpha} mu {mu} rot {}: dW {dw:+.1e} dvx {dvx:+.1e} dvz {dvz:+.1e}",
                row["rot"]
            ),
        );
    }
    verdict.close();
}
