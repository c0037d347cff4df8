//! Shows worn surfaces to rays, shape casts and characters: a collider beside the proxy that takes
//! no part in contacts. Contacts never read it; the nodes stay the only state.

use abrade::{Surface, Worn};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};
use rapier::geometry::{
    ColliderBuilder, ColliderHandle, ColliderSet, Group, InteractionGroups, InteractionTestMode,
    SharedShape,
};
use rapier::parry::utils::Array2;

use crate::error::WearError;
use crate::scalar;
use crate::surface::SurfaceId;
use crate::world::WearWorld;

/// A query collider, and how worn the surface was that it shows.
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Shown {
    collider: ColliderHandle,
    worn: Worn,
}

/// Pairs with nothing whose test mode is `And`, as that of bodies is unless they ask otherwise;
/// for those that do there is no solver group.
const OF_QUERIES: InteractionGroups =
    InteractionGroups::new(Group::GROUP_32, Group::NONE, InteractionTestMode::Or);

impl WearWorld {
    /// Groups for a query that sees query colliders and nothing else.
    pub const WORN_ONLY: InteractionGroups =
        InteractionGroups::new(Group::NONE, Group::GROUP_32, InteractionTestMode::Or);

    /// The collider that shows `surface` as it is worn now: a height field through the nodes of a
    /// strip, the facets of a solid, made
    /// at the first call, and made anew only when something has worn since the last one. It stands
    /// where the surface lies and has no density. It is a member of group 32 alone and lets no
    /// group in, so it is in no contact pair.
    ///
    /// A query without a filter sees it and the proxy, and the proxy's undeformed top comes first:
    /// exclude the proxy, or ask with [`WearWorld::WORN_ONLY`]. A filter with groups must have
    /// group 32 in its own filter, and the test mode `Or`: with `And` it does not see this
    /// collider, just as no body does. Rapier's queries know a new collider from its next step
    /// on: call this before the step.
    ///
    /// The cost is about that of reading every node once. A ray that falls exactly on a node or on
    /// an edge between two may slip through, in `f32` two of 100 000 that fall anywhere; a ball that
    /// is cast does not.
    ///
    /// # Errors
    /// The proxy is gone.
    pub fn sync_collider(
        &mut self,
        surface: SurfaceId,
        colliders: &mut ColliderSet,
    ) -> Result<ColliderHandle, WearError> {
        let frame = self.frame(surface, colliders)?;
        let worn = &mut self.surfaces[surface.0];
        let now = worn.surface.worn();
        let pose = scalar::to_pose(&(frame * middle(&worn.surface)));
        let kept = worn.shown.as_mut().filter(|shown| colliders.contains(shown.collider));
        let Some(shown) = kept else {
            let builder = ColliderBuilder::new(worn_shape(&worn.surface))
                .position(pose)
                .density(scalar::narrow(0.0))
                .collision_groups(OF_QUERIES)
                .solver_groups(InteractionGroups::none());
            let collider = colliders.insert(builder);
            worn.shown = Some(Shown { collider, worn: now });
            return Ok(collider);
        };
        let stale = shown.worn != now;
        shown.worn = now;
        let handle = shown.collider;
        // Borrowing it mutably would already make Rapier take it for changed.
        let moved = colliders.get(handle).is_some_and(|collider| *collider.position() != pose);
        if let Some(collider) = colliders.get_mut(handle).filter(|_| stale || moved) {
            collider.set_position(pose);
            if stale {
                collider.set_shape(worn_shape(&worn.surface));
            }
        }
        Ok(handle)
    }
}

/// The worn shape of `surface`: a height field, or its facets.
fn worn_shape(surface: &Surface) -> SharedShape {
    if let Some(strip) = Strip::of(surface) {
        return strip.field();
    }
    let nodes = surface.nodes();
    let corner = |i: usize| scalar::to_vector(&nodes.position(i).coords);
    let corners = (0..nodes.len()).map(corner).collect();
    // Only a mesh without facets is refused.
    SharedShape::trimesh(corners, surface.triangles()).unwrap_or_else(|_| SharedShape::ball(0.0))
}

/// Where that shape lies in the surface's frame.
fn middle(surface: &Surface) -> Isometry3<f64> {
    Strip::of(surface).map_or_else(Isometry3::identity, |strip| strip.middle())
}

/// A strip as a height field.
struct Strip<'a> {
    surface: &'a Surface,
    columns: usize,
    rows: usize,
}

impl<'a> Strip<'a> {
    fn of(surface: &'a Surface) -> Option<Self> {
        surface.columns_rows().map(|[columns, rows]| Self { surface, columns, rows })
    }

    /// Cells of the height field: columns, and half pitches along a column, which is where the
    /// nodes of every other column lie.
    fn cells(&self) -> [usize; 2] {
        [self.columns.max(2) - 1, 2 * self.rows - 1]
    }

    /// Extents of a cell along x and y [m].
    fn cell(&self) -> [f64; 2] {
        let pitch = self.surface.pitch();
        [0.75f64.sqrt() * pitch, 0.5 * pitch]
    }

    /// Where the height field lies in the surface's frame. Its own x, y, z are the surface's y, z,
    /// x.
    fn middle(&self) -> Isometry3<f64> {
        let ([along_x, along_y], [x, y]) = (self.cells(), self.cell());
        // A lone column stands in the middle of its cell.
        let half = if self.columns > 1 { 0.5 * along_x as f64 * x } else { 0.0 };
        let to_middle = Vector3::new(half, 0.5 * along_y as f64 * y, 0.0);
        let turn = UnitQuaternion::new_unchecked(Quaternion::new(0.5, 0.5, 0.5, 0.5));
        let first = self.surface.nodes().rest_position[0].coords;
        Isometry3::from_parts(Translation3::from(first + to_middle), turn)
    }

    /// A height field through every node; between two nodes of a column it has their mean.
    fn field(&self) -> SharedShape {
        let Self { columns, rows, .. } = *self;
        let ([along_x, along_y], [x, y]) = (self.cells(), self.cell());
        let depth = &self.surface.nodes().depth;
        let mut heights = Vec::with_capacity((along_x + 1) * (along_y + 1));
        for place in 0..=along_y {
            for column in 0..=along_x {
                let column = column.min(columns - 1);
                let shift = column % 2;
                let below = place.saturating_sub(shift) / 2;
                let above = (place + 1).saturating_sub(shift) / 2;
                let of = |row: usize| depth[column * rows + row.min(rows - 1)];
                heights.push(scalar::narrow(-0.5 * (of(below) + of(above))));
            }
        }
        let extent = Vector3::new(along_y as f64 * y, 1.0, along_x as f64 * x);
        let heights = Array2::new(along_x + 1, along_y + 1, heights);
        SharedShape::heightfield(heights, scalar::to_vector(&extent))
    }
}
