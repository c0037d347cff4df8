//! From the end of a run to its `summary.json`.

use std::collections::BTreeMap;

use abrade::{ElasticLaw, Ledger};
use abrade_report::Summary;
use abrade_report::quantity_text::count;
use abrade_report::summary::{
    BodySummary, EnergySummary, LawsSummary, MotionSummary, ResolverCounts, SurfaceSummary,
};

use crate::carrier::BuiltCarrier;
use crate::check::Checked;
use crate::run::bodies::{Bodies, Slide, Track};
use crate::run::engine::Engine;
use crate::run::entries::entries;
use crate::run::estimate;
use crate::run::fate::{Fate, fate};
use crate::run::rim;
use crate::run::stop::End;
use crate::run::{Precision, RunError};
use crate::scene::Output;

/// Nodes under the largest contact below which its result depends on the lattice.
const FEW_NODES: usize = 12;

/// What a summary is made of.
pub(crate) struct Run<'a> {
    pub checked: &'a Checked,
    pub engine: &'a dyn Engine,
    pub bodies: &'a Bodies,
    pub precision: Precision,
    pub simulated: f64,
    pub wall: f64,
    pub setup: f64,
    pub end: End,
    pub failure: Option<&'a RunError>,
    pub laws: Option<LawsSummary>,
}

/// The summary of a run.
pub(crate) fn summary(run: &Run<'_>) -> Summary {
    let counts = run.engine.counts();
    let names = run.checked.scene.surfaces.keys();
    let surfaces: BTreeMap<_, _> =
        names.enumerate().map(|(i, name)| (name.clone(), surface(run, i))).collect();
    let tracks = run.bodies.tracks.iter().enumerate();
    let bodies = tracks.map(|(i, track)| (track.name.clone(), body(run, i, track))).collect();
    let energy = run.checked.scene.outputs.contains(&Output::Energy).then(|| {
        let tracks = run.bodies.tracks.iter().enumerate();
        let kinetic: f64 =
            tracks.map(|(i, t)| t.inertia.kinetic_energy(&run.engine.state(i))).sum();
        let carried = |(i, body): (usize, &Option<BuiltCarrier>)| {
            Some(body.as_ref()?.kinetic_energy(&run.engine.carrier(i)?))
        };
        let carried: f64 = run.bodies.carriers.iter().enumerate().filter_map(carried).sum();
        energies(run.engine.ledger(), run.bodies, kinetic + carried)
    });
    let stop = match run.failure {
        Some(failure) => format!("{}: {failure}", run.end.words()),
        None => run.end.words().to_owned(),
    };
    let removed = (0..surfaces.len()).map(|i| run.engine.surface(i).worn().removed);
    Summary {
        scene: run.checked.scene.name.clone(),
        abrade: env!("CARGO_PKG_VERSION").to_owned(),
        complete: run.end.is_complete(),
        precision: match run.precision {
            Precision::Single => "f32".to_owned(),
            Precision::Double => "f64".to_owned(),
        },
        resolver: ResolverCounts {
            micro: counts.micro,
            quasi_static: counts.quasi_static,
            lockstep: counts.lockstep,
            collision: counts.collision,
        },
        resolver_reasons: counts.reasons.clone(),
        wall: run.wall,
        setup: run.setup,
        simulated: run.simulated,
        steps: counts.steps,
        node_evaluations: counts.node_evaluations,
        error_estimate: estimate::of(run.checked, run.engine, energy.as_ref()),
        surfaces,
        bodies,
        energy,
        erosion: run.bodies.erosion.summary(removed),
        warnings: warnings(run),
        stop: Some(stop),
        laws: run.laws.clone(),
    }
}

fn surface(run: &Run<'_>, index: usize) -> SurfaceSummary {
    let surface = run.engine.surface(index);
    let slides = run.bodies.tracks.iter().filter_map(|track| track.slide.as_ref());
    SurfaceSummary {
        wear_rate: slides.filter(|slide| slide.surface == index).find_map(|slide| slide.rate()),
        motion: run.engine.carrier(index).map(|state| MotionSummary::of(&state)),
        ..SurfaceSummary::of(&surface.nodes_since_made(), surface.wear_volume(), &surface.worn())
    }
}

fn body(run: &Run<'_>, index: usize, track: &Track) -> BodySummary {
    let state = run.engine.state(index);
    let fate = fate(run, index, track);
    let slide = track.slide.as_ref();
    let mean = slide.map(Slide::mean_force);
    let open = run.engine.open_contact(index);
    let (impulse, time) = open.unwrap_or_default();
    let (impulse, time) = (track.impulse + impulse, track.contact_time + time);
    let impact = (time > 0.0).then(|| impulse / time);
    let force = mean.or(impact).unwrap_or_default();
    let parted = fate == Fate::Left && run.failure.is_none() && !run.bodies.met_led(track);
    let approach = track.approach.filter(|v| parted && v.norm() > 0.0);
    let local = track.aim.map(|frame| frame.inverse_transform_vector(&state.velocity));
    let angle = |v: nalgebra::Vector3<f64>| v.z.atan2(v.xy().norm()).to_degrees();
    BodySummary {
        restitution: approach.map(|v| state.velocity.norm() / v.norm()),
        rebound_angle: approach.and(local).map(angle),
        restitution_normal: approach.and_then(|before| {
            let normal = run.bodies.normal_met(track)?;
            let towards = -before.dot(&normal);
            let away = state.velocity.dot(&normal);
            (towards > 0.0 && away > 0.0).then(|| away / towards)
        }),
        mean_force: [force.x, force.y, force.z],
        ..BodySummary::of(&state)
    }
}

/// The energies of all bodies, those of surfaces among them, `kinetic` [J] being theirs now. What the engine did to them
/// outside of contacts counts as external work.
pub(crate) fn energies(ledger: Ledger, bodies: &Bodies, kinetic: f64) -> EnergySummary {
    let start = |track: &Track| track.inertia.kinetic_energy(&track.start);
    let initial = bodies.tracks.iter().map(start).sum::<f64>() + bodies.carried_at_start();
    let outside = kinetic - initial - ledger.kinetic_change;
    let ledger = Ledger {
        external_work: ledger.external_work + outside,
        kinetic_change: kinetic - initial,
        ..ledger
    };
    EnergySummary::of(&ledger, initial + ledger.elastic_start, kinetic)
}

fn warnings(run: &Run<'_>) -> Vec<String> {
    let mut warnings = run.checked.notes.clone();
    let scenes: Vec<_> = run.checked.scene.surfaces.iter().collect();
    for entry in entries(run.checked) {
        let touching =
            entry.members.iter().map(|&i| (run.engine.surface(i).worn().peak_touching, i));
        let least = touching.filter(|(touching, _)| (1..FEW_NODES).contains(touching)).min();
        let Some((touching, index)) = least else { continue };
        let (name, scene) = scenes[index];
        let cure = match scene.elastic {
            ElasticLaw::HertzNodes { .. } => {
                "the result depends on where the body lands between the nodes; average over \
                 landings, or take `elastic: Foundation()` and a finer pitch"
            }
            _ => "the result depends on the lattice; take a finer pitch",
        };
        let touching = count(touching, "node", "nodes");
        warnings.push(format!("the largest contact on `{name}` was carried by {touching}: {cure}"));
    }
    for (index, (name, _)) in scenes.iter().enumerate() {
        let cure = match rim::reached(run.engine.surface(index)) {
            [false, false] => continue,
            [true, false] => "longer",
            [false, true] => "wider",
            [true, true] => "longer and wider",
        };
        warnings.push(format!(
            "the wear on `{name}` reaches the rim of the plate, beyond which there is nothing to wear: make it {cure}"
        ));
    }
    let tracks = run.bodies.tracks.iter().enumerate().filter(|(_, track)| !track.is_streamed);
    for (index, track) in tracks {
        let name = &track.name;
        match fate(run, index, track) {
            Fate::Missed => warnings.push(format!(
                "`{name}` has touched nothing: it passes beside the surfaces, or has not come to them yet"
            )),
            Fate::FellThrough => warnings.push(format!(
                "`{name}` is below the surface that it was aimed at: it went over the rim, or between \
                 nodes; its wear is cut short"
            )),
            Fate::Left | Fate::Stays | Fate::Led => {}
        }
    }
    for (what, why, steps) in &run.bodies.refused {
        let steps = count(*steps, "step", "steps");
        warnings.push(format!("{what} was left to the engine in {steps}, unworn: {why}"));
    }
    warnings
}
