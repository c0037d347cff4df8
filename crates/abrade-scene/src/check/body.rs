//! Checks of bodies: shape and mass.

use std::collections::BTreeMap;
use std::path::Path;

use abrade::{ParameterError, ShapeError, TriangleMesh};

use super::Checker;
use crate::clump::ClumpError;
use crate::problem::{Mark, Problem, Source};
use crate::scene::{Motion, SceneBody, SceneShape};
use crate::solid::{self, Solid, SolidTrouble};
use crate::spans::ScenePath;

impl Checker<'_> {
    pub(super) fn check_bodies(
        &mut self,
        folder: &Path,
        meshes: &BTreeMap<String, TriangleMesh>,
        notes: &mut Vec<String>,
    ) -> BTreeMap<String, Solid> {
        let mut solids = BTreeMap::new();
        for (name, body) in &self.scene.bodies {
            let path = ScenePath::of(["bodies", name]);
            let solid = self.check_body(&path, name, body, folder, meshes, notes);
            solids.extend(solid.map(|solid| (name.clone(), solid)));
        }
        solids
    }

    /// Checks the body that is written at `path`.
    pub(super) fn check_body(
        &mut self,
        path: &ScenePath,
        name: &str,
        body: &SceneBody,
        folder: &Path,
        meshes: &BTreeMap<String, TriangleMesh>,
        notes: &mut Vec<String>,
    ) -> Option<Solid> {
        self.check_motion(path, body);
        let placed = self.check_place(path, body);
        let solid = self.check_solid(path, name, body, folder, notes)?;
        if placed {
            self.check_outside(path, name, body, &solid, meshes);
        }
        Some(solid)
    }

    /// Checks the shape and the mass of the body that is written at `path`.
    pub(super) fn check_solid(
        &mut self,
        path: &ScenePath,
        name: &str,
        body: &SceneBody,
        folder: &Path,
        notes: &mut Vec<String>,
    ) -> Option<Solid> {
        self.check_law_for(path, body);
        match self.solid(path, body, folder) {
            Ok((solid, note)) => {
                notes.extend(note.map(|note| format!("body `{name}`: {note}")));
                return Some(solid);
            }
            Err(Some(trouble)) => self.refuse_shape(path, trouble),
            Err(None) => {}
        }
        None
    }

    /// The body's solid; `Err(None)` if its mass is already refused.
    fn solid(
        &mut self,
        path: &ScenePath,
        body: &SceneBody,
        folder: &Path,
    ) -> Result<(Solid, Option<String>), Option<SolidTrouble>> {
        let error = body.density.and_then(|rho| ParameterError::positive("density", rho));
        if let Some(error) = error {
            self.out_of_range(path, &error);
            return Err(None);
        }
        let mass = match body.motion {
            Motion::Drive { mass, .. } => mass,
            _ => None,
        };
        if mass.is_some_and(|mass| ParameterError::positive("mass", mass).is_some()) {
            return Err(None);
        }
        if body.motion == Motion::Fixed {
            return solid::fixed(&body.shape, folder).map_err(Some);
        }
        solid::solid(&body.shape, body.density, mass, folder).map_err(Some)
    }

    pub(super) fn refuse_shape(&mut self, path: &ScenePath, trouble: SolidTrouble) {
        let shape = path.join("shape");
        let message = trouble.to_string();
        match trouble {
            SolidTrouble::Parameter(error) => self.out_of_range(&shape, &error),
            SolidTrouble::OneOf(..) => {
                self.refuse(&shape, format!("`{shape}`: {message}"), "not both, not neither");
            }
            SolidTrouble::Shape(ShapeError::Parameter(error)) => self.out_of_range(&shape, &error),
            SolidTrouble::Shape(ShapeError::Empty { .. }) => {
                let field = self.content_of(&shape);
                self.refuse(&field, format!("`{shape}` is empty"), "nothing in it");
            }
            SolidTrouble::Shape(error @ ShapeError::Coplanar { .. }) => {
                let field = self.content_of(&shape);
                self.refuse(&field, format!("`{shape}`: {error}"), "has no volume");
            }
            SolidTrouble::Clump(error) => self.refuse_clump(&shape.join("file"), error),
            SolidTrouble::Mesh(_) => self.refuse(&shape.join("file"), message, ""),
            SolidTrouble::NoMass => {
                let message = format!("nothing gives a mass to `{path}`");
                self.refuse(path, message, "`density` must be given");
            }
            SolidTrouble::NoOwnInertia => self.refuse(&shape.join("inertia"), message, ""),
            SolidTrouble::Weight { .. } => {
                self.refuse(path, format!("`{path}`: {message}"), "must be finite and above zero");
            }
        }
    }

    /// The field of a shape that lists or names its content.
    fn content_of(&self, shape: &ScenePath) -> ScenePath {
        let written = |field: &&str| {
            let path = shape.join(*field);
            self.tree.find(&self.patched.text, &path.0).depth == path.0.len()
        };
        let field = ["points", "spheres", "file"].into_iter().find(|field| written(field));
        field.map_or_else(|| shape.clone(), |field| shape.join(field))
    }

    /// A fault in a clump file is shown in that file.
    fn refuse_clump(&mut self, path: &ScenePath, error: ClumpError) {
        let named = self.mark(path, "named here");
        let ClumpError::Line { path, line, text, trouble } = error else {
            let problem = Problem { message: error.to_string(), marks: vec![named], help: None };
            return self.problems.push(problem);
        };
        let range = 0..text.len();
        let name = path.display().to_string();
        let source = self.add_source(Source { name, text, first_line: line });
        let label = trouble.to_string();
        let message = format!("the clump file `{}` has a bad line", path.display());
        let marks = vec![Mark { source, range, label }, named];
        self.problems.push(Problem { message, marks, help: None });
    }

    /// `Eq5` is written for balls.
    fn check_law_for(&mut self, path: &ScenePath, body: &SceneBody) {
        if matches!(body.shape, SceneShape::Ball { .. }) {
            return;
        }
        for surface in self.for_balls_alone() {
            let law = ScenePath::of(["surfaces", &surface, "flow", "lateral"]);
            let marks = vec![
                self.mark(&path.join("shape"), "is not a `Ball`"),
                self.mark(&law, "for balls alone"),
            ];
            let message = format!("`{path}` cannot meet the surface `{surface}` under `Eq5`");
            let help = Some("`Projected` goes with every shape".to_owned());
            self.problems.push(Problem { message, marks, help });
        }
    }
}
