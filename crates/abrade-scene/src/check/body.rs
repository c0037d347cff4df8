//! Checks of bodies: shape, mass, place.

use std::collections::BTreeMap;
use std::path::Path;

use abrade::{ParameterError, ShapeError};

use super::{Checker, finite};
use crate::clump::ClumpError;
use crate::place;
use crate::problem::{Mark, Problem, Source};
use crate::scene::{Motion, Placement, SceneBody, SceneShape};
use crate::solid::{self, Solid, SolidTrouble};
use crate::spans::ScenePath;

impl Checker<'_> {
    pub(super) fn check_bodies(
        &mut self,
        folder: &Path,
        notes: &mut Vec<String>,
    ) -> BTreeMap<String, Solid> {
        let mut solids = BTreeMap::new();
        for (name, body) in &self.scene.bodies {
            let path = ScenePath::of(["bodies", name]);
            self.check_motion(&path, body);
            self.check_law_for(&path, body);
            let placed = self.check_place(&path, body);
            match self.solid(&path, body, folder) {
                Ok((solid, note)) => {
                    notes.extend(note.map(|note| format!("body `{name}`: {note}")));
                    if placed {
                        self.check_outside(&path, name, body, &solid);
                    }
                    solids.insert(name.clone(), solid);
                }
                Err(Some(trouble)) => self.refuse_shape(&path, trouble),
                Err(None) => {}
            }
        }
        solids
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
        solid::solid(&body.shape, body.density, mass, folder).map_err(Some)
    }

    fn refuse_shape(&mut self, path: &ScenePath, trouble: SolidTrouble) {
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
            SolidTrouble::Mesh { .. } => self.refuse(&shape.join("file"), message, ""),
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

    /// True when the body's place can be worked out.
    fn check_place(&mut self, path: &ScenePath, body: &SceneBody) -> bool {
        let before = self.problems.len();
        if place::rotation(&body.rotation).is_none() {
            self.no_direction(&path.join("rotation"));
        }
        let position = path.join("position");
        match &body.position {
            Placement::OnSurface { surface, at, gap } => {
                if !self.scene.surfaces.contains_key(surface) {
                    let known: Vec<&str> = self.scene.surfaces.keys().map(String::as_str).collect();
                    self.undefined(&position.join("surface"), "surface", surface, &known);
                }
                let at = at.iter().find(|x| !x.is_finite()).map(|&x| finite("at", x));
                let gap = (!gap.is_finite()).then(|| finite("gap", *gap));
                self.ranges(&position, [at, gap]);
            }
            Placement::At { point } => {
                let point = point.iter().find(|x| !x.is_finite());
                self.ranges(&position, [point.map(|&x| finite("point", x))]);
            }
        }
        self.problems.len() == before
    }

    /// A body must start outside every surface.
    fn check_outside(&mut self, path: &ScenePath, name: &str, body: &SceneBody, solid: &Solid) {
        let scene = self.scene;
        let own = match &body.position {
            Placement::OnSurface { surface, .. } => scene.surfaces.get_key_value(surface),
            Placement::At { .. } => None,
        };
        let Some(local) = place::local_state(body, solid, own.map(|(_, surface)| surface)) else {
            return;
        };
        let world = match own.map(|(_, surface)| place::frame(surface)) {
            Some(Some(frame)) => local.placed_by(&frame),
            Some(None) => return,
            None => local,
        };
        for (surface_name, surface) in &scene.surfaces {
            let (Some(strip), Some(frame)) =
                (place::strip(&surface.geometry), place::frame(surface))
            else {
                continue;
            };
            let state = match own {
                Some((own_name, _)) if own_name == surface_name => local,
                _ => world.seen_from(&frame),
            };
            let nodes = place::node_height(surface);
            if let Some(depth) = place::depth_inside(&solid.shape, &state, &strip, nodes) {
                let field = match body.position {
                    Placement::OnSurface { .. } => path.join("position").join("gap"),
                    Placement::At { .. } => path.join("position").join("point"),
                };
                let message = format!(
                    "the body `{name}` starts {depth:.3e} m inside the surface `{surface_name}`"
                );
                self.refuse(&field, message, "must lie above the surface");
            }
        }
    }
}
