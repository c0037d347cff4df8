//! Points in parts that move as rigid bodies: what stays between instants is kept once, what
//! changes is a place and a rotation per part.

use abrade_report::ReportError;
use nalgebra::{Point3, UnitQuaternion};

use crate::rigid;

/// Largest distance that a point of a rigid part may seem to move, over the part's size: far above
/// the rounding of files in f64, and of the page's f32.
const BENT: f64 = 1e-6;
/// The same over the distance from the world's origin, whose rounding the points carry.
const FAR: f64 = 1e-12;

/// The parts at the first instant.
#[derive(Debug)]
pub(crate) struct Moving {
    points: usize,
    parts: Vec<Part>,
    /// Part of every point.
    pub(crate) part: Vec<u32>,
}

/// Points that move together.
#[derive(Debug, Default)]
struct Part {
    members: Vec<u32>,
    /// Where they are at the first instant [m].
    first: Vec<Point3<f64>>,
    centre: Point3<f64>,
    /// Largest distance of a member from the centre [m].
    size: f64,
}

/// Where a part is: the middle of its points [m], and its rotation since the first instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pose {
    pub(crate) centre: Point3<f64>,
    pub(crate) rotation: UnitQuaternion<f64>,
}

impl Moving {
    /// `part` has an entry per point, from 0 on without a gap.
    pub(crate) fn new(points: &[Point3<f64>], part: Vec<u32>) -> Self {
        let count = part.iter().max().map_or(0, |last| *last as usize + 1);
        let mut parts: Vec<Part> = (0..count).map(|_| Part::default()).collect();
        for (at, (point, part)) in points.iter().zip(&part).enumerate() {
            let part = &mut parts[*part as usize];
            part.members.push(at as u32);
            part.first.push(*point);
        }
        for part in &mut parts {
            part.centre = rigid::centroid(&part.first);
            let far = part.first.iter().map(|point| (point - part.centre).norm());
            part.size = far.fold(0.0, f64::max);
        }
        Self { points: points.len(), parts, part }
    }

    /// Number of parts.
    pub(crate) fn len(&self) -> usize {
        self.parts.len()
    }

    /// Every point from the centre of its part, at the first instant [m].
    pub(crate) fn local(&self) -> Vec<[f64; 3]> {
        let mut local = vec![[0.0; 3]; self.points];
        for part in &self.parts {
            for (at, point) in part.members.iter().zip(&part.first) {
                local[*at as usize] = (point - part.centre).into();
            }
        }
        local
    }

    /// Where every part is at the first instant.
    pub(crate) fn first_poses(&self) -> Vec<Pose> {
        let pose = |part: &Part| Pose { centre: part.centre, rotation: UnitQuaternion::identity() };
        self.parts.iter().map(pose).collect()
    }

    /// Where every part is when its points are at `points` [m], as many as at the first instant.
    ///
    /// # Errors
    /// A part has changed its shape: by how much [m].
    pub(crate) fn poses(&self, points: &[Point3<f64>]) -> Result<Vec<Pose>, f64> {
        self.parts.iter().map(|part| part.pose(points)).collect()
    }
}

impl Part {
    fn pose(&self, points: &[Point3<f64>]) -> Result<Pose, f64> {
        let now: Vec<_> = self.members.iter().map(|at| points[*at as usize]).collect();
        let centre = rigid::centroid(&now);
        let rotation = rigid::rotation(&self.first, &now);
        let shift = |(first, now): (&Point3<f64>, &Point3<f64>)| {
            (now - (centre + rotation * (first - self.centre))).norm()
        };
        let shift = self.first.iter().zip(&now).map(shift).fold(0.0, f64::max);
        match shift <= BENT * self.size + FAR * centre.coords.norm() {
            true => Ok(Pose { centre, rotation }),
            false => Err(shift),
        }
    }
}

/// The connected parts of a mesh, numbered by their first points. Points on no triangle are of the
/// first part.
///
/// # Errors
/// A triangle names no point.
pub(crate) fn connected(points: usize, triangles: &[[u32; 3]]) -> Result<Vec<u32>, ReportError> {
    let mut up: Vec<u32> = (0..points as u32).collect();
    for (triangle, corners) in triangles.iter().enumerate() {
        if let Some(&point) = corners.iter().find(|corner| **corner as usize >= points) {
            return Err(ReportError::Triangle { triangle, point, points });
        }
        let [a, b, c] = corners.map(|corner| root(&mut up, corner));
        let least = a.min(b).min(c);
        [a, b, c].iter().for_each(|top| up[*top as usize] = least);
    }
    let mut is_drawn = vec![false; points];
    triangles.iter().flatten().for_each(|corner| is_drawn[*corner as usize] = true);
    let mut numbers = vec![None; points];
    let mut count = 0;
    let part = (0..points as u32).map(|point| {
        if !is_drawn[point as usize] {
            return 0;
        }
        let top = root(&mut up, point) as usize;
        *numbers[top].get_or_insert_with(|| {
            count += 1;
            count - 1
        })
    });
    Ok(part.collect())
}

/// The top of a point's tree, which gets shorter on the way.
fn root(up: &mut [u32], mut at: u32) -> u32 {
    while up[at as usize] != at {
        up[at as usize] = up[up[at as usize] as usize];
        at = up[at as usize];
    }
    at
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use nalgebra::{Isometry3, Vector3};

    use super::*;

    /// Two tetrahedra, the second one beside the first.
    fn pair() -> (Vec<Point3<f64>>, Vec<u32>) {
        let one = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.3, 0.2, 1.0]];
        let one = one.map(Point3::from);
        let both = one.iter().copied().chain(one.map(|point| point + Vector3::x() * 5.0));
        (both.collect(), vec![0, 0, 0, 0, 1, 1, 1, 1])
    }

    /// Fails for one pose over both parts, and for a rotation about the origin in the place of the
    /// part's own middle.
    #[test]
    fn each_part_has_a_motion_of_its_own() {
        let (points, part) = pair();
        let moving = Moving::new(&points, part);
        let motion = Isometry3::new(Vector3::new(0.0, 0.0, 7.0), Vector3::new(0.3, 0.0, 1.2));
        let now: Vec<_> = points
            .iter()
            .enumerate()
            .map(|(at, point)| if at < 4 { *point } else { motion * point })
            .collect();
        let poses = moving.poses(&now).expect("rigid");
        assert_relative_eq!(poses[0].rotation.angle(), 0.0, epsilon = 1e-12);
        for ((now, local), part) in now.iter().zip(moving.local()).zip(&moving.part) {
            let Pose { centre, rotation } = poses[*part as usize];
            assert_relative_eq!(*now, centre + rotation * Vector3::from(local), epsilon = 1e-12);
        }
    }

    /// Fails for a program that draws a stretched part as if it had turned.
    #[test]
    fn a_part_that_changes_its_shape_is_refused() {
        let (mut points, part) = pair();
        let moving = Moving::new(&points, part);
        points[5].x += 1e-3;
        let shift = moving.poses(&points).expect_err("stretched");
        assert!((1e-4..1e-3).contains(&shift), "{shift}");
    }

    /// Fails for parts by the order of triangles, for two that stay apart after a triangle joins
    /// them, and for a part per loose point.
    #[test]
    fn parts_are_what_triangles_join() {
        let part = connected(8, &[[5, 6, 7], [0, 1, 2], [2, 3, 0]]).expect("all there");
        assert_eq!(part, [0, 0, 0, 0, 0, 1, 1, 1]);
        let joined = connected(6, &[[0, 1, 2], [3, 4, 5], [2, 3, 4]]).expect("all there");
        assert_eq!(joined, [0; 6]);
        assert!(connected(2, &[[0, 1, 2]]).is_err());
    }
}
