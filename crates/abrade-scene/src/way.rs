//! Whether bodies come to a surface on their way, as far as that is plain before anything runs: where all surfaces
//! are plates at rest. What other bodies do to them is not asked.

use abrade::State;
use nalgebra::Vector3;

use crate::check::Checked;
use crate::place;
use crate::scene::{Motion, SurfaceMotion};
use crate::spans::path;

/// What to say of bodies that come to no plate.
pub(crate) fn notes(checked: &Checked) -> Vec<String> {
    let scene = &checked.scene;
    let is_at_rest = |motion: &SurfaceMotion| *motion == SurfaceMotion::Fixed;
    let is_plate = |name: &String| !checked.meshes.contains_key(name);
    if !scene.surfaces.iter().all(|(name, surface)| is_plate(name) && is_at_rest(&surface.motion)) {
        return Vec::new();
    }
    let misses = |name: &String| comes(checked, name) == Some(false);
    let bodies = scene.bodies.keys().filter(|name| !checked.is_streamed(name) && misses(name));
    let streams = checked.streamed.iter().filter(|(_, names)| names.iter().all(misses));
    let bodies = bodies.map(|name| format!("`{}` comes", path(&["bodies", name])));
    let streams =
        streams.map(|(name, _)| format!("no body of `{}` comes", path(&["streams", name])));
    let told = |(what, to)| {
        format!("{what} to {to} plate on its way: it goes past, moves away, or stays where it is")
    };
    bodies.map(|what| (what, "no")).chain(streams.map(|what| (what, "a"))).map(told).collect()
}

/// Whether the body called `name` comes to a plate; none for one that does not fly.
pub(crate) fn comes(checked: &Checked, name: &String) -> Option<bool> {
    let body = checked.scene.bodies.get(name)?;
    if matches!(body.motion, Motion::Fixed | Motion::Drive { .. }) {
        return None;
    }
    let solid = checked.solids.get(name)?;
    let start = checked.start(body, solid)?;
    let reach = solid.shape.bounding_radius();
    let gravity = Vector3::from(checked.scene.gravity);
    let comes = checked.scene.surfaces.values().any(|surface| {
        let plate = place::strip(&surface.geometry).zip(place::home(surface));
        // A plate of which this is not known is taken for one that is met.
        let Some((strip, frame)) = plate else { return true };
        let half = Vector3::new(
            0.5 * strip.length + strip.pitch + reach,
            0.5 * strip.width + strip.pitch + reach,
            place::node_height(surface) + reach,
        );
        enters(&start.seen_from(&frame), &frame.inverse_transform_vector(&gravity), &half)
    });
    Some(comes)
}

/// True where a centre in free fall comes within `half` of the origin, along each axis [m].
fn enters(start: &State, gravity: &Vector3<f64>, half: &Vector3<f64>) -> bool {
    let (position, velocity) = (start.position.coords, start.velocity);
    // Between two of the instants at which it passes a side of the box it is inside all the time, or outside.
    let mut instants = vec![0.0];
    for axis in 0..3 {
        for side in [-half[axis], half[axis]] {
            let passed = roots(0.5 * gravity[axis], velocity[axis], position[axis] - side);
            instants.extend(passed.into_iter().filter(|time| *time > 0.0 && time.is_finite()));
        }
    }
    instants.sort_by(f64::total_cmp);
    let last = instants[instants.len() - 1];
    instants.push(2.0 * last + 1.0);
    instants.windows(2).any(|pair| {
        let time = 0.5 * (pair[0] + pair[1]);
        let place = position + velocity * time + gravity * (0.5 * time * time);
        (0..3).all(|axis| place[axis].abs() <= half[axis])
    })
}

/// Where a t^2 + b t + c is zero; not a number where it is not.
fn roots(a: f64, b: f64, c: f64) -> [f64; 2] {
    // No difference of near numbers: the second root comes from the product of both.
    let sum = -0.5 * (b + (b * b - 4.0 * a * c).sqrt().copysign(b));
    [sum / a, c / sum]
}

#[cfg(test)]
mod tests {
    use nalgebra::Point3;

    use super::*;

    /// Fails for a body that is taken for one that misses though it comes from beside, is thrown up or falls, and for
    /// one that is not though it goes past a side, below, or away.
    #[test]
    fn a_body_comes_to_a_plate_or_misses_it() {
        let half = Vector3::new(2.0, 1.0, 0.1);
        let enters = |at: [f64; 3], velocity: [f64; 3], gravity: f64| {
            let velocity = Vector3::from(velocity);
            let start = State { velocity, ..State::at(Point3::from(at)) };
            enters(&start, &Vector3::new(0.0, 0.0, gravity), &half)
        };
        for (at, velocity, gravity) in [
            ([0.0, 0.0, 1.0], [0.0, 0.0, -1.0], 0.0),
            ([-5.0, 0.0, 1.0], [4.0, 0.0, -1.0], 0.0),
            ([0.0, 0.0, 1.0], [0.0; 3], -9.81),
            // Up for a second, down for as long, 4 m farther.
            ([-5.0, 0.0, 0.1], [2.0, 0.0, 9.81], -9.81),
            ([0.0, 0.0, 0.1], [0.0; 3], 0.0),
        ] {
            assert!(enters(at, velocity, gravity), "{at:?} {velocity:?}");
        }
        for (at, velocity, gravity) in [
            ([3.0, 0.0, 1.0], [0.0, 0.0, -1.0], 0.0),
            ([3.0, 0.0, 1.0], [1.0, 0.0, -1.0], 0.0),
            ([-5.0, 0.0, 1.0], [4.0, 2.0, -1.0], 0.0),
            ([-5.0, 0.0, 1.0], [1.0, 0.0, -1.0], 0.0),
            ([-5.0, 0.0, 0.1], [1.0, 0.0, 9.81], -9.81),
            ([0.0, 0.0, 1.0], [0.0, 0.0, 1.0], 0.0),
        ] {
            assert!(!enters(at, velocity, gravity), "{at:?} {velocity:?}");
        }
    }
}
