//! The parameters of a wearing material: one definition for scene, kernel and output.

use crate::error::ParameterError;

/// A material that wears.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "state", derive(serde::Serialize))]
pub struct Material {
    /// Hardness H [Pa]: the pressure at which a node flows down its normal (Eq. 7). `HV` is kgf/mm2.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::quantity::hardness"))]
    #[cfg_attr(feature = "serde", schemars(with = "crate::quantity::Quantity"))]
    pub hardness: f64,
    /// mu_a [-]: shear hardness H_l = mu_a H opens the lateral flow (Eq. 8).
    #[cfg_attr(feature = "serde", serde(default = "Material::default_shear_ratio"))]
    pub shear_ratio: f64,
    /// Young's modulus E [Pa]; needed by a `Foundation` without a stiffness and by `HertzNodes`.
    #[cfg_attr(
        feature = "serde",
        serde(default, deserialize_with = "crate::quantity::optional_pressure")
    )]
    #[cfg_attr(feature = "serde", schemars(with = "Option<crate::quantity::Quantity>"))]
    pub young: Option<f64>,
    /// Poisson's ratio nu [-].
    #[cfg_attr(feature = "serde", serde(default = "Material::default_poisson"))]
    pub poisson: f64,
    /// Coulomb friction coefficient mu [-] against every body.
    #[cfg_attr(feature = "serde", serde(default))]
    pub friction: f64,
}

impl Material {
    /// The paper's mu_a = 0.25.
    pub fn default_shear_ratio() -> f64 {
        0.25
    }

    /// The paper's nu = 0.3.
    pub fn default_poisson() -> f64 {
        0.3
    }

    /// Every value outside its range, with the field it stands in.
    pub fn check(&self) -> Vec<ParameterError> {
        let mut found = vec![
            ParameterError::positive("hardness", self.hardness),
            ParameterError::within("shear_ratio", self.shear_ratio, 0.0, 10.0),
            ParameterError::within("friction", self.friction, 0.0, 10.0),
            ParameterError::within("poisson", self.poisson, -0.99, 0.499),
        ];
        found.push(self.young.and_then(|young| ParameterError::positive("young", young)));
        found.into_iter().flatten().collect()
    }
}
