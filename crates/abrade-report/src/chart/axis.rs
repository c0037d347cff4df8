//! Axes of charts: what they measure, where their values stand.

use crate::picture::canvas::{Align, Canvas, Text};
use crate::units::{tick_text, ticks};

/// An axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis<'a> {
    /// What it measures, with the unit.
    pub name: &'a str,
    /// How its values are spread.
    pub scale: Scale,
}

/// How values are spread over an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Evenly, from zero or below.
    Linear,
    /// By their logarithms, between whole powers of ten; values that are not above zero are left out.
    Log,
}

/// Distance between ticks of a linear axis that is aimed at [pixels].
const PACE: f64 = 110.0;

/// Room beyond the outermost values of a linear axis, as a share of their range.
const MARGIN: f64 = 0.03;

/// The part of an axis that a chart shows; in whole decades or in values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Range {
    Linear([f64; 2]),
    Log([i32; 2]),
}

/// Text of a tick.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Label {
    Number(String),
    PowerOfTen(i32),
}

impl Scale {
    /// True for a value that has a place.
    pub(super) fn shows(self, value: f64) -> bool {
        value.is_finite() && (self == Self::Linear || value > 0.0)
    }
}

impl Axis<'_> {
    /// The range that holds all of `values` that have a place.
    pub(super) fn range(&self, values: impl Iterator<Item = f64>) -> Range {
        let shown = values.filter(|value| self.scale.shows(*value));
        let [low, high] = shown.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
            [low.min(value), high.max(value)]
        });
        match (self.scale, low > high) {
            (Scale::Linear, true) => Range::Linear([0.0, 1.0]),
            (Scale::Log, true) => Range::Log([0, 1]),
            (Scale::Linear, false) => {
                let low = low.min(0.0);
                let high = if high > low { high } else { low + 1.0 };
                // Zero is the frame itself; other ends keep off it.
                let margin = MARGIN * (high - low);
                Range::Linear([if low < 0.0 { low - margin } else { low }, high + margin])
            }
            (Scale::Log, false) => {
                let low = (low.log10() + 1e-9).floor() as i32;
                let high = (high.log10() - 1e-9).ceil() as i32;
                Range::Log([low, high.max(low + 1)])
            }
        }
    }
}

impl Range {
    /// Where `value` stands, as a share of the axis; below all others on a logarithmic one if it has no place.
    pub(super) fn share(self, value: f64) -> f64 {
        match self {
            Self::Linear([low, high]) => (value - low) / (high - low),
            Self::Log([low, high]) => {
                (value.max(0.0).log10() - f64::from(low)) / f64::from(high - low)
            }
        }
    }

    /// Values that are marked along `length` pixels, and their texts.
    pub(super) fn ticks(self, length: f64) -> Vec<(f64, Label)> {
        match self {
            Self::Linear([low, high]) => {
                let (values, decimals) = ticks(low, high, length / PACE);
                let tick = |value: f64| (value, Label::Number(tick_text(value, decimals)));
                values.into_iter().map(tick).collect()
            }
            Self::Log([low, high]) => {
                let pace = (high - low) / 10 + 1;
                let powers = (low..=high).step_by(pace as usize);
                powers.map(|power| (10f64.powi(power), Label::PowerOfTen(power))).collect()
            }
        }
    }
}

impl Label {
    /// Writes it with its `align` end at `at`.
    pub(super) fn write(&self, canvas: &mut Canvas, at: [f64; 2], align: Align) {
        match self {
            Self::Number(text) => canvas.text(at, text, Text { align, ..Text::default() }),
            Self::PowerOfTen(power) => {
                let shift = match align {
                    Align::Right => -23.0,
                    Align::Centre => 12.0,
                    Align::Left => 24.0,
                };
                let end = [at[0] + shift, at[1]];
                canvas.text(end, "10", Text { align: Align::Right, ..Text::default() });
                let raised = Text { size: 15.0, align: Align::Left, ..Text::default() };
                canvas.text([end[0] + 2.0, end[1] - 8.0], &tick_text(f64::from(*power), 0), raised);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LOG: Axis<'_> = Axis { name: "x", scale: Scale::Log };
    const LINEAR: Axis<'_> = Axis { name: "x", scale: Scale::Linear };

    /// One that rounded the ends inwards would draw points outside of its frame.
    #[test]
    fn every_point_lies_within_whole_decades() {
        let range = LOG.range([3.0, 0.02, 99.0].into_iter());
        assert_eq!(range, Range::Log([-2, 2]));
        assert_eq!(range.share(1.0), 0.5);
        // The lower end of a bar that reaches below zero.
        assert_eq!(range.share(-1.0), f64::NEG_INFINITY);
        assert_eq!(LOG.range([10.0].into_iter()), Range::Log([1, 2]));
        assert_eq!(LOG.range(std::iter::empty()), Range::Log([0, 1]));
    }

    /// One that began at the least value would show a small difference as a large one.
    #[test]
    fn a_linear_axis_begins_at_zero() {
        let range = LINEAR.range([90.0, 100.0].into_iter());
        assert_eq!(range.share(0.0), 0.0);
        assert!((0.9..1.0).contains(&range.share(100.0)));
        assert!(range.share(0.0) < LINEAR.range([-5.0, 5.0].into_iter()).share(0.0));
        let labels = range.ticks(600.0);
        assert_eq!(labels[0], (0.0, Label::Number("0".into())));
    }
}
