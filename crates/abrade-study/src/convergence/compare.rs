//! From runs to errors.

use crate::convergence::fit;
use crate::convergence::ladder::{Against, Ladder, Rung, Variant};
use crate::convergence::measure::Measured;
use crate::convergence::quantities::{Errors, Quantities};
use crate::convergence::references::References;

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
    /// Number of landings.
    pub landings: usize,
    /// Least wall time of a run [s].
    pub wall: f64,
    /// Mean number of accepted steps of a run.
    pub steps: f64,
    /// Mean number of nodes taken through the law.
    pub node_evaluations: f64,
    /// Means over the landings.
    pub mean: Quantities,
    /// Root mean squares over the landings against the curve's own reference, or against results
    /// from elsewhere.
    pub errors: Errors,
    /// Error of the wear volume against the reference of the whole study [-].
    pub total: Option<f64>,
    /// The runs' own estimates of their errors by time and by pitch [-].
    pub estimates: [Option<f64>; 2],
    /// True for a run that tells of the order: not the reference, nor next to it.
    pub is_fitted: bool,
    /// True for one that the reference of the whole study tells about.
    pub is_judged: bool,
    /// Why the scene could not be run so.
    pub failure: Option<String>,
}

impl Curve {
    pub(crate) fn new(ladder: &Ladder, runs: &[Measured], references: &References<'_>) -> Self {
        let pairs = ladder.rungs.iter().zip(runs);
        let rows: Vec<Row> = pairs.map(|(rung, run)| row(ladder, rung, run, references)).collect();
        let points = |of: &dyn Fn(&Row) -> f64| {
            let fitted = rows.iter().filter(|row| row.is_fitted && ladder.variant.refines());
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

fn row(ladder: &Ladder, rung: &Rung, run: &Measured, references: &References<'_>) -> Row {
    let whole = &references.whole;
    let own = references.of(ladder, rung);
    // Where nodes lie elsewhere, landings have only their mean in common.
    let moved = matches!(ladder.variant, Variant::Pitch | Variant::Both);
    let errors = match (references.are_given(), own) {
        (true, _) => of_landings(run, |_| whole.clone(), whole),
        (false, None) => Errors::default(),
        (false, Some((_, reference))) => {
            let mean = Quantities::mean(&reference.landings);
            let pair = |landing: usize| match reference.landings.get(landing) {
                Some(same) if !moved => same.clone(),
                _ => mean.clone(),
            };
            of_landings(run, pair, &mean)
        }
    };
    let place = |of: &Rung| ladder.rungs.iter().position(|other| other == of);
    let is_close = own.is_some_and(|(reference, _)| {
        let ratio = rung.value / reference.value;
        let is_next = place(rung).map(|at| at + 1) == place(reference);
        let is_near = is_next || ratio.max(1.0 / ratio) < CLOSE;
        reference == rung || ladder.against == Against::Finest && is_near
    });
    Row {
        rung: rung.clone(),
        landings: run.landings.len(),
        wall: run.wall,
        steps: run.steps,
        node_evaluations: run.node_evaluations,
        mean: Quantities::mean(&run.landings),
        errors: if run.is_done() { errors } else { Errors::default() },
        total: of_landings(run, |_| whole.clone(), whole).wear.filter(|_| run.is_done()),
        estimates: run.estimates,
        is_fitted: run.is_done() && (references.are_given() || !is_close),
        is_judged: run.is_done() && references.tell_of(rung),
        failure: run.failure.clone(),
    }
}

/// Root mean squares over the landings of a run, each against its `reference`, relative to `scale`.
fn of_landings(
    run: &Measured,
    reference: impl Fn(usize) -> Quantities,
    scale: &Quantities,
) -> Errors {
    let landings = run.landings.iter().enumerate();
    let errors = landings.map(|(landing, own)| Errors::between(own, &reference(landing), scale));
    Errors::rms(&errors.collect::<Vec<_>>())
}
