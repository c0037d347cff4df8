//! What follows a solid that has worn deep: its body, its collider, its events.

use super::tumble::{DENSITY, EDGE, Tumbler};
use crate::plugin::abrade::{Body, Hull, Shape, State, cuboid_vertices};
use crate::plugin::rapier::parry::shape::TypedShape;
use crate::plugin::rapier::prelude::*;
use crate::plugin::{WearEvent, WearSettings, scalar};
use nalgebra::{Isometry3, Point3, Vector3};

/// Throws both alike until the solid of the first was renewed, in the last step.
fn until_renewed<const N: usize>(mut tumblers: [&mut Tumbler; N]) {
    for _ in 0..400 {
        tumblers.iter_mut().for_each(|tumbler| tumbler.aim());
        for _ in 0..4 {
            tumblers.iter_mut().for_each(|tumbler| tumbler.step());
            let first = &tumblers[0];
            if first.wear.events().contains(&WearEvent::Renewed { surface: first.id }) {
                return;
            }
        }
    }
    panic!("the solid was not renewed")
}

/// Fails for a body that jumps, or whose material changes its motion, when its centre moves.
#[test]
fn what_stays_goes_on_as_it_was() {
    // A mass that is not in the middle makes the first shift of the centre a large one.
    let moments = scalar::to_vector(&Vector3::repeat(DENSITY * EDGE.powi(5) / 6.0));
    let mass = scalar::narrow(DENSITY * EDGE.powi(3));
    let corner = scalar::to_vector(&Vector3::new(0.2 * EDGE, 0.1 * EDGE, 0.0));
    let heavy = MassProperties::new(corner, mass, moments);
    let [mut with, mut without] = [true, false].map(|renew| {
        let half = scalar::narrow(0.5 * EDGE);
        let proxy = ColliderBuilder::cuboid(half, half, half).density(scalar::narrow(0.0));
        let body = RigidBodyBuilder::dynamic().additional_mass_properties(heavy);
        Tumbler::new(proxy, body, WearSettings { renew, ..WearSettings::default() })
    });
    until_renewed([&mut with, &mut without]);
    let shift = (with.weighed().1 - without.weighed().1).norm();
    assert!(shift > 0.2 * EDGE, "{shift}");
    let [(pose, v, w), (other_pose, other_v, other_w)] = [&with, &without].map(|tumbler| {
        let state = tumbler.state();
        let (_, centre, _) = tumbler.weighed();
        let pose = state.pose() * Isometry3::from(-centre.coords);
        let arm = pose.translation.vector - state.position.coords;
        (pose, state.velocity + state.spin.cross(&arm), state.spin)
    });
    let rounding = 16.0 * f64::EPSILON;
    let moved = pose.translation.vector - other_pose.translation.vector;
    assert!(moved.norm() < rounding * EDGE, "{moved}");
    assert_eq!(pose.rotation, other_pose.rotation);
    assert!((v - other_v).norm() < rounding * v.norm(), "{v} {other_v}");
    assert_eq!(w, other_w);
}

/// Fails for a mass that is the density times the volume whatever the embedder gave, for one that
/// a registered body does not share, and for one that is lost when Rapier sums it up anew.
#[test]
fn a_body_keeps_its_mass_per_volume() {
    let half = scalar::narrow(0.5 * EDGE);
    let heavy = 3.0 * DENSITY * EDGE.powi(3);
    let ways = [
        (ColliderBuilder::cuboid(half, half, half).density(0.0), scalar::narrow(heavy)),
        (ColliderBuilder::cuboid(half, half, half).mass(scalar::narrow(heavy)), 0.0),
    ];
    for (proxy, mass) in ways {
        let body = RigidBodyBuilder::dynamic().additional_mass(mass);
        let mut tumbler = Tumbler::new(proxy, body, WearSettings::default());
        until_renewed([&mut tumbler]);
        let worn = &tumbler.wear[tumbler.id];
        let volume = worn.mass_properties(1.0).expect("a solid").0.mass;
        let expected = heavy * volume / EDGE.powi(3);
        assert!(expected < heavy * (1.0 - 1e-5));
        for _ in 0..2 {
            let (mass, ..) = tumbler.weighed();
            assert!((mass / expected - 1.0).abs() < 1e-6, "{mass} {expected}");
            let (bodies, colliders) = (&mut tumbler.world.bodies, &tumbler.world.colliders);
            bodies[tumbler.cube].recompute_mass_properties_from_colliders(colliders);
        }
    }
}

/// Fails for a registered body whose mass, shape or reach stays what it was.
#[test]
fn a_registered_body_becomes_what_is_left_of_it() {
    let mut tumbler = Tumbler::cuboid();
    let heavy = 2.0 * DENSITY;
    let corners = cuboid_vertices(&Vector3::repeat(0.5 * EDGE));
    let (hull, inertia, _) = Hull::solid(&corners, heavy).expect("a cube");
    let state = State::at(Point3::new(0.0, 0.0, EDGE));
    let body = Body { shape: Shape::hull(hull), inertia, state, rotation_locked: false };
    let PhysicsWorld { bodies, colliders, .. } = &mut tumbler.world;
    tumbler.wear.place(tumbler.cube, body, bodies, colliders).expect("the cube");
    until_renewed([&mut tumbler]);
    let (left, _) = tumbler.wear[tumbler.id].mass_properties(heavy).expect("a solid");
    let (mass, _, tensor) = tumbler.weighed();
    assert!((mass / left.mass - 1.0).abs() < 1e-6, "{mass} {}", left.mass);
    assert!((tensor - left.tensor).norm() < 1e-6 * left.tensor.norm(), "{tensor}");
}

/// The corners of the proxy's shape, and the nodes [m].
fn corners(tumbler: &Tumbler) -> (Vec<Vector3<f64>>, Vec<Vector3<f64>>) {
    let collider = tumbler.world.bodies[tumbler.cube].colliders()[0];
    let points = match tumbler.world.colliders[collider].shape().as_typed_shape() {
        TypedShape::ConvexPolyhedron(hull) => hull.points(),
        TypedShape::TriMesh(mesh) => mesh.vertices(),
        _ => &[],
    };
    let nodes = tumbler.wear[tumbler.id].nodes();
    let nodes = (0..nodes.len()).map(|i| nodes.position(i).coords).collect();
    (points.iter().map(|p| scalar::vector(*p)).collect(), nodes)
}

/// Fails for a proxy that stays, for one that a node sticks out of, and for one that loses what the
/// embedder has set on it.
#[test]
fn the_proxy_follows_the_worn_solid() {
    let n = scalar::narrow;
    let half = n(0.5 * EDGE);
    let cuboid = ColliderBuilder::cuboid(half, half, half);
    let radius = 0.5 * EDGE * 3f64.sqrt();
    let ball = ColliderBuilder::ball(n(radius));
    for (proxy, is_ball) in [(cuboid, false), (ball, true)] {
        let groups = InteractionGroups::new(Group::GROUP_3, Group::ALL, InteractionTestMode::And);
        let proxy = proxy.density(n(DENSITY)).friction(n(0.123)).collision_groups(groups);
        let body = RigidBodyBuilder::dynamic();
        let mut tumbler = Tumbler::new(proxy, body, WearSettings::default());
        for _ in 0..30 {
            until_renewed([&mut tumbler]);
        }
        let (points, nodes) = corners(&tumbler);
        let collider = tumbler.world.bodies[tumbler.cube].colliders()[0];
        let collider = &tumbler.world.colliders[collider];
        assert_eq!((collider.friction(), collider.collision_groups()), (n(0.123), groups));
        let rounding = 4.0 * scalar::ROUNDING * EDGE;
        let reach = |along: &Vector3<f64>, points: &[Vector3<f64>]| {
            points.iter().map(|p| p.dot(along)).fold(f64::NEG_INFINITY, f64::max)
        };
        if is_ball {
            let farthest = nodes.iter().map(|node| node.norm()).fold(0.0, f64::max);
            let now = scalar::wide(collider.shape().as_ball().expect("a ball").radius);
            assert!(farthest < radius * (1.0 - 1e-3) && (now - farthest).abs() < rounding);
            continue;
        }
        assert!(points.len() > 8, "{points:?}");
        for along in nodes.iter().map(|node| node.normalize()) {
            let off = reach(&along, &points) - reach(&along, &nodes);
            assert!(off.abs() < 100.0 * rounding, "{off:e} along {along}");
        }
    }
}

/// Fails for a refusal that ends in a panic, is told at every step, or stops the wear.
#[test]
fn a_solid_that_cannot_be_renewed_says_so_and_wears_on() {
    let mut tumbler = Tumbler::cuboid();
    tumbler.speed = 12.0;
    let (mut refused, mut worn) = (0, 0.0);
    for _ in 0..40 {
        tumbler.aim();
        for _ in 0..4 {
            tumbler.step();
            let events = tumbler.wear.events();
            let told = events.iter().any(|e| matches!(e, WearEvent::NotRenewed { .. }));
            let volume = tumbler.wear[tumbler.id].wear_volume();
            assert!(!told || volume > worn, "told again without more wear");
            worn = if told { volume } else { worn };
            refused += usize::from(told);
        }
    }
    assert!(refused > 1, "{refused}");
}
