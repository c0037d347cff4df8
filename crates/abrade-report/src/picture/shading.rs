//! Facets of a solid on a sheet of pixels: the nearest one wins, coloured by depth, shaded by how
//! it is turned. What is seen from within the material is where the solid is cut open.

use abrade::Nodes;

use super::camera::Camera;
use super::colour::{BODY, Rgb, UNTOUCHED, WHITE, blend};
use super::plan::{shade, shades};

/// Where the light comes from, across, up and towards the eye.
const LIGHT: [f64; 3] = [-0.35, 0.55, 0.76];
/// Darkest share of the light on grey and on coloured facets: colours must stay those of the bar.
const DARK: [f64; 2] = [0.45, 0.75];
/// A pixel is worn where worn nodes have this share of the weight.
const WORN: f64 = 0.4;
/// Colour of shade.
const NIGHT: Rgb = [52, 56, 66];

/// Pixels in rows and the part of the picture plane that they show.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    /// Low and high corner [m].
    pub(super) low: [f64; 2],
    pub(super) high: [f64; 2],
    /// Columns and rows.
    pub(super) size: [usize; 2],
}

impl Window {
    /// Where a point of the plane stands, in pixels from the upper left corner.
    fn pixel(&self, at: [f64; 3]) -> [f64; 2] {
        let [x, y] = self.share([at[0], at[1]]);
        [x * self.size[0] as f64, y * self.size[1] as f64]
    }

    /// The same as shares of width and height.
    pub(super) fn share(&self, at: [f64; 2]) -> [f64; 2] {
        let [x, y] = [0, 1].map(|k| (at[k] - self.low[k]) / (self.high[k] - self.low[k]));
        [x, 1.0 - y]
    }
}

/// A facet as the eye sees it.
struct Seen {
    corners: [[f64; 2]; 3],
    /// Twice its area, signed: above zero if it faces the eye [pixels].
    area: f64,
    near: [f64; 3],
    depth: [f64; 3],
    light: f64,
}

/// The picture of a solid, row by row; `None` beside it. `largest` [m] is the depth at the end of
/// the colours.
pub(super) fn draw(
    nodes: &Nodes,
    triangles: &[[u32; 3]],
    camera: &Camera,
    window: &Window,
    largest: f64,
) -> Vec<Option<Rgb>> {
    let count = window.size[0] * window.size[1];
    let (mut pixels, mut nearest) = (vec![None; count], vec![f64::NEG_INFINITY; count]);
    let shades = shades();
    for corners in triangles {
        let Some(facet) = see(nodes, corners, camera, window) else { continue };
        let [columns, rows] = [0, 1].map(|k| facet.range(k, window.size[k]));
        for row in rows {
            for column in columns.clone() {
                let at = [column as f64 + 0.5, row as f64 + 0.5];
                let Some(weights) = facet.weights(at) else { continue };
                let near = mean(&weights, &facet.near);
                let i = row * window.size[0] + column;
                if near > nearest[i] && near <= camera.cut {
                    nearest[i] = near;
                    pixels[i] = Some(facet.colour(&weights, &shades, largest));
                }
            }
        }
    }
    pixels
}

fn mean(weights: &[f64; 3], values: &[f64; 3]) -> f64 {
    weights.iter().zip(values).map(|(weight, value)| weight * value).sum()
}

/// The facet, unless it is seen edge-on.
fn see(nodes: &Nodes, corners: &[u32; 3], camera: &Camera, window: &Window) -> Option<Seen> {
    let places = corners.map(|i| nodes.position(i as usize));
    let [a, b, c] = places;
    let normal = (b - a).cross(&(c - a)).try_normalize(0.0)?;
    let places = places.map(|place| camera.project(&place));
    let corners_seen = places.map(|place| window.pixel(place));
    let [p, q, r] = corners_seen;
    // Rows run down, so the sign is turned.
    let area = (r[0] - p[0]) * (q[1] - p[1]) - (q[0] - p[0]) * (r[1] - p[1]);
    let axes = [camera.across, camera.up, camera.toward];
    let light: f64 = axes.iter().zip(LIGHT).map(|(axis, part)| axis.dot(&normal) * part).sum();
    (area != 0.0).then(|| Seen {
        corners: corners_seen,
        area,
        near: places.map(|place| place[2]),
        depth: corners.map(|i| nodes.depth[i as usize]),
        light: light.max(0.0),
    })
}

impl Seen {
    /// Columns (0) or rows (1) that it may cover, of `size`.
    fn range(&self, k: usize, size: usize) -> std::ops::Range<usize> {
        let ends = self.corners.map(|corner| corner[k]);
        let low = ends.iter().copied().fold(f64::INFINITY, f64::min);
        let high = ends.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let first = (low - 0.5).ceil().max(0.0) as usize;
        first..((high + 0.5).floor().max(0.0) as usize).clamp(first, size.max(first))
    }

    /// Shares of the corners at a pixel inside.
    fn weights(&self, at: [f64; 2]) -> Option<[f64; 3]> {
        let part = |i: usize| {
            let [from, to] = [self.corners[(i + 1) % 3], self.corners[(i + 2) % 3]];
            let cross =
                (at[0] - from[0]) * (to[1] - from[1]) - (to[0] - from[0]) * (at[1] - from[1]);
            cross / self.area
        };
        let weights = [part(0), part(1), part(2)];
        weights.iter().all(|weight| *weight >= 0.0).then_some(weights)
    }

    fn colour(&self, weights: &[f64; 3], shades: &[Rgb], largest: f64) -> Rgb {
        if self.area < 0.0 {
            // The cut face of the solid.
            return blend(BODY, NIGHT, 0.35);
        }
        let worn = self.depth.map(|depth| f64::from(u8::from(depth > 0.0)));
        let is_worn = mean(weights, &worn) >= WORN;
        let (colour, dark) = match is_worn {
            true => (shade(shades, mean(weights, &self.depth) / largest), DARK[1]),
            false => (blend(UNTOUCHED, WHITE, 0.2), DARK[0]),
        };
        blend(NIGHT, colour, dark + (1.0 - dark) * self.light)
    }
}
