//! Triangle meshes of bodies, for display alone: a ball becomes an icosphere, which is a little
//! smaller than the ball it stands for.

use std::collections::BTreeMap;

use abrade::{Ball, Hull, Piece, Shape};
use nalgebra::{Point3, Vector3};

use crate::error::ReportError;

/// Triangles in a body's frame, counter-clockwise from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Corners [m].
    pub points: Vec<Point3<f64>>,
    /// Three corners each.
    pub triangles: Vec<[u32; 3]>,
}

/// Times an icosahedron's triangles are quartered: 12, 42, 162 vertices.
const QUARTERINGS: usize = 2;

impl Mesh {
    /// All pieces of a shape, the overlaps of a clump included.
    ///
    /// # Errors
    /// The faces of a hull cannot be found.
    pub fn of_shape(shape: &Shape) -> Result<Self, ReportError> {
        let mut mesh = Self::default();
        for piece in shape.pieces() {
            mesh.append(&match piece {
                Piece::Ball(ball) => Self::of_ball(ball),
                Piece::Hull(hull) => Self::of_hull(hull)?,
            });
        }
        Ok(mesh)
    }

    /// An icosphere of 162 vertices that lie on the ball.
    pub fn of_ball(ball: &Ball) -> Self {
        let mut mesh = icosahedron();
        for _ in 0..QUARTERINGS {
            mesh = mesh.quartered();
        }
        for point in &mut mesh.points {
            *point = ball.centre + point.coords.normalize() * ball.radius;
        }
        mesh
    }

    /// The faces of a hull.
    ///
    /// # Errors
    /// The vertices are coplanar, or too close to it.
    pub fn of_hull(hull: &Hull) -> Result<Self, ReportError> {
        Self::of_convex(hull.vertices())
    }

    /// The convex hull of `points` [m].
    ///
    /// # Errors
    /// The points are coplanar, or too close to it.
    pub fn of_convex(points: &[Point3<f64>]) -> Result<Self, ReportError> {
        type Corner = parry3d_f64::math::Vector3;
        let corners: Vec<_> = points.iter().map(|p| Corner::new(p.x, p.y, p.z)).collect();
        let (corners, triangles) = parry3d_f64::transformation::try_convex_hull(&corners)
            .map_err(|e| ReportError::Hull { vertices: points.len(), source: Box::new(e) })?;
        let points = corners.iter().map(|c| Point3::new(c.x, c.y, c.z)).collect();
        Ok(Self { points, triangles })
    }

    fn append(&mut self, other: &Self) {
        let first = self.points.len() as u32;
        self.points.extend_from_slice(&other.points);
        self.triangles.extend(other.triangles.iter().map(|t| t.map(|corner| corner + first)));
    }

    /// Every triangle split into four at the middles of its edges.
    fn quartered(&self) -> Self {
        let mut points = self.points.clone();
        let mut middles = BTreeMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                points.push(nalgebra::center(&points[a as usize], &points[b as usize]));
                points.len() as u32 - 1
            })
        };
        let mut triangles = Vec::with_capacity(4 * self.triangles.len());
        for &[a, b, c] in &self.triangles {
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            triangles.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        Self { points, triangles }
    }
}

/// The twelve points (0, +-1, +-phi) and their cyclic images. Its faces are the twenty triples of
/// points that are all two apart.
fn icosahedron() -> Mesh {
    let phi = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let signs = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
    let points: Vec<Point3<f64>> = (0..3)
        .flat_map(|turn| {
            signs.map(|(a, b)| {
                let v = [0.0, a, b * phi];
                Point3::new(v[turn % 3], v[(turn + 1) % 3], v[(turn + 2) % 3])
            })
        })
        .collect();
    let near = |a: usize, b: usize| (points[a] - points[b]).norm_squared() < 4.5;
    let mut triangles = Vec::with_capacity(20);
    for a in 0..12 {
        for b in (a + 1..12).filter(|&b| near(a, b)) {
            for c in (b + 1..12).filter(|&c| near(a, c) && near(b, c)) {
                let outward = facing(&points, [a, b, c]).dot(&points[a].coords) > 0.0;
                let (b, c) = if outward { (b, c) } else { (c, b) };
                triangles.push([a as u32, b as u32, c as u32]);
            }
        }
    }
    Mesh { points, triangles }
}

/// Twice the area of a triangle, along its normal [m2].
fn facing(points: &[Point3<f64>], [a, b, c]: [usize; 3]) -> Vector3<f64> {
    (points[b] - points[a]).cross(&(points[c] - points[a]))
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    /// Sixth of the sum of (a x b) . c: the volume inside a closed mesh that faces outward.
    fn volume(mesh: &Mesh) -> f64 {
        let corner = |i: u32| mesh.points[i as usize].coords;
        let six = |t: &[u32; 3]| corner(t[0]).cross(&corner(t[1])).dot(&corner(t[2]));
        mesh.triangles.iter().map(six).sum::<f64>() / 6.0
    }

    /// A program with a missing, doubled or inward face would not enclose the ball's volume; the
    /// tolerance is what flat triangles of this size cut off a sphere (about 3.5 %).
    #[test]
    fn an_icosphere_encloses_nearly_its_ball() {
        let ball = Ball { centre: Point3::new(1.0, 2.0, 3.0), radius: 2.0 };
        let mesh = Mesh::of_ball(&ball);
        assert_eq!((mesh.points.len(), mesh.triangles.len()), (162, 320));
        for point in &mesh.points {
            assert_relative_eq!((point - ball.centre).norm(), 2.0, max_relative = 1e-12);
        }
        let exact = 4.0 / 3.0 * std::f64::consts::PI * 8.0;
        let share = volume(&mesh) / exact;
        assert!((0.95..1.0).contains(&share), "{share}");
    }

    /// A program that lost a vertex or turned a face would not enclose the box.
    #[test]
    fn a_hull_encloses_its_box() {
        let corners = (0..8_u32).map(|i| {
            let side = |bit: u32, half: f64| if i & bit == 0 { -half } else { half };
            Point3::new(side(1, 0.5), side(2, 1.0), side(4, 1.5))
        });
        let mesh = Mesh::of_convex(&corners.collect::<Vec<_>>()).expect("a box is not flat");
        assert_eq!(mesh.triangles.len(), 12);
        assert_relative_eq!(volume(&mesh), 6.0, max_relative = 1e-12);
    }

    /// A program that let the hull code panic would take the run down with it.
    #[test]
    fn flat_points_are_a_typed_error() {
        let error = Mesh::of_convex(&[Point3::origin(); 4]).expect_err("no volume");
        assert!(matches!(error, ReportError::Hull { vertices: 4, .. }));
    }
}
