//! Wearing bodies among each other: blows as collisions of two.

use crate::plugin::abrade::{
    Body, Carrier, Encounter, EncounterSettings, Hull, Inertia, Loads, Material, Placed, Shape,
    Skin, State, Surface, SurfaceLaws, TriangleMesh, Until, cuboid_vertices,
};
use crate::plugin::rapier::prelude::*;
use crate::plugin::{SurfaceId, WearSettings, WearWorld, scalar};
use nalgebra::{Isometry3, Point3, Vector3};

const RADIUS: f64 = 0.01;
const DENSITY: f64 = 2000.0;
const HARDNESS: f64 = 1e6;

fn ball() -> Surface {
    ball_of(HARDNESS)
}

fn ball_of(hardness: f64) -> Surface {
    let material =
        Material { hardness, shear_ratio: 0.25, young: Some(1e8), poisson: 0.3, friction: 0.3 };
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
        self.add_of(HARDNESS, x, speed);
    }

    fn add_of(&mut self, hardness: f64, x: f64, speed: Option<f64>) {
        let n = scalar::narrow;
        let builder = match speed {
            Some(speed) => RigidBodyBuilder::dynamic().linvel(Vector::X * n(speed)),
            None => RigidBodyBuilder::fixed(),
        };
        let proxy = ColliderBuilder::ball(n(RADIUS)).density(n(DENSITY)).friction(n(0.0));
        let (body, proxy) = self.world.insert(builder.translation(Vector::X * n(x)), proxy);
        let id = self.wear.insert(ball_of(hardness), proxy, &mut self.world.colliders);
        let id = id.expect("a proxy");
        self.balls.push((body, id));
    }

    /// A ball beside ball `of`, which goes along with it, and at `aside` [m/s] with it along y.
    fn add_beside(&mut self, of: usize, aside: f64) {
        let n = scalar::narrow;
        let at = self.world.bodies[self.balls[of].0].translation();
        let speed = self.world.bodies[self.balls[of].0].linvel();
        self.add(scalar::wide(at.x), Some(scalar::wide(speed.x)));
        let beside = &mut self.world.bodies[self.balls.last().expect("a ball").0];
        beside.set_translation(Vector::new(at.x, at.y + n(2.02 * RADIUS), at.z), true);
        beside.set_linvel(Vector::new(speed.x, n(aside), 0.0), true);
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

/// Two balls that come together in the core.
struct Meeting {
    hardness: [f64; 2],
    /// Speed of approach, and of the first along y [m/s].
    speed: f64,
    aside: f64,
    /// None of them turns.
    locked: bool,
}

impl Meeting {
    /// Volumes that they lose.
    fn volumes(&self) -> [f64; 2] {
        let mut inertia = Inertia::of_ball(RADIUS, DENSITY);
        if self.locked {
            inertia.tensor *= 1e9;
        }
        let at = |x: f64, v: f64| State {
            velocity: Vector3::x() * v,
            ..State::at(Point3::new(x * RADIUS, 0.0, 0.0))
        };
        let shape = Shape::ball(RADIUS).expect("a ball");
        let mut state = at(-1.001, 0.5 * self.speed);
        state.velocity.y = self.aside;
        let mut body = Body { shape, inertia, state, rotation_locked: false };
        let [mut own, mut other] = self.hardness.map(ball_of);
        let skin = Skin { surface: &mut own, pose: Isometry3::identity() };
        let settings = EncounterSettings::default();
        let mut encounter =
            Encounter::of_two(&body, &skin, &other, settings).expect("an encounter");
        let state = at(1.001, -0.5 * self.speed);
        let loads = Loads::default();
        let carrier = Some(Carrier { state, inertia: Some(inertia), loads });
        let pose = state.pose();
        let mut placed = [Placed { surface: &mut other, pose, carrier, skin: Some(skin) }];
        let until = Until::FirstExit;
        encounter.advance(&mut body, &mut placed, &loads, 1.0, until, &mut ()).expect("a contact");
        [own, other].map(|surface| surface.worn().displaced())
    }
}

/// Volume that two balls lose that come together at `speed` [m/s], in the core.
fn reference(speed: f64) -> f64 {
    let hardness = [HARDNESS; 2];
    Meeting { hardness, speed, aside: 0.0, locked: false }.volumes().iter().sum()
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

/// Fails for a blow of two of which both wear, whichever comes first, or the harder one.
#[test]
fn the_softer_of_two_wears_in_a_crowd() {
    for hardness in [[HARDNESS, 4.0 * HARDNESS], [4.0 * HARDNESS, HARDNESS]] {
        let core = Meeting { hardness, speed: 1.0, aside: 0.0, locked: false }.volumes();
        let mut rig = Rig::new(1.0 / 240.0);
        rig.add_of(hardness[0], -0.021, Some(0.5));
        rig.add_of(hardness[1], 0.021, Some(-0.5));
        rig.add_beside(0, 0.0);
        rig.run(0.1);
        let volumes = rig.volumes();
        println!("{volumes:?}, in the core {core:?}");
        let soft = if hardness[0] < hardness[1] { 0 } else { 1 };
        assert!(volumes[1 - soft] == 0.0 && core[1 - soft] == 0.0);
        assert!((volumes[soft] / core[soft] - 1.0).abs() < 5e-3);
        assert_eq!(rig.wear.counters().collision, 1);
    }
}

/// Fails for a striker that flies on from where the step has left it, beside the place of the blow.
#[test]
fn a_blow_that_slides_wears_nearly_as_in_the_core() {
    let (aside, dt) = (0.6, 1.0 / 240.0);
    let hardness = [HARDNESS; 2];
    let core: f64 = Meeting { hardness, speed: 1.0, aside, locked: true }.volumes().iter().sum();
    let mut rig = Rig::new(dt);
    rig.add(-0.021, Some(0.5));
    rig.add(0.021, Some(-0.5));
    rig.add_beside(0, aside);
    // It meets the other where that is.
    let n = scalar::narrow;
    let time = (0.042 - 2.0 * RADIUS) / 1.0;
    let first = &mut rig.world.bodies[rig.balls[0].0];
    first.set_translation(Vector::new(n(-0.021), n(-aside * time), n(0.0)), true);
    first.set_linvel(Vector::new(n(0.5), n(aside), n(0.0)), true);
    rig.run(0.1);
    let ratio = (rig.volumes()[0] + rig.volumes()[1]) / core;
    println!("{ratio:.4} of the core");
    // Rapier meets them up to a step too early, where they approach more slowly: 0.93^2.
    assert!(ratio > 0.8 && ratio < 1.0, "{ratio}");
    assert_eq!(rig.wear.counters().collision, 1);
}

/// Volume that a ball loses that strikes a wall which moves at `speed` [m/s] against it, in the core.
fn reference_of_wall(speed: f64) -> f64 {
    let half = Vector3::repeat(0.5);
    let (hull, _, _) = Hull::solid(&cuboid_vertices(&half), 1.0).expect("a wall");
    let shape = Shape::hull(hull);
    let state = State::at(Point3::new(0.5, 0.0, 0.0));
    let mut wall = Body { shape, inertia: Inertia::immovable(), state, rotation_locked: true };
    let mut surface = ball();
    let at = State::at(Point3::new(-1.001 * RADIUS, 0.0, 0.0));
    let state = State { velocity: Vector3::x() * speed, ..at };
    let inertia = Some(Inertia::of_ball(RADIUS, DENSITY));
    let loads = Loads::default();
    let settings = EncounterSettings::default();
    let mut encounter = Encounter::new(&wall, [&surface], settings).expect("an encounter");
    let carrier = Some(Carrier { state, inertia, loads });
    let mut placed = [Placed { surface: &mut surface, pose: state.pose(), carrier, skin: None }];
    encounter
        .advance(&mut wall, &mut placed, &loads, 0.01, Until::Duration, &mut ())
        .expect("a blow");
    surface.worn().displaced()
}

/// Fails for a wall that does not wear what strikes it among others, and for a speed over the ground
/// where the wall moves.
#[test]
fn a_blow_on_a_wall_wears_as_in_the_core() {
    for (led, speed) in [(0.0, 1.0), (-0.6, 0.4)] {
        let core = reference_of_wall(1.0);
        for dt in [1.0 / 240.0, 1e-3] {
            let n = scalar::narrow;
            let mut rig = Rig::new(dt);
            rig.add(-0.021, Some(speed));
            rig.add_beside(0, 0.0);
            let body = RigidBodyBuilder::kinematic_velocity_based().linvel(Vector::X * n(led));
            let body = if led == 0.0 { RigidBodyBuilder::fixed() } else { body };
            let wall = ColliderBuilder::cuboid(n(0.5), n(0.5), n(0.5)).friction(n(0.0));
            rig.world.insert(body.translation(Vector::X * n(0.5)), wall);
            rig.run(0.05);
            let (volumes, counters) = (rig.volumes(), rig.wear.counters());
            println!("{led} {dt:.4}: {volumes:?}, in the core {core:e}, {counters:?}");
            assert!(volumes.iter().all(|volume| (volume / core - 1.0).abs() < 5e-3));
            assert_eq!(counters.collision, 2);
        }
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
