//! Checks of how surfaces move.

use abrade::ParameterError;

use super::{Checker, vector};
use crate::problem::Problem;
use crate::scene::{SceneSurface, SurfaceMotion};
use crate::spans::ScenePath;

impl Checker<'_> {
    pub(super) fn check_carrier(&mut self, path: &ScenePath, name: &str, surface: &SceneSurface) {
        let motion = path.join("motion");
        match &surface.motion {
            SurfaceMotion::Fixed => return,
            // Checked with its path.
            SurfaceMotion::Reciprocating { .. }
            | SurfaceMotion::Rocking { .. }
            | SurfaceMotion::Path { .. } => {}
            SurfaceMotion::Kinematic { velocity, spin } => {
                self.ranges(&motion, [vector("velocity", velocity), vector("spin", spin)]);
            }
            SurfaceMotion::Free { density, velocity, spin } => {
                let density = ParameterError::positive("density", *density);
                let found = [density, vector("velocity", velocity), vector("spin", spin)];
                self.ranges(&motion, found);
                self.check_has_mass(path, name, surface);
            }
        }
        self.check_own_name(&motion, name);
    }

    /// A plate bounds nothing that could weigh something.
    fn check_has_mass(&mut self, path: &ScenePath, name: &str, surface: &SceneSurface) {
        if surface.geometry.is_closed() {
            return;
        }
        let marks = vec![
            self.mark(&path.join("motion"), "is for solids"),
            self.mark(&path.join("geometry"), "bounds no solid"),
        ];
        let message = format!("the surface `{name}` cannot be free: a plate has no mass");
        let help = Some("a `Cuboid(..)` is a plate with a mass".to_owned());
        self.problems.push(Problem { message, marks, help });
    }

    /// The columns of a moving surface and of a body are named alike.
    fn check_own_name(&mut self, motion: &ScenePath, name: &str) {
        if self.scene.bodies.contains_key(name) {
            let marks = vec![
                self.mark(motion, "this surface moves"),
                self.mark(&ScenePath::of(["bodies", name]), "and so does this body"),
            ];
            let message = format!("a body and a surface that moves are both called `{name}`");
            self.problems.push(Problem { message, marks, help: Some("rename one".to_owned()) });
        }
    }
}
