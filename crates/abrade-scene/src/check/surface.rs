//! Checks of surfaces.

use std::collections::BTreeMap;
use std::path::Path;

use abrade::{
    Archard, ElasticLaw, FlowLaw, Lateral, NODE_LIMIT, ParameterError, SurfaceError, SurfaceLaws,
    TriangleMesh,
};

use super::{Checker, vector};
use crate::closed::{self, ClosedMesh};
use crate::place;
use crate::problem::Problem;
use crate::scene::{Geometry, SceneAdhesion, SceneSurface};
use crate::spans::ScenePath;
use crate::stiffness;

impl Checker<'_> {
    /// Checks every surface; returns the meshes of closed ones.
    pub(super) fn check_surfaces(
        &mut self,
        folder: &Path,
        notes: &mut Vec<String>,
    ) -> BTreeMap<String, TriangleMesh> {
        let mut meshes = BTreeMap::new();
        for (name, surface) in &self.scene.surfaces {
            let path = ScenePath::of(["surfaces", name]);
            match closed::closed(&surface.geometry, folder) {
                None => self.check_strip(&path, name, surface),
                Some(Ok(ClosedMesh { mesh, note })) => {
                    notes.extend(note.map(|note| format!("surface `{name}`: {note}")));
                    meshes.insert(name.clone(), mesh);
                }
                Some(Err(trouble)) => self.refuse_closed(&path, name, trouble),
            }
            self.check_laws(&path, surface);
            let material = self.scene.materials.get(&surface.material);
            notes.extend(material.and_then(|material| stiffness::note(name, surface, material)));
            let separates = |c: char| matches!(c, '/' | '\\') || c.is_control();
            if self.scene.surfaces.len() > 1 && name.contains(separates) {
                let message = format!("the surface `{name}` cannot be part of a file's name");
                self.refuse(&path, message, "without `/` or `\\`");
            }
            self.check_carrier(&path, name, surface);
            let led = self.check_led_path(&path, name, surface, folder, notes);
            self.paths.extend(led.map(|led| (name.clone(), led)));
            self.ranges(&path, [vector("position", &surface.position)]);
            if place::rotation(&surface.rotation).is_none() {
                self.no_direction(&path.join("rotation"));
            }
        }
        meshes
    }

    pub(super) fn no_direction(&mut self, path: &ScenePath) {
        let message = format!("`{path}` has no direction");
        self.refuse(path, message, "must be finite and of a length above zero");
    }

    fn check_strip(&mut self, path: &ScenePath, name: &str, surface: &SceneSurface) {
        let path = path.join("geometry");
        let Geometry::HexStrip { pitch, nodes, .. } = surface.geometry else { return };
        if pitch.is_some() == nodes.is_some() {
            let message = format!("`{path}` must have either `pitch` or `nodes`");
            return self.refuse(&path, message, "give one of them");
        }
        if nodes == Some(0) {
            let error = ParameterError { field: "nodes", value: 0.0, allowed: "at least 1".into() };
            return self.out_of_range(&path, &error);
        }
        let Some(strip) = place::strip(&surface.geometry) else { return };
        let mut errors = strip.check();
        if nodes.is_some() {
            errors.retain(|error| error.field != "pitch");
        }
        if !errors.is_empty() {
            return self.ranges(&path, errors.into_iter().map(Some));
        }
        let [columns, rows] = strip.columns_rows();
        let label = format!("gives {columns} columns of {rows} rows");
        if columns * rows < 1.0 {
            self.refuse(&path, format!("the surface `{name}` has no nodes"), label);
        } else if columns * rows > NODE_LIMIT || !(columns * rows).is_finite() {
            let message = format!("the surface `{name}` has more than {NODE_LIMIT:.0e} nodes");
            self.refuse(&path, message, label);
        }
    }

    fn check_laws(&mut self, path: &ScenePath, surface: &SceneSurface) {
        let errors = surface.elastic.check();
        self.ranges(&path.join("elastic"), errors.into_iter().map(Some));
        let errors = surface.removal.check();
        self.ranges(&path.join("removal"), errors.into_iter().map(Some));
        self.ranges(path, [SurfaceLaws::check_restitution(surface.restitution)]);
        if surface.elastic == ElasticLaw::Rigid && surface.restitution != 1.0 {
            let message = "`restitution` is that of springs".to_owned();
            self.refuse(&path.join("restitution"), message, "`Rigid` has none");
        }
        let Some(material) = self.scene.materials.get(&surface.material) else {
            let known: Vec<&str> = self.scene.materials.keys().map(String::as_str).collect();
            let name = &surface.material;
            return self.undefined(&path.join("material"), "material", name, &known);
        };
        let laws = surface.laws(material);
        let literal = surface.flow == FlowLaw::CapozzaHanley { lateral: Lateral::Eq5 };
        if literal && surface.elastic == ElasticLaw::Rigid {
            let message = "`lateral: Eq5` is the paper's formula for a ball on springs".to_owned();
            self.refuse(&path.join("flow"), message, "`Rigid` has none; take `lateral: Projected`");
        }
        if surface.elastic == ElasticLaw::Rigid && surface.adhesion.is_some() {
            let message = "`adhesion` holds a body against its springs".to_owned();
            self.refuse(&path.join("adhesion"), message, "`Rigid` has none; take `Foundation()`");
        }
        if surface.elastic == ElasticLaw::Rigid && surface.archard.is_some() {
            let message = "`archard` asks for the pressure below a body that slides".to_owned();
            self.refuse(&path.join("archard"), message, "`Rigid` has none; take `Foundation()`");
        }
        let errors = surface.archard.iter().flat_map(Archard::check);
        self.ranges(&path.join("archard"), errors.map(Some));
        if let Some(adhesion) = &surface.adhesion {
            self.check_adhesion(path, adhesion, surface);
        }
        for error in laws.check() {
            if let SurfaceError::Missing { law, field } = error {
                self.missing(path, &surface.material, law, field);
            }
        }
    }

    fn check_adhesion(
        &mut self,
        path: &ScenePath,
        adhesion: &SceneAdhesion,
        surface: &SceneSurface,
    ) {
        let material = &self.scene.materials[&surface.material];
        let at = path.join("adhesion");
        let errors = adhesion.on(material).check(material);
        self.ranges(&at, errors.into_iter().map(Some));
        let Some(radius) = adhesion.maugis_radius else { return };
        self.ranges(&at, [ParameterError::positive("maugis_radius", radius)]);
        if adhesion.pull_off.is_some() {
            let message = format!("`{at}` has both `pull_off` and `maugis_radius`");
            self.refuse(&at, message, "give one of them");
        }
        if material.young.is_none() {
            self.missing(path, &surface.material, "`maugis_radius`", "young");
        }
    }

    /// A law lacks a property of the surface's material.
    fn missing(&mut self, path: &ScenePath, material: &str, law: &str, field: &str) {
        let marks = vec![
            self.mark(&path.join("elastic"), format!("needs `{field}`")),
            self.mark(
                &ScenePath::of(["materials", material, field]),
                format!("gives no `{field}`"),
            ),
        ];
        let message =
            format!("{law} needs `{field}`, which the material `{material}` does not give");
        self.problems.push(Problem { message, marks, help: None });
    }

    /// Surfaces whose law is for balls alone.
    pub(super) fn for_balls_alone(&self) -> Vec<String> {
        let eq5 = FlowLaw::CapozzaHanley { lateral: Lateral::Eq5 };
        let surfaces = self.scene.surfaces.iter();
        surfaces.filter(|(_, s)| s.flow == eq5).map(|(name, _)| name.clone()).collect()
    }
}
