//! The lower half: depth along x through the deepest node. What was worn off carries the colours
//! of the plan view, what is left is grey.

use abrade::Nodes;

use super::axis::Scale;
use super::canvas::{Align, Canvas, Rect, SCALE, Text};
use super::colour::{self, BODY, INK, SOFT, WHITE, blend};
use super::raster::{self, Grid};
use super::view::View;
use crate::error::ReportError;
use crate::units::{of_extent, of_length, tick_text};

/// From the top of the half to the undeformed surface [pixels].
const AIR: f64 = 28.0;
/// Width of the outline [pixels].
const LINE: f64 = 2.0;
/// Share of the room below the surface that the deepest node may take.
const FULL: f64 = 0.9;
/// Depth that an untouched surface's axis shows, as a share of the width.
const UNTOUCHED_RANGE: f64 = 0.01;

/// A vertical scale: how often the depth is exaggerated, and the depth of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Stretch {
    factor: f64,
    /// Depth of a picture pixel [m].
    pixel: f64,
}

/// Draws the cross-section into `rect`.
pub(super) fn draw(
    canvas: &mut Canvas,
    rect: &Rect,
    view: &View,
    nodes: &Nodes,
) -> Result<(), ReportError> {
    let width = view.high[0] - view.low[0];
    let largest = view.deepest.as_ref().map_or(0.0, |deepest| deepest.depth);
    let range = if largest > 0.0 { largest } else { UNTOUCHED_RANGE * width };
    let stretch = Stretch::of(width / rect.width(), range, FULL * (rect.height() - AIR));
    let y = view.deepest.as_ref().map_or((view.low[1] + view.high[1]) / 2.0, |d| d.at[1]);
    let profile = profile(rect, view, nodes, y);
    paint(canvas, rect, &profile, largest, stretch);
    canvas.frame(rect, INK)?;
    let below = Rect { top: rect.top + AIR, ..*rect };
    let ends = [0.0, below.height() * stretch.pixel];
    Scale { ends, unit: of_length(range), name: "depth" }.left(canvas, &below)?;
    let unit = of_extent(width);
    Scale { ends: [view.low[0], view.high[0]], unit, name: "x" }.below(canvas, rect)?;
    let place = trimmed(y / unit.size, 3);
    let title = format!("cross-section at y = {place} {}, {}", unit.name, stretch.words());
    let look = Text { align: Align::Left, colour: SOFT, ..Text::default() };
    canvas.text([rect.left, rect.top - 20.0], &title, look);
    Ok(())
}

/// Depth in every column of the sheet [m]; NaN beyond the surface's rim.
fn profile(rect: &Rect, view: &View, nodes: &Nodes, y: f64) -> Vec<f64> {
    let [columns, _] = rect.sheet_size();
    let step = (view.high[0] - view.low[0]) / columns as f64;
    let grid =
        Grid { origin: [view.low[0] + step / 2.0, y], step: [step, step], size: [columns, 1] };
    let [low, high] = [[view.low[0], y], [view.high[0], y]];
    let field = grid.spread(view.nodes_in(nodes, low, high, raster::REACH));
    let inside = |column: usize| view.on_surface([grid.at(0, column), y]);
    let kept = |(column, depth): (usize, &f32)| match inside(column) {
        true => f64::from(*depth),
        false => f64::NAN,
    };
    field.iter().enumerate().map(kept).collect()
}

/// Above the surface nothing, then what was worn off, the outline, and what is left.
fn paint(canvas: &mut Canvas, rect: &Rect, profile: &[f64], largest: f64, stretch: Stretch) {
    let per_pixel = stretch.pixel / SCALE as f64;
    let air = AIR * SCALE as f64;
    let line: Vec<f64> = profile.iter().map(|depth| depth / per_pixel).collect();
    let bands: Vec<_> = (0..line.len()).map(|column| band(&line, column)).collect();
    canvas.paint(rect, |column, row| {
        let here = row as f64 + 0.5 - air;
        let away = here - line[column];
        let ground = match (here < 0.0, away < 0.0) {
            (true, _) => WHITE,
            (false, true) => colour::of_share(here * per_pixel / largest),
            (false, false) => BODY,
        };
        if away.is_nan() || !(bands[column].0..=bands[column].1).contains(&here) {
            return (!away.is_nan()).then_some(ground);
        }
        let cover = LINE * SCALE as f64 / 2.0 + 0.5 - distance(&line, column, here);
        Some(blend(ground, INK, cover))
    });
}

/// Columns on each side that may be nearer to a point than its own.
const REACH: usize = LINE as usize * SCALE;

/// The heights between which the line can be near a column [sheet pixels].
fn band(line: &[f64], column: usize) -> (f64, f64) {
    let near = &line[column.saturating_sub(REACH)..(column + REACH + 1).min(line.len())];
    let low = near.iter().copied().fold(f64::INFINITY, f64::min);
    let high = near.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    (low - REACH as f64, high + REACH as f64)
}

/// Distance of a point in the middle of `column`, `down` below the surface, from a line with one
/// height per column [sheet pixels].
fn distance(line: &[f64], column: usize, down: f64) -> f64 {
    let columns = column.saturating_sub(REACH)..(column + REACH).min(line.len() - 1);
    let near = columns.map(|i| {
        let (x, y, rise) = (column as f64 - i as f64, down - line[i], line[i + 1] - line[i]);
        let along = ((x + y * rise) / (1.0 + rise * rise)).clamp(0.0, 1.0);
        (x - along).hypot(y - along * rise)
    });
    near.filter(|d| d.is_finite()).fold(f64::INFINITY, f64::min)
}

impl Stretch {
    /// The largest round exaggeration that keeps `depth` [m] within `room` [pixels], where a
    /// pixel is `along` [m] wide.
    fn of(along: f64, depth: f64, room: f64) -> Self {
        let most = along * room / depth;
        let decade = 10.0_f64.powf(most.log10().floor());
        let steps = [8.0, 6.0, 5.0, 4.0, 3.0, 2.5, 2.0, 1.5, 1.0];
        let step = steps.into_iter().find(|step| step * decade <= most).unwrap_or(1.0);
        let factor = step * decade;
        Self { factor, pixel: along / factor }
    }

    fn words(self) -> String {
        match self.factor {
            f if (f - 1.0).abs() < 1e-9 => "true proportions".to_owned(),
            f if f > 1.0 => format!("depth exaggerated {}×", trimmed(f, 6)),
            f => format!("depth shortened to {}×", trimmed(f, 6)),
        }
    }
}

/// At most `decimals` decimals, without trailing zeros.
fn trimmed(value: f64, decimals: usize) -> String {
    let text = tick_text(value, decimals);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A program that measured the distance straight down would draw a steep wall as a hair, or
    /// let it stand above its own ends.
    #[test]
    fn a_wall_is_as_wide_as_a_floor() {
        let line = [vec![0.0; 10], vec![50.0; 10]].concat();
        assert!((distance(&line, 5, 3.0) - 3.0).abs() < 1e-12);
        assert!((distance(&line, 9, 25.0) - 0.5).abs() < 0.02);
        assert!((distance(&line, 9, -20.0) - 20.0).abs() < 1e-12);
    }

    /// A program that inverted the ratio would flatten a shallow crater, one that rounded up
    /// would let the deepest node fall out of the frame.
    #[test]
    fn the_exaggeration_is_round_and_fits() {
        // 1 mm over 1000 pixels; 10 um deep; 100 pixels of room: at most 10.
        let stretch = Stretch::of(1e-6, 1e-5, 100.0);
        assert!((stretch.factor - 10.0).abs() < 2.1, "{stretch:?}");
        assert!(1e-5 / stretch.pixel <= 100.0 * (1.0 + 1e-12));
        assert_eq!(Stretch::of(1e-6, 1e-4, 120.0).words(), "true proportions");
        assert_eq!(Stretch::of(1e-6, 1e-4, 1299.0).words(), "depth exaggerated 10×");
        assert_eq!(Stretch::of(1e-6, 1e-4, 55.0).words(), "depth shortened to 0.5×");
    }
}
