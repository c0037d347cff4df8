//! The core's body behind a rigid body: geometry from its colliders, about its centre of mass.

use abrade::{Ball, Hull, Inertia, Piece, Shape, ShapeError, cuboid_vertices};
use nalgebra::{Isometry3, Point3, Vector3};
use rapier::dynamics::RigidBody;
use rapier::geometry::{Collider, ColliderHandle, ColliderSet};
use rapier::math::Pose;
use rapier::parry::shape::{Shape as RapierShape, TypedShape};

use crate::event::Refusal;
use crate::obstacle::extent;
use crate::scalar;

/// Radius about the centre of mass that holds the body's solid colliders [m].
pub(crate) fn radius(body: &RigidBody, colliders: &ColliderSet) -> f64 {
    let com = Isometry3::from(-scalar::vector(body.local_center_of_mass()));
    solids(body, colliders, true)
        .map(|(_, collider)| reach(collider.shape(), &(com * place(collider))))
        .fold(0.0, f64::max)
}

/// Largest distance of a point of the placed shape from the origin [m]; that of its box for
/// shapes that have no wear contact.
fn reach(shape: &dyn RapierShape, place: &Isometry3<f64>) -> f64 {
    let farthest = |points: &mut dyn Iterator<Item = Point3<f64>>| {
        points.map(|p| (place * p).coords.norm()).fold(0.0, f64::max)
    };
    match shape.as_typed_shape() {
        TypedShape::Ball(ball) => place.translation.vector.norm() + scalar::wide(ball.radius),
        TypedShape::ConvexPolyhedron(hull) => {
            farthest(&mut hull.points().iter().map(|p| scalar::vector(*p).into()))
        }
        TypedShape::Compound(compound) => {
            let part = |(pose, part): &(Pose, _)| {
                let part: &rapier::geometry::SharedShape = part;
                reach(part.as_ref(), &(place * scalar::pose(pose)))
            };
            compound.shapes().iter().map(part).fold(0.0, f64::max)
        }
        _ => {
            let local = extent(&shape.compute_local_aabb());
            let middle = nalgebra::center(&local.low, &local.high).coords;
            farthest(&mut cuboid_vertices(&local.half()).into_iter().map(|corner| corner + middle))
        }
    }
}

/// Shape about the centre of mass.
pub(crate) fn shape(body: &RigidBody, colliders: &ColliderSet) -> Result<Shape, Refusal> {
    let com = Isometry3::from(-scalar::vector(body.local_center_of_mass()));
    let mut pieces = Vec::new();
    for (handle, collider) in solids(body, colliders, true) {
        let refused = Refusal::Shape { collider: handle };
        let place = com * place(collider);
        add_pieces(&mut pieces, collider.shape(), &place).map_err(|_| refused)?;
    }
    Shape::union(pieces).map_err(|_| Refusal::Massless)
}

/// Mass and inertia about the centre of mass.
pub(crate) fn inertia(body: &RigidBody) -> Result<Inertia, Refusal> {
    if body.is_kinematic() {
        return Ok(Inertia::immovable());
    }
    let local = &body.mass_properties().local_mprops;
    let mass = scalar::wide(local.mass());
    let tensor = scalar::matrix(&local.reconstruct_inertia_matrix());
    match mass > 0.0 && mass.is_finite() && tensor.iter().all(|x| x.is_finite()) {
        true => Ok(Inertia { mass, tensor }),
        false => Err(Refusal::Massless),
    }
}

/// The colliders of a body, in their order.
pub(crate) fn solids<'a>(
    body: &'a RigidBody,
    colliders: &'a ColliderSet,
    solid_only: bool,
) -> impl Iterator<Item = (ColliderHandle, &'a Collider)> {
    let all = body.colliders().iter().filter_map(|&h| colliders.get(h).map(|c| (h, c)));
    all.filter(move |(_, collider)| !solid_only || is_solid(collider))
}

/// True for a collider that counts.
pub(crate) fn is_solid(collider: &Collider) -> bool {
    collider.is_enabled() && !collider.is_sensor()
}

fn place(collider: &Collider) -> Isometry3<f64> {
    collider.position_wrt_parent().map_or_else(Isometry3::identity, scalar::pose)
}

/// A box of the given half extents [m].
pub(crate) fn cuboid(half: &Vector3<f64>) -> Option<Shape> {
    let piece = hull(cuboid_vertices(half).into_iter(), &Isometry3::identity()).ok()?;
    Shape::union(vec![piece]).ok()
}

/// The shape of a collider about its own origin.
pub(crate) fn standing(collider: &Collider) -> Option<Shape> {
    let mut pieces = Vec::new();
    add_pieces(&mut pieces, collider.shape(), &Isometry3::identity()).ok()?;
    Shape::union(pieces).ok()
}

/// A shape that has no wear contact.
struct NoContact;

impl From<ShapeError> for NoContact {
    fn from(_: ShapeError) -> Self {
        Self
    }
}

fn add_pieces(
    pieces: &mut Vec<Piece>,
    shape: &dyn RapierShape,
    place: &Isometry3<f64>,
) -> Result<(), NoContact> {
    match shape.as_typed_shape() {
        TypedShape::Ball(ball) => {
            let centre = Point3::from(place.translation.vector);
            pieces.push(Piece::Ball(Ball { centre, radius: scalar::wide(ball.radius) }));
        }
        TypedShape::Cuboid(cuboid) => {
            let corners = cuboid_vertices(&scalar::vector(cuboid.half_extents));
            pieces.push(hull(corners.into_iter(), place)?);
        }
        TypedShape::ConvexPolyhedron(polyhedron) => {
            let corners = polyhedron.points().iter().map(|p| scalar::vector(*p).into());
            pieces.push(hull(corners, place)?);
        }
        TypedShape::Compound(compound) => {
            for (pose, part) in compound.shapes() {
                add_pieces(pieces, part.as_ref(), &(place * scalar::pose(pose)))?;
            }
        }
        _ => return Err(NoContact),
    }
    Ok(())
}

/// The hull of corners placed about the body's centre of mass.
fn hull(
    corners: impl Iterator<Item = Point3<f64>>,
    place: &Isometry3<f64>,
) -> Result<Piece, ShapeError> {
    let corners: Vec<Point3<f64>> = corners.map(|corner| place * corner).collect();
    // The body's mass is Rapier's: the density only scales an inertia that is not used.
    let (hull, _, shift): (Hull, Inertia, Vector3<f64>) = Hull::solid(&corners, 1.0)?;
    Ok(Piece::Hull(hull.moved(&shift)))
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;
    use rapier::dynamics::RigidBodyBuilder;
    use rapier::geometry::{ColliderBuilder, SharedShape};
    use rapier::pipeline::PhysicsWorld;

    use super::*;

    /// Fails for pieces about the wrong point, a compound that is not opened, a sensor that is
    /// taken for solid, and a radius that a corner sticks out of.
    #[test]
    fn pieces_lie_about_the_centre_of_mass() {
        let mut world = PhysicsWorld::default();
        let n = scalar::narrow;
        let at = |x: f64| scalar::to_pose(&Isometry3::from(Vector3::new(x, 0.0, 0.0)));
        let (body, _) = world.insert(
            RigidBodyBuilder::dynamic(),
            ColliderBuilder::cuboid(n(1.0), n(1.0), n(1.0)).position(at(0.0)),
        );
        let part = (at(1.0), SharedShape::cuboid(n(1.0), n(1.0), n(1.0)));
        let second = ColliderBuilder::compound(vec![part]).position(at(3.0));
        world.insert_collider(second, Some(body));
        let sensor = ColliderBuilder::ball(n(9.0)).sensor(true).density(n(0.0));
        world.insert_collider(sensor, Some(body));
        let rb = &mut world.bodies[body];
        rb.recompute_mass_properties_from_colliders(&world.colliders);
        let rb = &world.bodies[body];
        let shape = shape(rb, &world.colliders).expect("a shape");
        let centres: Vec<f64> = shape
            .pieces()
            .iter()
            .filter_map(|piece| match piece {
                Piece::Hull(hull) => Some(hull.vertices().iter().map(|v| v.x).sum::<f64>() / 8.0),
                Piece::Ball(_) => None,
            })
            .collect();
        assert!((centres[0] + 2.0).abs() < 1e-6 && (centres[1] - 2.0).abs() < 1e-6, "{centres:?}");
        let radius = radius(rb, &world.colliders);
        assert!((radius - 11f64.sqrt()).abs() < 1e-5 && shape.bounding_radius() <= radius + 1e-9);
        let inertia = inertia(rb).expect("a mass");
        assert!((inertia.mass - 16.0).abs() < 1e-4);
        let across = 8.0 * (2.0 / 3.0) * 2.0 + 16.0 * 4.0;
        assert!((inertia.tensor[(1, 1)] - across).abs() < 1e-3 * across, "{}", inertia.tensor);
    }
}
