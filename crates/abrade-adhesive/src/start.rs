//! What can be wrong with a solid and bodies that are sound by themselves, as far as it shows before anything
//! moves; and how much there is to do.

use abrade::ParameterError;

use crate::asperities::Asperities;
use crate::neighbours::SURE;
use crate::simulation::fastest;
use crate::solid::Solid;

impl Asperities {
    /// A fault if the step is not stable in `solid`; both are checked.
    pub fn unstable(&self, solid: &Solid) -> Option<ParameterError> {
        self.numerics().unstable(solid, 1.0)
    }

    /// A fault if a step in `solid` does not resolve the speed of the bodies.
    pub fn too_fast(&self, solid: &Solid) -> Option<ParameterError> {
        let fastest = fastest(self.diameter, self.numerics().step(solid, self.diameter));
        let is_fine = self.speed <= fastest;
        // Four digits, not rounded up.
        let allowed = || format!("at most {:.3e} m/s, which a step resolves", 0.9995 * fastest);
        (!is_fine).then(|| ParameterError { field: "speed", value: self.speed, allowed: allowed() })
    }

    /// A fault if the adhesion of `solid` reaches further than pairs of parted faces are sure to be listed.
    pub fn beyond_reach(&self, solid: &Solid) -> Option<ParameterError> {
        let (value, reach) = (solid.adhesion_range, SURE * self.diameter);
        let allowed = || {
            format!(
                "at most {SURE:.2} diameters, {reach:.3e} m: pairs further apart are not followed"
            )
        };
        let is_fine = value <= reach;
        (!is_fine).then(|| ParameterError { field: "adhesion_range", value, allowed: allowed() })
    }

    /// A fault if elements of the two bodies overlap before they move; the bodies are checked.
    pub fn overlap_at_start(&self) -> Option<ParameterError> {
        let (assembly, parts) = self.place(0.0);
        let allowed = || "such that the bodies do not overlap at the start".to_owned();
        let overlap = self.bodies_overlap(&assembly, &parts);
        overlap.then(|| ParameterError { field: "gap", value: self.gap, allowed: allowed() })
    }

    /// Elements of both bodies.
    pub fn element_count(&self) -> usize {
        self.place(0.0).1.len()
    }

    /// Steps that the travel takes in `solid`.
    pub fn step_count(&self, solid: &Solid) -> f64 {
        let step = self.numerics().step(solid, self.diameter);
        (self.whole_travel() / (2.0 * self.speed * step)).ceil()
    }
}
