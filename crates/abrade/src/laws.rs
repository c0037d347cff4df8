//! The laws a surface can carry: elastic part, flow part, removal rule. Data only; the
//! arithmetic stands in `elastic` and `flow`.

use crate::error::ParameterError;
use crate::material::Material;

/// Elastic part of the contact, per node.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "state", derive(serde::Serialize))]
pub enum ElasticLaw {
    /// Winkler foundation: pressure k_w d, independent of the mesh.
    Foundation {
        /// k_w [Pa/m]; by default calibrated so that a sphere of the body's reference radius R
        /// carries its Hertz force when its mean pressure is H: 16 E*^2 / (9 pi^2 R H), with the
        /// yield overlap H/k_w kept within [1e-4, 2e-2] R. R is the radius of a ball, or of a ball
        /// of a hull's volume; of a body larger than the solid that it wears, that of the solid.
        #[cfg_attr(
            feature = "serde",
            serde(default, deserialize_with = "crate::quantity::optional_stiffness")
        )]
        #[cfg_attr(feature = "serde", schemars(with = "Option<crate::quantity::Quantity>"))]
        stiffness: Option<f64>,
    },
    /// The paper's law: every node a sphere of its own, Hertz normal force, Mindlin tangential
    /// spring. Does not converge with the pitch.
    HertzNodes {
        /// r_s [m]: radius of a node's sphere; the body is inflated by it.
        #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::quantity::length"))]
        #[cfg_attr(feature = "serde", schemars(with = "crate::quantity::Quantity"))]
        node_radius: f64,
        /// Which bodies give way.
        #[cfg_attr(feature = "serde", serde(default))]
        convention: HertzConvention,
    },
    /// No springs: rigid-plastic.
    Rigid,
}

/// Which bodies give way in [`ElasticLaw::HertzNodes`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, schemars::JsonSchema))]
#[cfg_attr(feature = "state", derive(serde::Serialize))]
pub enum HertzConvention {
    /// K = 2E/(3(1-nu^2)), k_t = 4G/(2-nu): node and body of the same elasticity.
    #[default]
    ElasticPair,
    /// Both doubled: the body is rigid.
    RigidBody,
}

/// Adhesion: what lies within a range of a node is drawn to it by a constant traction (Dugdale 1960;
/// Maugis, Journal of Colloid and Interface Science 150 (1992) 243). It takes springs: `Foundation` or
/// `HertzNodes`.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "state", derive(serde::Serialize))]
pub struct Adhesion {
    /// w [J/m2]: work of adhesion, what a unit of area costs to part.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::quantity::area_energy"))]
    #[cfg_attr(feature = "serde", schemars(with = "crate::quantity::Quantity"))]
    pub work: f64,
    /// Distance up to which the traction acts [m]. The traction, `work` over `range` times half of
    /// `pull_off`, must be below the hardness of every node; the rim of a contact, sqrt(2 R range) wide about a ball of radius R, should be five
    /// pitches wide at least.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::quantity::length"))]
    #[cfg_attr(feature = "serde", schemars(with = "crate::quantity::Quantity"))]
    pub range: f64,
    /// Pull-off force of a ball from a plane over pi w R [-]: 2 is what nodes come to by themselves
    /// (Bradley, DMT), 1.5 that of JKR; between them that of Maugis and Dugdale. It scales the work
    /// of adhesion in effect.
    #[cfg_attr(feature = "serde", serde(default = "local_pull_off"))]
    pub pull_off: f64,
}

/// Pull-off over pi w R of a local traction [-].
fn local_pull_off() -> f64 {
    2.0
}

impl Adhesion {
    /// One of a `work` of adhesion [J/m2] and a `range` [m].
    pub fn new(work: f64, range: f64) -> Self {
        Self { work, range, pull_off: local_pull_off() }
    }

    /// sigma_0 [Pa], of the work of adhesion in effect.
    pub fn traction(&self) -> f64 {
        0.5 * self.pull_off * self.work / self.range
    }

    /// Every value outside its range, on a surface of `material`.
    pub fn check(&self, material: &Material) -> Vec<ParameterError> {
        let sizes = [("work", self.work), ("range", self.range)];
        let mut found: Vec<_> =
            sizes.into_iter().filter_map(|(field, x)| ParameterError::positive(field, x)).collect();
        found.extend(ParameterError::within("pull_off", self.pull_off, 1.5, 2.0));
        if found.is_empty() {
            found.extend(self.below(material.hardness));
        }
        found
    }

    /// A fault if the traction reaches a hardness [Pa].
    pub(crate) fn below(&self, hardness: f64) -> Option<ParameterError> {
        let traction = self.traction();
        let is_fine = traction < hardness;
        (!is_fine).then(|| ParameterError {
            field: "range",
            value: self.range,
            allowed: format!(
                "so long that the traction on it, {traction:e} Pa, is below the hardness, {hardness:e} Pa"
            ),
        })
    }
}

/// Wear of a surface that bodies slide over, below its hardness too: K F s / H of volume for a load F
/// that slips by s (Archard, Journal of Applied Physics 24 (1953) 981). Of a node that flows as well
/// it is a part of the way that the flow takes it. On nodes that springs press s is the slip of their
/// tangential springs: one that sticks wears nothing. Faces have none, and s is the way of the face along
/// itself. It takes springs, `Foundation` or `HertzNodes`, and holds where K s of a step is below the
/// yield overlap.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "state", derive(serde::Serialize))]
pub struct Archard {
    /// K [-], above 0 and at most 1: of V = K F s / H. Texts that write V = K F s / (3 H) have three
    /// times this one.
    pub coefficient: f64,
}

impl Archard {
    /// Every value outside its range.
    pub fn check(&self) -> Vec<ParameterError> {
        let positive = ParameterError::positive("coefficient", self.coefficient);
        let most = || ParameterError::within("coefficient", self.coefficient, 0.0, 1.0);
        positive.or_else(most).into_iter().collect()
    }
}

/// Flow part: when a node sinks, and by how much.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "state", derive(serde::Serialize))]
pub enum FlowLaw {
    /// Capozza & Hanley (2022), Eqs. 7-9: a normal gate and a lateral gate.
    CapozzaHanley {
        /// Geometry of the lateral drop.
        #[cfg_attr(feature = "serde", serde(default))]
        lateral: Lateral,
    },
    /// Pressure H on every face element moving into the surface, normal to the face: the
    /// rigid-plastic theory of Hutchings, Papini & Spelt, Rickerby & Macmillan.
    NormalPressure {},
}

/// Geometry of the lateral drop in [`FlowLaw::CapozzaHanley`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, schemars::JsonSchema))]
#[cfg_attr(feature = "state", derive(serde::Serialize))]
pub enum Lateral {
    /// Exact and signed: the drop that keeps the node on the moving body.
    #[default]
    Projected,
    /// The paper's Eq. 5 and Eq. A.1 to the letter: every node as if in the plane of motion.
    /// For balls alone.
    Eq5,
}

/// Which part of the displaced volume leaves the surface as debris.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "state", derive(serde::Serialize))]
pub enum Removal {
    /// All of it.
    #[default]
    All,
    /// A fixed share.
    Fraction {
        /// Share of the displaced volume that is removed [-].
        of: f64,
    },
    /// Cutting where the face attacks steeper than `critical`, ploughing below.
    AttackAngle {
        /// Angle between the face and its sliding direction [rad].
        #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::quantity::angle"))]
        #[cfg_attr(feature = "serde", schemars(with = "crate::quantity::Quantity"))]
        critical: f64,
    },
}

/// Angles of attack that [`Worn::by_attack`](crate::Worn::by_attack) tells apart.
pub const ATTACK_BINS: usize = 18;
/// Width of each of them [rad].
pub const ATTACK_BIN: f64 = std::f64::consts::FRAC_PI_2 / ATTACK_BINS as f64;

/// What a removal rule makes of a drop.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Debris {
    /// Share that leaves.
    pub share: f64,
    /// Which angle of attack it was swept at, where the rule asks.
    pub bin: Option<usize>,
}

impl ElasticLaw {
    /// Every value outside its range.
    pub fn check(&self) -> Vec<ParameterError> {
        match self {
            Self::Foundation { stiffness } => stiffness
                .and_then(|k| ParameterError::positive("stiffness", k))
                .into_iter()
                .collect(),
            Self::HertzNodes { node_radius, .. } => {
                ParameterError::positive("node_radius", *node_radius).into_iter().collect()
            }
            Self::Rigid => Vec::new(),
        }
    }
}

impl Removal {
    /// True if the share depends on the angle of attack.
    pub(crate) fn asks_attack(&self) -> bool {
        matches!(self, Self::AttackAngle { .. })
    }

    /// What becomes of a drop; `attack` is the sine of the face's angle of attack.
    pub(crate) fn debris(&self, attack: impl FnOnce() -> f64) -> Debris {
        match self {
            Self::All => Debris { share: 1.0, bin: None },
            Self::Fraction { of } => Debris { share: *of, bin: None },
            Self::AttackAngle { critical } => {
                let attack = attack();
                let share = f64::from(u8::from(attack >= critical.sin()));
                let bin = (attack.clamp(0.0, 1.0).asin() / ATTACK_BIN) as usize;
                Debris { share, bin: Some(bin.min(ATTACK_BINS - 1)) }
            }
        }
    }

    /// Every value outside its range.
    pub fn check(&self) -> Vec<ParameterError> {
        match self {
            Self::All => Vec::new(),
            Self::Fraction { of } => {
                ParameterError::within("of", *of, 0.0, 1.0).into_iter().collect()
            }
            Self::AttackAngle { critical } => {
                ParameterError::within("critical", *critical, 0.0, std::f64::consts::FRAC_PI_2)
                    .into_iter()
                    .collect()
            }
        }
    }
}
