//! The runs' own estimates of their errors, beside the errors.

use crate::convergence::compare::{Curve, Row};
use crate::convergence::fit::ROUND_OFF;
use crate::convergence::ladder::Variant;

/// Factor within which an estimate tells an error.
const FACTOR: f64 = 3.0;

/// How well the estimates of a study's runs told their errors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Told {
    /// Settings with an estimate and an error that is known.
    pub of: usize,
    /// Those whose error is within a factor of 3 of its estimate.
    pub within: usize,
    /// Those whose error is no more than 3 times its estimate.
    pub below: usize,
}

/// Of the errors by time, on the curve of accuracies, and by pitch, on that of pitches.
pub(crate) fn told(curves: &[Curve]) -> [Told; 2] {
    [(Variant::Accuracy, 0), (Variant::Pitch, 1)].map(|(variant, which)| {
        let curves = curves.iter().filter(|curve| curve.variant == variant);
        let rows = curves.flat_map(|curve| &curve.rows).filter(|row| row.is_fitted);
        let ratios = rows.filter_map(|row| ratio(row, which));
        ratios.fold(Told::default(), |told, ratio| Told {
            of: told.of + 1,
            within: told.within + usize::from((1.0 / FACTOR..=FACTOR).contains(&ratio)),
            below: told.below + usize::from(ratio <= FACTOR),
        })
    })
}

/// Error over estimate; none for an error that is rounding.
fn ratio(row: &Row, which: usize) -> Option<f64> {
    let error = row.errors.wear.filter(|error| *error > ROUND_OFF)?;
    let estimate = row.estimates[which].filter(|estimate| *estimate > 0.0)?;
    Some(error / estimate)
}

impl Told {
    /// In words; empty where there is nothing to tell.
    pub(crate) fn words(&self, name: &str) -> String {
        let Self { of, within, below } = self;
        match of {
            0 => String::new(),
            _ => format!(
                "the runs' own estimates of the error by {name}: {within} of {of} within a factor \
                 of {FACTOR}, {below} no less than a third of it\n"
            ),
        }
    }
}
