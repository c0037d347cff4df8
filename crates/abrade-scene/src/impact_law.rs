//! Closed-form laws of erosion at the conditions of a scene's impacts: what a law asks for is taken from the
//! body, from the surface, or from what the scene gives.

use std::collections::BTreeMap;

use abrade_laws::{Law, LawError, Steel, laws};

/// A law, and what it takes from the scene.
#[derive(Clone, Debug)]
pub(crate) struct ImpactLaw {
    law: &'static Law,
    /// Values by the scene, in SI.
    given: Vec<(&'static str, f64)>,
    /// Density of the surface, for laws that give masses [kg/m3].
    surface_density: Option<f64>,
}

/// An impact as laws see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Blow {
    /// Mass [kg] and volume [m3] of the body.
    pub mass: f64,
    pub volume: f64,
    /// Speed over the surface [m/s] and angle from it [rad].
    pub speed: f64,
    pub angle: f64,
    /// Hardness of the surface [Pa].
    pub hardness: f64,
}

/// What a law's value says of the volume.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Scale {
    Volume,
    PerMass,
    Ratio,
}

/// Conditions that every impact has itself.
const OWN: [&str; 6] = ["mass", "speed", "angle", "diameter", "radius", "density"];

fn scale(law: &Law) -> Option<Scale> {
    law.find("speed").ok()?;
    match law.output.unit {
        "m3" => Some(Scale::Volume),
        "m3/kg" => Some(Scale::PerMass),
        "kg/kg" => Some(Scale::Ratio),
        _ => None,
    }
}

/// The laws that tell what an impact takes off.
pub(crate) fn impact_laws() -> impl Iterator<Item = &'static Law> {
    laws().filter(|law| scale(law).is_some())
}

/// Parameters of `law` that a scene may give.
pub(crate) fn givable(law: &Law) -> impl Iterator<Item = &'static str> {
    law.parameters.iter().map(|parameter| parameter.name).filter(|name| !OWN.contains(name))
}

impl ImpactLaw {
    /// The law called `name`, with the values among `given` that it has; none for a name that is no law of
    /// impacts.
    pub(crate) fn new(
        name: &str,
        given: &BTreeMap<String, f64>,
        surface_density: Option<f64>,
    ) -> Option<Self> {
        let law = impact_laws().find(|law| law.name == name)?;
        let value = |name: &'static str| Some((name, *given.get(name)?));
        Some(Self { law, given: givable(law).filter_map(value).collect(), surface_density })
    }

    /// Name of the law.
    pub(crate) fn name(&self) -> &'static str {
        self.law.name
    }

    /// True for a law that gives masses where no density of the surface is known.
    pub(crate) fn lacks_density(&self) -> bool {
        scale(self.law) == Some(Scale::Ratio) && self.surface_density.is_none()
    }

    /// Volume that it takes off [m3].
    ///
    /// # Errors
    /// A parameter that nothing gives, a value out of range, a law without a finite value there.
    pub(crate) fn predict(&self, blow: &Blow) -> Result<f64, LawError> {
        let Blow { mass, volume, speed, angle, hardness } = *blow;
        let diameter = (6.0 * volume / std::f64::consts::PI).cbrt();
        let known = |name: &str| match name {
            "mass" => Some(mass),
            "speed" => Some(speed),
            "angle" => Some(angle),
            "diameter" => Some(diameter),
            "radius" => Some(0.5 * diameter),
            "density" => Some(mass / volume),
            "pressure" | "hardness" => Some(hardness),
            "brinell" => Some(Steel::brinell_of(hardness)),
            _ => None,
        };
        let own = self.law.parameters.iter().filter_map(|p| Some((p.name, known(p.name)?)));
        let value = self.law.evaluate(own.chain(self.given.iter().copied()))?;
        Ok(match scale(self.law) {
            Some(Scale::PerMass) => value * mass,
            Some(Scale::Ratio) => value * mass / self.surface_density.unwrap_or(f64::NAN),
            Some(Scale::Volume) | None => value,
        })
    }
}
