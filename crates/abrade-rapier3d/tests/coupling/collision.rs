//! Wearing bodies among each other: blows as collisions of two.

use crate::plugin::abrade::{
    Body, Carrier, Encounter, EncounterSettings, Inertia, Loads, Material, Placed, Shape, Skin,
    State, Surface, SurfaceLaws, TriangleMesh, Until,
};
use crate::plugin::rapier::prelude::*;
use crate::plugin::{SurfaceId, WearSettings, WearWorld, scalar};
use nalgebra::{Isometry3, Point3, Vector3};

const RADIUS: f64 = 0.01;
const DENSITY: f64 = 2000.0;
const HARDNESS: f64 = 1e6;

fn ball() -> Surface {
    let material = Material {
        hardness: HARDNESS,
        shear_ratio: 0.25,
        young: Some(1e8),
        poisson: 0.3,
        friction: 0.3,
    };
    let mesh = TriangleMesh::sphere(RADIUS, RADIUS / 12.0).expect("a sphere");
    Surface::mesh(&mesh, SurfaceLaws::of(material)).expect("a surface")
}

/// Wearing balls in a world without gravity.
struct Rig {
    world: PhysicsWorld,
    wear: WearWorld,
    balls: Vec<(RigidBodyHandle, SurfaceId)>,
}

impl Rig {
    fn new(dt: f64) -> Self {
        let n = scalar::narrow;
        let mut world = PhysicsWorld { gravity: Vector::ZERO, ..PhysicsWorld::default() };
        world.integration_parameters.dt = n(dt);
        world.integration_parameters.length_unit = n(RADIUS);
        world.integration_parameters.normalized_max_linear_velocity = n(1e6);
        let wear = WearWorld::new(WearSettings { ledger: true, ..WearSettings::default() });
        Self { world, wear, balls: Vec::new() }
    }

    /// A ball at `x` [m] that moves along x at `speed` [m/s]; fixed without one.
    fn add(&mut self, x: f64, speed: Option<f64>) {
        let n = scalar::narrow;
        let builder = match speed {
            Some(speed) => RigidBodyBuilder::dynamic().linvel(Vector::X * n(speed)),
            None => RigidBodyBuilder::fixed(),
        };
        let proxy = ColliderBuilder::ball(n(RADIUS)).density(n(DENSITY)).friction(n(0.0));
        let (body, proxy) = self.world.insert(builder.translation(Vector::X * n(x)), proxy);
        let id = self.wear.insert(ball(), proxy, &mut self.world.colliders).expect("a proxy");
        self.balls.push((body, id));
    }

    fn run(&mut self, time: f64) {
        let steps = time / scalar::wide(self.world.integration_parameters.dt);
        for _ in 0..steps.ceil() as u32 {
            self.wear.step(&mut self.world, &(), &()).expect("a step inside the model");
        }
    }

    fn volumes(&self) -> Vec<f64> {
        self.balls.iter().map(|(_, id)| self.wear[*id].worn().displaced()).collect()
    }
}

/// Volume that two balls lose that come together at `speed` [m/s], in the core.
fn reference(speed: f64) -> f64 {
    let inertia = Inertia::of_ball(RADIUS, DENSITY);
    let at = |x: f64, v: f64| State {
        velocity: Vector3::x() * v,
        ..State::at(Point3::new(x * RADIUS, 0.0, 0.0))
    };
    let shape = Shape::ball(RADIUS).expect("a ball");
    let state = at(-1.001, 0.5 * speed);
    let mut body = Body { shape, inertia, state, rotation_locked: false };
    let [mut own, mut other] = [ball(), ball()];
    let skin = Skin { surface: &mut own, pose: Isometry3::identity() };
    let settings = EncounterSettings::default();
    let mut encounter = Encounter::of_two(&body, &skin, &other, settings).expect("an encounter");
    let state = at(1.001, -0.5 * speed);
    let loads = Loads::default();
    let carrier = Some(Carrier { state, inertia: Some(inertia), loads });
    let pose = state.pose();
    let mut placed = [Placed { surface: &mut other, pose, carrier, skin: Some(skin) }];
    let until = Until::FirstExit;
    encounter.advance(&mut body, &mut placed, &loads, 1.0, until, &mut ()).expect("a contact");
    own.worn().displaced() + other.worn().displaced()
}

/// Two balls that come together at `speed` [m/s], with another beside the first on its way, or alone.
fn pair(dt: f64, speed: f64, alone: bool) -> Rig {
    let mut rig = Rig::new(dt);
    rig.add(-0.021, Some(0.5 * speed));
    rig.add(0.021, Some(-0.5 * speed));
    if !alone {
        rig.add(-0.021, Some(0.5 * speed));
        let beside = &mut rig.world.bodies[rig.balls[2].0];
        beside.set_translation(
            Vector::new(scalar::narrow(-0.021), scalar::narrow(0.0202), 0.0),
            true,
        );
    }
    rig.run(0.1);
    rig
}

/// Fails for two that wear one after the other, or one alone, and for a pair that is not carried
/// through the step together.
#[test]
fn two_balls_on_their_own_wear_each_other_as_in_the_core() {
    let wanted = reference(1.0);
    for dt in [1.0 / 60.0, 1.0 / 240.0, 1e-3] {
        let rig = pair(dt, 1.0, true);
        let (volumes, counters) = (rig.volumes(), rig.wear.counters());
        let whole = (volumes[0] + volumes[1]) / wanted - 1.0;
        println!("{dt:.4}: {volumes:?}, of the reference {whole:.1e}, {counters:?}");
        assert!((volumes[0] / volumes[1] - 1.0).abs() < 1e-9 && whole.abs() < 2e-3);
        assert!(counters.micro > 0 && counters.collision == 0 && counters.refused == 0);
    }
}

/// Fails for blows of a part of the impulse, for wear of one of two, and for wear that depends on
/// the step.
#[test]
fn two_balls_that_collide_wear_as_in_the_core() {
    let wanted = reference(1.0);
    for dt in [1.0 / 60.0, 1.0 / 240.0, 1e-3] {
        let rig = pair(dt, 1.0, false);
        let (volumes, counters) = (rig.volumes(), rig.wear.counters());
        let whole = (volumes[0] + volumes[1]) / wanted - 1.0;
        println!("{dt:.4}: {volumes:?}, of the reference {whole:.1e}, {counters:?}");
        assert!((volumes[0] / volumes[1] - 1.0).abs() < 1e-9 && volumes[2] == 0.0);
        assert!(whole.abs() < 5e-3, "{whole}");
        assert_eq!(counters.collision, 1);
    }
}

/// Fails for a blow that is not handed on.
#[test]
fn a_blow_is_handed_on_through_a_row() {
    let mut rig = Rig::new(1.0 / 240.0);
    rig.add(-0.05, Some(2.0));
    rig.add(0.0, Some(0.0));
    rig.add(0.02, None);
    rig.run(0.1);
    let volumes = rig.volumes();
    println!("{volumes:?} {:?}", rig.wear.counters());
    assert!(volumes[0] > 0.0 && volumes[2] > 0.0);
    assert!(volumes[1] > volumes[0]);
    let mass = Inertia::of_ball(RADIUS, DENSITY).mass;
    assert!(HARDNESS * volumes.iter().sum::<f64>() < 0.5 * mass * 2.0 * 2.0, "no more than came");
}

/// Fails for laws that two surfaces cannot have between them, and end the run.
#[test]
fn surfaces_that_cannot_meet_wear_one_of_two() {
    let mut rig = Rig::new(1e-3);
    rig.add(-0.021, Some(1.0));
    rig.add(0.0, Some(0.0));
    let damped = |surface: Surface| {
        let laws = SurfaceLaws { restitution: 0.5, ..surface.laws().clone() };
        let mesh = TriangleMesh::sphere(RADIUS, RADIUS / 12.0).expect("a sphere");
        Surface::mesh(&mesh, laws).expect("a surface")
    };
    let n = scalar::narrow;
    let proxy = ColliderBuilder::ball(n(RADIUS)).density(n(DENSITY));
    let body =
        RigidBodyBuilder::dynamic().translation(Vector::X * n(0.021)).linvel(Vector::X * n(-1.0));
    let (body, proxy) = rig.world.insert(body, proxy);
    let id = rig.wear.insert(damped(ball()), proxy, &mut rig.world.colliders).expect("a proxy");
    rig.balls.push((body, id));
    rig.run(0.05);
    let volumes = rig.volumes();
    println!("{volumes:?} {:?}", rig.wear.counters());
    assert!(volumes[0] > 0.0 && volumes.iter().sum::<f64>() > volumes[0]);
    assert_eq!(rig.wear.counters().refused, 0);
}

/// Fails for wear by what only lies on something.
#[test]
fn what_lies_still_wears_nothing() {
    let mut rig = Rig::new(1.0 / 240.0);
    rig.world.gravity = Vector::X * scalar::narrow(-9.81);
    rig.add(0.0, None);
    for at in 1..5 {
        rig.add(f64::from(at) * 0.02, Some(0.0));
    }
    rig.run(1.0);
    assert_eq!(rig.volumes(), vec![0.0; 5]);
}
