//! ParaView PolyData (`.vtp`): what a surface and the bodies look like at an instant.
//!
//! The format is VTK's XML, arrays appended raw and compressed by zlib. `poly` knows the file,
//! `block` the compressed arrays, `read` the way back; this page knows which arrays there are.

mod block;
pub(crate) mod poly;
mod read;

use std::path::Path;

use abrade::{Nodes, State};
use nalgebra::{Isometry3, Point3, Vector3};

use crate::error::ReportError;
use crate::mesh::Mesh;
use poly::{Array, Place, PolyData};
pub use read::VtpFile;

/// Writes a surface at `pose`: the nodes where they are now (world), with the point arrays
/// `depth_m`, `rest_area_m2` and `normal` (world), and `hardness_Pa` where `hardness` [Pa] is given
/// node by node. Without `triangles` the nodes are drawn as points.
///
/// # Errors
/// Columns of different length, a triangle that names no node, or the file system refuses.
pub fn write_surface(
    path: &Path,
    nodes: &Nodes,
    hardness: Option<&[f64]>,
    pose: &Isometry3<f64>,
    triangles: &[[u32; 3]],
) -> Result<(), ReportError> {
    check_columns(nodes)?;
    if let Some(hardness) = hardness.filter(|hardness| hardness.len() != nodes.len()) {
        let (column, found, depths) = ("hardness", hardness.len(), nodes.len());
        return Err(ReportError::Columns { column, found, depths });
    }
    let all = 0..nodes.len();
    let mut data = PolyData::new(nodes.len());
    data.add(Place::Scalars, Array::f64("depth_m", nodes.depth.iter().copied()));
    data.add(Place::PointData, Array::f64("rest_area_m2", nodes.rest_area.iter().copied()));
    if let Some(hardness) = hardness {
        data.add(Place::PointData, Array::f64("hardness_Pa", hardness.iter().copied()));
    }
    data.add(Place::Normals, Array::vectors("normal", nodes.normal.iter().map(|n| pose * n)));
    data.points(all.map(|i| pose * nodes.position(i)));
    data.faces(triangles)?;
    data.write(path)
}

/// A quantity at every point: its name, with the unit, and its values.
pub type PointArray<'a> = (&'static str, &'a [f64]);

/// Writes points of a plane, z = 0, with `arrays`, the first of which colours them; `joined` pairs of points
/// that follow each other are lines.
///
/// # Errors
/// An array of another length, or the file system refuses.
pub fn write_plane(
    path: &Path,
    points: &[[f64; 2]],
    arrays: &[PointArray],
    joined: bool,
) -> Result<(), ReportError> {
    let mut data = PolyData::new(points.len());
    for (at, (name, values)) in arrays.iter().enumerate() {
        if values.len() != points.len() {
            let (column, found, depths) = (*name, values.len(), points.len());
            return Err(ReportError::Columns { column, found, depths });
        }
        let place = if at == 0 { Place::Scalars } else { Place::PointData };
        data.add(place, Array::f64(name, values.iter().copied()));
    }
    data.points(points.iter().map(|[x, y]| Point3::new(*x, *y, 0.0)));
    match joined {
        true => data.segments(),
        false => data.faces(&[])?,
    }
    data.write(path)
}

/// A body to draw.
#[derive(Clone, Copy, Debug)]
pub struct PlacedBody<'a> {
    /// Its mesh, in its own frame.
    pub mesh: &'a Mesh,
    /// Where it is and how it moves.
    pub state: &'a State,
}

/// Writes all bodies of an instant into one file, with the point arrays `body` (the place in
/// `bodies`, from 0) and `velocity_m_s` (of the point, spin included).
///
/// # Errors
/// A triangle that names no point of its mesh, or the file system refuses.
pub fn write_bodies(path: &Path, bodies: &[PlacedBody<'_>]) -> Result<(), ReportError> {
    let owned = bodies.iter().enumerate();
    let owners = owned.flat_map(|(i, body)| body.mesh.points.iter().map(move |_| i as f64));
    let points: Vec<Point3<f64>> = bodies.iter().flat_map(PlacedBody::points).collect();
    let mut data = PolyData::new(points.len());
    data.add(Place::Scalars, Array::f64("body", owners));
    let velocities = bodies.iter().flat_map(PlacedBody::velocities);
    data.add(Place::PointData, Array::vectors("velocity_m_s", velocities));
    data.points(points.into_iter());
    let mut triangles = Vec::new();
    let mut first = 0;
    for body in bodies {
        poly::check_triangles(&body.mesh.triangles, body.mesh.points.len())?;
        triangles.extend(body.mesh.triangles.iter().map(|t| t.map(|corner| corner + first)));
        first += body.mesh.points.len() as u32;
    }
    data.faces(&triangles)?;
    data.write(path)
}

impl PlacedBody<'_> {
    fn points(&self) -> impl Iterator<Item = Point3<f64>> {
        let pose = self.state.pose();
        self.mesh.points.iter().map(move |point| pose * point)
    }

    fn velocities(&self) -> impl Iterator<Item = Vector3<f64>> {
        let State { position, velocity, spin, .. } = *self.state;
        self.points().map(move |point| velocity + spin.cross(&(point - position)))
    }
}

pub(crate) fn check_columns(nodes: &Nodes) -> Result<(), ReportError> {
    let lengths = [
        ("rest_position", nodes.rest_position.len()),
        ("normal", nodes.normal.len()),
        ("rest_area", nodes.rest_area.len()),
    ];
    let depths = nodes.len();
    match lengths.into_iter().find(|(_, found)| *found != depths) {
        Some((column, found)) => Err(ReportError::Columns { column, found, depths }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests;
