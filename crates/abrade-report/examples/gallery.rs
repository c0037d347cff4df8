//! Draws made-up craters: one picture and page per case, to be looked at.
//!
//! cargo run --release -p abrade-report --example gallery -- FOLDER

use std::error::Error;
use std::path::Path;

use abrade::Nodes;
use abrade_report::{Mark, Picture};
use nalgebra::{Point3, Vector3};

/// A hex strip of `length` by `width` [m] with `pitch` [m].
fn strip(length: f64, width: f64, pitch: f64, depth: impl Fn(f64, f64) -> f64) -> Nodes {
    let columns = (length / (pitch * 0.75_f64.sqrt()) / 2.0) as i32;
    let rows = (width / pitch / 2.0) as i32;
    let mut nodes = Nodes::default();
    for i in -columns..=columns {
        for j in -rows..=rows {
            let shift = if i % 2 == 0 { 0.0 } else { 0.5 };
            let (x, y) = (f64::from(i) * 0.75_f64.sqrt() * pitch, (f64::from(j) + shift) * pitch);
            nodes.rest_position.push(Point3::new(x, y, 0.0));
            nodes.normal.push(Vector3::z());
            nodes.rest_area.push(0.75_f64.sqrt() * pitch * pitch);
            nodes.depth.push(depth(x, y).max(0.0));
        }
    }
    nodes
}

/// A lopsided bowl of `depth`, `length` by `width` about (x, y) [m].
fn bowl(x: f64, y: f64, depth: f64, length: f64, width: f64) -> f64 {
    let (a, b) = (2.0 * x / length, 2.0 * y / width);
    if a.abs() > 1.5 { 0.0 } else { depth * (1.0 - a * a * (1.0 - 0.3 * a) - b * b) }
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).ok_or("which folder?")?;
    let oblique = strip(30e-3, 12e-3, 0.05e-3, |x, y| bowl(x, y, 3.4e-5, 1.9e-3, 0.9e-3));
    let coarse = strip(30e-3, 12e-3, 0.15e-3, |x, y| bowl(x, y, 3.4e-5, 1.9e-3, 0.9e-3));
    let many = strip(20e-3, 20e-3, 0.1e-3, |x, y| {
        let hits = (0..60).map(|k| (f64::from(k * k % 37) - 18.0, f64::from(k * 7 % 23) - 11.0));
        let deep = hits.map(|(a, b)| bowl(x - a * 0.3e-3, y - b * 0.5e-3, 8e-6, 1.6e-3, 1.1e-3));
        deep.fold(0.0, f64::max)
    });
    let one = strip(30e-3, 12e-3, 0.15e-3, |x, y| if x == 0.0 && y == 0.0 { 4e-7 } else { 0.0 });
    let none = strip(30e-3, 12e-3, 0.15e-3, |_, _| 0.0);
    let large = strip(0.3, 0.12, 8.5e-5, |x, y| bowl(x, y, 2e-3, 0.2, 0.02));
    let cases = [
        ("oblique", "Oblique impact of a ball", &oblique),
        ("coarse", "Oblique impact of a ball, coarse nodes", &coarse),
        ("many", "Sixty impacts", &many),
        ("one", "One worn node", &one),
        ("none", "A ball that missed", &none),
        ("large", "A groove in millions of nodes", &large),
    ];
    let ball = Mark { label: "ball", position_local: Point3::new(1.2e-3, 0.0, 0.0) };
    for (name, title, nodes) in cases {
        let path = Path::new(&folder).join(format!("{name}.png"));
        Picture { title, nodes, wear_volume: nodes.wear_volume(), marks: &[ball] }.write(&path)?;
    }
    Ok(())
}
