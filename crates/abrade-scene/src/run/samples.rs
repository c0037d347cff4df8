//! The contact steps of one engine step, kept until the step is over: bodies are resolved one
//! after the other, and a history runs through time.

use abrade::{Ledger, State};
use nalgebra::Vector3;

use crate::run::engine::Sample;

/// A body at an instant of the step under way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kept {
    /// Time since the step began [s].
    pub time: f64,
    pub state: State,
    pub force: Vector3<f64>,
    /// The body's own energies.
    pub ledger: Ledger,
}

/// What a body displaced on a surface by an instant.
#[derive(Clone, Copy, Debug)]
struct Displaced {
    surface: usize,
    /// Volume of the surface then [m3], and its largest depth [m].
    volume: f64,
    depth: f64,
}

/// One body over the step under way.
#[derive(Clone, Debug)]
pub(crate) struct Course {
    kept: Vec<Kept>,
    displaced: Vec<Vec<Displaced>>,
    /// Volumes when the body's first sample came, per surface.
    start: Vec<Option<f64>>,
}

impl Course {
    /// A course that begins at `state`.
    pub(crate) fn new(surfaces: usize, state: State, force: Vector3<f64>, ledger: Ledger) -> Self {
        Self {
            kept: vec![Kept { time: 0.0, state, force, ledger }],
            displaced: vec![Vec::new()],
            start: vec![None; surfaces],
        }
    }

    /// Adds a contact step; `before` are the volumes when the body's turn came.
    pub(crate) fn push(&mut self, sample: &Sample<'_>, before: &[f64]) {
        self.kept.push(Kept {
            time: sample.time,
            state: sample.state,
            force: sample.force,
            ledger: sample.ledger.copied().unwrap_or_default(),
        });
        let met = sample.surfaces.iter().map(|&(surface, worn)| {
            self.start[surface].get_or_insert(before[surface]);
            let worn = worn.worn();
            Displaced { surface, volume: worn.displaced(), depth: worn.max_depth }
        });
        self.displaced.push(met.collect());
    }

    /// First and last time in contact [s].
    pub(crate) fn contact(&self) -> Option<[f64; 2]> {
        let touching = |kept: &&Kept| kept.force != Vector3::zeros();
        let first = self.kept.iter().find(touching)?;
        let last = self.kept.iter().rev().find(touching)?;
        Some([first.time, last.time])
    }

    /// The body at `time` [s] since the step began: as it was after its last contact step.
    pub(crate) fn at(&self, time: f64) -> &Kept {
        &self.kept[self.index(time)]
    }

    /// Volume [m3] that the body displaced on `surface` by `time`, and the depth seen then [m].
    pub(crate) fn displaced(&self, surface: usize, time: f64) -> (f64, f64) {
        let Some(start) = self.start[surface] else { return (0.0, 0.0) };
        let upto = &self.displaced[..=self.index(time)];
        let last = upto.iter().rev().flatten().find(|d| d.surface == surface);
        last.map_or((0.0, 0.0), |d| (d.volume - start, d.depth))
    }

    fn index(&self, time: f64) -> usize {
        self.kept.partition_point(|kept| kept.time <= time).max(1) - 1
    }
}
