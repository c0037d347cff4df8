//! Paths against their closed forms.

use super::*;

const SWING: Swing = Swing { frequency: 5.0, phase: 0.3 };

fn home() -> Isometry3<f64> {
    Isometry3::new(Vector3::new(1.0, 2.0, 3.0), Vector3::new(0.2, -0.4, 0.6))
}

fn point(time: f64, shift: [f64; 3], turn: [f64; 3]) -> Waypoint {
    let rotation = UnitQuaternion::from_scaled_axis(Vector3::from(turn));
    Waypoint { time, shift: shift.into(), rotation }
}

fn through(points: Vec<Waypoint>, repeat: bool) -> LedPath {
    LedPath::new(home(), Way::Through(Legs::new(points, repeat).expect("legs")))
}

/// There and back, with a quarter turn.
fn loop_of_two() -> Vec<Waypoint> {
    vec![
        point(1.0, [0.0; 3], [0.0; 3]),
        point(2.0, [4.0, 0.0, 0.0], [0.0, 0.0, 0.5 * PI]),
        point(4.0, [0.0; 3], [0.0; 3]),
    ]
}

/// Fails for a velocity that is not the derivative of the place: a lost phase, a degree for a
/// radian, a turn in the frame's own axes.
#[test]
fn the_velocity_is_the_rate_of_the_place() {
    let axis = Unit::new_normalize(Vector3::new(1.0, 2.0, -2.0));
    let paths = [
        LedPath::new(home(), Way::Reciprocating(Vector3::new(0.1, -0.2, 0.3), SWING)),
        LedPath::new(home(), Way::Rocking(axis, 0.7, SWING)),
        through(loop_of_two(), true),
        through(loop_of_two(), false),
    ];
    for path in &paths {
        for time in [0.11, 1.37, 2.9, 5.2, 17.83] {
            let step = 1e-6;
            let [before, after] = [path.at(time - step), path.at(time + step)];
            let velocity = (after.translation.vector - before.translation.vector) / (2.0 * step);
            let turn = (after.rotation * before.rotation.inverse()).scaled_axis();
            let [v, spin] = path.velocity_spin(time);
            // The third derivatives are below 1e5.
            assert!((velocity - v).norm() < 1e-6, "{time}: {velocity} {v}");
            assert!((turn / (2.0 * step) - spin).norm() < 1e-6, "{time}: {turn} {spin}");
        }
    }
}

/// Fails for a path that moves before its first point or after its last, wraps late or not at all,
/// or turns the long way around.
#[test]
fn a_path_waits_goes_straight_and_begins_again() {
    let along = |path: &LedPath, time: f64| {
        let moved = path.at(time).translation.vector - home().translation.vector;
        let turn = (path.at(time).rotation * home().rotation.inverse()).scaled_axis();
        (moved.x, turn.z)
    };
    let [once, again] = [false, true].map(|repeat| through(loop_of_two(), repeat));
    let quarter = 0.5 * PI;
    for (time, x, z) in [(0.0, 0.0, 0.0), (1.25, 1.0, 0.25), (2.0, 4.0, 1.0), (3.5, 1.0, 0.25)] {
        for path in [&once, &again] {
            let (moved, turn) = along(path, time);
            assert!((moved - x).abs() < 1e-12 && (turn - z * quarter).abs() < 1e-12, "{time}");
        }
    }
    assert!(along(&once, 4.25).0.abs() < 1e-12 && once.is_over(4.0) && !once.is_over(3.9));
    assert!((along(&again, 4.25).0 - 1.0).abs() < 1e-12 && !again.is_over(1e6));
    assert!((along(&again, 3001.0 + 0.25).0 - 1.0).abs() < 1e-9);
    let corners = [(0.0, 1.0), (1.0, 1.0), (1.5, 0.5), (2.0, 2.0), (2.0 - 1e-12, 2.0)];
    for (time, until) in corners {
        assert!((again.until_corner(time, 1e-9) - until).abs() < 1e-9, "{time}");
    }
    assert!((again.until_corner(4.0, 1e-9) - 1.0).abs() < 1e-12);
    assert!((again.until_corner(4.0 - 1e-12, 1e-9) - 1.0).abs() < 1e-9);
    assert_eq!(once.until_corner(4.0, 1e-9), f64::INFINITY);
}

/// Fails for a box that leaves out an end of the stroke, or where a turn takes a corner.
#[test]
fn the_swept_box_holds_every_place() {
    let corners = [Point3::new(-0.3, -0.2, -0.1), Point3::new(0.5, 0.2, 0.0)];
    let axis = Unit::new_normalize(Vector3::new(0.0, 1.0, 1.0));
    let line = vec![point(0.0, [0.0; 3], [0.3; 3]), point(1.0, [1.0, -2.0, 3.0], [0.3; 3])];
    let paths = [
        LedPath::new(home(), Way::Reciprocating(Vector3::new(0.1, -0.2, 0.3), SWING)),
        LedPath::new(home(), Way::Rocking(axis, 2.0, SWING)),
        through(loop_of_two(), true),
        through(line, false),
    ];
    for path in &paths {
        let [low, high] = path.swept(&corners);
        for i in 0..1000 {
            let frame = path.at(0.005 * f64::from(i));
            for corner in 0..8 {
                let pick = |axis: usize| corners[corner >> axis & 1][axis];
                let at = frame * Point3::new(pick(0), pick(1), pick(2));
                let inside = (0..3).all(|k| low[k] - 1e-12 <= at[k] && at[k] <= high[k] + 1e-12);
                assert!(inside, "{at} {low} {high}");
            }
        }
    }
}

/// Fails for a path that jumps, whose order is not that of its times, or whose turn is a guess.
#[test]
fn what_is_no_path_is_refused() {
    let fault = |points: Vec<Waypoint>, repeat| Legs::new(points, repeat).expect_err("a fault");
    let start = point(0.0, [0.0; 3], [0.0; 3]);
    let far = point(1.0, [1.0, 0.0, 0.0], [0.0; 3]);
    assert_eq!(fault(vec![start], false), PathFault::TooFew);
    assert_eq!(fault(vec![start, far, far], false), PathFault::NotLater(2));
    assert_eq!(fault(vec![start, far], true), PathFault::Open);
    let turned = point(2.0, [0.0; 3], [0.0, PI, 0.0]);
    assert_eq!(fault(vec![start, turned], false), PathFault::HalfTurn(1));
    let skew = point(2.0, [0.0; 3], [0.0, 0.1, 0.0]);
    assert_eq!(fault(vec![start, skew], true), PathFault::Open);
}
