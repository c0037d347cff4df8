//! Facets of a worn surface near a place: how far points are from them, and on which side.

use nalgebra::{Point3, Vector3};

use crate::box_grid::Boxes;
use crate::surface::Surface;

/// Relative difference of squared distances below which two facets are as near: a point beyond an
/// edge is as far from both, and the one that it is more squarely above tells the side.
const TIE: f64 = 1e-9;
/// Distance from a facet, in its size, below which its own normal is that of the nearest point.
const FLAT: f64 = 1e-9;

/// A facet as it is worn.
#[derive(Clone, Copy, Debug)]
struct Facet {
    corner: Point3<f64>,
    edges: [Vector3<f64>; 2],
    /// Outward unit normal; zero for a facet without an area.
    normal: Vector3<f64>,
    /// Length of its longer edge at the corner [m].
    size: f64,
}

/// The nearest point of the surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Foot {
    /// Unit vector out of the solid, through the point asked about.
    pub normal: Vector3<f64>,
    /// Distance of the point asked about [m]; negative inside.
    pub height: f64,
}

/// Facets within reach of a region, in their surface's frame.
#[derive(Clone, Debug, Default)]
pub(crate) struct Facets {
    corners: Vec<[u32; 3]>,
    facets: Vec<Facet>,
    /// Distance up to which points are found [m].
    reach: f64,
    boxes: Boxes,
}

impl Facet {
    fn new(corners: [Point3<f64>; 3]) -> Self {
        let [a, b, c] = corners;
        let edges = [b - a, c - a];
        let across = edges[0].cross(&edges[1]);
        let normal = across.try_normalize(0.0).unwrap_or_default();
        Self { corner: a, edges, normal, size: edges[0].norm().max(edges[1].norm()) }
    }

    /// Vector from the nearest point of the facet to `x` (Ericson, Real-Time Collision Detection,
    /// 2005, 5.1.5).
    #[inline]
    fn apart(&self, x: &Point3<f64>) -> Vector3<f64> {
        let [ab, ac] = self.edges;
        let ap = x - self.corner;
        let (d1, d2) = (ab.dot(&ap), ac.dot(&ap));
        if d1 <= 0.0 && d2 <= 0.0 {
            return ap;
        }
        let bp = ap - ab;
        let (d3, d4) = (ab.dot(&bp), ac.dot(&bp));
        if d3 >= 0.0 && d4 <= d3 {
            return bp;
        }
        let vc = d1 * d4 - d3 * d2;
        if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
            return ap - ab * (d1 / (d1 - d3));
        }
        let cp = ap - ac;
        let (d5, d6) = (ab.dot(&cp), ac.dot(&cp));
        if d6 >= 0.0 && d5 <= d6 {
            return cp;
        }
        let vb = d5 * d2 - d1 * d6;
        if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
            return ap - ac * (d2 / (d2 - d6));
        }
        let va = d3 * d6 - d5 * d4;
        let (along, beside) = (d4 - d3, d5 - d6);
        if va <= 0.0 && along >= 0.0 && beside >= 0.0 {
            return bp - (ac - ab) * (along / (along + beside));
        }
        self.normal * self.normal.dot(&ap)
    }
}

impl Facets {
    /// Takes the facets with these `corners` of `surface` as they are now, to be found by points within
    /// `reach` [m] of them.
    pub(crate) fn set(&mut self, corners: &[[u32; 3]], surface: &Surface, reach: f64) {
        self.corners.clear();
        self.corners.extend_from_slice(corners);
        self.reach = reach;
        self.facets.clear();
        let place = |i: u32| surface.position(i as usize);
        self.facets.extend(corners.iter().map(|corners| Facet::new(corners.map(place))));
        let around = |facet: &Facet| {
            let [a, b, c] = [Vector3::zeros(), facet.edges[0], facet.edges[1]];
            let grown = Vector3::repeat(reach);
            let (low, high) = (a.inf(&b).inf(&c) - grown, a.sup(&b).sup(&c) + grown);
            [facet.corner + low, facet.corner + high]
        };
        self.boxes.set(self.facets.iter().map(around));
    }

    /// Distance up to which points are found [m].
    pub(crate) fn reach(&self) -> f64 {
        self.reach
    }

    /// True where a facet may be within reach of `x`.
    #[inline]
    pub(crate) fn near(&self, x: &Point3<f64>) -> bool {
        !self.boxes.at(x).is_empty()
    }

    /// Corners of the facet that has the nearest point to `x`, and the weights by which that point
    /// lies between them.
    pub(crate) fn seat(&self, x: &Point3<f64>) -> Option<([u32; 3], [f64; 3])> {
        let (apart, _, at) = self.nearest(x)?;
        let facet = &self.facets[at];
        let [ab, ac] = facet.edges;
        let on = x - apart - facet.corner;
        let (bb, bc, cc) = (ab.norm_squared(), ab.dot(&ac), ac.norm_squared());
        let (b, c) = (ab.dot(&on), ac.dot(&on));
        let whole = bb * cc - bc * bc;
        let [second, third] = match whole > 0.0 {
            true => [(cc * b - bc * c) / whole, (bb * c - bc * b) / whole],
            false => [0.0; 2],
        };
        Some((self.corners[at], [1.0 - second - third, second, third].map(|w| w.max(0.0))))
    }

    /// The nearest point to `x` within reach. The distance is a potential: a force along its
    /// gradient gives back what it took.
    pub(crate) fn foot(&self, x: &Point3<f64>) -> Option<Foot> {
        let (apart, above, at) = self.nearest(x)?;
        let facet = &self.facets[at];
        let distance = apart.norm();
        let side = if above >= 0.0 { 1.0 } else { -1.0 };
        let flat = distance <= FLAT * facet.size || above.abs() >= distance;
        let normal = if flat { facet.normal } else { apart * (side / distance) };
        Some(Foot { normal, height: side * distance })
    }

    /// The vector to `x` from the nearest point within reach, the part of it above the facet, and the
    /// facet's number.
    fn nearest(&self, x: &Point3<f64>) -> Option<(Vector3<f64>, f64, usize)> {
        let mut least = self.reach * self.reach;
        let mut best: Option<(Vector3<f64>, f64, usize)> = None;
        for &at in self.boxes.at(x) {
            let facet = &self.facets[at as usize];
            let apart = facet.apart(x);
            let square = apart.norm_squared();
            if square > least * (1.0 + TIE) {
                continue;
            }
            let above = apart.dot(&facet.normal);
            let nearer = square < least * (1.0 - TIE);
            if nearer || best.is_none_or(|(_, other, _)| above.abs() > other.abs()) {
                least = square.min(least);
                best = Some((apart, above, at as usize));
            }
        }
        best
    }
}

impl Surface {
    /// The part of the undeformed surface whose facets may come into a box of the worn one.
    pub(crate) fn facet_box(&self, [low, high]: &[Point3<f64>; 2]) -> [Point3<f64>; 2] {
        let edge = if self.is_flat() { 2.0 * self.pitch } else { 0.0 };
        let grown = Vector3::repeat(self.deepest + edge);
        [low - grown, high + grown]
    }

    /// Calls `visit` with the corners of every facet that may meet the box, and of others.
    pub(crate) fn visit_facets(
        &self,
        low: &Point3<f64>,
        high: &Point3<f64>,
        visit: impl FnMut([u32; 3]),
    ) {
        let [low, high] = self.facet_box(&[*low, *high]);
        self.layout.visit_facets(self.grid(), &low, &high, visit);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Material;
    use crate::mesh::TriangleMesh;
    use crate::surface::SurfaceLaws;

    fn cube() -> Facets {
        let mesh = TriangleMesh::cuboid(Vector3::repeat(0.5), 0.25).expect("a cube");
        let material = Material {
            hardness: 1.0,
            shear_ratio: 0.25,
            young: Some(100.0),
            poisson: 0.3,
            friction: 0.0,
        };
        let surface = Surface::mesh(&mesh, SurfaceLaws::of(material)).expect("a surface");
        let mut facets = Facets::default();
        facets.set(mesh.triangles(), &surface, 0.3);
        facets
    }

    /// Fails for a wrong side beyond edges and corners, a nearest point off a facet, and a distance
    /// that is not that of a box.
    #[test]
    fn heights_are_the_signed_distances_of_the_solid() {
        let facets = cube();
        let mut count = 0;
        for i in 0..40 {
            for j in 0..40 {
                for k in 0..40 {
                    let at = |n: i32| -0.75 + 1.5 * (f64::from(n) + 0.37) / 40.0;
                    let x = Point3::new(at(i), at(j), at(k));
                    let out = x.coords.map(|a| (a.abs() - 0.5).max(0.0)).norm();
                    let inside = x.coords.map(|a| 0.5 - a.abs()).min();
                    let height = if out > 0.0 { out } else { -inside };
                    match facets.foot(&x) {
                        Some(foot) => {
                            assert!((foot.height - height).abs() < 1e-12, "{x} {height} {foot:?}");
                            let away = x + foot.normal * 1e-6;
                            let gained = facets.foot(&away).map_or(1e-6, |f| f.height - height);
                            assert!(gained > 0.99e-6, "{x} {foot:?} {gained}");
                            count += 1;
                        }
                        None => assert!(height.abs() > 0.3, "{x} {height}"),
                    }
                }
            }
        }
        assert!(count > 30_000, "{count}");
    }
}
