//! Two colliders in a step: how the one goes over the other.

use abrade::State;
use nalgebra::{Isometry3, UnitQuaternion, Vector3};
use rapier::geometry::{Collider, ColliderHandle, ContactPair};

use crate::collision::blow::Blow;
use crate::held::Before;
use crate::view::WorldView;
use crate::{scalar, shadow};

/// The two colliders of a pair in a step.
pub(crate) struct Passage {
    legs: [Leg; 2],
    /// Half the longest edge of the box around the smaller of the two [m].
    radius: f64,
}

impl Passage {
    /// None where a collider is gone.
    pub fn of(pair: &ContactPair, world: &WorldView<'_>, before: &Before) -> Option<Self> {
        let collider = |handle: ColliderHandle| world.colliders.get(handle);
        let colliders = [collider(pair.collider1)?, collider(pair.collider2)?];
        let radius = |collider: &Collider| {
            scalar::vector(collider.shape().compute_local_aabb().half_extents()).max()
        };
        let radius = colliders.map(radius).into_iter().fold(f64::INFINITY, f64::min);
        Some(Self { legs: colliders.map(|collider| Leg::of(collider, world, before)), radius })
    }

    /// Frame of the second in that of the first after a share of the step.
    pub fn at(&self, share: f64) -> Isometry3<f64> {
        self.legs[0].at(share).inverse() * self.legs[1].at(share)
    }

    /// Frame of the first, or of the second, in the world after a share of the step.
    pub fn frame(&self, first: bool, share: f64) -> Isometry3<f64> {
        self.legs[if first { 0 } else { 1 }].at(share)
    }

    /// Way of the contact over the surfaces since the second was at `start` [m]: how far it slid, and
    /// how far the smaller of the two rolled.
    pub fn way(&self, start: &Isometry3<f64>, blow: &Blow) -> f64 {
        let (first, end) = (self.frame(true, 1.0), self.at(1.0));
        let place = first.inverse_transform_point(&blow.place);
        let slid = place - start * end.inverse_transform_point(&place);
        let normal = first.inverse_transform_vector(&blow.normal);
        let slid = slid - normal * normal.dot(&slid);
        slid.norm() + start.rotation.angle_to(&end.rotation) * self.radius
    }
}

/// A collider in a step, whose body goes straight and turns evenly.
struct Leg {
    from: State,
    shift: Vector3<f64>,
    turn: Vector3<f64>,
    /// Frame of the collider in that of the body.
    local: Isometry3<f64>,
}

impl Leg {
    fn of(collider: &Collider, world: &WorldView<'_>, before: &Before) -> Self {
        let pose = scalar::pose(collider.position());
        let parent = collider.parent().and_then(|h| Some((h, world.bodies.get(h)?)));
        let end = match parent.filter(|(_, rb)| !rb.is_fixed()) {
            Some((_, rb)) => shadow::held(rb),
            None => State { rotation: pose.rotation, ..State::at(pose.translation.vector.into()) },
        };
        let from = parent.and_then(|(handle, _)| before.of(handle)).copied().unwrap_or(end);
        let turn = (end.rotation * from.rotation.inverse()).scaled_axis();
        let shift = end.position - from.position;
        Self { from, shift, turn, local: end.pose().inverse() * pose }
    }

    fn at(&self, share: f64) -> Isometry3<f64> {
        let turn = UnitQuaternion::from_scaled_axis(self.turn * share);
        let position = self.from.position + self.shift * share;
        let rotation = turn * self.from.rotation;
        State { position, rotation, ..self.from }.pose() * self.local
    }
}
