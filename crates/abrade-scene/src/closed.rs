//! From the geometry of a solid to the mesh whose vertices are its nodes.

use std::path::Path;

use abrade::{Bend, Mended, MeshError, ParameterError, TriangleMesh};
use nalgebra::Vector3;
use thiserror::Error;

use crate::mesh_file::{self, Facets, FileTrouble};
use crate::number_rows::{self, Line, RowsTrouble};
use crate::scene::Geometry;

/// The mesh of a solid, and what was mended in its file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ClosedMesh {
    pub(crate) mesh: TriangleMesh,
    pub(crate) note: Option<String>,
}

/// Why a geometry makes no closed mesh.
#[derive(Clone, Debug, PartialEq, Error)]
pub(crate) enum ClosedTrouble {
    /// The mesh file.
    #[error(transparent)]
    File(#[from] FileTrouble),
    /// The file of heights.
    #[error(transparent)]
    Heights(#[from] RowsTrouble),
    /// A row of heights that does not go with the others, or with the base.
    #[error("{error}")]
    Row { error: Box<MeshError>, line: Line },
    /// What the file holds is not the boundary of a solid.
    #[error("`{file}` bounds no solid")]
    NoSolid { file: String, error: MeshError },
    /// The sizes, or the pitch.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

/// The mesh of `geometry`; none if it is not closed. Files lie in `folder`.
pub(crate) fn closed(
    geometry: &Geometry,
    folder: &Path,
) -> Option<Result<ClosedMesh, ClosedTrouble>> {
    let made = match *geometry {
        Geometry::HexStrip { .. } => return None,
        Geometry::Sphere { radius, pitch } => TriangleMesh::sphere(radius, pitch),
        Geometry::Cylinder { radius, length, pitch } => {
            TriangleMesh::cylinder(radius, length, pitch)
        }
        Geometry::Tube { inner, outer, length, pitch } => {
            TriangleMesh::tube(inner, outer, length, pitch)
        }
        Geometry::Bend { inner, outer, radius, angle, straight, pitch } => {
            TriangleMesh::bend(&Bend { inner, outer, radius, angle, straight }, pitch)
        }
        Geometry::Capsule { radius, length, pitch } => TriangleMesh::capsule(radius, length, pitch),
        Geometry::Cuboid { half_extents, pitch } => {
            TriangleMesh::cuboid(Vector3::from(half_extents), pitch)
        }
        Geometry::HeightField { ref file, spacing, base, scale } => {
            return Some(ground(folder, file, spacing, base, scale));
        }
        Geometry::Mesh { ref file, pitch, scale } => {
            return Some(from_file(folder, file, pitch, scale));
        }
    };
    Some(made.map(|mesh| ClosedMesh { mesh, note: None }).map_err(ClosedTrouble::Mesh))
}

fn positive(field: &'static str, value: f64) -> Result<(), ClosedTrouble> {
    let error = ParameterError::positive(field, value);
    error.map_or(Ok(()), |error| Err(ClosedTrouble::Mesh(error.into())))
}

fn ground(
    folder: &Path,
    file: &str,
    [along, across]: [f64; 2],
    base: f64,
    scale: f64,
) -> Result<ClosedMesh, ClosedTrouble> {
    positive("spacing", along)?;
    positive("spacing", across)?;
    positive("scale", scale)?;
    let mut heights = number_rows::read(folder, "height field", file)?;
    heights.rows.iter_mut().flatten().for_each(|height| *height *= scale);
    let mesh = TriangleMesh::height_field(&heights.rows, along, across, base);
    let mesh = mesh.map_err(|error| {
        let row = match error {
            MeshError::RaggedHeights { row, .. } | MeshError::LowHeight { row, .. } => row,
            error => return ClosedTrouble::Mesh(error),
        };
        match heights.lines.get(row) {
            Some(line) => ClosedTrouble::Row { error: Box::new(error), line: line.clone() },
            None => ClosedTrouble::NoSolid { file: file.to_owned(), error },
        }
    })?;
    Ok(ClosedMesh { mesh, note: None })
}

fn from_file(
    folder: &Path,
    file: &str,
    pitch: Option<f64>,
    scale: f64,
) -> Result<ClosedMesh, ClosedTrouble> {
    positive("scale", scale)?;
    pitch.map_or(Ok(()), |pitch| positive("pitch", pitch))?;
    let Facets { vertices, triangles } = mesh_file::read(folder, file, scale)?;
    let (mesh, mended) = TriangleMesh::mend(vertices, triangles)
        .map_err(|error| ClosedTrouble::NoSolid { file: file.to_owned(), error })?;
    let mesh = pitch.map_or(Ok(mesh.clone()), |pitch| mesh.resampled(pitch))?;
    let note = (mended != Mended::default()).then(|| format!("the mesh `{file}`: {mended}"));
    Ok(ClosedMesh { mesh, note })
}
