//! Reads the files of a run, instant after instant, and packs what the page needs of them.

use std::path::{Path, PathBuf};

use abrade_report::history;
use abrade_report::vtp::VtpFile;
use nalgebra::Point3;

use crate::block::{BodiesBlock, Instant, Packed, Shape, SurfaceBlock};
use crate::error::ViewError;
use crate::folder::RunFolder;
use crate::moving::{Moving, Pose, connected};
use crate::path;

/// Distance below which a bend of a path is left out, over the size of what is shown.
const STRAIGHT: f64 = 1e-4;

/// The box around all that is shown at the first instant [m].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    low: Point3<f64>,
    high: Point3<f64>,
}

impl Bounds {
    /// Of the surfaces, where they are at the first instant.
    pub(crate) fn of_surfaces(run: &RunFolder) -> Result<Self, ViewError> {
        let (mut low, mut high) = (Point3::from([f64::MAX; 3]), Point3::from([f64::MIN; 3]));
        for (_, files) in &run.surfaces {
            for point in VtpFile::open(&files[0])?.points()? {
                (low, high) = (low.inf(&point), high.sup(&point));
            }
        }
        Ok(Self { low, high })
    }

    pub(crate) fn middle(&self) -> Point3<f64> {
        nalgebra::center(&self.low, &self.high)
    }
}

/// Packs a surface; `origin` [m] is what places are told from.
pub(crate) fn surface(
    name: &str,
    files: &[PathBuf],
    origin: Point3<f64>,
) -> Result<SurfaceBlock, ViewError> {
    let mut block = SurfaceBlock {
        name: name.to_owned(),
        shapes: Vec::new(),
        instants: Vec::new(),
        max_depths_m: Vec::new(),
    };
    let mut laid_out: Option<(VtpFile, Moving)> = None;
    for path in files {
        let file = VtpFile::open(path)?;
        let (depths, normals) = (file.scalars("depth_m")?, file.vectors("normal")?);
        let all = file.points()?.into_iter().zip(&normals).zip(&depths);
        let rest: Vec<_> = all.map(|((point, normal), depth)| point + normal * *depth).collect();
        let poses = laid_out.as_ref().and_then(|(first, moving)| {
            (first.len() == file.len() && first.has_triangles_of(&file))
                .then(|| moving.poses(&rest).ok())?
        });
        let poses = match poses {
            Some(poses) => poses,
            // The first instant, or the surface has been renewed since the last one.
            None => {
                let triangles = file.triangles()?;
                let moving = Moving::new(&rest, connected(rest.len(), &triangles)?);
                let normals = normals.iter().flat_map(|normal| <[f64; 3]>::from(*normal));
                block.shapes.push(shape(&moving, &triangles, Some(Packed::f32s(normals))));
                let poses = moving.first_poses();
                laid_out = Some((file, moving));
                poses
            }
        };
        block.max_depths_m.push(depths.iter().copied().fold(0.0, f64::max));
        block.instants.push(Instant {
            shape: block.shapes.len() - 1,
            poses: packed(&poses, origin),
            depth: Some(Packed::f32s(depths)),
        });
    }
    Ok(block)
}

/// Packs the bodies of `run`, whose files are `files`.
pub(crate) fn bodies(
    run: &RunFolder,
    files: &[PathBuf],
    origin: Point3<f64>,
    bounds: &Bounds,
) -> Result<BodiesBlock, ViewError> {
    let names: Vec<String> = run.summary.bodies.keys().cloned().collect();
    let first = VtpFile::open(&files[0])?;
    let part: Vec<u32> = first.scalars("body")?.into_iter().map(|body| body as u32).collect();
    // Before there is room made for so many.
    let count = part.iter().max().map_or(0, |last| *last as usize + 1);
    check_count(&files[0], "bodies", count, names.len())?;
    let moving = Moving::new(&first.points()?, part);
    let mut instants = Vec::new();
    for path in files {
        let file = VtpFile::open(path)?;
        check_count(path, "points of bodies", file.len(), first.len())?;
        let poses = moving.poses(&file.points()?);
        let poses = poses.map_err(|shift| ViewError::Bent { path: path.clone(), shift })?;
        instants.push(Instant { shape: 0, poses: packed(&poses, origin), depth: None });
    }
    let paths = paths(&run.folder, &names, origin, bounds)?;
    let shapes = [shape(&moving, &first.triangles()?, None)];
    Ok(BodiesBlock { names, shapes, instants, paths })
}

/// The paths in the history, if the run wrote one.
fn paths(
    folder: &Path,
    names: &[String],
    origin: Point3<f64>,
    bounds: &Bounds,
) -> Result<Option<Vec<Packed>>, ViewError> {
    let history = folder.join("history.csv");
    if !history.is_file() {
        return Ok(None);
    }
    let distance = STRAIGHT * (bounds.high - bounds.low).norm();
    let packed = |places: Vec<Point3<f64>>| {
        let kept = path::thinned(&places, distance);
        Packed::f32s(kept.into_iter().flat_map(|place| <[f64; 3]>::from(place - origin)))
    };
    Ok(Some(history::read_places(&history, names)?.into_iter().map(packed).collect()))
}

fn shape(moving: &Moving, triangles: &[[u32; 3]], normal: Option<Packed>) -> Shape {
    Shape {
        points: moving.part.len(),
        parts: moving.len(),
        local: Packed::f32s(moving.local().into_iter().flatten()),
        normal,
        part: (moving.len() > 1).then(|| Packed::u32s(moving.part.iter().copied())),
        triangles: Packed::u32s(triangles.iter().flatten().copied()),
    }
}

fn packed(poses: &[Pose], origin: Point3<f64>) -> Packed {
    let pose = |pose: &Pose| {
        let ([x, y, z], q) = ((pose.centre - origin).into(), pose.rotation.coords);
        [x, y, z, q.x, q.y, q.z, q.w]
    };
    Packed::f32s(poses.iter().flat_map(pose))
}

pub(crate) fn check_count(
    path: &Path,
    what: &'static str,
    found: usize,
    expected: usize,
) -> Result<(), ViewError> {
    match found == expected {
        true => Ok(()),
        false => Err(ViewError::Mixed { path: path.to_owned(), what, found, expected }),
    }
}
