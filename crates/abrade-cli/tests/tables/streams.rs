//! Streams through the command line.

use crate::run::{at, run};

/// A run of `count` grains of the nozzle.
fn nozzle(count: u32, sets: &[&str]) -> serde_json::Value {
    let mut all = vec![format!("streams.grit.count={count}"), "outputs=[Energy]".to_owned()];
    all.extend(sets.iter().map(|set| (*set).to_owned()));
    run("nozzle.ron", &all)
}

/// Fails for grains that come in no order or not at all, for a rate that is not that of the debris and
/// of the mass that struck, and for grains that stay when they have left: 60 of them take 26 ms, in
/// which the first one would get a metre away.
#[test]
fn grains_come_strike_and_go() {
    let summary = nozzle(60, &[]);
    assert_eq!(summary["complete"], true);
    assert_eq!(at(&summary, "erosion.struck"), 60.0);
    let removed = 1e9 * at(&summary, "surfaces.plate.removed_volume_m3");
    let mass = at(&summary, "erosion.struck_kg");
    let rate = at(&summary, "erosion.rate_mm3_per_kg");
    assert!(removed > 0.0 && (rate * mass / removed - 1.0).abs() < 1e-12, "{rate}");
    let by_mass = at(&summary, "erosion.rate_kg_per_kg");
    assert!((by_mass / (rate * 7850e-9) - 1.0).abs() < 1e-12, "{by_mass}");
    for (name, body) in summary["bodies"].as_object().expect("bodies") {
        let place = at(body, "position_m.0").hypot(at(body, "position_m.2"));
        assert!(place < 0.3, "{name} at {place} m");
    }
    let again = nozzle(60, &[]);
    for key in ["surfaces", "bodies", "energy", "erosion"] {
        assert_eq!(summary[key], again[key], "{key}");
    }
    let other = nozzle(60, &["streams.grit.seed=2"]);
    assert_ne!(summary["surfaces"], other["surfaces"]);
}

/// Fails for grains whose way depends on the steps of the run that they come in.
#[test]
fn a_stream_does_not_depend_on_the_step() {
    let sets = ["streams.grit.mass_rate=\"0.02 g/s\"", "run.step=\"0.3 ms\""];
    let [coarse, fine] = [&sets[..1], &sets].map(|sets| nozzle(20, sets));
    let volume = |summary| at(summary, "surfaces.plate.wear_volume_m3");
    let off = volume(&fine) / volume(&coarse) - 1.0;
    assert!(off.abs() < 1e-6, "{off:e}");
}
