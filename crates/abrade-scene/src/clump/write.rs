//! Clumps in the formats of other programs. Mass properties are those of the union.

use std::fmt::Write as _;

use abrade::UnionInertia;
use nalgebra::Vector3;

use super::properties::moments;
use super::{ClumpFile, Format};

/// The text of `clump` in `format`, of density `density` [kg/m3]. An MClump folder is several
/// files; its sphere file alone is what `Csv` writes.
pub fn write(clump: &ClumpFile, format: Format, density: f64, union: &UnionInertia) -> String {
    match format {
        Format::Xyzr => rows(clump, "# x y z r\n", " "),
        Format::Csv => rows(clump, "x,y,z,r\n", ","),
        Format::MClump => rows(clump, "", ","),
        Format::Kratos => kratos(clump, union),
        Format::Lammps => lammps(clump, density, union),
    }
}

fn rows(clump: &ClumpFile, header: &str, separator: &str) -> String {
    let mut text = header.to_owned();
    for sphere in &clump.spheres {
        let c = sphere.centre;
        let row = [c.x, c.y, c.z, sphere.radius].map(|value| value.to_string());
        text += &row.join(separator);
        text.push('\n');
    }
    text
}

fn kratos(clump: &ClumpFile, union: &UnionInertia) -> String {
    let spheres = rows(clump, "", " ");
    let c = union.centre;
    let reach = |ball: &abrade::Ball| (ball.centre - c).norm() + ball.radius;
    let size = 2.0 * clump.spheres.iter().map(reach).fold(0.0, f64::max);
    let moments = moments(&(union.tensor / union.volume));
    format!(
        "Name\ncluster\n\n\
         Begin centers_and_radii\n{spheres}End centers_and_radii\n\n\
         Particle_center_and_diameter\n{} {} {} {size}\n\n\
         Size\n{size}\n\nVolume\n{}\n\n\
         Inertia per unit mass\n{}\n{}\n{}\n",
        c.x, c.y, c.z, union.volume, moments[0], moments[1], moments[2]
    )
}

/// A molecule whose atoms share the union's mass by their volumes.
fn lammps(clump: &ClumpFile, density: f64, union: &UnionInertia) -> String {
    let (mass, c, t) = (union.volume * density, union.centre, union.tensor * density);
    let cubes: Vec<f64> = clump.spheres.iter().map(|sphere| sphere.radius.powi(3)).collect();
    let all: f64 = cubes.iter().sum();
    let mut text = format!(
        "# a clump of spheres\n\n{} atoms\n{mass} mass\n{} {} {} com\n{} {} {} {} {} {} inertia\n",
        clump.spheres.len(),
        c.x,
        c.y,
        c.z,
        t[(0, 0)],
        t[(1, 1)],
        t[(2, 2)],
        t[(0, 1)],
        t[(0, 2)],
        t[(1, 2)],
    );
    let mut section = |name: &str, row: &dyn Fn(usize) -> String| {
        let _ = write!(text, "\n{name}\n\n");
        for i in 0..clump.spheres.len() {
            let _ = writeln!(text, "{} {}", i + 1, row(i));
        }
    };
    let at = |i: usize| -> Vector3<f64> { clump.spheres[i].centre.coords };
    section("Coords", &|i| format!("{} {} {}", at(i).x, at(i).y, at(i).z));
    section("Types", &|_| "1".into());
    section("Diameters", &|i| (2.0 * clump.spheres[i].radius).to_string());
    section("Masses", &|i| (mass * cubes[i] / all).to_string());
    text
}
