//! From which side a worn solid is seen: one that shows its deepest node, the solid being cut open
//! in front of it where it hides it from every side that is tried. The projection is orthographic.

use abrade::Nodes;
use nalgebra::{Point3, Unit, UnitQuaternion, Vector3};

/// Side from which a solid without wear is seen, and to which others are tilted.
const USUAL: [f64; 3] = [0.45, -0.7, 0.55];
/// Angle between the view and the normal of the deepest node [rad]: enough to show relief.
const TILT: f64 = 0.5;
/// Nearness to z above which y is up in the picture.
const UPRIGHT: f64 = 0.98;

/// An eye at infinity.
#[derive(Clone, Copy, Debug)]
pub(super) struct Camera {
    pub(super) across: Vector3<f64>,
    pub(super) up: Vector3<f64>,
    /// Towards the eye.
    pub(super) toward: Vector3<f64>,
    /// Nothing is shown that is nearer to the eye than this, along `toward` [m].
    pub(super) cut: f64,
}

impl Camera {
    /// The eye for a solid with these facets, `deepest` being its deepest node if it is worn.
    pub(super) fn of(nodes: &Nodes, triangles: &[[u32; 3]], deepest: Option<usize>) -> Self {
        let usual = Vector3::from(USUAL).normalize();
        let Some(deepest) = deepest else { return Self::from(usual, f64::INFINITY) };
        let normal = nodes.normal[deepest];
        let tilts: Vec<_> = tilted(normal, usual).into_iter().chain([normal]).collect();
        let covers: Vec<_> =
            tilts.iter().map(|toward| cover(nodes, triangles, deepest, toward)).collect();
        if let Some(free) = covers.iter().position(Option::is_none) {
            return Self::from(tilts[free], f64::INFINITY);
        }
        // Half-way to what hides the node.
        let room = covers[0].unwrap_or(0.0) / 2.0;
        let cut = tilts[0].dot(&nodes.rest_position[deepest].coords) + room;
        Self::from(tilts[0], cut)
    }

    fn from(toward: Vector3<f64>, cut: f64) -> Self {
        let head = if toward.z.abs() < UPRIGHT { Vector3::z() } else { Vector3::y() };
        let across = head.cross(&toward).normalize();
        Self { across, up: toward.cross(&across), toward, cut }
    }

    /// Across, up and towards the eye [m].
    pub(super) fn project(&self, point: &Point3<f64>) -> [f64; 3] {
        [self.across, self.up, self.toward].map(|axis| axis.dot(&point.coords))
    }

    /// True when the solid is cut open.
    pub(super) fn cuts(&self) -> bool {
        self.cut.is_finite()
    }
}

/// Four sides at [`TILT`] from `normal`, the first one towards `usual`.
fn tilted(normal: Vector3<f64>, usual: Vector3<f64>) -> [Vector3<f64>; 4] {
    let along = |v: Vector3<f64>| v - normal * normal.dot(&v);
    let wish = along(usual);
    let aside = if wish.norm() > 0.1 { wish } else { along(Vector3::x()) }.normalize();
    let axis = Unit::new_unchecked(normal);
    let quarter = std::f64::consts::FRAC_PI_2;
    [0.0, 1.0, 3.0, 2.0].map(|turns| {
        let aside = UnitQuaternion::from_axis_angle(&axis, turns * quarter) * aside;
        normal * TILT.cos() + aside * TILT.sin()
    })
}

/// Distance from a node to the first facet in front of it [m].
fn cover(nodes: &Nodes, triangles: &[[u32; 3]], node: usize, toward: &Vector3<f64>) -> Option<f64> {
    let from = nodes.rest_position[node];
    let others = triangles.iter().filter(|corners| !corners.contains(&(node as u32)));
    let hits = others.filter_map(|corners| {
        let corners = corners.map(|i| nodes.position(i as usize));
        crossing(&from, toward, &corners)
    });
    hits.reduce(f64::min)
}

/// Way along `toward` to a facet (Moller & Trumbore, Journal of Graphics Tools 2 (1997) 21).
fn crossing(from: &Point3<f64>, toward: &Vector3<f64>, corners: &[Point3<f64>; 3]) -> Option<f64> {
    let [a, b, c] = corners;
    let (ab, ac) = (b - a, c - a);
    let p = toward.cross(&ac);
    let determinant = ab.dot(&p);
    if determinant == 0.0 {
        return None;
    }
    let s = from - a;
    let u = s.dot(&p) / determinant;
    let q = s.cross(&ab);
    let v = toward.dot(&q) / determinant;
    let way = ac.dot(&q) / determinant;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && way > 0.0).then_some(way)
}

#[cfg(test)]
mod tests {
    use abrade::TriangleMesh;

    use super::*;
    use crate::picture::solid::tests::surface;

    fn camera(mesh: &TriangleMesh, near: [f64; 3]) -> (Camera, Vector3<f64>) {
        let surface = surface(mesh);
        let (mut nodes, near) = (surface.nodes().clone(), Point3::from(near));
        let distance = |i: &usize| (nodes.rest_position[*i] - near).norm();
        let node = (0..nodes.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let node = node.expect("a node");
        nodes.depth[node] = 1e-5;
        (Camera::of(&nodes, &surface.triangles(), Some(node)), nodes.normal[node])
    }

    /// Fails for an eye behind the solid, and for a solid that is cut though nothing hides its
    /// deepest node.
    #[test]
    fn a_crater_on_a_sphere_is_seen_from_its_side() {
        let sphere = TriangleMesh::sphere(0.02, 0.002).expect("a sphere");
        for near in [[0.02, 0.0, 0.0], [0.0, 0.0, 0.02], [0.0, 0.01, -0.02]] {
            let (camera, normal) = camera(&sphere, near);
            assert!((camera.toward.dot(&normal) - TILT.cos()).abs() < 1e-9);
            assert!(!camera.cuts());
        }
    }

    /// Fails for an eye that looks at the outside of a pipe whose bore is worn, or through its end.
    #[test]
    fn a_pipe_is_cut_open_to_show_its_bore() {
        let tube = TriangleMesh::tube(0.02, 0.025, 0.2, 0.004).expect("a tube");
        let (camera, normal) = camera(&tube, [0.02, 0.0, 0.0]);
        assert!(camera.toward.dot(&normal) > 0.8);
        let [node, wall] = [0.02, -0.02].map(|x| camera.project(&Point3::new(x, 0.0, 0.0))[2]);
        assert!(camera.cuts() && node < camera.cut && camera.cut < wall);
    }
}
