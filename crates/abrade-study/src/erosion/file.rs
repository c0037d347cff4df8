//! The file of an erosion study (RON): grains, a target, at which angles and speeds, how many impacts.

use std::collections::BTreeMap;

use abrade::quantity::{self, Quantity};
use abrade::{ElasticLaw, FlowLaw, Material, Removal, SurfaceLaws};
use abrade_scene::scene::Grain;
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer};

/// The version of study files that this program reads.
pub const VERSION: u32 = 1;

/// Impacts of grains of several forms, all of one size, on a plate.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StudyFile {
    /// Version of the file's form; this one is 1.
    pub version: u32,
    /// What the study is called: the title of its results.
    pub name: String,
    /// What is struck.
    pub target: Target,
    /// Grains by name. Each impact meets another grain of a form that is random.
    pub grains: BTreeMap<String, Grain>,
    /// Name of the grain that the others are compared with (default: the first that is a sphere).
    #[serde(default)]
    pub reference: Option<String>,
    /// Density of the grains [kg/m3].
    #[serde(deserialize_with = "quantity::density")]
    #[schemars(with = "Quantity")]
    pub density: f64,
    /// Size of every grain.
    pub size: Size,
    /// Speeds of impact [m/s].
    #[serde(deserialize_with = "speeds")]
    #[schemars(with = "Vec<Quantity>")]
    pub speeds: Vec<f64>,
    /// Angles of impact, from the surface [rad].
    #[serde(deserialize_with = "angles")]
    #[schemars(with = "Vec<Quantity>")]
    pub angles: Vec<f64>,
    /// What each impact finds (default `Fresh`).
    #[serde(default)]
    pub plate: Plate,
    /// How many impacts.
    #[serde(default)]
    pub samples: Samples,
    /// Pitches that go into the edge of a cube of the volume E0/H, the most that an impact can displace
    /// at the hardness (default 10) [-].
    #[serde(default = "resolution")]
    pub resolution: f64,
    /// Target relative time error of the wear volume (default 1e-3) [-].
    #[serde(default = "accuracy")]
    pub accuracy: f64,
}

/// What is struck: a plate.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Target {
    /// Its material.
    pub material: Material,
    /// Its density, for ratios of masses (default: none are told) [kg/m3].
    #[serde(default, deserialize_with = "quantity::optional_density")]
    #[schemars(with = "Option<Quantity>")]
    pub density: Option<f64>,
    /// When a node sinks, and by how much (default `NormalPressure()`).
    #[serde(default = "flow")]
    pub flow: FlowLaw,
    /// Elastic part of the contact (default `Rigid`).
    #[serde(default = "elastic")]
    pub elastic: ElasticLaw,
    /// Which part of the displaced volume leaves as debris (default `All`).
    #[serde(default)]
    pub removal: Removal,
}

/// The size that all grains of a study have in common.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum Size {
    /// They have the volume of a sphere, and with it the mass.
    Volume {
        /// Diameter of the sphere, of the median grain [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        diameter: f64,
        /// Standard deviation of the logarithm of the diameter (default 0: all alike) [-].
        #[serde(default)]
        spread: f64,
    },
    /// They are as long: the largest distance between two points of a grain is the same.
    Feret {
        /// That distance, of the median grain [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        diameter: f64,
        /// Standard deviation of the logarithm of the diameter (default 0: all alike) [-].
        #[serde(default)]
        spread: f64,
    },
}

/// What an impact finds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum Plate {
    /// A plate that nothing has struck.
    #[default]
    Fresh,
    /// The plate that the impacts before it have left, of this size. Intervals count impacts as independent, which
    /// they are where few meet a crater; where many do, they are too narrow.
    Worn {
        /// Edge of the square over which impacts are spread evenly [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        width: f64,
    },
}

/// How many impacts a case has, and how they are spread over attitudes and places.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Samples {
    /// Impacts at least (default 64).
    pub least: u32,
    /// Impacts at most (default 1024).
    pub most: u32,
    /// Half width of the 95 % interval of the wear volume, over the volume, at which no more impacts
    /// are made (default 0.05) [-].
    pub interval: f64,
    /// How attitudes, places in the cell of the nodes and directions over the lattice are spread: the
    /// same for all grains (default `LowDiscrepancy`).
    pub sequence: Sequence,
    /// Seed of the samples, and of grains whose form is random.
    pub seed: u64,
}

/// How samples are spread.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema)]
pub enum Sequence {
    /// By a sequence that covers all of them evenly. Intervals, which count samples as independent, are
    /// then wider than they need to be.
    #[default]
    LowDiscrepancy,
    /// Independently at random (PCG32).
    Random,
}

impl Default for Samples {
    fn default() -> Self {
        let sequence = Sequence::default();
        Self { least: 64, most: 1024, interval: 0.05, sequence, seed: 0 }
    }
}

impl Target {
    /// The laws of the plate.
    pub(crate) fn laws(&self) -> SurfaceLaws {
        SurfaceLaws {
            elastic: self.elastic.clone(),
            flow: self.flow.clone(),
            removal: self.removal.clone(),
            ..SurfaceLaws::of(self.material.clone())
        }
    }
}

impl Size {
    /// Diameter of the median grain [m].
    pub(crate) fn diameter(&self) -> f64 {
        let (Self::Volume { diameter, .. } | Self::Feret { diameter, .. }) = self;
        *diameter
    }

    /// What of all grains is alike.
    pub(crate) fn word(&self) -> &'static str {
        match self {
            Self::Volume { .. } => "mass",
            Self::Feret { .. } => "length",
        }
    }

    pub(crate) fn spread(&self) -> f64 {
        let (Self::Volume { spread, .. } | Self::Feret { spread, .. }) = self;
        *spread
    }
}

fn flow() -> FlowLaw {
    FlowLaw::NormalPressure {}
}

fn elastic() -> ElasticLaw {
    ElasticLaw::Rigid
}

fn resolution() -> f64 {
    10.0
}

fn accuracy() -> f64 {
    1e-3
}

fn speeds<'de, D: Deserializer<'de>>(d: D) -> Result<Vec<f64>, D::Error> {
    quantity::SPEED.list(d)
}

fn angles<'de, D: Deserializer<'de>>(d: D) -> Result<Vec<f64>, D::Error> {
    quantity::ANGLE.list(d)
}
