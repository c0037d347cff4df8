//! Closed forms of unions of balls.

use std::f64::consts::PI;

use super::*;

fn ball(x: f64, y: f64, z: f64, radius: f64) -> Ball {
    Ball { centre: Point3::new(x, y, z), radius }
}

fn close(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{found} {expected}");
}

/// A ball twice in the same place is one ball, found by the grid: the closed form of a sphere.
#[test]
fn the_grid_finds_a_sphere() {
    let one = ball(3.0, -2.0, 7.0, 0.5);
    let found = UnionInertia::of_balls(&[one, one]).unwrap();
    let volume = 4.0 / 3.0 * PI * 0.125;
    close(found.volume, volume, 1e-5);
    close(found.tensor.trace(), 1.2 * volume * 0.25, 1e-5);
    assert!((found.centre - one.centre).norm() < 1e-5 * 0.5);
    assert!(found.error < 1e-4);
}

/// Two equal balls at distance d: the lens has volume pi (4R + d)(2R - d)^2 / 12.
#[test]
fn two_overlapping_spheres_lack_one_lens() {
    for (direction, d) in [(Vector3::x(), 1.0), (Vector3::z(), 1.5), (Vector3::repeat(0.4), 1.0)] {
        let r = 1.0;
        let d: f64 = direction.norm() * d;
        let far = Point3::from(direction.normalize() * d);
        let balls = [ball(0.0, 0.0, 0.0, r), Ball { centre: far, radius: r }];
        let found = UnionInertia::of_balls(&balls).unwrap();
        let lens = PI * (4.0 * r + d) * (2.0 * r - d).powi(2) / 12.0;
        close(found.volume, 2.0 * 4.0 / 3.0 * PI - lens, 1e-5);
        assert!((found.centre - nalgebra::center(&balls[0].centre, &far)).norm() < 1e-5);
        // About the axis: half of the union is the ball minus a cap of height c, whose moment
        // is pi/2 times the integral of (r^2 - t^2)^2 over t from r - c to r.
        let primitive = |t: f64| r.powi(4) * t - 2.0 * r * r * t.powi(3) / 3.0 + t.powi(5) / 5.0;
        let cap = PI / 2.0 * (primitive(r) - primitive(d / 2.0));
        let axis = direction.normalize();
        close(axis.dot(&(found.tensor * axis)), 2.0 * (8.0 / 15.0 * PI - cap), 1e-4);
    }
}

#[test]
fn disjoint_spheres_are_summed_exactly() {
    let balls = [ball(-2.0, 0.0, 0.0, 1.0), ball(2.0, 0.0, 0.0, 0.5)];
    let found = UnionInertia::of_balls(&balls).unwrap();
    let [a, b] = [1.0, 0.125].map(|cube| 4.0 / 3.0 * PI * cube);
    let own = 0.4 * (a + b * 0.25);
    close(found.volume, a + b, 1e-14);
    close(found.tensor[(0, 0)], own, 1e-13);
    close(found.tensor[(1, 1)], own + 16.0 * a * b / (a + b), 1e-13);
    close(found.centre.x, (-2.0 * a + 2.0 * b) / (a + b), 1e-13);
    assert_eq!(found.error, 0.0);
}

#[test]
fn a_far_origin_and_a_stray_ball_change_nothing() {
    let pair = [ball(0.0, 0.0, 0.0, 1.0), ball(0.9, 0.2, 0.1, 0.7)];
    let near = UnionInertia::of_balls(&pair).unwrap();
    let far = pair.map(|b| Ball { centre: b.centre + Vector3::repeat(1e6), ..b });
    close(UnionInertia::of_balls(&far).unwrap().tensor.trace(), near.tensor.trace(), 1e-6);
    let stray = [pair[0], pair[1], ball(1e9, 0.0, 0.0, 1e-3)];
    close(UnionInertia::of_balls(&stray).unwrap().volume, near.volume, 1e-6);
}

#[test]
fn pairs_are_those_closer_than_their_radii() {
    let row: Vec<Ball> = (0..5).map(|i| ball(f64::from(i) * 1.5, 0.0, 0.0, 1.0)).collect();
    assert_eq!(overlapping_pairs(&row), [[0, 1], [1, 2], [2, 3], [3, 4]]);
    assert!(UnionInertia::of_balls(&[]).is_err());
    assert!(UnionInertia::of_balls(&[ball(0.0, 0.0, f64::NAN, 1.0)]).is_err());
}

/// Fails for a union whose volume or inertia has overflowed or vanished, and for a radius that is
/// blamed for a place.
#[test]
fn sizes_that_no_number_can_say_are_refused() {
    for radius in [1e-60, 1e60] {
        assert!(UnionInertia::of_balls(&[ball(0.0, 0.0, 0.0, radius)]).is_ok());
    }
    let extreme = [ball(0.0, 0.0, 0.0, 1e-300), ball(1e-300, 0.0, 0.0, 1e200)];
    let far = [ball(0.0, 0.0, 0.0, 1.0), ball(0.0, -1e200, 0.0, 2.0)];
    for (balls, blamed) in [
        (&extreme[..1], ("radius", 1e-300)),
        (&extreme[1..], ("radius", 1e200)),
        (&extreme, ("radius", 1e200)),
        (&far, ("centre", -1e200)),
    ] {
        let refused = UnionInertia::of_balls(balls);
        let Err(ShapeError::Parameter(ParameterError { field, value, .. })) = refused else {
            panic!("{refused:?}");
        };
        assert_eq!((field, value), blamed);
    }
}
