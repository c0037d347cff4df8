//! The rows: each builds its world, runs it and says what was left.

use crate::plugin::rapier::prelude::*;
use crate::plugin::{Counters, scalar};
use nalgebra::{UnitQuaternion, Vector3};

use super::rig::{Case, GRAVITY, Plate, Rig, n, vector};

/// What is left of a row.
#[derive(Clone, Copy, Debug)]
pub struct Outcome {
    /// W_V [mm3].
    pub volume: f64,
    /// Speed of the body that matters [m/s].
    pub speed: f64,
    pub sleeps: bool,
    pub counters: Counters,
}

impl Rig {
    fn outcome(&self, body: RigidBodyHandle) -> Outcome {
        Outcome {
            volume: self.volume(),
            speed: self.speed(body),
            sleeps: self.world.bodies[body].is_sleeping(),
            counters: *self.counters(),
        }
    }
}

/// How two bodies are joined.
type Join = fn(&mut Rig, [RigidBodyHandle; 2], GenericJoint);

fn down() -> Vector3<f64> {
    Vector3::z() * -GRAVITY
}

/// A steel ball of 3 mm that lies on a steel plate.
pub fn resting_ball(case: Case) -> Outcome {
    let plate = Plate { length: 20e-3, width: 10e-3, pitch: 0.1e-3, hardness: 1.7e9, young: 200e9 };
    let mut rig = Rig::new(case, &plate, down(), 0.01);
    let ball = rig.body(Vector3::z() * 3e-3);
    let ball = rig.ball(ball, 3e-3, 7800.0);
    rig.run(3.0, |_| ());
    rig.outcome(ball)
}

/// A ball of 10 mm on soft ground, pressed by a load that grows to 50 N in half a second.
pub fn loaded_ball(case: Case) -> Outcome {
    let plate = Plate { length: 20e-3, width: 10e-3, pitch: 0.2e-3, hardness: 20e6, young: 2e9 };
    let mut rig = Rig::new(case, &plate, down(), 0.01);
    let ball = rig.body(Vector3::z() * 10e-3);
    let ball = rig.ball(ball, 10e-3, 7800.0);
    rig.run(0.6, |rig| {
        let load = 50.0 * ((rig.time + rig.case.dt) / 0.5).min(1.0);
        let rb = &mut rig.world.bodies[ball];
        rb.reset_forces(true);
        rb.add_force(vector(0.0, 0.0, -load), true);
    });
    rig.outcome(ball)
}

/// A box of 10 kg with a face of 1 cm2 under a load that grows to 0.8 of what the ground bears.
pub fn pressed_box(case: Case) -> (Outcome, f64) {
    let plate = Plate { length: 40e-3, width: 40e-3, pitch: 0.2e-3, hardness: 5e6, young: 250e6 };
    let mut rig = Rig::new(case, &plate, down(), 0.01);
    let body = rig.body(Vector3::z() * 5e-3);
    let body = rig.block(body, [5e-3; 3], 1e7);
    rig.run(1.0, |rig| {
        let load = 300.0 * (3.0 * rig.time).min(1.0);
        let rb = &mut rig.world.bodies[body];
        rb.reset_forces(true);
        rb.add_force(vector(0.0, 0.0, -load), true);
    });
    let tilt = scalar::rotation(rig.world.bodies[body].rotation()).angle();
    (rig.outcome(body), tilt)
}

/// A block of `density` that comes down at 2 m/s on a ball that lies on the plate.
fn block_on_ball(case: Case, density: f64, sleeps: bool) -> Outcome {
    let plate = Plate { length: 20e-3, width: 10e-3, pitch: 0.1e-3, hardness: 1.7e9, young: 200e9 };
    let mut rig = Rig::new(case, &plate, down(), 0.01);
    let ball = rig.body(Vector3::z() * 5e-3).sleeping(sleeps);
    rig.ball(ball, 5e-3, 7800.0);
    let block = rig.body(Vector3::z() * 0.1).linvel(vector(0.0, 0.0, -2.0));
    let block = rig.block(block, [10e-3, 10e-3, 5e-3], density);
    rig.run(0.05, |_| ());
    rig.outcome(block)
}

pub fn light_block_on_ball(case: Case) -> Outcome {
    block_on_ball(case, 1000.0, false)
}

pub fn heavy_block_on_ball(case: Case) -> Outcome {
    block_on_ball(case, 20_000.0, false)
}

pub fn heavy_block_on_sleeping_ball(case: Case) -> Outcome {
    block_on_ball(case, 20_000.0, true)
}

pub fn fixed_joint_dumbbell(case: Case) -> Outcome {
    dumbbell(case, Rig::joint)
}

pub fn dumbbell_as_articulation(case: Case) -> Outcome {
    dumbbell(case, Rig::link)
}

/// Two balls that a fixed joint holds 8 mm apart, tilted, at 20 m/s.
fn dumbbell(case: Case, join: Join) -> Outcome {
    let plate = Plate { length: 30e-3, width: 12e-3, pitch: 0.1e-3, hardness: 1.7e9, young: 200e9 };
    let mut rig = Rig::new(case, &plate, Vector3::zeros(), 0.01);
    let turn = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.5);
    let middle = Vector3::new(-10e-3, 0.0, 20e-3);
    let (sin, cos) = 70f64.to_radians().sin_cos();
    let velocity = vector(20.0 * cos, 0.0, -20.0 * sin);
    let arms = [-4e-3, 4e-3].map(|x| Vector3::x() * x);
    let balls = arms.map(|arm| {
        let place = rig.case.origin + middle + turn * arm;
        let pose = scalar::to_pose(&nalgebra::Isometry3::from_parts(place.into(), turn));
        let body = RigidBodyBuilder::dynamic().pose(pose).linvel(velocity);
        rig.ball(body, 3e-3, 2500.0)
    });
    let joint = FixedJointBuilder::new()
        .local_anchor1(scalar::to_vector(&-arms[0]))
        .local_anchor2(scalar::to_vector(&-arms[1]))
        .contacts_enabled(false);
    join(&mut rig, balls, joint.build().data);
    rig.run(0.05, |_| ());
    let velocities = balls.map(|ball| scalar::vector(rig.world.bodies[ball].linvel()));
    let speed = (velocities[0] + velocities[1]).norm() / 2.0;
    Outcome { speed, ..rig.outcome(balls[0]) }
}

pub fn pendulum(case: Case) -> Outcome {
    swing(case, Rig::joint)
}

pub fn pendulum_as_articulation(case: Case) -> Outcome {
    swing(case, Rig::link)
}

/// A pendulum of 60 mm whose hard tip swings into the plate at 45 degrees.
fn swing(case: Case, join: Join) -> Outcome {
    let plate = Plate { length: 0.12, width: 12e-3, pitch: 0.1e-3, hardness: 1.7e9, young: 200e9 };
    let mut rig = Rig::new(case, &plate, down(), 0.01);
    let (arm, radius) = (60e-3, 3e-3);
    // The tip touches the plate when the arm is 45 degrees below the horizontal.
    let height = radius + arm * 0.5f64.sqrt();
    let pivot = RigidBodyBuilder::fixed()
        .translation(scalar::to_vector(&(rig.case.origin + Vector3::z() * height)));
    let pivot = rig.world.insert_body(pivot);
    // It starts close by: over a longer way Rapier's own swing is off by a per cent.
    let angle = 0.74f64;
    let at = Vector3::new(arm * angle.cos(), 0.0, height - arm * angle.sin());
    let spin = 5.0 / arm;
    let velocity = Vector3::new(-angle.sin(), 0.0, -angle.cos()) * 5.0;
    let tip = rig.body(at).linvel(scalar::to_vector(&velocity)).angvel(vector(0.0, spin, 0.0));
    let tip = rig.ball(tip, radius, 7800.0);
    let joint = RevoluteJointBuilder::new(Vector::Y)
        .local_anchor1(Vector::ZERO)
        .local_anchor2(scalar::to_vector(&Vector3::new(-at.x, 0.0, height - at.z)));
    join(&mut rig, [pivot, tip], joint.build().data);
    rig.run(1.0 / 60.0, |_| ());
    rig.outcome(tip)
}

/// A tip that a motor draws along the plate at 0.2 m/s, free to find its height, pressed down by
/// 200 N.
pub fn motor_driven_scratch(case: Case) -> Outcome {
    let plate = Plate { length: 30e-3, width: 3e-3, pitch: 0.06e-3, hardness: 1.7e9, young: 200e9 };
    let mut rig = Rig::new(case, &plate, down(), 0.01);
    let radius = 2e-3;
    let at = Vector3::new(-10e-3, 0.0, radius);
    let base = RigidBodyBuilder::fixed().translation(scalar::to_vector(&(rig.case.origin + at)));
    let base = rig.world.insert_body(base);
    let holder = MassProperties::new(Vector::ZERO, n(0.1), vector(1e-5, 1e-5, 1e-5));
    let tip = rig.body(at).additional_mass_properties(holder);
    let tip = rig.ball(tip, radius, 0.0);
    // With fewer, Rapier's solver does not bring the motor to push against 70 N of friction.
    rig.world.integration_parameters.num_solver_iterations = 16;
    let held = JointAxesMask::ANG_AXES | JointAxesMask::LIN_Y;
    let joint = GenericJointBuilder::new(held).motor_velocity(JointAxis::LinX, n(0.2), n(1e6));
    rig.world.insert_impulse_joint(base, tip, joint);
    rig.run(0.05, |rig| {
        let rb = &mut rig.world.bodies[tip];
        rb.reset_forces(true);
        rb.add_force(vector(0.0, 0.0, -200.0), true);
    });
    rig.outcome(tip)
}

/// Five boxes of 20 mm on a soft plate, the top one struck by a ball at 30 m/s from above.
pub fn struck_stack(case: Case) -> Outcome {
    let plate = Plate { length: 80e-3, width: 80e-3, pitch: 1e-3, hardness: 5e6, young: 1e9 };
    let mut rig = Rig::new(case, &plate, down(), 0.02);
    for i in 0..5 {
        let body = rig.body(Vector3::z() * (10e-3 + 20e-3 * f64::from(i)));
        rig.block(body, [10e-3; 3], 1000.0);
    }
    let ball =
        rig.body(Vector3::new(-3e-3, 0.0, 0.1 + 5e-3 + 10e-3)).linvel(vector(3.0, 0.0, -30.0));
    let ball = rig.ball(ball, 5e-3, 7800.0);
    rig.run(0.05, |_| ());
    rig.outcome(ball)
}

/// A clump of four balls of 20 mm that rolls down an incline of 30 degrees on soft ground.
pub fn rolling_clump(case: Case) -> Outcome {
    let plate = Plate { length: 1.0, width: 0.2, pitch: 1.5e-3, hardness: 50e3, young: 10e6 };
    let (sin, cos) = 30f64.to_radians().sin_cos();
    let gravity = Vector3::new(GRAVITY * sin, 0.0, -GRAVITY * cos);
    let mut rig = Rig::new(case, &plate, gravity, 0.05);
    let parts = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    let body = rig.body(Vector3::new(-0.4, 0.0, 32e-3));
    let body = rig.world.insert_body(body);
    for part in parts {
        let at = Vector3::from(part) * 10e-3;
        let ball = ColliderBuilder::ball(n(20e-3))
            .translation(scalar::to_vector(&at))
            .density(n(2000.0))
            .friction(n(0.3));
        rig.world.insert_collider(ball, Some(body));
    }
    rig.run(0.5, |_| ());
    rig.outcome(body)
}
