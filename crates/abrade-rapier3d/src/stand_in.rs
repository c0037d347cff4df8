//! The shape that stands for a worn solid in Rapier's world.
//!
//! It holds every node. A convex one stays as it is while the solid fills it: a drum with a groove
//! keeps its smooth cylinder, on which nothing hops, and a cube becomes the hull of what is left.

use nalgebra::Vector3;
use rapier::geometry::{Collider, SharedShape};
use rapier::math::Vector;
use rapier::parry::shape::{SupportMap, TypedShape};

use crate::scalar;
use crate::surface::WornCollider;

/// Directions in which a convex shape is compared with the nodes.
const DIRECTIONS: usize = 200;
/// Pitches that the nodes keep away from a convex shape before it is made anew.
const SLACK: f64 = 0.25;
/// Turn from one direction to the next, which spreads them evenly [rad].
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

/// What stands for the worn solid in place of the shape of `proxy`; None where that has to stay, and
/// where the solid still fills it.
pub(crate) fn shape(proxy: &Collider, worn: &WornCollider) -> Option<SharedShape> {
    let nodes = worn.surface.nodes();
    let places: Vec<Vector3<f64>> =
        (0..nodes.len()).map(|i| (worn.offset * nodes.position(i)).coords).collect();
    let corners = || -> Vec<Vector> { places.iter().map(scalar::to_vector).collect() };
    match proxy.shape().as_typed_shape() {
        TypedShape::Ball(ball) => {
            let farthest = places.iter().map(Vector3::norm).fold(0.0, f64::max);
            Some(SharedShape::ball(ball.radius.min(scalar::narrow(farthest))))
        }
        TypedShape::TriMesh(mesh) => {
            let facets = worn.surface.triangles();
            SharedShape::trimesh_with_flags(corners(), facets, mesh.flags()).ok()
        }
        _ if !proxy.shape().is_convex() => None,
        _ => {
            let slack = SLACK * worn.surface.pitch();
            let whole = proxy.shape().as_support_map();
            let is_full = whole.is_some_and(|whole| fills(&places, whole, slack));
            if is_full { None } else { SharedShape::convex_hull(&corners()) }
        }
    }
}

/// True where no direction shows the nodes farther than `slack` [m] inside a convex shape.
fn fills(places: &[Vector3<f64>], whole: &dyn SupportMap, slack: f64) -> bool {
    directions().all(|along| {
        let reach = scalar::vector(whole.local_support_point(scalar::to_vector(&along)));
        let farthest = places.iter().map(|place| place.dot(&along)).fold(f64::MIN, f64::max);
        reach.dot(&along) - farthest <= slack
    })
}

/// Unit vectors, spread evenly.
fn directions() -> impl Iterator<Item = Vector3<f64>> {
    (0..DIRECTIONS).map(|i| {
        let height = 1.0 - (2.0 * i as f64 + 1.0) / DIRECTIONS as f64;
        let (sine, cosine) = (GOLDEN_ANGLE * i as f64).sin_cos();
        let radius = (1.0 - height * height).sqrt();
        Vector3::new(radius * cosine, radius * sine, height)
    })
}
