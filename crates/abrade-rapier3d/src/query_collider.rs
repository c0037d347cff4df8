//! Shows worn surfaces to rays, shape casts and characters: colliders beside the proxy that take
//! no part in contacts, one per tile of the surface. Contacts never read them; the nodes stay the
//! only state.

use abrade::Surface;
use nalgebra::Isometry3;
use rapier::geometry::{
    Collider, ColliderBuilder, ColliderHandle, ColliderSet, Group, InteractionGroups,
    InteractionTestMode,
};
use rapier::math::Pose;

use crate::error::WearError;
use crate::scalar;
use crate::surface::SurfaceId;
use crate::tiles::Tiles;
use crate::world::WearWorld;

/// The query colliders of a surface.
pub(crate) struct Shown {
    tiles: Tiles,
    /// One per tile.
    colliders: Vec<ColliderHandle>,
    /// How often the surface had been renewed when its tiles were laid out.
    renewals: u32,
}

/// Pairs with nothing whose test mode is `And`, as that of bodies is unless they ask otherwise;
/// for those that do there is no solver group.
const OF_QUERIES: InteractionGroups =
    InteractionGroups::new(Group::GROUP_32, Group::NONE, InteractionTestMode::Or);

impl WearWorld {
    /// Groups for a query that sees query colliders and nothing else.
    pub const WORN_ONLY: InteractionGroups =
        InteractionGroups::new(Group::NONE, Group::GROUP_32, InteractionTestMode::Or);

    /// Makes the colliders that show `surface` as it is worn now, at the first call, and at every
    /// other one makes those anew in which something has worn since; the number of those made is
    /// returned. Each shows a tile: of a strip a height field through 32 by 32 nodes, of a solid
    /// 1024 neighbouring facets. They stand where the surface lies and have no density. They are
    /// members of group 32 alone and let no group in, so they are in no contact pair.
    ///
    /// A query without a filter sees them and the proxy, and the proxy's undeformed top comes
    /// first: exclude the proxy, or ask with [`WearWorld::WORN_ONLY`]. A filter with groups must
    /// have group 32 in its own filter, and the test mode `Or`: with `And` it does not see these
    /// colliders, just as no body does. Rapier's queries know a new collider from its next step
    /// on: call this before the step.
    ///
    /// The cost is that of reading the nodes of the tiles made, and a look at every handle. A ray
    /// that falls exactly on a node or on an edge between two may slip through, in `f32` two of
    /// 100 000 that fall anywhere; a ball that is cast does not.
    ///
    /// # Errors
    /// The surface is not of this world, or its proxy is gone.
    pub fn sync_colliders(
        &mut self,
        surface: SurfaceId,
        colliders: &mut ColliderSet,
    ) -> Result<usize, WearError> {
        let frame = self.frame(surface, colliders)?;
        let worn = &mut self.surfaces[surface.0];
        let shown = worn.shown.get_or_insert_with(|| Shown::new(&worn.surface));
        let made = shown.sync(&worn.surface, &frame, colliders);
        worn.owned().watch();
        Ok(made)
    }

    /// The colliders that show `surface`, one per tile; none before the first
    /// [`WearWorld::sync_colliders`]. Those that are removed come back, under other handles, at
    /// the next one.
    pub fn query_colliders(&self, surface: SurfaceId) -> &[ColliderHandle] {
        let shown = self.surfaces.get(surface.0).and_then(|worn| worn.shown.as_ref());
        shown.map_or(&[], |shown| &shown.colliders)
    }
}

/// True for a collider that shows a surface: nothing runs into it.
pub(crate) fn is_of_queries(collider: &Collider) -> bool {
    collider.collision_groups() == OF_QUERIES
}

impl Shown {
    fn new(surface: &Surface) -> Self {
        let tiles = Tiles::of(surface);
        let colliders = vec![ColliderHandle::invalid(); tiles.count()];
        Self { tiles, colliders, renewals: surface.renewals() }
    }

    /// The tiles in which something has worn since the last look.
    fn stale(&self, surface: &Surface) -> Vec<usize> {
        surface.sunk().map_or_else(|| (0..self.tiles.count()).collect(), |i| self.tiles.with(i))
    }

    /// Number of the tiles made anew.
    fn sync(
        &mut self,
        surface: &Surface,
        frame: &Isometry3<f64>,
        colliders: &mut ColliderSet,
    ) -> usize {
        let is_renewed = self.renewals != surface.renewals();
        if is_renewed {
            self.tiles.renew(surface);
            self.renewals = surface.renewals();
        }
        let tiles = &self.tiles;
        let pose = |tile| scalar::to_pose(&(frame * tiles.place(tile)));
        // They move together: the first one tells. Borrowing one mutably would already make Rapier
        // take it for changed.
        let first = self.colliders.first().and_then(|handle| colliders.get(*handle));
        let moved = first.is_none_or(|collider| *collider.position() != pose(0));
        let mut stale = self.stale(surface).into_iter().peekable();
        let mut made = 0;
        for (tile, handle) in self.colliders.iter_mut().enumerate() {
            let is_stale = stale.next_if_eq(&tile).is_some();
            let is_missing = !colliders.contains(*handle);
            made += usize::from(is_stale || is_missing);
            if is_missing {
                *handle = colliders.insert(collider(tiles, tile, surface, pose(tile)));
            } else if let Some(collider) = colliders.get_mut(*handle).filter(|_| is_stale || moved)
            {
                if moved {
                    collider.set_position(pose(tile));
                }
                if is_renewed {
                    collider.set_shape(tiles.shape(tile, surface));
                } else if is_stale {
                    tiles.refit(tile, surface, collider);
                }
            }
        }
        made
    }
}

fn collider(tiles: &Tiles, tile: usize, surface: &Surface, pose: Pose) -> Collider {
    ColliderBuilder::new(tiles.shape(tile, surface))
        .position(pose)
        .density(scalar::narrow(0.0))
        .collision_groups(OF_QUERIES)
        .solver_groups(InteractionGroups::none())
        .build()
}

/// What is written of query colliders: their handles, the order of a mesh's facets, and how often the
/// surface had been renewed when they were made.
#[cfg(feature = "serde-serialize")]
pub(crate) type ShownParts = (Vec<ColliderHandle>, Vec<u32>, u32);

#[cfg(feature = "serde-serialize")]
impl Shown {
    pub fn parts(&self) -> ShownParts {
        (self.colliders.clone(), self.tiles.order().to_vec(), self.renewals)
    }

    /// The query colliders of `surface`; None when they cannot be its.
    pub fn of_parts(surface: &Surface, parts: ShownParts) -> Option<Self> {
        let (colliders, order, renewals) = parts;
        let tiles = Tiles::ordered(surface, order)?;
        (tiles.count() == colliders.len()).then_some(Self { tiles, colliders, renewals })
    }
}
