//! Where surfaces lie and how bodies start, in the world.

use abrade::{Ball, ElasticLaw, HexStrip, Piece, Shape, State};
use nalgebra::{
    Isometry3, Point3, Quaternion, Translation3, Unit, UnitQuaternion, Vector3, Vector4,
};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;

use crate::led_path::LedPath;
use crate::scene::{Geometry, Motion, Placement, Rotation, SceneBody, SceneSurface};
use crate::solid::Solid;

/// Relative round-off that a placement may carry, of a body's size.
const PLACEMENT_ROUND_OFF: f64 = 1e-9;

/// The rotation, or none if its axis or quaternion has no direction.
pub(crate) fn rotation(rotation: &Rotation) -> Option<UnitQuaternion<f64>> {
    match *rotation {
        Rotation::AxisAngle { axis, angle } => {
            let axis = direction(Vector3::from(axis))?;
            Some(UnitQuaternion::from_axis_angle(&Unit::new_unchecked(axis), angle))
        }
        Rotation::Quaternion { xyzw } => {
            let unit = direction(Vector4::from(xyzw))?;
            Some(Unit::new_unchecked(Quaternion::from_vector(unit)))
        }
        Rotation::Random { seed } => Some(random(seed)),
    }
}

/// `v` over its length, whatever that is.
pub(crate) fn direction<const N: usize>(
    v: nalgebra::SVector<f64, N>,
) -> Option<nalgebra::SVector<f64, N>> {
    let largest = v.amax();
    let fine = largest.is_finite() && largest > 0.0;
    fine.then(|| (v / largest).normalize())
}

/// Uniform over all rotations: Shoemake (1992), three uniform numbers to a unit quaternion.
fn random(seed: u64) -> UnitQuaternion<f64> {
    let mut generator = Pcg32::seed_from_u64(seed);
    let [u, v, w]: [f64; 3] = generator.random();
    let turn = std::f64::consts::TAU;
    let (a, b) = ((1.0 - u).sqrt(), u.sqrt());
    let (i, j) = (a * (turn * v).sin(), a * (turn * v).cos());
    let (k, real) = (b * (turn * w).sin(), b * (turn * w).cos());
    UnitQuaternion::new_normalize(Quaternion::new(real, i, j, k))
}

/// Frame of a surface at the start, in the world, `path` being what it is led along; none if its
/// rotation has no direction.
pub(crate) fn start(surface: &SceneSurface, path: Option<&LedPath>) -> Option<Isometry3<f64>> {
    path.map_or_else(|| home(surface), |path| Some(path.at(0.0)))
}

/// Frame that the position and the rotation of a surface say, in the world; none if the rotation
/// has no direction.
pub(crate) fn home(surface: &SceneSurface) -> Option<Isometry3<f64>> {
    let translation = Translation3::from(Vector3::from(surface.position));
    Some(Isometry3::from_parts(translation, rotation(&surface.rotation)?))
}

/// The strip that a geometry describes; none if it is another one, or its pitch is not settled.
pub(crate) fn strip(geometry: &Geometry) -> Option<HexStrip> {
    let Geometry::HexStrip { length, width, pitch, nodes, rest_area } = *geometry else {
        return None;
    };
    let mut strip = match (pitch, nodes) {
        (Some(pitch), None) => HexStrip { length, width, pitch, rest_area: None },
        (None, Some(nodes)) => HexStrip::with_nodes(length, width, f64::from(nodes)),
        _ => return None,
    };
    strip.rest_area = rest_area.or(strip.rest_area);
    Some(strip)
}

/// Height of the node spheres above the node plane [m].
pub(crate) fn node_height(surface: &SceneSurface) -> f64 {
    match surface.elastic {
        ElasticLaw::HertzNodes { node_radius, .. } => node_radius,
        _ => 0.0,
    }
}

/// State at the start, in the frame that the body's placement names.
pub(crate) fn local_state(
    body: &SceneBody,
    solid: &Solid,
    surface: Option<&SceneSurface>,
) -> Option<State> {
    let rotation = rotation(&body.rotation)?;
    let position = match &body.position {
        Placement::OnSurface { at, gap, .. } => {
            let lowest = solid.shape.lowest(&rotation, &Vector3::z());
            let nodes = surface.map_or(0.0, node_height);
            Point3::new(at[0], at[1], gap + nodes - lowest)
        }
        Placement::InFrame { point, .. } | Placement::At { point } => Point3::from(*point),
    };
    let (velocity, spin) = velocity(&body.motion);
    Some(State { position, rotation, velocity, spin })
}

/// Velocity and spin at the start.
pub(crate) fn velocity(motion: &Motion) -> (Vector3<f64>, Vector3<f64>) {
    match *motion {
        Motion::Impact { speed, angle, azimuth, spin } => {
            let along = speed * angle.cos();
            let v = [along * azimuth.cos(), along * azimuth.sin(), -speed * angle.sin()];
            (v.into(), spin.into())
        }
        Motion::Free { velocity, spin } => (velocity.into(), spin.into()),
        Motion::Fixed | Motion::Drive { .. } => (Vector3::zeros(), Vector3::zeros()),
    }
}

/// Round-off [m] that a placement may carry.
pub(crate) fn round_off(shape: &Shape, state: &State) -> f64 {
    PLACEMENT_ROUND_OFF * shape.bounding_radius()
        + 8.0 * f64::EPSILON * state.position.coords.norm()
}

/// Depth [m] of a body below the node surface of `strip`, `state` being in the strip's frame; none
/// if it lies above or beside it.
pub(crate) fn depth_inside(
    shape: &Shape,
    state: &State,
    strip: &HexStrip,
    node_height: f64,
) -> Option<f64> {
    let half = Vector3::new(strip.length / 2.0 + strip.pitch, strip.width / 2.0 + strip.pitch, 0.0);
    let depth = |piece: &Piece| match piece {
        Piece::Ball(ball) => {
            let centre = state.pose() * ball.centre;
            ball_depth(&Ball { centre, radius: ball.radius + node_height }, &half)
        }
        Piece::Hull(hull) => {
            let corner = |v: &Point3<f64>| state.pose() * v;
            let mut corners = hull.vertices().iter().map(corner);
            let first = corners.next()?;
            let (low, high) = corners.fold((first, first), |(l, h), v| (l.inf(&v), h.sup(&v)));
            let beside = (0..2).any(|axis| low[axis] > half[axis] || high[axis] < -half[axis]);
            (!beside).then_some(node_height - low.z)
        }
    };
    let deepest = shape.pieces().iter().filter_map(depth).fold(0.0, f64::max);
    (deepest > round_off(shape, state)).then_some(deepest)
}

/// Depth of a ball below the part of the plane z = 0 within `half` of the origin.
fn ball_depth(ball: &Ball, half: &Vector3<f64>) -> Option<f64> {
    let depth = ball.radius - ball.centre.z;
    let above = ball.centre.z.max(0.0);
    let reach = (ball.radius * ball.radius - above * above).max(0.0).sqrt();
    let outside = |axis: usize| (ball.centre[axis].abs() - half[axis]).max(0.0);
    (outside(0).hypot(outside(1)) <= reach).then_some(depth)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn random_rotations_have_no_preferred_direction() {
        let mut sum = Vector3::zeros();
        let mut square = nalgebra::Matrix3::zeros();
        for seed in 0..4000 {
            let z = random(seed) * Vector3::z();
            sum += z;
            square += z * z.transpose();
        }
        // Standard deviation of a mean of 4000: 0.009 for a component, 0.005 for its square.
        assert!((sum / 4000.0).amax() < 0.04, "{sum}");
        let third = nalgebra::Matrix3::from_diagonal_element(1.0 / 3.0);
        assert!((square / 4000.0 - third).amax() < 0.02, "{square}");
        assert_eq!(random(7), random(7));
    }

    #[test]
    fn a_ball_beside_or_above_the_plate_is_not_inside_it() {
        let strip = HexStrip { length: 2.0, width: 1.0, pitch: 0.01, rest_area: None };
        let shape = Shape::ball(0.1).unwrap();
        let depth = |x, y, z| {
            let state = State::at(Point3::new(x, y, z));
            depth_inside(&shape, &state, &strip, 0.0).map(|depth| (depth * 1e6).round() / 1e6)
        };
        assert_eq!(depth(0.0, 0.0, 0.1), None);
        assert_eq!(depth(0.0, 0.0, 0.09), Some(0.01));
        assert_eq!(depth(0.0, 0.0, -3.0), Some(3.1));
        assert_eq!(depth(1.12, 0.0, 0.0), None);
        assert_eq!(depth(1.05, 0.0, 0.0), Some(0.1));
    }
}
