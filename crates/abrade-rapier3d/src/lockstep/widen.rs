//! Shapes, colliders and joints as the private `f64` world holds them.

use abrade_lockstep::rapier as fine;
use abrade_lockstep::{to_pose, to_vector};
use fine::dynamics::{JointAxesMask, JointLimits, JointMotor, MotorModel};
use fine::geometry::{ColliderBuilder, Group, InteractionGroups, InteractionTestMode, SharedShape};
use fine::parry::shape::TriMeshFlags;
use rapier::dynamics::{CoefficientCombineRule, GenericJoint};
use rapier::geometry::Collider;
use rapier::math::{Pose, Vector};
use rapier::parry::shape::{Shape, TypedShape};

use crate::scalar;

fn point(v: Vector) -> fine::math::Vector {
    to_vector(&scalar::vector(v))
}

pub(crate) fn pose(p: &Pose) -> fine::math::Pose {
    to_pose(&scalar::pose(p))
}

/// The shape in `f64`; `None` for kinds that the private world does not take.
pub(crate) fn shape(shape: &dyn Shape) -> Option<SharedShape> {
    let n = scalar::wide;
    Some(match shape.as_typed_shape() {
        TypedShape::Ball(s) => SharedShape::ball(n(s.radius)),
        TypedShape::Cuboid(s) => {
            let half = scalar::vector(s.half_extents);
            SharedShape::cuboid(half.x, half.y, half.z)
        }
        TypedShape::Capsule(s) => {
            SharedShape::capsule(point(s.segment.a), point(s.segment.b), n(s.radius))
        }
        TypedShape::Cylinder(s) => SharedShape::cylinder(n(s.half_height), n(s.radius)),
        TypedShape::Cone(s) => SharedShape::cone(n(s.half_height), n(s.radius)),
        TypedShape::Segment(s) => SharedShape::segment(point(s.a), point(s.b)),
        TypedShape::Triangle(s) => SharedShape::triangle(point(s.a), point(s.b), point(s.c)),
        TypedShape::HalfSpace(s) => SharedShape::halfspace(point(s.normal)),
        TypedShape::ConvexPolyhedron(s) => {
            let points: Vec<_> = s.points().iter().map(|p| point(*p)).collect();
            SharedShape::convex_hull(&points)?
        }
        TypedShape::TriMesh(s) => {
            let points = s.vertices().iter().map(|p| point(*p)).collect();
            let flags = TriMeshFlags::from_bits_truncate(s.flags().bits());
            SharedShape::trimesh_with_flags(points, s.indices().to_vec(), flags).ok()?
        }
        TypedShape::HeightField(s) => {
            let (points, indices) = s.to_trimesh();
            let points = points.iter().map(|p| point(*p)).collect();
            SharedShape::trimesh_with_flags(points, indices, TriMeshFlags::FIX_INTERNAL_EDGES)
                .ok()?
        }
        TypedShape::Compound(s) => {
            let part = |(at, part): &(Pose, rapier::geometry::SharedShape)| {
                self::shape(part.as_ref()).map(|shape| (pose(at), shape))
            };
            SharedShape::compound(s.shapes().iter().map(part).collect::<Option<_>>()?)
        }
        _ => return None,
    })
}

/// The collider in `f64`, without mass, at its place on its body, or in the world.
pub(crate) fn collider(collider: &Collider, place: &Pose) -> Option<ColliderBuilder> {
    let n = scalar::wide;
    Some(
        ColliderBuilder::new(shape(collider.shape())?)
            .position(pose(place))
            .density(0.0)
            .friction(n(collider.friction()))
            .friction_combine_rule(rule(collider.friction_combine_rule()))
            .restitution(n(collider.restitution()))
            .restitution_combine_rule(rule(collider.restitution_combine_rule()))
            .contact_skin(n(collider.contact_skin()))
            .collision_groups(groups(collider.collision_groups()))
            .solver_groups(groups(collider.solver_groups())),
    )
}

fn rule(rule: CoefficientCombineRule) -> fine::dynamics::CoefficientCombineRule {
    use fine::dynamics::CoefficientCombineRule as Fine;
    match rule {
        CoefficientCombineRule::Average => Fine::Average,
        CoefficientCombineRule::Min => Fine::Min,
        CoefficientCombineRule::Multiply => Fine::Multiply,
        CoefficientCombineRule::Max => Fine::Max,
        CoefficientCombineRule::ClampedSum => Fine::ClampedSum,
        CoefficientCombineRule::GeometricMean => Fine::GeometricMean,
    }
}

fn groups(groups: rapier::geometry::InteractionGroups) -> InteractionGroups {
    let bits = Group::from_bits_retain;
    let mode = match groups.test_mode {
        rapier::geometry::InteractionTestMode::And => InteractionTestMode::And,
        rapier::geometry::InteractionTestMode::Or => InteractionTestMode::Or,
    };
    InteractionGroups::new(bits(groups.memberships.bits()), bits(groups.filter.bits()), mode)
}

/// The joint in `f64`.
pub(crate) fn joint(joint: &GenericJoint) -> fine::dynamics::GenericJoint {
    let n = scalar::wide;
    let axes = |bits: u8| JointAxesMask::from_bits_truncate(bits);
    let limit = |i: usize| {
        let limit = &joint.limits[i];
        JointLimits { min: n(limit.min), max: n(limit.max), impulse: 0.0 }
    };
    let motor = |i: usize| {
        let motor = &joint.motors[i];
        JointMotor {
            target_vel: n(motor.target_vel),
            target_pos: n(motor.target_pos),
            stiffness: n(motor.stiffness),
            damping: n(motor.damping),
            max_force: n(motor.max_force),
            impulse: 0.0,
            model: match motor.model {
                rapier::dynamics::MotorModel::AccelerationBased => MotorModel::AccelerationBased,
                rapier::dynamics::MotorModel::ForceBased => MotorModel::ForceBased,
            },
        }
    };
    let mut copy = fine::dynamics::GenericJoint::new(axes(joint.locked_axes.bits()));
    copy.local_frame1 = pose(&joint.local_frame1);
    copy.local_frame2 = pose(&joint.local_frame2);
    copy.limit_axes = axes(joint.limit_axes.bits());
    copy.motor_axes = axes(joint.motor_axes.bits());
    copy.coupled_axes = axes(joint.coupled_axes.bits());
    copy.limits = std::array::from_fn(limit);
    copy.motors = std::array::from_fn(motor);
    copy.contacts_enabled = joint.contacts_enabled;
    copy.set_enabled(joint.is_enabled());
    copy
}
