//! Descriptors of shape, as erosion studies tell them.

use std::f64::consts::PI;
use std::path::Path;

use abrade::{Ball, Hull, Piece, Shape};
use abrade_scene::scene::Form;
use abrade_scene::{GrainError, MadeGrain};
use nalgebra::{Point3, UnitQuaternion, Vector3};
use serde::Serialize;

use super::file::StudyFile;
use super::silhouette;

/// Attitudes, and grains of a random form, that means are taken over.
const COUNT: u32 = 64;
/// Height over the lowest point at which a grain's front is looked at, over the diameter of the sphere
/// of the same volume.
pub(crate) const LEVEL: f64 = 0.05;
/// Points per sphere of a clump that its surface is judged by.
const POINTS: u32 = 2000;

/// The shape of a grain; of a random form means over 64 grains.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Descriptors {
    /// Mass [kg].
    pub mass_kg: f64,
    /// Diameter of the sphere of the same volume [m].
    pub volume_diameter_m: f64,
    /// Largest distance between two points [m].
    pub feret_diameter_m: f64,
    /// Surface of the sphere of the same volume over that of the grain (H. Wadell, J. Geol. 40 (1932)
    /// 443) [-].
    pub sphericity: f64,
    /// Radius of the tips over that of the largest sphere about the centre of mass within the grain [-];
    /// 0 for sharp corners. None where nobody knows the tips, those of superquadrics and meshes, and where
    /// that centre is outside of the grain.
    pub roundness: Option<f64>,
    /// Mean angle from the surface to the line from the lowest point to the grain's front, at a height of
    /// 0.05 diameters, over all attitudes [rad].
    pub attack_angle_rad: f64,
    /// Spike parameter SPQ of silhouettes (M. G. Hamblin & G. W. Stachowiak, Wear 190 (1995) 225),
    /// their sides fitted in polar coordinates: 0 for a circle, 0.71 for a square [-].
    pub spike: f64,
    /// Of a clump that stands for a form: largest distance of the form's surface from the spheres [m].
    pub fit_error_m: Option<f64>,
    /// Of a clump that stands for a form: mean radius of the spheres nearest to its corners [m].
    pub tip_radius_m: Option<f64>,
}

/// The descriptors of the grain of this `name`.
pub(crate) fn describe(
    file: &StudyFile,
    name: &str,
    folder: &Path,
) -> Result<Descriptors, GrainError> {
    let form = &file.grains[name].form;
    let grains = if matches!(form, Form::Grit { .. }) { COUNT } else { 1 };
    let mut sum = Descriptors::default();
    for k in 0..grains {
        let grain = file.grain_of_median_size(name, k, folder)?;
        let rotations = (0..COUNT).filter(|r| grains == 1 || *r == k);
        let rotations = rotations.map(|r| file.samples.at(r).rotation).collect::<Vec<_>>();
        let one = of(&grain, form, &rotations);
        let share = 1.0 / f64::from(grains);
        sum.mass_kg += share * one.mass_kg;
        sum.volume_diameter_m += share * one.volume_diameter_m;
        sum.feret_diameter_m += share * one.feret_diameter_m;
        sum.sphericity += share * one.sphericity;
        sum.attack_angle_rad += share * one.attack_angle_rad;
        sum.spike += share * one.spike;
        let mean = |sum: Option<f64>, one: Option<f64>| one.map(|x| sum.unwrap_or(0.0) + share * x);
        sum.roundness = mean(sum.roundness, one.roundness);
        sum.fit_error_m = mean(sum.fit_error_m, one.fit_error_m);
        sum.tip_radius_m = mean(sum.tip_radius_m, one.tip_radius_m);
    }
    Ok(sum)
}

fn of(grain: &MadeGrain, form: &Form, rotations: &[UnitQuaternion<f64>]) -> Descriptors {
    let shape = &grain.solid.shape;
    let diameter = (6.0 * grain.volume / PI).cbrt();
    let mean = |f: &dyn Fn(&UnitQuaternion<f64>) -> f64| {
        rotations.iter().map(f).sum::<f64>() / rotations.len() as f64
    };
    Descriptors {
        mass_kg: grain.solid.inertia.mass,
        volume_diameter_m: diameter,
        feret_diameter_m: grain.feret,
        sphericity: PI * diameter * diameter / area(shape),
        roundness: roundness(grain, form),
        attack_angle_rad: mean(&|rotation| attack(shape, rotation, LEVEL * diameter)),
        spike: mean(&|rotation| silhouette::spike(&silhouette::profile(shape, rotation))),
        fit_error_m: grain.fit.map(|fit| fit.error),
        tip_radius_m: grain.fit.map(|fit| fit.tip_radius),
    }
}

fn roundness(grain: &MadeGrain, form: &Form) -> Option<f64> {
    let balls = balls(&grain.solid.shape);
    let inner = inscribed(&grain.solid.shape)?;
    let tip = match (form, grain.fit) {
        (_, Some(fit)) => fit.tip_radius,
        // The edge follows from the diameter of the cube with round corners, whose largest inner sphere
        // has half of it.
        (Form::RoundedCube { radius }, None) => 2.0 * radius * inner,
        (Form::Sphere | Form::Clump { .. }, None) => {
            balls.iter().map(|ball| ball.radius).sum::<f64>() / balls.len() as f64
        }
        (Form::Superquadric { .. } | Form::Mesh { .. }, None) => return None,
        _ => 0.0,
    };
    Some(tip / inner)
}

fn balls(shape: &Shape) -> Vec<Ball> {
    let ball = |piece: &Piece| match piece {
        Piece::Ball(ball) => Some(*ball),
        Piece::Hull(_) => None,
    };
    shape.pieces().iter().filter_map(ball).collect()
}

/// Radius of the largest sphere about the centre of mass within a hull or a union of spheres [m]; None
/// where that centre is outside.
fn inscribed(shape: &Shape) -> Option<f64> {
    let balls = balls(shape);
    let nearest = |piece: &Piece| match piece {
        Piece::Hull(hull) => hull.planes().iter().map(|p| p.offset).fold(f64::INFINITY, f64::min),
        Piece::Ball(ball) => {
            open_points(ball, &balls).map(|point| point.coords.norm()).fold(f64::INFINITY, f64::min)
        }
    };
    let is_inside = balls.is_empty() || balls.iter().any(|b| b.centre.coords.norm() < b.radius);
    is_inside.then(|| shape.pieces().iter().map(nearest).fold(f64::INFINITY, f64::min))
}

/// Surface [m2]; of a union of spheres by points all over them.
fn area(shape: &Shape) -> f64 {
    let balls = balls(shape);
    shape
        .pieces()
        .iter()
        .map(|piece| match piece {
            Piece::Hull(hull) => hull_area(hull),
            Piece::Ball(ball) => open_area(ball, &balls),
        })
        .sum()
}

fn hull_area(hull: &Hull) -> f64 {
    let corner = |i: u32| hull.vertices()[i as usize];
    let facet = |&[a, b, c]: &[u32; 3]| {
        (corner(b) - corner(a)).cross(&(corner(c) - corner(a))).norm() / 2.0
    };
    hull.facets().iter().map(facet).sum()
}

/// Area of `ball` that no other of `balls` covers [m2].
fn open_area(ball: &Ball, balls: &[Ball]) -> f64 {
    let open = open_points(ball, balls).count();
    4.0 * PI * ball.radius * ball.radius * open as f64 / f64::from(POINTS)
}

/// Points spread evenly over `ball` that no other of `balls` covers.
fn open_points<'a>(ball: &'a Ball, balls: &'a [Ball]) -> impl Iterator<Item = Point3<f64>> + 'a {
    let golden = PI * (3.0 - 5f64.sqrt());
    let point = move |i: u32| {
        let z = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(POINTS);
        let (turn, out) = (golden * f64::from(i), (1.0 - z * z).sqrt());
        ball.centre + Vector3::new(out * turn.cos(), out * turn.sin(), z) * ball.radius
    };
    let is_open = move |point: &Point3<f64>| {
        let covers = |other: &Ball| {
            other != ball && (point - other.centre).norm() < other.radius * (1.0 - 1e-9)
        };
        !balls.iter().any(covers)
    };
    (0..POINTS).map(point).filter(is_open)
}

/// Angle from the surface to the line from the lowest point of the shape, so turned, to its front at the
/// height `level` above [rad]; the front is to the side of the x axis.
fn attack(shape: &Shape, rotation: &UnitQuaternion<f64>, level: f64) -> f64 {
    let mut low = Point3::new(0.0, 0.0, f64::INFINITY);
    for piece in shape.pieces() {
        match piece {
            Piece::Ball(ball) => {
                let point = rotation * ball.centre - Vector3::z() * ball.radius;
                low = if point.z < low.z { point } else { low };
            }
            Piece::Hull(hull) => {
                for corner in hull.vertices() {
                    let point = rotation * corner;
                    low = if point.z < low.z { point } else { low };
                }
            }
        }
    }
    let height = low.z + level;
    let front = shape.pieces().iter().map(|piece| front(piece, rotation, height));
    level.atan2(front.fold(f64::NEG_INFINITY, f64::max) - low.x)
}

/// Farthest along x of the piece at this height [m].
fn front(piece: &Piece, rotation: &UnitQuaternion<f64>, height: f64) -> f64 {
    match piece {
        Piece::Ball(ball) => {
            let centre = rotation * ball.centre;
            let square = ball.radius.powi(2) - (height - centre.z).powi(2);
            if square < 0.0 { f64::NEG_INFINITY } else { centre.x + square.sqrt() }
        }
        Piece::Hull(hull) => {
            let corner = |i: u32| rotation * hull.vertices()[i as usize];
            let edges = hull.facets().iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
            let crossing = |[a, b]: [u32; 2]| {
                let (a, b) = (corner(a), corner(b));
                let share = (height - a.z) / (b.z - a.z);
                (0.0..=1.0).contains(&share).then(|| a.x + share * (b.x - a.x))
            };
            edges.filter_map(crossing).fold(f64::NEG_INFINITY, f64::max)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clump(centres: [f64; 2], radius: f64) -> Shape {
        let ball = |x: f64| Piece::Ball(Ball { centre: Point3::new(x, 0.0, 0.0), radius });
        Shape::union(centres.map(ball).to_vec()).expect("two balls")
    }

    /// Fails for an inner sphere of one ball alone, or one of a centre that lies between balls.
    #[test]
    fn the_inner_sphere_is_that_of_the_union() {
        // Two balls of radius 1 meet in a ring of this radius about the centre.
        let ring = (1.0f64 - 0.5 * 0.5).sqrt();
        let inner = inscribed(&clump([-0.5, 0.5], 1.0)).expect("it is inside");
        assert!((inner - ring).abs() < 5e-3, "{inner} {ring}");
        assert_eq!(inscribed(&clump([-2.0, 2.0], 1.0)), None);
        let ball = inscribed(&Shape::ball(3.0).expect("a ball")).expect("it is inside");
        assert!((ball - 3.0).abs() < 1e-12, "{ball}");
    }
}
