//! The outline of a body's asperities over its base.

use std::f64::consts::FRAC_PI_2;

use abrade::ParameterError;
use abrade::quantity::{self, Quantity};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What differs by less is the bound itself: `25 um` and 0.000025 are not the same number [-].
const ROUNDING: f64 = 1e-9;

/// Height of the highest asperities, in periods.
const STEEP: f64 = 1e3;

/// Least angle of the sides of a trapezoid [rad].
const LEAST_SIDE: f64 = 0.05;

/// Outline of the asperities of a body.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum Profile {
    /// One trapezoid in a period. Centres of elements lie half a diameter inside its corners.
    Trapezoid {
        /// Width of the top facet (default 0.5 mm) [m].
        #[serde(default = "top", deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        top: f64,
        /// Height (default 0.5 mm) [m].
        #[serde(default = "height", deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        height: f64,
        /// Angle of the sides with the base (default 60 deg) [rad].
        #[serde(default = "side", deserialize_with = "quantity::angle")]
        #[schemars(with = "Quantity")]
        side: f64,
    },
    /// A line through points, which repeats with the period. Centres of elements lie up to the line.
    Line {
        /// Place along x from 0 to the period, rising, and height above the lowest point of each [m].
        #[serde(deserialize_with = "points")]
        #[schemars(with = "Vec<[Quantity; 2]>")]
        points: Vec<[f64; 2]>,
    },
}

fn top() -> f64 {
    0.5e-3
}

fn height() -> f64 {
    0.5e-3
}

fn side() -> f64 {
    60f64.to_radians()
}

fn points<'de, D: serde::Deserializer<'de>>(d: D) -> Result<Vec<[f64; 2]>, D::Error> {
    quantity::LENGTH.rows(d)
}

impl Default for Profile {
    fn default() -> Self {
        Self::Trapezoid { top: top(), height: height(), side: side() }
    }
}

impl Profile {
    /// Every value outside its range, with the field it stands in; the elements are of `diameter` and the
    /// bodies repeat after `period` [m].
    pub fn check(&self, diameter: f64, period: f64) -> Vec<ParameterError> {
        let found = match self {
            Self::Trapezoid { top, height, side } => {
                let base = top + 2.0 * height / slope(*side);
                let fits = base <= period * (1.0 + ROUNDING);
                let wide = ParameterError {
                    field: "top",
                    value: *top,
                    allowed: format!("such that the foot, {base:e}, fits the period, {period:e}"),
                };
                vec![
                    within("top", *top, diameter, period),
                    within("height", *height, diameter, STEEP * period),
                    // A facet of the side that an element does not fill tells nothing of the angle.
                    within("side", *side, LEAST_SIDE, FRAC_PI_2),
                    (!fits).then_some(wide),
                ]
            }
            Self::Line { points } => {
                let refuse = |value: f64, allowed: &str| {
                    Some(ParameterError { field: "points", value, allowed: allowed.into() })
                };
                let rises = points.windows(2).all(|pair| pair[0][0] < pair[1][0]);
                let end = period * (1.0 + ROUNDING);
                let inside = points.iter().all(|p| (0.0..=end).contains(&p[0]));
                let finite = points.iter().flatten().all(|x| x.is_finite());
                let (count, height, most) = (points.len() as f64, self.height(), STEEP * period);
                let steep = format!("such that the highest is at most {most:e} above the lowest");
                vec![
                    if points.len() < 2 { refuse(count, "two or more") } else { None },
                    if rises && finite { None } else { refuse(count, "finite, with rising x") },
                    if inside { None } else { refuse(count, "between 0 and the period along x") },
                    if height <= most { None } else { refuse(height, &steep) },
                ]
            }
        };
        found.into_iter().flatten().collect()
    }

    /// Height of the highest point [m].
    pub fn height(&self) -> f64 {
        match self {
            Self::Trapezoid { height, .. } => *height,
            Self::Line { points } => {
                let heights = points.iter().map(|point| point[1]);
                let [low, high] = heights
                    .fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], y| [l.min(y), h.max(y)]);
                high - low
            }
        }
    }

    /// Width over which the bodies face each other: of the top facet, or the period of a line [m].
    pub fn facing(&self, period: f64) -> f64 {
        match self {
            Self::Trapezoid { top, .. } => *top,
            Self::Line { .. } => period,
        }
    }

    /// How far below the highest point the surface lies at `x`, of elements whose centres stay `inset` from
    /// the sides of a trapezoid [m].
    pub(crate) fn depth(&self, x: f64, period: f64, inset: f64) -> f64 {
        match self {
            Self::Trapezoid { top, side, .. } => {
                let beyond = (x - 0.5 * period).abs() - (0.5 * top - inset);
                // A side of 90 deg has no foot.
                if beyond <= 1e-6 * inset { 0.0 } else { beyond * slope(*side) }
            }
            Self::Line { points } => {
                let lowest = points.iter().map(|point| point[1]).fold(f64::INFINITY, f64::min);
                self.height() - (line_height(points, x.rem_euclid(period), period) - lowest)
            }
        }
    }
}

/// An error unless `low <= value <= high`, but for rounding.
pub(crate) fn within(
    field: &'static str,
    value: f64,
    low: f64,
    high: f64,
) -> Option<ParameterError> {
    let near = |bound: f64| (value - bound).abs() <= ROUNDING * bound.abs();
    let is_bound = near(low) || near(high);
    ParameterError::within(field, value, low, high).filter(|_| !is_bound)
}

/// Height over way of a side [-]: of one that is a right angle but for rounding, that of the right angle.
fn slope(side: f64) -> f64 {
    side.min(FRAC_PI_2).tan()
}

/// Height of the line at `x`; between its last and first point it goes over the period.
fn line_height(points: &[[f64; 2]], x: f64, period: f64) -> f64 {
    let next = points.partition_point(|point| point[0] <= x);
    let last = points.len() - 1;
    let [x1, y1] =
        if next == 0 { [points[last][0] - period, points[last][1]] } else { points[next - 1] };
    let [x2, y2] = if next > last { [points[0][0] + period, points[0][1]] } else { points[next] };
    if x2 > x1 { y1 + (y2 - y1) * (x - x1) / (x2 - x1) } else { y1 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for a line that ends at its last point, or whose heights count from zero.
    #[test]
    fn a_line_goes_on_over_the_period() {
        let line = Profile::Line { points: vec![[0.2, 1.0], [0.6, 3.0]] };
        assert_eq!(line.height(), 2.0);
        assert!((line.depth(0.4, 1.0, 0.0) - 1.0).abs() < 1e-12);
        // From 0.6 down to 1.2: a third of the way at 0.8, and half of it at 0.9 and at -0.1.
        assert!((line.depth(0.8, 1.0, 0.0) - 2.0 / 3.0).abs() < 1e-12);
        assert!((line.depth(-0.1, 1.0, 0.0) - 1.0).abs() < 1e-12);
    }

    /// Fails for a foot that does not fit, or a height below that of an element or without a bound.
    #[test]
    fn impossible_outlines_are_named() {
        let of = |profile: Profile| {
            profile.check(1.0, 50.0).into_iter().map(|error| error.field).collect::<Vec<_>>()
        };
        let (top, height, side) = (20.0, 20.0, 60f64.to_radians());
        assert!(of(Profile::Trapezoid { top, height, side }).is_empty());
        // What a written bound comes to is the bound, but for rounding.
        let least = 1.0 - 1e-15;
        assert!(of(Profile::Trapezoid { top: least, height: least, side }).is_empty());
        assert_eq!(of(Profile::Trapezoid { top: 0.999, height, side }), ["top"]);
        assert_eq!(of(Profile::Trapezoid { top, height, side: 0.6 }), ["top"]);
        assert_eq!(of(Profile::Trapezoid { top, height: 0.5, side }), ["height"]);
        assert_eq!(of(Profile::Line { points: vec![[1.0, 0.0], [0.5, 1.0]] }), ["points"]);
        assert_eq!(of(Profile::Line { points: vec![[0.0, 0.0], [5.0, 1e300]] }), ["points"]);
    }
}
