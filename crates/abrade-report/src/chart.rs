//! A chart of curves, on linear or logarithmic axes, as PNG.

mod axis;

use std::path::Path;

use crate::atomic;
use crate::error::ReportError;
use crate::picture::canvas::{Align, Canvas, Rect, Text};
use crate::picture::colour::{INK, Rgb, SOFT, UNTOUCHED};

use axis::Range;
pub use axis::{Axis, Scale};

/// A chart.
#[derive(Clone, Copy, Debug)]
pub struct Chart<'a> {
    /// Headline.
    pub title: &'a str,
    /// A line below it.
    pub caption: &'a str,
    /// The axis along the lower side.
    pub x: Axis<'a>,
    /// The axis along the left side.
    pub y: Axis<'a>,
    /// The curves; points that an axis cannot show are left out.
    pub series: &'a [Series],
}

/// A curve.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// What the legend says.
    pub name: String,
    /// Its points, in the order in which they are joined.
    pub points: Vec<[f64; 2]>,
    /// Half lengths of the bars at the points, upwards and downwards; empty without bars.
    pub bars: Vec<f64>,
    /// How it is drawn.
    pub stroke: Stroke,
}

/// How a curve is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Stroke {
    /// A line with a dot at every point: values at places.
    #[default]
    Dots,
    /// A line alone.
    Line,
    /// Dashes: a formula beside what was found, or one of two branches.
    Dashes,
}

impl Series {
    /// Leaves out the points below `least`, and their bars.
    pub fn leave_out_below(&mut self, least: f64) {
        let keeps: Vec<bool> = self.points.iter().map(|point| point[1] >= least).collect();
        let mut kept = keeps.iter();
        self.points.retain(|_| *kept.next().unwrap_or(&true));
        let mut kept = keeps.iter();
        self.bars.retain(|_| *kept.next().unwrap_or(&true));
    }
}

/// Size of a chart [pixels].
const SIZE: [usize; 2] = [1400, 860];
/// The plot in it [pixels].
const PLOT: Rect = Rect { left: 130.0, right: 960.0, top: 130.0, bottom: 760.0 };
/// Width of a curve [pixels].
const WIDTH: f64 = 2.5;
/// A dash and the gap behind it [pixels].
const DASH: [f64; 2] = [9.0, 6.0];
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

impl Chart<'_> {
    /// The chart as the bytes of a PNG file.
    ///
    /// # Errors
    /// The drawing library's own.
    pub fn to_png(&self) -> Result<Vec<u8>, ReportError> {
        // As high as the legend needs.
        let legend = PLOT.top + LINE * (self.series.len() as f64 + 0.5);
        let mut canvas = Canvas::new(SIZE[0], SIZE[1].max(legend as usize))?;
        let look = Text { size: 34.0, bold: true, align: Align::Left, ..Text::default() };
        let title = canvas.fitted(self.title, look, SIZE[0] as f64 - 1.5 * PLOT.left);
        canvas.text([PLOT.left, 40.0], &title, look);
        let small = Text { size: 22.0, bold: false, colour: SOFT, ..look };
        canvas.text([PLOT.left, 87.0], self.caption, small);
        let values = |axis: usize| {
            self.series.iter().flat_map(move |series| self.drawn(series).map(move |(p, _)| p[axis]))
        };
        let ends = self
            .series
            .iter()
            .flat_map(|series| self.drawn(series).flat_map(|([_, y], bar)| [y - bar, y + bar]));
        let x = self.x.range(values(0));
        let y = self.y.range(ends);
        self.grid(&mut canvas, x, y)?;
        // Dashes tell their curves from the others: they begin with the first colour again.
        let mut colours = [0, 0];
        for (at, series) in self.series.iter().enumerate() {
            let next = &mut colours[usize::from(series.stroke == Stroke::Dashes)];
            let colour = COLOURS[*next % COLOURS.len()];
            *next += 1;
            self.curve(&mut canvas, [x, y], (at, colour), series)?;
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

    fn grid(&self, canvas: &mut Canvas, x: Range, y: Range) -> Result<(), ReportError> {
        for (value, label) in x.ticks(PLOT.width()) {
            let at = PLOT.left + x.share(value) * PLOT.width();
            canvas.line(&[[at, PLOT.top], [at, PLOT.bottom]], UNTOUCHED, 1.0)?;
            label.write(canvas, [at, PLOT.bottom + 26.0], Align::Centre);
        }
        for (value, label) in y.ticks(PLOT.height()) {
            let at = PLOT.bottom - y.share(value) * PLOT.height();
            canvas.line(&[[PLOT.left, at], [PLOT.right, at]], UNTOUCHED, 1.0)?;
            label.write(canvas, [PLOT.left - 13.0, at], Align::Right);
        }
        canvas.frame(&PLOT, INK)?;
        let middle = [(PLOT.left + PLOT.right) / 2.0, (PLOT.top + PLOT.bottom) / 2.0];
        canvas.text([middle[0], PLOT.bottom + 62.0], self.x.name, Text::default());
        let upright = Text { upright: true, ..Text::default() };
        canvas.text([PLOT.left - 94.0, middle[1]], self.y.name, upright);
        Ok(())
    }

    fn curve(
        &self,
        canvas: &mut Canvas,
        [x, y]: [Range; 2],
        (at, colour): (usize, Rgb),
        series: &Series,
    ) -> Result<(), ReportError> {
        let up = |value: f64| PLOT.bottom - y.share(value) * PLOT.height();
        let along = |value: f64| PLOT.left + x.share(value) * PLOT.width();
        let points: Vec<([f64; 2], f64)> = self.drawn(series).collect();
        let line: Vec<[f64; 2]> = points.iter().map(|([a, b], _)| [along(*a), up(*b)]).collect();
        let strokes = |line: &[[f64; 2]]| match series.stroke {
            Stroke::Dashes => dashes(line),
            Stroke::Dots | Stroke::Line => vec![line.to_vec()],
        };
        for stroke in strokes(&line).iter().filter(|stroke| stroke.len() > 1) {
            canvas.line(stroke, colour, WIDTH)?;
        }
        let has_dots = series.stroke == Stroke::Dots;
        for ([a, b], bar) in points.iter().filter(|_| has_dots) {
            let ends =
                [b - bar, b + bar].map(|end| [along(*a), up(end).clamp(PLOT.top, PLOT.bottom)]);
            canvas.line(&ends, colour, 1.5)?;
            canvas.dot([along(*a), up(*b)], 5.0, colour)?;
        }
        let down = PLOT.top + 20.0 + LINE * at as f64;
        let left = PLOT.right + 30.0;
        for stroke in strokes(&[[left, down], [left + 34.0, down]]) {
            canvas.line(&stroke, colour, WIDTH)?;
        }
        if has_dots {
            canvas.dot([left + 17.0, down], 5.0, colour)?;
        }
        let nothing = if line.is_empty() { " (nothing to show)" } else { "" };
        let look = Text { align: Align::Left, ..Text::default() };
        canvas.text([left + 46.0, down], &format!("{}{nothing}", series.name), look);
        Ok(())
    }

    /// The points that the axes can show, with their bars.
    fn drawn<'a>(&self, series: &'a Series) -> impl Iterator<Item = ([f64; 2], f64)> + use<'a> {
        let [x, y] = [self.x.scale, self.y.scale];
        let bar = |at: usize| series.bars.get(at).copied().filter(|bar| bar.is_finite());
        let points = series.points.iter().enumerate();
        let shown = points.filter(move |(_, point)| x.shows(point[0]) && y.shows(point[1]));
        shown.map(move |(at, point)| (*point, bar(at).unwrap_or(0.0)))
    }
}

/// The dashes of a line.
fn dashes(line: &[[f64; 2]]) -> Vec<Vec<[f64; 2]>> {
    let mut strokes = vec![line.first().copied().into_iter().collect::<Vec<_>>()];
    let (mut is_drawn, mut left) = (true, DASH[0]);
    for pair in line.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let mut gone = 0.0;
        while length - gone > left {
            gone += left;
            let at = [0, 1].map(|k| a[k] + (b[k] - a[k]) * gone / length);
            match (is_drawn, strokes.last_mut()) {
                (true, Some(stroke)) => stroke.push(at),
                _ => strokes.push(vec![at]),
            }
            is_drawn = !is_drawn;
            left = DASH[usize::from(!is_drawn)];
        }
        left -= length - gone;
        if let (true, Some(stroke)) = (is_drawn, strokes.last_mut()) {
            stroke.push(b);
        }
    }
    strokes
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for dashes that start anew at every point, which close points make a solid line, or that leave
    /// the line.
    #[test]
    fn dashes_go_on_from_point_to_point() {
        let line: Vec<[f64; 2]> = (0..=100).map(|i| [f64::from(i), 7.0]).collect();
        let strokes = dashes(&line);
        let drawn: f64 = strokes.iter().map(|s| s[s.len() - 1][0] - s[0][0]).sum();
        let period = DASH[0] + DASH[1];
        assert!((drawn - 100.0 * DASH[0] / period).abs() < DASH[0], "{drawn}");
        assert_eq!(strokes.len(), (100.0 / period).ceil() as usize);
        assert!(strokes.iter().flatten().all(|at| at[1] == 7.0));
    }

    /// Fails for a legend that ends below the picture: the height of a PNG file stands in its bytes 20 to 23.
    #[test]
    fn the_legend_has_room() {
        let axis = Axis { name: "x", scale: Scale::Linear };
        let height = |count: usize| {
            let series = vec![Series::default(); count];
            let chart = Chart { title: "t", caption: "c", x: axis, y: axis, series: &series };
            let png = chart.to_png().unwrap();
            u32::from_be_bytes([png[20], png[21], png[22], png[23]])
        };
        assert_eq!(height(17), SIZE[1] as u32);
        assert!(f64::from(height(40)) > PLOT.top + 40.0 * LINE);
    }

    /// A program that took logarithms of all there is would fail here, for want of a curve, or of a
    /// point that has one.
    #[test]
    fn what_cannot_be_drawn_is_left_out() {
        let points = vec![[0.0, 1.0], [1.0, f64::NAN], [2.0, -1.0]];
        let series = [Series { name: "none".into(), points, ..Series::default() }];
        for scale in [Scale::Log, Scale::Linear] {
            let axis = Axis { name: "x", scale };
            for series in [&series[..], &[]] {
                let chart = Chart { title: "t", caption: "c", x: axis, y: axis, series };
                assert!(chart.to_png().unwrap().starts_with(b"\x89PNG"));
            }
        }
    }
}
