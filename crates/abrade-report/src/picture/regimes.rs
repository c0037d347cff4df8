//! A map of regimes: over two parameters, cells that show which share of the runs ended in which class, and
//! boundaries between them.

use super::canvas::{Align, Canvas, Rect, Text};
use super::colour::{INK, Rgb, SOFT};
use crate::error::ReportError;
use crate::units::{tick_text, ticks};

/// A map.
#[derive(Clone, Debug, PartialEq)]
pub struct Regimes<'a> {
    /// Headline.
    pub title: &'a str,
    /// A line below it.
    pub caption: &'a str,
    /// What x and y are.
    pub axes: [&'a str; 2],
    /// Names of the classes, at most eight; the legend tells those that occur.
    pub classes: &'a [&'a str],
    /// The cells.
    pub cells: Vec<Cell>,
    /// The boundaries.
    pub boundaries: Vec<Boundary>,
}

/// A cell.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cell {
    /// Its place.
    pub at: [f64; 2],
    /// Runs in each class.
    pub counts: Vec<usize>,
}

/// A boundary.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Boundary {
    /// What the legend says.
    pub name: String,
    /// Its points.
    pub points: Vec<[f64; 2]>,
    /// Lower and upper end of the interval at each point, none where it is open; empty without intervals.
    pub intervals: Vec<[Option<f64>; 2]>,
    /// Whether it is dashed.
    pub is_dashed: bool,
}

const SIZE: [usize; 2] = [1400, 900];
const PLOT: Rect = Rect { left: 130.0, right: 960.0, top: 130.0, bottom: 790.0 };
/// Slipping to mixed, told apart by the colour-blind as well (Okabe & Ito, 2008).
const COLOURS: [Rgb; 8] = [
    [225, 225, 220],
    [86, 180, 233],
    [240, 228, 66],
    [213, 94, 0],
    [0, 158, 115],
    [150, 60, 120],
    [90, 90, 90],
    [150, 120, 60],
];
/// Half the width of what stands at the end of a bar: a line across, or the head of an arrow where it is open.
const CAP: f64 = 7.0;
/// Half the length of a boundary that has one point.
const DASH: f64 = 20.0;
const LINES: [Rgb; 3] = [[20, 20, 20], [120, 40, 160], [0, 90, 160]];

impl Regimes<'_> {
    /// The picture as the bytes of a PNG file.
    ///
    /// # Errors
    /// The drawing library's own.
    pub fn to_png(&self) -> Result<Vec<u8>, ReportError> {
        let mut canvas = Canvas::new(SIZE[0], SIZE[1])?;
        let look = Text { size: 34.0, bold: true, align: Align::Left, ..Text::default() };
        canvas.text([PLOT.left, 40.0], self.title, look);
        let small = Text { size: 22.0, bold: false, colour: SOFT, ..look };
        let caption = canvas.fitted(self.caption, small, SIZE[0] as f64 - 1.5 * PLOT.left);
        canvas.text([PLOT.left, 87.0], &caption, small);
        let edges = [0, 1].map(|axis| self.edges(axis));
        let ends = [0, 1].map(|axis| self.ends(&edges[axis], axis));
        for cell in &self.cells {
            self.cell(&mut canvas, cell, &edges, ends)?;
        }
        for (at, boundary) in self.boundaries.iter().enumerate() {
            draw_boundary(&mut canvas, boundary, LINES[at % LINES.len()], ends)?;
        }
        self.frame(&mut canvas, ends)?;
        self.legend(&mut canvas)?;
        canvas.to_png()
    }

    /// Each value of an axis with the ends of its cells, half way to the next.
    fn edges(&self, axis: usize) -> Vec<(f64, f64, f64)> {
        let mut values: Vec<f64> = self.cells.iter().map(|cell| cell.at[axis]).collect();
        values.sort_by(f64::total_cmp);
        values.dedup();
        let half = |a: usize, b: usize| 0.5 * (values[b] - values[a]);
        let last = values.len().saturating_sub(1);
        let around = |at: usize| {
            let below = if at > 0 { half(at - 1, at) } else { half(0, last.min(1)) };
            let above = if at < last { half(at, at + 1) } else { below };
            let alone = if last == 0 { 0.5 } else { 0.0 };
            (values[at], values[at] - below - alone, values[at] + above + alone)
        };
        (0..values.len()).map(around).collect()
    }

    /// The ends of an axis: room for all cells, whose edges are `edges`, and for the points of the boundaries.
    fn ends(&self, edges: &[(f64, f64, f64)], axis: usize) -> (f64, f64) {
        let cells =
            edges.first().zip(edges.last()).map(|((_, low, _), (_, _, high))| (*low, *high));
        let points = self.boundaries.iter().flat_map(|boundary| &boundary.points);
        let wider =
            |(low, high): (f64, f64), at: &[f64; 2]| (low.min(at[axis]), high.max(at[axis]));
        points.fold(cells.unwrap_or((0.0, 1.0)), wider)
    }

    /// A cell, cut into upright strips by the shares of its classes.
    fn cell(
        &self,
        canvas: &mut Canvas,
        cell: &Cell,
        edges: &[Vec<(f64, f64, f64)>; 2],
        ends: [(f64, f64); 2],
    ) -> Result<(), ReportError> {
        let find = |axis: usize| edges[axis].iter().find(|(value, _, _)| *value == cell.at[axis]);
        let (Some((_, left, right)), Some((_, low, high))) = (find(0), find(1)) else {
            return Ok(());
        };
        let total: usize = cell.counts.iter().sum();
        let [top, bottom] = [*high, *low].map(|y| place(ends, [*left, y])[1]);
        let (mut from, mut done) = (*left, 0);
        for (class, count) in cell.counts.iter().enumerate().filter(|(_, count)| **count > 0) {
            done += count;
            let to = left + (right - left) * done as f64 / total as f64;
            let [a, b] = [from, to].map(|x| place(ends, [x, *low])[0]);
            let corners = [[a, top], [b, top], [b, bottom], [a, bottom]];
            canvas.fill(&corners, COLOURS[class % COLOURS.len()])?;
            from = to;
        }
        let [a, b] = [*left, *right].map(|x| place(ends, [x, *low])[0]);
        canvas.frame(&Rect { left: a, right: b, top, bottom }, SOFT)
    }

    fn frame(&self, canvas: &mut Canvas, ends: [(f64, f64); 2]) -> Result<(), ReportError> {
        let (values, decimals) = ticks(ends[0].0, ends[0].1, 8.0);
        for value in values {
            let x = place(ends, [value, ends[1].0])[0];
            canvas.line(&[[x, PLOT.bottom], [x, PLOT.bottom + 8.0]], INK, 1.0)?;
            canvas.text([x, PLOT.bottom + 26.0], &tick_text(value, decimals), Text::default());
        }
        let (values, decimals) = ticks(ends[1].0, ends[1].1, 8.0);
        for value in values {
            let y = place(ends, [ends[0].0, value])[1];
            canvas.line(&[[PLOT.left - 8.0, y], [PLOT.left, y]], INK, 1.0)?;
            let look = Text { align: Align::Right, ..Text::default() };
            canvas.text([PLOT.left - 14.0, y], &tick_text(value, decimals), look);
        }
        canvas.frame(&PLOT, INK)?;
        let middle = [(PLOT.left + PLOT.right) / 2.0, (PLOT.top + PLOT.bottom) / 2.0];
        canvas.text([middle[0], PLOT.bottom + 62.0], self.axes[0], Text::default());
        let upright = Text { upright: true, ..Text::default() };
        canvas.text([PLOT.left - 94.0, middle[1]], self.axes[1], upright);
        Ok(())
    }

    /// Whether a run of any cell ended in `class`.
    fn occurs(&self, class: usize) -> bool {
        self.cells.iter().any(|cell| cell.counts.get(class).is_some_and(|count| *count > 0))
    }

    fn legend(&self, canvas: &mut Canvas) -> Result<(), ReportError> {
        let look = Text { align: Align::Left, ..Text::default() };
        let left = PLOT.right + 30.0;
        let mut down = PLOT.top + 20.0;
        for (class, name) in
            self.classes.iter().enumerate().filter(|(class, _)| self.occurs(*class))
        {
            let [top, bottom] = [down - 11.0, down + 11.0];
            let corners = [[left, top], [left + 30.0, top], [left + 30.0, bottom], [left, bottom]];
            canvas.fill(&corners, COLOURS[class % COLOURS.len()])?;
            canvas.text([left + 44.0, down], name, look);
            down += 38.0;
        }
        let drawn = |(_, boundary): &(usize, &Boundary)| !boundary.points.is_empty();
        for (at, boundary) in self.boundaries.iter().enumerate().filter(drawn) {
            let middle = if boundary.is_dashed { left + 12.0 } else { left + 30.0 };
            canvas.line(&[[left, down], [middle, down]], LINES[at % LINES.len()], 3.0)?;
            canvas.text([left + 44.0, down], &boundary.name, look);
            down += 38.0;
        }
        Ok(())
    }
}

/// Where a point of the map is in the picture.
fn place([x, y]: [(f64, f64); 2], at: [f64; 2]) -> [f64; 2] {
    let share = |(low, high): (f64, f64), value: f64| (value - low) / (high - low);
    [
        PLOT.left + share(x, at[0]) * PLOT.width(),
        PLOT.bottom - share(y, at[1]).clamp(0.0, 1.0) * PLOT.height(),
    ]
}

fn draw_boundary(
    canvas: &mut Canvas,
    boundary: &Boundary,
    colour: Rgb,
    ends: [(f64, f64); 2],
) -> Result<(), ReportError> {
    let line: Vec<[f64; 2]> = boundary.points.iter().map(|at| place(ends, *at)).collect();
    if let [[x, y]] = line[..] {
        canvas.line(&[[x - DASH, y], [x + DASH, y]], colour, 3.0)?;
    }
    for pair in line.windows(2) {
        let pieces = if boundary.is_dashed { 12 } else { 1 };
        for piece in 0..pieces {
            let along = |t: f64| [0, 1].map(|k| pair[0][k] + (pair[1][k] - pair[0][k]) * t);
            let from = f64::from(piece) / f64::from(pieces);
            let length = if boundary.is_dashed { 0.6 } else { 1.0 } / f64::from(pieces);
            canvas.line(&[along(from), along(from + length)], colour, 3.0)?;
        }
    }
    for (at, interval) in boundary.points.iter().zip(&boundary.intervals) {
        let bar = reach(*interval, ends[1]).map(|y| place(ends, [at[0], y]));
        canvas.line(&bar, colour, 2.0)?;
        for (([x, y], end), inwards) in bar.into_iter().zip(interval).zip([-1.0, 1.0]) {
            match end {
                Some(_) => canvas.line(&[[x - CAP, y], [x + CAP, y]], colour, 2.0)?,
                None => {
                    let foot = y + 2.0 * CAP * inwards;
                    canvas.fill(&[[x, y], [x - CAP, foot], [x + CAP, foot]], colour)?;
                }
            }
        }
        canvas.dot(place(ends, *at), 6.0, colour)?;
    }
    Ok(())
}

/// From where to where the bar of an interval goes: to the edges of the map where it is open.
fn reach([from, to]: [Option<f64>; 2], (low, high): (f64, f64)) -> [f64; 2] {
    [from.unwrap_or(low), to.unwrap_or(high)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for an open interval whose bar ends like a closed one, where the values do.
    #[test]
    fn the_bar_of_an_open_interval_goes_to_the_edge() {
        assert_eq!(reach([Some(0.2), Some(1.1)], (-0.1, 1.3)), [0.2, 1.1]);
        assert_eq!(reach([None, Some(1.1)], (-0.1, 1.3)), [-0.1, 1.1]);
        assert_eq!(reach([Some(0.2), None], (-0.1, 1.3)), [0.2, 1.3]);
    }

    /// Fails for a boundary that is drawn along the edge of the cells where it lies beyond them.
    #[test]
    fn a_boundary_beyond_the_cells_has_room() {
        let cells = vec![Cell { at: [1.0, 0.0], counts: vec![1] }];
        let beyond = Boundary { points: vec![[1.0, 1.2], [1.3, 0.2]], ..Boundary::default() };
        let mut map = Regimes {
            title: "",
            caption: "",
            axes: [""; 2],
            classes: &["one"],
            cells,
            boundaries: vec![],
        };
        assert_eq!(map.ends(&map.edges(1), 1), (-0.5, 0.5));
        map.boundaries.push(beyond);
        assert_eq!(map.ends(&map.edges(1), 1), (-0.5, 1.2));
    }

    /// Fails for a legend that tells of what no run came to.
    #[test]
    fn the_legend_tells_the_classes_that_occur() {
        let cells = vec![Cell { at: [0.0; 2], counts: vec![0, 2] }, Cell::default()];
        let classes = &["one", "two", "three"];
        let map =
            Regimes { title: "", caption: "", axes: [""; 2], classes, cells, boundaries: vec![] };
        assert_eq!([0, 1, 2].map(|class| map.occurs(class)), [false, true, false]);
    }

    /// Fails for a map of one cell, or of none, and for cells that overlap where values are uneven.
    #[test]
    fn cells_meet_half_way_and_any_number_of_them_is_drawn() {
        let cell = |x: f64, y: f64| Cell { at: [x, y], counts: vec![1, 2] };
        let mut map = Regimes {
            title: "t",
            caption: "c",
            axes: ["x", "y"],
            classes: &["one", "two"],
            cells: vec![cell(1.0, 0.0), cell(1.2, 0.0), cell(2.0, 0.5)],
            boundaries: Vec::new(),
        };
        let edges: Vec<[f64; 2]> =
            map.edges(0).iter().map(|(_, low, high)| [*low, *high]).collect();
        for (found, expected) in edges.iter().zip([[0.9, 1.1], [1.1, 1.6], [1.6, 2.4]]) {
            assert!((found[0] - expected[0]).abs() < 1e-12, "{edges:?}");
            assert!((found[1] - expected[1]).abs() < 1e-12, "{edges:?}");
        }
        for count in [3, 1, 0] {
            map.cells.truncate(count);
            assert!(map.to_png().unwrap().starts_with(b"\x89PNG"));
        }
    }
}
