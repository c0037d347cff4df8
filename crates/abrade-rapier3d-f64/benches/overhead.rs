//! What a wear surface costs a world of which no body touches it: the same world stepped with and
//! without the plug-in, in turn, and the ratio of the two times.
//!
//! `cargo bench -p abrade-rapier3d-f64 --bench overhead` prints, for a crowd far from the plate
//! and one right above it, the median of the ratios of paired runs, and the ratio of the least
//! times, which other work on the machine lengthens least; then the least time of a step with one
//! ball that lies on the plate and may not sleep, alone and in a crowd.

use std::time::{Duration, Instant};

use abrade_rapier3d_f64::abrade::{HexStrip, Material, Surface, SurfaceLaws};
use abrade_rapier3d_f64::rapier::math::Vector;
use abrade_rapier3d_f64::rapier::prelude::*;
use abrade_rapier3d_f64::{WearSettings, WearWorld};

/// Steps per run, and pairs of runs.
const STEPS: usize = 20;
const PAIRS: usize = 150;
/// Radius of a body, and the distance of neighbours [m].
const RADIUS: f64 = 0.05;
const SPACING: f64 = 0.2;

fn main() {
    println!("  bodies  height  us/step    median  of least");
    for count in [100, 1000] {
        for height in [50.0, 2.0] {
            let Overhead { step, median, of_least } = overhead(count, height);
            println!("{count:>8} {height:>5} m {step:>8.1} {median:>9.4} {of_least:>9.4}");
        }
    }
    println!("one resting ball: {:.1} us/step", resting_ball(0));
    println!("with 1000 bodies far away: {:.1} us/step", resting_ball(1000));
}

/// Least time of a step in which one ball rests on the plate, and a crowd is far away [us].
fn resting_ball(crowd_size: usize) -> f64 {
    let mut world = crowd(crowd_size, 50.0);
    for (_, rb) in world.bodies.iter_mut() {
        rb.set_gravity_scale(0.0, false);
    }
    world.gravity = Vector::Z * -9.81;
    let mut wear = plate(&mut world);
    let body = RigidBodyBuilder::dynamic().translation(Vector::Z * RADIUS).can_sleep(false);
    world.insert(body, ColliderBuilder::ball(RADIUS));
    let mut step = || {
        timed(|| {
            wear.step(&mut world, &(), &()).expect("a step at rest");
        })
    };
    let least = (0..PAIRS).map(|_| step()).min().unwrap_or_default();
    assert!(wear.counters().quasi_static > 0 && wear.counters().steps == 0);
    least.as_secs_f64() * 1e6 / STEPS as f64
}

/// Time of a step without the plug-in [us], and ratios with / without.
struct Overhead {
    step: f64,
    median: f64,
    of_least: f64,
}

fn overhead(count: usize, height: f64) -> Overhead {
    let (mut plain, mut worn) = (crowd(count, height), crowd(count, height));
    let mut wear = plate(&mut worn);
    let _ = plate(&mut plain);
    let mut without = || timed(|| plain.step());
    let mut with = || {
        timed(|| {
            wear.step(&mut worn, &(), &()).expect("a step in which nothing touches");
        })
    };
    // What is looked at once is no part of a step's cost.
    with();
    let (mut ratios, mut least) = (Vec::new(), [f64::INFINITY; 2]);
    for pair in 0..PAIRS {
        let times = match pair % 2 {
            0 => [without(), with()],
            _ => {
                let with = with();
                [without(), with]
            }
        };
        let [without, with] = times.map(|time| time.as_secs_f64());
        least = [least[0].min(without), least[1].min(with)];
        ratios.push(with / without);
    }
    ratios.sort_by(f64::total_cmp);
    assert_eq!(wear.counters().micro + wear.counters().refused, 0);
    let step = least[0] * 1e6 / STEPS as f64;
    Overhead { step, median: ratios[PAIRS / 2], of_least: least[1] / least[0] }
}

fn timed(mut step: impl FnMut()) -> Duration {
    let start = Instant::now();
    (0..STEPS).for_each(|_| step());
    start.elapsed()
}

/// Awake balls on a grid that begins at `height` [m], drifting without gravity.
fn crowd(count: usize, height: f64) -> PhysicsWorld {
    let mut world = PhysicsWorld { gravity: Vector::ZERO, ..PhysicsWorld::default() };
    for number in 0..count {
        let at = |digit: usize| SPACING * (number / 10usize.pow(digit as u32) % 10) as f64;
        let body = RigidBodyBuilder::dynamic()
            .translation(Vector::new(at(0) - 1.0, at(1) - 1.0, height + at(2)))
            .linvel(Vector::new(1e-2, 0.0, 0.0))
            .can_sleep(false);
        world.insert(body, ColliderBuilder::ball(RADIUS));
    }
    world
}

fn plate(world: &mut PhysicsWorld) -> WearWorld {
    let material = Material {
        hardness: 6.6e9,
        shear_ratio: 0.25,
        young: Some(200e9),
        poisson: 0.3,
        friction: 0.5,
    };
    let laws = SurfaceLaws::of(material);
    let strip = HexStrip::with_nodes(2.0, 2.0, 1e4);
    let surface = Surface::hex_strip(strip, laws).expect("a plate");
    let proxy = ColliderBuilder::cuboid(1.0, 1.0, 0.01).translation(Vector::Z * -0.01);
    let proxy = world.colliders.insert(proxy);
    let mut wear = WearWorld::new(WearSettings::default());
    wear.insert_on_top(surface, proxy, &mut world.colliders).expect("a proxy");
    wear
}
