//! What a run writes while it goes: history, ParaView files.

use std::path::{Path, PathBuf};

use abrade::{Ledger, State};
use abrade_report::history::{BodyRow, Columns, Row, SurfaceRow};
use abrade_report::summary::LawsSummary;
use abrade_report::{History, ReportError, Summary};
use nalgebra::Vector3;

use crate::build::Built;
use crate::check::Checked;
use crate::run::bodies::{Bodies, Track};
use crate::run::ending::Ending;
use crate::run::engine::{Engine, Sample, Watch};
use crate::run::entries::{Entry, entries};
use crate::run::frames::Frames;
use crate::run::impacts::Predictions;
use crate::run::samples::Course;
use crate::run::summary::energies;
use crate::scene::Output;

/// Largest number of history rows of the contacts of an engine step.
const ROWS: usize = 100_000;
/// Part of a step by which an instant may lie behind its end and still be shown with it: a sum of
/// steps is rounded, and the next step has no force yet.
const BEHIND: f64 = 1e-9;

/// Writes what the scene asks for.
pub(crate) struct Recorder {
    time: f64,
    folder: PathBuf,
    title: String,
    outputs: Vec<Output>,
    history: Option<Timed<History>>,
    predictions: Option<Predictions>,
    frames: Option<Timed<Frames>>,
    energies: bool,
    courses: Vec<Course>,
    /// Volumes of the surfaces when the next body's turn comes [m3].
    volumes: Vec<f64>,
    depths: Vec<f64>,
    /// States of the bodies of moving surfaces when the step began.
    carriers: Vec<Option<State>>,
    /// Energies of encounters that were over when the step began.
    closed: Ledger,
    last_ledgers: Vec<Ledger>,
    entries: Vec<Entry>,
}

/// Something that is written every so often.
struct Timed<T> {
    it: T,
    every: f64,
    next: f64,
}

impl Recorder {
    pub(crate) fn new(
        checked: &Checked,
        built: &Built,
        folder: &Path,
    ) -> Result<Self, ReportError> {
        let outputs = checked.scene.outputs.clone();
        let energies = outputs.contains(&Output::Energy);
        let (entries, count) = (entries(checked), built.surfaces.len());
        let mut history = None;
        let mut every_frame = None;
        let mut at_end = false;
        for output in &outputs {
            match output {
                Output::History { every } => {
                    let columns = Columns {
                        bodies: built.bodies.keys().cloned().collect(),
                        surfaces: entries.iter().map(|entry| entry.name.clone()).collect(),
                        carriers: moving(built, &entries),
                        energies,
                    };
                    let it = History::create(&folder.join("history.csv"), columns)?;
                    history = Some(Timed { it, every: *every, next: *every });
                }
                Output::Surface { every: Some(every), .. } => every_frame = Some(*every),
                Output::Surface { every: None, .. } => at_end = true,
                _ => {}
            }
        }
        let with_bodies = outputs.contains(&Output::Bodies);
        let frames = match every_frame.is_some() || at_end || with_bodies {
            true => {
                let every = every_frame.unwrap_or(f64::INFINITY);
                let it = Frames::new(built, &entries, folder, with_bodies, at_end)?;
                Some(Timed { it, every, next: every })
            }
            false => None,
        };
        Ok(Self {
            time: 0.0,
            folder: folder.to_owned(),
            title: checked.scene.name.clone(),
            outputs,
            history,
            predictions: Predictions::new(checked, built, folder)?,
            frames,
            energies,
            courses: Vec::new(),
            volumes: vec![0.0; count],
            depths: vec![0.0; count],
            carriers: vec![None; count],
            closed: Ledger::default(),
            last_ledgers: vec![Ledger::default(); built.bodies.len()],
            entries,
        })
    }

    /// Simulated time [s].
    pub(crate) fn time(&self) -> f64 {
        self.time
    }

    /// What laws say of the impacts so far, where the scene names some.
    pub(crate) fn laws(&self) -> Option<LawsSummary> {
        self.predictions.as_ref().map(Predictions::summary)
    }

    /// Time until the next frame is due [s].
    pub(crate) fn until_frame(&self) -> f64 {
        self.frames.as_ref().map_or(f64::INFINITY, |frames| frames.next - self.time)
    }

    /// The state at the start.
    pub(crate) fn begin(
        &mut self,
        engine: &dyn Engine,
        bodies: &Bodies,
    ) -> Result<(), ReportError> {
        self.open_step(engine, bodies);
        self.row(bodies, 0.0)?;
        match &mut self.frames {
            Some(frames) if frames.every.is_finite() => frames.it.write(engine, bodies, 0.0),
            _ => Ok(()),
        }
    }

    /// Gets ready for the contact steps of an engine step; only a history needs them.
    pub(crate) fn open_step(&mut self, engine: &dyn Engine, bodies: &Bodies) {
        if self.history.is_none() {
            return;
        }
        let count = self.volumes.len();
        self.closed = engine.ledger();
        self.courses.clear();
        for body in 0..bodies.tracks.len() {
            let live = engine.has_ledger(body);
            let ledger = if live { self.last_ledgers[body] } else { Ledger::default() };
            self.closed -= ledger;
            let course = Course::new(count, engine.state(body), Vector3::zeros(), ledger);
            self.courses.push(course);
        }
        for surface in 0..count {
            let worn = engine.surface(surface).worn();
            self.volumes[surface] = worn.displaced();
            self.depths[surface] = worn.max_depth;
            self.carriers[surface] = engine.carrier(surface);
        }
    }

    /// Sees the contact steps of an engine step.
    pub(crate) fn watch<'a>(&'a mut self, bodies: &'a mut Bodies) -> Watcher<'a> {
        let before = self.volumes.clone();
        Watcher { recorder: self, bodies, before, body: usize::MAX }
    }

    /// Writes what fell into an engine step of length `dt` [s].
    pub(crate) fn close_step(
        &mut self,
        engine: &dyn Engine,
        bodies: &Bodies,
        dt: f64,
    ) -> Result<(), ReportError> {
        self.rows(bodies, dt)?;
        if let Some(predictions) = &mut self.predictions {
            predictions.add(bodies)?;
        }
        for (last, course) in self.last_ledgers.iter_mut().zip(&self.courses) {
            *last = course.at(f64::INFINITY).ledger;
        }
        self.time += dt;
        let time = self.time;
        match &mut self.frames {
            Some(frames) if time >= frames.next * (1.0 - f64::EPSILON) => {
                frames.next += frames.every;
                frames.it.write(engine, bodies, time)
            }
            _ => Ok(()),
        }
    }

    /// Rows of the history: every instant due while a body is in contact, and the last one due.
    fn rows(&mut self, bodies: &Bodies, dt: f64) -> Result<(), ReportError> {
        let Some(Timed { every, next, .. }) = self.history else { return Ok(()) };
        let time = self.time;
        let end = time + dt * (1.0 + BEHIND);
        if next > end {
            return Ok(());
        }
        let due = ((end - next) / every).floor();
        let last = due as u64;
        let instant = |i: u64| {
            let at = next + i as f64 * every - time;
            // The end of the step is known exactly, not what came shortly before it.
            if (at - dt).abs() < dt * BEHIND { dt } else { at }
        };
        let touching = self.courses.iter().filter_map(Course::contact);
        let busy = touching.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
        if let Some([from, to]) = busy {
            // Instants before the contact are passed over, not tried: there may be billions.
            let first = ((time + from - next) / every).floor() - 2.0;
            let near = (first.max(0.0) as u64..last)
                .map(instant)
                .skip_while(|&at| at < from - every)
                .take_while(|&at| at <= to + every);
            for at in near.take(ROWS) {
                self.row(bodies, at)?;
            }
        }
        self.row(bodies, instant(last))?;
        if let Some(history) = &mut self.history {
            history.next = next + (due + 1.0) * every;
        }
        Ok(())
    }

    /// A row `at` seconds into the step under way.
    fn row(&mut self, bodies: &Bodies, at: f64) -> Result<(), ReportError> {
        if self.history.is_none() {
            return Ok(());
        }
        let mut ledger = self.closed;
        let mut rows = Vec::with_capacity(self.courses.len());
        for (body, course) in self.courses.iter().enumerate() {
            let kept = course.at(at);
            ledger += kept.ledger;
            let mut state = kept.state;
            if kept.force == Vector3::zeros() && bodies.is_there(body) {
                // Between contacts and after the last one it flies on.
                state.position += state.velocity * (at - kept.time);
            }
            rows.push(BodyRow { state, force: kept.force });
        }
        let surfaces: Vec<_> = (0..self.volumes.len())
            .map(|surface| {
                let parts = self.courses.iter().map(|course| course.displaced(surface, at));
                let (volume, depth) = parts.fold((0.0, 0.0f64), |(v, d), (w, e)| (v + w, d.max(e)));
                SurfaceRow {
                    wear_volume: self.volumes[surface] + volume,
                    max_depth: self.depths[surface].max(depth),
                }
            })
            .collect();
        let carriers: Vec<_> = (0..self.carriers.len()).map(|s| self.carrier(s, at)).collect();
        let energies = self.energies.then(|| {
            let pairs = bodies.tracks.iter().zip(&rows);
            let own = pairs.map(|(track, row)| track.inertia.kinetic_energy(&row.state));
            let carried = bodies.carriers.iter().zip(&carriers);
            let carried = carried.filter_map(|(body, s)| Some((body.as_ref()?, s.as_ref()?)));
            let carried = carried.map(|(body, state)| body.kinetic_energy(state));
            energies(ledger, bodies, own.sum::<f64>() + carried.sum::<f64>())
        });
        let surfaces: Vec<_> =
            self.entries.iter().map(|entry| together(&surfaces, entry)).collect();
        let single = self.entries.iter().filter(|entry| !entry.is_copied);
        let carriers: Vec<_> = single.filter_map(|entry| carriers[entry.members[0]]).collect();
        let Some(history) = &mut self.history else { return Ok(()) };
        history.it.push(&Row {
            time: self.time + at,
            bodies: &rows,
            surfaces: &surfaces,
            carriers: &carriers,
            energies: energies.as_ref(),
        })
    }

    /// The body of a surface `at` seconds into the step under way: it flies on from the last
    /// contact step.
    fn carrier(&self, surface: usize, at: f64) -> Option<State> {
        let begun = (0.0, self.carriers[surface]?);
        let met = self.courses.iter().filter_map(|course| course.carrier(surface, at));
        let (time, mut state) = met.fold(begun, |a, b| if b.0 >= a.0 { b } else { a });
        state.position += state.velocity * (at - time);
        Some(state)
    }

    /// Closes the files and writes those of the end.
    pub(crate) fn finish(
        self,
        engine: &dyn Engine,
        bodies: &Bodies,
        summary: &Summary,
    ) -> Result<(), ReportError> {
        if let Some(history) = self.history {
            history.it.finish()?;
        }
        if let Some(predictions) = self.predictions {
            predictions.finish()?;
        }
        if let Some(mut frames) = self.frames
            && (frames.it.at_end || !frames.every.is_finite())
        {
            frames.it.write(engine, bodies, self.time)?;
        }
        let ending = Ending {
            folder: &self.folder,
            title: &self.title,
            entries: &self.entries,
            engine,
            bodies,
        };
        ending.write(&self.outputs, summary)
    }
}

/// Names of the surfaces that move; copies have no columns for their motion.
fn moving(built: &Built, entries: &[Entry]) -> Vec<String> {
    let moves = |entry: &&Entry| {
        !entry.is_copied && built.surfaces.get(&entry.name).is_some_and(|s| s.carrier.is_some())
    };
    entries.iter().filter(moves).map(|entry| entry.name.clone()).collect()
}

/// The row of an entry: of copies the sum of their volumes and the largest depth.
fn together(surfaces: &[SurfaceRow], entry: &Entry) -> SurfaceRow {
    let members = entry.members.iter().map(|&index| surfaces[index]);
    let none = SurfaceRow { wear_volume: 0.0, max_depth: 0.0 };
    members.fold(none, |sum, row| SurfaceRow {
        wear_volume: sum.wear_volume + row.wear_volume,
        max_depth: sum.max_depth.max(row.max_depth),
    })
}

/// Passes contact steps to the recordings and to what the run remembers of its bodies.
pub(crate) struct Watcher<'a> {
    recorder: &'a mut Recorder,
    bodies: &'a mut Bodies,
    /// Volumes when the present body's turn came, and the body.
    before: Vec<f64>,
    body: usize,
}

impl Watch for Watcher<'_> {
    fn looks_at(&self, body: usize) -> bool {
        self.recorder.history.is_some()
            || self.bodies.tracks[body].learns()
            || self.bodies.awaits_touch(body)
    }

    fn watches(&self) -> bool {
        self.recorder.history.is_some()
            || self.bodies.touches.is_some()
            || self.bodies.present().any(Track::learns)
    }

    fn sample(&mut self, sample: &Sample<'_>) {
        self.bodies.see(sample, self.recorder.time);
        if self.recorder.history.is_none() {
            return;
        }
        if sample.body != self.body {
            self.body = sample.body;
            for (surface, before) in self.before.iter_mut().enumerate() {
                let courses = self.recorder.courses.iter();
                let gained: f64 =
                    courses.map(|course| course.displaced(surface, f64::INFINITY).0).sum();
                *before = self.recorder.volumes[surface] + gained;
            }
        }
        self.recorder.courses[sample.body].push(sample, &self.before);
    }
}
