//! What a study found: its cases with estimates, ratios to the reference, exponents of speed, and the
//! shapes of its grains.

use super::case::{Case, Made};
use super::descriptors::Descriptors;
use super::file::{Samples, StudyFile};
use super::impact::Impact;
use super::quantities::{ALL, Quantity, REMOVED, WEAR};
use super::sensitivity::{Sensitivity, sensitivities};
use super::statistics::Estimate;

/// Debris over displaced volume of the reference below which it has none to speak of.
const LEAST: f64 = 1e-6;

/// What a study found.
#[derive(Clone, Debug, PartialEq)]
pub struct Erosion {
    /// The study.
    pub file: StudyFile,
    /// Its cases, in the order of their numbers; those that were made.
    pub cases: Vec<CaseResult>,
    /// The shapes of the grains that have a case, by name, in the order of the study.
    pub grains: Vec<(String, Descriptors)>,
    /// How wear goes with speed, per grain and angle; empty of studies at one speed.
    pub exponents: Vec<Exponent>,
    /// What the debris hangs on.
    pub sensitivities: Vec<Sensitivity>,
}

/// What a case found.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseResult {
    /// The case.
    pub case: Case,
    /// Impacts with a result.
    pub impacts: usize,
    /// Impacts without one, and why the first of them has none.
    pub missed: Option<(usize, String)>,
    /// Pitch of its plate [m].
    pub pitch: f64,
    /// One estimate per quantity, in the order of the columns of `cases.csv`; see [`CaseResult::quantity`].
    pub(crate) quantities: Vec<Estimate>,
    /// Displaced volume per mass over that of the reference; None where that is missing.
    pub wear_ratio: Option<Estimate>,
    /// Debris per mass over that of the reference; None where that is missing or leaves none.
    pub removed_ratio: Option<Estimate>,
}

impl CaseResult {
    /// True where the interval of the displaced volume is still wider than the study asks for.
    pub fn is_wide(&self, samples: &Samples) -> bool {
        self.impacts > 0 && self.quantity("wear_mm3_per_kg").relative() > samples.interval
    }
}

/// How the displaced volume per impact goes with speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Exponent {
    /// Name of the grain.
    pub grain: String,
    /// Angle from the surface [rad].
    pub angle: f64,
    /// The exponent [-].
    pub wear: Estimate,
}

impl Erosion {
    /// What the cases that were `made` tell.
    pub(crate) fn of(
        file: &StudyFile,
        made: &[(Case, Made)],
        grains: Vec<(String, Descriptors)>,
    ) -> Self {
        let hits: Vec<Vec<Impact>> = made.iter().map(|(_, made)| hits(made)).collect();
        let find = |grain: &str, speed: f64, angle: f64| {
            made.iter().position(|(case, _)| case.is(grain, speed, angle))
        };
        let result = |(at, (case, case_made)): (usize, &(Case, Made))| {
            let reference = file.reference.as_deref();
            let reference = reference.and_then(|name| find(name, case.speed, case.angle));
            let with = |quantity: &Quantity| {
                let other = reference?;
                // Debris of a sphere at right angles is a node or none: nothing to divide by.
                let has_some =
                    quantity.of(&hits[other]).value > LEAST * WEAR.of(&hits[other]).value;
                let ratio = has_some.then(|| quantity.ratio(case_made, &made[other].1))?;
                ratio.value.is_finite().then_some(ratio)
            };
            let misses: Vec<&String> =
                case_made.impacts.iter().filter_map(|impact| impact.as_ref().err()).collect();
            CaseResult {
                case: case.clone(),
                impacts: hits[at].len(),
                missed: misses.first().map(|first| (misses.len(), (*first).clone())),
                pitch: case_made.pitch,
                quantities: ALL.iter().map(|quantity| quantity.of(&hits[at])).collect(),
                wear_ratio: with(&WEAR),
                removed_ratio: with(&REMOVED),
            }
        };
        let cases: Vec<CaseResult> = made.iter().enumerate().map(result).collect();
        let mut exponents = Vec::new();
        for grain in file.grains.keys() {
            for &angle in &file.angles {
                let at: Vec<usize> =
                    file.speeds.iter().filter_map(|&speed| find(grain, speed, angle)).collect();
                if at.len() > 1 && at.len() == file.speeds.len() {
                    let cases: Vec<&Made> = at.iter().map(|&at| &made[at].1).collect();
                    let wear = WEAR.exponent(&file.speeds, &cases);
                    if wear.value.is_finite() {
                        exponents.push(Exponent { grain: grain.clone(), angle, wear });
                    }
                }
            }
        }
        let sensitivities = sensitivities(file, made);
        Self { file: file.clone(), cases, grains, exponents, sensitivities }
    }

    /// Number of cases that were not made.
    pub fn missing(&self) -> usize {
        self.file.cases().len() - self.cases.len()
    }
}

impl CaseResult {
    /// The estimate of the quantity `name`.
    ///
    /// # Panics
    /// There is no such quantity.
    pub fn quantity(&self, name: &str) -> Estimate {
        let at = ALL.iter().position(|quantity| quantity.name == name);
        self.quantities[at.expect("a quantity of the list")]
    }
}

/// The impacts that have a result.
fn hits(made: &Made) -> Vec<Impact> {
    made.impacts.iter().flatten().copied().collect()
}
