//! How large collisions are, before they are made.

use super::file::{MapFile, SceneFile};
use abrade_adhesive::{Asperities, Solid};

/// Time that an element takes in a step (docs/adhesive.md, "Cost") [s].
const ELEMENT_STEP: f64 = 23e-9;

/// Hardening over Young's modulus down to which a collision makes about a twentieth of the work of its drives
/// out of nothing, and not more (docs/adhesive.md, "Where the work goes") [-].
const LEAST_HARDENING: f64 = 0.1;

/// What differs by less is the bound itself [-].
const ROUNDING: f64 = 1e-12;

/// Size of a collision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// Elements of both bodies.
    pub elements: usize,
    /// Steps over the travel.
    pub steps: f64,
}

impl Size {
    fn of(solid: &Solid, bodies: &Asperities) -> Self {
        Self { elements: bodies.element_count(), steps: bodies.step_count(solid) }
    }

    /// About how long a core takes for it [s].
    pub fn seconds(&self) -> f64 {
        ELEMENT_STEP * self.elements as f64 * self.steps
    }
}

impl SceneFile {
    /// Size of the collision.
    pub fn size(&self) -> Size {
        Size::of(&self.solid, &self.bodies)
    }

    /// What stands out, though it can be run.
    pub fn notes(&self) -> Vec<String> {
        [strong(&self.solid), soft(&self.solid)].into_iter().flatten().collect()
    }
}

impl MapFile {
    /// What stands out, though it can be run.
    pub fn notes(&self) -> Vec<String> {
        soft(&self.solid).into_iter().collect()
    }

    /// Size of each collision: what a map varies does not change it.
    pub fn size(&self) -> Size {
        Size::of(&self.solid, &self.bodies)
    }
}

/// That adhesion is stronger than links.
fn strong(solid: &Solid) -> Option<String> {
    let (adhesion, strength) = (solid.adhesion, solid.tensile_strength());
    (adhesion > strength * (1.0 + ROUNDING)).then(|| {
        format!(
            "`solid.adhesion` is {adhesion:e} Pa, above the uniaxial tensile strength of a link, {strength:.4e} Pa: \
             faces in touch bear more than the link that held them"
        )
    })
}

/// That hardening is too low for averaged returns.
fn soft(solid: &Solid) -> Option<String> {
    let (hardening, least) = (solid.hardening, LEAST_HARDENING * solid.young);
    (hardening < least * (1.0 - ROUNDING)).then(|| {
        format!(
            "`solid.hardening` is {hardening:e} Pa, below a tenth of `young`, {least:e} Pa: averaged returns make energy \
             out of nothing, a tenth of the work of the drives at a twentieth of `young` and most of it at a \
             hundredth, and the run may end early (docs/adhesive.md)"
        )
    })
}
