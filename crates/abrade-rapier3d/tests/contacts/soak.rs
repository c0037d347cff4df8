//! Random scenes of mixed bodies, joints included: nothing gains energy, sinks through, or is
//! thrown.
//!
//! Four scenes of a second and a half in the normal tests; a thousand of ten seconds, or those that
//! `SOAK` says (`100` or `20..30`), with
//! `cargo test --release -p abrade-rapier3d --test contacts_f32 -- --ignored soak_of --nocapture`.

use crate::plugin::rapier::prelude::*;
use crate::plugin::{Resolve, scalar};
use nalgebra::Vector3;

use super::rig::{Case, GRAVITY, Plate, Rig, n, vector};

/// A generator of its own: the scenes must be the same for ever (Marsaglia's xorshift64*).
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11;
        bits as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.roll()
    }

    fn vector(&mut self, size: f64) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.between(-size, size))
    }
}

/// Half the width of the ground [m].
const HALF: f64 = 0.75;
const BODIES: usize = 20;
/// Distance of the nodes [m]: a stone of 3 cm must not fall in between them.
const PITCH: f64 = 0.01;
const STEP: f64 = 1.0 / 60.0;

/// Balls, boxes, stones and clumps of 4 to 12 cm above soft ground inside four walls, some of them
/// jointed.
fn scene(dice: &mut Dice) -> (Rig, Vec<RigidBodyHandle>) {
    let hardness = 10f64.powf(dice.between(6.0, 8.0));
    let plate = Plate {
        length: 2.0 * HALF,
        width: 2.0 * HALF,
        pitch: PITCH,
        hardness,
        young: 50.0 * hardness,
    };
    let case = Case { dt: STEP, origin: Vector3::zeros(), resolve: Resolve::Auto, accuracy: 1e-2 };
    let mut rig = Rig::new(case, &plate, Vector3::z() * -GRAVITY, 0.1);
    for (x, y) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
        let (wide, high) = (n(2.0 * HALF), n(3.0));
        let wall = ColliderBuilder::cuboid(
            if x == 0.0 { wide } else { n(0.5) },
            if y == 0.0 { wide } else { n(0.5) },
            high,
        );
        let at = Vector3::new(x, y, 0.0) * (HALF + 0.3);
        rig.world.colliders.insert(wall.translation(scalar::to_vector(&at)));
    }
    let bodies = (0..BODIES).map(|i| drop_body(&mut rig, dice, i)).collect::<Vec<_>>();
    for pair in bodies.chunks(2) {
        if dice.roll() < 0.2 {
            join(&mut rig, dice, [pair[0], pair[1]]);
        }
    }
    (rig, bodies)
}

fn drop_body(rig: &mut Rig, dice: &mut Dice, i: usize) -> RigidBodyHandle {
    let (row, column) = ((i / 4) as f64, (i % 4) as f64);
    let at = Vector3::new(-0.3 + 0.2 * column, dice.between(-0.3, 0.3), 0.15 + 0.25 * row);
    let body = rig
        .body(at)
        .linvel(scalar::to_vector(&dice.vector(2.0)))
        .angvel(scalar::to_vector(&dice.vector(5.0)));
    let size = dice.between(0.02, 0.06);
    let density = n(dice.between(300.0, 8000.0));
    let handle = rig.world.insert_body(body);
    let colliders = match i % 4 {
        0 => vec![ColliderBuilder::ball(n(size))],
        1 => vec![ColliderBuilder::cuboid(n(size), n(size * dice.between(0.5, 1.0)), n(size))],
        2 => {
            let corner = |_| scalar::to_vector(&(dice.vector(1.0).normalize() * size));
            let corners: Vec<_> = (0..12).map(corner).collect();
            let stone = ColliderBuilder::convex_hull(&corners);
            vec![stone.unwrap_or_else(|| ColliderBuilder::ball(n(size)))]
        }
        _ => [-0.5, 0.5]
            .map(|x| ColliderBuilder::ball(n(size)).translation(vector(x * size, 0.0, 0.0)))
            .to_vec(),
    };
    for collider in colliders {
        rig.world.insert_collider(collider.density(density).friction(n(0.4)), Some(handle));
    }
    handle
}

fn join(rig: &mut Rig, dice: &mut Dice, [a, b]: [RigidBodyHandle; 2]) {
    let [from, to] = [a, b].map(|h| scalar::pose(rig.world.bodies[h].position()));
    let middle = nalgebra::center(&from.translation.vector.into(), &to.translation.vector.into());
    let anchors = [from, to].map(|pose| {
        let anchor: nalgebra::Point3<f64> = pose.inverse_transform_point(&middle);
        scalar::to_vector(&anchor.coords)
    });
    let joint: GenericJoint = match (dice.roll() * 3.0) as u32 {
        0 => FixedJointBuilder::new().local_anchor1(anchors[0]).local_anchor2(anchors[1]).into(),
        1 => RevoluteJointBuilder::new(Vector::Y)
            .local_anchor1(anchors[0])
            .local_anchor2(anchors[1])
            .into(),
        _ => {
            SphericalJointBuilder::new().local_anchor1(anchors[0]).local_anchor2(anchors[1]).into()
        }
    };
    rig.world.insert_impulse_joint(a, b, joint);
}

/// What went wrong in a scene, if anything did.
fn run(seed: u64, seconds: f64) -> Result<[u64; 5], String> {
    let mut dice = Dice(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
    let (mut rig, bodies) = scene(&mut dice);
    let start = rig.energy();
    let mut outside = 0;
    for step in 0..(seconds / STEP) as u64 {
        // A crater deeper than its body is outside the model: said, and the world goes on.
        if let Err(error) = rig.wear.step(&mut rig.world, &(), &()) {
            println!("seed {seed}, step {step}: {error}");
            outside += 1;
        }
        for &body in &bodies {
            let rb = &rig.world.bodies[body];
            let (at, v) = (scalar::vector(rb.center_of_mass()), scalar::vector(rb.linvel()));
            if !(at.iter().chain(v.iter()).all(|x| x.is_finite())) {
                return Err(format!("seed {seed}, step {step}: {body:?} is at {at:?}"));
            }
            let inside = at.x.abs() < HALF && at.y.abs() < HALF;
            // In soft ground a body's middle may come to lie lower than the ground once was, but not
            // lower than anything has worn.
            let ground = -rig.wear[rig.plate].worn().max_depth;
            if inside && at.z < ground || at.z > 5.0 {
                return Err(format!("seed {seed}, step {step}: {body:?} is at {at:?}, {v:?}"));
            }
        }
        let now = rig.energy();
        if now > 1.05 * start + 0.5 {
            return Err(format!("seed {seed}, step {step}: energy {start} J became {now} J"));
        }
    }
    let c = rig.counters();
    Ok([c.micro, c.quasi_static, c.lockstep, c.refused, outside])
}

fn soak(seeds: std::ops::Range<u64>, seconds: f64) {
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get());
    let (mut faults, mut counts) = (Vec::new(), [0; 5]);
    let part = |first: usize| {
        let own = seeds.clone().skip(first).step_by(threads);
        own.map(|seed| run(seed, seconds).inspect_err(|fault| println!("{fault}")))
            .collect::<Vec<_>>()
    };
    let results: Vec<_> = std::thread::scope(|scope| {
        let parts: Vec<_> = (0..threads).map(|first| scope.spawn(move || part(first))).collect();
        parts.into_iter().flat_map(|part| part.join().expect("no panic")).collect()
    });
    for result in results {
        match result {
            Ok(seen) => counts.iter_mut().zip(seen).for_each(|(sum, n)| *sum += n),
            Err(fault) => faults.push(fault),
        }
    }
    println!("body steps by micro, quasi-static, lockstep, none; outside the model: {counts:?}");
    assert!(faults.is_empty(), "{} scenes failed:\n{}", faults.len(), faults.join("\n"));
    let all: u64 = counts[..4].iter().sum();
    assert!(counts[4] * 1000 < all, "outside the model too often: {counts:?}");
    assert!(counts[..3].iter().all(|n| *n > 0), "a resolver never ran: {counts:?}");
}

/// Fails for a resolver that throws bodies, loses them below the ground, or makes them faster.
#[test]
fn nothing_is_thrown_or_sinks_through() {
    soak(0..4, 1.5);
}

#[test]
#[ignore = "half an hour on two cores; cargo test --release -p abrade-rapier3d --test contacts_f32 -- --ignored soak_of \
            --nocapture"]
fn soak_of_a_thousand_scenes() {
    let asked = std::env::var("SOAK").unwrap_or_else(|_| "0..1000".into());
    let (from, to) = asked.split_once("..").unwrap_or(("0", &asked));
    let [from, to] = [from, to].map(|n| n.parse().expect("SOAK=100 or SOAK=20..30"));
    soak(from..to, 10.0);
}
