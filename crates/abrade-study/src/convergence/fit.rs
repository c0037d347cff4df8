//! Exponents of power laws.

/// Error below which rounding is all that is left [-].
pub(crate) const ROUND_OFF: f64 = 1e-12;
/// Points that an exponent takes at least.
const POINTS: usize = 3;
/// Ratio of the largest to the least value below which there is nothing to fit.
const SPREAD: f64 = 1.5;

/// The exponent q of y = c x^q through `points` (x, y), by least squares of the logarithms; none for
/// fewer than three of them, or values that hardly differ.
pub(crate) fn exponent(points: &[[f64; 2]]) -> Option<f64> {
    let above = |p: &&[f64; 2]| p[0] > 0.0 && p[0].is_finite() && p[1] > ROUND_OFF;
    let logs: Vec<[f64; 2]> = points.iter().filter(above).map(|p| [p[0].ln(), p[1].ln()]).collect();
    let count = logs.len() as f64;
    let mean = |axis: usize| logs.iter().map(|p| p[axis]).sum::<f64>() / count;
    let (x, y) = (mean(0), mean(1));
    let differs = |axis: usize| {
        let values = || logs.iter().map(|p| p[axis]);
        values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min) > SPREAD.ln()
    };
    let spread: f64 = logs.iter().map(|p| (p[0] - x).powi(2)).sum();
    let both: f64 = logs.iter().map(|p| (p[0] - x) * (p[1] - y)).sum();
    (logs.len() >= POINTS && differs(0) && differs(1)).then(|| both / spread)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A fit of the numbers, not of their logarithms, would be led by the largest.
    #[test]
    fn the_exponent_of_a_power_law_is_found() {
        let law = |x: f64| [x, 0.3 * x.powf(-1.7)];
        let found = exponent(&[1e-3, 1e-1, 1.0, 5.0].map(law)).unwrap();
        assert!((found + 1.7).abs() < 1e-12, "{found}");
    }

    /// One that took round-off for an error would bend the slope.
    #[test]
    fn too_few_points_have_none_and_round_off_is_none() {
        assert_eq!(exponent(&[[1.0, 1.0], [2.0, 4.0]]), None);
        assert_eq!(exponent(&[[1.0, 1.0], [2.0, 4.0], [4.0, 1e-16]]), None);
        assert_eq!(exponent(&[[1.0, 1.0], [1.0, 4.0], [1.0, 2.0]]), None);
    }
}
