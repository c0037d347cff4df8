//! Spreads some vertices of a mesh evenly without a change of the enclosed volume. Each moves alone
//! and across its own area vector S, the sum of those of the facets around it: the volume is linear
//! in each vertex with the slope S / 3 (Kuprat, Khamayseh, George & Larkey, J. Comput. Phys. 172
//! (2001) 99, section 2).

use nalgebra::{Point3, Vector3};

use super::features::{Features, Kind};
use super::guard::{Corners, area, hardly_turns, may_move, shape};
use super::passes::{diamonds, worst};
use super::patchwork::{Edge, Patchwork};
use super::relax::way;
use crate::mesh::TriangleMesh;

/// Rounds of flips and moves.
const ROUNDS: usize = 2;
/// Share of the distance of neighbours below which a vertex lies well.
const NEAR: f64 = 0.02;
/// Shape of a facet below which it is poor: its edge is flipped, and a sharp edge does not hold a
/// worn vertex of it.
const POOR: f64 = 0.4;
/// Cosine of the angle between the normals of a vertex and its facets, below which they may not
/// fall.
const FACING: f64 = 0.8;
/// Shares of the way that are tried.
const SHARES: [f64; 3] = [1.0, 0.5, 0.25];
/// Rings of facets around what has worn that take part.
const RINGS: usize = 2;

impl TriangleMesh {
    /// The mesh with the `worn` vertices, and those near them, spread evenly; `column` holds a
    /// number per vertex, which is carried over. The volume changes by round-off. Sharp edges stay
    /// as in [`TriangleMesh::resampled`]. The result is not checked.
    pub(crate) fn spread(&self, worn: &[bool], column: &mut [f64]) -> Self {
        let features = Features::of(self);
        let mut net = Patchwork::of(self, features);
        let near = ring(self, worn);
        let list: Vec<u32> = (0..near.len() as u32).filter(|&i| near[i as usize]).collect();
        for &i in list.iter().filter(|&&i| worn[i as usize]) {
            if net.facets_at(i).any(|t| shape(&t.map(|k| net.points[k as usize])) < POOR) {
                net.kind[i as usize] = Kind::Smooth;
            }
        }
        for _ in 0..ROUNDS {
            flip(&mut net, &list, &near);
            list.iter().for_each(|&i| settle(&mut net, i, column));
        }
        let (vertices, triangles) = net.into_parts();
        Self { vertices, triangles }
    }
}

/// The vertices within a few rings of `worn` ones.
fn ring(mesh: &TriangleMesh, worn: &[bool]) -> Vec<bool> {
    let mut near = worn.to_vec();
    for _ in 0..RINGS {
        let before = near.clone();
        for t in mesh.triangles() {
            if t.iter().any(|&i| before[i as usize]) {
                t.iter().for_each(|&i| near[i as usize] = true);
            }
        }
    }
    near
}

/// Moves a vertex towards the middle of what is around it.
fn settle(net: &mut Patchwork, i: u32, column: &mut [f64]) {
    let Some(mut way) = way(net, i) else { return };
    if let Some(along) = along(net, i) {
        way = along * along.dot(&way);
    }
    let slope = slope(net, i);
    let Some(normal) = slope.try_normalize(0.0) else { return };
    let way = way - normal * normal.dot(&way);
    // A vertex with six equal facets has them twice as large as the square of the distance.
    if way.norm_squared() < NEAR * NEAR * slope.norm() {
        return;
    }
    let from = net.points[i as usize];
    let aims = SHARES.map(|share| way * share).into_iter();
    let fits = |step: &Vector3<f64>| {
        may_move(net, &[i], from + step) && faces(net, i, from + step, &normal)
    };
    if let Some(step) = aims.into_iter().find(fits) {
        column[i as usize] += change(net, i, &step, column);
        net.points[i as usize] = from + step;
    }
}

/// Direction of the sharp edges at a vertex that moves along them.
fn along(net: &Patchwork, i: u32) -> Option<Vector3<f64>> {
    let mut beside = net.neighbours(i).filter(|j| net.chain(i, *j).is_some());
    let [a, b] = [beside.next()?, beside.next()?].map(|j| net.points[j as usize]);
    matches!(net.kind[i as usize], Kind::Along(_)).then(|| (b - a).normalize())
}

/// True if the facets at a vertex still face its way when it lies at `p`, or as much as before.
fn faces(net: &Patchwork, i: u32, p: Point3<f64>, normal: &Vector3<f64>) -> bool {
    let (mut before, mut after) = (f64::INFINITY, f64::INFINITY);
    for t in net.facets_at(i) {
        let old = t.map(|k| net.points[k as usize]);
        let new = t.map(|k| if k == i { p } else { net.points[k as usize] });
        let facing = |corners: &Corners| area(corners).normalize().dot(normal);
        before = before.min(facing(&old));
        after = after.min(facing(&new));
    }
    after >= before.min(FACING)
}

/// Sum of the area vectors of the facets at a vertex [m2].
fn slope(net: &Patchwork, i: u32) -> Vector3<f64> {
    net.facets_at(i).map(|t| area(&t.map(|k| net.points[k as usize]))).sum()
}

/// Change of a column, linear over each facet, by a `step` from vertex `i`.
fn change(net: &Patchwork, i: u32, step: &Vector3<f64>, column: &[f64]) -> f64 {
    let from = net.points[i as usize];
    let along = |t: [u32; 3]| -> Option<f64> {
        let k = t.iter().position(|j| *j == i)?;
        let [q, r] = [t[(k + 1) % 3], t[(k + 2) % 3]];
        let [u, v] = [q, r].map(|j| net.points[j as usize] - from);
        let normal = u.cross(&v);
        let size = normal.norm_squared();
        let [a, b] = [step.cross(&v), u.cross(step)].map(|w| w.dot(&normal) / size);
        let rise = |j: u32| column[j as usize] - column[i as usize];
        (a >= 0.0 && b >= 0.0).then(|| a * rise(q) + b * rise(r))
    };
    net.facets_at(i).find_map(along).unwrap_or(0.0)
}

/// Flips edges between `near` vertices, that are not sharp and have a poor facet, where that makes
/// the worse facet better; the ends give back the volume of the tetrahedron that it makes.
fn flip(net: &mut Patchwork, list: &[u32], near: &[bool]) {
    for &a in list {
        let others: Vec<u32> = net.neighbours(a).filter(|&b| a < b && near[b as usize]).collect();
        for b in others {
            let Some(edge) = net.edge(a, b).filter(|_| net.chain(a, b).is_none()) else { continue };
            let Edge { c, d, .. } = edge;
            let (old, new) = diamonds(net, edge);
            if worst(&old) >= POOR || worst(&new) <= worst(&old) {
                continue;
            }
            let few = net.valence(a) < 4 || net.valence(b) < 4;
            if few || c == d || net.edge(c, d).is_some() {
                continue;
            }
            if old.iter().all(|old| new.iter().all(|new| hardly_turns(old, new))) {
                let [p, q, r, s] = [a, b, c, d].map(|i| net.points[i as usize]);
                let gained = (s - p).dot(&(q - p).cross(&(r - p))) / 6.0;
                net.flip(edge);
                [a, b, c, d].iter().for_each(|&i| grow(net, i, -gained / 4.0));
            }
        }
    }
}

/// Moves a vertex along its area vector so that the volume grows by `volume` [m3].
fn grow(net: &mut Patchwork, i: u32, volume: f64) {
    let slope = slope(net, i);
    let size = slope.norm_squared();
    if size > 0.0 {
        let to: Point3<f64> = net.points[i as usize] + slope * (3.0 * volume / size);
        net.points[i as usize] = to;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for moves that leave the surface, for a column that is left at the vertex instead of
    /// at the place, and for vertices that do not become evener.
    #[test]
    fn vertices_spread_within_the_surface() {
        let flat = TriangleMesh::cuboid(Vector3::new(1.0, 1.0, 0.2), 0.1).expect("a slab");
        let mut mesh = flat.clone();
        let on_top = |p: &Point3<f64>| p.z == 0.2 && p.x.abs() < 0.85 && p.y.abs() < 0.85;
        let top: Vec<bool> = flat.vertices().iter().map(on_top).collect();
        for (i, p) in mesh.vertices.iter_mut().enumerate().filter(|(i, _)| top[*i]) {
            let shift = |k: usize| 0.03 * ((i * 7 + k * 3) as f64).sin();
            *p += Vector3::new(shift(1), shift(2), 0.0);
        }
        let mut column: Vec<f64> = mesh.vertices().iter().map(|p| 2.0 * p.x - p.y).collect();
        let mut even = mesh.clone();
        for _ in 0..8 {
            even = even.spread(&top, &mut column);
        }
        assert!((even.volume() / flat.volume() - 1.0).abs() < 1e-13);
        let miss = |mesh: &TriangleMesh| {
            let apart = mesh.vertices().iter().zip(flat.vertices()).map(|(p, q)| (p - q).norm());
            apart.map(|d| d * d).sum::<f64>().sqrt()
        };
        assert!(miss(&even) < 0.8 * miss(&mesh), "{}", miss(&even));
        for (p, value) in even.vertices().iter().zip(&column).filter(|(p, _)| p.z == 0.2) {
            assert!((value - (2.0 * p.x - p.y)).abs() < 1e-12, "{value} at {p}");
        }
    }
}
