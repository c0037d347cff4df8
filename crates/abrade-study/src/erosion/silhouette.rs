//! Silhouettes of grains, and how spiky they are.

use std::f64::consts::{PI, TAU};

use abrade::{Piece, Shape};
use nalgebra::{Point2, UnitQuaternion, Vector2};

/// Directions in which a silhouette is looked at.
const DIRECTIONS: usize = 720;

/// Distance of the outline from the centre of mass, direction by direction all around [m]: of the shape,
/// so turned, seen along the z axis.
pub(super) fn profile(shape: &Shape, rotation: &UnitQuaternion<f64>) -> Vec<f64> {
    let mut radii = vec![0.0_f64; DIRECTIONS];
    for piece in shape.pieces() {
        match piece {
            Piece::Ball(ball) => {
                let centre = (rotation * ball.centre).xy();
                for (radius, direction) in radii.iter_mut().zip(directions()) {
                    *radius = radius.max(disc(&centre, ball.radius, &direction));
                }
            }
            Piece::Hull(hull) => {
                let corners: Vec<Point2<f64>> =
                    hull.vertices().iter().map(|corner| (rotation * corner).xy()).collect();
                for &[a, b, c] in hull.facets() {
                    for [a, b] in [[a, b], [b, c], [c, a]] {
                        edge(&mut radii, &corners[a as usize], &corners[b as usize]);
                    }
                }
            }
        }
    }
    radii
}

fn directions() -> impl Iterator<Item = Vector2<f64>> {
    (0..DIRECTIONS).map(|i| {
        let (sin, cos) = (TAU * i as f64 / DIRECTIONS as f64).sin_cos();
        Vector2::new(cos, sin)
    })
}

/// How far the ray along `direction` goes until it leaves a disc for good [m].
fn disc(centre: &Point2<f64>, radius: f64, direction: &Vector2<f64>) -> f64 {
    let along = centre.coords.dot(direction);
    let square = radius * radius - centre.coords.norm_squared() + along * along;
    if square < 0.0 { 0.0 } else { along + square.sqrt() }
}

/// Lengthens the rays that cross the edge from `a` to `b`.
fn edge(radii: &mut [f64], a: &Point2<f64>, b: &Point2<f64>) {
    let way = b - a;
    for (radius, direction) in radii.iter_mut().zip(directions()) {
        let across = direction.perp(&way);
        if across == 0.0 {
            continue;
        }
        let share = a.coords.perp(&direction) / across;
        if (0.0..=1.0).contains(&share) {
            *radius = radius.max((a.coords + way * share).dot(&direction));
        }
    }
}

/// The spike parameter: the mean over all stretches of the outline beyond the circle of the same area of
/// cos(theta / 2), theta being the angle at the farthest point of the stretch between parabolas through
/// its two sides; 0 where there are none.
pub(super) fn spike(profile: &[f64]) -> f64 {
    let count = profile.len();
    let circle = (profile.iter().map(|r| r * r).sum::<f64>() / count as f64).sqrt();
    // What is beyond by less is the round-off of a circle.
    let is_beyond = |i: usize| profile[i % count] > circle * (1.0 + 1e-9);
    let Some(start) = (0..count).find(|&i| !is_beyond(i)) else { return 0.0 };
    let mut spikes = Vec::new();
    let mut i = start;
    while i < start + count {
        if !is_beyond(i) {
            i += 1;
            continue;
        }
        let end = (i..start + count).find(|&k| !is_beyond(k)).unwrap_or(start + count);
        let top = (i..end).max_by(|&a, &b| profile[a % count].total_cmp(&profile[b % count]));
        let top = top.unwrap_or(i);
        let before: Vec<f64> = (i..=top).rev().map(|k| profile[k % count]).collect();
        let after: Vec<f64> = (top..end).map(|k| profile[k % count]).collect();
        let theta = PI - fall(&before) - fall(&after);
        spikes.push((theta / 2.0).cos().max(0.0));
        i = end;
    }
    if spikes.is_empty() { 0.0 } else { spikes.iter().sum::<f64>() / spikes.len() as f64 }
}

/// Angle by which the outline falls behind the circle about the centre at the first of the distances
/// `side` [rad]: of the parabola in the direction's angle that fits them and goes through the first.
fn fall(side: &[f64]) -> f64 {
    let [mut s2, mut s3, mut s4, mut y1, mut y2] = [0.0; 5];
    for (k, radius) in side.iter().enumerate() {
        let x = TAU * k as f64 / DIRECTIONS as f64;
        let y = radius - side[0];
        s2 += x * x;
        s3 += x * x * x;
        s4 += x * x * x * x;
        y1 += x * y;
        y2 += x * x * y;
    }
    let determinant = s2 * s4 - s3 * s3;
    if side.len() < 3 || determinant <= 0.0 {
        return 0.0;
    }
    let slope = (y1 * s4 - y2 * s3) / determinant;
    (-slope / side[0]).atan()
}

#[cfg(test)]
mod tests {
    use abrade::{Hull, cuboid_vertices};
    use nalgebra::Vector3;

    use super::*;

    fn spike_of(shape: &Shape) -> f64 {
        spike(&profile(shape, &UnitQuaternion::identity()))
    }

    /// Fails for a silhouette that is not the shape's, or a spike that does not tell a corner's angle:
    /// a square has four of 90 degrees, a circle none.
    #[test]
    fn a_square_has_spikes_and_a_circle_none() {
        let cube = cuboid_vertices(&Vector3::repeat(0.5));
        let cube = Shape::hull(Hull::solid(&cube, 1.0).expect("a cube").0);
        let radii = profile(&cube, &UnitQuaternion::identity());
        assert!((radii[0] - 0.5).abs() < 1e-12);
        assert!((radii[DIRECTIONS / 8] - 0.5f64.sqrt()).abs() < 1e-12);
        let square = spike(&radii);
        assert!((square - 0.5f64.sqrt()).abs() < 0.02, "{square}");
        assert_eq!(spike_of(&Shape::ball(1.0).expect("a ball")), 0.0);
    }
}
