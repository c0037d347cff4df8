//! A closed mesh whose edges can be split, collapsed and flipped. Facets and vertices keep their
//! numbers; what is gone is left out at the end.

use std::collections::HashMap;

use nalgebra::Point3;

use super::features::{Features, Kind, sorted};
use crate::mesh::TriangleMesh;

const GONE: [u32; 3] = [u32::MAX; 3];

/// An edge between facets `left` (a, b, c) and `right` (b, a, d).
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    pub(super) a: u32,
    pub(super) b: u32,
    pub(super) c: u32,
    pub(super) d: u32,
    left: u32,
    right: u32,
}

#[derive(Debug)]
pub(super) struct Patchwork {
    pub(super) points: Vec<Point3<f64>>,
    pub(super) kind: Vec<Kind>,
    /// Number of facets that a vertex should have.
    pub(super) ideal: Vec<f64>,
    facets: Vec<[u32; 3]>,
    patch: Vec<u32>,
    /// Facets at each vertex.
    around: Vec<Vec<u32>>,
    chain: HashMap<[u32; 2], u32>,
}

impl Patchwork {
    pub(super) fn of(mesh: &TriangleMesh, features: Features) -> Self {
        let mut around = vec![Vec::new(); mesh.vertices().len()];
        for (facet, corners) in mesh.triangles().iter().enumerate() {
            corners.iter().for_each(|&i| around[i as usize].push(facet as u32));
        }
        Self {
            points: mesh.vertices().to_vec(),
            kind: features.kind,
            ideal: features.ideal,
            facets: mesh.triangles().to_vec(),
            patch: features.patch,
            around,
            chain: features.chain.into_iter().collect(),
        }
    }

    /// Number of the vertices that are left.
    pub(super) fn vertex_count(&self) -> usize {
        self.around.iter().filter(|facets| !facets.is_empty()).count()
    }

    /// Vertices and facets that are left.
    pub(super) fn into_parts(self) -> (Vec<Point3<f64>>, Vec<[u32; 3]>) {
        let mut number = vec![0; self.points.len()];
        let mut vertices = Vec::new();
        for (i, p) in self.points.iter().enumerate().filter(|(i, _)| !self.around[*i].is_empty()) {
            number[i] = vertices.len() as u32;
            vertices.push(*p);
        }
        let left = self.facets.into_iter().filter(|t| *t != GONE);
        (vertices, left.map(|t| t.map(|i| number[i as usize])).collect())
    }

    /// All edges, the lower index first.
    pub(super) fn edges(&self) -> Vec<[u32; 2]> {
        let left = self.facets.iter().filter(|t| **t != GONE);
        let pairs = left.flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        pairs.filter(|[a, b]| a < b).collect()
    }

    /// The edge between two vertices, if it is there.
    pub(super) fn edge(&self, a: u32, b: u32) -> Option<Edge> {
        let beyond = |from: u32, to: u32| {
            self.around[from as usize].iter().find_map(|&facet| {
                let t = self.facets[facet as usize];
                let k = t.iter().position(|i| *i == from)?;
                (t[(k + 1) % 3] == to).then_some((facet, t[(k + 2) % 3]))
            })
        };
        let ((left, c), (right, d)) = (beyond(a, b)?, beyond(b, a)?);
        Some(Edge { a, b, c, d, left, right })
    }

    pub(super) fn length(&self, [a, b]: [u32; 2]) -> f64 {
        (self.points[b as usize] - self.points[a as usize]).norm()
    }

    /// Chain of a sharp edge.
    pub(super) fn chain(&self, a: u32, b: u32) -> Option<u32> {
        self.chain.get(&sorted(a, b)).copied()
    }

    /// Facets at a vertex, as corners.
    pub(super) fn facets_at(&self, i: u32) -> impl Iterator<Item = [u32; 3]> {
        self.around[i as usize].iter().map(|&facet| self.facets[facet as usize])
    }

    /// Vertices joined to `i`: in a closed fan each follows `i` in one facet.
    pub(super) fn neighbours(&self, i: u32) -> impl Iterator<Item = u32> {
        self.facets_at(i).map(move |t| {
            if t[0] == i {
                t[1]
            } else if t[1] == i {
                t[2]
            } else {
                t[0]
            }
        })
    }

    /// Number of facets at a vertex.
    pub(super) fn valence(&self, i: u32) -> usize {
        self.around[i as usize].len()
    }

    /// Patch of a facet at a vertex: that of all of them unless it is on a sharp edge.
    pub(super) fn patch_at(&self, i: u32) -> Option<u32> {
        self.around[i as usize].first().map(|&facet| self.patch[facet as usize])
    }

    /// A new vertex at `p` on the edge.
    pub(super) fn split(&mut self, edge: Edge, p: Point3<f64>) {
        let Edge { a, b, c, d, left, right } = edge;
        let m = self.points.len() as u32;
        let [above, below] = [0, 1].map(|k| (self.facets.len() + k) as u32);
        self.points.push(p);
        self.ideal.push(6.0);
        self.facets[left as usize] = [a, m, c];
        self.facets[right as usize] = [b, m, d];
        self.facets.extend([[m, b, c], [m, a, d]]);
        self.patch.extend([left, right].map(|facet| self.patch[facet as usize]));
        self.around.push(vec![left, above, right, below]);
        exchange(&mut self.around[b as usize], left, above);
        exchange(&mut self.around[a as usize], right, below);
        self.around[c as usize].push(above);
        self.around[d as usize].push(below);
        self.kind.push(match self.chain.remove(&sorted(a, b)) {
            None => Kind::Smooth,
            Some(chain) => {
                self.chain.insert(sorted(a, m), chain);
                self.chain.insert(sorted(m, b), chain);
                Kind::Along(chain)
            }
        });
    }

    /// Removes vertex `a` of the edge into `b`, which moves to `p`.
    pub(super) fn collapse(&mut self, edge: Edge, p: Point3<f64>) {
        let Edge { a, b, c, d, left, right } = edge;
        let neighbours: Vec<u32> = self.neighbours(a).collect();
        for other in neighbours {
            if let Some(chain) = self.chain.remove(&sorted(a, other)).filter(|_| other != b) {
                self.chain.insert(sorted(b, other), chain);
            }
        }
        for (facet, third) in [(left, c), (right, d)] {
            self.facets[facet as usize] = GONE;
            [a, b, third].iter().for_each(|&i| drop_from(&mut self.around[i as usize], facet));
        }
        let moved = std::mem::take(&mut self.around[a as usize]);
        for &facet in &moved {
            let corners = &mut self.facets[facet as usize];
            corners.iter_mut().filter(|i| **i == a).for_each(|i| *i = b);
        }
        self.around[b as usize].extend(moved);
        self.points[b as usize] = p;
    }

    /// Joins `c` and `d` instead of `a` and `b`.
    pub(super) fn flip(&mut self, edge: Edge) {
        let Edge { a, b, c, d, left, right } = edge;
        self.facets[left as usize] = [a, d, c];
        self.facets[right as usize] = [d, b, c];
        drop_from(&mut self.around[a as usize], right);
        drop_from(&mut self.around[b as usize], left);
        self.around[c as usize].push(right);
        self.around[d as usize].push(left);
    }
}

fn exchange(list: &mut [u32], old: u32, new: u32) {
    list.iter_mut().filter(|i| **i == old).for_each(|i| *i = new);
}

fn drop_from(list: &mut Vec<u32>, gone: u32) {
    list.retain(|i| *i != gone);
}
