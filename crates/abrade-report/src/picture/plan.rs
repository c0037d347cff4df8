//! The upper half: the surface from above, its colour bar, and the places to point at.

use abrade::Nodes;

use super::Mark;
use super::axis::Scale;
use super::canvas::{Align, Canvas, Rect, Text};
use super::colour::{self, INK, Rgb, SOFT, UNTOUCHED, WHITE};
use super::raster::{self, Grid};
use super::view::View;
use crate::error::ReportError;
use crate::units::{of_extent, of_length};

/// Steps of the colour bar.
const SHADES: usize = 512;

/// Draws the plan view into `rect`.
pub(super) fn draw(
    canvas: &mut Canvas,
    rect: &Rect,
    view: &View,
    nodes: &Nodes,
    marks: &[Mark<'_>],
) -> Result<(), ReportError> {
    paint_surface(canvas, rect, view, nodes);
    canvas.frame(rect, INK)?;
    let unit = of_extent(view.high[0] - view.low[0]);
    Scale { ends: [view.low[0], view.high[0]], unit, name: "x" }.below(canvas, rect)?;
    Scale { ends: [view.high[1], view.low[1]], unit, name: "y" }.left(canvas, rect)?;
    match &view.deepest {
        Some(deepest) => {
            colour_bar(canvas, rect, deepest.depth)?;
            section_line(canvas, rect, view.share(deepest.at)[1])?;
        }
        None => {
            // Above the middle, where marks are likely.
            let middle = [(rect.left + rect.right) / 2.0, rect.top + 0.36 * rect.height()];
            canvas.text(middle, "no wear", Text { size: 34.0, colour: SOFT, ..Text::default() });
        }
    }
    marks.iter().try_for_each(|mark| point_at(canvas, rect, view, mark))
}

/// Colours every pixel by the depth there; beyond the surface's rim it stays white.
fn paint_surface(canvas: &mut Canvas, rect: &Rect, view: &View, nodes: &Nodes) {
    let size = rect.sheet_size();
    let step = [0, 1].map(|k| (view.high[k] - view.low[k]) / size[k] as f64);
    let grid = Grid {
        origin: [view.low[0] + step[0] / 2.0, view.high[1] - step[1] / 2.0],
        step: [step[0], -step[1]],
        size,
    };
    let field = grid.spread(view.nodes_in(nodes, view.low, view.high, raster::REACH));
    let largest = view.deepest.as_ref().map_or(1.0, |deepest| deepest.depth);
    let shades = shades();
    canvas.paint(rect, |column, row| {
        let depth = f64::from(field[row * size[0] + column]);
        let on_surface = view.on_surface([grid.at(0, column), grid.at(1, row)]);
        (depth.is_finite() && on_surface).then(|| shade(&shades, depth / largest))
    });
}

pub(super) fn shades() -> Vec<Rgb> {
    (0..SHADES).map(|i| colour::of_share(i as f64 / (SHADES - 1) as f64)).collect()
}

pub(super) fn shade(shades: &[Rgb], share: f64) -> Rgb {
    match share > 0.0 {
        true => shades[((share * (SHADES - 1) as f64).round() as usize).min(SHADES - 1)],
        false => UNTOUCHED,
    }
}

pub(super) fn colour_bar(
    canvas: &mut Canvas,
    rect: &Rect,
    largest: f64,
) -> Result<(), ReportError> {
    let bar = Rect { left: rect.right + 32.0, right: rect.right + 60.0, ..*rect };
    let bar = Rect { top: bar.top + 40.0, ..bar };
    let [_, rows] = bar.sheet_size();
    let shades = shades();
    canvas.paint(&bar, |_, row| Some(shades[row * SHADES / rows]));
    canvas.frame(&bar, INK)?;
    Scale { ends: [0.0, largest], unit: of_length(largest), name: "depth" }.right(canvas, &bar)
}

/// Arrows at both sides where the cross-section runs.
fn section_line(canvas: &mut Canvas, rect: &Rect, down: f64) -> Result<(), ReportError> {
    let y = rect.top + down * rect.height();
    for (edge, inward) in [(rect.left, 1.0), (rect.right, -1.0)] {
        let foot = edge + 2.0 * inward;
        let tip = edge + 14.0 * inward;
        canvas.fill(&[[foot, y - 6.0], [tip, y], [foot, y + 6.0]], INK)?;
        for dash in 0..3 {
            let from = tip + inward * (4.0 + 12.0 * f64::from(dash));
            canvas.line(&[[from, y], [from + 7.0 * inward, y]], INK, 1.0)?;
        }
    }
    Ok(())
}

/// A ring with a name, unless it lies outside the view.
fn point_at(
    canvas: &mut Canvas,
    rect: &Rect,
    view: &View,
    mark: &Mark<'_>,
) -> Result<(), ReportError> {
    name_place(canvas, rect, view.share(view.project(&mark.position_local)), mark.label)
}

/// A ring with a name at a share of the width and height of `rect`, unless that is outside.
pub(super) fn name_place(
    canvas: &mut Canvas,
    rect: &Rect,
    share: [f64; 2],
    label: &str,
) -> Result<(), ReportError> {
    if !share.iter().all(|s| (0.0..=1.0).contains(s)) {
        return Ok(());
    }
    let [x, y] = [rect.left + share[0] * rect.width(), rect.top + share[1] * rect.height()];
    canvas.dot([x, y], 6.0, WHITE)?;
    canvas.dot([x, y], 4.5, INK)?;
    let leftward = share[0] > 0.85;
    let align = if leftward { Align::Right } else { Align::Left };
    let at = [x + if leftward { -13.0 } else { 13.0 }, y];
    // A light rim keeps the name readable on every colour.
    for turn in 0..12 {
        let (dy, dx) = (f64::from(turn) * std::f64::consts::PI / 6.0).sin_cos();
        let rim = Text { colour: WHITE, align, ..Text::default() };
        canvas.text([at[0] + 2.5 * dx, at[1] + 2.5 * dy], label, rim);
    }
    canvas.text(at, label, Text { align, ..Text::default() });
    Ok(())
}
