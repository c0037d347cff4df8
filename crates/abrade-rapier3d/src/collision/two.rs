//! Two colliders of which at least one has a surface: whose stands, and what meets it.

use abrade::{Ball, Body, Inertia, Piece, Placed, Shape, Skin, State, Surface, can_meet};
use nalgebra::{Isometry3, Point3, Vector3};
use rapier::geometry::{Collider, ContactPair};

use crate::collision::blow::Blow;
use crate::extent::Extent;
use crate::micro::{self, Volumes};
use crate::surface::{SurfaceId, WornCollider};
use crate::view::WorldView;
use crate::wall;

/// Whose surface stands, and what the other wears.
#[derive(Clone, Copy)]
pub(crate) struct Roles {
    pub stands: SurfaceId,
    /// True when it is that of the first collider of the pair.
    pub first_stands: bool,
    /// The surface of the other's own, and its frame in that of the body.
    pub skin: Option<(SurfaceId, Isometry3<f64>)>,
}

impl Roles {
    /// The surfaces of the two: that which stands, and the other's own.
    pub fn surfaces(&self) -> Vec<SurfaceId> {
        [self.stands].into_iter().chain(self.skin.map(|(id, _)| id)).collect()
    }

    /// The surfaces, to be worn.
    pub fn place<'a>(&self, surfaces: &'a mut [WornCollider]) -> Option<[Placed<'a>; 1]> {
        let ids = self.surfaces();
        let mut owned = micro::owned(surfaces, &ids);
        let surface = owned.next()?;
        let skin = owned.next().zip(self.skin).map(|(surface, (_, pose))| Skin { surface, pose });
        Some([Placed { surface, pose: Isometry3::identity(), carrier: None, skin }])
    }

    /// What the surfaces have lost since they were placed.
    pub fn gained(&self, placed: [Placed<'_>; 1]) -> Volumes {
        let [Placed { surface, skin, .. }] = placed;
        let worn = [surface].into_iter().chain(skin.map(|skin| skin.surface));
        let volumes = worn.map(|surface| surface.settle().displaced());
        self.surfaces().into_iter().zip(volumes).collect()
    }
}

/// The surface that stands, and what meets it.
pub(crate) struct Two {
    pub roles: Roles,
    /// The other where the step has left it, at rest in the frame of the surface that stands.
    pub body: Body,
    /// Unit normal from it into that surface.
    pub down: Vector3<f64>,
    /// Frame of the surface that stands, in the world.
    pub frame: Isometry3<f64>,
}

impl Two {
    /// Who of a pair meets whom, in the frame of the surface that stands; None where neither has a
    /// shape that can. `own` are the places of their surfaces among all.
    pub fn of(
        pair: &ContactPair,
        own: [Option<usize>; 2],
        blow: &Blow,
        surfaces: &[WornCollider],
        world: &WorldView<'_>,
    ) -> Option<Self> {
        let handles = [pair.collider1, pair.collider2];
        let [first, second] = handles.map(|handle| world.colliders.get(handle));
        let colliders = [first?, second?];
        let worn = own.map(|at| at.map(|at| &*surfaces[at].surface));
        standing(worn).into_iter().find_map(|stands| {
            let strikes = 1 - stands;
            let worn = &surfaces[own[stands]?];
            let pose = worn.pose(colliders[stands]);
            let towards = if stands == 0 { -1.0 } else { 1.0 };
            // Where their laws cannot meet, the one that stands wears alone.
            let skin = own[strikes].filter(|&at| can_meet(&surfaces[at].surface, &worn.surface));
            let skin = skin.map(|at| &surfaces[at]);
            let (body, skin) = Self::body(colliders[strikes], skin, worn, &pose)?;
            let down = pose.inverse_transform_vector(&(blow.normal * towards));
            let skin = own[strikes].map(SurfaceId).zip(skin);
            let (stands, first_stands) = (SurfaceId(own[stands]?), stands == 0);
            Some(Self { roles: Roles { stands, first_stands, skin }, body, down, frame: pose })
        })
    }

    /// The body of a striking collider, at rest in the frame at `pose` of the surface of `stands`, and
    /// where the surface of its own lies in it.
    fn body(
        collider: &Collider,
        skin: Option<&WornCollider>,
        stands: &WornCollider,
        pose: &Isometry3<f64>,
    ) -> Option<(Body, Option<Isometry3<f64>>)> {
        let Some(skin) = skin.filter(|skin| !skin.surface.is_flat()) else {
            let part = stands.bounds.placed_by(pose).grown(stands.bounds.half().norm());
            return wall::striker(collider, &part, pose).map(|body| (body, None));
        };
        let Extent { low, high } = skin.bounds;
        let centre = nalgebra::center(&low, &high);
        let nodes = skin.surface.nodes();
        let places = (0..nodes.len()).map(|i| nodes.rest_position[i]);
        let radius = places.map(|x| (x - centre).norm()).fold(0.0, f64::max);
        // The ball around it, about whose centre it moves.
        let shape =
            Shape::union(vec![Piece::Ball(Ball { centre: Point3::origin(), radius })]).ok()?;
        let frame = pose.inverse() * skin.pose(collider);
        let state = State { rotation: frame.rotation, ..State::at(frame * centre) };
        let inertia = Inertia::immovable();
        let body = Body { shape, inertia, state, rotation_locked: false };
        Some((body, Some(Isometry3::from(-centre.coords))))
    }
}

/// Which of the two stands: the first where it can, of two that cannot meet the softer.
fn standing(own: [Option<&Surface>; 2]) -> [usize; 2] {
    let [Some(first), Some(second)] = own else { return [0, 1] };
    let harder = first.laws().material.hardness > second.laws().material.hardness;
    if harder && !can_meet(first, second) { [1, 0] } else { [0, 1] }
}
