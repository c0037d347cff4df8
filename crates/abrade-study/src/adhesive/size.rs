//! How large collisions are, before they are made.

use super::file::{MapFile, SceneFile};
use abrade_adhesive::{Asperities, Solid};

/// Time that an element takes in a step (docs/adhesive.md, "Cost") [s].
const ELEMENT_STEP: f64 = 23e-9;

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
        let (adhesion, strength) = (self.solid.adhesion, self.solid.tensile_strength());
        let is_above = adhesion > strength * (1.0 + 1e-12);
        let note = || {
            format!(
                "`solid.adhesion` is {adhesion:e} Pa, above the uniaxial tensile strength of a link, \
                 {strength:.4e} Pa: faces in touch bear more than the link that held them"
            )
        };
        is_above.then(note).into_iter().collect()
    }
}

impl MapFile {
    /// Size of each collision: what a map varies does not change it.
    pub fn size(&self) -> Size {
        Size::of(&self.solid, &self.bodies)
    }
}
