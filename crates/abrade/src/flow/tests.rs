//! How far nodes sink, against closed forms.

use super::*;
use crate::body::State;
use crate::clump_query::ClumpQuery;
use crate::elastic::Foundation;
use crate::ground::Flat;
use crate::node_law::{Answer, Motion, resolve};
use crate::query::{BallQuery, Contactor};
use crate::shape::{Ball, Piece};
use nalgebra::Point3;

const AREA: f64 = 1e-4;

/// A unit ball whose centre is at `centre`, on a foundation of 1e3 Pa/m.
fn ball(centre: Point3<f64>) -> BallQuery {
    let ball = Ball { centre: Point3::origin(), radius: 1.0 };
    let mut query = BallQuery::new(&ball, 1e3, 0.0);
    query.place(&State::at(centre));
    query
}

fn node<'a>(query: &'a BallQuery, x: Point3<f64>) -> NodeStep<'a, Foundation, BallQuery> {
    NodeStep {
        query,
        elastic: Foundation::new(0.3),
        x,
        n: Vector3::z(),
        area: AREA,
        friction: 0.0,
        heading: Vector3::zeros(),
        trial_stretch: Vector3::zeros(),
    }
}

/// Fails for a node that sinks too far, too little, or ahead of the body.
#[test]
fn a_node_under_a_ball_keeps_the_hardness_and_no_more() {
    let flow = CapozzaHanley::<Projected> {
        hardness: 1.0,
        shear_hardness: 0.25,
        lateral: Default::default(),
    };
    // Pressed in by 10 mm in one step from touch; the hardness allows 1 mm of overlap.
    let query = ball(Point3::new(0.0, 0.0, 0.99));
    let zero = Vector3::zeros();
    let motion = Motion { velocity: -Vector3::z(), spin: zero, drag: None, dt: 0.01 };
    let answer =
        resolve(Flat, &flow, &mut node(&query, Point3::origin()), &Spring::default(), &motion);
    let spring = answer.expect("a contact").spring;
    assert!((spring.normal_load / AREA - 1.0).abs() < 1e-8);
    assert!((spring.drop.normal - 9e-3).abs() < 1e-10 && spring.drop.lateral == 0.0);
    // At half the way the body cannot have pushed it down by more than it moved itself.
    let motion = Motion { dt: 0.004, ..motion };
    let old = Spring { overlap: 6e-3, normal_load: AREA, ..Spring::default() };
    let answer = resolve(Flat, &flow, &mut node(&query, Point3::origin()), &old, &motion);
    assert_eq!(answer.expect("a contact").spring.drop.normal, 0.004);
}

/// Fails for an Eq. 5 that is not the drop onto the moved sphere in the plane of motion, or that
/// takes the height of a body that comes down as it is at the end of the step.
#[test]
fn eq5_is_the_exact_drop_in_the_plane_of_motion() {
    let query = ball(Point3::new(0.0, 0.0, 0.9));
    let below = |x: f64| 0.9 - (1.0 - x * x).sqrt();
    let x = 0.2;
    // The body moves by dx along and comes down by `down`; the node sinks with it if it may.
    let drop = |dx: f64, down: f64, sinking: f64| {
        let advance = Advance {
            step: Vector3::new(dx, 0.0, -down),
            share: 1.0,
            was_in_contact: true,
            overlap_change: 0.0,
        };
        let start = node(&query, Point3::new(x, 0.0, below(x) + down)).at(0.0);
        Eq5::advance(&start, &advance, [&Vector3::x(), &Vector3::z()], sinking)
    };
    for dx in [1e-1, 1e-3, 1e-5] {
        let exact = below(x) - below(x - dx);
        for down in [0.0, 1e-3] {
            let miss = drop(dx, down, down) / exact - 1.0;
            assert!(miss.abs() < 1e-9, "{dx} {down}: {miss:e}");
        }
    }
}

/// Fails for a gate that counts the closed part of a step.
#[test]
fn the_lateral_gate_counts_the_open_share_of_a_step() {
    let cases = [(1.0, 1.0, 1.0), (-1.0, 3.0, 0.75), (3.0, -1.0, 0.75), (-1.0, -1.0, 0.0)];
    for (before, after, share) in cases {
        assert_eq!(open_share(before, after), share, "{before} {after}");
    }
}

/// Fails for a node that goes on sinking aside when friction alone holds it, and gains energy.
#[test]
fn a_node_that_friction_pulls_up_does_not_sink_aside() {
    let (hardness, shear_hardness) = (1e3, 1e-3);
    let flow = CapozzaHanley::<Projected> { hardness, shear_hardness, lateral: Default::default() };
    let query = ball(Point3::new(0.0, 0.0, 0.4));
    let mut node = NodeStep { friction: 2.0, ..node(&query, Point3::new(0.9, 0.0, 0.0)) };
    node.heading = Vector3::x();
    let motion = Motion { velocity: Vector3::x(), spin: Vector3::zeros(), drag: None, dt: 1e-2 };
    let old = Spring { overlap: 6e-3, normal_load: AREA, ..Spring::default() };
    let old = Spring { excess: Excess { normal: -1.0, lateral: 1e-3 }, ..old };
    let spring = resolve(Flat, &flow, &mut node, &old, &motion).expect("a contact").spring;
    assert!(spring.drop.lateral > 0.0, "{spring:?}");
    assert!(spring.normal_load > -1e-9 * spring.tangential_force, "{spring:?}");
}

/// What becomes of a node at the origin on which the first of two balls comes down: each ball by x and z
/// of its centre and its radius.
fn between(balls: [[f64; 3]; 2], hardness: f64) -> Answer {
    let piece = |[x, z, radius]: [f64; 3]| Contactor {
        piece: Piece::Ball(Ball { centre: Point3::new(x, 0.0, z), radius }),
        coefficient: 1e3,
    };
    let mut query = ClumpQuery::new(&balls.map(piece), 0.0);
    query.place(&State::at(Point3::origin()));
    let ball = ball(Point3::origin());
    let NodeStep { elastic, x, n, area, friction, heading, trial_stretch, .. } =
        node(&ball, Point3::origin());
    let query = &query;
    let mut node = NodeStep { query, elastic, x, n, area, friction, heading, trial_stretch };
    let motion = Motion { velocity: -Vector3::z(), spin: Vector3::zeros(), drag: None, dt: 0.05 };
    let flow = NormalPressure { hardness };
    resolve(Flat, &flow, &mut node, &Spring::default(), &motion).expect("a contact")
}

/// Fails for a node between two balls of a clump that is pushed into the lower one.
#[test]
fn a_node_sinks_no_farther_than_to_the_next_piece_below_it() {
    let answer = between([[0.0, 0.95, 1.0], [0.0, -0.6, 0.57]], 0.1);
    // Half-way between the overlaps: 50 mm with the upper ball, 30 mm off the lower one.
    assert!((answer.spring.drop.normal - 0.04).abs() < 1e-9, "{:?}", answer.spring);
    assert!(answer.loaded.cosine > STEEP && answer.spring.normal_load > 0.0);
}

/// Fails for a search that looks beyond another ball, below whose top the node would be pressed as
/// well, and harder than by the one that it gets away from.
#[test]
fn a_node_on_its_way_down_does_not_pass_through_another_piece() {
    let drop = between([[0.62, 0.325, 1.0], [-0.25, -0.5, 0.3]], 1.0).spring.drop.normal;
    let upper = 1.0 - 0.62f64.hypot(0.325 + drop);
    let lower = 0.3 - 0.25f64.hypot(0.5 - drop);
    assert!((upper - lower).abs() < 1e-9 && upper > 0.03, "{drop}: {upper} {lower}");
}

/// Depth to which a ball that comes down, slides by and leaves takes a node, in `count` steps.
fn depth_after(count: u32) -> f64 {
    let (hardness, shear_hardness) = (1.0, 0.25);
    let flow = CapozzaHanley::<Projected> { hardness, shear_hardness, lateral: Default::default() };
    let dt = 2.0 / f64::from(count);
    let centre = |i: u32| {
        let t = dt * f64::from(i);
        Point3::new(0.25 * t, 0.0, 1.001 - 0.04 * (1.0 - (t - 1.0).powi(2)))
    };
    let (mut old, mut depth) = (Spring::default(), 0.0);
    for i in 0..count {
        let query = ball(centre(i + 1));
        let velocity = (centre(i + 1) - centre(i)) / dt;
        let motion = Motion { velocity, spin: Vector3::zeros(), drag: None, dt };
        let mut node = node(&query, Point3::new(0.15, 0.0, -depth));
        node.heading = Vector3::x();
        let answer = resolve(Flat, &flow, &mut node, &old, &motion);
        old = answer.map_or_else(Spring::default, |answer| answer.spring);
        depth += old.drop.normal + old.drop.lateral;
    }
    depth
}

/// Fails where gates that open within a step let a node sink as if they had been open all of
/// it, and where one is paid what the other has done: the depth then is off by a step's way.
#[test]
fn the_depth_under_both_gates_converges_faster_than_the_step() {
    let finest = depth_after(25_600);
    let errors = [50, 100, 400, 1600].map(|count| (depth_after(count) - finest).abs());
    assert!(errors[0] < 3e-3 * finest, "{errors:?}");
    let order = (errors[0] / errors[3]).ln() / 32f64.ln();
    assert!(order > 1.5, "{order}: {errors:?}");
}
