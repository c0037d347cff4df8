//! Rapier's contacts with a proxy, laid on the worn surface.

use nalgebra::{Point3, Vector3};
use rapier::geometry::{Collider, ColliderHandle};
use rapier::math::Pose;
use rapier::parry::shape::{Shape, TypedShape};
use rapier::pipeline::ContactModificationContext;

use crate::scalar;
use crate::surface::WornCollider;

/// Pitches around a corner within which the highest node bears it.
const BEARING: f64 = 1.0;

/// Lowers the contacts of `other` with the proxy of `worn` by what has worn away under them, and
/// gives them the friction of the surface's material, or more where the body ploughs.
pub(crate) fn lay(
    context: &mut ContactModificationContext<'_>,
    worn: &WornCollider,
    other: ColliderHandle,
    friction: f64,
) {
    let (colliders, proxy_is_first) = (context.colliders, context.collider1 == worn.proxy);
    let (Some(proxy), Some(other)) = (colliders.get(worn.proxy), colliders.get(other)) else {
        return;
    };
    let Some(manifold) = context.rigid_mut() else { return };
    let friction = friction.max(worn.surface.laws().material.friction);
    *manifold.friction = scalar::narrow(friction);
    if worn.surface.worn().max_depth == 0.0 {
        return;
    }
    let frame = worn.pose(proxy);
    let local = |p: Vector3<f64>| frame.inverse_transform_point(&Point3::from(p));
    let part = match proxy_is_first {
        true => manifold.manifold.subshape2,
        false => manifold.manifold.subshape1,
    };
    if let Some((centre, radius)) = ball(other, part) {
        let sag = worn.surface.sag_under_ball(&local(centre), radius);
        for contact in manifold.solver_contacts.iter_mut() {
            contact.dist += scalar::narrow(sag);
        }
        return;
    }
    let reach = BEARING * worn.surface.pitch();
    for contact in manifold.solver_contacts.iter_mut() {
        let at = if proxy_is_first { contact.anchor2 } else { contact.anchor1 };
        contact.dist += scalar::narrow(worn.surface.sag_at(&local(scalar::vector(at)), reach));
    }
}

/// Centre in the world and radius of a collider's part, if it is a ball.
fn ball(collider: &Collider, part: u32) -> Option<(Vector3<f64>, f64)> {
    let (pose, shape) = subshape(collider.position(), collider.shape(), part)?;
    match shape.as_typed_shape() {
        TypedShape::Ball(ball) => {
            Some((scalar::vector(pose.translation), scalar::wide(ball.radius)))
        }
        _ => None,
    }
}

fn subshape<'a>(pose: &Pose, shape: &'a dyn Shape, part: u32) -> Option<(Pose, &'a dyn Shape)> {
    match shape.as_typed_shape() {
        TypedShape::Compound(compound) => {
            let (local, shape) = compound.shapes().get(part as usize)?;
            Some((pose * *local, shape.as_ref()))
        }
        _ => Some((*pose, shape)),
    }
}
