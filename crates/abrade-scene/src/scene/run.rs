//! When a scene's run stops, how closely it computes, what it writes.

use std::collections::BTreeMap;

use abrade::quantity::{self, Quantity};
use schemars::JsonSchema;
use serde::Deserialize;

/// When to stop and how closely to compute.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Run {
    /// When the run ends (default `AllRebounded`).
    #[serde(default)]
    pub stop: Stop,
    /// How contacts are resolved (default `Auto`).
    #[serde(default)]
    pub resolve: Resolve,
    /// Target relative time error of the wear volume [-].
    #[serde(default = "default_accuracy")]
    pub accuracy: f64,
    /// Time step of the engine [s] (default 1/240 s), 1 s at most. In each a led surface moves at constant
    /// velocity.
    #[serde(default = "default_step", deserialize_with = "quantity::time")]
    #[schemars(with = "Quantity")]
    pub step: f64,
}

/// When a run ends.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum Stop {
    /// When every free body moves away from every surface, or rests where none that is led can come.
    #[default]
    AllRebounded,
    /// At the first instant after contact at which the whole body is above the undeformed surface,
    /// or its kinetic energy is below 1e-9 of the start.
    FirstExit,
    /// After a time.
    Time {
        /// Simulated time [s].
        #[serde(deserialize_with = "quantity::time")]
        #[schemars(with = "Quantity")]
        limit: f64,
    },
    /// When every driven body has slid its distance.
    Distance,
    /// After a number of impacts.
    Impacts {
        /// Number of impacts.
        count: u64,
    },
}

/// How contacts are resolved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema)]
pub enum Resolve {
    /// The method that fits each body and step.
    #[default]
    Auto,
    /// The contact integrator alone: a body that it cannot carry wears nothing.
    Micro,
    /// By the balance of the load that the engine's contact bore, blows included.
    QuasiStatic,
    /// Every body near a surface in tiny steps of the engine, with all that it touches: the
    /// reference, at its price.
    Lockstep,
}

/// Something a run writes beside its summary.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum Output {
    /// `history.csv`: motion, force and wear over time; of copies the wear of all together.
    History {
        /// Time between lines [s].
        #[serde(deserialize_with = "quantity::time")]
        #[schemars(with = "Quantity")]
        every: f64,
    },
    /// `surface_NNNN.vtp` and `surface.pvd`: the worn surface, at the end unless `every` is given;
    /// copies of one are in one file.
    Surface {
        /// At which moment.
        #[serde(default)]
        at: Option<Moment>,
        /// Time between files [s].
        #[serde(default, deserialize_with = "quantity::optional_time")]
        #[schemars(with = "Option<Quantity>")]
        every: Option<f64>,
    },
    /// `bodies.pvd`: the bodies at the instants of `Surface`.
    Bodies,
    /// `surface.stl` or `surface.obj`: the facets of the worn surface at the end, in its frame [m];
    /// closed for a solid, a sheet for a plate; of copies the first.
    Mesh {
        /// Format of the file.
        format: MeshFormat,
    },
    /// `surface.png`: plan view and cross-section of a worn plate; a worn solid from the side of
    /// its deepest node; of copies the first.
    Picture,
    /// The energy ledger, in the summary.
    Energy,
    /// `report.html`: picture and numbers on one page; `abrade view` makes the page in 3D.
    Report,
    /// `impacts.csv`: every impact with the volume that it displaced, and beside it the volumes that
    /// closed-form laws of erosion give for its mass, speed and angle at the touch; their sums in the
    /// summary. A body's diameter is that of the ball of its volume. Bodies are then run one after the
    /// other.
    Laws {
        /// Names of the laws, as `abrade laws` lists them.
        names: Vec<String>,
        /// Density of the surfaces [kg/m3], for laws that give masses.
        #[serde(default, deserialize_with = "quantity::optional_density")]
        #[schemars(with = "Option<Quantity>")]
        surface_density: Option<f64>,
        /// Other parameters of the laws by name, in SI; a hardness or flow pressure that is not given is
        /// that of the material.
        #[serde(default)]
        given: BTreeMap<String, f64>,
    },
}

/// Format of a mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
pub enum MeshFormat {
    /// Binary STL: corners to seven digits.
    Stl,
    /// OBJ: corners to every digit, and each but once.
    Obj,
}

/// A moment of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
pub enum Moment {
    /// When it ends.
    End,
}

impl Default for Run {
    fn default() -> Self {
        Self {
            stop: Stop::default(),
            resolve: Resolve::default(),
            accuracy: default_accuracy(),
            step: default_step(),
        }
    }
}

fn default_accuracy() -> f64 {
    1e-3
}

fn default_step() -> f64 {
    1.0 / 240.0
}
