//! From a scene's shape to geometry about the centre of mass, mass and inertia.

use std::path::Path;

use abrade::{
    Ball, Hull, Inertia, ParameterError, Piece, Shape, ShapeError, UnionInertia, cuboid_vertices,
};
use nalgebra::{Point3, Vector3};
use thiserror::Error;

use crate::clump::{self, ClumpError, ClumpFile, Format, Given, Source};
use crate::grain::{GrainSize, MadeGrain};
use crate::mesh_file::{self, FileTrouble};
use crate::scene::{ClumpInertia, Grain, SceneShape};

/// Hull coordinates [m] beyond which volumes cannot be held in a number.
const LARGEST_COORDINATE: f64 = 1e60;

/// A body's geometry and inertia.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// Geometry about the centre of mass.
    pub shape: Shape,
    /// Mass and inertia about the centre of mass.
    pub inertia: Inertia,
    /// Centre of mass in the coordinates that the scene or its file uses [m].
    pub centre: Vector3<f64>,
}

/// Why a shape makes no solid.
#[derive(Clone, Debug, PartialEq, Error)]
pub(crate) enum SolidTrouble {
    /// A value of the shape's own is out of range.
    #[error(transparent)]
    Parameter(ParameterError),
    /// Neither or both of two fields that stand for each other.
    #[error("give either `{0}` or `{1}`")]
    OneOf(&'static str, &'static str),
    /// The geometry is empty or flat.
    #[error(transparent)]
    Shape(#[from] ShapeError),
    /// The clump file.
    #[error(transparent)]
    Clump(#[from] ClumpError),
    /// The mesh file.
    #[error(transparent)]
    Mesh(#[from] FileTrouble),
    /// Nothing says what it weighs.
    #[error("nothing gives a mass")]
    NoMass,
    /// The clump file has no mass properties of its own.
    #[error("the clump file gives no inertia of its own")]
    NoOwnInertia,
    /// Mass or inertia cannot be held in a number, or vanish.
    #[error("the mass would be {mass:e} kg")]
    Weight { mass: f64 },
}

/// Geometry at unit density, before a mass is chosen.
struct Blank {
    shape: Shape,
    unit: Inertia,
    centre: Vector3<f64>,
    /// Set when the file gives mass and inertia.
    own: Option<Inertia>,
    note: Option<String>,
}

/// The solid of `shape`. Its mass is `mass` [kg] if given, else the clump file's own if asked for,
/// else it follows from `density` [kg/m3]. The text is a note worth showing.
pub(crate) fn solid(
    shape: &SceneShape,
    density: Option<f64>,
    mass: Option<f64>,
    folder: &Path,
) -> Result<(Solid, Option<String>), SolidTrouble> {
    let blank = blank(shape, density, folder)?;
    let inertia = match (mass, blank.own, density) {
        (Some(mass), own, _) => {
            let from = own.unwrap_or(blank.unit);
            Inertia { mass, tensor: from.tensor * (mass / from.mass) }
        }
        (None, Some(own), _) => own,
        (None, None, Some(density)) => {
            Inertia { mass: blank.unit.mass * density, tensor: blank.unit.tensor * density }
        }
        (None, None, None) => return Err(SolidTrouble::NoMass),
    };
    if !is_sound(&inertia) {
        return Err(SolidTrouble::Weight { mass: inertia.mass });
    }
    Ok((Solid { shape: blank.shape, inertia, centre: blank.centre }, blank.note))
}

/// The solid of `shape`, held so that nothing moves it.
pub(crate) fn fixed(
    shape: &SceneShape,
    folder: &Path,
) -> Result<(Solid, Option<String>), SolidTrouble> {
    let Blank { shape, centre, note, .. } = blank(shape, None, folder)?;
    Ok((Solid { shape, inertia: Inertia::immovable(), centre }, note))
}

/// True when mass and principal moments are finite and above zero.
pub(crate) fn is_sound(inertia: &Inertia) -> bool {
    let finite = inertia.mass.is_finite() && inertia.tensor.iter().all(|x| x.is_finite());
    let moments = || inertia.tensor.symmetric_eigenvalues();
    inertia.mass > 0.0 && finite && moments().iter().all(|&moment| moment > 0.0)
}

fn blank(shape: &SceneShape, density: Option<f64>, folder: &Path) -> Result<Blank, SolidTrouble> {
    match shape {
        SceneShape::Ball { radius } => {
            positive("radius", &[*radius])?;
            let (shape, unit) = (Shape::ball(*radius)?, Inertia::of_ball(*radius, 1.0));
            Ok(Blank { shape, unit, centre: Vector3::zeros(), own: None, note: None })
        }
        SceneShape::Cuboid { size } => {
            positive("size", size)?;
            hull(&cuboid_vertices(&(Vector3::from(*size) / 2.0)))
        }
        SceneShape::Polyhedron { kind, edge } => {
            positive("edge", &[*edge])?;
            hull(&kind.vertices(*edge))
        }
        SceneShape::ConvexHull { points, file, scale } => {
            positive("scale", &[*scale])?;
            match (points, file) {
                (Some(points), None) => {
                    hull(&points.iter().map(|p| Point3::from(*p)).collect::<Vec<_>>())
                }
                (None, Some(file)) => hull(&mesh_file::read(folder, file, *scale)?.vertices),
                _ => Err(SolidTrouble::OneOf("points", "file")),
            }
        }
        SceneShape::Clump { spheres, file, scale, inertia } => {
            positive("scale", &[*scale])?;
            let clump = match (spheres, file) {
                (Some(spheres), None) => written(spheres)?,
                (None, Some(file)) => clump::read(&folder.join(file))?.scaled(*scale),
                _ => return Err(SolidTrouble::OneOf("spheres", "file")),
            };
            clumped(&clump, *inertia, density)
        }
        SceneShape::Grain { form, diameter, spheres, seed } => {
            positive("diameter", &[*diameter])?;
            let grain = Grain { form: form.clone(), spheres: *spheres };
            let size = GrainSize::Volume(*diameter);
            let MadeGrain { solid, fit, .. } = grain.made(size, 1.0, *seed, folder)?;
            let Solid { shape, inertia: unit, centre } = solid;
            Ok(Blank { shape, unit, centre, own: None, note: fit.map(|fit| fit.note()) })
        }
    }
}

fn hull(points: &[Point3<f64>]) -> Result<Blank, SolidTrouble> {
    let too_large = |x: &f64| x.is_nan() || x.abs() >= LARGEST_COORDINATE;
    if let Some(&value) = points.iter().flat_map(|point| point.iter()).find(|x| too_large(x)) {
        let allowed = format!("of a size below {LARGEST_COORDINATE:e} m");
        let field = "points";
        return Err(SolidTrouble::Parameter(ParameterError { field, value, allowed }));
    }
    let (hull, unit, centre) = Hull::solid(points, 1.0)?;
    Ok(Blank { shape: Shape::hull(hull), unit, centre, own: None, note: None })
}

/// The clump that a scene's own list of spheres makes.
fn written(spheres: &[[f64; 4]]) -> Result<ClumpFile, SolidTrouble> {
    let radii: Vec<f64> = spheres.iter().map(|sphere| sphere[3]).collect();
    positive("spheres", &radii)?;
    let ball = |&[x, y, z, radius]: &[f64; 4]| Ball { centre: Point3::new(x, y, z), radius };
    Ok(ClumpFile {
        path: Default::default(),
        format: Format::Xyzr,
        spheres: spheres.iter().map(ball).collect(),
        given: Given::default(),
    })
}

fn clumped(
    clump: &ClumpFile,
    source: ClumpInertia,
    density: Option<f64>,
) -> Result<Blank, SolidTrouble> {
    let report = clump.report()?;
    let UnionInertia { volume, centre, tensor, .. } = report.union;
    let mut blank_centre = centre;
    let mut own = None;
    if source == ClumpInertia::File {
        if clump.given.tensor_per_mass.is_none() {
            return Err(SolidTrouble::NoOwnInertia);
        }
        let properties = clump.properties(Source::File, density, &report.union);
        let properties = properties.ok_or(SolidTrouble::NoMass)?;
        blank_centre = properties.centre;
        own = Some(properties.inertia);
    }
    let about = |ball: &Ball| {
        Piece::Ball(Ball { centre: ball.centre - blank_centre.coords, radius: ball.radius })
    };
    Ok(Blank {
        shape: Shape::union(clump.spheres.iter().map(about).collect())?,
        unit: Inertia { mass: volume, tensor },
        centre: blank_centre.coords,
        own,
        note: report.difference(),
    })
}

fn positive(field: &'static str, values: &[f64]) -> Result<(), SolidTrouble> {
    let error = values.iter().find_map(|&value| ParameterError::positive(field, value));
    error.map_or(Ok(()), |error| Err(SolidTrouble::Parameter(error)))
}
