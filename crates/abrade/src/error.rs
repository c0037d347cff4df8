//! Typed errors: what, where, and what was allowed.

use thiserror::Error;

/// A parameter outside its range.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("`{field}` is {value}, it must be {allowed}")]
pub struct ParameterError {
    /// Field name, as a scene writes it.
    pub field: &'static str,
    /// The offending value, in SI units.
    pub value: f64,
    /// What was allowed, in words.
    pub allowed: String,
}

impl ParameterError {
    /// An error unless `value` is finite and above zero.
    pub fn positive(field: &'static str, value: f64) -> Option<Self> {
        let fine = value.is_finite() && value > 0.0;
        (!fine).then(|| Self { field, value, allowed: "finite and above zero".into() })
    }

    /// An error unless `low <= value <= high`; `f64::MAX` for what has no bound above, and
    /// `f64::MIN_POSITIVE` for what is above zero.
    pub fn within(field: &'static str, value: f64, low: f64, high: f64) -> Option<Self> {
        let fine = value >= low && value <= high;
        let allowed = || match (low == f64::MIN_POSITIVE, high == f64::MAX) {
            (true, true) => "finite and above zero".into(),
            (true, false) => format!("above zero and at most {high}"),
            (false, true) => format!("finite and at least {low}"),
            (false, false) => format!("between {low} and {high}"),
        };
        (!fine).then(|| Self { field, value, allowed: allowed() })
    }
}

/// A surface that cannot be built.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum SurfaceError {
    /// A law or material parameter is out of range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// No node would be left.
    #[error("the surface has no nodes: {reason}")]
    NoNodes {
        /// Why there is none.
        reason: String,
    },
    /// More nodes than the index type or a plain memory bound allows.
    #[error("the surface would have {nodes:.3e} nodes, at most {limit:.1e} are allowed")]
    TooManyNodes {
        /// Nodes asked for.
        nodes: f64,
        /// Largest number allowed.
        limit: f64,
    },
    /// Not one factor on the hardness per node.
    #[error("{factors} factors on the hardness of {nodes} nodes")]
    HardnessCount {
        /// Factors given.
        factors: usize,
        /// Nodes of the surface.
        nodes: usize,
    },
    /// A factor on the hardness is out of range.
    #[error("the factor {factor} on the hardness of node {node} is not finite and above zero")]
    HardnessFactor {
        /// The node.
        node: usize,
        /// Its factor [-].
        factor: f32,
    },
    /// A parameter that the chosen law needs is missing.
    #[error("{law} needs `{field}`, which the material does not give")]
    Missing {
        /// The law.
        law: &'static str,
        /// The missing field.
        field: &'static str,
    },
}

/// A shape that cannot be built.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ShapeError {
    /// No piece, or a hull of no points.
    #[error("the shape is empty: {what}")]
    Empty {
        /// What was empty.
        what: &'static str,
    },
    /// A coordinate, radius or edge is not finite, or not above zero.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// All points lie in one plane, on one line or in one place.
    #[error(
        "the {points} points of the hull are coplanar: their thickness is {thickness:e} m, \
         less than 1e-9 of their extent {extent:e} m"
    )]
    Coplanar {
        /// Number of points given.
        points: usize,
        /// Smallest width of the cloud [m].
        thickness: f64,
        /// Largest width of the cloud [m].
        extent: f64,
    },
}

/// Why a contact could not be carried on: a physical state outside the model's reach.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum PhysicsError {
    /// The body's centre of mass went below the undeformed surface; beside a strip, by twice as far
    /// as the body reaches, while it touches nodes.
    #[error(
        "the body's centre of mass is {depth:e} m below the undeformed surface: the crater is deeper than the body, which is outside the model"
    )]
    Engulfed {
        /// Depth of the centre of mass below the undeformed surface [m].
        depth: f64,
    },
    /// The body overlaps the surface at the start.
    #[error("the body starts {depth:e} m inside the surface")]
    StartsInside {
        /// Largest overlap of a node [m].
        depth: f64,
    },
    /// A position, velocity or force is no longer finite.
    #[error("the state is not finite after {time:e} s")]
    NotFinite {
        /// Time since the call began that found it [s].
        time: f64,
    },
    /// The step was halved until it vanished.
    #[error(
        "the contact needs a time step below {step:e} s: it is stiffer than the arithmetic can resolve"
    )]
    StepVanished {
        /// Smallest step tried [s].
        step: f64,
    },
    /// The bounded number of steps was used up.
    #[error("the contact took more than {steps} steps")]
    TooManySteps {
        /// Steps taken.
        steps: u64,
    },
    /// Springs under the faces of a body took or gave energy that it never had.
    #[error(
        "the springs under the body's faces are out of balance by {short:e} J, of the {energy:e} J of the contact: nodes nearer to each other, or a higher accuracy, keep it"
    )]
    Unbalanced {
        /// Energy that the body owes the springs [J]; below zero what they owe it.
        short: f64,
        /// Its kinetic energy at the first touch, and the work of loads since [J].
        energy: f64,
    },
    /// A driven body cannot find the load.
    #[error(
        "the load of {load:e} N is not reached before the body is pressed {depth:.3e} m in: the surface is too small \
         or too soft for it, or the body has come to its rim"
    )]
    LoadNotReached {
        /// Load asked for [N].
        load: f64,
        /// Depth at which the search ended [m].
        depth: f64,
    },
    /// The laws and the body do not go together.
    #[error("{what}")]
    Unsupported {
        /// What does not go together, and what does.
        what: &'static str,
    },
}
