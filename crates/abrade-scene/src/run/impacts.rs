//! Impacts beside closed-form laws: `impacts.csv` and the sums of the summary.

use std::path::Path;

use abrade_report::ReportError;
use abrade_report::impacts::{Impact, Impacts};
use abrade_report::summary::LawsSummary;

use crate::build::Built;
use crate::check::Checked;
use crate::impact_law::{Blow, ImpactLaw};
use crate::run::bodies::Bodies;
use crate::run::extent::volume_sum;
use crate::run::touch::{Struck, Touch, Touches};
use crate::scene::Output;

/// The laws that a scene names, and what came of them so far.
pub(crate) struct Predictions {
    table: Impacts,
    laws: Vec<ImpactLaw>,
    /// Volumes of the bodies [m3] and hardness of the surfaces [Pa], in the scene's order.
    volumes: Vec<f64>,
    hardness: Vec<f64>,
    surfaces: Vec<String>,
    sums: Vec<f64>,
    impacts: u64,
    wear_volume: f64,
}

impl Predictions {
    /// Opens the table in `folder`, if the scene names laws.
    pub(crate) fn new(
        checked: &Checked,
        built: &Built,
        folder: &Path,
    ) -> Result<Option<Self>, ReportError> {
        let scene = &checked.scene;
        let named = scene.outputs.iter().find_map(|output| match output {
            Output::Laws { names, surface_density, given } => Some((names, surface_density, given)),
            _ => None,
        });
        let Some((names, density, given)) = named else { return Ok(None) };
        let laws: Vec<_> =
            names.iter().filter_map(|name| ImpactLaw::new(name, given, *density)).collect();
        let volumes = built.bodies.iter().map(|(name, body)| match scene.bodies[name].density {
            Some(density) if !body.inertia.is_immovable() => body.inertia.mass / density,
            _ => volume_sum(&body.shape),
        });
        let material =
            |surface: &crate::scene::SceneSurface| scene.materials[&surface.material].hardness;
        Ok(Some(Self {
            table: Impacts::create(&folder.join("impacts.csv"), laws.iter().map(ImpactLaw::name))?,
            sums: vec![0.0; laws.len()],
            laws,
            volumes: volumes.collect(),
            hardness: scene.surfaces.values().map(material).collect(),
            surfaces: scene.surfaces.keys().cloned().collect(),
            impacts: 0,
            wear_volume: 0.0,
        }))
    }

    /// Adds the impacts that ended in a step.
    pub(crate) fn add(&mut self, bodies: &Bodies) -> Result<(), ReportError> {
        for struck in bodies.touches.iter().flat_map(Touches::over) {
            let Struck { body, touch: Touch { time, speed, angle, surface }, volume } = *struck;
            let track = &bodies.tracks[body];
            let blow = Blow {
                mass: track.inertia.mass,
                volume: self.volumes[body],
                speed,
                angle,
                hardness: self.hardness[surface],
            };
            // A law without a value there has none in the table, nor in the sum.
            let predicted: Vec<f64> =
                self.laws.iter().map(|law| law.predict(&blow).unwrap_or(f64::NAN)).collect();
            self.sums.iter_mut().zip(&predicted).for_each(|(sum, value)| *sum += value);
            self.impacts += 1;
            self.wear_volume += volume;
            self.table.push(&Impact {
                time,
                body: &track.name,
                surface: &self.surfaces[surface],
                mass: blow.mass,
                speed,
                angle: angle.to_degrees(),
                wear_volume: volume,
                predicted: &predicted,
            })?;
        }
        Ok(())
    }

    /// The sums so far.
    pub(crate) fn summary(&self) -> LawsSummary {
        let names = self.laws.iter().map(|law| law.name().to_owned());
        LawsSummary {
            impacts: self.impacts,
            wear_volume: self.wear_volume,
            predicted: names.zip(self.sums.iter().copied()).collect(),
        }
    }

    /// Closes the table.
    pub(crate) fn finish(self) -> Result<(), ReportError> {
        self.table.finish()
    }
}
