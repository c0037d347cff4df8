//! The lower half: depth along x through the deepest node. What was worn off carries the colours
//! of the plan view, what is left is grey.

use abrade::Nodes;

use super::axis::Scale;
use super::canvas::{Align, Canvas, Rect, Text};
use super::colour::{self, BODY, INK, SOFT};
use super::raster::{self, Grid};
use super::view::View;
use crate::error::ReportError;
use crate::units::{of_extent, of_length, tick_text};

/// From the top of the half to the undeformed surface [pixels].
const AIR: f64 = 26.0;
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
    outline(canvas, rect, &profile, stretch)?;
    canvas.frame(rect, INK)?;
    let below = Rect { top: rect.top + AIR, ..*rect };
    let ends = [0.0, below.height() * stretch.pixel];
    Scale { ends, unit: of_length(range), name: "depth" }.left(canvas, &below)?;
    let unit = of_extent(width);
    Scale { ends: [view.low[0], view.high[0]], unit, name: "x" }.below(canvas, rect)?;
    let place = tick_text(y / unit.size, 3);
    let title = format!("cross-section at y = {place} {}, {}", unit.name, stretch.words());
    let look = Text { align: Align::LEFT, colour: SOFT, ..Text::default() };
    canvas.text([rect.left, rect.top - 16.0], &title, look)
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

fn paint(canvas: &mut Canvas, rect: &Rect, profile: &[f64], largest: f64, stretch: Stretch) {
    let per_pixel = stretch.pixel / super::canvas::SCALE as f64;
    let air = AIR * super::canvas::SCALE as f64;
    canvas.paint(rect, |column, row| {
        let here = (row as f64 + 0.5 - air) * per_pixel;
        let depth = profile[column];
        match here < 0.0 || depth.is_nan() {
            true => None,
            false if here < depth => Some(colour::of_share(here / largest)),
            false => Some(BODY),
        }
    });
}

fn outline(
    canvas: &mut Canvas,
    rect: &Rect,
    profile: &[f64],
    stretch: Stretch,
) -> Result<(), ReportError> {
    let surface = rect.top + AIR;
    let point = |(column, depth): (usize, &f64)| {
        let x = rect.left + (column as f64 + 0.5) / super::canvas::SCALE as f64;
        [x, surface + depth / stretch.pixel]
    };
    let points: Vec<_> = profile.iter().enumerate().map(point).collect();
    for piece in points.split(|p| p[1].is_nan()).filter(|piece| piece.len() > 1) {
        canvas.line(piece, INK, 1.5)?;
    }
    Ok(())
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
            f if f > 1.0 => format!("depth exaggerated {}×", trimmed(f)),
            f => format!("depth shortened to {}×", trimmed(f)),
        }
    }
}

/// A round factor without the noise of its last digits.
fn trimmed(factor: f64) -> String {
    let text = format!("{factor:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

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
