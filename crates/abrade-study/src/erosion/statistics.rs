//! Estimates from samples, with the half widths of their 95 % intervals.

/// An estimate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Its value; not a number where there are no samples that tell it.
    pub value: f64,
    /// Half width of its 95 % interval; infinite where there are too few samples for one.
    pub half_width: f64,
}

impl Estimate {
    /// Half width over value [-].
    pub fn relative(&self) -> f64 {
        if self.half_width == 0.0 { 0.0 } else { (self.half_width / self.value).abs() }
    }
}

/// An estimate that is a function `f` of the sums over all samples of what each row holds, by the
/// jackknife: its spread is that of the values without one sample each (B. Efron & C. Stein, Ann. Stat. 9
/// (1981) 586). For a mean that is the usual interval, with Student's factor for `samples` of them: the fewest
/// that any of the sums is over.
pub(crate) fn estimate<R: AsRef<[f64]>>(
    rows: &[R],
    samples: usize,
    f: impl Fn(&[f64]) -> f64,
) -> Estimate {
    let Some(first) = rows.first() else {
        return Estimate { value: f64::NAN, half_width: f64::INFINITY };
    };
    let mut sums = vec![0.0; first.as_ref().len()];
    for row in rows {
        for (sum, x) in sums.iter_mut().zip(row.as_ref()) {
            *sum += x;
        }
    }
    let value = f(&sums);
    let count = rows.len() as f64;
    if samples < 2 {
        return Estimate { value, half_width: f64::INFINITY };
    }
    let mut rest = sums.clone();
    let [mut first, mut second] = [0.0; 2];
    for row in rows {
        for ((rest, sum), x) in rest.iter_mut().zip(&sums).zip(row.as_ref()) {
            *rest = sum - x;
        }
        // Summed as differences from the whole's value: they are small.
        let difference = f(&rest) - value;
        first += difference;
        second += difference * difference;
    }
    let spread = (second - first * first / count) * (count - 1.0) / count;
    // Not a number where the value is none, or is none without one of the samples.
    let half_width = match spread.is_nan() {
        true => f64::INFINITY,
        false => student(samples - 1) * spread.max(0.0).sqrt(),
    };
    Estimate { value, half_width }
}

/// Half width of the 95 % interval over the standard error, by the expansion of Student's distribution in
/// the degrees of freedom (M. Abramowitz & I. Stegun 26.7.5); right to 1 % from 3 of them on.
fn student(freedom: usize) -> f64 {
    const Z: f64 = 1.959_963_984_540_054;
    let z = |power: i32| Z.powi(power);
    let terms = [
        Z,
        (z(3) + Z) / 4.0,
        (5.0 * z(5) + 16.0 * z(3) + 3.0 * Z) / 96.0,
        (3.0 * z(7) + 19.0 * z(5) + 17.0 * z(3) - 15.0 * Z) / 384.0,
    ];
    let share = 1.0 / freedom as f64;
    terms.iter().rev().fold(0.0, |sum, term| sum * share + term)
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg32;

    use super::*;

    /// Quantiles of tables.
    #[test]
    fn students_factor_is_that_of_tables() {
        for (freedom, factor) in [(4, 2.776), (9, 2.262), (30, 2.042), (63, 1.998)] {
            let found = student(freedom);
            assert!((found / factor - 1.0).abs() < 5e-3, "{freedom}: {found}");
        }
    }

    /// Fails for a mean whose interval is not the usual one.
    #[test]
    fn a_mean_has_its_usual_interval() {
        let rows = [1.0, 2.0, 4.0, 9.0, 4.0].map(|value| [value, 1.0]);
        let Estimate { value, half_width } = estimate(&rows, 5, |sums| sums[0] / sums[1]);
        assert_eq!(value, 4.0);
        // Variance 9.5, five values.
        assert!((half_width / (2.776 * (9.5_f64 / 5.0).sqrt()) - 1.0).abs() < 5e-3, "{half_width}");
    }

    /// Fails for a value out of nothing, and for an interval of no width where one sample alone has a term that
    /// the value divides by.
    #[test]
    fn what_no_samples_tell_has_no_interval() {
        let none: [[f64; 2]; 0] = [];
        let nothing = estimate(&none, 0, |sums| sums[0] / sums[1]);
        assert!(nothing.value.is_nan() && nothing.half_width == f64::INFINITY, "{nothing:?}");
        for rows in [[[1.0, 2.0], [0.0, 0.0]], [[0.0, 0.0], [0.0, 0.0]]] {
            let few = estimate(&rows, 2, |sums| sums[0] / sums[1]);
            assert_eq!(few.half_width, f64::INFINITY, "{few:?}");
        }
    }

    /// Fails for an interval of a ratio that forgets that its parts are of the same samples, or that is
    /// wrong by a factor: nineteen in twenty hold the true value.
    #[test]
    fn nineteen_intervals_in_twenty_hold_the_ratio() {
        let mut generator = Pcg32::seed_from_u64(11);
        let mut held = 0;
        let trials = 2000;
        for _ in 0..trials {
            let rows: Vec<[f64; 2]> = (0..64)
                .map(|_| {
                    let [a, b]: [f64; 2] = generator.random();
                    [2.0 * (a + 0.1 * b), a + 0.1]
                })
                .collect();
            let Estimate { value, half_width } = estimate(&rows, 64, |sums| sums[0] / sums[1]);
            held += usize::from((value - 1.1 / 0.6).abs() <= half_width);
        }
        let share = held as f64 / f64::from(trials);
        assert!((0.935..0.965).contains(&share), "{share}");
    }
}
