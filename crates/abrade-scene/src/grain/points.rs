//! Points whose hulls are forms, about the origin and of a size near one.

use std::f64::consts::PI;

use nalgebra::{Point3, Vector3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;

use crate::stream::disc;

/// Eight octants of signs.
fn octants() -> impl Iterator<Item = [f64; 3]> {
    (0..8).map(|i| [0, 1, 2].map(|axis| if i >> axis & 1 == 0 { -1.0 } else { 1.0 }))
}

/// `rings` rings of twice as many points each, and the poles: sin and cos of two angles, raised to what
/// the exponents ask for, which sets them close where the surface bends.
pub(super) fn superquadric(half_axes: &[f64; 3], [n, m]: [f64; 2], rings: u32) -> Vec<Point3<f64>> {
    let raised = |x: f64, power: f64| x.signum() * x.abs().powf(power);
    let [a, b, c] = half_axes;
    let mut points = vec![Point3::new(0.0, 0.0, *c), Point3::new(0.0, 0.0, -c)];
    for ring in 0..rings {
        let up = PI * ((f64::from(ring) + 0.5) / f64::from(rings) - 0.5);
        let (height, around) = (raised(up.sin(), 2.0 / n), raised(up.cos(), 2.0 / n));
        for step in 0..2 * rings {
            let turn = PI * (f64::from(step) + 0.5) / f64::from(rings);
            let x = around * raised(turn.cos(), 2.0 / m);
            let y = around * raised(turn.sin(), 2.0 / m);
            points.push(Point3::new(a * x, b * y, c * height));
        }
    }
    points
}

/// Ten points on the octant of a sphere at each corner of an inner cube; edge 1.
pub(super) fn rounded_cube(radius: f64) -> Vec<Point3<f64>> {
    const STEPS: u32 = 3;
    let mut directions = Vec::new();
    for i in 0..=STEPS {
        for j in 0..=STEPS - i {
            let k = STEPS - i - j;
            directions.push(Vector3::new(f64::from(i), f64::from(j), f64::from(k)).normalize());
        }
    }
    let inner = 0.5 - radius;
    octants()
        .flat_map(|sign| {
            directions.iter().map(move |direction| {
                let out = (direction * radius).add_scalar(inner);
                Point3::from(out.component_mul(&Vector3::from(sign)))
            })
        })
        .collect()
}

/// The two ends of what is left of every edge; edge 1.
pub(super) fn truncated_cube(cut: f64) -> Vec<Point3<f64>> {
    let on_edge = |sign: [f64; 3]| {
        (0..3).map(move |axis| {
            let mut corner = Point3::from(sign) * 0.5;
            corner[axis] *= 1.0 - 2.0 * cut;
            corner
        })
    };
    octants().flat_map(on_edge).collect()
}

/// `count` points of an ellipsoid whose proportions are drawn as well.
pub(super) fn grit(
    count: u32,
    elongation: [f64; 2],
    flatness: [f64; 2],
    seed: u64,
) -> Vec<Point3<f64>> {
    let mut generator = Pcg32::seed_from_u64(seed);
    let mut between = |[low, high]: [f64; 2]| {
        let share: f64 = generator.random();
        low + (high - low) * share
    };
    let axes = Vector3::new(between(elongation), 1.0, 1.0 / between(flatness));
    (0..count)
        .map(|_| {
            // Evenly over the sphere (Marsaglia, Annals of Mathematical Statistics 43 (1972) 645).
            let [a, b] = disc(&mut generator);
            let square = a * a + b * b;
            let out = 2.0 * (1.0 - square).sqrt();
            Point3::from(Vector3::new(a * out, b * out, 1.0 - 2.0 * square).component_mul(&axes))
        })
        .collect()
}
