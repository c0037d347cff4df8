//! A sphere of many faces on a foundation, in normal impact: lengths in R, speeds in v, H = 1,
//! beta = m v^2 / (2 pi H R^3). Faces press columns by their overlap along the column, as the
//! table's integration does; a ball presses nodes along its own radius, which is another law.

use std::f64::consts::PI;

use abrade::{ElasticLaw, HexStrip, Inertia};
use nalgebra::{Matrix3, Point3};

use crate::sphere::{Study, rms};
use crate::table::{Row, number, read};
use crate::theory::{Shot, hull, rigid};

/// Rings of corners from the pole to the cap's rim, and corners of each.
const RINGS: usize = 24;
const CORNERS: usize = 48;
/// Polar angle of the rim; the largest contact of the table ends at 0.70.
const RIM: f64 = 0.85;

/// The lower cap of a unit sphere, and its top.
fn cap() -> Vec<Point3<f64>> {
    let corner = |ring: usize, i: usize| {
        let (polar, turn) = (RIM * ring as f64 / RINGS as f64, 0.5 * (ring % 2) as f64);
        let around = 2.0 * PI * (i as f64 + turn) / CORNERS as f64;
        let (sin, cos) = polar.sin_cos();
        Point3::new(sin * around.cos(), sin * around.sin(), -cos)
    };
    let poles = [Point3::new(0.0, 0.0, -1.0), Point3::new(0.0, 0.0, 1.0)];
    let rings = (1..=RINGS).flat_map(|ring| (0..CORNERS).map(move |i| corner(ring, i)));
    rings.chain(poles).collect()
}

/// The cap of `row` on a plate with `nodes` of them across its largest contact.
fn shot(row: &Row, points: &[Point3<f64>], nodes: f64) -> Shot {
    let depth = number(row, "hmax");
    let across = 2.0 * (depth * (2.0 - depth)).sqrt();
    let pitch = across / nodes;
    let extent = across + 8.0 * pitch;
    let strip = HexStrip { length: extent, width: extent, pitch, rest_area: None };
    let mass = 2.0 * PI * number(row, "beta");
    let (shape, _) = hull(points, mass);
    let inertia = Inertia { mass, tensor: mass * Matrix3::identity() };
    let stiffness = Some(1.0 / number(row, "dy"));
    Shot {
        elastic: ElasticLaw::Foundation { stiffness },
        rotation_locked: true,
        ..rigid(shape, inertia, 90.0, strip)
    }
}

/// Fails for springs under faces that press along the face's normal, by the cut area in the place of the
/// one seen along the column, or that give back another energy than they took.
#[test]
fn a_sphere_of_many_faces_rebounds_from_a_foundation_as_the_theory_says() {
    let points = cap();
    let mut study = Study::new(["W", "COR", "depth"], 20, [1e-3, 1e-3, 1e-3]);
    // The other rows are of pressures that grow with a power of the overlap other than one.
    for row in read("foundation_sphere_normal").iter().filter(|row| number(row, "q") == 1.0) {
        study.row(&format!("beta {} dy {}", row["beta"], row["dy"]), |nodes| {
            rms(&shot(row, &points, nodes), |end| {
                [
                    end.paid / end.energy[0] - number(row, "WH_over_E0"),
                    end.state.velocity.z - number(row, "COR"),
                    end.surface.worn().max_depth + number(row, "dy") - number(row, "hmax"),
                ]
            })
        });
    }
    study.finish();
}
