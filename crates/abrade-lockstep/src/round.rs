//! Bodies that are the same however they turn.

use abrade::{Ball, Piece, Shape};
use rapier::dynamics::RigidBody;
use rapier::geometry::{Collider, ColliderSet};

/// Share of its radius or inertia by which a round body may be off.
const ROUND: f64 = 1e-6;

/// True for a body that looks the same however it turns, to contacts and to its own inertia.
pub(crate) fn is_round(rb: &RigidBody, colliders: &ColliderSet) -> bool {
    let centre = rb.local_center_of_mass();
    let is_centred = |collider: &Collider| {
        let at = collider.position_wrt_parent().map_or(centre, |place| place.translation);
        collider.shape().as_ball().is_some_and(|ball| (at - centre).length() < ROUND * ball.radius)
    };
    let inertia = rb.mass_properties().local_mprops.principal_inertia();
    let (least, most) = (inertia.min_element(), inertia.max_element());
    most - least <= ROUND * most
        && rb.colliders().iter().filter_map(|own| colliders.get(*own)).all(is_centred)
}

/// True for a ball about its centre of mass.
pub(crate) fn is_ball(shape: &Shape) -> bool {
    let centred = |ball: &Ball| ball.centre.coords.norm() < ROUND * ball.radius;
    matches!(shape.pieces(), [Piece::Ball(ball)] if centred(ball))
}
