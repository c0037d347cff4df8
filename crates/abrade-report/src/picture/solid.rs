//! A worn solid in two panels: the whole of it, and the surroundings of its deepest crater. Where
//! the crater is as large as the solid, the first panel stands alone.

use std::collections::BTreeMap;
use std::path::Path;

use abrade::Nodes;

use super::camera::Camera;
use super::canvas::{Align, Canvas, Rect, Text};
use super::colour::{INK, SOFT};
use super::shading::{self, Window};
use super::{Mark, WIDTH, caption, head, plan};
use crate::atomic;
use crate::error::ReportError;
use crate::units::{of_extent, tick_text, ticks};

/// Left and right edge of the panels [pixels].
const SIDES: (f64, f64) = (60.0, 1240.0);
/// Their top and bottom [pixels].
const HEIGHT: (f64, f64) = (152.0, 712.0);
/// Between the panels [pixels].
const GAP: f64 = 60.0;
/// Below them [pixels].
const FOOT: f64 = 78.0;
/// Free room around the solid and around the crater, as a share of their size.
const MARGIN: [f64; 2] = [0.06, 0.25];
/// Least size of the second panel, in node distances.
const LEAST_NODES: f64 = 14.0;
/// A crater above this share of the solid needs no panel of its own.
const LARGE: f64 = 0.6;
/// Length of the arrows that show the axes [pixels].
const ARROW: f64 = 40.0;

/// A picture of a solid.
#[derive(Clone, Copy, Debug)]
pub struct SolidPicture<'a> {
    /// Headline, usually the scene's name.
    pub title: &'a str,
    /// The surface of the solid since it was made ([`abrade::Surface::nodes_since_made`]), in its
    /// own frame.
    pub nodes: &'a Nodes,
    /// Facets between the nodes, counter-clockwise as seen from outside.
    pub triangles: &'a [[u32; 3]],
    /// Its wear volume, W_V [m3].
    pub wear_volume: f64,
    /// Places to point at.
    pub marks: &'a [Mark<'a>],
}

impl SolidPicture<'_> {
    /// The picture as the bytes of a PNG file.
    ///
    /// # Errors
    /// The drawing library's own.
    pub fn to_png(&self) -> Result<Vec<u8>, ReportError> {
        let nodes = self.nodes;
        let deepest = (0..nodes.len()).max_by(|&a, &b| nodes.depth[a].total_cmp(&nodes.depth[b]));
        let deepest = deepest.filter(|&i| nodes.depth[i] > 0.0);
        let camera = Camera::of(nodes, self.triangles, deepest);
        let mut canvas = Canvas::new(WIDTH, (HEIGHT.1 + FOOT) as usize)?;
        head(&mut canvas, SIDES.0, self.title, &caption(nodes, self.wear_volume));
        let whole = self.bounds(&camera);
        let size = span(&whole).into_iter().fold(0.0, f64::max);
        let crater = deepest.map(|i| self.crater(&camera, i));
        let crater = crater.filter(|square| span(square)[0] < LARGE * size);
        let side = HEIGHT.1 - HEIGHT.0;
        let all = Rect { left: SIDES.0, right: SIDES.1, top: HEIGHT.0, bottom: HEIGHT.1 };
        let first = if crater.is_some() { Rect { right: SIDES.0 + side, ..all } } else { all };
        let window = fitted(&widened(whole, MARGIN[0] * size), &first);
        self.panel(&mut canvas, &first, &camera, &window)?;
        note(&mut canvas, &first, &seen_from(&camera));
        axes(&mut canvas, &first, &camera)?;
        if let Some(square) = crater {
            outline(&mut canvas, &first, &window, &square)?;
            let second = Rect { left: SIDES.0 + side + GAP, ..all };
            self.panel(&mut canvas, &second, &camera, &fitted(&square, &second))?;
            note(&mut canvas, &second, "around the deepest node");
        }
        for mark in self.marks {
            let [x, y, _] = camera.project(&mark.position_local);
            plan::name_place(&mut canvas, &first, window.share([x, y]), mark.label)?;
        }
        if let Some(deepest) = deepest {
            plan::colour_bar(&mut canvas, &all, nodes.depth[deepest])?;
        }
        canvas.to_png()
    }

    /// Writes the picture to `path`.
    ///
    /// # Errors
    /// The drawing library's own, or the file system refuses.
    pub fn write(&self, path: &Path) -> Result<(), ReportError> {
        atomic::write(path, &self.to_png()?)
    }

    fn panel(
        &self,
        canvas: &mut Canvas,
        rect: &Rect,
        camera: &Camera,
        window: &Window,
    ) -> Result<(), ReportError> {
        let largest = self.nodes.depth.iter().copied().fold(0.0, f64::max);
        let pixels = shading::draw(self.nodes, self.triangles, camera, window, largest);
        canvas.paint(rect, |column, row| pixels[row * window.size[0] + column]);
        canvas.frame(rect, INK)?;
        scale_bar(canvas, rect, window.high[0] - window.low[0])
    }

    /// Corners of the solid in the picture plane [m].
    fn bounds(&self, camera: &Camera) -> [[f64; 2]; 2] {
        around((0..self.nodes.len()).map(|i| camera.project(&self.nodes.rest_position[i])))
    }

    /// A square around the worn nodes that hang together with the deepest one [m].
    fn crater(&self, camera: &Camera, deepest: usize) -> [[f64; 2]; 2] {
        let nodes = self.nodes;
        let worn = connected(nodes, self.triangles, deepest);
        let facing = worn.iter().filter(|&&i| nodes.normal[i as usize].dot(&camera.toward) > 0.0);
        let places = facing.map(|&i| camera.project(&nodes.rest_position[i as usize]));
        let found = around(places.chain([camera.project(&nodes.rest_position[deepest])]));
        let spacing = nodes.rest_area[deepest].sqrt();
        let size = span(&found).into_iter().fold(0.0, f64::max) * (1.0 + 2.0 * MARGIN[1]);
        let half = 0.5 * size.max(LEAST_NODES * spacing);
        let middle = [0, 1].map(|k| 0.5 * (found[0][k] + found[1][k]));
        [middle.map(|x| x - half), middle.map(|x| x + half)]
    }
}

/// The worn nodes that are joined to `from` by edges between worn nodes, in rising order.
fn connected(nodes: &Nodes, triangles: &[[u32; 3]], from: usize) -> Vec<u32> {
    let mut near: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for [a, b, c] in triangles {
        for [one, other] in [[a, b], [b, c], [c, a]] {
            if [one, other].iter().all(|i| nodes.depth[**i as usize] > 0.0) {
                near.entry(*one).or_default().push(*other);
                near.entry(*other).or_default().push(*one);
            }
        }
    }
    let mut found = std::collections::BTreeSet::from([from as u32]);
    let mut open = vec![from as u32];
    while let Some(node) = open.pop() {
        let next = near.get(&node).into_iter().flatten();
        open.extend(next.copied().filter(|other| found.insert(*other)));
    }
    found.into_iter().collect()
}

fn around(places: impl Iterator<Item = [f64; 3]>) -> [[f64; 2]; 2] {
    let start = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    let found = places.fold(start, |[low, high], p| {
        [[0, 1].map(|k| low[k].min(p[k])), [0, 1].map(|k| high[k].max(p[k]))]
    });
    if found[0][0].is_finite() { found } else { [[0.0; 2]; 2] }
}

fn span([low, high]: &[[f64; 2]; 2]) -> [f64; 2] {
    [0, 1].map(|k| high[k] - low[k])
}

fn widened([low, high]: [[f64; 2]; 2], room: f64) -> [[f64; 2]; 2] {
    [low.map(|x| x - room), high.map(|x| x + room)]
}

/// The smallest window of the form of `rect` around the corners.
fn fitted(corners: &[[f64; 2]; 2], rect: &Rect) -> Window {
    let [width, height] = span(corners);
    let pixel = (width / rect.width()).max(height / rect.height());
    let pixel = if pixel > 0.0 { pixel } else { 1e-6 };
    let half = [rect.width(), rect.height()].map(|side| 0.5 * side * pixel);
    let middle = [0, 1].map(|k| 0.5 * (corners[0][k] + corners[1][k]));
    Window {
        low: [0, 1].map(|k| middle[k] - half[k]),
        high: [0, 1].map(|k| middle[k] + half[k]),
        size: rect.sheet_size(),
    }
}

fn seen_from(camera: &Camera) -> String {
    let part = |x: f64| tick_text(x, 2);
    let [x, y, z] = [camera.toward.x, camera.toward.y, camera.toward.z].map(part);
    let cut = if camera.cuts() { ", cut open" } else { "" };
    format!("seen from ({x}, {y}, {z}){cut}")
}

fn note(canvas: &mut Canvas, rect: &Rect, text: &str) {
    let look = Text { align: Align::Left, colour: SOFT, ..Text::default() };
    canvas.text([rect.left, rect.top - 20.0], text, look);
}

/// A length below the lower right corner; `width` [m] is that of the panel.
fn scale_bar(canvas: &mut Canvas, rect: &Rect, width: f64) -> Result<(), ReportError> {
    let unit = of_extent(width);
    let (steps, decimals) = ticks(0.0, width / unit.size, rect.width() / 120.0);
    let Some(&length) = steps.get(1) else { return Ok(()) };
    let right = rect.right - 2.0;
    let left = right - length * unit.size / width * rect.width();
    let y = rect.bottom + 22.0;
    canvas.line(&[[left, y], [right, y]], INK, 2.0)?;
    for x in [left, right] {
        canvas.line(&[[x, y - 7.0], [x, y + 7.0]], INK, 2.0)?;
    }
    let text = format!("{}\u{a0}{}", tick_text(length, decimals), unit.name);
    canvas.text([0.5 * (left + right), y + 26.0], &text, Text::default());
    Ok(())
}

/// Arrows along the axes of the surface's frame, in the lower left corner.
fn axes(canvas: &mut Canvas, rect: &Rect, camera: &Camera) -> Result<(), ReportError> {
    let foot = [rect.left + 1.7 * ARROW, rect.bottom - 1.7 * ARROW];
    for (k, name) in ["x", "y", "z"].into_iter().enumerate() {
        let tip = [camera.across[k], -camera.up[k]];
        let at = |share: f64| [0, 1].map(|i| foot[i] + share * ARROW * tip[i]);
        canvas.line(&[foot, at(1.0)], INK, 2.0)?;
        if tip[0].hypot(tip[1]) > 0.2 {
            canvas.text(at(1.35), name, Text { size: 18.0, ..Text::default() });
        }
    }
    Ok(())
}

/// A frame in the first panel around what the second one shows.
fn outline(
    canvas: &mut Canvas,
    rect: &Rect,
    window: &Window,
    [low, high]: &[[f64; 2]; 2],
) -> Result<(), ReportError> {
    let place = |corner: [f64; 2]| {
        let [x, y] = window.share(corner);
        [rect.left + x * rect.width(), rect.top + y * rect.height()]
    };
    let ([left, bottom], [right, top]) = (place(*low), place(*high));
    canvas.frame(&Rect { left, right, top, bottom }, INK)
}

#[cfg(test)]
pub(crate) mod tests;
