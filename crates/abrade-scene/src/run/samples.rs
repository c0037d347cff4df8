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
    /// State of the body that the surface moves with.
    carrier: Option<State>,
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
        let met = sample.surfaces.iter().map(|met| {
            self.start[met.index].get_or_insert(before[met.index]);
            let worn = met.surface.worn();
            let (volume, depth) = (worn.displaced(), worn.max_depth);
            Displaced { surface: met.index, volume, depth, carrier: met.carrier }
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
        self.last(surface, time).map_or((0.0, 0.0), |(_, d)| (d.volume - start, d.depth))
    }

    /// The body of `surface` as the last contact step by `time` [s] left it, and when that was.
    pub(crate) fn carrier(&self, surface: usize, time: f64) -> Option<(f64, State)> {
        let (at, displaced) = self.last(surface, time)?;
        Some((at, displaced.carrier?))
    }

    /// What the last contact step with `surface` by `time` [s] left, and when that was.
    fn last(&self, surface: usize, time: f64) -> Option<(f64, &Displaced)> {
        self.start[surface]?;
        let upto = self.kept.iter().zip(&self.displaced).take(self.index(time) + 1);
        upto.rev().find_map(|(kept, displaced)| {
            let found = displaced.iter().find(|d| d.surface == surface)?;
            Some((kept.time, found))
        })
    }

    fn index(&self, time: f64) -> usize {
        self.kept.partition_point(|kept| kept.time <= time).max(1) - 1
    }
}
