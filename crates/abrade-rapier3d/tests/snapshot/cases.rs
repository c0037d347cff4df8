//! Worlds in the middle of a contact, one for every way to resolve it.

use crate::plugin::abrade::{
    Body, Drive, DriveSolution, HexStrip, Inertia, Material, Shape, State, Surface, SurfaceLaws,
    TriangleMesh,
};
use crate::plugin::rapier::math::{Pose, Vector};
use crate::plugin::rapier::prelude::*;
use crate::plugin::{Counters, Resolve, SurfaceId, WearEvent, WearSettings, WearWorld, scalar};
use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3};

use super::save::Save;

pub struct Case {
    pub name: &'static str,
    world: fn() -> Save,
    /// Steps of bodies that were resolved as the case wants it.
    counted: fn(&Counters) -> u64,
    /// Steps before the save and after it.
    before: usize,
    pub after: usize,
}

pub const CASES: [Case; 9] = [
    Case {
        name: "impacts at tiny steps",
        world: impacts,
        counted: |counters| counters.micro,
        before: 6,
        after: 40,
    },
    Case {
        name: "blow on a dumbbell",
        world: dumbbell,
        counted: |counters| counters.lockstep,
        before: 6,
        after: 12,
    },
    Case {
        name: "pressed and slid",
        world: slider,
        counted: |counters| counters.quasi_static,
        before: 12,
        after: 12,
    },
    Case {
        name: "ground among others",
        world: ground,
        counted: |counters| counters.quasi_static,
        before: 12,
        after: 12,
    },
    Case {
        name: "driven scratch",
        world: scratch,
        counted: |counters| counters.micro,
        before: 8,
        after: 8,
    },
    Case {
        name: "cube that is to be renewed",
        world: tumbling,
        counted: |counters| counters.micro,
        before: 14,
        after: 30,
    },
    Case {
        name: "cube that was renewed",
        world: tumbling,
        counted: |counters| counters.micro,
        before: 111,
        after: 100,
    },
    Case {
        name: "tool in its groove",
        world: groove,
        counted: |counters| counters.micro,
        before: 3,
        after: 4,
    },
    Case { name: "hail", world: hail, counted: |counters| counters.micro, before: 12, after: 24 },
];

impl Case {
    /// The world at the save: a contact has begun, and has not ended.
    pub fn begun(&self) -> Save {
        let mut save = (self.world)();
        let events = save.run(self.before);
        let count = |wanted: fn(&&WearEvent) -> bool| events.iter().filter(wanted).count();
        let begun = count(|event| matches!(event, WearEvent::Started { .. }));
        let ended = count(|event| matches!(event, WearEvent::Ended { .. }));
        let driven = save.world.bodies.iter().any(|(body, _)| save.wear.driven(body).is_some());
        assert!(driven || begun > ended, "{}: {begun} begun, {ended} ended", self.name);
        assert!((self.counted)(save.wear.counters()) > 0, "{}: {events:?}", self.name);
        save
    }

    /// Takes the steps after the save and tells every bit that comes of them.
    pub fn finish(&self, save: &mut Save) -> String {
        let displaced = |save: &Save| -> f64 {
            save.wear.surfaces().map(|(_, surface)| surface.worn().displaced()).sum()
        };
        let before = (displaced(save), (self.counted)(save.wear.counters()));
        let outcome = save.outcome(self.after);
        let after = (displaced(save), (self.counted)(save.wear.counters()));
        println!("{}: {before:?} before, {after:?} after", self.name);
        assert!(after.0 > before.0 && after.1 > before.1, "{}: {before:?} {after:?}", self.name);
        outcome
    }
}

fn n(x: f64) -> Real {
    scalar::narrow(x)
}

fn v(x: f64, y: f64, z: f64) -> Vector {
    scalar::to_vector(&Vector3::new(x, y, z))
}

/// A plate of `length` x `width` [m], its top at z = 0, without gravity.
struct Plate {
    size: [f64; 3],
    material: Material,
    restitution: f64,
    dt: f64,
    resolve: Resolve,
}

pub const STEEL: Material = Material {
    hardness: 1.7e9,
    shear_ratio: 0.25,
    young: Some(200e9),
    poisson: 0.3,
    friction: 0.3,
};
const SOFT: Material = Material { hardness: 20e6, young: Some(2e9), ..STEEL };

impl Plate {
    fn save(self) -> (Save, SurfaceId) {
        let Self { size: [length, width, pitch], material, restitution, dt, resolve } = self;
        let laws = SurfaceLaws { restitution, ..SurfaceLaws::of(material) };
        let strip = HexStrip { length, width, pitch, rest_area: None };
        let surface = Surface::hex_strip(strip, laws).expect("a plate");
        let mut world = PhysicsWorld { gravity: Vector::ZERO, ..PhysicsWorld::default() };
        world.integration_parameters.dt = n(dt);
        world.integration_parameters.length_unit = n(0.01);
        world.integration_parameters.normalized_max_linear_velocity = Real::MAX;
        let slab = ColliderBuilder::cuboid(n(0.5 * length), n(0.5 * width), n(0.01))
            .translation(v(0.0, 0.0, -0.01))
            .friction(n(0.3));
        let proxy = world.colliders.insert(slab);
        // Damaged bytes may ask for any number of steps.
        let settings =
            WearSettings { ledger: true, step_limit: 3000, resolve, ..WearSettings::default() };
        let mut wear = WearWorld::new(settings);
        let plate = wear.insert_on_top(surface, proxy, &mut world.colliders).expect("a proxy");
        (Save { world, wear }, plate)
    }
}

/// A ball, a block, a tetrahedron and a pair of blocks, each just above the plate at 35 m/s.
fn impacts() -> Save {
    let plate = Plate {
        size: [40e-3, 12e-3, 0.2e-3],
        material: STEEL,
        restitution: 0.7,
        dt: 1e-6,
        resolve: Resolve::Auto,
    };
    let (mut save, _) = plate.save();
    let turn = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, 0.5, 0.2));
    let (h, r) = (1.5e-3, 2e-3);
    let corners = [v(0.0, 0.0, 0.0), v(r, 0.0, 0.0), v(0.0, r, 0.0), v(0.0, 0.0, r)];
    let part = |x: f64| {
        (Pose::from_translation(v(x, 0.0, 0.0)), SharedShape::cuboid(n(0.5 * h), n(h), n(h)))
    };
    let shapes = [
        SharedShape::ball(n(r)),
        SharedShape::cuboid(n(h), n(h), n(h)),
        SharedShape::convex_hull(&corners).expect("a hull"),
        SharedShape::compound(vec![part(-h), part(h)]),
    ];
    for (at, shape) in [-15e-3, -5e-3, 5e-3, 15e-3].into_iter().zip(shapes) {
        let place =
            |z: f64| scalar::to_pose(&Isometry3::from_parts(Vector3::new(at, 0.0, z).into(), turn));
        let lowest = scalar::wide(shape.compute_aabb(&place(0.0)).mins.z);
        let body = RigidBodyBuilder::dynamic().pose(place(1e-5 - lowest));
        let body = body.linvel(v(12.0, 0.0, -33.0)).angvel(v(100.0, -200.0, 50.0));
        save.world.insert(body, ColliderBuilder::new(shape).density(n(2500.0)));
    }
    save
}

/// A ball that is led into the plate, turning, and along it.
fn groove() -> Save {
    let plate = Plate {
        size: [30e-3, 12e-3, 0.2e-3],
        material: SOFT,
        restitution: 1.0,
        dt: 1e-3,
        resolve: Resolve::Auto,
    };
    let (mut save, _) = plate.save();
    let body = RigidBodyBuilder::kinematic_velocity_based().translation(v(-5e-3, 1e-4, 3.1e-3));
    let body = body.linvel(v(0.5, 0.0, -0.05)).angvel(v(3.0, -20.0, 50.0));
    let (tool, _) = save.world.insert(body, ColliderBuilder::ball(n(3e-3)));
    save.wear.add_tool(tool, &save.world.bodies).expect("a kinematic body");
    save
}

/// Two balls that a fixed joint holds 8 mm apart, tilted, on soft ground at 5 m/s.
fn dumbbell() -> Save {
    let plate = Plate {
        size: [30e-3, 12e-3, 0.2e-3],
        material: SOFT,
        restitution: 1.0,
        dt: 1e-5,
        resolve: Resolve::Auto,
    };
    let (mut save, _) = plate.save();
    let turn = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.5);
    let arms = [-4e-3, 4e-3].map(|x| Vector3::x() * x);
    let middle = Vector3::new(0.0, 0.0, 3e-3 + 4e-3 * 0.5f64.sin() + 5e-5);
    let balls = arms.map(|arm| {
        let pose = Isometry3::from_parts((middle + turn * arm).into(), turn);
        let body = RigidBodyBuilder::dynamic().pose(scalar::to_pose(&pose));
        let ball = ColliderBuilder::ball(n(3e-3)).density(n(7800.0)).friction(n(0.3));
        save.world.insert(body.linvel(v(2.0, 0.0, -5.0)), ball).0
    });
    let joint = FixedJointBuilder::new()
        .local_anchor1(scalar::to_vector(&-arms[0]))
        .local_anchor2(scalar::to_vector(&-arms[1]))
        .contacts_enabled(false);
    save.world.insert_impulse_joint(balls[0], balls[1], joint);
    save
}

/// A ball of 1 kg that a force of 50 N presses on soft ground, on its way along it.
fn slider() -> Save {
    let plate = Plate {
        size: [40e-3, 10e-3, 0.4e-3],
        material: SOFT,
        restitution: 1.0,
        dt: 1.0 / 240.0,
        resolve: Resolve::QuasiStatic,
    };
    let (mut save, _) = plate.save();
    let body = RigidBodyBuilder::dynamic().translation(v(-10e-3, 0.0, 10e-3));
    let body = body.linvel(v(0.2, 0.0, 0.0)).additional_mass(n(1.0)).lock_rotations();
    let ball = ColliderBuilder::ball(n(10e-3)).density(n(0.0)).friction(n(0.3));
    let (body, _) = save.world.insert(body, ball);
    save.world.bodies[body].add_force(v(20.0, 0.0, -50.0), true);
    save
}

/// A tip of 2 mm that is pressed in and drawn along under 100 N.
fn scratch() -> Save {
    let plate = Plate {
        size: [10e-3, 3e-3, 0.1e-3],
        material: STEEL,
        restitution: 1.0,
        dt: 1e-4,
        resolve: Resolve::Auto,
    };
    let (mut save, plate) = plate.save();
    let body = RigidBodyBuilder::kinematic_position_based().translation(v(0.0, 0.0, 3e-3));
    let (tip, _) = save.world.insert(body, ColliderBuilder::ball(n(2e-3)));
    let drive = Drive {
        indent_to: 100.0,
        load: 100.0,
        speed: 0.2,
        distance: 4e-3,
        mass: 0.05,
        solution: DriveSolution::Dynamic,
    };
    let shape = Shape::ball(2e-3).expect("a ball");
    let state = State::at(Point3::new(-2e-3, 0.0, 2.1e-3));
    let inertia = Inertia::of_ball(2e-3, 7800.0);
    let body = Body { shape, inertia, state, rotation_locked: true };
    save.wear.drive(plate, tip, body, drive, &save.world.bodies).expect("a drive");
    save
}

/// A wearing cube that falls on a floor; it is renewed in the 29th step.
fn tumbling() -> Save {
    let gravity = v(0.0, 0.0, -100.0);
    let mut world = PhysicsWorld { gravity, ..PhysicsWorld::default() };
    world.integration_parameters.dt = n(2e-4);
    world.integration_parameters.length_unit = n(0.02);
    world
        .colliders
        .insert(ColliderBuilder::cuboid(n(1.0), n(1.0), n(0.1)).translation(v(0.0, 0.0, -0.1)));
    let body = RigidBodyBuilder::dynamic()
        .translation(v(0.0, 0.0, 0.025))
        .rotation(v(0.5, 0.7, 0.0))
        .linvel(v(0.3, 0.2, -3.0))
        .angvel(v(20.0, -30.0, 10.0));
    let half = n(0.01);
    let cube = ColliderBuilder::cuboid(half, half, half).density(n(2000.0));
    let (_, proxy) = world.insert(body, cube);
    let mesh = TriangleMesh::cuboid(Vector3::repeat(0.01), 2e-3).expect("a cube");
    let soft = Material { hardness: 1e7, young: Some(2e8), ..STEEL };
    let laws = SurfaceLaws { restitution: 0.9, ..SurfaceLaws::of(soft) };
    let surface = Surface::mesh(&mesh, laws).expect("a surface");
    let settings = WearSettings { ledger: true, step_limit: 30_000, ..WearSettings::default() };
    let mut wear = WearWorld::new(settings);
    wear.insert(surface, proxy, &mut world.colliders).expect("a proxy");
    Save { world, wear }
}

/// Balls that fall one after the other on the same spots, some beside the plate, and one that is
/// registered with its exact state.
fn hail() -> Save {
    let plate = Plate {
        size: [40e-3, 40e-3, 0.5e-3],
        material: SOFT,
        restitution: 0.8,
        dt: 2e-5,
        resolve: Resolve::Auto,
    };
    let (mut save, _) = plate.save();
    for number in 0..30 {
        let [column, row] = [number % 5, number / 5].map(f64::from);
        let at = Vector3::new(12e-3 * (column - 1.5), 8e-3 * (row - 1.0), 0.0);
        let velocity = Vector3::new(column - 1.0, 0.5 * row, -6.0);
        let at = at - velocity * (2e-5 * (5.0 * row + column)) + Vector3::z() * 2.01e-3;
        let body = RigidBodyBuilder::dynamic().translation(scalar::to_vector(&at));
        let ball = ColliderBuilder::ball(n(2e-3)).density(n(7800.0));
        let (ball, _) = save.world.insert(body.linvel(scalar::to_vector(&velocity)), ball);
        if number == 7 {
            let shape = Shape::ball(2e-3).expect("a ball");
            let state = State { velocity, ..State::at(at.into()) };
            let inertia = Inertia::of_ball(2e-3, 7800.0);
            let body = Body { shape, inertia, state, rotation_locked: false };
            let (bodies, colliders) = (&mut save.world.bodies, &save.world.colliders);
            save.wear.place(ball, body, bodies, colliders).expect("the ball");
        }
    }
    save
}

/// A ball that slides on a block, along a wall.
fn ground() -> Save {
    let radius = 5e-3;
    let mut world = PhysicsWorld { gravity: v(0.0, 0.0, -2.0), ..PhysicsWorld::default() };
    world.integration_parameters.dt = n(1.0 / 240.0);
    world.integration_parameters.length_unit = n(radius);
    let half = Vector3::new(10e-3, 4e-3, 4e-3);
    let proxy = ColliderBuilder::cuboid(n(half.x), n(half.y), n(half.z));
    let proxy = world.colliders.insert(proxy.translation(v(0.0, 0.0, -half.z)).friction(n(0.3)));
    let wall = ColliderBuilder::cuboid(n(0.1), n(0.01), n(0.01)).friction(n(0.0));
    world.colliders.insert(wall.translation(v(0.0, radius + 0.01, 0.012)));
    let mesh = TriangleMesh::cuboid(half, 0.4e-3).expect("a block");
    let surface = Surface::mesh(&mesh, SurfaceLaws::of(SOFT)).expect("a surface");
    let settings = WearSettings { ledger: true, step_limit: 3000, ..WearSettings::default() };
    let mut wear = WearWorld::new(settings);
    wear.insert(surface, proxy, &mut world.colliders).expect("a proxy");
    let body = RigidBodyBuilder::dynamic()
        .translation(v(-5e-3, 0.0, radius))
        .linvel(v(0.05, 0.0, 0.0))
        .additional_mass(n(10.0))
        .lock_rotations();
    world.insert(body, ColliderBuilder::ball(n(radius)).density(n(0.0)).friction(n(0.0)));
    Save { world, wear }
}
