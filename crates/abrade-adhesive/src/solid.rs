//! The solid that both bodies consist of: elasticity, flow, strength of links, adhesion; and what
//! follows from them.

use abrade::ParameterError;
use abrade::quantity::{self, Quantity};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What the slope of linear hardening is taken against.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
pub enum HardeningSlope {
    /// The total equivalent strain, whose elastic slope is 3 G.
    #[default]
    Tangent,
    /// The equivalent plastic strain.
    Plastic,
}

/// A solid. The defaults are the reference values of the paper, with the shear strength of its figures.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Solid {
    /// Density rho (default 2000) [kg/m3].
    #[serde(deserialize_with = "quantity::density")]
    #[schemars(with = "Quantity")]
    pub density: f64,
    /// Young's modulus E (default 1 GPa) [Pa].
    #[serde(deserialize_with = "quantity::pressure")]
    #[schemars(with = "Quantity")]
    pub young: f64,
    /// Poisson's ratio nu (default 0.3) [-].
    pub poisson: f64,
    /// Yield stress sigma_y, von Mises (default 1 MPa) [Pa].
    #[serde(deserialize_with = "quantity::pressure")]
    #[schemars(with = "Quantity")]
    pub yield_stress: f64,
    /// Slope H of linear hardening (default 0.5 GPa); below a tenth of `young` averaged returns make energy
    /// out of nothing, and without any, runs end early (docs/adhesive.md) [Pa].
    #[serde(deserialize_with = "quantity::pressure")]
    #[schemars(with = "Quantity")]
    pub hardening: f64,
    /// What that slope is taken against (default `Tangent`).
    pub slope: HardeningSlope,
    /// Pure shear strength sigma_j of a link (default 4.5 MPa) [Pa].
    #[serde(deserialize_with = "quantity::pressure")]
    #[schemars(with = "Quantity")]
    pub shear_strength: f64,
    /// Ratio a of the uniaxial strengths of a link, compression to tension (default 1) [-].
    pub strength_ratio: f64,
    /// Stress sigma_0 that draws parted faces together (default 0) [Pa].
    #[serde(deserialize_with = "quantity::pressure")]
    #[schemars(with = "Quantity")]
    pub adhesion: f64,
    /// Range delta of that stress (default 1 nm) [m].
    #[serde(deserialize_with = "quantity::length")]
    #[schemars(with = "Quantity")]
    pub adhesion_range: f64,
}

impl Default for Solid {
    fn default() -> Self {
        Self {
            density: 2000.0,
            young: 1e9,
            poisson: 0.3,
            yield_stress: 1e6,
            hardening: 0.5e9,
            slope: HardeningSlope::Tangent,
            shear_strength: 4.5e6,
            strength_ratio: 1.0,
            adhesion: 0.0,
            adhesion_range: 1e-9,
        }
    }
}

impl Solid {
    /// Every value outside its range, with the field it stands in.
    pub fn check(&self) -> Vec<ParameterError> {
        let mut found = vec![
            ParameterError::positive("density", self.density),
            ParameterError::positive("young", self.young),
            ParameterError::within("poisson", self.poisson, -0.9, 0.49),
            ParameterError::positive("yield_stress", self.yield_stress),
            ParameterError::within("hardening", self.hardening, 0.0, f64::MAX),
            ParameterError::positive("shear_strength", self.shear_strength),
            ParameterError::within("strength_ratio", self.strength_ratio, 1.0, 1000.0),
            ParameterError::within("adhesion", self.adhesion, 0.0, f64::MAX),
            ParameterError::within("adhesion_range", self.adhesion_range, 0.0, f64::MAX),
        ];
        if self.slope == HardeningSlope::Tangent && found.iter().all(Option::is_none) {
            let elastic = 3.0 * self.shear_modulus();
            let fine = self.hardening < elastic;
            let allowed = format!("below 3 G = {elastic:e} where it is the `Tangent`");
            let error = ParameterError { field: "hardening", value: self.hardening, allowed };
            found.push((!fine).then_some(error));
        }
        found.into_iter().flatten().collect()
    }

    /// Uniaxial strength of a link in tension, sigma_t = sqrt(3) sigma_j (a + 1) / (2 a) [Pa] (the
    /// paper's Eq. 12).
    pub fn tensile_strength(&self) -> f64 {
        self.compressive_strength() / self.strength_ratio
    }

    /// Uniaxial strength of a link in compression, sigma_c = a sigma_t [Pa].
    pub fn compressive_strength(&self) -> f64 {
        3f64.sqrt() * self.shear_strength * (self.strength_ratio + 1.0) / 2.0
    }

    /// G [Pa].
    pub fn shear_modulus(&self) -> f64 {
        self.young / (2.0 * (1.0 + self.poisson))
    }

    /// K [Pa].
    pub fn bulk_modulus(&self) -> f64 {
        self.young / (3.0 * (1.0 - 2.0 * self.poisson))
    }

    /// Speed of longitudinal waves [m/s].
    pub fn longitudinal_speed(&self) -> f64 {
        ((self.bulk_modulus() + 4.0 / 3.0 * self.shear_modulus()) / self.density).sqrt()
    }

    /// Speed of shear waves [m/s].
    pub fn shear_speed(&self) -> f64 {
        (self.shear_modulus() / self.density).sqrt()
    }

    /// Slope of the yield stress against the equivalent plastic strain [Pa].
    pub fn plastic_modulus(&self) -> f64 {
        match self.slope {
            HardeningSlope::Plastic => self.hardening,
            // In series with the elastic slope: 1 / H = 1 / (3 G) + 1 / Hp; without hardening, zero.
            HardeningSlope::Tangent => {
                let elastic = 3.0 * self.shear_modulus();
                self.hardening * elastic / (elastic - self.hardening)
            }
        }
    }
}

/// What the passes need of a solid and of the size of its elements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Constants {
    /// Diameter d of an element [m].
    pub(crate) diameter: f64,
    /// Area S0 = d / sqrt(3) of a face, per metre of thickness [m2].
    pub(crate) face: f64,
    /// Volume of an element, the hexagon sqrt(3) d2 / 2 [m3].
    pub(crate) volume: f64,
    /// Mass of an element [kg].
    pub(crate) mass: f64,
    /// Moment of inertia of the disc of its area [kg m2].
    pub(crate) inertia: f64,
    /// 2 G [Pa].
    pub(crate) twice_shear: f64,
    /// A = 1 - 2 G / (3 K) [-] (the paper's Eq. 9).
    pub(crate) coupling: f64,
    /// Mean stress per summed strain of the faces, by the number of linked faces [Pa].
    pub(crate) response: [f64; 7],
    /// Yield stress [Pa] and its slope [Pa].
    pub(crate) yield_stress: f64,
    pub(crate) plastic_modulus: f64,
    /// Compressive strength [Pa], (a + 1) / 2 and 1.5 (a - 1) [-] of the paper's Eq. 11.
    pub(crate) strength: f64,
    pub(crate) strength_shear: f64,
    pub(crate) strength_mean: f64,
    /// Stress that no link fails under [Pa], where neither its own stresses nor the equivalent and
    /// mean stress of its ends exceed it.
    ///
    /// With that stress T: the stresses along the face and along z are up to T + 2 T / 3, their
    /// difference up to 2 T / sqrt(3). The equivalent stress of the face then is below 3.3 T and
    /// its mean below 1.5 T.
    pub(crate) calm: f64,
    /// sigma_0 [Pa] and delta [m].
    pub(crate) adhesion: f64,
    pub(crate) adhesion_range: f64,
}

impl Constants {
    /// Constants of elements of `diameter` [m].
    ///
    /// The response c_N of an element with N linked faces: the mean stress changes so that the
    /// unlinked ones keep their traction. With six it is Hooke's, K tr(eps).
    pub(crate) fn new(solid: &Solid, diameter: f64) -> Self {
        let (shear, bulk) = (solid.shear_modulus(), solid.bulk_modulus());
        let coupling = 1.0 - 2.0 * shear / (3.0 * bulk);
        let volume = 3f64.sqrt() / 2.0 * diameter * diameter;
        let mass = solid.density * volume;
        let response =
            |linked: usize| (2.0 * shear / 3.0) / (3.0 - coupling - linked as f64 * coupling / 3.0);
        let strength = solid.compressive_strength();
        let strength_shear = (solid.strength_ratio + 1.0) / 2.0;
        let strength_mean = 1.5 * (solid.strength_ratio - 1.0);
        Self {
            diameter,
            face: diameter / 3f64.sqrt(),
            volume,
            mass,
            inertia: mass * volume / (2.0 * std::f64::consts::PI),
            twice_shear: 2.0 * shear,
            coupling,
            response: std::array::from_fn(response),
            yield_stress: solid.yield_stress,
            plastic_modulus: solid.plastic_modulus(),
            strength,
            strength_shear,
            strength_mean,
            calm: strength / (3.4 * strength_shear + 1.5 * strength_mean),
            adhesion: solid.adhesion,
            adhesion_range: solid.adhesion_range,
        }
    }

    /// Response of an element with `linked` linked faces; beyond six, that of six.
    pub(crate) fn response_of(&self, linked: u32) -> f64 {
        self.response[linked.min(6) as usize]
    }
}
