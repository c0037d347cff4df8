//! A Rapier world with one wear plate, as an embedder sets it up.

use crate::plugin::abrade::{HexStrip, Material, Surface, SurfaceLaws};
use crate::plugin::rapier::math::Vector;
use crate::plugin::rapier::prelude::*;
use crate::plugin::{Counters, Resolve, SurfaceId, WearSettings, WearWorld, scalar};
use nalgebra::{Isometry3, Vector3};

pub const GRAVITY: f64 = 9.81;

/// How a row is run.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    pub dt: f64,
    /// Where the plate's top lies [m].
    pub origin: Vector3<f64>,
    pub resolve: Resolve,
    pub accuracy: f64,
}

/// A plate of `length` x `width` [m].
pub struct Plate {
    pub length: f64,
    pub width: f64,
    pub pitch: f64,
    pub hardness: f64,
    pub young: f64,
}

/// Rapier's world, the wear beside it, and the plate.
pub struct Rig {
    pub case: Case,
    pub world: PhysicsWorld,
    pub wear: WearWorld,
    pub plate: SurfaceId,
    pub time: f64,
}

pub fn vector(x: f64, y: f64, z: f64) -> Vector {
    scalar::to_vector(&Vector3::new(x, y, z))
}

pub fn n(x: f64) -> Real {
    scalar::narrow(x)
}

impl Plate {
    pub fn surface(&self) -> Surface {
        let material = Material {
            hardness: self.hardness,
            shear_ratio: 0.25,
            young: Some(self.young),
            poisson: 0.3,
            friction: 0.3,
        };
        let strip =
            HexStrip { length: self.length, width: self.width, pitch: self.pitch, rest_area: None };
        Surface::hex_strip(strip, SurfaceLaws::of(material)).expect("a plate")
    }
}

impl Rig {
    /// `plate` at the case's origin under `gravity` [m/s2], and what is `scale` [m] large on it.
    pub fn new(case: Case, plate: &Plate, gravity: Vector3<f64>, scale: f64) -> Self {
        let gravity = scalar::to_vector(&gravity);
        let mut world = PhysicsWorld { gravity, ..PhysicsWorld::default() };
        world.integration_parameters.dt = n(case.dt);
        world.integration_parameters.length_unit = n(scale);
        world.integration_parameters.normalized_max_linear_velocity = Real::MAX;
        let half = 0.25 * plate.width;
        let slab = ColliderBuilder::cuboid(n(0.5 * plate.length), n(0.5 * plate.width), n(half))
            .translation(scalar::to_vector(&(case.origin - Vector3::z() * half)))
            .friction(n(0.3));
        let proxy = world.colliders.insert(slab);
        let settings = WearSettings {
            accuracy: case.accuracy,
            resolve: case.resolve,
            ..WearSettings::default()
        };
        let mut wear = WearWorld::new(settings);
        let plate = wear.insert_on_top(plate.surface(), proxy, &mut world.colliders);
        Self { case, world, wear, plate: plate.expect("a proxy"), time: 0.0 }
    }

    /// A body at `at` above the plate's middle [m].
    pub fn body(&self, at: Vector3<f64>) -> RigidBodyBuilder {
        let place = Isometry3::from(self.case.origin + at);
        RigidBodyBuilder::dynamic().pose(scalar::to_pose(&place))
    }

    pub fn ball(&mut self, body: RigidBodyBuilder, radius: f64, density: f64) -> RigidBodyHandle {
        let collider = ColliderBuilder::ball(n(radius)).density(n(density)).friction(n(0.3));
        self.world.insert(body, collider).0
    }

    pub fn block(
        &mut self,
        body: RigidBodyBuilder,
        half: [f64; 3],
        density: f64,
    ) -> RigidBodyHandle {
        let [x, y, z] = half.map(n);
        let collider = ColliderBuilder::cuboid(x, y, z).density(n(density)).friction(n(0.3));
        self.world.insert(body, collider).0
    }

    /// Joins two bodies by impulses.
    pub fn joint(&mut self, [first, second]: [RigidBodyHandle; 2], joint: GenericJoint) {
        self.world.insert_impulse_joint(first, second, joint);
    }

    /// Joins two bodies, as they move, to an articulation without damping: rigidly, or a body
    /// that hangs on one that stands.
    pub fn link(&mut self, [first, second]: [RigidBodyHandle; 2], joint: GenericJoint) {
        let handle = self.world.insert_multibody_joint(first, second, joint).expect("a joint");
        let (multibody, _) = self.world.multibody_joints.get_mut(handle).expect("a link");
        multibody.forward_kinematics(&self.world.bodies, true);
        multibody.damping_mut().fill(n(0.0));
        let [root, link] = [first, second].map(|body| &self.world.bodies[body]);
        let turn = joint.local_frame1.rotation.inverse() * link.angvel();
        let (v, spin) = (root.linvel(), root.angvel());
        let rates = match root.is_dynamic() {
            true => vec![v.x, v.y, v.z, spin.x, spin.y, spin.z],
            false => vec![turn.x],
        };
        multibody.generalized_velocity_mut().copy_from_slice(&rates);
    }

    pub fn step(&mut self) {
        self.wear.step(&mut self.world, &(), &()).expect("a step inside the model");
        self.time += self.case.dt;
    }

    /// Steps for `duration` [s], `drive` being called before each step.
    pub fn run(&mut self, duration: f64, mut drive: impl FnMut(&mut Self)) {
        while self.time < duration - 0.5 * self.case.dt {
            drive(self);
            self.step();
        }
    }

    pub fn speed(&self, body: RigidBodyHandle) -> f64 {
        scalar::vector(self.world.bodies[body].linvel()).norm()
    }

    /// W_V [mm3].
    pub fn volume(&self) -> f64 {
        self.wear[self.plate].wear_volume() * 1e9
    }

    /// Energy of the bodies [J]: kinetic, and of their height over the world's origin.
    pub fn energy(&self) -> f64 {
        let of = |rb: &RigidBody| {
            let height = scalar::vector(rb.center_of_mass()).z;
            scalar::wide(rb.kinetic_energy()) + scalar::wide(rb.mass()) * GRAVITY * height
        };
        self.world.bodies.iter().map(|(_, rb)| of(rb)).sum()
    }

    pub fn counters(&self) -> &Counters {
        self.wear.counters()
    }
}
