//! The settings to take.

use crate::convergence::compare::{Curve, Row};
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
/// counts only where every finer one of its curve is as close, for an error that is small by chance is
/// none, and where the reference tells about it.
pub(crate) fn cheapest(curves: &[Curve]) -> Vec<Cheapest> {
    TARGETS.iter().map(|&target| Cheapest { target, setting: below(curves, target) }).collect()
}

fn below(curves: &[Curve], target: f64) -> Option<(Variant, Rung, f64, f64)> {
    let refining = curves.iter().filter(|curve| curve.variant.refines());
    let lasting = refining.flat_map(|curve| {
        let judged: Vec<&Row> = curve.rows.iter().filter(|row| row.is_judged).collect();
        let close = |row: &&Row| row.total.is_some_and(|total| total <= target);
        let from = judged.iter().rposition(|row| !close(row)).map_or(0, |last| last + 1);
        let settings = judged.into_iter().skip(from);
        settings.filter_map(|row| Some((curve.variant, row.rung.clone(), row.wall, row.total?)))
    });
    lasting.min_by(|a, b| a.2.total_cmp(&b.2))
}
