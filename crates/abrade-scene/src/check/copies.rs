//! Checks of the copies of surfaces: how many, of what, and beside each other.

use std::collections::BTreeMap;

use abrade::{ParameterError, SOLID_NODE_LIMIT, TriangleMesh};

use super::{Checked, Checker, vector};
use crate::copies::MOST;
use crate::overlap;
use crate::place;
use crate::problem::Problem;
use crate::scene::{Copies, SceneSurface, SurfaceMotion};
use crate::spans::ScenePath;

impl Checker<'_> {
    pub(super) fn check_copies(&mut self, meshes: &BTreeMap<String, TriangleMesh>) {
        for (name, surface) in &self.scene.surfaces {
            let Some(copies) = &surface.copies else { continue };
            let path = ScenePath::of(["surfaces", name]);
            let before = self.problems.len();
            self.check_copies_free(&path, name, surface);
            self.check_counts(&path.join("copies"), copies);
            if self.problems.len() > before {
                continue;
            }
            self.check_copy_names(&path, name, surface);
            if let Some(mesh) = meshes.get(name) {
                self.check_copies_apart(&path.join("copies"), name, surface, copies, mesh);
            }
        }
    }

    /// Only what moves on its own is worth another one.
    fn check_copies_free(&mut self, path: &ScenePath, name: &str, surface: &SceneSurface) {
        if matches!(surface.motion, SurfaceMotion::Free { .. }) {
            return;
        }
        let marks = vec![
            self.mark(&path.join("copies"), "is for free surfaces"),
            self.mark(&path.join("motion"), "expected `Free(..)`"),
        ];
        let message = format!("the surface `{name}` has copies, and is not free");
        self.problems.push(Problem { message, marks, help: None });
    }

    fn check_counts(&mut self, path: &ScenePath, copies: &Copies) {
        let Copies::Grid { counts, spacing } = copies;
        if counts.contains(&0) {
            let (value, allowed) = (0.0, "at least 1 along every axis".to_owned());
            self.out_of_range(path, &ParameterError { field: "counts", value, allowed });
        } else if copies.count() > MOST {
            let value = copies.count() as f64;
            let allowed = format!("at most {MOST} together");
            self.out_of_range(path, &ParameterError { field: "counts", value, allowed });
        }
        self.ranges(path, [vector("spacing", spacing)]);
    }

    /// Copies are called like nothing else that the scene names.
    fn check_copy_names(&mut self, path: &ScenePath, name: &str, surface: &SceneSurface) {
        let scene = self.scene;
        if scene.streams.contains_key(name) {
            let message = format!("a stream and a surface with copies are both called `{name}`");
            return self.refuse(path, message, "rename one");
        }
        let taken = |copy: &String| {
            scene.bodies.contains_key(copy) || scene.surfaces.contains_key(copy) && copy != name
        };
        if let Some(copy) = surface.copies(name).map(|(copy, _)| copy).find(taken) {
            let message = format!("the surface `{name}` has a copy `{copy}`, and so has the scene");
            self.refuse(path, message, "rename the surface");
        }
    }

    /// Copies must start outside of each other, and all their nodes within the limit.
    fn check_copies_apart(
        &mut self,
        path: &ScenePath,
        name: &str,
        surface: &SceneSurface,
        copies: &Copies,
        mesh: &TriangleMesh,
    ) {
        let nodes = copies.count() as f64 * mesh.vertices().len() as f64;
        if nodes > SOLID_NODE_LIMIT {
            let message =
                format!("the surface `{name}` has more than {SOLID_NODE_LIMIT:.0e} nodes");
            return self.refuse(&path.join("counts"), message, format!("gives {nodes:.3e}"));
        }
        let placed = surface.copies(name).map(|(name, copy)| Some((name, place::home(&copy)?)));
        let Some(placed) = placed.collect::<Option<Vec<_>>>() else { return };
        let (names, frames): (Vec<_>, Vec<_>) = placed.into_iter().unzip();
        if let Some([first, second]) = overlap::first_overlap(mesh, &frames) {
            let [first, second] = [&names[first], &names[second]];
            let message = format!("the copies `{first}` and `{second}` overlap");
            self.refuse(&path.join("spacing"), message, "must keep them outside of each other");
        }
    }
}

impl Checked {
    /// Puts copies in the places of the surfaces that have some.
    pub(super) fn copy_surfaces(&mut self) {
        let surfaces = std::mem::take(&mut self.scene.surfaces);
        for (name, surface) in surfaces {
            if surface.copies.is_none() {
                self.scene.surfaces.insert(name, surface);
                continue;
            }
            let (mesh, hardness) = (self.meshes.remove(&name), self.hardness.remove(&name));
            let mut names = Vec::new();
            for (copy_name, copy) in surface.copies(&name) {
                let mesh = mesh.clone().map(|mesh| (copy_name.clone(), mesh));
                self.meshes.extend(mesh);
                let hardness = hardness.clone().map(|hardness| (copy_name.clone(), hardness));
                self.hardness.extend(hardness);
                self.scene.surfaces.insert(copy_name.clone(), copy);
                names.push(copy_name);
            }
            self.copied.insert(name, names);
        }
    }
}
