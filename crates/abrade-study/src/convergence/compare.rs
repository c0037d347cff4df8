//! From runs to errors.

use crate::convergence::fit;
use crate::convergence::ladder::{Against, Ladder, Rung, Variant};
use crate::convergence::measure::{INTERRUPTED, Measured};
use crate::convergence::quantities::{Errors, Quantities};
use crate::error::StudyError;

/// Ratio to the reference's setting below which a run is no measure of the order: the reference is
/// hardly closer to the truth.
const CLOSE: f64 = 2.5;

/// The results at the settings of a ladder.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// What is varied.
    pub variant: Variant,
    /// From coarse to fine.
    pub rows: Vec<Row>,
    /// Number of settings that the budget left out.
    pub left_out: usize,
    /// Exponent of the wear volume's error over the number that is varied [-].
    pub order: Option<f64>,
    /// Exponent of the wear volume's error over the wall time [-].
    pub slope: Option<f64>,
}

/// The results at a setting.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The setting.
    pub rung: Rung,
    /// Least wall time of a run [s].
    pub wall: f64,
    /// Mean number of accepted steps of a run.
    pub steps: f64,
    /// Mean number of nodes taken through the law.
    pub node_evaluations: f64,
    /// Means over the landings.
    pub mean: Quantities,
    /// Root mean squares over the landings against the curve's own reference.
    pub errors: Errors,
    /// Error of the wear volume against the reference of the whole study [-].
    pub total: Option<f64>,
    /// The runs' own estimates of their errors by time and by pitch [-].
    pub estimates: [Option<f64>; 2],
    /// True for a run that tells of the order: not the reference, nor next to it.
    pub is_fitted: bool,
    /// Why the scene could not be run so.
    pub failure: Option<String>,
}

/// What errors are counted from.
pub(crate) struct References<'a> {
    climbed: &'a [(&'a Ladder, Vec<Measured>)],
    /// That of total errors.
    whole: Quantities,
    given: bool,
    words: String,
}

impl<'a> References<'a> {
    /// # Errors
    /// No run came to its end.
    pub fn new(
        climbed: &'a [(&'a Ladder, Vec<Measured>)],
        given: Option<(Quantities, String)>,
    ) -> Result<Self, StudyError> {
        let mut references =
            Self { climbed, whole: Quantities::default(), given: false, words: String::new() };
        let order = [Variant::Both, Variant::Pitch, Variant::Accuracy];
        let finest = order.iter().find_map(|&variant| references.finest(variant));
        let first = || climbed.iter().find_map(|(ladder, _)| references.finest(ladder.variant));
        match (given, finest.or_else(first)) {
            (Some((whole, words)), _) => {
                references.words = words;
                references.given = true;
                references.whole = whole;
            }
            (None, Some((rung, run))) => {
                references.whole = Quantities::mean(&run.landings);
                references.words = format!("the finest run, {}", rung.sets.join(" "));
            }
            (None, None) => {
                let failures = climbed.iter().flat_map(|(_, runs)| runs);
                let reason = failures.filter_map(|run| run.failure.clone()).next();
                return Err(match reason {
                    Some(reason) if reason != INTERRUPTED => StudyError::Nothing { reason },
                    _ => StudyError::Interrupted,
                });
            }
        }
        Ok(references)
    }

    pub fn words(&self) -> String {
        self.words.clone()
    }

    /// The finest run of a variant.
    fn finest(&self, variant: Variant) -> Option<(&'a Rung, &'a Measured)> {
        let (ladder, runs) = self.climbed.iter().find(|(ladder, _)| ladder.variant == variant)?;
        ladder.rungs.iter().zip(runs).rfind(|(_, run)| run.is_done())
    }

    /// What the runs of a ladder are compared with.
    fn of(&self, ladder: &Ladder) -> Option<(&'a Rung, &'a Measured)> {
        match ladder.against {
            Against::Finest => self.finest(ladder.variant),
            Against::Of(variant) => self.finest(variant).or_else(|| self.finest(ladder.variant)),
            Against::Scene => {
                let (ladder, runs) =
                    self.climbed.iter().find(|(other, _)| other.variant == ladder.variant)?;
                let mut pairs = ladder.rungs.iter().zip(runs);
                pairs.find(|(rung, run)| rung.value == 1.0 && run.is_done())
            }
        }
    }

    /// The reference of a landing: where nodes lie elsewhere, landings have only their mean in
    /// common.
    fn landing(&self, ladder: &Ladder, reference: &Measured, landing: usize) -> Quantities {
        let moved = matches!(ladder.variant, Variant::Pitch | Variant::Both);
        match reference.landings.get(landing) {
            _ if self.given => self.whole.clone(),
            Some(own) if !moved => own.clone(),
            _ => Quantities::mean(&reference.landings),
        }
    }
}

impl Curve {
    pub(crate) fn new(ladder: &Ladder, runs: &[Measured], references: &References<'_>) -> Self {
        let reference = references.of(ladder);
        let row = |(rung, run): (&Rung, &Measured)| {
            let errors = reference.map(|(_, reference)| {
                let scale = match references.given {
                    true => references.whole.clone(),
                    false => Quantities::mean(&reference.landings),
                };
                let pairs = run.landings.iter().enumerate();
                let errors = pairs.map(|(landing, own)| {
                    let reference = references.landing(ladder, reference, landing);
                    Errors::between(own, &reference, &scale)
                });
                Errors::rms(&errors.collect::<Vec<_>>())
            });
            let whole = &references.whole;
            let total = run.landings.iter().map(|own| Errors::between(own, whole, whole));
            let total: Vec<Errors> = total.collect();
            let is_close = |reference: &Rung| {
                let same = matches!(ladder.against, Against::Finest) && !references.given;
                let ratio = rung.value / reference.value;
                let is_reference = rung == reference && !references.given;
                is_reference || same && ratio.max(1.0 / ratio) < CLOSE
            };
            Row {
                rung: rung.clone(),
                wall: run.wall,
                steps: run.steps,
                node_evaluations: run.node_evaluations,
                mean: Quantities::mean(&run.landings),
                errors: errors.filter(|_| run.is_done()).unwrap_or_default(),
                total: Errors::rms(&total).wear.filter(|_| run.is_done()),
                estimates: run.estimates,
                is_fitted: run.is_done() && !reference.is_some_and(|(rung, _)| is_close(rung)),
                failure: run.failure.clone(),
            }
        };
        let rows: Vec<Row> = ladder.rungs.iter().zip(runs).map(row).collect();
        let points = |of: &dyn Fn(&Row) -> f64| {
            let fitted = rows.iter().filter(|row| row.is_fitted);
            fitted.filter_map(|row| Some([of(row), row.errors.wear?])).collect::<Vec<_>>()
        };
        Self {
            variant: ladder.variant,
            left_out: ladder.rungs.len() - runs.len(),
            order: fit::exponent(&points(&|row| row.rung.value)),
            slope: fit::exponent(&points(&|row| row.wall)),
            rows,
        }
    }
}
