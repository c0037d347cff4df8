//! Checks of the laws that a scene has beside its impacts.

use std::collections::BTreeMap;

use abrade::ParameterError;

use super::Checker;
use crate::impact_law::{Blow, ImpactLaw, givable, impact_laws};
use crate::spans::ScenePath;

impl Checker<'_> {
    pub(super) fn check_impact_laws(
        &mut self,
        path: &ScenePath,
        names: &[String],
        surface_density: Option<f64>,
        given: &BTreeMap<String, f64>,
    ) {
        if names.is_empty() {
            self.refuse(&path.join("names"), "`Laws` names no law".into(), "expected a name");
        }
        let error =
            surface_density.and_then(|rho| ParameterError::positive("surface_density", rho));
        self.ranges(path, [error]);
        let known: Vec<_> = impact_laws().map(|law| law.name).collect();
        for (i, name) in names.iter().enumerate() {
            let place = path.join("names").join(i.to_string());
            match ImpactLaw::new(name, given, surface_density) {
                None => self.undefined(&place, "law of impacts", name, &known),
                Some(_) if names[..i].contains(name) => {
                    self.refuse(&place, format!("`{name}` is named twice"), "once is enough");
                }
                Some(law) if law.lacks_density() => {
                    let message =
                        format!("`{name}` gives masses, and nothing gives the surface's density");
                    self.refuse(&place, message, "`surface_density` must be given beside it");
                }
                Some(law) => self.check_law(&place, &law),
            }
        }
        let named = || impact_laws().filter(|law| names.iter().any(|name| name == law.name));
        let takes: Vec<_> = named().flat_map(givable).collect();
        for name in given.keys().filter(|name| !takes.contains(&name.as_str())) {
            self.undefined(&path.join("given").join(name), "parameter of these laws", name, &takes);
        }
    }

    /// A law that lacks a parameter lacks it at every impact.
    fn check_law(&mut self, path: &ScenePath, law: &ImpactLaw) {
        for material in self.scene.materials.values() {
            let hardness = material.hardness;
            let blow = Blow { mass: 1e-6, volume: 1e-9, speed: 10.0, angle: 0.5, hardness };
            if let Err(error) = law.predict(&blow) {
                return self.refuse(path, error.to_string(), "may stand in `given`, in SI");
            }
        }
    }
}
