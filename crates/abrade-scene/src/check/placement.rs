//! Checks of where bodies start: on what, and outside of it.

use std::collections::BTreeMap;

use abrade::TriangleMesh;
use nalgebra::Isometry3;

use super::{Checker, vector};
use crate::overlap;
use crate::place;
use crate::problem::Problem;
use crate::scene::{Motion, Placement, SceneBody, SceneSurface, SurfaceMotion};
use crate::solid::Solid;
use crate::spans::ScenePath;

impl Checker<'_> {
    /// True when the body's place can be worked out.
    pub(super) fn check_place(&mut self, path: &ScenePath, body: &SceneBody) -> bool {
        let before = self.problems.len();
        if place::rotation(&body.rotation).is_none() {
            self.no_direction(&path.join("rotation"));
        }
        let position = path.join("position");
        if let Some(surface) = body.position.surface() {
            self.check_host(path, body, surface);
        }
        match &body.position {
            Placement::OnSurface { at, gap, .. } => {
                self.ranges(&position, [vector("at", at), vector("gap", &[*gap])]);
            }
            Placement::InFrame { point, .. } | Placement::At { point } => {
                self.ranges(&position, [vector("point", point)]);
            }
        }
        self.problems.len() == before
    }

    /// The surface that a body is placed on must be there, and flat for words of flat surfaces.
    fn check_host(&mut self, path: &ScenePath, body: &SceneBody, name: &str) {
        let position = path.join("position");
        let Some(surface) = self.scene.surfaces.get(name) else {
            let known: Vec<&str> = self.scene.surfaces.keys().map(String::as_str).collect();
            return self.undefined(&position.join("surface"), "surface", name, &known);
        };
        if surface.copies.is_some() {
            let marks = vec![
                self.mark(&position.join("surface"), "must name one surface"),
                self.mark(&ScenePath::of(["surfaces", name, "copies"]), "makes many of it"),
            ];
            let message = format!("`{path}` cannot lie on the surface `{name}`, which has copies");
            return self.problems.push(Problem { message, marks, help: None });
        }
        if !surface.geometry.is_closed() {
            return self.check_drive_still(path, body, name, surface);
        }
        let (word, message, help) = match (&body.motion, &body.position) {
            (Motion::Drive { .. }, _) => (
                path.join("motion"),
                format!("`{path}` cannot be driven over the surface `{name}`, which is closed"),
                "a drive presses along the normal of a flat surface".to_owned(),
            ),
            (_, Placement::OnSurface { .. }) => (
                position,
                format!("`{path}` cannot lie on the surface `{name}`, which is closed"),
                format!(
                    "place it in the surface's frame: `InFrame(surface: \"{name}\", point: ..)`"
                ),
            ),
            _ => return,
        };
        let geometry = ScenePath::of(["surfaces", name, "geometry"]);
        let marks =
            vec![self.mark(&word, "is for flat surfaces"), self.mark(&geometry, "has no top")];
        self.problems.push(Problem { message, marks, help: Some(help) });
    }

    /// A drive slides over a plate at rest.
    fn check_drive_still(
        &mut self,
        path: &ScenePath,
        body: &SceneBody,
        name: &str,
        surface: &SceneSurface,
    ) {
        let driven = matches!(body.motion, Motion::Drive { .. });
        if driven && surface.motion != SurfaceMotion::Fixed {
            let marks = vec![
                self.mark(&path.join("motion"), "is for surfaces at rest"),
                self.mark(&ScenePath::of(["surfaces", name, "motion"]), "moves the surface"),
            ];
            let message =
                format!("`{path}` cannot be driven over the surface `{name}`, which moves");
            self.problems.push(Problem { message, marks, help: None });
        }
    }

    /// A body must start outside every surface.
    pub(super) fn check_outside(
        &mut self,
        path: &ScenePath,
        name: &str,
        body: &SceneBody,
        solid: &Solid,
        meshes: &BTreeMap<String, TriangleMesh>,
    ) {
        let scene = self.scene;
        let own = body.position.surface().and_then(|name| scene.surfaces.get_key_value(name));
        let Some(local) = place::local_state(body, solid, own.map(|(_, surface)| surface)) else {
            return;
        };
        let world = match own.map(|(name, surface)| self.start(name, surface)) {
            Some(Some(frame)) => local.placed_by(&frame),
            Some(None) => return,
            None => local,
        };
        for (surface_name, surface) in &scene.surfaces {
            let mesh = meshes.get(surface_name);
            let found = surface.copies(surface_name).find_map(|(copy_name, copy)| {
                let frame = self.start(&copy_name, &copy)?;
                let state = match own {
                    Some((own_name, _)) if own_name == surface_name => local,
                    _ => world.seen_from(&frame),
                };
                Some((copy_name, depth_inside(&copy, mesh, solid, &state)?))
            });
            if let Some((copy_name, depth)) = found {
                self.refuse_inside(path, name, body, &copy_name, surface, depth);
            }
        }
    }

    /// Frame of a surface at the start, in the world.
    fn start(&self, name: &String, surface: &SceneSurface) -> Option<Isometry3<f64>> {
        place::start(surface, self.paths.get(name))
    }

    fn refuse_inside(
        &mut self,
        path: &ScenePath,
        name: &str,
        body: &SceneBody,
        surface_name: &str,
        surface: &SceneSurface,
        depth: f64,
    ) {
        let field = match body.position {
            Placement::OnSurface { .. } => "gap",
            Placement::InFrame { .. } | Placement::At { .. } => "point",
        };
        let message =
            format!("the body `{name}` starts {depth:.3e} m inside the surface `{surface_name}`");
        let label = match surface.geometry.is_closed() {
            true => "must lie outside of its solid",
            false => "must lie above the surface",
        };
        self.refuse(&path.join("position").join(field), message, label);
    }
}

/// Depth of a body inside a surface, whose mesh is `mesh` if it is closed [m].
fn depth_inside(
    surface: &SceneSurface,
    mesh: Option<&TriangleMesh>,
    solid: &Solid,
    state: &abrade::State,
) -> Option<f64> {
    let nodes = place::node_height(surface);
    match mesh {
        Some(mesh) => overlap::depth_in_mesh(&solid.shape, state, mesh, nodes),
        None => {
            let strip = place::strip(&surface.geometry)?;
            place::depth_inside(&solid.shape, state, &strip, nodes)
        }
    }
}
