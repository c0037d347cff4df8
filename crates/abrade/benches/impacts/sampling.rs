//! How long criterion looks at a bench of this crate.

use std::time::Duration;

use criterion::Criterion;

/// Criterion with `samples` of each function, taken in about so many `seconds`.
pub fn criterion(seconds: u64, samples: usize) -> Criterion {
    Criterion::default()
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(seconds))
        .sample_size(samples)
        .configure_from_args()
}
