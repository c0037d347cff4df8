//! A case that is under way: its impacts so far and the depths of its plate, kept in a file of its own from
//! time to time and where the user breaks it off. A study goes on there, with the bits of one that nobody broke
//! off.

use std::time::{Duration, Instant};

use abrade::{Changes, Surface};
use abrade_report::ReportError;
use abrade_scene::Progress;

use super::case::{Case, Impacts, contact_time, share};
use super::file::StudyFile;
use super::store::Store;

/// Time between two files of a case, and what it is at least in times that the last one took to write.
const EVERY: Duration = Duration::from_secs(5);
const OVER_WRITING: u32 = 20;

/// What a case has come to.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Begun {
    /// Pitch of the plate [m].
    pub(crate) pitch: f64,
    pub(crate) impacts: Impacts,
    /// Worn nodes of the plate and their depths [m].
    pub(crate) depths: Vec<(u32, f64)>,
}

impl Begun {
    fn of(impacts: &Impacts, plate: &Surface) -> Self {
        let depths = (0..).zip(&plate.nodes().depth).map(|(id, depth)| (id, *depth));
        Self {
            pitch: plate.pitch(),
            impacts: impacts.clone(),
            depths: depths.filter(|(_, depth)| *depth > 0.0).collect(),
        }
    }

    /// The plate, of one that is unworn; None for depths that it cannot have.
    pub(crate) fn plate(&self, unworn: &Surface) -> Option<Surface> {
        let count = unworn.nodes().len();
        let is_depth = |(id, depth): &(u32, f64)| (*id as usize) < count && *depth > 0.0;
        let fits = self.pitch == unworn.pitch() && self.depths.iter().all(is_depth);
        fits.then(|| {
            let mut plate = unworn.clone();
            plate.apply(&Changes::to_depths(self.depths.clone()));
            plate
        })
    }
}

/// Tells how far a case is, and keeps it.
pub(crate) struct Watch<'a> {
    progress: &'a mut dyn Progress,
    store: &'a Store,
    case: &'a Case,
    due: Instant,
    /// Why it could not be kept.
    pub(crate) error: Option<ReportError>,
}

impl<'a> Watch<'a> {
    pub(crate) fn new(progress: &'a mut dyn Progress, store: &'a Store, case: &'a Case) -> Self {
        Self { progress, store, case, due: Instant::now() + EVERY, error: None }
    }

    /// False where the case is to be broken off after these `impacts`, which have worn the `plate`.
    pub(crate) fn goes_on(&mut self, file: &StudyFile, impacts: &Impacts, plate: &Surface) -> bool {
        let goes_on = self.progress.advance(contact_time(impacts), Some(share(file, impacts)));
        let began = Instant::now();
        if goes_on && began < self.due {
            return true;
        }
        let kept = self.store.keep(self.case, &Begun::of(impacts, plate));
        self.due = Instant::now() + EVERY.max(began.elapsed() * OVER_WRITING);
        self.error = kept.err();
        goes_on && self.error.is_none()
    }
}
