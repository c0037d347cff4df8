//! How a body of a scene moves.

use abrade::quantity::{self, Quantity};
use schemars::JsonSchema;
use serde::Deserialize;

use super::vectors;

/// How a body moves. Directions count in the axes that its `position` names.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum Motion {
    /// At rest in the world, whatever strikes it: a floor, on which free surfaces wear.
    Fixed,
    /// Flies into the surface: velocity = speed (cos angle cos azimuth, cos angle sin azimuth,
    /// -sin angle).
    Impact {
        /// Speed of the centre of mass [m/s].
        #[serde(deserialize_with = "quantity::speed")]
        #[schemars(with = "Quantity")]
        speed: f64,
        /// Angle between the velocity and the surface [rad], at most 90 degrees.
        #[serde(deserialize_with = "quantity::angle")]
        #[schemars(with = "Quantity")]
        angle: f64,
        /// Turn of the direction about the normal, from +x towards +y [rad].
        #[serde(default, deserialize_with = "quantity::angle")]
        #[schemars(with = "Quantity")]
        azimuth: f64,
        /// Angular velocity [rad/s].
        #[serde(default, deserialize_with = "vectors::spin3")]
        #[schemars(with = "[Quantity; 3]")]
        spin: [f64; 3],
    },
    /// Moves freely from a given velocity.
    Free {
        /// Velocity of the centre of mass [m/s].
        #[serde(default, deserialize_with = "vectors::speed3")]
        #[schemars(with = "[Quantity; 3]")]
        velocity: [f64; 3],
        /// Angular velocity [rad/s].
        #[serde(default, deserialize_with = "vectors::spin3")]
        #[schemars(with = "[Quantity; 3]")]
        spin: [f64; 3],
    },
    /// Is pressed into the surface to a load, then slides along +x at constant speed under constant
    /// load. The rotation is locked.
    Drive {
        /// Load to which it is pressed in [N].
        #[serde(deserialize_with = "quantity::force")]
        #[schemars(with = "Quantity")]
        indent_to: f64,
        /// Load while it slides [N] (default `indent_to`).
        #[serde(default, deserialize_with = "quantity::optional_force")]
        #[schemars(with = "Option<Quantity>")]
        load: Option<f64>,
        /// Sliding speed [m/s].
        #[serde(default, deserialize_with = "quantity::speed")]
        #[schemars(with = "Quantity")]
        speed: f64,
        /// Sliding distance [m]; zero for an indentation alone.
        #[serde(default, deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        distance: f64,
        /// Length at the end of the path over which the wear rate is taken [m] (default half the
        /// distance).
        #[serde(default, deserialize_with = "quantity::optional_length")]
        #[schemars(with = "Option<Quantity>")]
        rate_over: Option<f64>,
        /// Mass of the driven body [kg] (default: that of its shape).
        #[serde(default, deserialize_with = "quantity::optional_mass")]
        #[schemars(with = "Option<Quantity>")]
        mass: Option<f64>,
        /// How the motion down the normal is found (default `Dynamic()`).
        #[serde(default)]
        solution: Solution,
    },
}

/// How a driven body's motion down the normal is found.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum Solution {
    /// By its equation of motion.
    Dynamic {},
    /// By balance of load and contact force at every increment of the path.
    QuasiStatic {
        /// Length of an increment [m] (default an eighth of a pitch).
        #[serde(default, deserialize_with = "quantity::optional_length")]
        #[schemars(with = "Option<Quantity>")]
        increment: Option<f64>,
    },
}

impl Default for Motion {
    fn default() -> Self {
        Self::Free { velocity: [0.0; 3], spin: [0.0; 3] }
    }
}

impl Default for Solution {
    fn default() -> Self {
        Self::Dynamic {}
    }
}
