//! Convex polyhedra: vertices for placement and drawing, face planes for contact.

use nalgebra::{Matrix3, Point3, Vector3};
use parry3d_f64::mass_properties::MassProperties;
use parry3d_f64::math::Vector as ParryVector;
use parry3d_f64::transformation::try_convex_hull;

use crate::body::Inertia;
use crate::error::{ParameterError, ShapeError};
#[cfg(feature = "state")]
use crate::state::{Fault, finite, positive, require};

/// Thickness over extent below which points count as coplanar.
const COPLANAR: f64 = 1e-9;
/// Sine of the angle below which two facets belong to one face.
const SAME_FACE: f64 = 1e-7;

/// A convex polyhedron, kept as its vertices and the planes of its faces.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "state", serde(remote = "Self"))]
pub struct Hull {
    vertices: Vec<Point3<f64>>,
    facets: Vec<[u32; 3]>,
    planes: Vec<Plane>,
}

/// The plane of a face: normal . x = offset, the polyhedron on the side below.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub struct Plane {
    /// Outward unit normal.
    pub normal: Vector3<f64>,
    /// Distance from the origin [m].
    pub offset: f64,
}

/// The regular polyhedra that a scene can name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, schemars::JsonSchema))]
pub enum Polyhedron {
    /// (1,1,1), (1,-1,-1), (-1,1,-1), (-1,-1,1), times edge / sqrt 8.
    Tetrahedron,
    /// Faces along the axes.
    Cube,
    /// (+-1,0,0).., times edge / sqrt 2.
    Octahedron,
    /// (0,+-1,+-phi).., times edge / 2.
    Icosahedron,
}

impl Hull {
    /// The convex hull of `points` and its inertia at `density` [kg/m3]; the hull is moved so that
    /// its centre of mass is the origin, and the shift is returned (old = new + shift).
    ///
    /// # Errors
    /// No points, points that are not finite, or coplanar points.
    pub fn solid(
        points: &[Point3<f64>],
        density: f64,
    ) -> Result<(Self, Inertia, Vector3<f64>), ShapeError> {
        let unit = UnitCloud::of(points)?;
        let coplanar = || unit.coplanar(points.len());
        let (corners, facets) = try_convex_hull(&unit.points).map_err(|_| coplanar())?;
        let solid = MassProperties::from_convex_polyhedron(1.0, &corners, &facets);
        if !(solid.inv_mass.is_finite() && solid.inv_mass > 0.0) {
            return Err(coplanar());
        }
        let centre = from_parry(solid.local_com);
        let back = |p: &ParryVector| Point3::from((from_parry(*p) - centre) * unit.scale);
        let vertices: Vec<_> = corners.iter().map(back).collect();
        let planes = planes_of(&vertices, &facets);
        let m = solid.reconstruct_inertia_matrix();
        let columns = [m.x_axis, m.y_axis, m.z_axis].map(from_parry);
        let inertia = Inertia {
            mass: density * unit.scale.powi(3) / solid.inv_mass,
            tensor: Matrix3::from_columns(&columns) * (density * unit.scale.powi(5)),
        };
        Ok((Self { vertices, facets, planes }, inertia, centre * unit.scale + unit.middle))
    }

    /// Vertices [m].
    pub fn vertices(&self) -> &[Point3<f64>] {
        &self.vertices
    }

    /// Triangles of vertices, outward, for display.
    pub fn facets(&self) -> &[[u32; 3]] {
        &self.facets
    }

    /// Planes of the faces; coplanar facets share one.
    pub fn planes(&self) -> &[Plane] {
        &self.planes
    }

    /// This hull moved by `shift` [m].
    pub fn moved(mut self, shift: &Vector3<f64>) -> Self {
        self.vertices.iter_mut().for_each(|v| *v += shift);
        self.planes.iter_mut().for_each(|p| p.offset += p.normal.dot(shift));
        self
    }

    /// Largest distance of a vertex from the origin [m].
    pub fn bounding_radius(&self) -> f64 {
        self.vertices.iter().map(|v| v.coords.norm()).fold(0.0, f64::max)
    }

    /// Volume [m3].
    pub fn volume(&self) -> f64 {
        let corner = |i: u32| self.vertices[i as usize].coords;
        let six_fold: f64 =
            self.facets.iter().map(|&[a, b, c]| corner(a).dot(&corner(b).cross(&corner(c)))).sum();
        six_fold / 6.0
    }
}

/// Points scaled to unit size: hull algorithms carry absolute tolerances.
struct UnitCloud {
    points: Vec<ParryVector>,
    middle: Vector3<f64>,
    scale: f64,
    thickness: f64,
}

impl UnitCloud {
    fn of(points: &[Point3<f64>]) -> Result<Self, ShapeError> {
        let Some(first) = points.first() else {
            return Err(ShapeError::Empty { what: "the hull has no points" });
        };
        if let Some(value) = points.iter().flat_map(|p| p.coords.data.0[0]).find(|x| !x.is_finite())
        {
            return Err(ParameterError { field: "points", value, allowed: "finite".into() }.into());
        }
        let (low, high) = points.iter().fold((*first, *first), |(l, h), p| (l.inf(p), h.sup(p)));
        let middle = (low.coords + high.coords) / 2.0;
        let scale = (high - low).amax();
        let unit: Vec<Vector3<f64>> =
            points.iter().map(|p| (p.coords - middle) / scale.max(f64::MIN_POSITIVE)).collect();
        let cloud = Self {
            thickness: thickness(&unit),
            points: unit.iter().map(|p| ParryVector::new(p.x, p.y, p.z)).collect(),
            middle,
            scale,
        };
        match cloud.thickness > COPLANAR {
            true => Ok(cloud),
            false => Err(cloud.coplanar(points.len())),
        }
    }

    fn coplanar(&self, points: usize) -> ShapeError {
        ShapeError::Coplanar { points, thickness: self.thickness * self.scale, extent: self.scale }
    }
}

/// Width of the cloud along the direction of least variance.
fn thickness(points: &[Vector3<f64>]) -> f64 {
    let mean = points.iter().sum::<Vector3<f64>>() / points.len() as f64;
    let covariance: Matrix3<f64> = points.iter().map(|p| (p - mean) * (p - mean).transpose()).sum();
    let eigen = covariance.symmetric_eigen();
    let least = eigen.eigenvectors.column(eigen.eigenvalues.imin()).into_owned();
    let along = points.iter().map(|p| p.dot(&least));
    let (low, high) =
        along.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
    high - low
}

/// One plane per face: facets whose normals agree share it. A face's plane goes through its
/// outermost vertex, so that no vertex lies outside.
fn planes_of(vertices: &[Point3<f64>], facets: &[[u32; 3]]) -> Vec<Plane> {
    let mut planes: Vec<(Plane, f64)> = Vec::new();
    for facet in facets {
        let [a, b, c] = facet.map(|i| vertices[i as usize]);
        let cross = (b - a).cross(&(c - a));
        let area = cross.norm();
        if area == 0.0 {
            continue;
        }
        let normal = cross / area;
        let known = planes.iter_mut().find(|(plane, _)| {
            plane.normal.cross(&normal).norm() < SAME_FACE && plane.normal.dot(&normal) > 0.0
        });
        match known {
            // The largest facet of a face has the most accurate normal.
            Some((plane, largest)) if area > *largest => {
                plane.normal = normal;
                *largest = area;
            }
            Some(_) => {}
            None => planes.push((Plane { normal, offset: 0.0 }, area)),
        }
    }
    let outermost = |normal: &Vector3<f64>| {
        vertices.iter().map(|v| v.coords.dot(normal)).fold(f64::NEG_INFINITY, f64::max)
    };
    planes
        .into_iter()
        .map(|(plane, _)| Plane { offset: outermost(&plane.normal), ..plane })
        .collect()
}

fn from_parry(v: ParryVector) -> Vector3<f64> {
    Vector3::new(v.x, v.y, v.z)
}

impl Polyhedron {
    /// Vertices of the polyhedron with this `edge` [m].
    pub fn vertices(self, edge: f64) -> Vec<Point3<f64>> {
        let phi = 0.5 * (1.0 + 5f64.sqrt());
        let (unit, scale): (Vec<[f64; 3]>, f64) = match self {
            Self::Tetrahedron => (
                vec![[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]],
                1.0 / 8f64.sqrt(),
            ),
            Self::Cube => return cuboid_vertices(&Vector3::repeat(0.5 * edge)),
            Self::Octahedron => {
                let axis = |a: usize, s: f64| std::array::from_fn(|i| if i == a { s } else { 0.0 });
                ((0..6).map(|i| axis(i / 2, [1.0, -1.0][i % 2])).collect(), 0.5f64.sqrt())
            }
            Self::Icosahedron => {
                let corner = |i: usize| {
                    let (a, b) = ([1.0, -1.0][i & 1], phi * [1.0, -1.0][i >> 1 & 1]);
                    let mut v = [0.0, a, b];
                    v.rotate_right(i / 4);
                    v
                };
                ((0..12).map(corner).collect(), 0.5)
            }
        };
        unit.into_iter().map(|v| Point3::from(v) * (scale * edge)).collect()
    }
}

/// Vertices of a box with these half extents [m].
pub fn cuboid_vertices(half_extents: &Vector3<f64>) -> Vec<Point3<f64>> {
    let sign = |i: usize, a: usize| if i >> a & 1 == 0 { -1.0 } else { 1.0 };
    (0..8).map(|i| Point3::from(Vector3::from_fn(|a, _| sign(i, a) * half_extents[a]))).collect()
}

#[cfg(feature = "state")]
impl Hull {
    pub(crate) fn checked(self) -> Result<Self, Fault> {
        let corners = self.vertices.iter().flat_map(|v| v.coords.iter());
        let planes = self.planes.iter().flat_map(|p| p.normal.iter().chain([&p.offset]));
        require(finite(corners), "a corner is not finite")?;
        require(finite(planes), "a plane is not finite")?;
        let count = self.vertices.len();
        let inside = self.facets.iter().flatten().all(|&i| (i as usize) < count);
        require(inside, "a facet of a hull has no corner")?;
        let solid = !self.planes.is_empty() && positive(self.volume());
        require(solid, "a hull has no volume")?;
        Ok(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for a wrong edge, a wrong inertia, split faces or a tolerance that is not relative.
    #[test]
    fn regular_solids_have_their_faces_volume_and_inertia_at_any_size() {
        let phi = 0.5 * (1.0 + 5f64.sqrt());
        for edge in [1e-7, 3e-3, 40.0] {
            for (kind, faces, volume, gyration) in [
                (Polyhedron::Tetrahedron, 4, 1.0 / 72f64.sqrt(), 1.0 / 20.0),
                (Polyhedron::Cube, 6, 1.0, 1.0 / 6.0),
                (Polyhedron::Octahedron, 8, 2f64.sqrt() / 3.0, 0.1),
                (Polyhedron::Icosahedron, 20, 5.0 * phi * phi / 6.0, phi * phi / 10.0),
            ] {
                let (hull, inertia, shift) =
                    Hull::solid(&kind.vertices(edge), 2.0).expect("a regular solid");
                assert_eq!(hull.planes().len(), faces, "{kind:?}");
                let mass = 2.0 * volume * edge.powi(3);
                assert!((inertia.mass / mass - 1.0).abs() < 1e-12, "{kind:?}");
                let expected = Matrix3::from_diagonal_element(gyration * mass * edge * edge);
                let miss = (inertia.tensor - expected).amax() / expected.amax();
                assert!(miss < 1e-9, "{kind:?} {miss:e}");
                assert!(shift.norm() < 1e-12 * edge);
            }
        }
    }

    /// Fails for a hull that accepts points without volume.
    #[test]
    fn flat_points_are_refused() {
        let flat: Vec<_> =
            (0..9).map(|i| Point3::new((i % 3) as f64, (i / 3) as f64, (i % 3) as f64)).collect();
        assert!(matches!(Hull::solid(&flat, 1.0), Err(ShapeError::Coplanar { points: 9, .. })));
        assert!(matches!(Hull::solid(&[], 1.0), Err(ShapeError::Empty { .. })));
        let point = [Point3::new(1.0, 2.0, 3.0); 5];
        assert!(matches!(Hull::solid(&point, 1.0), Err(ShapeError::Coplanar { .. })));
    }
}
