//! When a trial step is rejected, and what is tried in its place.

use crate::trial::Trial;

/// A trial is rejected above this multiple of eta.
const REJECT: f64 = 1.5;
/// Share of the allowed step below which a jump of an overlap is taken as it is: where another
/// face carves a node, no step is short enough.
pub(crate) const OVERLAP_STEP: f64 = 1e-2;

/// A smaller step where the trial asks for one.
pub(crate) fn rejected(trial: &Trial, dt: f64, allowed: f64) -> Option<f64> {
    if trial.touching == 0 {
        None
    } else if dt > REJECT * allowed {
        Some(allowed.min(0.7 * dt))
    } else if trial.overlap_change > 1.0 && dt > OVERLAP_STEP * allowed {
        Some(dt * (0.8 / trial.overlap_change).max(0.1))
    } else {
        None
    }
}
