//! A chart of curves on logarithmic axes, as PNG.

use std::path::Path;

use crate::atomic;
use crate::error::ReportError;
use crate::picture::canvas::{Align, Canvas, Rect, Text};
use crate::picture::colour::{INK, Rgb, SOFT, UNTOUCHED};
use crate::units::tick_text;

/// A chart.
#[derive(Clone, Copy, Debug)]
pub struct Chart<'a> {
    /// Headline.
    pub title: &'a str,
    /// A line below it.
    pub caption: &'a str,
    /// What the axes measure, with their units.
    pub x: &'a str,
    /// As `x`.
    pub y: &'a str,
    /// The curves; points that are not above zero are left out.
    pub series: &'a [Series],
}

/// A curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// What the legend says.
    pub name: String,
    /// Its points, in the order in which they are joined.
    pub points: Vec<[f64; 2]>,
}

/// Size of a chart [pixels].
const SIZE: [usize; 2] = [1400, 860];
/// The plot in it [pixels].
const PLOT: Rect = Rect { left: 130.0, right: 960.0, top: 130.0, bottom: 760.0 };
/// From one line of the legend to the next [pixels].
const LINE: f64 = 40.0;

/// Colours that stay apart in print and to the colour-blind (Okabe & Ito, 2008).
const COLOURS: [Rgb; 8] = [
    [0, 114, 178],
    [213, 94, 0],
    [0, 158, 115],
    [204, 121, 167],
    [86, 180, 233],
    [230, 159, 0],
    [90, 90, 90],
    [150, 120, 60],
];

/// A logarithmic axis, its ends whole powers of ten.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Decades {
    low: i32,
    high: i32,
}

impl Decades {
    /// Around `values`, at least one decade.
    fn around(values: impl Iterator<Item = f64>) -> Self {
        let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
            [low.min(value), high.max(value)]
        });
        if low > high {
            return Self { low: 0, high: 1 };
        }
        let low = (low.log10() + 1e-9).floor() as i32;
        let high = (high.log10() - 1e-9).ceil() as i32;
        Self { low, high: high.max(low + 1) }
    }

    /// Where `value` stands, as a share of the axis.
    fn share(self, value: f64) -> f64 {
        (value.log10() - f64::from(self.low)) / f64::from(self.high - self.low)
    }

    /// Its powers of ten, not more than about ten of them.
    fn ticks(self) -> impl Iterator<Item = i32> {
        let pace = (self.high - self.low) / 10 + 1;
        (self.low..=self.high).step_by(pace as usize)
    }
}

impl Chart<'_> {
    /// The chart as the bytes of a PNG file.
    ///
    /// # Errors
    /// The drawing library's own.
    pub fn to_png(&self) -> Result<Vec<u8>, ReportError> {
        let mut canvas = Canvas::new(SIZE[0], SIZE[1])?;
        let look = Text { size: 34.0, bold: true, align: Align::Left, ..Text::default() };
        let title = canvas.fitted(self.title, look, SIZE[0] as f64 - 1.5 * PLOT.left);
        canvas.text([PLOT.left, 40.0], &title, look);
        let small = Text { size: 22.0, bold: false, colour: SOFT, ..look };
        canvas.text([PLOT.left, 87.0], self.caption, small);
        let points = || self.series.iter().flat_map(drawn);
        let axes = [0, 1].map(|axis| Decades::around(points().map(|point| point[axis])));
        self.grid(&mut canvas, axes)?;
        for (at, series) in self.series.iter().enumerate() {
            self.curve(&mut canvas, axes, at, series)?;
        }
        canvas.to_png()
    }

    /// Writes the chart to `path`.
    ///
    /// # Errors
    /// The drawing library's own, or the file system refuses.
    pub fn write(&self, path: &Path) -> Result<(), ReportError> {
        atomic::write(path, &self.to_png()?)
    }

    fn grid(&self, canvas: &mut Canvas, [x, y]: [Decades; 2]) -> Result<(), ReportError> {
        for power in x.ticks() {
            let at = PLOT.left + x.share(10f64.powi(power)) * PLOT.width();
            canvas.line(&[[at, PLOT.top], [at, PLOT.bottom]], UNTOUCHED, 1.0)?;
            power_of_ten(canvas, [at + 12.0, PLOT.bottom + 26.0], power);
        }
        for power in y.ticks() {
            let at = PLOT.bottom - y.share(10f64.powi(power)) * PLOT.height();
            canvas.line(&[[PLOT.left, at], [PLOT.right, at]], UNTOUCHED, 1.0)?;
            power_of_ten(canvas, [PLOT.left - 36.0, at], power);
        }
        canvas.frame(&PLOT, INK)?;
        let middle = [(PLOT.left + PLOT.right) / 2.0, (PLOT.top + PLOT.bottom) / 2.0];
        canvas.text([middle[0], PLOT.bottom + 62.0], self.x, Text::default());
        let upright = Text { upright: true, ..Text::default() };
        canvas.text([PLOT.left - 94.0, middle[1]], self.y, upright);
        Ok(())
    }

    fn curve(
        &self,
        canvas: &mut Canvas,
        [x, y]: [Decades; 2],
        at: usize,
        series: &Series,
    ) -> Result<(), ReportError> {
        let colour = COLOURS[at % COLOURS.len()];
        let place = |[a, b]: [f64; 2]| {
            let right = PLOT.left + x.share(a) * PLOT.width();
            [right, PLOT.bottom - y.share(b) * PLOT.height()]
        };
        let line: Vec<[f64; 2]> = drawn(series).map(place).collect();
        if line.len() > 1 {
            canvas.line(&line, colour, 2.0)?;
        }
        for &point in &line {
            canvas.dot(point, 5.0, colour)?;
        }
        let down = PLOT.top + 20.0 + LINE * at as f64;
        let left = PLOT.right + 30.0;
        canvas.line(&[[left, down], [left + 34.0, down]], colour, 3.0)?;
        let nothing = if line.is_empty() { " (nothing to show)" } else { "" };
        let look = Text { align: Align::Left, ..Text::default() };
        canvas.text([left + 46.0, down], &format!("{}{nothing}", series.name), look);
        Ok(())
    }
}

/// The points that logarithmic axes can show.
fn drawn(series: &Series) -> impl Iterator<Item = [f64; 2]> {
    let above = |point: &&[f64; 2]| point.iter().all(|x| x.is_finite() && *x > 0.0);
    series.points.iter().filter(above).copied()
}

/// 10 and its power, raised; the 10 ends at `end`.
fn power_of_ten(canvas: &mut Canvas, end: [f64; 2], power: i32) {
    canvas.text(end, "10", Text { align: Align::Right, ..Text::default() });
    let raised = Text { size: 15.0, align: Align::Left, ..Text::default() };
    canvas.text([end[0] + 2.0, end[1] - 8.0], &tick_text(f64::from(power), 0), raised);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One that rounded the ends inwards would draw points outside of its frame.
    #[test]
    fn every_point_lies_within_whole_decades() {
        let axis = Decades::around([3.0, 0.02, 99.0].into_iter());
        assert_eq!(axis, Decades { low: -2, high: 2 });
        assert_eq!(axis.share(1.0), 0.5);
        assert_eq!(Decades::around([10.0].into_iter()), Decades { low: 1, high: 2 });
        assert_eq!(Decades::around(std::iter::empty()), Decades { low: 0, high: 1 });
    }

    /// A program that took logarithms of all there is would fail here, for want of a curve, or of a
    /// point that has one.
    #[test]
    fn what_cannot_be_drawn_is_left_out() {
        let points = vec![[0.0, 1.0], [1.0, f64::NAN], [2.0, -1.0]];
        let series = [Series { name: "none".into(), points }];
        for series in [&series[..], &[]] {
            let chart = Chart { title: "t", caption: "c", x: "x", y: "y", series };
            assert!(chart.to_png().unwrap().starts_with(b"\x89PNG"));
        }
    }
}
