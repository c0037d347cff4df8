//! The cases of a study: one grain at one speed and angle each, with as many impacts as it takes. A case
//! depends on nothing but the study's file, so that cases can be made in any order, anywhere.

use std::path::Path;
use std::sync::Arc;

use abrade::{HexStrip, Surface, SurfaceError, SurfaceLaws};
use abrade_scene::scene::Form;
use abrade_scene::{GrainError, GrainSize, MadeGrain, Progress};
use rayon::prelude::*;

use super::file::{Plate, Size, StudyFile};
use super::impact::{Impact, Miss, Shot};
use super::sample::Sample;
use super::statistics::{self, Estimate};

/// Half the edge of a fresh plate, in lengths of the grain.
const REACH: f64 = 6.0;
/// Impacts on a worn plate between two looks at the user's wish to stop.
const STRETCH: u32 = 64;

/// A case.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// Its number, from 0.
    pub number: usize,
    /// Name of its grain.
    pub grain: String,
    /// Speed [m/s].
    pub speed: f64,
    /// Angle from the surface [rad].
    pub angle: f64,
}

/// A case that was made.
#[derive(Clone, Debug, PartialEq)]
pub struct Made {
    /// Pitch of the plate [m].
    pub pitch: f64,
    /// What each impact did; of those that have no result, why not.
    pub impacts: Vec<Result<Impact, String>>,
}

impl StudyFile {
    /// All cases, in the order of their numbers: grain by grain, in each speed by speed.
    pub fn cases(&self) -> Vec<Case> {
        let mut cases = Vec::new();
        for grain in self.grains.keys() {
            for &speed in &self.speeds {
                for &angle in &self.angles {
                    cases.push(Case { number: cases.len(), grain: grain.clone(), speed, angle });
                }
            }
        }
        cases
    }

    /// Files that the study names.
    pub(crate) fn files(&self) -> impl Iterator<Item = &str> {
        self.grains.values().filter_map(|grain| match &grain.form {
            Form::Mesh { file } | Form::Clump { file } => Some(file.as_str()),
            _ => None,
        })
    }

    /// The grain of this `name` that meets sample `k`.
    pub(crate) fn grain(&self, name: &str, k: u32, folder: &Path) -> Result<MadeGrain, GrainError> {
        let factor = (self.size.spread() * self.samples.at(k).deviate).exp();
        self.grain_of_size(name, k, factor, folder)
    }

    /// The grain of this `name` that meets sample `k`, were it of the median size.
    pub(crate) fn grain_of_median_size(
        &self,
        name: &str,
        k: u32,
        folder: &Path,
    ) -> Result<MadeGrain, GrainError> {
        self.grain_of_size(name, k, 1.0, folder)
    }

    fn grain_of_size(
        &self,
        name: &str,
        k: u32,
        factor: f64,
        folder: &Path,
    ) -> Result<MadeGrain, GrainError> {
        let size = match self.size {
            Size::Volume { diameter, .. } => GrainSize::Volume(diameter * factor),
            Size::Feret { diameter, .. } => GrainSize::Feret(diameter * factor),
        };
        self.grains[name].make(size, self.density, self.samples.grain_seed(k), folder)
    }
}

/// What all impacts of a case have in common.
pub(crate) struct Range<'a> {
    file: &'a StudyFile,
    folder: &'a Path,
    case: &'a Case,
    /// The grain, where all impacts meet the same one.
    grain: Option<MadeGrain>,
    /// The plate, unworn.
    pub(crate) plate: Arc<Surface>,
}

impl Case {
    /// Makes the impacts of the case; None where the user broke it off.
    ///
    /// # Errors
    /// The grain or the plate cannot be made.
    pub fn make(
        &self,
        file: &StudyFile,
        folder: &Path,
        progress: &mut dyn Progress,
    ) -> Result<Option<Made>, CaseError> {
        let range = Range::new(file, folder, self)?;
        let impacts = match file.plate {
            Plate::Fresh => range.fresh(progress)?,
            Plate::Worn { width } => range.worn(width, progress)?,
        };
        Ok(impacts.map(|impacts| Made { pitch: range.plate.pitch(), impacts }))
    }
}

impl<'a> Range<'a> {
    pub(crate) fn new(
        file: &'a StudyFile,
        folder: &'a Path,
        case: &'a Case,
    ) -> Result<Self, CaseError> {
        let median = file.grain_of_median_size(&case.grain, 0, folder)?;
        let pitch = file.pitch(&median, case.speed);
        let plate = Arc::new(file.plate(&median, pitch)?);
        let is_one = file.size.spread() == 0.0
            && !matches!(file.grains[&case.grain].form, Form::Grit { .. });
        Ok(Self { file, folder, case, grain: is_one.then_some(median), plate })
    }
}

impl Range<'_> {
    /// Impacts on fresh plates, some at a time, until the interval is narrow enough.
    fn fresh(&self, progress: &mut dyn Progress) -> Result<Option<Impacts>, CaseError> {
        let samples = &self.file.samples;
        let mut impacts = Impacts::new();
        while wants_more(self.file, &impacts) {
            let from = impacts.len() as u32;
            let to = (from + samples.least).min(samples.most);
            let next: Result<Vec<_>, CaseError> = (from..to)
                .into_par_iter()
                .map(|k| self.land(k, [0.0; 2], &mut Surface::leaf(&self.plate)))
                .collect();
            impacts.extend(next?);
            if !progress.advance(contact_time(&impacts), share(self.file, &impacts)) {
                return Ok(None);
            }
        }
        Ok(Some(impacts))
    }

    /// Impacts one after the other on one plate.
    fn worn(&self, width: f64, progress: &mut dyn Progress) -> Result<Option<Impacts>, CaseError> {
        let samples = &self.file.samples;
        let mut plate = Surface::clone(&self.plate);
        let mut impacts = Impacts::new();
        while wants_more(self.file, &impacts) {
            let to = (impacts.len() as u32 + STRETCH).min(samples.most);
            for k in impacts.len() as u32..to {
                let place = samples.at(k).place.map(|share| (share - 0.5) * width);
                impacts.push(self.land(k, place, &mut plate)?);
            }
            if !progress.advance(contact_time(&impacts), share(self.file, &impacts)) {
                return Ok(None);
            }
        }
        Ok(Some(impacts))
    }

    /// Impact `k`, about the place `about` of `plate`.
    pub(crate) fn land(
        &self,
        k: u32,
        about: [f64; 2],
        plate: &mut Surface,
    ) -> Result<Result<Impact, String>, CaseError> {
        let Self { file, folder, case, .. } = self;
        let sample: Sample = file.samples.at(k);
        let own;
        let grain = match &self.grain {
            Some(grain) => grain,
            None => {
                own = file.grain(&case.grain, k, folder)?;
                &own
            }
        };
        let pitch = self.plate.pitch();
        let cell = [3f64.sqrt() * pitch, pitch];
        let at = [0, 1].map(|a| about[a] + sample.place[a] * cell[a]);
        let Case { speed, angle, .. } = **case;
        let shot = Shot { grain, sample: &sample, at, speed, angle, accuracy: file.accuracy };
        Ok(shot.land(plate).map_err(|miss: Miss| miss.to_string()))
    }
}

/// What impacts did, in their order.
pub(crate) type Impacts = Vec<Result<Impact, String>>;

/// A case that cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CaseError {
    /// Its grain.
    #[error(transparent)]
    Grain(#[from] GrainError),
    /// Its plate.
    #[error(transparent)]
    Plate(#[from] SurfaceError),
}

/// The volume displaced per mass of grains [m3/kg].
pub(crate) fn wear_per_mass<'a>(impacts: impl IntoIterator<Item = &'a Impact>) -> Estimate {
    let rows: Vec<[f64; 2]> =
        impacts.into_iter().map(|impact| [impact.wear_volume_m3, impact.mass_kg]).collect();
    statistics::estimate(&rows, |sums| sums[0] / sums[1])
}

fn wants_more(file: &StudyFile, impacts: &Impacts) -> bool {
    let samples = &file.samples;
    let count = impacts.len() as u32;
    let is_wide = || wear_per_mass(impacts.iter().flatten()).relative() > samples.interval;
    count < samples.most && (count < samples.least || is_wide())
}

/// How much of a case is done, as far as one can tell from how its interval narrows.
fn share(file: &StudyFile, impacts: &Impacts) -> Option<f64> {
    let samples = &file.samples;
    let wide = wear_per_mass(impacts.iter().flatten()).relative() / samples.interval;
    let count = impacts.len() as f64;
    let needed = (count * wide * wide).clamp(f64::from(samples.least), f64::from(samples.most));
    Some((count / needed).min(1.0))
}

fn contact_time(impacts: &Impacts) -> f64 {
    impacts.iter().flatten().map(|impact| impact.contact_s).sum()
}

impl StudyFile {
    /// Pitch of the plate that `median` strikes at this `speed` [m].
    fn pitch(&self, median: &MadeGrain, speed: f64) -> f64 {
        let energy = 0.5 * median.solid.inertia.mass * speed * speed;
        (energy / self.target.material.hardness).cbrt() / self.resolution
    }

    /// The plate, unworn.
    fn plate(&self, median: &MadeGrain, pitch: f64) -> Result<Surface, SurfaceError> {
        let largest = median.feret * (2.5 * self.size.spread()).exp();
        let spread = match self.plate {
            Plate::Fresh => 0.0,
            Plate::Worn { width } => width,
        };
        let edge = spread + 2.0 * REACH * largest;
        let strip = HexStrip { length: edge, width: edge, pitch, rest_area: None };
        let target = &self.target;
        let laws = SurfaceLaws {
            elastic: target.elastic.clone(),
            flow: target.flow.clone(),
            removal: target.removal.clone(),
            ..SurfaceLaws::of(target.material.clone())
        };
        Surface::hex_strip(strip, laws)
    }
}
