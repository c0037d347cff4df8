//! Velocity Verlet, drag, and what is held.

use wide::f64x4;

use crate::elements::Elements;
use crate::lanes::{LANES, load, store};
use crate::solid::Constants;

/// Half a step of the velocities.
pub(crate) fn kick(elements: &mut Elements, step: f64) {
    let half = f64x4::splat(0.5 * step);
    for at in (0..elements.x.len()).step_by(LANES) {
        let total = |sum: &[Vec<f64>; 2]| load(&sum[0], at) + load(&sum[1], at);
        let forces = [&elements.force_x, &elements.force_y, &elements.torque].map(total);
        let columns = [&mut elements.vx, &mut elements.vy, &mut elements.spin];
        let mobilities = [&elements.mobility_x, &elements.mobility_y, &elements.mobility_spin];
        for ((column, mobility), force) in columns.into_iter().zip(mobilities).zip(forces) {
            let kicked = load(column, at) + half * (force * load(mobility, at));
            store(column, at, kicked);
        }
    }
}

/// A step of the positions. The sums of forces begin anew.
pub(crate) fn drift(elements: &mut Elements, step: f64) {
    let step = f64x4::splat(step);
    for at in (0..elements.x.len()).step_by(LANES) {
        let x = load(&elements.x, at) + step * load(&elements.vx, at);
        store(&mut elements.x, at, x);
        let y = load(&elements.y, at) + step * load(&elements.vy, at);
        store(&mut elements.y, at, y);
        for sum in [&mut elements.force_x, &mut elements.force_y, &mut elements.torque] {
            store(&mut sum[0], at, f64x4::ZERO);
            store(&mut sum[1], at, f64x4::ZERO);
        }
    }
}

/// Work that the drives do in half a step, against the forces of now [J].
pub(crate) fn drive_work(elements: &Elements, step: f64) -> f64 {
    let power = |(at, hold): &(u32, crate::assembly::Hold)| {
        let at = *at as usize;
        let force =
            |sum: &[Vec<f64>; 2], held: bool| if held { sum[0][at] + sum[1][at] } else { 0.0 };
        let along = force(&elements.force_x, hold.x) * elements.vx[at];
        along + force(&elements.force_y, hold.y) * elements.vy[at]
    };
    -0.5 * step * elements.held.iter().map(power).sum::<f64>()
}

/// Takes their share off the velocities over those of the start; returns the energy that goes [J].
pub(crate) fn drag(elements: &mut Elements, constants: &Constants) -> f64 {
    let mut lost = 0.0;
    for at in &elements.dragged {
        let at = *at as usize;
        let share = elements.drag[at];
        let (vx, vy) = (elements.vx[at], elements.vy[at]);
        let free = |mobility: f64| if mobility > 0.0 { share } else { 0.0 };
        elements.vx[at] -= free(elements.mobility_x[at]) * (vx - elements.led_x[at]);
        elements.vy[at] -= free(elements.mobility_y[at]) * (vy - elements.led_y[at]);
        let (wx, wy) = (elements.vx[at], elements.vy[at]);
        lost += vx * vx + vy * vy - wx * wx - wy * wy;
    }
    0.5 * constants.mass * lost
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
