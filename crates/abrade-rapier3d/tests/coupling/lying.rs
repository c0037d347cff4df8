//! What lies, slides and rolls on closed and on moving surfaces, among other bodies.

use crate::plugin::abrade::{
    Body, Drive, DriveSolution, Driven, EncounterSettings, HexStrip, Inertia, Material, Placed,
    Shape, State, Surface, SurfaceLaws, TriangleMesh,
};
use crate::plugin::rapier::prelude::*;
use crate::plugin::{Resolver, SurfaceId, WearEvent, WearSettings, WearWorld, scalar};
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};

/// Of the ball [m].
const RADIUS: f64 = 5e-3;
/// Of the surfaces [m].
const PITCH: f64 = 0.3e-3;
const HARDNESS: f64 = 20e6;
/// That presses the ball [N].
const LOAD: f64 = 20.0;
const SPEED: f64 = 0.05;
/// Of a ball that a motor draws, and of one that stays [kg].
const LIGHT: f64 = 0.1;
const HEAVY: f64 = 10.0;
/// Of the drum [rad/s].
const SPIN: f64 = 2.0;
/// Half edges of the block [m].
const BLOCK: [f64; 3] = [15e-3, 6e-3, 4e-3];
/// Radius and length of the drum [m].
const DRUM: [f64; 2] = [20e-3, 10e-3];

fn laws(hardness: f64) -> SurfaceLaws {
    SurfaceLaws::of(Material {
        hardness,
        shear_ratio: 0.25,
        young: Some(100.0 * hardness),
        poisson: 0.3,
        friction: 0.3,
    })
}

fn block() -> Surface {
    let mesh = TriangleMesh::cuboid(Vector3::from(BLOCK), PITCH).expect("a block");
    Surface::mesh(&mesh, laws(HARDNESS)).expect("a surface")
}

fn strip() -> Surface {
    let [length, width] = [2.0 * BLOCK[0], 2.0 * BLOCK[1]];
    let strip = HexStrip { length, width, pitch: PITCH, rest_area: None };
    Surface::hex_strip(strip, laws(HARDNESS)).expect("a strip")
}

/// A ball that is pressed down on a surface.
struct Rig {
    world: PhysicsWorld,
    wear: WearWorld,
    id: SurfaceId,
    ball: RigidBodyHandle,
    load: f64,
    events: Vec<WearEvent>,
}

fn n(x: f64) -> Real {
    scalar::narrow(x)
}

fn v(x: f64, y: f64, z: f64) -> Vector {
    scalar::to_vector(&Vector3::new(x, y, z))
}

impl Rig {
    /// With a surface on `proxy`, and a ball whose lowest point is `at`.
    fn new(
        proxy: (RigidBodyBuilder, ColliderBuilder),
        surface: (Surface, Isometry3<f64>),
        at: Vector3<f64>,
        locked: LockedAxes,
        renew: bool,
        mass: f64,
        dt: f64,
    ) -> Self {
        let mut world = PhysicsWorld { gravity: Vector::ZERO, ..PhysicsWorld::default() };
        world.integration_parameters.dt = n(dt);
        world.integration_parameters.length_unit = n(RADIUS);
        let settings = WearSettings { ledger: true, renew, ..WearSettings::default() };
        let mut wear = WearWorld::new(settings);
        let (_, proxy) = world.insert(proxy.0, proxy.1.friction(n(0.3)));
        let id = wear.insert_at(surface.0, proxy, surface.1, &mut world.colliders);
        let body = RigidBodyBuilder::dynamic()
            .translation(scalar::to_vector(&(at + Vector3::z() * RADIUS)))
            .additional_mass_properties(MassProperties::new(
                Vector::ZERO,
                n(mass),
                Vector::splat(n(0.4 * mass * RADIUS * RADIUS)),
            ))
            .locked_axes(locked);
        let ball = ColliderBuilder::ball(n(RADIUS)).density(n(0.0)).friction(n(0.3));
        let (ball, _) = world.insert(body, ball);
        let (id, events) = (id.expect("a proxy"), Vec::new());
        Self { world, wear, id, ball, load: LOAD, events }
    }

    /// A block whose top is z = 0, or a plate in its place, with the ball near its one end, and a
    /// wall that the ball slides along.
    fn flat(closed: bool, mass: f64, dt: f64) -> Self {
        let [x, y, z] = BLOCK;
        let proxy = ColliderBuilder::cuboid(n(x), n(y), n(z)).translation(v(0.0, 0.0, -z));
        let top = Isometry3::from(Translation3::new(0.0, 0.0, z));
        let surface = if closed { (block(), Isometry3::identity()) } else { (strip(), top) };
        let at = Vector3::new(-0.01, 0.0, 0.0);
        let body = RigidBodyBuilder::fixed();
        let mut rig =
            Self::new((body, proxy), surface, at, LockedAxes::ROTATION_LOCKED, false, mass, dt);
        let wall = ColliderBuilder::cuboid(n(0.1), n(0.01), n(0.01)).friction(n(0.0));
        rig.world.insert_collider(wall.translation(v(0.0, RADIUS + 0.01, 0.012)), None);
        rig
    }

    /// A turning drum about y, and the ball on top of it, which stays there.
    fn drum(rolls: bool, renew: bool, dt: f64) -> Self {
        let [radius, length] = DRUM;
        let body = RigidBodyBuilder::kinematic_velocity_based().angvel(v(0.0, SPIN, 0.0));
        let proxy = ColliderBuilder::cylinder(n(0.5 * length), n(radius));
        let mesh = TriangleMesh::cylinder(radius, length, PITCH).expect("a drum");
        let surface = Surface::mesh(&mesh, laws(HARDNESS)).expect("a surface");
        let turn = UnitQuaternion::rotation_between(&Vector3::z(), &Vector3::y());
        let offset = Isometry3::from_parts(Translation3::identity(), turn.expect("a turn"));
        let mut locked = LockedAxes::TRANSLATION_LOCKED_X | LockedAxes::TRANSLATION_LOCKED_Y;
        if !rolls {
            locked |= LockedAxes::ROTATION_LOCKED;
        }
        let at = Vector3::z() * radius;
        Self::new((body, proxy), (surface, offset), at, locked, renew, HEAVY, dt)
    }

    /// Lets a motor draw the ball along x.
    fn draw(&mut self, speed: f64) {
        let at = self.world.bodies[self.ball].translation();
        let base = self.world.insert_body(RigidBodyBuilder::fixed().translation(at));
        let held = JointAxesMask::ANG_AXES | JointAxesMask::LIN_Y;
        let joint = GenericJointBuilder::new(held);
        let joint = joint.motor_velocity(JointAxis::LinX, n(speed), n(1e6));
        self.world.insert_impulse_joint(base, self.ball, joint);
        // With fewer, Rapier's solver does not bring the motor to push against the friction.
        self.world.integration_parameters.num_solver_iterations = 16;
    }

    fn run(&mut self, time: f64) {
        let dt = scalar::wide(self.world.integration_parameters.dt);
        for _ in 0..(time / dt).round() as u32 {
            let rb = &mut self.world.bodies[self.ball];
            rb.reset_forces(true);
            rb.add_force(v(0.0, 0.0, -self.load), true);
            self.wear.step(&mut self.world, &(), &()).expect("a step inside the model");
            self.events.extend_from_slice(self.wear.events());
        }
    }

    fn worn(&self) -> f64 {
        self.wear[self.id].wear_volume()
    }

    /// Worn volume per way of the ball [m2], once it has gone a good part of it.
    fn groove(&mut self) -> f64 {
        let x = |rig: &Self| scalar::wide(rig.world.bodies[rig.ball].translation().x);
        self.draw(SPEED);
        self.run(0.1);
        let (from, began) = (x(self), self.worn());
        self.run(0.2);
        let way = x(self) - from;
        assert!((way / (0.2 * SPEED) - 1.0).abs() < 0.05, "{way}");
        (self.worn() - began) / way
    }
}

/// The same groove in the core.
fn reference(mut surface: Surface, top: f64) -> f64 {
    let state = State::at(Point3::new(-0.01, 0.0, top + RADIUS + 1e-9));
    let shape = Shape::ball(RADIUS).expect("a ball");
    let inertia = Inertia::of_ball(RADIUS, 8000.0);
    let mut body = Body { shape, inertia, state, rotation_locked: true };
    let solution = DriveSolution::QuasiStatic { increment: PITCH / 4.0 };
    let (indent_to, load, speed, distance, mass) = (LOAD, LOAD, SPEED, 0.015, LIGHT);
    let drive = Drive { indent_to, load, speed, distance, mass, solution };
    let settings = EncounterSettings::default();
    let mut driven = Driven::new(&mut body, &surface, drive, settings).expect("a drive");
    let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
    driven.indent(&mut body, &mut placed, &mut ()).expect("an indentation");
    driven.advance(&mut body, &mut placed, 0.1, &mut ()).expect("a groove");
    placed[0].surface.settle();
    driven.advance(&mut body, &mut placed, 0.2, &mut ()).expect("a groove");
    placed[0].surface.settle().displaced() / (0.2 * SPEED)
}

const STEPS: [f64; 3] = [1.0 / 60.0, 1.0 / 240.0, 1e-3];

/// Fails for a contact that begins anew in every step, for another load or direction, and for a way
/// that is not that of the step.
#[test]
fn a_ball_grooves_a_block_among_others_as_it_does_a_plate() {
    let [plate, core] = [reference(strip(), 0.0), reference(block(), BLOCK[2])];
    let by = |rig: &Rig| rig.wear.reasons().map(|(by, ..)| by).collect::<Vec<_>>();
    let mut rig = Rig::flat(false, LIGHT, 1.0 / 60.0);
    let open = rig.groove();
    assert!(!by(&rig).contains(&Resolver::Collision), "Rapier holds it on a plate");
    for dt in STEPS {
        let mut rig = Rig::flat(true, LIGHT, dt);
        let groove = rig.groove();
        let ratios = [core, plate, open].map(|other| groove / other);
        println!("{dt:.4}: {groove:e}, over block, plate in the core, plate {ratios:.4?}");
        assert!(by(&rig).contains(&Resolver::QuasiStatic), "{:?}", by(&rig));
        assert!((ratios[0] - 1.0).abs() < 0.03, "{ratios:?}");
        // The nodes of a block and of a plate lie in other patterns.
        assert!(ratios[1..].iter().all(|ratio| (ratio - 1.0).abs() < 0.06), "{ratios:?}");
    }
}

/// Fails for a contact that is pressed anew in every step.
#[test]
fn what_lies_under_a_load_wears_once() {
    for dt in STEPS {
        let mut rig = Rig::flat(true, HEAVY, dt);
        rig.run(0.05);
        let (first, steps) = (rig.worn(), rig.wear.counters().steps);
        rig.run(1.0);
        println!("{dt:.4}: {first:e} {:?}", rig.wear.counters());
        assert!(first > 0.0 && rig.worn() == first, "{first:e} {:e}", rig.worn());
        assert_eq!(rig.wear.counters().steps, steps);
        rig.load = 2.0 * LOAD;
        rig.run(0.05);
        assert!(rig.worn() > 1.5 * first, "{first:e} {:e}", rig.worn());
    }
}

/// Fails for wear by a way over the ground where the surface moves under a body that stays, and for
/// wear that depends on the step.
#[test]
fn a_drum_is_ground_in_proportion_to_the_way() {
    // Some of the rolling ball's track is a single node wide.
    for (rolls, linear, tolerance) in [(false, 0.02, 0.01), (true, 0.1, 0.15)] {
        let mut rates = Vec::new();
        for dt in STEPS {
            let mut rig = Rig::drum(rolls, false, dt);
            let worn = [0.6; 4].map(|time| {
                rig.run(time);
                rig.worn()
            });
            println!("{dt:.4} {rolls}: {worn:?} {:?}", rig.wear.counters());
            let parts = [1, 2, 3].map(|at| (worn[at] - worn[at - 1]) / (worn[3] - worn[0]));
            assert!(parts.iter().all(|part| (3.0 * part - 1.0).abs() < linear), "{parts:?}");
            rates.push(worn[3] - worn[0]);
        }
        println!("{rolls}: {rates:?}");
        let off = rates.iter().map(|rate| (rate / rates[1] - 1.0).abs()).fold(0.0, f64::max);
        assert!(off < tolerance, "{off}");
    }
}

/// Fails for a look at nodes that cannot flow, and for a bound that holds back what can.
#[test]
fn what_bears_too_little_costs_nothing() {
    let node = block().least_area();
    let least = HARDNESS * 0.25 * node / 1f64.hypot(0.3);
    for part in [0.9, 6.0] {
        let mut rig = Rig::flat(true, LIGHT, 1.0 / 240.0);
        rig.load = part * least;
        rig.draw(SPEED);
        rig.run(0.2);
        let counters = *rig.wear.counters();
        println!("{part}: {:e} {counters:?}", rig.worn());
        match part < 1.0 {
            true => {
                assert_eq!(
                    [counters.quasi_static, counters.steps, counters.node_evaluations],
                    [0; 3]
                );
                assert!(rig.worn() == 0.0 && counters.refused == 0);
            }
            false => assert!(rig.worn() > 0.0 && counters.quasi_static > 10),
        }
    }
}

/// Fails for solids that are never renewed under what grinds them, or at every step, and for a drum
/// that turns about another axis with its new shape.
#[test]
fn what_is_ground_is_renewed() {
    let worn = [false, true].map(|renew| {
        let mut rig = Rig::drum(false, renew, 1.0 / 240.0);
        // By its weight: on facets it hops, which is no blow among things that fall faster.
        (rig.load, rig.world.gravity) = (0.0, v(0.0, 0.0, -LOAD / HEAVY));
        rig.run(1.2);
        let axis = rig.world.bodies.iter().find(|(_, body)| body.is_kinematic()).expect("a drum").1;
        assert!(axis.translation().length() < n(1e-9), "{:?}", axis.translation());
        let proxy = &rig.world.colliders[axis.colliders()[0]];
        assert!(proxy.shape().as_cylinder().is_some(), "its facets would let a ball hop");
        (rig.worn(), rig.wear[rig.id].renewals())
    });
    println!("{worn:?}");
    assert!(worn[0].1 == 0 && (2..8).contains(&worn[1].1));
    assert!((worn[1].0 / worn[0].0 - 1.0).abs() < 0.1, "{worn:?}");
}

/// Fails for a contact that begins in every step, and for loads or volumes that are lost.
#[test]
fn a_contact_that_lasts_begins_and_ends_once() {
    let mut rig = Rig::flat(true, LIGHT, 1.0 / 240.0);
    rig.draw(SPEED);
    rig.run(0.2);
    rig.load = -LOAD;
    rig.run(0.1);
    let started = rig.events.iter().filter(|event| matches!(event, WearEvent::Started { .. }));
    assert_eq!(started.count(), 1);
    let ended: Vec<_> =
        rig.events.iter().filter(|e| matches!(e, WearEvent::Ended { .. })).collect();
    println!("{ended:?} {:e}", rig.worn());
    let [WearEvent::Ended { volume, impulse, contact_time, .. }] = ended[..] else {
        panic!("{ended:?}");
    };
    assert!((volume / rig.worn() - 1.0).abs() < 1e-9);
    assert!((contact_time - 0.2).abs() < 0.02 && (impulse.z / (LOAD * 0.2) - 1.0).abs() < 0.1);
    let ledger = rig.wear.ledger();
    println!("{ledger:?} {:e}", ledger.numerical());
    assert!(ledger.elastic == 0.0 && ledger.friction > ledger.wear && ledger.wear > 0.0);
    assert!(ledger.numerical().abs() < 0.05 * ledger.external_work);
    let by =
        |wanted| rig.wear.reasons().filter(|(by, ..)| *by == wanted).map(|(.., n)| n).sum::<u64>();
    assert_eq!(by(Resolver::QuasiStatic), rig.wear.counters().quasi_static);
}
