//! Writes a report page with made-up numbers, to be looked at.
//!
//! cargo run -p abrade-report --example page -- PICTURE.png PAGE.html

use std::collections::BTreeMap;
use std::error::Error;
use std::path::Path;

use abrade::State;
use abrade_report::page;
use abrade_report::summary::{
    BodySummary, EnergySummary, ErrorEstimate, ResolverCounts, Summary, SurfaceSummary,
};
use nalgebra::{Point3, Vector3};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let picture = std::fs::read(arguments.next().ok_or("which picture?")?)?;
    let path = arguments.next().ok_or("which page?")?;
    let surface = SurfaceSummary {
        nodes: 5012,
        wear_volume: 2.3625e-11,
        wear_volume_normal: 1.5e-11,
        wear_volume_lateral: 8.625e-12,
        removed_volume: 2.3625e-11,
        max_depth: 3.4e-5,
        worn_nodes: 74,
        peak_normal_force: 4321.5,
        ..SurfaceSummary::default()
    };
    let state = State {
        velocity: Vector3::new(20.5, 0.0, 18.25),
        spin: Vector3::new(0.0, 3100.0, 0.0),
        ..State::at(Point3::new(1.2e-3, 0.0, 3e-3))
    };
    let ball = BodySummary {
        restitution: Some(0.7842),
        rebound_angle: Some(41.68),
        mean_force: [-1500.0, 0.0, 3200.0],
        ..BodySummary::of(&state)
    };
    let summary = Summary {
        scene: "Oblique impact of a ball".into(),
        abrade: "0.1.0".into(),
        complete: true,
        precision: "f64".into(),
        resolver: ResolverCounts { micro: 1, ..Default::default() },
        resolver_reasons: Default::default(),
        wall: 0.0123,
        setup: 0.0004,
        simulated: 1.2e-5,
        steps: 312,
        node_evaluations: 20_512,
        surfaces: BTreeMap::from([("plate".into(), surface)]),
        bodies: BTreeMap::from([("ball".into(), ball)]),
        energy: Some(EnergySummary { initial: 0.1732, kinetic: 0.1065, ..Default::default() }),
        erosion: None,
        error_estimate: ErrorEstimate {
            time: Some(8.1e-4),
            pitch: None,
            basis: Some("half steps on the last contact".into()),
        },
        warnings: vec!["Fewer than 12 nodes carried the largest contact.".into()],
        stop: Some("all bodies have rebounded".into()),
        laws: None,
    };
    Ok(page::write(Path::new(&path), &summary, Some(&picture))?)
}
