//! The rigid motion between two sets of points: W. Kabsch, Acta Crystallographica A 34 (1978) 827.

use nalgebra::{Matrix3, Point3, Rotation3, UnitQuaternion, Vector3};

/// Mean of the points [m].
pub(crate) fn centroid(points: &[Point3<f64>]) -> Point3<f64> {
    // Summed from the first point, so that a body far from the origin loses no digits.
    let Some(first) = points.first() else { return Point3::origin() };
    let sum: Vector3<f64> = points.iter().map(|point| point - first).sum();
    first + sum / points.len() as f64
}

/// The rotation that takes `from` (about their centroid) closest to `to` (about theirs), in the
/// sense of least squares; for points in a plane too. The columns are of one length.
pub(crate) fn rotation(from: &[Point3<f64>], to: &[Point3<f64>]) -> UnitQuaternion<f64> {
    let (before, after) = (centroid(from), centroid(to));
    let pairs = from.iter().zip(to);
    let covariance: Matrix3<f64> =
        pairs.map(|(from, to)| (to - after) * (from - before).transpose()).sum();
    let decomposed = covariance.svd(true, true);
    let (Some(left), Some(right)) = (decomposed.u, decomposed.v_t) else {
        return UnitQuaternion::identity();
    };
    // The least singular vector is turned over where the product would mirror.
    let mirrored = (left * right).determinant() < 0.0;
    let least = decomposed.singular_values.imin();
    let mut signs = Vector3::repeat(1.0);
    signs[least] = if mirrored { -1.0 } else { 1.0 };
    let matrix = left * Matrix3::from_diagonal(&signs) * right;
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(matrix))
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use nalgebra::{Isometry3, Translation3};

    use super::*;

    fn moved(points: &[Point3<f64>], turn: UnitQuaternion<f64>) -> Vec<Point3<f64>> {
        let motion = Isometry3::from_parts(Translation3::new(1e3, -2.0, 0.5), turn);
        points.iter().map(|point| motion * point).collect()
    }

    /// Fails for a fit that mirrors a plate, whose least singular value is zero, or that turns the
    /// wrong way round.
    #[test]
    fn a_rotation_is_found_again_of_solids_and_of_plates() {
        let solid = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.3, 0.2, 1.0]];
        let plate = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 2.0, 1.0], [1.0, 2.0, 1.0]];
        for points in [solid, plate].map(|points| points.map(Point3::from)) {
            for angle in [0.0, 1e-9, 0.7, 2.0, 3.1] {
                let axis = nalgebra::Unit::new_normalize(Vector3::new(1.0, -2.0, 0.5));
                let turn = UnitQuaternion::from_axis_angle(&axis, angle);
                let found = rotation(&points, &moved(&points, turn));
                assert_relative_eq!(found.angle_to(&turn), 0.0, epsilon = 1e-12);
            }
        }
    }
}
