//! What a picture shows: the plane it is projected on, the window in that plane, the deepest node
//! and the distance between nodes.

use abrade::Nodes;
use nalgebra::{Point3, Vector3};

/// Nodes shallower than this share of the largest depth do not widen the window.
const FAINT: f64 = 1e-3;
/// Free room around the worn region, as a share of its size.
const MARGIN: f64 = 0.12;
/// Least size of a window, in node distances.
const LEAST_NODES: f64 = 10.0;
/// Nodes that look away from the viewer by more than this cosine are not drawn.
const GRAZING: f64 = 0.1;

/// What a picture shows.
#[derive(Debug)]
pub(super) struct View {
    plane: Plane,
    /// Low and high corner of the window [m].
    pub(super) low: [f64; 2],
    pub(super) high: [f64; 2],
    /// Low and high corner of the whole surface [m].
    surface: [[f64; 2]; 2],
    /// None where nothing is worn.
    pub(super) deepest: Option<Deepest>,
    /// Node distance over that of a close-packed lattice with the same area per node [-].
    packing: f64,
    /// Node distance about the middle of the view [m].
    spacing: f64,
}

/// The deepest node.
#[derive(Debug)]
pub(super) struct Deepest {
    /// In the plane [m].
    pub(super) at: [f64; 2],
    /// Its depth [m].
    pub(super) depth: f64,
}

/// A node as a picture sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Seen {
    /// In the plane [m].
    pub(super) at: [f64; 2],
    /// Worn depth [m].
    pub(super) depth: f64,
    /// Distance to its neighbours [m].
    pub(super) spacing: f64,
}

#[derive(Debug)]
struct Plane {
    across: Vector3<f64>,
    up: Vector3<f64>,
    normal: Vector3<f64>,
}

impl View {
    /// The worn region with a margin, or the whole surface if nothing is worn; height over width
    /// within the two bounds.
    pub(super) fn of(nodes: &Nodes, flattest: f64, tallest: f64) -> Self {
        let deepest = (0..nodes.len()).max_by(|&a, &b| nodes.depth[a].total_cmp(&nodes.depth[b]));
        let deepest = deepest.filter(|&i| nodes.depth[i] > 0.0);
        let plane = Plane::of(nodes, deepest);
        let centre = deepest.unwrap_or(nodes.len() / 2);
        let packing = packing(nodes, centre);
        let threshold = deepest.map_or(0.0, |i| FAINT * nodes.depth[i]);
        let faces = |i: &usize| plane.faces(&nodes.normal[*i]);
        let spread = |chosen: &dyn Fn(usize) -> bool| {
            let seen = (0..nodes.len()).filter(faces).filter(|&i| chosen(i));
            bounds(seen.map(|i| plane.project(&nodes.rest_position[i])))
        };
        let surface = spread(&|_| true).unwrap_or([[0.0; 2]; 2]);
        let worn = spread(&|i| nodes.depth[i] > threshold).unwrap_or(surface);
        let spacing = nodes.rest_area.get(centre).map_or(0.0, |area| packing * lattice(*area));
        let [low, high] = window(worn, surface, spacing, (flattest, tallest));
        let deepest = deepest
            .map(|i| Deepest { at: plane.project(&nodes.rest_position[i]), depth: nodes.depth[i] });
        Self { plane, low, high, surface, deepest, packing, spacing }
    }

    /// Height over width.
    pub(super) fn aspect(&self) -> f64 {
        (self.high[1] - self.low[1]) / (self.high[0] - self.low[0])
    }

    /// The nodes within `reach` node distances of the box `low`..`high` [m].
    pub(super) fn nodes_in<'a>(
        &'a self,
        nodes: &'a Nodes,
        low: [f64; 2],
        high: [f64; 2],
        reach: f64,
    ) -> impl Iterator<Item = Seen> + 'a {
        (0..nodes.len()).filter(|&i| self.plane.faces(&nodes.normal[i])).filter_map(move |i| {
            let at = self.plane.project(&nodes.rest_position[i]);
            let spacing = self.packing * lattice(nodes.rest_area[i]);
            let room = reach * spacing;
            let inside = (0..2).all(|k| at[k] >= low[k] - room && at[k] <= high[k] + room);
            inside.then_some(Seen { at, depth: nodes.depth[i], spacing })
        })
    }

    /// True where there is surface, half a node distance around its outermost nodes included.
    pub(super) fn on_surface(&self, at: [f64; 2]) -> bool {
        let [low, high] = self.surface;
        let rim = self.spacing / 2.0;
        (0..2).all(|k| at[k] >= low[k] - rim && at[k] <= high[k] + rim)
    }

    /// Where a point of the plane stands in the window, from its upper left corner: shares of
    /// its width and height.
    pub(super) fn share(&self, at: [f64; 2]) -> [f64; 2] {
        let [x, y] = [0, 1].map(|k| (at[k] - self.low[k]) / (self.high[k] - self.low[k]));
        [x, 1.0 - y]
    }

    /// A point of the surface's frame in the plane [m].
    pub(super) fn project(&self, point: &Point3<f64>) -> [f64; 2] {
        self.plane.project(point)
    }
}

impl Plane {
    /// Against the mean normal, weighted by what is worn, or by area where nothing is.
    fn of(nodes: &Nodes, deepest: Option<usize>) -> Self {
        let mut sum = Vector3::zeros();
        let mut weights = 0.0;
        for i in 0..nodes.len() {
            let weight = nodes.rest_area[i] * if deepest.is_some() { nodes.depth[i] } else { 1.0 };
            sum += nodes.normal[i] * weight;
            weights += weight;
        }
        // A closed surface worn all around has no side of its own: look at its deepest node.
        let fallback = deepest.map_or(Vector3::z(), |i| nodes.normal[i]);
        let normal = if sum.norm() > 0.1 * weights { sum.normalize() } else { fallback };
        let along = |axis: Vector3<f64>| axis - normal * normal.dot(&axis);
        let across = along(Vector3::x());
        let across = if across.norm() > 0.1 { across } else { along(Vector3::y()) }.normalize();
        Self { across, up: normal.cross(&across), normal }
    }

    fn project(&self, point: &Point3<f64>) -> [f64; 2] {
        [self.across.dot(&point.coords), self.up.dot(&point.coords)]
    }

    fn faces(&self, normal: &Vector3<f64>) -> bool {
        self.normal.dot(normal) > GRAZING
    }
}

/// Node distance of a close-packed lattice with this area per node [m]: a_s = sqrt(3)/2 pitch^2.
fn lattice(rest_area: f64) -> f64 {
    (2.0 / 3.0_f64.sqrt() * rest_area).sqrt()
}

/// Real over close-packed node distance near node `middle`: the median of a few nodes. Differs
/// from one where a scene gives the rest area outright.
fn packing(nodes: &Nodes, middle: usize) -> f64 {
    const SAMPLES: usize = 9;
    if nodes.len() < 2 {
        return 1.0;
    }
    let first = middle.saturating_sub(SAMPLES / 2);
    let mut ratios: Vec<f64> = (first..nodes.len().min(first + SAMPLES))
        .map(|i| {
            let here = nodes.rest_position[i];
            let others = nodes.rest_position.iter().map(|other| (other - here).norm_squared());
            let nearest = others.filter(|d| *d > 0.0).fold(f64::INFINITY, f64::min);
            nearest.sqrt() / lattice(nodes.rest_area[i])
        })
        .collect();
    ratios.sort_by(f64::total_cmp);
    let median = ratios[ratios.len() / 2];
    if median.is_finite() { median } else { 1.0 }
}

/// Low and high corner of the points.
fn bounds(points: impl Iterator<Item = [f64; 2]>) -> Option<[[f64; 2]; 2]> {
    points.fold(None, |found, p| {
        let [low, high] = found.unwrap_or([p, p]);
        Some([[low[0].min(p[0]), low[1].min(p[1])], [high[0].max(p[0]), high[1].max(p[1])]])
    })
}

/// `worn` with its margin, widened to an allowed aspect, moved back onto the surface where that
/// is large enough.
fn window(
    worn: [[f64; 2]; 2],
    surface: [[f64; 2]; 2],
    spacing: f64,
    (flattest, tallest): (f64, f64),
) -> [[f64; 2]; 2] {
    let span = |b: [[f64; 2]; 2], k: usize| b[1][k] - b[0][k];
    let room = MARGIN * span(worn, 0).max(span(worn, 1));
    let mut size = [0, 1].map(|k| (span(worn, k) + 2.0 * room).max(LEAST_NODES * spacing));
    if size[0] <= 0.0 {
        size = [1e-3; 2];
    }
    size[1] = size[1].max(flattest * size[0]);
    size[0] = size[0].max(size[1] / tallest);
    let middle = [0, 1].map(|k| {
        let wish = (worn[0][k] + worn[1][k]) / 2.0;
        let half = size[k] / 2.0;
        match size[k] <= span(surface, k) {
            true => wish.clamp(surface[0][k] + half, surface[1][k] - half),
            false => (surface[0][k] + surface[1][k]) / 2.0,
        }
    });
    [-0.5, 0.5].map(|side| [0, 1].map(|k| middle[k] + side * size[k]))
}

#[cfg(test)]
mod tests;
