//! A hail: 1000 balls that rain on one plate of 1e5 nodes; a ball that has struck begins anew from
//! above. Impacts per second, Rapier's whole step included, on one thread and on two.
//!
//! `cargo bench -p abrade-rapier3d-f64 --bench hail` prints the best of some rounds, in turn on
//! one thread and on two.

use std::time::Instant;

use abrade_rapier3d_f64::abrade::{
    ElasticLaw, HertzConvention, HexStrip, Material, Surface, SurfaceLaws,
};
use abrade_rapier3d_f64::rapier::math::Vector;
use abrade_rapier3d_f64::rapier::prelude::*;
use abrade_rapier3d_f64::{WearEvent, WearSettings, WearWorld};

const BALLS: usize = 1000;
const NODES: f64 = 1e5;
/// Edge of the plate [m].
const EDGE: f64 = 0.35;
const RADIUS: f64 = 3e-3;
const NODE_RADIUS: f64 = 0.25e-3;
const DENSITY: f64 = 2500.0;
/// Speed of the balls [m/s].
const SPEED: f64 = 35.0;
/// Step of the embedder [s], how many it takes a ball to come down, and how many are timed.
const DT: f64 = 1.0 / 240.0;
const FALL: usize = 12;
const STEPS: usize = 60;
const ROUNDS: usize = 5;

/// What a hail did.
struct Hail {
    seconds: f64,
    impacts: usize,
    refused: u64,
    failed: usize,
    evaluations: u64,
}

fn main() {
    let pools = [1, 2].map(|threads| {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool")
    });
    println!("balls               threads  impacts  refused  failed  nodes/impact   ms  impacts/s");
    for (name, collide) in [("hit each other", true), ("pass each other", false)] {
        let mut best: [Option<Hail>; 2] = [None, None];
        for _ in 0..ROUNDS {
            for (pool, best) in pools.iter().zip(&mut best) {
                let hail = pool.install(|| hail(collide));
                if best.as_ref().is_none_or(|best| hail.seconds < best.seconds) {
                    *best = Some(hail);
                }
            }
        }
        let rates = [1, 2].map(|threads| {
            let Some(Hail { seconds, impacts, refused, failed, evaluations }) = &best[threads - 1]
            else {
                return 0.0;
            };
            let (ms, rate) = (1e3 * seconds, *impacts as f64 / seconds);
            let each = *evaluations / (*impacts).max(1) as u64;
            print!("{name:<20}{threads:>7} {impacts:>8} {refused:>8} {failed:>7}");
            println!(" {each:>13} {ms:>4.0} {rate:>10.0}");
            rate
        });
        println!("two threads over one: {:.2}", rates[1] / rates[0]);
    }
}

/// Balls that are each aimed at a spot of the plate at a time of its own.
fn hail(collide: bool) -> Hail {
    let mut world = PhysicsWorld { gravity: Vector::Z * -9.81, ..PhysicsWorld::default() };
    world.integration_parameters.dt = DT;
    world.integration_parameters.length_unit = 0.01;
    world.integration_parameters.normalized_max_linear_velocity = 1e5;
    let half = 0.5 * EDGE;
    let proxy = ColliderBuilder::cuboid(half, half, 0.01).translation(Vector::Z * -0.01);
    let proxy = world.colliders.insert(proxy);
    let mut wear = WearWorld::new(WearSettings { accuracy: 3e-3, ..WearSettings::default() });
    wear.insert_on_top(plate(), proxy, &mut world.colliders).expect("a proxy");
    let filter = if collide { Group::ALL } else { Group::GROUP_1 };
    let groups = InteractionGroups::new(Group::GROUP_2, filter, InteractionTestMode::And);
    let mut seed = 1;
    for number in 0..BALLS {
        let (at, velocity) = aimed(DT * FALL as f64 * number as f64 / BALLS as f64, &mut seed);
        let body = RigidBodyBuilder::dynamic().translation(at).linvel(velocity);
        let ball = ColliderBuilder::ball(RADIUS).density(DENSITY).collision_groups(groups);
        world.insert(body, ball);
    }
    let (mut impacts, mut failed, mut struck) = (0, 0, Vec::new());
    let start = Instant::now();
    for _ in 0..STEPS {
        // A ball that another one has thrown over the plate's edge is an error: it begins anew.
        failed += usize::from(wear.step(&mut world, &(), &()).is_err());
        for event in wear.events() {
            match event {
                WearEvent::Ended { body, .. } => struck.push((*body, 1)),
                WearEvent::NotResolved { body, .. } | WearEvent::Failed { body, .. } => {
                    struck.push((*body, 0))
                }
                _ => {}
            }
        }
        let lost =
            |(handle, body): (_, &RigidBody)| (body.translation().z < 0.0).then_some((handle, 0));
        struck.extend(world.bodies.iter().filter_map(lost));
        for (body, count) in struck.drain(..) {
            impacts += count;
            let (at, velocity) = aimed(DT * (FALL as f64 - 1.0), &mut seed);
            let body = &mut world.bodies[body];
            body.set_translation(at, true);
            body.set_linvel(velocity, true);
            body.set_angvel(Vector::ZERO, true);
        }
    }
    let (seconds, counters) = (start.elapsed().as_secs_f64(), wear.counters());
    Hail {
        seconds,
        impacts,
        refused: counters.refused,
        failed,
        evaluations: counters.node_evaluations,
    }
}

/// Where a ball is `time` [s] before it strikes, within a step, and its velocity.
fn aimed(time: f64, seed: &mut u64) -> (Vector, Vector) {
    let [x, y, later] = [(); 3].map(|()| random(seed) - 0.5);
    let spot = Vector::new(0.9 * EDGE * x, 0.9 * EDGE * y, RADIUS + NODE_RADIUS + 1e-6);
    let (sin, cos) = 60f64.to_radians().sin_cos();
    let velocity = SPEED * Vector::new(cos, 0.0, -sin);
    (spot - velocity * (time + DT * (later + 0.5)), velocity)
}

/// A number in [0, 1) from a seed that goes on.
fn random(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
    (*seed >> 11) as f64 / (1u64 << 53) as f64
}

fn plate() -> Surface {
    let material = Material {
        hardness: 6.6e9,
        shear_ratio: 0.25,
        young: Some(200e9),
        poisson: 0.3,
        friction: 0.5,
    };
    let convention = HertzConvention::ElasticPair;
    let elastic = ElasticLaw::HertzNodes { node_radius: NODE_RADIUS, convention };
    let laws = SurfaceLaws { elastic, ..SurfaceLaws::of(material) };
    Surface::hex_strip(HexStrip::with_nodes(EDGE, EDGE, NODES), laws).expect("a plate")
}
