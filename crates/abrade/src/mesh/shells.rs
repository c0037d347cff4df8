//! Shells: the connected parts of a surface, their volumes and how they lie inside each other.

use nalgebra::{Point3, Vector3};

use super::links;

/// A connected part of a closed surface.
#[derive(Clone, Debug)]
pub(super) struct Shell {
    pub(super) facets: Vec<u32>,
    /// One of its vertices [m].
    pub(super) at: Point3<f64>,
    low: Point3<f64>,
    high: Point3<f64>,
    /// Enclosed volume [m3], below zero where the facets face inward.
    pub(super) volume: f64,
    /// Number of other shells around it.
    pub(super) inside: usize,
}

impl Shell {
    /// True for a solid that faces inward, or a cavity that faces outward.
    pub(super) fn is_inside_out(&self) -> bool {
        let outward = self.volume > 0.0;
        outward != self.inside.is_multiple_of(2)
    }
}

/// The shells of a surface whose edges all have two sides. They must not cross each other.
pub(super) fn shells(
    vertices: &[Point3<f64>],
    triangles: &[[u32; 3]],
    twins: &[u32],
) -> Vec<Shell> {
    let (label, count) = links::shells(twins);
    let mut facets = vec![Vec::new(); count];
    for (facet, shell) in label.iter().enumerate() {
        facets[*shell as usize].push(facet as u32);
    }
    let mut shells: Vec<Shell> =
        facets.into_iter().map(|facets| measured(vertices, triangles, facets)).collect();
    let inside: Vec<usize> =
        (0..count).map(|i| shells_around(vertices, triangles, &shells, i)).collect();
    shells.iter_mut().zip(inside).for_each(|(shell, inside)| shell.inside = inside);
    shells
}

fn measured(vertices: &[Point3<f64>], triangles: &[[u32; 3]], facets: Vec<u32>) -> Shell {
    let corners = |facet: &u32| triangles[*facet as usize].map(|i| vertices[i as usize]);
    let at = corners(&facets[0])[0];
    let (mut low, mut high, mut volume) = (at, at, 0.0);
    for [a, b, c] in facets.iter().map(corners) {
        for p in [a, b, c] {
            low = low.inf(&p);
            high = high.sup(&p);
        }
        volume += (a - at).dot(&(b - at).cross(&(c - at))) / 6.0;
    }
    Shell { facets, at, low, high, volume, inside: 0 }
}

fn shells_around(
    vertices: &[Point3<f64>],
    triangles: &[[u32; 3]],
    shells: &[Shell],
    i: usize,
) -> usize {
    let at = shells[i].at;
    let holds = |shell: &Shell| {
        let boxed = (0..3).all(|a| shell.low[a] < at[a] && at[a] < shell.high[a]);
        boxed && winding_number(vertices, triangles, &shell.facets, &at).abs() > 0.5
    };
    (0..shells.len()).filter(|&j| j != i && holds(&shells[j])).count()
}

/// How often a closed shell goes around a point that is not on it: the sum of the solid angles of
/// its facets over 4 pi (Van Oosterom & Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125, Eq. 8).
fn winding_number(
    vertices: &[Point3<f64>],
    triangles: &[[u32; 3]],
    facets: &[u32],
    at: &Point3<f64>,
) -> f64 {
    let half_angle = |facet: &u32| {
        let [a, b, c]: [Vector3<f64>; 3] =
            triangles[*facet as usize].map(|i| vertices[i as usize] - at);
        let [p, q, r] = [a, b, c].map(|v| v.norm());
        let cosine = p * q * r + a.dot(&b) * r + b.dot(&c) * p + c.dot(&a) * q;
        a.dot(&b.cross(&c)).atan2(cosine)
    };
    facets.iter().map(half_angle).sum::<f64>() / std::f64::consts::TAU
}
