//! Whole runs, for the share of them that node evaluations are: an impact from a new encounter to
//! its exit, and a scratch under a dead load.

use std::time::Instant;

use abrade::{
    Body, Drive, DriveSolution, Driven, EncounterSettings, HexStrip, Inertia, Placed, Shape, State,
    Surface,
};
use nalgebra::{Isometry3, Point3};

use crate::cases::{Case, Range, foundation, paper, projected};

/// Runs, of which the fastest counts.
const RUNS: usize = 10;

/// Least time of an impact per node evaluation [ns].
pub fn impact(case: &Case) -> f64 {
    let mut range = Range::new(case.clone());
    let mut least = f64::INFINITY;
    for _ in 0..RUNS {
        range.make_ready();
        let start = Instant::now();
        let done = range.fire();
        least = least.min(per(start, done.node_evaluations));
    }
    least
}

/// A ball that is pressed into a plate and slid.
pub struct Scratch {
    surface: Surface,
    body: Body,
    driven: Driven,
}

impl Scratch {
    /// Pressed in; sliding follows from `solution`.
    pub fn new(solution: DriveSolution) -> Self {
        let mut laws = paper("", foundation(), projected(), 45.0, None).laws;
        laws.material.hardness = 1.7e9;
        let strip = HexStrip { length: 12e-3, width: 6e-3, pitch: 0.1e-3, rest_area: None };
        let mut surface = Surface::hex_strip(strip, laws).expect("a plate");
        let radius = 10e-3;
        let mut body = Body {
            shape: Shape::ball(radius).expect("a ball"),
            inertia: Inertia::of_ball(radius, 8000.0),
            state: State::at(Point3::new(-2e-3, 0.0, radius + 1e-9)),
            rotation_locked: true,
        };
        let drive =
            Drive { indent_to: 2e3, load: 2e3, speed: 0.2, distance: 2e-3, mass: 0.0335, solution };
        let settings = EncounterSettings::default();
        let mut driven = Driven::new(&mut body, &surface, drive, settings).expect("a drive");
        let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
        driven.indent(&mut body, &mut placed, &mut ()).expect("an indentation");
        Self { surface, body, driven }
    }

    /// Slides it; node evaluations.
    pub fn slide(&mut self) -> u64 {
        let Self { surface, body, driven } = self;
        let mut placed = [Placed::at_rest(surface, Isometry3::identity())];
        let done = driven.advance(body, &mut placed, 1.0, &mut ()).expect("a scratch");
        done.node_evaluations
    }
}

/// Least time of a scratch per node evaluation [ns], and the number of them.
pub fn scratch(solution: DriveSolution) -> (f64, u64) {
    let mut found = (f64::INFINITY, 0);
    for _ in 0..RUNS {
        let mut scratch = Scratch::new(solution);
        let start = Instant::now();
        let evaluations = scratch.slide();
        found = (per(start, evaluations).min(found.0), evaluations);
    }
    found
}

/// Nanoseconds since `start`, over `count`.
fn per(start: Instant, count: u64) -> f64 {
    1e9 * start.elapsed().as_secs_f64() / count as f64
}
