//! Clusters of Kratos (`.clu`): spheres between `Begin centers_and_radii` and `End ..`, then named
//! values on the lines after their names. The inertia is given about principal axes, per mass.

use std::path::Path;

use nalgebra::{Matrix3, Point3, Vector3};

use super::lines::{Line, lines};
use super::{ClumpError, ClumpFile, Format, Given};

pub(super) fn parse(path: &Path, text: &str) -> Result<ClumpFile, ClumpError> {
    let missing = |what| ClumpError::Missing { path: path.to_owned(), what };
    let mut spheres = Vec::new();
    let mut given = Given::default();
    let mut rest = lines(path, text, "//");
    while let Some(line) = rest.next() {
        if line.text.starts_with("Begin centers_and_radii") {
            loop {
                let line = rest.next().ok_or_else(|| missing("End centers_and_radii"))?;
                if line.text.starts_with("End centers_and_radii") {
                    break;
                }
                spheres.push(line.sphere(line.first("4 (x, y, z, radius)")?)?);
            }
        } else if line.text.starts_with("Particle_center_and_diameter") {
            let [x, y, z] = value(rest.next(), || missing("Particle_center_and_diameter"))?;
            given.centre = Some(Point3::new(x, y, z));
        } else if line.text.starts_with("Volume") {
            let [volume] = value(rest.next(), || missing("Volume"))?;
            given.volume = Some(volume);
        } else if line.text.starts_with("Inertia") {
            let mut principal = Vector3::zeros();
            for moment in principal.iter_mut() {
                [*moment] = value(rest.next(), || missing("Inertia per unit mass"))?;
            }
            given.tensor_per_mass = Some(Matrix3::from_diagonal(&principal));
        } else if line.text == "Name" || line.text == "Size" {
            rest.next();
        }
    }
    Ok(ClumpFile { path: path.to_owned(), format: Format::Kratos, spheres, given })
}

fn value<const N: usize>(
    line: Option<Line>,
    missing: impl Fn() -> ClumpError,
) -> Result<[f64; N], ClumpError> {
    line.ok_or_else(missing)?.first("a number for each named value")
}
