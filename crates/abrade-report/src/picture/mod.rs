//! `surface.png`: a worn plate from above, coloured by depth, and a cross-section along x through
//! its deepest node; or a worn solid and its deepest crater, shaded, from a side that shows it.
//!
//! Of a plate, `view` chooses what is seen, `raster` spreads the nodes over pixels, `plan` and
//! `section` draw the two halves on a `canvas`; the cost is bounded by pixels and by the nodes
//! inside the view. Of a solid, `camera` chooses the side, `shading` draws its facets, `solid` lays
//! out the panels; the cost is bounded by pixels and facets.

mod axis;
mod camera;
pub(crate) mod canvas;
pub(crate) mod colour;
pub(crate) mod gallery;
mod letters;
mod plan;
mod raster;
pub(crate) mod regimes;
pub(crate) mod rounds;
mod scale_bar;
mod section;
mod shading;
mod slope;
mod solid;
mod view;

use std::path::Path;

use abrade::Nodes;
use nalgebra::Point3;

use crate::atomic;
use crate::error::ReportError;
use crate::units::{counted, of_length, of_volume, with_unit};
use canvas::{Align, Canvas, Rect, Text};
pub use colour::depth_colours;
pub use solid::SolidPicture;
use view::View;

/// A picture of a plate.
#[derive(Clone, Copy, Debug)]
pub struct Picture<'a> {
    /// Headline, usually the scene's name.
    pub title: &'a str,
    /// The surface since it was made; drawn in its own frame, seen against its mean normal.
    pub nodes: &'a Nodes,
    /// Its wear volume, W_V [m3].
    pub wear_volume: f64,
    /// Places to point at, such as where a body ended.
    pub marks: &'a [Mark<'a>],
}

/// A place on the surface and its name.
#[derive(Clone, Copy, Debug)]
pub struct Mark<'a> {
    /// Text beside the place.
    pub label: &'a str,
    /// In the surface's frame [m].
    pub position_local: Point3<f64>,
}

/// Width of a picture [pixels]; its height follows the shape of the worn region.
pub const WIDTH: usize = 1400;

/// Left and right edge of both halves [pixels].
const SIDES: (f64, f64) = (116.0, 1240.0);
/// Top of the plan view [pixels].
const PLAN_TOP: f64 = 124.0;
/// Least and largest height of the plan view [pixels].
const PLAN_HEIGHT: (f64, f64) = (320.0, 720.0);
/// From the plan view to the cross-section [pixels].
const GAP: f64 = 116.0;
/// Height of the cross-section [pixels].
const SECTION_HEIGHT: f64 = 240.0;
/// Below the cross-section [pixels].
const FOOT: f64 = 80.0;

impl Picture<'_> {
    /// The picture as the bytes of a PNG file.
    ///
    /// # Errors
    /// The drawing library's own.
    pub fn to_png(&self) -> Result<Vec<u8>, ReportError> {
        let width = SIDES.1 - SIDES.0;
        let view = View::of(self.nodes, PLAN_HEIGHT.0 / width, PLAN_HEIGHT.1 / width);
        let plan = Rect {
            left: SIDES.0,
            right: SIDES.1,
            top: PLAN_TOP,
            bottom: PLAN_TOP + (width * view.aspect()).round(),
        };
        let top = plan.bottom + GAP;
        let section = Rect { top, bottom: top + SECTION_HEIGHT, ..plan };
        let mut canvas = Canvas::new(WIDTH, (section.bottom + FOOT) as usize)?;
        head(&mut canvas, SIDES.0, self.title, &caption(self.nodes, self.wear_volume));
        plan::draw(&mut canvas, &plan, &view, self.nodes, self.marks)?;
        section::draw(&mut canvas, &section, &view, self.nodes)?;
        canvas.to_png()
    }

    /// Writes the picture to `path`.
    ///
    /// # Errors
    /// The drawing library's own, or the file system refuses.
    pub fn write(&self, path: &Path) -> Result<(), ReportError> {
        atomic::write(path, &self.to_png()?)
    }
}

/// Title and caption, their left edge at `left`.
fn head(canvas: &mut Canvas, left: f64, title: &str, caption: &str) {
    let look = Text { size: 34.0, bold: true, align: Align::Left, ..Text::default() };
    let line = canvas.fitted(title, look, WIDTH as f64 - 1.5 * SIDES.0);
    canvas.text([left, 40.0], &line, look);
    let small = Text { size: 22.0, bold: false, colour: colour::SOFT, ..look };
    canvas.text([left, 87.0], caption, small);
}

/// The figures of `nodes`, whose wear volume is `volume` [m3].
fn caption(nodes: &Nodes, volume: f64) -> String {
    let deepest = nodes.depth.iter().copied().fold(0.0, f64::max);
    if deepest == 0.0 {
        return format!("no wear  ·  {}", of_nodes(nodes));
    }
    let worn = nodes.depth.iter().filter(|depth| **depth > 0.0).count();
    format!(
        "displaced {}  ·  largest depth {}  ·  {} of {} worn",
        with_unit(volume, of_volume(volume)),
        with_unit(deepest, of_length(deepest)),
        counted(worn),
        of_nodes(nodes),
    )
}

fn of_nodes(nodes: &Nodes) -> String {
    match nodes.len() {
        1 => "1 node".to_owned(),
        count => format!("{} nodes", counted(count)),
    }
}

#[cfg(test)]
mod tests;
