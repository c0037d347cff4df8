//! The adhesion at which half of the collisions grind: a logistic curve through the shares, by maximum
//! likelihood, with the interval of the profile likelihood.

/// Half the drop of the log likelihood at the ends of a 95 % interval: the quantile of chi squared, 3.84, over 2.
const DROP: f64 = 1.92;
/// Places that are tried over the range of the values, less one.
const PLACES: usize = 400;
/// Widths of the curve that are tried, as shares of the range.
const WIDTHS: [f64; 9] = [0.003, 0.006, 0.012, 0.025, 0.05, 0.1, 0.2, 0.4, 0.8];

/// A boundary, in the units of what varies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Boundary {
    /// Where the share is one half.
    pub at: f64,
    /// The ends of the 95 % interval, among the values.
    pub interval: [f64; 2],
    /// Whether the runs bound it below and above; where not, the end is that of the values.
    pub is_bounded: [bool; 2],
}

impl Boundary {
    /// The ends of the interval; none where the runs do not bound it.
    pub(crate) fn ends(&self) -> [Option<f64>; 2] {
        [0, 1].map(|side| self.is_bounded[side].then_some(self.interval[side]))
    }
}

/// Runs at one value: how many, and how many of them came out so.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Share {
    pub(crate) value: f64,
    pub(crate) runs: usize,
    pub(crate) hits: usize,
}

/// The boundary above which runs come out so; none where it is not between the values.
pub(crate) fn boundary(shares: &[Share]) -> Option<Boundary> {
    let values = shares.iter().map(|share| share.value);
    let [low, high] =
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(v), h.max(v)]);
    let hits: usize = shares.iter().map(|share| share.hits).sum();
    let runs: usize = shares.iter().map(|share| share.runs).sum();
    if hits == 0 || hits == runs || high <= low {
        return None;
    }
    let place = |at: usize| low + (high - low) * at as f64 / PLACES as f64;
    let profile: Vec<f64> = (0..=PLACES)
        .map(|at| {
            let of = |width: &f64| likelihood(shares, place(at), width * (high - low));
            WIDTHS.iter().map(of).fold(f64::NEG_INFINITY, f64::max)
        })
        .collect();
    let best = profile.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    // Of places that are as likely, the middle: shares that part sharply leave a stretch of them.
    let near = |drop: f64| {
        let fine = |at: &usize| profile[*at] >= best - drop;
        let first = (0..=PLACES).find(fine).unwrap_or(0);
        let last = (0..=PLACES).rev().find(fine).unwrap_or(PLACES);
        [first, last]
    };
    let is_inside = |[first, last]: [usize; 2]| [first > 0, last < PLACES];
    let (best, interval) = (near(0.02), near(DROP));
    // A curve that is as likely at an end has no half among the runs.
    (is_inside(best) == [true, true]).then(|| Boundary {
        at: 0.5 * (place(best[0]) + place(best[1])),
        interval: interval.map(place),
        is_bounded: is_inside(interval),
    })
}

/// Log likelihood of the shares under a logistic curve.
fn likelihood(shares: &[Share], middle: f64, width: f64) -> f64 {
    let of = |share: &Share| {
        let x = ((share.value - middle) / width).clamp(-500.0, 500.0);
        let (hit, miss) = (-(-x).exp().ln_1p(), -x.exp().ln_1p());
        share.hits as f64 * hit + (share.runs - share.hits) as f64 * miss
    };
    shares.iter().map(of).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shares(rows: &[(f64, usize)], runs: usize) -> Vec<Share> {
        rows.iter().map(|&(value, hits)| Share { value, runs, hits }).collect()
    }

    /// Fails for a fit that runs away where shares part sharply, or that hides how far apart they are.
    #[test]
    fn a_sharp_change_lies_half_way_and_its_interval_spans_the_step() {
        let found = boundary(&shares(&[(0.0, 0), (0.5, 0), (1.0, 5), (1.5, 5)], 5)).unwrap();
        assert!((found.at - 0.75).abs() < 0.05, "{found:?}");
        assert!(found.interval[0] < 0.62 && found.interval[1] > 0.88, "{found:?}");
        assert!(found.interval[0] > 0.3 && found.interval[1] < 1.2, "{found:?}");
        assert_eq!(found.is_bounded, [true, true]);
    }

    /// Fails for an interval that looks as if it ended where the values do.
    #[test]
    fn an_interval_that_goes_beyond_the_values_is_not_bounded() {
        let rows = [(0.0, 0), (0.4, 0), (0.8, 2), (1.1, 2), (1.35, 4), (1.6, 3)];
        let found = boundary(&shares(&rows, 5)).unwrap();
        assert_eq!(found.is_bounded, [true, false]);
        assert_eq!(found.ends(), [Some(found.interval[0]), None]);
    }

    /// Fails for an interval that does not shrink with the number of runs: a curve of width 0.2 about 1.
    #[test]
    fn more_runs_narrow_the_interval() {
        let curve = |value: f64| 1.0 / (1.0 + (-(value - 1.0) / 0.2_f64).exp());
        let of = |runs: usize| {
            let rows: Vec<(f64, usize)> = (0..9)
                .map(|k| 0.25 * f64::from(k))
                .map(|value| (value, (curve(value) * runs as f64).round() as usize))
                .collect();
            boundary(&shares(&rows, runs)).unwrap()
        };
        let width = |b: Boundary| b.interval[1] - b.interval[0];
        let (few, many) = (of(5), of(80));
        assert!((many.at - 1.0).abs() < 0.03, "{many:?}");
        assert!(width(few) > 3.0 * width(many), "{few:?} {many:?}");
    }

    /// Fails for a boundary where there is none: all or no runs came out so, or few at every value, or
    /// more than half at every value but not more at the higher.
    #[test]
    fn shares_on_one_side_of_a_half_have_no_boundary() {
        assert_eq!(boundary(&shares(&[(0.0, 0), (0.5, 0), (1.0, 1)], 5)), None);
        assert_eq!(boundary(&shares(&[(0.0, 4), (0.5, 5), (1.0, 5)], 5)), None);
        let above = [(0.0, 5), (0.4, 3), (0.8, 3), (1.35, 5)];
        assert_eq!(boundary(&shares(&above, 5)), None);
        assert_eq!(boundary(&shares(&[(0.0, 0), (1.0, 0)], 5)), None);
        assert_eq!(boundary(&shares(&[(0.0, 5), (1.0, 5)], 5)), None);
    }
}
