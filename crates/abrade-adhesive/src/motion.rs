//! Velocity Verlet, drag, and what is held.

use multiversion::multiversion;

use crate::elements::Elements;
use crate::four::{Four, LANES};
use crate::lanes::{Sum, load, sides, store, take};
use crate::solid::Constants;

/// The first half of a step: velocities of its middle, and positions of its end. Sums of forces
/// begin anew.
#[multiversion(targets("x86_64+avx2"))]
pub(crate) fn begin(elements: &mut Elements, step: f64) {
    let count = elements.x.len();
    let (half, whole) = (Four::splat(0.5 * step), Four::splat(step));
    let drift = |place: &mut [f64], speed: &mut [f64], sum: &mut Sum, mobility: &[f64]| {
        let (place, mut sum) = (&mut place[..count], sides(sum, count));
        let (speed, mobility) = (&mut speed[..count], &mobility[..count]);
        for at in (0..count).step_by(LANES) {
            let new = load(speed, at) + half * (take(&mut sum, at) * load(mobility, at));
            let moved = load(place, at) + whole * new;
            store(speed, at, new);
            store(place, at, moved);
        }
    };
    drift(&mut elements.x, &mut elements.vx, &mut elements.force_x, &elements.mobility_x);
    drift(&mut elements.y, &mut elements.vy, &mut elements.force_y, &elements.mobility_y);
    let (spin, mobility) = (&mut elements.spin[..count], &elements.mobility_spin[..count]);
    let mut torque = sides(&mut elements.torque, count);
    for at in (0..count).step_by(LANES) {
        let new = load(spin, at) + half * (take(&mut torque, at) * load(mobility, at));
        store(spin, at, new);
    }
}

/// The second half of a step: velocities of its end.
#[multiversion(targets("x86_64+avx2"))]
pub(crate) fn end(elements: &mut Elements, step: f64) {
    let count = elements.x.len();
    let half = Four::splat(0.5 * step);
    let kick = |speed: &mut [f64], sum: &Sum, mobility: &[f64]| {
        let (speed, mobility) = (&mut speed[..count], &mobility[..count]);
        let (begun, ended) = (&sum[0][..count], &sum[1][..count]);
        for at in (0..count).step_by(LANES) {
            let force = load(begun, at) + load(ended, at);
            let new = load(speed, at) + half * (force * load(mobility, at));
            store(speed, at, new);
        }
    };
    kick(&mut elements.vx, &elements.force_x, &elements.mobility_x);
    kick(&mut elements.vy, &elements.force_y, &elements.mobility_y);
    kick(&mut elements.spin, &elements.torque, &elements.mobility_spin);
}

/// Work that the drives do in half a step, against the forces of now [J].
pub(crate) fn drive_work(elements: &Elements, step: f64) -> f64 {
    let power = |(at, hold): &(u32, crate::assembly::Hold)| {
        let at = *at as usize;
        let force = |sum: &Sum, held: bool| if held { sum[0][at] + sum[1][at] } else { 0.0 };
        let along = force(&elements.force_x, hold.x) * elements.vx[at];
        along + force(&elements.force_y, hold.y) * elements.vy[at]
    };
    -0.5 * step * elements.held.iter().map(power).sum::<f64>()
}

/// Takes their share off the velocities over those of the start; returns the energy that goes [J].
#[multiversion(targets("x86_64+avx2"))]
pub(crate) fn drag(elements: &mut Elements, constants: &Constants) -> f64 {
    let count = elements.x.len();
    let (vx, vy) = (&mut elements.vx[..count], &mut elements.vy[..count]);
    let (led_x, led_y) = (&elements.led_x[..count], &elements.led_y[..count]);
    let [drag_x, drag_y] = elements.drag.each_ref().map(|drag| &drag[..count]);
    let mut lost = Four::ZERO;
    for at in &elements.dragged {
        let at = *at as usize;
        let (old_x, old_y) = (load(vx, at), load(vy, at));
        let new_x = old_x - load(drag_x, at) * (old_x - load(led_x, at));
        let new_y = old_y - load(drag_y, at) * (old_y - load(led_y, at));
        store(vx, at, new_x);
        store(vy, at, new_y);
        lost += old_x * old_x + old_y * old_y - new_x * new_x - new_y * new_y;
    }
    0.5 * constants.mass * lost.sum()
}

/// Square of the highest speed [m2/s2] and whose it is; one that is not a number counts as the highest.
pub(crate) fn fastest(elements: &Elements) -> (f64, usize) {
    let mut highest = (0.0, 0);
    for at in 0..elements.count {
        let square = elements.vx[at] * elements.vx[at] + elements.vy[at] * elements.vy[at];
        if square > highest.0 {
            highest = (square, at);
        } else if square.is_nan() {
            return (f64::NAN, at);
        }
    }
    highest
}
