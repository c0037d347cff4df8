//! Tools: kinematic bodies led through wear surfaces.

use super::rig::{self, DENSITY, HALF_THICKNESS, RADIUS, Rig, surface};
use crate::plugin;
use crate::plugin::abrade::{
    Body, Drive, DriveSolution, Encounter, EncounterSettings, Inertia, Loads, Material,
    PhysicsError, Placed, Shape, State, Surface, SurfaceLaws, TriangleMesh, Until,
};
use crate::plugin::rapier::math::{Pose, Vector};
use crate::plugin::rapier::prelude::*;
use crate::plugin::{
    Refusal, Resolver, SurfaceId, WearError, WearEvent, WearSettings, WearWorld, scalar,
};
use nalgebra::{Isometry3, Vector3};

const DEPTH: f64 = 0.05e-3;
const SPEED: f64 = 0.3;
/// From beyond one border of the plate to its middle [m].
const START: f64 = -18.5e-3;
const WAY: f64 = 15e-3;

#[derive(Clone, Copy, Debug)]
enum Led {
    ByVelocity,
    ByPosition,
}

fn n(x: f64) -> Real {
    scalar::narrow(x)
}

/// A ball that is led from `at` [m] at `velocity` [m/s], and is a tool.
fn tool(rig: &mut Rig, led: Led, at: Vector3<f64>, velocity: Vector3<f64>) -> RigidBodyHandle {
    let body = match led {
        Led::ByVelocity => RigidBodyBuilder::kinematic_velocity_based(),
        Led::ByPosition => RigidBodyBuilder::kinematic_position_based(),
    };
    let body = body.translation(scalar::to_vector(&at)).linvel(scalar::to_vector(&velocity));
    let ball = ColliderBuilder::ball(n(RADIUS)).density(n(DENSITY));
    let (body, _) = rig.world.insert(body, ball);
    rig.wear.add_tool(body, &rig.world.bodies).expect("a kinematic body");
    body
}

/// Where a plough along x begins, in the middle of the plate's width.
fn beside() -> Vector3<f64> {
    Vector3::new(START, 0.013e-3, RADIUS - DEPTH)
}

/// Sets where a tool is to be at the end of the next step.
fn aim(rig: &mut Rig, tool: RigidBodyHandle, at: Vector3<f64>) {
    let rb = rig.world.bodies.get_mut(tool).expect("the tool");
    rb.set_next_kinematic_translation(scalar::to_vector(&at));
}

/// Ploughs to the middle of the plate in steps of `dt` [s]; shows each step's load.
fn plough(
    rig: &mut Rig,
    led: Led,
    [speed, dt]: [f64; 2],
    mut see: impl FnMut(&Rig, RigidBodyHandle),
) -> RigidBodyHandle {
    let from = beside();
    let body = tool(rig, led, from, Vector3::x() * speed);
    let steps = (WAY / (speed * dt)).round() as u32;
    for step in 1..=steps {
        if matches!(led, Led::ByPosition) {
            let share = f64::from(step) / f64::from(steps);
            aim(rig, body, from + Vector3::x() * (WAY * share));
        }
        rig.step();
        see(rig, body);
    }
    body
}

/// The same in the core alone, in the same calls: wear volume [m3].
fn by_core(from: &State, dt: f64, steps: u32) -> f64 {
    let mut surface = surface();
    let mut body = Body {
        shape: Shape::ball(scalar::wide(n(RADIUS))).expect("a ball"),
        inertia: Inertia::immovable(),
        state: *from,
        rotation_locked: false,
    };
    let settings = EncounterSettings::default();
    let mut encounter = Encounter::new(&body, [&surface], settings).expect("an encounter");
    let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
    for _ in 0..steps {
        encounter
            .advance(&mut body, &mut placed, &Loads::default(), dt, Until::Duration, &mut ())
            .expect("a plough");
    }
    surface.wear_volume()
}

/// Fails for a tool that is not led where Rapier leads it, whose springs are lost between the steps,
/// or that is kept in Rapier's numbers.
#[test]
fn a_tool_ploughs_as_in_the_core_at_any_step() {
    let mut all = Vec::new();
    for led in [Led::ByVelocity, Led::ByPosition] {
        for dt in [1.0 / 60.0, 1.0 / 240.0] {
            let mut rig = Rig::new(Vector3::zeros(), dt);
            let steps = (WAY / (SPEED * dt)).round() as u32;
            let still = tool(&mut rig, Led::ByVelocity, beside(), Vector3::x() * SPEED);
            let from = rig.state(still);
            rig.wear.remove_tool(still);
            let mut impulse = Vector3::zeros();
            let body = plough(&mut rig, led, [SPEED, dt], |rig, tool| {
                assert!(rig.wear.events().iter().all(|e| matches!(e, WearEvent::Started { .. })));
                impulse += rig.wear.tool_load(tool).expect("a tool").impulse;
            });
            let wear = rig.wear[rig.plate].wear_volume();
            let miss = wear / by_core(&from, scalar::wide(n(dt)), steps) - 1.0;
            println!("{led:?} dt {dt:.1e}: W {wear:.9e}, {miss:.1e} from the core's");
            // Positions of f32 are rounded by 1e-9 m at the way's end.
            let rounded = matches!(led, Led::ByPosition) && scalar::ROUNDING > 1e-10;
            let limit = if rounded { 1e-6 } else { 1e-9 };
            assert!(miss.abs() < limit, "{led:?} dt {dt:e}: {miss:e}");
            assert!(rig.wear.in_contact(body));
            all.push((wear, impulse));
        }
    }
    let (wear, impulse) = all[0];
    let spread = all.iter().map(|(w, _)| (w / wear - 1.0).abs()).fold(0.0, f64::max);
    let force = all.iter().map(|(_, j)| (j - impulse).norm() / impulse.norm()).fold(0.0, f64::max);
    println!("spread of W {spread:.1e}, of the mean force {force:.1e}");
    assert!(spread < 1e-6 && force < 1e-4, "{spread:e} {force:e}");
}

/// Fails for a load of another sign, frame or step than that of the contact.
#[test]
fn the_cutting_force_times_the_way_is_the_work() {
    let dt = 1.0 / 240.0;
    let mut rig = Rig::new(Vector3::new(0.4, -0.2, 0.3), dt);
    let origin = Vector3::new(0.4, -0.2, 0.3);
    let turn = 2.0;
    let body = tool(&mut rig, Led::ByVelocity, origin + beside(), Vector3::x() * SPEED);
    rig.world.bodies[body].set_angvel(Vector::Y * n(turn), true);
    let (mut work, mut last) = (0.0, Vector3::zeros());
    for _ in 0..(WAY / (SPEED * dt)).round() as u32 {
        rig.step();
        let load = rig.wear.tool_load(body).expect("a tool");
        assert_eq!(load.dt, scalar::wide(n(dt)));
        work -= (load.force().x * SPEED + load.torque().y * turn) * load.dt;
        last = load.force();
    }
    let ledger = rig.wear.ledger();
    println!("{last:?} N, {work} J of {ledger:?}");
    assert!((work / ledger.external_work - 1.0).abs() < 1e-6, "{work} {ledger:?}");
    assert!(ledger.wear > 0.0 && ledger.numerical().abs() < 1e-3 * work);
    // It is held back and lifted, by more than friction and less than the hardness of its face.
    assert!(last.x < 0.0 && last.z > 0.0, "{last:?}");
    let face = std::f64::consts::PI * RADIUS * DEPTH * 6.6e9;
    assert!((0.2..2.0).contains(&(last.z / face)), "{} of {face} N", last.z);
    assert!(last.y.abs() < 0.05 * last.norm(), "{last:?}");
}

/// Fails for a kinematic body that wears without being asked to, and for tools that are looked at
/// closely wherever they are.
#[test]
fn only_tools_cut_and_only_near_a_surface() {
    let mut rig = Rig::new(Vector3::zeros(), 1.0 / 60.0);
    let body = tool(&mut rig, Led::ByVelocity, beside(), Vector3::x() * SPEED);
    rig.wear.remove_tool(body);
    let far = tool(&mut rig, Led::ByVelocity, beside() + Vector3::z(), Vector3::x() * SPEED);
    for _ in 0..4 {
        rig.step();
    }
    assert_eq!(rig.wear[rig.plate].wear_volume(), 0.0);
    let counters = rig.wear.counters();
    assert_eq!((counters.micro, counters.steps, counters.refused), (0, 0, 0));
    assert_eq!(rig.wear.tool_load(body), None);
    assert_eq!(rig.wear.tool_load(far).map(|load| load.impulse), Some(Vector3::zeros()));
    let dynamic = rig.ball(Vector3::z(), Vector3::zeros());
    let refused = rig.wear.add_tool(dynamic, &rig.world.bodies);
    assert_eq!(refused, Err(WearError::NotKinematic { body: dynamic }));
}

/// Fails for a body that two of them lead.
#[test]
fn a_body_is_driven_or_a_tool() {
    let mut rig = Rig::new(Vector3::zeros(), 1.0 / 60.0);
    let at = Vector3::z() * (RADIUS + 1e-3);
    let body = tool(&mut rig, Led::ByPosition, at, Vector3::zeros());
    let solution = DriveSolution::Dynamic;
    let (load, speed) = (100.0, 0.2);
    let drive = Drive { indent_to: load, load, speed, distance: 4e-3, mass: 0.05, solution };
    let driven = |rig: &mut Rig| {
        let ball = rig::body(Vector3::zeros());
        rig.wear.drive(rig.plate, body, ball, drive, &rig.world.bodies)
    };
    let already = |led| Err(WearError::LedAlready { body, led });
    assert_eq!(driven(&mut rig), already(plugin::Led::Tool));
    rig.wear.remove_tool(body);
    assert_eq!(driven(&mut rig), Ok(()));
    let refused = rig.wear.add_tool(body, &rig.world.bodies);
    assert_eq!(refused, already(plugin::Led::Driven));
    assert!(rig.wear.tool_load(body).is_none());
}

/// Fails for a tool that goes on when it has stopped, that loses its groove meanwhile, or that is lost
/// when it is put somewhere else.
#[test]
fn a_tool_may_stop_in_its_groove_and_be_taken_away() {
    for led in [Led::ByVelocity, Led::ByPosition] {
        let mut rig = Rig::new(Vector3::zeros(), 1.0 / 60.0);
        let body = plough(&mut rig, led, [SPEED, 1.0 / 60.0], |_, _| {});
        let (wear, at) = (rig.wear[rig.plate].wear_volume(), rig.state(body).position.coords);
        rig.world.bodies[body].set_linvel(Vector::ZERO, true);
        let before = rig.wear.counters().steps;
        for _ in 0..3 {
            rig.step();
            let load = rig.wear.tool_load(body).expect("a tool");
            assert!(load.force().z > 0.0 && rig.wear.in_contact(body), "{load:?}");
        }
        let worn = rig.wear[rig.plate].wear_volume() / wear - 1.0;
        assert!(worn.abs() < 1e-5, "{led:?} {worn:e}");
        assert!(rig.wear.counters().steps - before < 30);
        let go_on = |rig: &mut Rig, to: Vector3<f64>| match led {
            Led::ByVelocity => {
                rig.world.bodies[body].set_linvel(Vector::X * n(SPEED), true);
            }
            Led::ByPosition => aim(rig, body, to),
        };
        go_on(&mut rig, at + Vector3::x() * 5e-3);
        rig.step();
        assert!(rig.wear[rig.plate].wear_volume() > 1.05 * wear);
        rig.world.bodies[body].set_position(Pose::from_translation(Vector::splat(3.0)), true);
        rig.step();
        assert!(matches!(rig.wear.events(), [WearEvent::Ended { .. }]), "{:?}", rig.wear.events());
        assert!(!rig.wear.in_encounter(body));
        // Into the plate: nobody can tell how it came there.
        let inside = Vector::new(n(5e-3), n(3e-3), n(RADIUS - 4.0 * DEPTH));
        rig.world.bodies[body].set_position(Pose::from_translation(inside), true);
        rig.step();
        let is_inside =
            |e: &WearEvent| matches!(e, WearEvent::NotResolved { reason: Refusal::Inside, .. });
        assert!(rig.wear.events().iter().any(is_inside), "{:?}", rig.wear.events());
    }
}

/// Fails for a tool that is led on once it is free: it strikes the plate, and rebounds.
#[test]
fn a_tool_that_is_let_go_is_a_body_like_others() {
    let mut rig = Rig::new(Vector3::zeros(), 1.0 / 60.0);
    let at = Vector3::z() * (RADIUS + 1e-3);
    let body = tool(&mut rig, Led::ByVelocity, at, -Vector3::z() * 20.0);
    rig.world.bodies[body].set_body_type(RigidBodyType::Dynamic, true);
    rig.step();
    let state = rig.state(body);
    assert!(state.velocity.z > 0.0 && state.position.z > RADIUS, "{state:?}");
    assert_eq!(rig.wear.counters().micro, 1);
    assert!(rig.wear[rig.plate].wear_volume() > 0.0);
}

/// Fails for a tool that is taken through the plate, a panic, and a world that stands still
/// afterwards.
#[test]
fn a_tool_deeper_than_itself_is_an_error_and_the_world_goes_on() {
    let mut rig = Rig::new(Vector3::zeros(), 1.0 / 60.0);
    let body = tool(&mut rig, Led::ByVelocity, Vector3::z() * 5e-3, -Vector3::z() * 0.3);
    let mut failed = 0;
    for _ in 0..4 {
        match rig.wear.step(&mut rig.world, &(), &()) {
            Ok(_) => {}
            Err(WearError::Physics { source: PhysicsError::Engulfed { .. }, .. }) => failed += 1,
            Err(error) => panic!("{error}"),
        }
    }
    assert_eq!(failed, 1);
    let z = scalar::wide(rig.world.bodies[body].translation().z);
    assert!((z + 0.015).abs() < 1e-3, "{z}");
    assert!(rig.wear[rig.plate].wear_volume() > 0.0);
}

/// Fails for a tool that jumps over the plate, and for steps that go by the time of the step.
#[test]
fn a_tool_at_100_m_per_s_cuts_the_same_groove() {
    let wear = [SPEED, 100.0].map(|speed| {
        let dt = WAY / speed;
        let mut rig = Rig::new(Vector3::zeros(), dt);
        plough(&mut rig, Led::ByVelocity, [speed, dt], |_, _| {});
        println!("{:?}", rig.wear.counters());
        rig.wear[rig.plate].wear_volume()
    });
    let miss = wear[1] / wear[0] - 1.0;
    println!("{miss:e}");
    assert!(miss.abs() < 1e-5, "{miss:e}");
}

/// Fails for contacts that begin anew, inside, where a tool comes to a second surface.
#[test]
fn a_groove_goes_on_over_a_seam() {
    let mut rig = Rig::new(Vector3::zeros(), 1.0 / 60.0);
    let half = [15e-3, 6e-3, HALF_THICKNESS].map(n);
    let next = ColliderBuilder::cuboid(half[0], half[1], half[2]).translation(Vector::new(
        n(-30e-3),
        n(0.0),
        n(-HALF_THICKNESS),
    ));
    let next = rig.world.colliders.insert(next);
    let next = rig.wear.insert_on_top(surface(), next, &mut rig.world.colliders).expect("a proxy");
    let from = beside() - Vector3::x() * 30e-3;
    tool(&mut rig, Led::ByVelocity, from, Vector3::x() * SPEED);
    let mut events = Vec::new();
    for _ in 0..15 {
        rig.step();
        events.extend(rig.wear.events().to_vec());
    }
    let started = |id: SurfaceId| {
        let is = |e: &&WearEvent| matches!(e, WearEvent::Started { surface, .. } if *surface == id);
        events.iter().filter(is).count()
    };
    assert_eq!([started(next), started(rig.plate)], [1, 1], "{events:?}");
    assert!(!events.iter().any(|e| matches!(e, WearEvent::NotResolved { .. })), "{events:?}");
    let miss = rig.wear[next].wear_volume() / rig.wear[rig.plate].wear_volume() - 1.0;
    println!("the first of two plates wore more by {miss:.1e}");
    assert!(miss.abs() < 1e-5);
}

const EDGE: f64 = 0.02;

/// A wearing cube, its top at z = 0.
fn workpiece(rig: &mut Rig, body: RigidBodyBuilder) -> (RigidBodyHandle, SurfaceId) {
    let material = Material {
        hardness: 1e8,
        shear_ratio: 0.25,
        young: Some(5e9),
        poisson: 0.3,
        friction: 0.3,
    };
    let mesh = TriangleMesh::cuboid(Vector3::repeat(0.5 * EDGE), 1e-3).expect("a cube");
    let surface = Surface::mesh(&mesh, SurfaceLaws::of(material)).expect("a surface");
    let half = n(0.5 * EDGE);
    let body = body.translation(Vector::Z * -half);
    let proxy = ColliderBuilder::cuboid(half, half, half).density(n(DENSITY));
    let (body, proxy) = rig.world.insert(body, proxy);
    let id = rig.wear.insert(surface, proxy, &mut rig.world.colliders).expect("a proxy");
    (body, id)
}

/// Without the plate. What is renewed loses the momentum of what has worn off.
fn empty(dt: f64) -> Rig {
    let mut rig = Rig::new(Vector3::zeros(), dt);
    rig.world.colliders[rig.proxy].set_enabled(false);
    rig.wear = WearWorld::new(WearSettings { renew: false, ..WearSettings::default() });
    rig
}

/// Fails for a tool that is led against something else than what it sees: the same groove in a solid
/// that stands, and in one that is led over a tool that stands.
#[test]
fn a_groove_in_a_solid_is_the_same_whoever_is_led() {
    let speed = Vector3::new(0.5, 0.0, 0.0);
    let at = Vector3::new(-0.5 * EDGE - RADIUS, 1e-4, RADIUS - 0.4e-3);
    let wear = [0.0, 1.0].map(|share| {
        let mut rig = empty(1e-3);
        let body = RigidBodyBuilder::kinematic_velocity_based();
        let body = body.linvel(scalar::to_vector(&(-speed * share)));
        let (_, id) = workpiece(&mut rig, body);
        let tool = tool(&mut rig, Led::ByVelocity, at, speed * (1.0 - share));
        for _ in 0..20 {
            rig.step();
            let load = rig.wear.tool_load(tool).expect("a tool");
            assert!(load.impulse.x <= 0.0, "{load:?}");
        }
        assert!(rig.wear.in_contact(tool));
        rig.wear[id].wear_volume()
    });
    let miss = wear[1] / wear[0] - 1.0;
    println!("{wear:?} {miss:e}");
    assert!(wear[0] > 1e-9 && miss.abs() < 1e-4, "{wear:?} {miss:e}");
}

/// Fails for a workpiece that Rapier pushes once more, that the tool does not feel, or that wears
/// nothing.
#[test]
fn a_tool_pushes_a_free_workpiece_and_wears_it() {
    for dt in [1.0 / 60.0, 1e-3] {
        let mut rig = empty(dt);
        let (body, id) = workpiece(&mut rig, RigidBodyBuilder::dynamic());
        let at = Vector3::new(1e-3, 0.5e-3, RADIUS + 1e-3);
        let tool = tool(&mut rig, Led::ByVelocity, at, Vector3::new(0.5, 0.0, -4.0));
        let mut impulse = Vector3::zeros();
        for _ in 0..(4.0 / 60.0 / dt).round() as u32 {
            rig.step();
            impulse += rig.wear.tool_load(tool).expect("a tool").impulse;
            let left = |e: &WearEvent| matches!(e, WearEvent::NotResolved { .. });
            assert!(!rig.wear.events().iter().any(left), "{:?}", rig.wear.events());
        }
        let state = rig.wear.state(body, &rig.world.bodies).expect("the workpiece");
        let mass = scalar::wide(rig.world.bodies[body].mass());
        let miss = (state.velocity * mass + impulse).norm() / impulse.norm();
        let wear = rig.wear[id].wear_volume();
        println!("dt {dt:.1e}: {:?}, p {miss:.1e}, W {wear:e}", state.velocity);
        assert!(wear > 0.0 && state.velocity.z < -4.0, "{state:?}");
        assert!(miss < 1e-5, "{miss:e}");
        assert_eq!(rig.wear.counters().collision, 0);
    }
}

/// A dynamic workpiece on a floor.
fn lying() -> (Rig, RigidBodyHandle, SurfaceId) {
    let mut rig = empty(1.0 / 240.0);
    let (body, id) = workpiece(&mut rig, RigidBodyBuilder::dynamic());
    let floor = ColliderBuilder::cuboid(n(0.1), n(0.1), n(0.01));
    rig.world.colliders.insert(floor.translation(Vector::Z * n(-EDGE - 0.01)));
    (rig, body, id)
}

/// Fails for a workpiece whose step is counted once for every tool at it.
#[test]
fn a_workpiece_between_two_tools_is_left_to_collision_once_a_step() {
    let (mut rig, ..) = lying();
    for x in [-5e-3, 5e-3] {
        let at = Vector3::new(x, 0.5e-3, RADIUS + 0.1e-3);
        tool(&mut rig, Led::ByVelocity, at, Vector3::new(0.0, 0.0, -0.3));
    }
    for step in 1..=2 {
        rig.step();
        let reasons = rig.wear.reasons().filter(|(by, ..)| *by == Resolver::Collision);
        assert_eq!(reasons.map(|(.., count)| count).sum::<u64>(), step);
    }
}

/// Fails for a workpiece that is driven through what it lies on, or that nobody takes care of.
#[test]
fn a_workpiece_that_lies_on_something_is_left_to_collision() {
    let (mut rig, body, id) = lying();
    let at = Vector3::new(1e-3, 0.5e-3, RADIUS + 0.1e-3);
    let tool = tool(&mut rig, Led::ByVelocity, at, Vector3::new(0.0, 0.0, -0.3));
    let (mut handed, mut impulse) = (false, 0.0f64);
    for _ in 0..2 {
        rig.step();
        impulse = impulse.max(rig.wear.tool_load(tool).expect("a tool").impulse.z);
        handed |= rig.wear.events().iter().any(|event| {
            let (by, reason) = match event {
                WearEvent::Resolved { body: of, by, reason } if *of == body => (by, reason),
                _ => return false,
            };
            *by == Resolver::Collision && matches!(reason, Some(Refusal::Obstructed { .. }))
        });
    }
    let z = scalar::wide(rig.world.bodies[body].translation().z);
    println!("{:?}, W {:e}, {impulse}", rig.wear.counters(), rig.wear[id].wear_volume());
    assert!(handed && impulse > 0.0);
    assert!(z > -0.5 * EDGE - 2e-3, "{z}");
}

/// Fails for an event that does not tell what a tool has worn in the step in which its contact failed.
#[test]
fn the_end_of_a_cut_that_fails_tells_what_it_wore() {
    let mut rig = Rig::limited(200, 1e-3);
    tool(&mut rig, Led::ByVelocity, beside(), Vector3::x() * 10.0 * SPEED);
    let fails = (0..10).any(|_| rig.wear.step(&mut rig.world, &(), &()).is_err());
    assert!(fails, "two hundred steps are too few");
    rig.assert_that_failure_tells_wear();
}
