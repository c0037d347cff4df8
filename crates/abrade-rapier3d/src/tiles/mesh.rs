//! A closed mesh in tiles, each a mesh of neighbouring facets. Nodes on the border of two tiles
//! are corners of both.

use abrade::Surface;
use nalgebra::Point3;
use rapier::geometry::{Collider, SharedShape};
use rapier::math::Vector;

use crate::scalar;

/// Facets of a tile; the last one has fewer.
const FACETS: usize = 1024;

/// The facets, shared out.
pub(crate) struct MeshTiles {
    /// Facets tile by tile.
    order: Vec<u32>,
    /// The nodes of each tile, ascending.
    corners: Lists,
    /// The tiles of each node.
    tiles: Lists,
}

/// Lists in compressed rows: list `i` is `items[start[i]..start[i + 1]]`.
struct Lists {
    start: Vec<u32>,
    items: Vec<u32>,
}

impl Lists {
    fn get(&self, i: usize) -> &[u32] {
        &self.items[self.start[i] as usize..self.start[i + 1] as usize]
    }
}

impl MeshTiles {
    /// Halves the facets across the widest extent of their middles until they are few.
    pub fn of(surface: &Surface) -> Self {
        let facets = surface.facets().unwrap_or_default();
        let corners = &surface.nodes().rest_position;
        // Three times the middle.
        let middle = |facet: &[u32; 3]| {
            facet.iter().fold(Point3::origin(), |sum, i| sum + corners[*i as usize].coords)
        };
        let middles: Vec<Point3<f64>> = facets.iter().map(middle).collect();
        let mut order: Vec<u32> = (0..facets.len() as u32).collect();
        share_out(&mut order, &middles);
        Self::from_order(order, surface)
    }

    /// The tiles of facets in this order; None when it is none of all facets.
    #[cfg(feature = "serde-serialize")]
    pub fn ordered(order: Vec<u32>, surface: &Surface) -> Option<Self> {
        let mut sorted = order.clone();
        sorted.sort_unstable();
        let is_whole = sorted.iter().copied().eq(0..surface.facets()?.len() as u32);
        is_whole.then(|| Self::from_order(order, surface))
    }

    fn from_order(order: Vec<u32>, surface: &Surface) -> Self {
        let facets = surface.facets().unwrap_or_default();
        let mut corners = Lists { start: vec![0], items: Vec::new() };
        let mut of_tile = Vec::new();
        for tile in order.chunks(FACETS) {
            of_tile.clear();
            of_tile.extend(tile.iter().flat_map(|facet| facets[*facet as usize]));
            of_tile.sort_unstable();
            of_tile.dedup();
            corners.items.extend_from_slice(&of_tile);
            corners.start.push(corners.items.len() as u32);
        }
        let tiles = tiles_of_nodes(&corners, surface.nodes().len());
        Self { order, corners, tiles }
    }

    /// The same facets, which have other corners now.
    pub fn renew(&mut self, surface: &Surface) {
        *self = Self::from_order(std::mem::take(&mut self.order), surface);
    }

    #[cfg(feature = "serde-serialize")]
    pub fn order(&self) -> &[u32] {
        &self.order
    }

    pub fn count(&self) -> usize {
        self.order.len().div_ceil(FACETS)
    }

    /// The tiles with node `i` at a corner.
    pub fn with(&self, i: usize) -> impl Iterator<Item = usize> {
        self.tiles.get(i).iter().map(|tile| *tile as usize)
    }

    /// The facets of a tile, its nodes where they are now.
    pub fn shape(&self, tile: usize, surface: &Surface) -> SharedShape {
        let corners = self.corners.get(tile);
        let facets = surface.facets().unwrap_or_default();
        let places = corners.iter().map(|i| place(surface, *i)).collect();
        let number = |i: u32| corners.partition_point(|corner| *corner < i) as u32;
        let tile = self.order.chunks(FACETS).nth(tile).unwrap_or_default();
        let facets = tile.iter().map(|facet| facets[*facet as usize].map(number)).collect();
        // Only a mesh without facets is refused.
        SharedShape::trimesh(places, facets).unwrap_or_else(|_| SharedShape::ball(0.0))
    }

    /// True when `collider` has as many nodes as the tile.
    pub fn is_shown_by(&self, tile: usize, collider: &Collider) -> bool {
        let mesh = collider.shape().as_trimesh();
        mesh.is_some_and(|mesh| mesh.vertices().len() == self.corners.get(tile).len())
    }

    /// Moves the nodes of such a collider to where they are now.
    pub fn refit(&self, tile: usize, surface: &Surface, collider: &mut Collider) {
        let Some(mesh) = collider.shape_mut().as_trimesh_mut() else { return };
        mesh.update_vertices(|places| {
            for (at, i) in places.iter_mut().zip(self.corners.get(tile)) {
                *at = place(surface, *i);
            }
        });
    }
}

/// Where node `i` is now.
fn place(surface: &Surface, i: u32) -> Vector {
    scalar::to_vector(&surface.nodes().position(i as usize).coords)
}

/// Sorts facets so that every [`FACETS`] of them lie together.
fn share_out(facets: &mut [u32], middles: &[Point3<f64>]) {
    let tiles = facets.len().div_ceil(FACETS);
    if tiles < 2 {
        return;
    }
    let mut low = middles[facets[0] as usize];
    let mut high = low;
    for facet in facets.iter() {
        low = low.inf(&middles[*facet as usize]);
        high = high.sup(&middles[*facet as usize]);
    }
    let axis = (high - low).imax();
    let half = tiles / 2 * FACETS;
    facets.select_nth_unstable_by(half, |a, b| {
        let [at, other] = [a, b].map(|facet| middles[*facet as usize][axis]);
        at.total_cmp(&other).then(a.cmp(b))
    });
    let (below, above) = facets.split_at_mut(half);
    share_out(below, middles);
    share_out(above, middles);
}

/// The tiles of each node, from the nodes of each tile.
fn tiles_of_nodes(corners: &Lists, nodes: usize) -> Lists {
    let mut start = vec![0u32; nodes + 1];
    corners.items.iter().for_each(|i| start[*i as usize + 1] += 1);
    (0..nodes).for_each(|i| start[i + 1] += start[i]);
    let mut next = start.clone();
    let mut items = vec![0; corners.items.len()];
    for tile in 0..corners.start.len() - 1 {
        for &i in corners.get(tile) {
            items[next[i as usize] as usize] = tile as u32;
            next[i as usize] += 1;
        }
    }
    Lists { start, items }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use abrade::{Material, SurfaceLaws, TriangleMesh};

    use super::*;

    fn surface(mesh: &TriangleMesh) -> Surface {
        let (hardness, young) = (1e6, Some(1e8));
        let material = Material { hardness, shear_ratio: 0.25, young, poisson: 0.3, friction: 0.3 };
        Surface::mesh(mesh, SurfaceLaws::of(material)).expect("a surface")
    }

    /// The facets that tiles show, by their corners [nm], sorted.
    fn shown(tiles: &MeshTiles, surface: &Surface) -> Vec<[[i64; 3]; 3]> {
        let facets = |tile: usize| {
            let shape = tiles.shape(tile, surface);
            let mesh = shape.as_trimesh().expect("a mesh");
            assert!(mesh.num_triangles() <= FACETS);
            let corner = |i: u32| scalar::vector(mesh.vertices()[i as usize]);
            mesh.indices().iter().map(|t| t.map(|i| nm(corner(i)))).collect::<Vec<_>>()
        };
        let mut facets: Vec<_> = (0..tiles.count()).flat_map(facets).collect();
        facets.sort_unstable();
        facets
    }

    /// Flips an edge between two tiles.
    fn flip_on_a_border(tiles: &MeshTiles, facets: &mut [[u32; 3]]) {
        let mut edges = BTreeMap::new();
        for (place, &facet) in tiles.order.iter().enumerate() {
            let (tile, [a, b, c]) = (place / FACETS, facets[facet as usize]);
            for [from, to, apex] in [[a, b, c], [b, c, a], [c, a, b]] {
                let Some((other, across, over)) = edges
                    .insert([from, to], (tile, facet, apex))
                    .or_else(|| edges.get(&[to, from]).copied())
                else {
                    continue;
                };
                if other != tile {
                    facets[facet as usize] = [from, over, apex];
                    facets[across as usize] = [over, to, apex];
                    return;
                }
            }
        }
        panic!("facets of two tiles");
    }

    fn nm(place: nalgebra::Vector3<f64>) -> [i64; 3] {
        place.map(|x| (1e9 * x).round() as i64).into()
    }

    /// Fails for facets that are lost or shown twice, and for tiles that keep the corners which
    /// their facets had before a renewal: it flips edges, as this test does across a border.
    #[test]
    fn tiles_show_every_facet_with_the_corners_that_it_has() {
        let mesh = TriangleMesh::sphere(0.05, 2e-3).expect("a sphere");
        let before = surface(&mesh);
        let mut tiles = MeshTiles::of(&before);
        assert!(tiles.count() > 10);
        let mut facets = mesh.triangles().to_vec();
        flip_on_a_border(&tiles, &mut facets);
        let mesh = TriangleMesh::new(mesh.vertices().to_vec(), facets).expect("a solid");
        let after = surface(&mesh);
        let expected = |surface: &Surface| {
            let corner = |i: u32| nm(scalar::vector(place(surface, i)));
            let mut facets: Vec<_> =
                surface.triangles().iter().map(|facet| facet.map(corner)).collect();
            facets.sort_unstable();
            facets
        };
        assert!(shown(&tiles, &before) == expected(&before));
        tiles.renew(&after);
        assert!(shown(&tiles, &after) == expected(&after));
        assert!(expected(&before) != expected(&after));
    }
}
