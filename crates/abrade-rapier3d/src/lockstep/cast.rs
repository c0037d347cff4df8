//! Whether two moving colliders meet, in `f64`: Rapier's own cast in `f32` misses at the size of
//! millimetres.

use abrade_lockstep::rapier as fine;
use abrade_lockstep::{from_vector, to_vector};
use fine::parry::query::{ShapeCastOptions, cast_shapes};
use nalgebra::Vector3;
use rapier::geometry::Collider;

use crate::lockstep::widen;

/// Unit vector from `a` towards `b` where they meet, if two colliders that are apart do so within
/// `dt` [s], moving straight at the given velocities [m/s].
pub(crate) fn meeting(
    [a, b]: [&Collider; 2],
    [va, vb]: [Vector3<f64>; 2],
    dt: f64,
) -> Option<Vector3<f64>> {
    let (shape_a, shape_b) = (widen::shape(a.shape())?, widen::shape(b.shape())?);
    let (place_a, place_b) = (widen::pose(a.position()), widen::pose(b.position()));
    let options = ShapeCastOptions {
        stop_at_penetration: false,
        ..ShapeCastOptions::with_max_time_of_impact(dt)
    };
    let (va, vb) = (to_vector(&va), to_vector(&vb));
    let hit = cast_shapes(&place_a, va, shape_a.as_ref(), &place_b, vb, shape_b.as_ref(), options);
    let hit = hit.ok().flatten().filter(|hit| hit.time_of_impact > 0.0)?;
    Some(from_vector(place_a.rotation * hit.normal1))
}
