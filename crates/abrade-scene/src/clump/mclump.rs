//! The folder that MClump writes for a clump: spheres in `Clump/Clump.txt`, properties in
//! `Inertia/Mass.txt` and `Inertia/TOI.txt`, both about the origin, which is the centre of mass.

use std::path::Path;

use nalgebra::{Matrix3, Point3};

use super::lines::lines;
use super::{ClumpError, ClumpFile, Format, rows, text_of};

/// Reads the folder.
pub(super) fn read(folder: &Path) -> Result<ClumpFile, ClumpError> {
    let path = folder.join("Clump").join("Clump.txt");
    let clump = rows::parse(&path, &text_of(&path)?)?;
    if clump.spheres.is_empty() {
        return Err(ClumpError::Empty { path });
    }
    complete(clump)
}

/// Adds the properties that lie beside a file `<folder>/Clump/Clump.txt`, if they do.
pub(super) fn complete(mut clump: ClumpFile) -> Result<ClumpFile, ClumpError> {
    let inside = clump.path.parent().filter(|folder| folder.ends_with("Clump"));
    let Some(folder) = inside.and_then(Path::parent).map(|folder| folder.join("Inertia")) else {
        return Ok(clump);
    };
    let (mass, tensor) = (folder.join("Mass.txt"), folder.join("TOI.txt"));
    if !(mass.is_file() && tensor.is_file()) {
        return Ok(clump);
    }
    let missing = |what| ClumpError::Missing { path: folder.clone(), what };
    let text = text_of(&mass)?;
    let [value] =
        lines(&mass, &text, "#").next().ok_or_else(|| missing("Mass.txt"))?.first("1 (mass)")?;
    let text = text_of(&tensor)?;
    let mut rows = lines(&tensor, &text, "#");
    let mut toi = Matrix3::zeros();
    for i in 0..3 {
        let line = rows.next().ok_or_else(|| missing("3 lines of TOI.txt"))?;
        toi.set_row(i, &nalgebra::RowVector3::from(line.first::<3>("3 (a row of the tensor)")?));
    }
    clump.format = Format::MClump;
    clump.given.mass = Some(value);
    clump.given.centre = Some(Point3::origin());
    clump.given.tensor_per_mass = Some(toi / value);
    Ok(clump)
}
