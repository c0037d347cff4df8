//! The drum of `scenes/closed/ball_mill.ron` as an OBJ file [mm]: a ring about z with 8 lifters, of
//! the size of that in `examples/ball_mill`.
//!
//! `cargo run --release --example mill_drum > scenes/closed/drum.obj`

const LIFTERS: usize = 8;
/// Radius of the liner between the lifters, of their tops, and of the drum's outside.
const LINER: f64 = 150.0;
const TOP: f64 = 138.0;
const OUTSIDE: f64 = 170.0;
const HALF_LENGTH: f64 = 25.0;
/// Half of a lifter's top and of its foot, seen from the axis [degrees].
const HALF_TOP: f64 = 3.0;
const HALF_FOOT: f64 = 4.5;
/// Corners of the liner from the foot of one lifter to that of the next.
const ARC: usize = 9;

/// Corners of the profile over one lifter and the liner behind it: angle from its middle [degrees],
/// rising, and radius.
fn lifter() -> Vec<[f64; 2]> {
    let lifter = [[-HALF_FOOT, LINER], [-HALF_TOP, TOP], [HALF_TOP, TOP]];
    let step = (360.0 / LIFTERS as f64 - 2.0 * HALF_FOOT) / ARC as f64;
    let liner = (0..ARC).map(|k| [HALF_FOOT + step * k as f64, LINER]);
    lifter.into_iter().chain(liner).collect()
}

fn main() {
    let turn = 360.0 / LIFTERS as f64;
    let profile: Vec<[f64; 2]> = (0..LIFTERS)
        .flat_map(|k| lifter().into_iter().map(move |[angle, r]| [angle + turn * k as f64, r]))
        .collect();
    let n = profile.len();
    println!("# A drum with {LIFTERS} lifters, as examples/mill_drum.rs makes it [mm]");
    // Rows of corners, once around the material: inside, from below to above, and outside.
    for (inside, z) in
        [(true, -HALF_LENGTH), (true, HALF_LENGTH), (false, HALF_LENGTH), (false, -HALF_LENGTH)]
    {
        for [angle, r] in &profile {
            let r = if inside { *r } else { OUTSIDE };
            let (sin, cos) = angle.to_radians().sin_cos();
            println!("v {:.6} {:.6} {z}", r * cos, r * sin);
        }
    }
    for row in 0..4 {
        let corner = |row: usize, k: usize| 1 + (row % 4) * n + k % n;
        for k in 0..n {
            let [a, b] = [corner(row, k), corner(row, k + 1)];
            let [c, d] = [corner(row + 1, k + 1), corner(row + 1, k)];
            println!("f {a} {d} {c}\nf {a} {c} {b}");
        }
    }
}
