//! How stiff `Foundation` is on a surface, told before anything runs: where its stiffness is not
//! given it follows from E, H and the size of the body, within bounds, as the core calibrates it
//! against Hertz (elastic.rs).

use abrade::{ElasticLaw, Material, Piece};

use crate::check::Checked;
use crate::scene::{SceneSurface, SurfaceMotion};
use crate::unlikely;

/// Bounds of H / k_w, over the radius of the body.
const BOUNDS: [f64; 2] = [1e-4, 2e-2];

/// H / k_w that E and H ask for, over the radius of the body [-].
fn asked(material: &Material) -> f64 {
    let plane_strain = material.young.unwrap_or(0.0) / (1.0 - material.poisson * material.poisson);
    let ratio = 0.75 * std::f64::consts::PI * material.hardness / plane_strain;
    ratio * ratio
}

/// H / k_w under a body of this `radius` [m] [m].
pub(crate) fn yield_overlap(material: &Material, radius: f64) -> f64 {
    asked(material).clamp(BOUNDS[0], BOUNDS[1]) * radius
}

/// What to say of a surface called `name` on which E no longer changes the stiffness.
pub(crate) fn note(name: &str, surface: &SceneSurface, material: &Material) -> Option<String> {
    let ElasticLaw::Foundation { stiffness: None } = surface.elastic else { return None };
    // A forgotten unit has a note of its own.
    if unlikely::material_notes(&[], material).next().is_some() {
        return None;
    }
    let [low, high] = BOUNDS;
    let bound = match asked(material) {
        asked if asked > high => "2e-2",
        asked if asked < low => "1e-4",
        _ => return None,
    };
    Some(format!(
        "the stiffness of `{name}` is at its bound, H / k_w = {bound} R: E no longer changes it; give \
         `elastic: Foundation(stiffness: ..)`"
    ))
}

impl Checked {
    /// Least and largest stiffness per area that bodies, and other surfaces that come to it, find
    /// on the surface called `name` [Pa/m]; none for other laws than `Foundation`.
    pub fn stiffness(&self, name: &str) -> Option<[f64; 2]> {
        let surface = self.scene.surfaces.get(name)?;
        let ElasticLaw::Foundation { stiffness } = surface.elastic else { return None };
        if let Some(stiffness) = stiffness {
            return Some([stiffness; 2]);
        }
        let material = self.scene.materials.get(&surface.material)?;
        let most = self.size_of_solid(name);
        let pieces = self.solids.values().flat_map(|solid| solid.shape.pieces());
        let moves = |surface: &SceneSurface| surface.motion != SurfaceMotion::Fixed;
        let others = self
            .scene
            .surfaces
            .iter()
            .filter(|(other, with)| *other != name && (moves(surface) || moves(with)));
        let radii = pieces
            .map(reference_radius)
            .chain(others.map(|(other, _)| self.size_of_solid(other)))
            .map(|radius| radius.min(most))
            .filter(|radius| radius.is_finite());
        let (least, largest) = radii.fold((f64::INFINITY, 0.0f64), |(least, largest), radius| {
            (least.min(radius), largest.max(radius))
        });
        let stiffness = |radius: f64| material.hardness / yield_overlap(material, radius);
        (largest > 0.0).then(|| [stiffness(largest), stiffness(least)])
    }

    /// Radius of a ball of the volume of the surface's solid [m]; infinite for a plate.
    pub(crate) fn size_of_solid(&self, name: &str) -> f64 {
        self.meshes.get(name).map_or(f64::INFINITY, |mesh| ball_of(mesh.volume()))
    }
}

/// R of a piece: a ball's own radius, the radius of a hull's volume-equivalent ball [m].
fn reference_radius(piece: &Piece) -> f64 {
    match piece {
        Piece::Ball(ball) => ball.radius,
        Piece::Hull(hull) => ball_of(hull.volume()),
    }
}

/// Radius of a ball of this volume [m].
fn ball_of(volume: f64) -> f64 {
    (volume * 0.75 / std::f64::consts::PI).cbrt()
}
