//! Bodies near a wear surface that Rapier keeps in hand through a step, because the gate refused
//! them; what they bore is seen after it.

use abrade::State;
use nalgebra::Vector3;
use rapier::dynamics::{MultibodyJointSet, RigidBody, RigidBodyHandle};
use rapier::geometry::{ColliderHandle, NarrowPhase};

use crate::event::Refusal;
use crate::scalar;
use crate::shadow;
use crate::surface::{SurfaceId, WornCollider};
use crate::tracked::Tracked;
use crate::view::WorldView;

/// A body that Rapier keeps in hand.
pub(crate) struct Held {
    pub body: RigidBodyHandle,
    /// The surfaces that it is near.
    pub surfaces: Vec<SurfaceId>,
    /// Why Micro did not take it.
    pub reason: Refusal,
    /// Nothing else could meet it in the step.
    pub is_alone: bool,
    /// It will strike a surface, or was seen to strike one.
    pub strikes: bool,
    /// Speed below which an approach is rest [m/s].
    pub rest_speed: f64,
    /// Load that its contacts with surfaces bore in the step before [N].
    pub bore: f64,
}

/// States before the step, in the order of the handles.
#[derive(Default)]
pub(crate) struct Before {
    states: Vec<(RigidBodyHandle, State)>,
}

impl Before {
    /// Takes note of the `held` bodies, exactly where that is known; of every body that moves, if
    /// one of them could meet another, or something `may_wake`.
    pub fn note(
        &mut self,
        world: &WorldView<'_>,
        tracked: &[Option<Tracked>],
        held: &[Held],
        may_wake: bool,
    ) {
        self.states.clear();
        let bodies = &*world.bodies;
        let exact = |handle: RigidBodyHandle, rb: &RigidBody| {
            let shadow = Tracked::find(tracked, handle).and_then(|t| t.shadow.as_ref());
            let state = shadow::read(rb, shadow, &nalgebra::Isometry3::identity());
            match link_velocity(handle, world.multibody_joints) {
                Some([velocity, spin]) => State { velocity, spin, ..state },
                None => state,
            }
        };
        if held.iter().all(|held| held.is_alone) && !may_wake {
            let own = held.iter().filter_map(|held| Some((held.body, bodies.get(held.body)?)));
            self.states.extend(own.map(|(handle, rb)| (handle, exact(handle, rb))));
            self.states.sort_unstable_by_key(|(handle, _)| handle.into_raw_parts());
            return;
        }
        let moving = bodies.iter().filter(|(_, rb)| !rb.is_fixed());
        self.states.extend(moving.map(|(handle, rb)| (handle, exact(handle, rb))));
    }

    /// State of a body before the step.
    pub fn of(&self, body: RigidBodyHandle) -> Option<&State> {
        let key = body.into_raw_parts().0;
        let at = self.states.binary_search_by_key(&key, |(h, _)| h.into_raw_parts().0).ok()?;
        Some(&self.states[at].1).filter(|_| self.states[at].0 == body)
    }
}

/// Velocity and spin of a link of an articulation, whose joints know them: what its body says is
/// of no consequence.
fn link_velocity(body: RigidBodyHandle, joints: &MultibodyJointSet) -> Option<[Vector3<f64>; 2]> {
    let link = joints.rigid_body_link(body)?;
    let multibody = joints.get_multibody(link.multibody)?;
    let (jacobian, rates) = (multibody.body_jacobian(link.id), multibody.generalized_velocity());
    if jacobian.ncols() != rates.nrows() {
        return None;
    }
    let motion = jacobian * rates;
    Some([0, 3].map(|first| Vector3::from_fn(|axis, _| scalar::wide(motion[first + axis]))))
}

/// Impulse that Rapier's contacts with a proxy gave a body in the last step [N s], in the world.
pub(crate) fn impulse(
    colliders: &[ColliderHandle],
    worn: &WornCollider,
    narrow_phase: &NarrowPhase,
) -> Vector3<f64> {
    let on_body = |own: ColliderHandle| {
        let pair = narrow_phase.contact_pair(worn.proxy, own)?;
        let sign = if pair.collider1 == worn.proxy { 1.0 } else { -1.0 };
        Some(scalar::vector(pair.total_impulse()) * sign)
    };
    colliders.iter().filter_map(|own| on_body(*own)).sum()
}
