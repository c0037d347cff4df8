//! How stiff `Foundation` is on a surface, told before anything runs: where its stiffness is not
//! given it follows from E, H and the size of the body, within bounds, as the core calibrates it
//! against Hertz (elastic.rs).

use abrade::{
    CALIBRATED_YIELD, ElasticLaw, Material, ball_radius, calibrated_yield, reference_radius,
};

use crate::check::Checked;
use crate::scene::{SceneSurface, SurfaceMotion};
use crate::unlikely;

/// What to say of a surface called `name` on which E no longer changes the stiffness.
pub(crate) fn note(name: &str, surface: &SceneSurface, material: &Material) -> Option<String> {
    let ElasticLaw::Foundation { stiffness: None } = surface.elastic else { return None };
    // A forgotten unit has a note of its own.
    if unlikely::material_notes(&[], material).next().is_some() {
        return None;
    }
    let asked = calibrated_yield(material, 1.0);
    let bound = CALIBRATED_YIELD.into_iter().find(|bound| asked == *bound)?;
    Some(format!(
        "the stiffness of `{name}` is at its bound, H / k_w = {bound:e} R: E no longer changes it; give \
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
        let stiffness = |radius: f64| material.hardness / calibrated_yield(material, radius);
        (largest > 0.0).then(|| [stiffness(largest), stiffness(least)])
    }

    /// Radius of a ball of the volume of the surface's solid [m]; infinite for a plate.
    pub(crate) fn size_of_solid(&self, name: &str) -> f64 {
        self.meshes.get(name).map_or(f64::INFINITY, |mesh| ball_radius(mesh.volume()))
    }
}
