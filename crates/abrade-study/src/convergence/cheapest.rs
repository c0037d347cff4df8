//! The settings to take.

use crate::convergence::compare::Curve;
use crate::convergence::ladder::{Rung, Variant};

/// Errors that a setting is named for [-].
const TARGETS: [f64; 3] = [1e-2, 1e-3, 1e-4];

/// The cheapest setting for an error.
#[derive(Clone, Debug, PartialEq)]
pub struct Cheapest {
    /// Error of the wear volume that is allowed [-].
    pub target: f64,
    /// What was varied, the setting, its wall time [s] and its error [-]; none where no setting of
    /// the study is as close.
    pub setting: Option<(Variant, Rung, f64, f64)>,
}

/// The cheapest settings of `curves` for a hundredth, a thousandth and a ten-thousandth. A setting
/// counts only where every dearer one of its curve is as close: an error that is small by chance is
/// none.
pub(crate) fn cheapest(curves: &[Curve]) -> Vec<Cheapest> {
    TARGETS.iter().map(|&target| Cheapest { target, setting: below(curves, target) }).collect()
}

fn below(curves: &[Curve], target: f64) -> Option<(Variant, Rung, f64, f64)> {
    let refining = curves.iter().filter(|curve| curve.variant.refines());
    let lasting = refining.flat_map(|curve| {
        let close = |total: Option<f64>| total.is_some_and(|total| total <= target);
        let last = curve.rows.iter().rposition(|row| row.failure.is_none() && !close(row.total));
        let rows = curve.rows.iter().skip(last.map_or(0, |last| last + 1));
        rows.filter_map(move |row| {
            let total = row.total.filter(|_| row.failure.is_none())?;
            Some((curve.variant, row.rung.clone(), row.wall, total))
        })
    });
    lasting.min_by(|a, b| a.2.total_cmp(&b.2))
}
