//! The mesh-objective law: limits in pitch and time, and how fast they are reached.

use crate::rig::{Impact, laws, paper, projected};
use crate::table::{number, read};
use abrade::{ElasticLaw, HexStrip};

/// A paper impact on a foundation, four landings of which the mean is taken.
pub fn landings(case: &str, angle: f64, stiffness: Option<f64>, pitch: f64) -> Vec<Impact> {
    let base = paper(case, angle, [0.0, 0.0]);
    let extent = if case == "normal" { 12e-3 } else { 3e-3 };
    let elastic = ElasticLaw::Foundation { stiffness };
    let laws = laws(base.laws.material.hardness, elastic, projected());
    let strip = HexStrip { length: extent, width: extent, pitch, rest_area: None };
    [(0.0, 0.0), (0.289, 0.0), (0.144, 0.25), (0.4, 0.13)]
        .map(|(x, y)| Impact {
            at: [x * pitch, y * pitch],
            strip,
            laws: laws.clone(),
            ..base.clone()
        })
        .into()
}

/// Fails for a wrong calibration, a mesh-dependent law or a lateral part that is not the paper's.
#[test]
fn foundation_impacts_reach_their_limits() {
    let mut misses = Vec::new();
    for row in read("foundation_limit") {
        let case = row["case"].as_str();
        let hardness = paper(case, 90.0, [0.0; 2]).laws.material.hardness;
        // PaperCal: k_w = H / (0.8 d_y of the paper's node).
        let stiffness =
            (row["law"] == "WinklerPaperCal").then(|| hardness / (0.8 * node_yield(case)));
        let pitch = if case == "normal" { 0.3e-3 } else { 0.03e-3 };
        let runs: Vec<_> = landings(case, number(&row, "theta"), stiffness, pitch)
            .iter()
            .map(Impact::run)
            .collect();
        let mean = |f: &dyn Fn(&crate::rig::Outcome) -> f64| {
            runs.iter().map(f).sum::<f64>() / runs.len() as f64
        };
        let w = mean(&|o| o.surface.wear_volume()) * 1e9;
        let cor = mean(&|o| o.restitution);
        let (w_limit, cor_limit) = (number(&row, "W_limit_mm3"), number(&row, "COR_limit"));
        let line = format!(
            "{case} {} {}: W {w:.6} / {w_limit} ({:+.2e})  COR {cor:.5} / {cor_limit} ({:+.1e})  angle {:.3} / {} steps {} nodes {} touching {}",
            row["law"],
            row["theta"],
            w / w_limit - 1.0,
            cor - cor_limit,
            mean(&|o| o.rebound_angle),
            row["th_r_limit"],
            runs[0].advance.steps,
            runs[0].advance.node_evaluations,
            runs[0].surface.worn().peak_touching
        );
        println!("{line}");
        if (w / w_limit - 1.0).abs() > 3e-3 || (cor - cor_limit).abs() > 1e-3 {
            misses.push(line);
        }
    }
    assert!(misses.is_empty(), "{}", misses.join("\n"));
}

/// Overlap at which the paper's node yields: a_s H = K sqrt(R_eff) d^1.5.
fn node_yield(case: &str) -> f64 {
    let impact = paper(case, 90.0, [0.0; 2]);
    let area = impact.strip.rest_area.expect("the paper's area");
    let k = 2.0 * 200e9 / (3.0 * (1.0 - 0.09));
    let effective: f64 = 0.25e-3 * impact.radius / (0.25e-3 + impact.radius);
    (area * impact.laws.material.hardness / (k * effective.sqrt())).powf(2.0 / 3.0)
}
