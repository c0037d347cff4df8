//! The cases of a study: one grain at one speed and angle each, with as many impacts as it takes. A case
//! depends on no other one, so that cases can be made in any order, anywhere.

use std::path::Path;
use std::sync::Arc;

use abrade::{Changes, HexStrip, Surface, SurfaceError};
use abrade_report::quantity_text::digits;
use abrade_scene::scene::Form;
use abrade_scene::{GrainError, GrainSize, MadeGrain};
use nalgebra::Point3;
use rayon::prelude::*;

use super::begun::{Begun, Watch};
use super::file::{Plate, Size, StudyFile};
use super::impact::{Impact, Landed, Miss, Shot};
use super::sample::{CUT, Sample};
use super::statistics::{self, Estimate};

/// Half the edge of a fresh plate, in lengths of the grain.
const REACH: f64 = 6.0;
/// Impacts on a worn plate that are made beside each other; their number, so that results do not depend on
/// that of the threads.
const BESIDE: u32 = 8;
/// Impacts between two looks at the user's wish to stop.
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

impl Case {
    /// True for the case of this grain, speed and angle.
    pub(crate) fn is(&self, grain: &str, speed: f64, angle: f64) -> bool {
        self.grain == grain && self.speed == speed && self.angle == angle
    }
}

/// A case that could not be made, and why.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("case {}, {} at {} m/s and {} deg: {error}", .case.number, .case.grain, digits(.case.speed), digits(.case.angle.to_degrees()))]
pub struct Unmade {
    /// The case.
    pub case: Case,
    /// Why not.
    pub error: CaseError,
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
    /// Makes the impacts of the case, or those that are missing from what has `begun`; None where it was
    /// broken off.
    ///
    /// # Errors
    /// The grain or the plate cannot be made.
    pub(crate) fn make(
        &self,
        file: &StudyFile,
        folder: &Path,
        begun: Option<Begun>,
        watch: &mut Watch<'_>,
    ) -> Result<Option<Made>, CaseError> {
        let range = Range::new(file, folder, self)?;
        let begun = begun.and_then(|begun| Some((begun.plate(&range.plate)?, begun.impacts)));
        let (plate, impacts) =
            begun.unwrap_or_else(|| (Surface::clone(&range.plate), Impacts::new()));
        let impacts = match file.plate {
            Plate::Fresh => range.fresh(impacts, watch)?,
            Plate::Worn { .. } => range.worn(plate, impacts, watch)?,
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
        let strip = file.strip(&median, case.speed);
        let plate = Arc::new(Surface::hex_strip(strip, file.target.laws())?);
        let is_one = file.size.spread() == 0.0
            && !matches!(file.grains[&case.grain].form, Form::Grit { .. });
        Ok(Self { file, folder, case, grain: is_one.then_some(median), plate })
    }
}

impl Range<'_> {
    /// Impacts on fresh plates, some at a time, until the interval is narrow enough.
    fn fresh(
        &self,
        mut impacts: Impacts,
        watch: &mut Watch<'_>,
    ) -> Result<Option<Impacts>, CaseError> {
        let samples = &self.file.samples;
        // Those that are there may end between two looks at the interval.
        while self.is_between(&impacts) || wants_more(self.file, &impacts) {
            let from = impacts.len() as u32;
            let end = ((from / samples.least + 1) * samples.least).min(samples.most);
            let landed = self.land_some(from..(from + STRETCH).min(end), &self.plate)?;
            impacts.extend(landed.into_iter().map(|landed| told(landed.outcome).0));
            if !watch.goes_on(self.file, &impacts, &self.plate) {
                return Ok(None);
            }
        }
        Ok(Some(impacts))
    }

    /// True while no one asks how wide the interval is.
    fn is_between(&self, impacts: &Impacts) -> bool {
        let (samples, count) = (&self.file.samples, impacts.len() as u32);
        !count.is_multiple_of(samples.least) && count < samples.most
    }

    /// Impacts one after the other on one plate: some at a time, each as if those beside it had not been.
    /// Those that may have looked at what one before them has changed are made again, so that the result is
    /// that of one after the other.
    fn worn(
        &self,
        plate: Surface,
        mut impacts: Impacts,
        watch: &mut Watch<'_>,
    ) -> Result<Option<Impacts>, CaseError> {
        let samples = &self.file.samples;
        let mut plate = Arc::new(plate);
        while wants_more(self.file, &impacts) {
            let end = (impacts.len() as u32 + STRETCH).min(samples.most);
            while (impacts.len() as u32) < end {
                self.some_more(end, &mut plate, &mut impacts)?;
            }
            if !watch.goes_on(self.file, &impacts, &plate) {
                return Ok(None);
            }
        }
        Ok(Some(impacts))
    }

    /// The next few impacts on `plate`, up to `end`.
    fn some_more(
        &self,
        end: u32,
        plate: &mut Arc<Surface>,
        impacts: &mut Impacts,
    ) -> Result<(), CaseError> {
        let from = impacts.len() as u32;
        let to = (from + BESIDE).min(end);
        let landed = self.land_some(from..to, plate)?;
        let mut changed: Vec<[Point3<f64>; 2]> = Vec::new();
        for (k, landed) in (from..to).zip(landed) {
            let is_stale = changed.iter().any(|part| overlap(part, &landed.seen));
            let landed = if is_stale { self.land(k, plate)? } else { landed };
            let (impact, changes) = told(landed.outcome);
            if let Some(changes) = changes {
                // No leaf of it is left: this copies nothing.
                let plate = Arc::make_mut(plate);
                changed.extend(changes.bounds(plate.nodes()));
                plate.apply(&changes);
            }
            impacts.push(impact);
        }
        Ok(())
    }

    /// The impacts `samples`, each on a leaf of `plate`.
    fn land_some(
        &self,
        samples: std::ops::Range<u32>,
        plate: &Arc<Surface>,
    ) -> Result<Vec<Landed>, CaseError> {
        samples.into_par_iter().map(|k| self.land(k, plate)).collect()
    }

    /// Impact `k` on a leaf of `plate`.
    pub(crate) fn land(&self, k: u32, plate: &Arc<Surface>) -> Result<Landed, CaseError> {
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
        let pitch = plate.pitch();
        let area = match file.plate {
            Plate::Fresh => [3f64.sqrt() * pitch, pitch],
            Plate::Worn { width } => [width; 2],
        };
        let at = [0, 1].map(|a| (sample.place[a] - 0.5) * area[a]);
        let Case { speed, angle, .. } = **case;
        let shot = Shot { grain, sample: &sample, at, speed, angle, accuracy: file.accuracy };
        Ok(shot.land(plate))
    }
}

/// An impact, or why it has no result, and what it changed.
fn told(outcome: Result<(Impact, Changes), Miss>) -> (Result<Impact, String>, Option<Changes>) {
    match outcome {
        Ok((impact, changes)) => (Ok(impact), Some(changes)),
        Err(miss) => (Err(miss.to_string()), None),
    }
}

/// True where a box has a part in a part of the plate.
fn overlap([low, high]: &[Point3<f64>; 2], [least, most]: &[[f64; 2]; 2]) -> bool {
    (0..2).all(|axis| low[axis] <= most[axis] && least[axis] <= high[axis])
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
    statistics::estimate(&rows, rows.len(), |sums| sums[0] / sums[1])
}

/// True while the interval is too wide. A case whose first impacts all have no result is given up: its
/// value is not a number, and no interval of it is wide.
fn wants_more(file: &StudyFile, impacts: &Impacts) -> bool {
    let samples = &file.samples;
    let count = impacts.len() as u32;
    let is_wide = || wear_per_mass(impacts.iter().flatten()).relative() > samples.interval;
    count < samples.most && (count < samples.least || is_wide())
}

/// How much of a case is done, as far as one can tell from how its interval narrows.
pub(crate) fn share(file: &StudyFile, impacts: &Impacts) -> f64 {
    let samples = &file.samples;
    let wide = wear_per_mass(impacts.iter().flatten()).relative() / samples.interval;
    let count = impacts.len() as f64;
    let needed = (count * wide * wide).max(f64::from(samples.least)).min(f64::from(samples.most));
    (count / needed).min(1.0)
}

pub(crate) fn contact_time(impacts: &Impacts) -> f64 {
    impacts.iter().flatten().map(|impact| impact.contact_s).sum()
}

impl StudyFile {
    /// Pitch of the plate that `median` strikes at this `speed` [m].
    fn pitch(&self, median: &MadeGrain, speed: f64) -> f64 {
        let energy = 0.5 * median.solid.inertia.mass * speed * speed;
        (energy / self.target.material.hardness).cbrt() / self.resolution
    }

    /// The plate that `median` strikes at this `speed` [m/s].
    pub(crate) fn strip(&self, median: &MadeGrain, speed: f64) -> HexStrip {
        let largest = median.feret * (CUT * self.size.spread()).exp();
        let spread = match self.plate {
            Plate::Fresh => 0.0,
            Plate::Worn { width } => width,
        };
        let edge = spread + 2.0 * REACH * largest;
        HexStrip { length: edge, width: edge, pitch: self.pitch(median, speed), rest_area: None }
    }
}

#[cfg(test)]
mod tests {
    use abrade_scene::Progress;

    use super::*;
    use crate::erosion::store::Store;

    struct Quiet;

    impl Progress for Quiet {
        fn advance(&mut self, _: f64, _: Option<f64>) -> bool {
            true
        }
    }

    /// Fails for impacts beside each other that do not see what those before them have changed, and for
    /// sums that depend on who made them.
    #[test]
    fn impacts_beside_each_other_give_the_bits_of_one_after_the_other() {
        let text = r#"(version: 1, name: "test", target: (material: (hardness: 1.7e9)),
            grains: { "grit": (form: Grit(points: 8)) }, density: 2650.0,
            size: Volume(diameter: 2e-4, spread: 0.2), speeds: [98.0], angles: ["30 deg"],
            plate: Worn(width: 1e-3), samples: (least: 80, most: 80), resolution: 3.0)"#;
        let kind = abrade_scene::FileKind { name: "study", version: 1 };
        let file = abrade_scene::Document::<StudyFile>::read("test", text.into(), &[], kind);
        let file = file.and_then(abrade_scene::Document::finish).expect("a study");
        let case = &file.cases()[0];
        let range = Range::new(&file, Path::new(""), case).expect("a plate");
        let folder = tempfile::tempdir().expect("a folder");
        let store = Store::new(&file, Path::new(""), folder.path());
        let (mut quiet, unworn) = (Quiet, Surface::clone(&range.plate));
        let mut watch = Watch::new(&mut quiet, &store, case);
        let beside = range.worn(unworn, Impacts::new(), &mut watch);
        let beside = beside.expect("impacts").expect("all of them");
        let mut plate = Surface::clone(&range.plate);
        let mut changed = 0;
        for (k, impact) in (0..).zip(&beside) {
            let fresh = told(range.land(k, &range.plate).expect("a grain").outcome).0;
            let shared = Arc::new(plate);
            let (alone, changes) = told(range.land(k, &shared).expect("a grain").outcome);
            plate = Arc::try_unwrap(shared).expect("no leaf is left");
            changes.iter().for_each(|changes| plate.apply(changes));
            assert_eq!(*impact, alone, "{k}");
            changed += usize::from(fresh != alone);
        }
        assert!(changed > 20, "{changed} of 80 met a crater");
    }
}
