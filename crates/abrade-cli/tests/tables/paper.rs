//! The paper's set-ups: our own references on its lattice, and LAMMPS under Eq. 5.

use crate::run::{Verdict, at, number, run, table};

fn set(path: &str, value: impl std::fmt::Display) -> String {
    format!("{path}={value}")
}

fn landing(body: &str, x: f64, y: f64) -> String {
    set(&format!("bodies.{body}.position.at"), format!("(\"{x} mm\", \"{y} mm\")"))
}

/// Fails for a scene, a placement or a summary that differs from the law tested in the core.
#[test]
fn impacts_on_the_paper_lattice() {
    let mut verdict = Verdict::default();
    for row in table("paper_lattice_impacts") {
        let sets = [
            set("bodies.ball.motion.angle", format!("{} deg", row["theta"])),
            landing("ball", number(&row, "x_mm"), number(&row, "y_mm")),
        ];
        let summary = run(&format!("paper/{}_impact.ron", row["case"]), &sets);
        let w = at(&summary, "surfaces.plate.wear_volume_m3") * 1e9;
        let cor = at(&summary, "bodies.ball.restitution");
        let angle = at(&summary, "bodies.ball.rebound_angle_deg");
        let expected = number(&row, "W_mm3");
        let fine = (w - expected).abs() <= (2e-3 * expected).max(2e-6)
            && (cor - number(&row, "COR")).abs() <= 5e-4
            && (angle - number(&row, "th_r_deg")).abs() <= 0.05;
        verdict.row(
            fine,
            format!(
                "{} {} {}: W {w:.7} / {expected}, COR {cor:.6} / {}, angle {angle:.4} / {}",
                row["case"], row["theta"], row["landing"], row["COR"], row["th_r_deg"]
            ),
        );
    }
    verdict.close();
}

/// Fails for a wrong load balance or effective area.
#[test]
fn indentation_on_the_paper_lattice() {
    let mut verdict = Verdict::default();
    for row in table("indentation").iter().filter(|row| row["law"].starts_with("paperHertz")) {
        let pitch = 0.601_577;
        let at_mm = match row["landing"].as_str() {
            "top" => [0.0, 0.0],
            "hollow" => [pitch / 12f64.sqrt(), pitch / 2.0],
            _ => [0.0, pitch / 2.0],
        };
        let convention = match row["law"].as_str() {
            "paperHertz_E*110" => "ElasticPair",
            _ => "RigidBody",
        };
        let sets = [
            set("surfaces.plate.elastic.convention", convention),
            landing("indenter", at_mm[0], at_mm[1]),
        ];
        let summary = run("paper/indentation.ron", &sets);
        let area = at(&summary, "surfaces.plate.indented_area_m2") * 1e6;
        let expected = number(row, "A_ind_at_21kN_mm2");
        verdict.row(
            (area / expected - 1.0).abs() <= 0.02,
            format!("{} {}: area {area:.4} / {expected}", row["law"], row["landing"]),
        );
    }
    verdict.close();
}

/// LAMMPS' lattice and its own numbers.
fn lammps_sets(row: &crate::run::Row) -> Vec<String> {
    let convention = if row["kfac"] == "1" { "ElasticPair" } else { "RigidBody" };
    vec![
        set(
            "surfaces.plate.geometry",
            "HexStrip(length: \"93.5 mm\", width: \"16.8 mm\", pitch: \"0.6 mm\", \
             rest_area: \"0.3134078 mm2\")",
        ),
        set("surfaces.plate.flow.lateral", "Eq5"),
        set("surfaces.plate.elastic.convention", convention),
        set("materials.plate.shear_ratio", &row["mua"]),
    ]
}

/// Fails for a literal Eq. 5 or A.1 that is not the paper's.
#[test]
fn impacts_in_lammps_under_eq5() {
    let mut verdict = Verdict::default();
    for name in ["lammps_normal_impacts", "lammps_oblique_impacts"] {
        for row in table(name).iter().filter(|row| number(row, "dt") <= 4e-9) {
            let normal = name == "lammps_normal_impacts";
            let mut sets = lammps_sets(row);
            sets.push(set("materials.plate.hardness", number(row, "H")));
            sets.push(set("bodies.ball.motion.speed", number(row, "V")));
            sets.push(set("bodies.ball.motion.angle", format!("{} deg", row["theta"])));
            if !normal {
                let mm = |column| number(row, column) * 1e3;
                sets.push(landing("ball", mm("ox"), mm("oy")));
                // LAMMPS' own gap: it moves the landing of a grazing ball.
                sets.push(set("bodies.ball.position.gap", "1 um"));
            }
            let scene = if normal { "paper/normal_impact.ron" } else { "paper/oblique_impact.ron" };
            let summary = run(scene, &sets);
            let w = at(&summary, "surfaces.plate.wear_volume_m3") * 1e9;
            let cor = at(&summary, "bodies.ball.restitution");
            let (expected, cor_expected) = (number(row, "W") * 1e9, number(row, "cor"));
            let fine = match normal {
                true => {
                    (w / expected - 1.0).abs() <= 0.02 && (cor / cor_expected - 1.0).abs() <= 0.04
                }
                false => {
                    (w - expected).abs() <= (0.05 * expected).max(5e-5)
                        && (cor - cor_expected).abs() <= 3e-3
                }
            };
            verdict.row(
                fine,
                format!(
                    "{name} H {} theta {} kfac {} at ({}, {}): W {w:.6} / {expected:.6}, COR \
                     {cor:.5} / {cor_expected}",
                    row["H"],
                    row["theta"],
                    row["kfac"],
                    row.get("ox").map_or("0", String::as_str),
                    row.get("oy").map_or("0", String::as_str)
                ),
            );
        }
    }
    verdict.close();
}

/// Fails for a slide that starts, balances or flows otherwise than LAMMPS'.
#[test]
fn full_scratches_in_lammps_under_eq5() {
    let mut verdict = Verdict::default();
    for row in table("lammps_scratch").iter().filter(|row| row["label"] == "full0.4s") {
        // On the lattice as shipped; LAMMPS' own pitch is 0.3 % less.
        let mut sets = lammps_sets(row);
        sets.remove(0);
        let summary = run("paper/scratch.ron", &sets);
        let rate = at(&summary, "surfaces.plate.wear_rate_m2") * 1e6;
        let expected = number(row, "rate_tail_mm2");
        verdict.row(
            (rate / expected - 1.0).abs() <= 0.02,
            format!("kfac {}: rate {rate:.5} / {expected} mm2", row["kfac"]),
        );
    }
    verdict.close();
}

/// Fails for a default stiffness or a pitch of the shipped scenes that is not converged.
#[test]
fn foundation_impacts_as_shipped() {
    let mut verdict = Verdict::default();
    for row in table("foundation_limit").iter().filter(|row| row["law"] == "WinklerHertzCal") {
        let sets = [set("bodies.ball.motion.angle", format!("{} deg", row["theta"]))];
        let summary = run(&format!("foundation/{}_impact.ron", row["case"]), &sets);
        let w = at(&summary, "surfaces.plate.wear_volume_m3") * 1e9;
        let cor = at(&summary, "bodies.ball.restitution");
        let (expected, cor_expected) = (number(row, "W_limit_mm3"), number(row, "COR_limit"));
        verdict.row(
            (w / expected - 1.0).abs() <= 3e-3 && (cor - cor_expected).abs() <= 1e-3,
            format!(
                "{} {}: W {w:.6} / {expected}, COR {cor:.5} / {cor_expected}",
                row["case"], row["theta"]
            ),
        );
    }
    verdict.close();
}
