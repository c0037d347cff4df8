//! `summary.json`: what a run did, in numbers that other programs read. The keys are part of the
//! interface; an absent value is `null`, never a missing key.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use abrade::{Ledger, Nodes, State, Worn};
use serde::{Deserialize, Serialize};

use crate::atomic;
use crate::error::{FileAction, ReportError};

/// The whole of `summary.json`, in the order of its keys.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Name of the scene.
    pub scene: String,
    /// Version of abrade.
    pub abrade: String,
    /// False when the run was broken off.
    pub complete: bool,
    /// Precision of the engine: `f32` or `f64`.
    pub precision: String,
    /// Steps of bodies near a surface, by the resolver that took them.
    pub resolver: ResolverCounts,
    /// Of the steps that `micro` did not take, how many for which reason: "resolver: reason".
    #[serde(default)]
    pub resolver_reasons: BTreeMap<String, u64>,
    /// Wall time [s].
    #[serde(rename = "wall_s")]
    pub wall: f64,
    /// The part of it before the first step: nodes, engine, files opened [s].
    #[serde(rename = "setup_s", default)]
    pub setup: f64,
    /// Simulated time [s].
    #[serde(rename = "simulated_s")]
    pub simulated: f64,
    /// Accepted steps.
    pub steps: u64,
    /// Nodes taken through the law, rejected steps included.
    pub node_evaluations: u64,
    /// By the names of the scene.
    pub surfaces: BTreeMap<String, SurfaceSummary>,
    /// By the names of the scene.
    pub bodies: BTreeMap<String, BodySummary>,
    /// The ledger, where the scene asks for it.
    pub energy: Option<EnergySummary>,
    /// What the bodies of streams took off, once one has struck.
    #[serde(default)]
    pub erosion: Option<ErosionSummary>,
    /// How far the wear volume may be off.
    pub error_estimate: ErrorEstimate,
    /// What the reader should know, in sentences.
    pub warnings: Vec<String>,
    /// Why the run ended, in words.
    pub stop: Option<String>,
    /// Impacts beside closed-form laws, where the scene names some.
    #[serde(default)]
    pub laws: Option<LawsSummary>,
}

/// The impacts of a run beside closed-form laws.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LawsSummary {
    /// Impacts that are over.
    pub impacts: u64,
    /// Volume that they displaced [m3].
    #[serde(rename = "wear_volume_m3")]
    pub wear_volume: f64,
    /// Sums of what each law says of them [m3]; null for a law without a finite value at one of them.
    #[serde(rename = "predicted_m3", deserialize_with = "numbers")]
    pub predicted: BTreeMap<String, f64>,
}

/// Reads numbers among which null is none.
fn numbers<'de, D: serde::Deserializer<'de>>(d: D) -> Result<BTreeMap<String, f64>, D::Error> {
    let read = BTreeMap::<String, Option<f64>>::deserialize(d)?;
    Ok(read.into_iter().map(|(name, value)| (name, value.unwrap_or(f64::NAN))).collect())
}

/// Steps of bodies near a surface, by the resolver that took them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ResolverCounts {
    /// Integrated in f64 between the engine's steps.
    pub micro: u64,
    /// By the load that the engine's contact bore.
    pub quasi_static: u64,
    /// With all that the body touches, in tiny steps of the engine.
    pub lockstep: u64,
    /// Blows of contacts that the engine kept, as collisions of two.
    pub collision: u64,
}

/// What happened to a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SurfaceSummary {
    /// Number of nodes.
    pub nodes: usize,
    /// W_V [m3] = sum of rest_area * depth (Eq. 6).
    #[serde(rename = "wear_volume_m3")]
    pub wear_volume: f64,
    /// Part displaced by the normal flow [m3].
    #[serde(rename = "wear_volume_normal_m3")]
    pub wear_volume_normal: f64,
    /// Part displaced by the lateral flow [m3].
    #[serde(rename = "wear_volume_lateral_m3")]
    pub wear_volume_lateral: f64,
    /// Part lost to slip under load, by Archard's law [m3].
    #[serde(rename = "wear_volume_archard_m3", default)]
    pub wear_volume_archard: f64,
    /// Debris, by the surface's removal rule [m3].
    #[serde(rename = "removed_volume_m3")]
    pub removed_volume: f64,
    /// Broken off as overhangs [m3].
    #[serde(rename = "chip_volume_m3")]
    pub chip_volume: f64,
    /// Largest depth [m].
    #[serde(rename = "max_depth_m")]
    pub max_depth: f64,
    /// Nodes with a depth above zero.
    pub worn_nodes: usize,
    /// Largest number of nodes that a body touched at once.
    #[serde(default)]
    pub touching_nodes: usize,
    /// Largest total force along minus the normals [N].
    #[serde(rename = "peak_normal_force_N")]
    pub peak_normal_force: f64,
    /// Largest sum of the effective areas of the nodes in normal flow [m2] (Eq. 19).
    #[serde(rename = "indented_area_m2")]
    pub indented_area: f64,
    /// Wear rate: volume per sliding distance over the last `rate_over` of a driven run [m2], m3 per m.
    #[serde(rename = "wear_rate_m2")]
    pub wear_rate: Option<f64>,
    /// How it moves; `None` for a surface at rest in the world.
    #[serde(default)]
    pub motion: Option<MotionSummary>,
}

/// Where the body of a moving surface ended, and how it moves: the centre of mass of a free one,
/// the origin of the surface's frame of a led one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MotionSummary {
    /// Place [m].
    #[serde(rename = "position_m")]
    pub position: [f64; 3],
    /// Orientation as the quaternion x, y, z, w.
    pub rotation_xyzw: [f64; 4],
    /// Velocity [m/s].
    #[serde(rename = "velocity_m_s")]
    pub velocity: [f64; 3],
    /// Angular velocity [rad/s].
    #[serde(rename = "spin_rad_s")]
    pub spin: [f64; 3],
}

/// Where a body ended and how it left.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BodySummary {
    /// Centre of mass [m].
    #[serde(rename = "position_m")]
    pub position: [f64; 3],
    /// Orientation as the quaternion x, y, z, w.
    pub rotation_xyzw: [f64; 4],
    /// Velocity of the centre of mass [m/s].
    #[serde(rename = "velocity_m_s")]
    pub velocity: [f64; 3],
    /// Angular velocity [rad/s].
    #[serde(rename = "spin_rad_s")]
    pub spin: [f64; 3],
    /// Speed after over speed before [-]; `None` where there was no impact, for a body that stays or has
    /// fallen past its surface, after a failure, and where something leads a surface that it met.
    pub restitution: Option<f64>,
    /// Angle of the velocity from the surface [deg]; `None` where the restitution is.
    #[serde(rename = "rebound_angle_deg")]
    pub rebound_angle: Option<f64>,
    /// Speed away from the surface after over speed towards it before, along the normal of the
    /// plate at rest that it met first [-]; `None` where the restitution is, and for any other
    /// surface.
    #[serde(default)]
    pub restitution_normal: Option<f64>,
    /// Impulse of the surfaces over the time in contact, force over the way of a driven body, and its last
    /// force where it only indents [N]; zero without a contact.
    #[serde(rename = "mean_force_N")]
    pub mean_force: [f64; 3],
}

/// The energies of a run [J].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EnergySummary {
    /// Kinetic energy at the start, and of driven bodies what springs hold at the end of their indentation: energies
    /// count from there [J].
    #[serde(rename = "initial_J")]
    pub initial: f64,
    /// Kinetic energy now [J].
    #[serde(rename = "kinetic_J")]
    pub kinetic: f64,
    /// Stored in the springs [J].
    #[serde(rename = "elastic_J")]
    pub elastic: f64,
    /// Dissipated by slip [J].
    #[serde(rename = "friction_J")]
    pub friction: f64,
    /// Work of wear [J].
    #[serde(rename = "wear_J")]
    pub wear: f64,
    /// Dissipated by damping [J].
    #[serde(rename = "damping_J")]
    pub damping: f64,
    /// Done by gravity, loads and drives [J].
    #[serde(rename = "external_work_J")]
    pub external_work: f64,
    /// Change made by a tangential history that is not conservative [J].
    #[serde(rename = "history_J")]
    pub history: f64,
    /// Energy of adhesion [J], counted from the start of the run: falls as bodies come to adhere,
    /// rises as they part.
    #[serde(rename = "adhesion_J")]
    pub adhesion: f64,
    /// Added by time integration [J].
    #[serde(rename = "numerical_J")]
    pub numerical: f64,
}

/// Debris of all surfaces over the mass of the bodies of streams that have struck one. The debris is by
/// the removal rules of the surfaces, and all that is displaced where they have none. Steady is the
/// second half of that mass, in which 40 steps with new bodies are needed at least.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErosionSummary {
    /// Bodies that have struck.
    pub struck: u64,
    /// Their mass [kg].
    #[serde(rename = "struck_kg")]
    pub mass: f64,
    /// Over the whole run [mm3/kg].
    #[serde(rename = "rate_mm3_per_kg")]
    pub rate: f64,
    /// Over the steady part [mm3/kg].
    #[serde(rename = "steady_mm3_per_kg")]
    pub steady: Option<f64>,
    /// Standard error of that, from the scatter of ten blocks of it [mm3/kg].
    #[serde(rename = "steady_deviation_mm3_per_kg")]
    pub steady_deviation: Option<f64>,
    /// Over the whole run [kg/kg]; `None` unless every surface has a density.
    #[serde(rename = "rate_kg_per_kg")]
    pub rate_by_mass: Option<f64>,
    /// Over the steady part [kg/kg]; `None` unless every surface has a density.
    #[serde(rename = "steady_kg_per_kg")]
    pub steady_by_mass: Option<f64>,
}

/// How far the wear volume may be off, relative.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ErrorEstimate {
    /// By the time steps [-]; `None` where the run has no basis for it.
    pub time: Option<f64>,
    /// By the node distance [-]; `None` where the run has no basis for it.
    pub pitch: Option<f64>,
    /// What the estimate rests on, in words.
    pub basis: Option<String>,
}

impl Summary {
    /// The text of the file, indented.
    ///
    /// # Errors
    /// Never for values made by this crate's structs; the writer's own.
    pub fn to_json(&self) -> Result<String, ReportError> {
        let mut text = serde_json::to_string_pretty(self)?;
        text.push('\n');
        Ok(text)
    }

    /// Reads the file `path`.
    ///
    /// # Errors
    /// The file system refuses, or a key is missing.
    pub fn read(path: &Path) -> Result<Self, ReportError> {
        let text = fs::read_to_string(path).map_err(ReportError::file(FileAction::Read, path))?;
        let damaged = |source: serde_json::Error| ReportError::Damaged {
            path: path.to_owned(),
            missing: format!("{source}: a key or value"),
        };
        serde_json::from_str(&text).map_err(damaged)
    }

    /// Writes the file `path`.
    ///
    /// # Errors
    /// The file system refuses.
    pub fn write(&self, path: &Path) -> Result<(), ReportError> {
        atomic::write(path, self.to_json()?.as_bytes())
    }
}

impl SurfaceSummary {
    /// What the nodes since they were made ([`abrade::Surface::nodes_since_made`]), the wear volume
    /// [m3] and the tally of a surface tell. The caller adds `wear_rate` [m2], which needs the
    /// body's path, and `motion`.
    pub fn of(nodes: &Nodes, wear_volume: f64, worn: &Worn) -> Self {
        Self {
            nodes: nodes.len(),
            wear_volume,
            wear_volume_normal: worn.normal,
            wear_volume_lateral: worn.lateral,
            wear_volume_archard: worn.archard,
            removed_volume: worn.removed,
            chip_volume: worn.chip,
            max_depth: nodes.depth.iter().copied().fold(0.0, f64::max),
            worn_nodes: nodes.depth.iter().filter(|depth| **depth > 0.0).count(),
            touching_nodes: worn.peak_touching,
            peak_normal_force: worn.peak_normal_force,
            indented_area: worn.indented_area,
            wear_rate: None,
            motion: None,
        }
    }
}

impl MotionSummary {
    /// The state of a body.
    pub fn of(state: &State) -> Self {
        Self {
            position: state.position.coords.into(),
            rotation_xyzw: state.rotation.coords.into(),
            velocity: state.velocity.into(),
            spin: state.spin.into(),
        }
    }
}

impl BodySummary {
    /// The state of a body; the caller adds what its path tells.
    pub fn of(state: &State) -> Self {
        Self {
            position: state.position.coords.into(),
            rotation_xyzw: state.rotation.coords.into(),
            velocity: state.velocity.into(),
            spin: state.spin.into(),
            restitution: None,
            rebound_angle: None,
            restitution_normal: None,
            mean_force: [0.0; 3],
        }
    }
}

impl EnergySummary {
    /// The ledger of all contacts, with the kinetic energy at the start and now [J].
    pub fn of(ledger: &Ledger, initial: f64, kinetic: f64) -> Self {
        Self {
            initial,
            kinetic,
            elastic: ledger.elastic,
            friction: ledger.friction,
            wear: ledger.wear,
            damping: ledger.damping,
            external_work: ledger.external_work,
            history: ledger.history,
            adhesion: ledger.adhesion,
            numerical: ledger.numerical(),
        }
    }
}

#[cfg(test)]
mod tests;
