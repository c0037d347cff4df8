//! A surface as rays see it, in tiles of a bounded number of nodes: whatever has worn, only the
//! tiles that it lies in are made anew. Neighbouring tiles leave no gap.

mod mesh;
mod strip;

use abrade::Surface;
use nalgebra::Isometry3;
use rapier::geometry::{Collider, SharedShape};

use self::mesh::MeshTiles;
use self::strip::StripTiles;

/// Which nodes each tile shows.
pub(crate) enum Tiles {
    Strip(StripTiles),
    Mesh(MeshTiles),
}

impl Tiles {
    pub fn of(surface: &Surface) -> Self {
        match StripTiles::of(surface) {
            Some(strip) => Self::Strip(strip),
            None => Self::Mesh(MeshTiles::of(surface)),
        }
    }

    /// Follows the facets of a solid that was renewed: their number stays, but not their corners.
    pub fn renew(&mut self, surface: &Surface) {
        if let Self::Mesh(mesh) = self {
            mesh.renew(surface);
        }
    }

    /// Number of tiles.
    pub fn count(&self) -> usize {
        match self {
            Self::Strip(strip) => strip.count(),
            Self::Mesh(mesh) => mesh.count(),
        }
    }

    /// The tiles that show one of `nodes`, in their order.
    pub fn with(&self, nodes: &[u32]) -> Vec<usize> {
        let mut tiles = Vec::new();
        match self {
            Self::Strip(strip) => nodes.iter().for_each(|&i| tiles.extend(strip.with(i as usize))),
            Self::Mesh(mesh) => nodes.iter().for_each(|&i| tiles.extend(mesh.with(i as usize))),
        }
        tiles.sort_unstable();
        tiles.dedup();
        tiles
    }

    /// Where a tile's shape lies in the surface's frame.
    pub fn place(&self, tile: usize) -> Isometry3<f64> {
        match self {
            Self::Strip(strip) => strip.place(tile),
            Self::Mesh(_) => Isometry3::identity(),
        }
    }

    /// A tile of `surface` as it is worn now.
    pub fn shape(&self, tile: usize, surface: &Surface) -> SharedShape {
        match self {
            Self::Strip(strip) => strip.shape(tile, &surface.nodes().depth),
            Self::Mesh(mesh) => mesh.shape(tile, surface),
        }
    }

    /// Brings the collider of a tile, whose facets are the same, to what is worn now.
    pub fn refit(&self, tile: usize, surface: &Surface, collider: &mut Collider) {
        match self {
            Self::Mesh(mesh) if mesh.is_shown_by(tile, collider) => {
                mesh.refit(tile, surface, collider);
            }
            _ => collider.set_shape(self.shape(tile, surface)),
        }
    }

    /// How facets are shared out to tiles, for the bytes of a world: a renewal moves them, and
    /// tiles made afterwards would be others. Empty for a strip.
    #[cfg(feature = "serde-serialize")]
    pub fn order(&self) -> &[u32] {
        match self {
            Self::Strip(_) => &[],
            Self::Mesh(mesh) => mesh.order(),
        }
    }

    /// The tiles of `surface` that have this [`Tiles::order`]; None when they cannot have.
    #[cfg(feature = "serde-serialize")]
    pub fn ordered(surface: &Surface, order: Vec<u32>) -> Option<Self> {
        match StripTiles::of(surface) {
            Some(strip) => order.is_empty().then_some(Self::Strip(strip)),
            None => MeshTiles::ordered(order, surface).map(Self::Mesh),
        }
    }
}
