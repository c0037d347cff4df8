//! Sizes of bodies as the engine counts them.

use abrade::{Piece, Shape};

use crate::build::{Built, BuiltSurface};

/// Sum of the pieces' volumes, overlaps counted twice, as Rapier's densities do [m3].
pub(crate) fn volume_sum(shape: &Shape) -> f64 {
    let volume = |piece: &Piece| match piece {
        Piece::Ball(ball) => 4.0 / 3.0 * std::f64::consts::PI * ball.radius.powi(3),
        Piece::Hull(hull) => hull.volume(),
    };
    shape.pieces().iter().map(volume).sum()
}

/// The size of the smallest body that is free to move [m]: Rapier's tolerances are fractions of it.
pub(crate) fn length_unit(built: &Built) -> f64 {
    let bodies = built.bodies.values().filter(|body| !body.inertia.is_immovable());
    let free =
        |surface: &&BuiltSurface| surface.carrier.is_some_and(|carrier| carrier.inertia.is_some());
    let extent = |surface: &BuiltSurface| {
        let [low, high] = surface.surface.bounds();
        (high - low).norm()
    };
    let sizes = bodies.map(|body| 2.0 * body.shape.bounding_radius());
    let smallest =
        sizes.chain(built.surfaces.values().filter(free).map(extent)).fold(f64::INFINITY, f64::min);
    if smallest.is_finite() { smallest } else { 1.0 }
}
