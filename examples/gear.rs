//! The gear of `scenes/closed/gear_scratch.ron` as an OBJ file [mm]: 12 teeth of module 2 mm with
//! involute flanks, a bore, the axis along z.
//!
//! A flank at the distance r from the axis stands off the middle of its tooth by the angle
//! pi / 2N + inv(a) - inv(a_r), with inv(a) = tan a - a, cos a_r = r_b / r and a = 20 degrees.
//!
//! `cargo run --release --example gear > scenes/closed/gear.obj`

use std::f64::consts::{PI, TAU};

const TEETH: usize = 12;
const MODULE: f64 = 2.0;
const BORE: f64 = 4.0;
const HALF_WIDTH: f64 = 4.0;
const PRESSURE_ANGLE: f64 = 20.0;
/// By how much a tooth is wider at its root than where the involute begins [rad].
const DRAFT: f64 = 0.02;

/// Corners of the profile over one tooth: angle from its middle, rising, and radius.
fn tooth() -> Vec<[f64; 2]> {
    let pitch_radius = 0.5 * MODULE * TEETH as f64;
    let base = pitch_radius * PRESSURE_ANGLE.to_radians().cos();
    let involute = |angle: f64| angle.tan() - angle;
    let at_pitch = PI / (2 * TEETH) as f64 + involute(PRESSURE_ANGLE.to_radians());
    let half = |r: f64| at_pitch - involute((base / r).acos());
    let root = [at_pitch + DRAFT, pitch_radius - 1.25 * MODULE];
    let flank = [base, pitch_radius + 0.2 * MODULE, pitch_radius + MODULE].map(|r| [half(r), r]);
    let falling = || flank.iter().rev().chain([&root]);
    let rising = falling().rev().map(|[angle, r]| [-angle, *r]);
    rising.chain(falling().copied()).collect()
}

fn main() {
    let turn = TAU / TEETH as f64;
    let profile: Vec<[f64; 2]> = (0..TEETH)
        .flat_map(|k| tooth().into_iter().map(move |[angle, r]| [angle + turn * k as f64, r]))
        .collect();
    let n = profile.len();
    println!("# A gear of {TEETH} teeth, module {MODULE} mm, as examples/gear.rs makes it [mm]");
    // Rows of corners, once around the material: outside below and above, bore above and below.
    for (outside, z) in
        [(true, -HALF_WIDTH), (true, HALF_WIDTH), (false, HALF_WIDTH), (false, -HALF_WIDTH)]
    {
        for [angle, r] in &profile {
            let r = if outside { *r } else { BORE };
            println!("v {:.6} {:.6} {z}", r * angle.cos(), r * angle.sin());
        }
    }
    for row in 0..4 {
        let corner = |row: usize, k: usize| 1 + (row % 4) * n + k % n;
        for k in 0..n {
            let [a, b] = [corner(row, k), corner(row, k + 1)];
            let [c, d] = [corner(row + 1, k + 1), corner(row + 1, k)];
            println!("f {a} {b} {c}\nf {a} {c} {d}");
        }
    }
}
