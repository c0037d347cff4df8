//! A pipe that turns a corner: rings of nodes around its axis, out along the bore, back along the
//! outside, joined by triangles.

use std::f64::consts::{PI, TAU};

use nalgebra::{Point3, Vector3};

use super::TriangleMesh;
use super::check::bound_count;
use super::error::MeshError;
use super::lathe::{Ring, stitch};
use super::solids::{check_round, check_sizes};
use crate::error::ParameterError;
use crate::surface::SOLID_NODE_LIMIT;

/// Sizes of a pipe bend. Its axis comes along +z to the origin of its frame, turns by `angle` about
/// the line x = `radius`, z = 0, towards +x, and goes on straight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bend {
    /// Radius of the bore [m].
    pub inner: f64,
    /// Radius of the outside [m].
    pub outer: f64,
    /// Radius of the bent axis [m].
    pub radius: f64,
    /// Angle by which the axis turns [rad], up to half a turn.
    pub angle: f64,
    /// Length of the straight pipe before and behind the bend [m]; may be zero.
    pub straight: f64,
}

impl TriangleMesh {
    /// The pipe `bend`, vertices on its true surface, about `pitch` [m] apart on the outside of the
    /// turn and closer on its inside.
    ///
    /// # Errors
    /// Sizes out of range, too coarse, too many vertices.
    pub fn bend(bend: &Bend, pitch: f64) -> Result<Self, MeshError> {
        bend.check(pitch)?;
        let rows = bend.rows(pitch)?;
        let mut vertices = Vec::new();
        let lay = |(number, row): (usize, &Row)| {
            let place = |angle: f64| bend.point(row.station, row.radius, angle);
            Ring::around(TAU * row.radius / pitch, number, &mut vertices, place)
        };
        let rings: Vec<Ring> = rows.iter().enumerate().map(lay).collect();
        let mut triangles = Vec::new();
        rings.windows(2).for_each(|pair| stitch(&pair[0], &pair[1], &mut triangles));
        stitch(&rings[rings.len() - 1], &rings[0], &mut triangles);
        Self::new(vertices, triangles)
    }
}

/// A ring around the axis: how far along it, and of which radius [m].
#[derive(Clone, Copy, Debug)]
struct Row {
    station: f64,
    radius: f64,
}

impl Bend {
    fn check(&self, pitch: f64) -> Result<(), MeshError> {
        let Self { inner, outer, radius, angle, straight } = *self;
        check_sizes([("inner", inner), ("outer", outer), ("radius", radius), ("pitch", pitch)])?;
        let below = |field, value: f64, bound: &str, limit: f64| {
            let allowed = format!("below `{bound}`, which is {limit}");
            (value >= limit).then_some(ParameterError { field, value, allowed })
        };
        let turns = angle > 0.0 && angle <= PI;
        let runs = straight >= 0.0 && straight.is_finite();
        let fault = below("inner", inner, "outer", outer)
            .or_else(|| below("outer", outer, "radius", radius))
            .or_else(|| {
                let allowed = "above 0 and at most 180 deg".to_owned();
                (!turns).then_some(ParameterError { field: "angle", value: angle, allowed })
            })
            .or_else(|| {
                let allowed = "finite and not below zero".to_owned();
                (!runs).then_some(ParameterError { field: "straight", value: straight, allowed })
            });
        if let Some(fault) = fault {
            return Err(fault.into());
        }
        check_round("inner", inner, pitch)?;
        check_round("outer", outer, pitch)
    }

    /// The rings, once around the material: back through the bore, out over the first end, along
    /// the outside and in over the last end.
    fn rows(&self, pitch: f64) -> Result<Vec<Row>, MeshError> {
        let height = pitch * 0.75f64.sqrt();
        let parts = |length: f64| (length / height).round().max(1.0);
        let counts = [self.inner, self.outer].map(|wall| {
            let ends = if self.straight > 0.0 { parts(self.straight) } else { 0.0 };
            [ends, parts((self.radius + wall) * self.angle), ends]
        });
        let across = parts(self.outer - self.inner);
        let around = |wall: f64, rings: f64| rings * (TAU * wall / pitch + 1.0);
        let nodes = around(self.inner, counts[0].iter().sum())
            + around(self.outer, counts[1].iter().sum::<f64>() + 2.0 * across);
        bound_count("vertices", nodes, SOLID_NODE_LIMIT)?;
        let [bore, outside] = counts.map(|counts| self.stations(&counts));
        let wall = |k: usize| self.inner + (self.outer - self.inner) * k as f64 / across;
        let ends = 1..across as usize;
        let row = |station: f64, radius: f64| Row { station, radius };
        let (first, last) = (bore[0], bore[bore.len() - 1]);
        let mut rows: Vec<Row> = bore.iter().rev().map(|s| row(*s, self.inner)).collect();
        rows.extend(ends.clone().map(|k| row(first, wall(k))));
        rows.extend(outside.iter().map(|s| row(*s, self.outer)));
        rows.extend(ends.rev().map(|k| row(last, wall(k))));
        Ok(rows)
    }

    /// Places of rings along the axis [m], from the bend's beginning; `counts` are the parts of the
    /// straight pipe before it, of the bend and of the pipe behind it.
    fn stations(&self, counts: &[f64; 3]) -> Vec<f64> {
        let turn = self.radius * self.angle;
        let ends = [-self.straight, 0.0, turn, turn + self.straight];
        let mut stations = vec![ends[0]];
        for (piece, parts) in counts.iter().enumerate() {
            let (from, to) = (ends[piece], ends[piece + 1]);
            let place = |k: usize| match k == *parts as usize {
                true => to,
                false => from + (to - from) * k as f64 / parts,
            };
            stations.extend((1..=*parts as usize).map(place));
        }
        stations
    }

    /// The point at `angle` [rad] around the axis, `distance` [m] from it; `station` [m] along it.
    fn point(&self, station: f64, distance: f64, angle: f64) -> Point3<f64> {
        let theta = (station / self.radius).clamp(0.0, self.angle);
        let beyond = station - theta * self.radius;
        let (sin, cos) = theta.sin_cos();
        let along = Vector3::new(sin, 0.0, cos);
        let inward = Vector3::new(cos, 0.0, -sin);
        let middle = Point3::new(self.radius, 0.0, 0.0) - inward * self.radius + along * beyond;
        middle + (inward * angle.cos() + Vector3::y() * angle.sin()) * distance
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;

    const ELBOW: Bend =
        Bend { inner: 6e-3, outer: 8e-3, radius: 20e-3, angle: FRAC_PI_2, straight: 15e-3 };

    /// Fails for a pipe whose walls face the wrong way, or whose turn has the radius of another
    /// line than its axis (Pappus: volume = area of the section times length of the axis).
    #[test]
    fn a_bend_has_the_volume_of_its_section_along_its_axis() {
        for (angle, straight) in [(FRAC_PI_2, 15e-3), (0.5, 0.0), (PI, 5e-3)] {
            let bend = Bend { angle, straight, ..ELBOW };
            let mesh = TriangleMesh::bend(&bend, 0.5e-3).expect("a bend");
            let section = PI * (64e-6 - 36e-6);
            let volume = section * (20e-3 * angle + 2.0 * straight);
            let miss = mesh.volume() / volume - 1.0;
            assert!(miss.abs() < 5e-3, "{angle}: {miss:e}");
        }
    }

    /// Fails for nodes off the walls, for a turn towards another side, and for an end that stands
    /// askew.
    #[test]
    fn nodes_lie_on_the_walls_and_the_ends() {
        let mesh = TriangleMesh::bend(&ELBOW, 0.6e-3).expect("a bend");
        let ends = |p: &Point3<f64>| {
            let (inlet, outlet) = ((p.z + 15e-3).abs(), (p.x - 35e-3).abs());
            inlet.min(outlet) < 1e-12
        };
        for p in mesh.vertices() {
            let distance = if p.z < 0.0 {
                p.coords.xy().norm()
            } else if p.x > 20e-3 {
                (p.z - 20e-3).hypot(p.y)
            } else {
                ((20e-3 - p.x).hypot(p.z) - 20e-3).hypot(p.y)
            };
            let on_wall = [6e-3, 8e-3].iter().any(|wall| (distance - wall).abs() < 1e-12);
            assert!(on_wall || (ends(p) && (6e-3..8e-3).contains(&distance)), "{p}");
        }
        let pitch = mesh.pitch();
        assert!((pitch / 0.6e-3 - 1.0).abs() < 0.2, "{pitch}");
    }

    #[test]
    fn sizes_that_make_no_pipe_are_refused_by_name() {
        for (bend, field) in [
            (Bend { inner: 8e-3, ..ELBOW }, "inner"),
            (Bend { outer: 20e-3, ..ELBOW }, "outer"),
            (Bend { angle: 0.0, ..ELBOW }, "angle"),
            (Bend { angle: 3.2, ..ELBOW }, "angle"),
            (Bend { straight: -1e-3, ..ELBOW }, "straight"),
            (Bend { radius: f64::NAN, ..ELBOW }, "radius"),
        ] {
            let error = TriangleMesh::bend(&bend, 0.5e-3).expect_err(field);
            let MeshError::Parameter(found) = &error else { panic!("{error}") };
            assert_eq!(found.field, field, "{error}");
        }
        let coarse = TriangleMesh::bend(&ELBOW, 6e-3).expect_err("too coarse");
        assert!(matches!(coarse, MeshError::TooCoarse { field: "inner", .. }), "{coarse}");
        let fine = TriangleMesh::bend(&ELBOW, 1e-8).expect_err("too fine");
        assert!(matches!(fine, MeshError::TooMany { .. }), "{fine}");
    }
}
