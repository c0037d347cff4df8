//! The island against the core's own integrator, which shares nothing with Rapier's solver.

use abrade::{
    Ball, Body, Encounter, EncounterSettings, HexStrip, Inertia, Loads, Material, PhysicsError,
    Piece, Placed, Shape, State, Surface, SurfaceLaws, Until, cuboid_vertices,
};
use abrade_lockstep::rapier::prelude::*;
use abrade_lockstep::{Island, IslandSettings, Proxy, Wearer, to_pose, to_vector};
use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3};

const FREE: IslandSettings =
    IslandSettings { step_limit: 1_000_000, budget: u64::MAX, rest_speed: 0.0 };

fn plate(pitch: f64) -> Surface {
    plate_of(6.6e9, pitch)
}

fn plate_of(hardness: f64, pitch: f64) -> Surface {
    let material = Material {
        hardness,
        shear_ratio: 0.25,
        young: Some(200e9 / 6.6e9 * hardness),
        poisson: 0.3,
        friction: 0.5,
    };
    let strip = HexStrip { length: 30e-3, width: 12e-3, pitch, rest_area: None };
    Surface::hex_strip(strip, SurfaceLaws::of(material)).expect("a plate")
}

fn fired(body: &mut Body, speed: f64, angle: f64) {
    let (sin, cos) = f64::to_radians(angle).sin_cos();
    body.state.velocity = Vector3::new(speed * cos, 0.0, -speed * sin);
}

fn ball() -> Body {
    let (radius, density) = (3e-3, 2500.0);
    let mut body = Body {
        shape: Shape::ball(radius).expect("a ball"),
        inertia: Inertia::of_ball(radius, density),
        state: State::at(Point3::new(0.0, 0.0, radius + 1e-6)),
        rotation_locked: false,
    };
    fired(&mut body, 35.0, 45.0);
    body
}

/// Two balls, 8 mm apart, tilted: what a fixed joint makes of them.
fn dumbbell() -> Body {
    let radius = 3e-3;
    let balls = [-4e-3, 4e-3].map(|x| Ball { centre: Point3::new(x, 0.0, 0.0), radius });
    let one = Inertia::of_ball(radius, 2500.0);
    let mut tensor = one.tensor * 2.0;
    tensor[(1, 1)] += 2.0 * one.mass * 16e-6;
    tensor[(2, 2)] += 2.0 * one.mass * 16e-6;
    let mut state = State::at(Point3::new(0.0, 0.0, 8e-3));
    state.rotation = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.5);
    let lowest = radius + 4e-3 * 0.5f64.sin();
    state.position.z = lowest + 1e-6;
    let shape = Shape::union(balls.map(Piece::Ball).to_vec()).expect("balls");
    let inertia = Inertia { mass: 2.0 * one.mass, tensor };
    let mut body = Body { shape, inertia, state, rotation_locked: false };
    fired(&mut body, 20.0, 70.0);
    body
}

fn by_core(body: &Body, pitch: f64) -> (State, f64) {
    let (mut body, mut surface) = (body.clone(), plate(pitch));
    let settings = EncounterSettings { accuracy: 1e-4, ..EncounterSettings::default() };
    let mut encounter = Encounter::new(&body, [&surface], settings).expect("an encounter");
    let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
    let loads = Loads::default();
    encounter
        .advance(&mut body, &mut placed, &loads, 2e-4, Until::Duration, &mut ())
        .expect("an impact");
    (body.state, surface.wear_volume())
}

fn world(plate: &mut PhysicsWorld) -> ColliderHandle {
    plate.gravity = Vector::ZERO;
    let slab =
        ColliderBuilder::cuboid(0.015, 0.006, 0.01).translation(Vector::new(0.0, 0.0, -0.01));
    plate.colliders.insert(slab)
}

fn insert(world: &mut PhysicsWorld, body: &Body) -> RigidBodyHandle {
    let Body { inertia, state, .. } = body;
    let properties = MassProperties::with_inertia_matrix(
        Vector::ZERO,
        inertia.mass,
        Matrix::from_cols_array(inertia.tensor.as_slice().try_into().expect("nine")),
    );
    let builder = RigidBodyBuilder::dynamic()
        .pose(to_pose(&state.pose()))
        .linvel(to_vector(&state.velocity))
        .angvel(to_vector(&state.spin))
        .additional_mass_properties(properties)
        .can_sleep(false);
    let handle = world.insert_body(builder);
    for piece in body.shape.pieces() {
        let collider = match piece {
            Piece::Ball(ball) => {
                ColliderBuilder::ball(ball.radius).translation(to_vector(&ball.centre.coords))
            }
            Piece::Hull(hull) => {
                let points: Vec<_> = hull.vertices().iter().map(|v| to_vector(&v.coords)).collect();
                ColliderBuilder::convex_hull(&points).expect("a hull")
            }
        };
        world.insert_collider(collider.density(0.0), Some(handle));
    }
    world.bodies[handle].set_allow_fast_rotation(true);
    handle
}

/// Takes the bodies through 0.2 ms; returns the state of the first and the wear volume.
fn by_island(
    world: PhysicsWorld,
    proxy: ColliderHandle,
    bodies: &[(RigidBodyHandle, Body)],
    pitch: f64,
    accuracy: f64,
) -> (Vector3<f64>, Vector3<f64>, f64, u64) {
    let mut surface = plate(pitch);
    let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
    let settings = EncounterSettings { accuracy, ..EncounterSettings::default() };
    let wearers: Vec<_> = bodies
        .iter()
        .map(|(h, b)| Wearer::new(*h, b.clone(), Loads::default(), &mut placed, vec![0], settings))
        .collect::<Result<_, _>>()
        .expect("wearers");
    let mut island =
        Island::new(world, wearers, vec![Proxy { collider: proxy, friction: 0.5 }], FREE);
    let done = island.advance(&mut placed, 2e-4, &mut |_, _, _| ()).expect("an impact");
    let states: Vec<State> = island.wearers().iter().map(|w| w.body.state).collect();
    let count = states.len() as f64;
    let velocity = states.iter().map(|s| s.velocity).sum::<Vector3<f64>>() / count;
    (velocity, states[0].spin, surface.wear_volume(), done.steps)
}

/// Fails for a force that lags a step, a torque about the wrong point, a step that is too long for
/// the springs.
#[test]
fn a_lone_ball_does_what_the_core_makes_of_it() {
    let (expected, volume) = by_core(&ball(), 0.1e-3);
    for (accuracy, limit) in [(1e-3, 1e-2), (1e-4, 3e-3)] {
        let mut world_ = PhysicsWorld::default();
        let proxy = world(&mut world_);
        let handle = insert(&mut world_, &ball());
        let (v, w, wear, steps) = by_island(world_, proxy, &[(handle, ball())], 0.1e-3, accuracy);
        let dv = (v - expected.velocity).norm() / 35.0;
        let dw = (w - expected.spin).norm() / expected.spin.norm();
        let miss = wear / volume - 1.0;
        println!("accuracy {accuracy}: dv {dv:.1e}, dspin {dw:.1e}, dW {miss:+.1e}, {steps} steps");
        assert!(dv < limit && dw < limit && miss.abs() < limit);
    }
}

/// Fails for surfaces that are lowered for a body in another order than it names them: where an engine
/// has left it inside one of them, that one throws it out.
#[test]
fn each_surface_is_lowered_by_its_own_overlap() {
    for uses in [vec![0, 1], vec![1, 0]] {
        let mut surfaces = [plate(0.1e-3), plate(0.1e-3)];
        let [away, below] = &mut surfaces;
        let far = Isometry3::translation(1.0, 0.0, 0.0);
        let mut placed =
            [Placed::at_rest(away, far), Placed::at_rest(below, Isometry3::identity())];
        let mut world_ = PhysicsWorld::default();
        let slab = world(&mut world_);
        let proxies = [world_.colliders.insert(ColliderBuilder::ball(1e-3)), slab];
        world_.colliders[proxies[0]].set_translation(Vector::X);
        let mut body = ball();
        body.state = State::at(Point3::new(0.0, 0.0, 3e-3 - 20e-6));
        let handle = insert(&mut world_, &body);
        let (loads, settings) = (Loads::default(), EncounterSettings::default());
        let wearer = Wearer::new(handle, body, loads, &mut placed, uses.clone(), settings);
        let proxies = proxies.map(|collider| Proxy { collider, friction: 0.5 });
        let wearers = vec![wearer.expect("a wearer")];
        let mut island = Island::new(world_, wearers, proxies.to_vec(), FREE);
        island.advance(&mut placed, 1e-5, &mut |_, _, _| ()).expect("steps");
        let wearer = &island.wearers()[0];
        let speed = wearer.body.state.velocity.norm();
        assert_eq!((speed, wearer.worn()), (0.0, &[0.0, 0.0][..]), "{uses:?}");
    }
}

/// Fails for faces whose force lags, or for an impulse taken for a force.
#[test]
fn a_lone_cube_does_what_the_core_makes_of_it() {
    let corners = cuboid_vertices(&Vector3::repeat(2e-3));
    let (hull, inertia, _) = abrade::Hull::solid(&corners, 2500.0).expect("a cube");
    let shape = Shape::union(vec![Piece::Hull(hull)]).expect("a cube");
    let mut state = State::at(Point3::new(0.0, 0.0, 4e-3));
    state.rotation = UnitQuaternion::from_euler_angles(0.6, 0.4, 0.1);
    let lowest = corners.iter().map(|c| (state.rotation * c).z).fold(0.0, f64::min);
    state.position.z = 1e-6 - lowest;
    let mut body = Body { shape, inertia, state, rotation_locked: false };
    fired(&mut body, 20.0, 60.0);
    let (expected, volume) = by_core(&body, 0.1e-3);
    let mut world_ = PhysicsWorld::default();
    let proxy = world(&mut world_);
    let handle = insert(&mut world_, &body);
    let (v, w, wear, steps) = by_island(world_, proxy, &[(handle, body)], 0.1e-3, 1e-3);
    let dv = (v - expected.velocity).norm() / 20.0;
    let dw = (w - expected.spin).norm() / expected.spin.norm();
    let miss = wear / volume - 1.0;
    println!("dv {dv:.1e}, dspin {dw:.1e}, dW {miss:+.1e}, {steps} steps");
    assert!(dv < 1e-2 && dw < 2e-2 && miss.abs() < 1e-2);
}

/// Fails for a joint that gives way under an impact, or kicks.
#[test]
fn a_jointed_dumbbell_is_one_body() {
    let whole = dumbbell();
    let (expected, volume) = by_core(&whole, 0.1e-3);
    let mut world_ = PhysicsWorld::default();
    let proxy = world(&mut world_);
    let mut parts = Vec::new();
    for piece in whole.shape.pieces() {
        let Piece::Ball(at) = piece else { continue };
        let mut part = ball();
        part.state = whole.state;
        part.state.position = whole.state.pose() * at.centre;
        parts.push((insert(&mut world_, &part), part, at.centre));
    }
    let anchors = parts.iter().map(|(_, _, c)| to_vector(&-c.coords)).collect::<Vec<_>>();
    let joint = FixedJointBuilder::new()
        .local_anchor1(anchors[0])
        .local_anchor2(anchors[1])
        .contacts_enabled(false);
    world_.insert_impulse_joint(parts[0].0, parts[1].0, joint);
    let bodies: Vec<_> = parts.into_iter().map(|(h, b, _)| (h, b)).collect();
    let (v, w, wear, steps) = by_island(world_, proxy, &bodies, 0.1e-3, 1e-3);
    let dv = (v - expected.velocity).norm() / 20.0;
    let dw = (w - expected.spin).norm() / expected.spin.norm();
    let miss = wear / volume - 1.0;
    println!("dv {dv:.1e}, dspin {dw:.1e}, dW {miss:+.1e}, {steps} steps");
    assert!(dv < 1e-2 && dw < 1e-2 && miss.abs() < 1e-2);
}

/// A light cube, slow enough to rest: one edge is beyond the plate's nodes and 10 um below them, the
/// other comes down on them; and a heavy ball that strikes it after it has.
fn leaning_and_struck() -> [Body; 2] {
    let corners = cuboid_vertices(&Vector3::repeat(2e-3));
    let (hull, inertia, _) = abrade::Hull::solid(&corners, 300.0).expect("a cube");
    let shape = Shape::union(vec![Piece::Hull(hull)]).expect("a cube");
    let mut state = State::at(Point3::new(15e-3, 0.0, 2.01e-3));
    state.rotation = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.01);
    (state.velocity.z, state.spin.y) = (-0.025, -12.5);
    let cube = Body { shape, inertia, state, rotation_locked: false };
    let mut heavy = ball();
    heavy.inertia = Inertia::of_ball(3e-3, 8000.0);
    heavy.state = State::at(Point3::new(14e-3, 0.0, 7.6e-3));
    heavy.state.velocity.z = -0.3;
    [cube, heavy]
}

/// Fails for springs that push a body out of where it has come to while it rested, and for a first
/// step that is too long for them.
#[test]
fn a_body_struck_at_rest_gets_no_energy_from_where_it_has_come_to() {
    let bodies = leaning_and_struck();
    let mut world_ = PhysicsWorld::default();
    let proxy = world(&mut world_);
    world_.colliders[proxy].set_shape(SharedShape::cuboid(0.03, 0.006, 0.01));
    let handles = [0, 1].map(|i| insert(&mut world_, &bodies[i]));
    let mut surface = plate(0.5e-3);
    let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
    let settings = EncounterSettings { accuracy: 1e-2, ..EncounterSettings::default() };
    let [cube, _] = bodies;
    let cube = Wearer::new(handles[0], cube, Loads::default(), &mut placed, vec![0], settings);
    let proxies = vec![Proxy { collider: proxy, friction: 0.5 }];
    let resting = IslandSettings { rest_speed: 0.2, ..FREE };
    let mut island = Island::new(world_, vec![cube.expect("a wearer")], proxies, resting);
    let [start, _] = island.energies();
    let (mut most, mut rested, mut woke): (f64, _, _) = (0.0, false, false);
    let mut watch = |island: &Island, _: f64, _: &[Placed<'_>]| {
        let rests = island.wearers()[0].rests();
        rested |= rests;
        woke |= rested && !rests;
        most = most.max(island.energies()[0] / start);
    };
    let done = island.advance(&mut placed, 4e-3, &mut watch).expect("a blow");
    println!("energy at most {most} of what it was, {} steps", done.steps);
    assert!(rested && woke && most < 1.0 + 1e-3);
}

/// Fails for an island that ends where one of its bodies is outside the model, for a body that a
/// heavy one drives on through a contact, and for a blow's impulses taken for those of the next step.
#[test]
fn a_ball_that_is_driven_in_too_deep_stops_with_what_drives_it() {
    let mut light = ball();
    fired(&mut light, 20.0, 90.0);
    let mut heavy = light.clone();
    heavy.inertia = Inertia::of_ball(3e-3, 1e6);
    heavy.state.position.z += 10e-3;
    let mut world_ = PhysicsWorld::default();
    let proxy = world(&mut world_);
    let handles = [&light, &heavy].map(|body| insert(&mut world_, body));
    let joint = FixedJointBuilder::new().local_anchor1(Vector::new(0.0, 0.0, 10e-3));
    world_.insert_impulse_joint(handles[0], handles[1], joint);
    let mut surface = plate_of(1e6, 0.5e-3);
    let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
    let settings = EncounterSettings { accuracy: 1e-2, ..EncounterSettings::default() };
    let light = Wearer::new(handles[0], light, Loads::default(), &mut placed, vec![0], settings);
    let proxies = vec![Proxy { collider: proxy, friction: 0.5 }];
    let mut island = Island::new(world_, vec![light.expect("a wearer")], proxies, FREE);
    let [start, _] = island.energies();
    let mut most = 0f64;
    let mut watch =
        |island: &Island, _: f64, _: &[Placed<'_>]| most = most.max(island.energies()[0] / start);
    let done = island.advance(&mut placed, 2e-3, &mut watch).expect("a blow");
    let beyond = island.wearers()[0].beyond().cloned();
    let [light, heavy] = handles.map(|handle| island.state(handle).expect("a state"));
    let arm = (heavy.position - light.position).norm();
    let speed = light.velocity.norm().max(heavy.velocity.norm());
    println!("{beyond:?}, {} m, arm {arm} m, {speed} m/s, {done:?}", light.position.z);
    assert!(matches!(beyond, Some(PhysicsError::Engulfed { .. })));
    assert!(light.position.z > -1e-4 && (arm / 10e-3 - 1.0).abs() < 1e-3);
    assert!(speed < 1e-3 * 20.0 && most < 1.0 + 1e-3);
}
