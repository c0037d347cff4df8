//! From a form to a solid: corners or spheres of any size, then the size that is asked for.

mod fill;
mod points;

use std::path::Path;

use abrade::{Ball, Hull, Inertia, ParameterError, Piece, Shape, UnionInertia};
use nalgebra::{Point3, Vector3};

pub use fill::Fit;

use crate::clump;
use crate::mesh_file;
use crate::scene::{Form, Grain};
use crate::solid::{Solid, SolidTrouble};

/// What the size of a grain is told by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GrainSize {
    /// Diameter of the sphere of the same volume [m].
    Volume(f64),
    /// Largest distance between two points of the grain [m].
    Feret(f64),
}

/// A grain of a size.
#[derive(Clone, Debug, PartialEq)]
pub struct MadeGrain {
    /// Geometry about the centre of mass, mass and inertia.
    pub solid: Solid,
    /// Volume [m3].
    pub volume: f64,
    /// Largest distance between two of its points [m].
    pub feret: f64,
    /// How well the spheres of a clump stand for the form.
    pub fit: Option<Fit>,
}

/// A form that makes no solid.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(transparent)]
pub struct GrainError(SolidTrouble);

impl Grain {
    /// The grain of this `size` and `density` [kg/m3]; `seed` chooses among the grains of a form that
    /// is random. Files are looked for in `folder`.
    ///
    /// # Errors
    /// A value of the form is out of range, or a file does not serve.
    pub fn make(
        &self,
        size: GrainSize,
        density: f64,
        seed: u64,
        folder: &Path,
    ) -> Result<MadeGrain, GrainError> {
        self.made(size, density, seed, folder).map_err(GrainError)
    }

    pub(crate) fn made(
        &self,
        size: GrainSize,
        density: f64,
        seed: u64,
        folder: &Path,
    ) -> Result<MadeGrain, SolidTrouble> {
        self.check()?;
        let mut fit = None;
        let (solid, volume) = match (&self.form, self.spheres) {
            (Form::Sphere, _) => {
                let inertia = Inertia::of_ball(1.0, 1.0);
                let volume = inertia.mass;
                (Solid { shape: Shape::ball(1.0)?, inertia, centre: Vector3::zeros() }, volume)
            }
            (Form::Clump { file }, _) => union_of(&clump::read(&folder.join(file))?.spheres)?,
            (form, spheres) => {
                let (hull, inertia, centre) = Hull::solid(&corners(form, seed, folder)?, 1.0)?;
                match spheres {
                    Some(count) => {
                        let (balls, found) = fill::spheres(&hull, count as usize);
                        fit = Some(found);
                        union_of(&balls)?
                    }
                    None => {
                        let volume = hull.volume();
                        (Solid { shape: Shape::hull(hull), inertia, centre }, volume)
                    }
                }
            }
        };
        let feret = feret(&solid.shape);
        let factor = match size {
            GrainSize::Volume(diameter) => diameter / sphere_diameter(volume),
            GrainSize::Feret(diameter) => diameter / feret,
        };
        Ok(MadeGrain {
            solid: scaled(&solid, factor, density)?,
            volume: volume * factor.powi(3),
            feret: feret * factor,
            fit: fit.map(|fit| fit.scaled(factor)),
        })
    }

    /// The first value that is out of range.
    fn check(&self) -> Result<(), SolidTrouble> {
        let refuse = |field, value: f64, allowed: &str| {
            Err(SolidTrouble::Parameter(ParameterError { field, value, allowed: allowed.into() }))
        };
        let within = |value: f64, low: f64, high: f64| value >= low && value <= high;
        match &self.form {
            Form::Superquadric { half_axes, .. }
                if half_axes.iter().any(|&a| !within(a, 1e-6, 1e6)) =>
            {
                refuse("half_axes", half_axes[0], "from 1e-6 to 1e6 each")?;
            }
            Form::Superquadric { exponents, .. }
                if exponents.iter().any(|&n| !within(n, 2.0, 100.0)) =>
            {
                refuse("exponents", exponents[0], "from 2 to 100 each")?;
            }
            Form::Superquadric { rings, .. } if !(4..=40).contains(rings) => {
                refuse("rings", f64::from(*rings), "from 4 to 40")?;
            }
            Form::RoundedCube { radius } if !(*radius > 0.0 && *radius < 0.5) => {
                refuse("radius", *radius, "above zero and below 0.5")?;
            }
            Form::TruncatedCube { cut } if !(*cut > 0.0 && *cut <= 0.5) => {
                refuse("cut", *cut, "above zero and at most 0.5")?;
            }
            Form::Grit { points, .. } if !(5..=200).contains(points) => {
                refuse("points", f64::from(*points), "from 5 to 200")?;
            }
            Form::Grit { elongation: [low, high], .. }
                if !(within(*low, 1.0, *high) && *high <= 100.0) =>
            {
                refuse("elongation", *low, "two numbers from 1 to 100, the smaller one first")?;
            }
            Form::Grit { flatness: [low, high], .. }
                if !(within(*low, 1.0, *high) && *high <= 100.0) =>
            {
                refuse("flatness", *low, "two numbers from 1 to 100, the smaller one first")?;
            }
            _ => {}
        }
        match (&self.form, self.spheres) {
            (Form::Sphere | Form::Clump { .. }, Some(count)) => {
                refuse("spheres", f64::from(count), "left out: the form is made of spheres")
            }
            (_, Some(count)) if !(1..=1000).contains(&count) => {
                refuse("spheres", f64::from(count), "from 1 to 1000")
            }
            _ => Ok(()),
        }
    }
}

/// Points whose hull is the form.
fn corners(form: &Form, seed: u64, folder: &Path) -> Result<Vec<Point3<f64>>, SolidTrouble> {
    Ok(match form {
        Form::Polyhedron { kind } => kind.vertices(1.0),
        Form::Superquadric { half_axes, exponents, rings } => {
            points::superquadric(half_axes, *exponents, *rings)
        }
        Form::RoundedCube { radius } => points::rounded_cube(*radius),
        Form::TruncatedCube { cut } => points::truncated_cube(*cut),
        Form::Grit { points, elongation, flatness } => {
            points::grit(*points, *elongation, *flatness, seed)
        }
        Form::Mesh { file } => mesh_file::read(folder, file, 1.0)?.vertices,
        Form::Sphere | Form::Clump { .. } => Vec::new(),
    })
}

/// The union of `balls` at unit density, and its volume [m3].
fn union_of(balls: &[Ball]) -> Result<(Solid, f64), SolidTrouble> {
    let union = UnionInertia::of_balls(balls)?;
    let about = |ball: &Ball| {
        Piece::Ball(Ball { centre: ball.centre - union.centre.coords, radius: ball.radius })
    };
    let shape = Shape::union(balls.iter().map(about).collect())?;
    let inertia = Inertia { mass: union.volume, tensor: union.tensor };
    Ok((Solid { shape, inertia, centre: union.centre.coords }, union.volume))
}

/// `solid`, `factor` times as large and of `density` times its density.
pub(crate) fn scaled(solid: &Solid, factor: f64, density: f64) -> Result<Solid, SolidTrouble> {
    let larger = |piece: &Piece| match piece {
        Piece::Ball(ball) => {
            Ok(Piece::Ball(Ball { centre: ball.centre * factor, radius: ball.radius * factor }))
        }
        Piece::Hull(hull) => {
            let corners: Vec<_> = hull.vertices().iter().map(|corner| corner * factor).collect();
            Hull::solid(&corners, 1.0).map(|(hull, _, shift)| Piece::Hull(hull.moved(&shift)))
        }
    };
    let pieces = solid.shape.pieces().iter().map(larger).collect::<Result<Vec<_>, _>>()?;
    let inertia = Inertia {
        mass: solid.inertia.mass * density * factor.powi(3),
        tensor: solid.inertia.tensor * (density * factor.powi(5)),
    };
    Ok(Solid { shape: Shape::union(pieces)?, inertia, centre: solid.centre * factor })
}

/// Diameter of the sphere of this `volume`.
pub(crate) fn sphere_diameter(volume: f64) -> f64 {
    (6.0 * volume / std::f64::consts::PI).cbrt()
}

/// Largest distance between two points of `shape`.
fn feret(shape: &Shape) -> f64 {
    let balls: Vec<(Point3<f64>, f64)> = shape
        .pieces()
        .iter()
        .flat_map(|piece| match piece {
            Piece::Ball(ball) => vec![(ball.centre, ball.radius)],
            Piece::Hull(hull) => hull.vertices().iter().map(|&corner| (corner, 0.0)).collect(),
        })
        .collect();
    let mut largest = 0.0_f64;
    for (i, (a, r)) in balls.iter().enumerate() {
        for (b, s) in &balls[i..] {
            largest = largest.max((a - b).norm() + r + s);
        }
    }
    largest
}
