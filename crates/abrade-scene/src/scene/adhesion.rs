//! Adhesion of a surface.

use std::f64::consts::PI;

use abrade::quantity::{self, Quantity};
use abrade::{Adhesion, Material};
use abrade_laws::contact::{ContactModel, MaugisDugdale, Pair, maugis_lambda};
use schemars::JsonSchema;
use serde::Deserialize;

/// What lies within a range of a node is drawn to it by a constant traction, work over range (Dugdale).
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SceneAdhesion {
    /// w [J/m2]: work of adhesion, what a unit of area costs to part.
    #[serde(deserialize_with = "quantity::area_energy")]
    #[schemars(with = "Quantity")]
    pub work: f64,
    /// Distance up to which the traction acts [m]. The traction must be below the hardness; the rim of a
    /// contact, sqrt(2 R range) wide about a ball of radius R, should be five pitches wide at least.
    #[serde(deserialize_with = "quantity::length")]
    #[schemars(with = "Quantity")]
    pub range: f64,
    /// Pull-off force of a ball from a plane over pi w R [-], from 1.5 (JKR) to 2 (default: 2, what a local
    /// traction comes to). It scales the work of adhesion in effect.
    #[serde(default)]
    pub pull_off: Option<f64>,
    /// In its place, the radius of a rigid ball [m] whose pull-off force is that of Maugis and Dugdale for
    /// this work and traction, on an elastic half-space of the material (default: none).
    #[serde(default, deserialize_with = "quantity::optional_length")]
    #[schemars(with = "Option<Quantity>")]
    pub maugis_radius: Option<f64>,
}

impl SceneAdhesion {
    /// Adhesion to a surface of `material`; one that cannot be is left as it was given.
    pub(crate) fn on(&self, material: &Material) -> Adhesion {
        let plain = Adhesion::new(self.work, self.range);
        let by_maugis = self.maugis_radius.and_then(|radius| self.by_maugis(material, radius));
        Adhesion { pull_off: by_maugis.or(self.pull_off).unwrap_or(plain.pull_off), ..plain }
    }

    /// Pull-off force over pi w R in the model of Maugis and Dugdale, with DMT and JKR at its ends; None
    /// where there is no such contact.
    fn by_maugis(&self, material: &Material, radius: f64) -> Option<f64> {
        let modulus = material.young? / (1.0 - material.poisson * material.poisson);
        let pair = Pair::new(radius, modulus).ok()?;
        let traction = self.work / self.range;
        let lambda = maugis_lambda(&pair, self.work, traction).ok()?;
        let limit = if lambda < 1.0 { 2.0 } else { 1.5 };
        let model = MaugisDugdale::new(pair, self.work, traction).ok();
        let unit = PI * self.work * radius;
        Some(model.map_or(limit, |model| (-model.parting().pull_off / unit).clamp(1.5, 2.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for another modulus, radius or scale than those of Maugis' parameter: lambda is 1, and the
    /// pull-off force that of the table of the transition.
    #[test]
    fn the_pull_off_of_a_ball_is_that_of_maugis_and_dugdale() {
        let material = Material {
            hardness: 1e9,
            shear_ratio: 0.25,
            young: Some(0.75 * 3e9 * (1.0 - 0.09)),
            poisson: 0.3,
            friction: 0.0,
        };
        let (work, radius) = (0.1, 1e-6);
        let stiff = 3e9;
        for (lambda, pull_off) in [(0.3, 1.815556), (1.0, 1.600735), (5.0, 1.506350)] {
            let traction = lambda / 2.0 * (PI * work * stiff * stiff / radius).cbrt();
            let (range, maugis_radius) = (work / traction, Some(radius));
            let adhesion = SceneAdhesion { work, range, pull_off: None, maugis_radius };
            let found = adhesion.on(&material).pull_off;
            assert!((found - pull_off).abs() < 1e-6, "{lambda}: {found}");
        }
        let far =
            |range| SceneAdhesion { work, range, pull_off: None, maugis_radius: Some(radius) };
        assert_eq!([1.0, 1e-16].map(|range| far(range).on(&material).pull_off), [2.0, 1.5]);
    }
}
