//! One impact of a grain on a plate, from just above it until the whole grain is out again.

use abrade::{
    ATTACK_BINS, Body, Changes, Encounter, EncounterSettings, Instant, Ledger, Loads, Observer,
    PhysicsError, Placed, Shape, State, Surface, Until,
};
use abrade_scene::MadeGrain;
use nalgebra::{Isometry3, Point3, Vector3};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

use super::sample::Sample;

/// Lengths of the grain that it may fly at its speed before it is given up.
const FLIGHT: f64 = 1000.0;
/// Share of the energy below which a grain that is not out again by then has stopped in its crater.
const STOPPED: f64 = 1e-3;
/// Height above the plate at the start, in diameters.
const GAP: f64 = 1e-9;
/// Steps after which an impact is given up.
const STEPS: u64 = 200_000;

/// An impact to be made.
pub(crate) struct Shot<'a> {
    pub(crate) grain: &'a MadeGrain,
    pub(crate) sample: &'a Sample,
    /// Where its centre of mass starts, over the plate [m].
    pub(crate) at: [f64; 2],
    /// Speed [m/s].
    pub(crate) speed: f64,
    /// Angle from the surface [rad].
    pub(crate) angle: f64,
    pub(crate) accuracy: f64,
}

/// What an impact did. Shares are of the kinetic energy before it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Impact {
    /// Mass of the grain [kg].
    pub mass_kg: f64,
    /// Its kinetic energy before [J].
    #[serde(rename = "energy_J")]
    pub energy_j: f64,
    /// Volume displaced [m3].
    pub wear_volume_m3: f64,
    /// The part of it by normal flow [m3].
    pub normal_m3: f64,
    /// The part of it by lateral flow [m3].
    pub lateral_m3: f64,
    /// The part of it that broke off as overhangs [m3].
    pub chip_m3: f64,
    /// Debris, by the removal rule [m3].
    pub removed_volume_m3: f64,
    /// Displaced by faces of each angle of attack, in steps of 5 degrees; zeros where the removal rule
    /// does not ask for it [m3].
    pub displaced_by_attack_m3: [f64; ATTACK_BINS],
    /// How deep the grain went below the unworn plate [m].
    pub depth_m: f64,
    /// Whether it stopped in its crater.
    pub is_embedded: bool,
    /// Normal velocity after over before, turned round [-].
    pub restitution_normal: f64,
    /// Velocity along the plate in the way it came, after over before [-]; 0 where it came straight.
    pub restitution_tangential: f64,
    /// Speed after over before [-].
    pub restitution: f64,
    /// Spin after the impact [rad/s].
    pub spin_rad_s: f64,
    /// The part of the spin that a grain rolling the way it came would have; below zero where it turned
    /// backwards [rad/s].
    pub spin_forward_rad_s: f64,
    /// Speed at the rim of the grain by its forward spin, over the speed before [-].
    pub rim: f64,
    /// Share of energy left in the motion of the centre of mass [-].
    pub energy_translation: f64,
    /// Share of energy left in the rotation [-].
    pub energy_rotation: f64,
    /// Share of energy that went into wear [-].
    pub energy_wear: f64,
    /// Share of energy that went into friction [-].
    pub energy_friction: f64,
    /// Share of energy that went elsewhere: dashpots, springs, errors of time [-].
    pub energy_other: f64,
    /// Time in contact [s].
    pub contact_s: f64,
    /// Nodes taken through the law.
    pub node_evaluations: u64,
}

/// Why an impact has no result.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub(crate) enum Miss {
    #[error(transparent)]
    Physics(#[from] PhysicsError),
    #[error("it was not out again after a way of {FLIGHT} lengths")]
    Stays,
    #[error("it left the plate by its border")]
    Border,
}

/// An impact that was made, on a leaf of a plate.
pub(crate) struct Landed {
    /// What it did, and to which nodes.
    pub(crate) outcome: Result<(Impact, Changes), Miss>,
    /// The part of the plate, along x and y, that it may have looked at [m]: least and largest
    /// coordinates.
    pub(crate) seen: [[f64; 2]; 2],
}

impl Shot<'_> {
    /// Makes the impact on a leaf of `plate`.
    pub(crate) fn land(&self, plate: &Arc<Surface>) -> Landed {
        let start = self.start(self.grain.feret);
        let mut track = Track::new(&self.grain.solid.shape, &start);
        let outcome = self.make(plate, &start, &mut track);
        // The candidates of a step lie within a pitch or two of the body.
        let reach = self.grain.solid.shape.bounding_radius() + 4.0 * plate.pitch();
        let [low, high] = track.way;
        let seen = [low.map(|x| x - reach), high.map(|x| x + reach)];
        Landed { outcome, seen }
    }

    fn make(
        &self,
        plate: &Arc<Surface>,
        start: &State,
        track: &mut Track<'_>,
    ) -> Result<(Impact, Changes), Miss> {
        let solid = &self.grain.solid;
        let mut body = Body {
            shape: solid.shape.clone(),
            inertia: solid.inertia,
            state: *start,
            rotation_locked: false,
        };
        let mut leaf = Surface::leaf(plate);
        let settings =
            EncounterSettings { accuracy: self.accuracy, ledger: true, step_limit: STEPS };
        let mut encounter = Encounter::new(&body, [&leaf], settings)?;
        let mut placed = [Placed::at_rest(&mut leaf, Isometry3::identity())];
        let duration = FLIGHT * self.grain.feret / self.speed;
        let until = Until::FirstExit;
        let advance =
            encounter.advance(&mut body, &mut placed, &Loads::default(), duration, until, track)?;
        let left = solid.inertia.kinetic_energy(&body.state) / solid.inertia.kinetic_energy(start);
        let is_embedded = !advance.exited || left < 1e-9;
        if is_embedded && left > STOPPED {
            return Err(Miss::Stays);
        }
        if !self.is_over(plate, &body.state.position) {
            return Err(Miss::Border);
        }
        let changes = leaf.into_changes();
        let gain = changes.gain();
        let impact = Impact {
            wear_volume_m3: gain.displaced(),
            normal_m3: gain.normal,
            lateral_m3: gain.lateral,
            chip_m3: gain.chip,
            removed_volume_m3: gain.removed,
            displaced_by_attack_m3: gain.by_attack,
            depth_m: track.depth,
            is_embedded,
            contact_s: advance.contact_time,
            node_evaluations: advance.node_evaluations,
            ..self.told(start, &body, encounter.ledger())
        };
        Ok((impact, changes))
    }

    fn start(&self, diameter: f64) -> State {
        let lowest = self.grain.solid.shape.lowest(&self.sample.rotation, &Vector3::z());
        let [x, y] = self.at;
        let along = self.along();
        State {
            position: Point3::new(x, y, GAP * diameter - lowest),
            rotation: self.sample.rotation,
            velocity: (along * self.angle.cos() - Vector3::z() * self.angle.sin()) * self.speed,
            spin: Vector3::zeros(),
        }
    }

    /// The way it flies, along the plate.
    fn along(&self) -> Vector3<f64> {
        let (sin, cos) = self.sample.azimuth.sin_cos();
        Vector3::new(cos, sin, 0.0)
    }

    /// True while the grain is over the plate, wherever it is turned to.
    fn is_over(&self, plate: &Surface, centre: &Point3<f64>) -> bool {
        let [low, high] = plate.bounds();
        let reach = self.grain.solid.shape.bounding_radius();
        (0..2).all(|a| centre[a] - reach >= low[a] && centre[a] + reach <= high[a])
    }

    /// What the body's motion and the ledger tell.
    fn told(&self, start: &State, body: &Body, ledger: &Ledger) -> Impact {
        let inertia = &body.inertia;
        let energy = inertia.kinetic_energy(start);
        let State { velocity, spin, .. } = body.state;
        let along = self.along();
        let translation = 0.5 * inertia.mass * velocity.norm_squared() / energy;
        let kinetic = inertia.kinetic_energy(&body.state) / energy;
        let (wear, friction) = (ledger.wear / energy, ledger.friction / energy);
        let came = start.velocity.dot(&along);
        let forward = spin.dot(&Vector3::z().cross(&along));
        let is_straight = self.angle.cos() < 1e-9;
        Impact {
            mass_kg: inertia.mass,
            energy_j: energy,
            restitution_normal: -velocity.z / start.velocity.z,
            restitution_tangential: if is_straight { 0.0 } else { velocity.dot(&along) / came },
            restitution: velocity.norm() / self.speed,
            spin_rad_s: spin.norm(),
            spin_forward_rad_s: forward,
            rim: forward * self.grain.feret / 2.0 / self.speed,
            energy_translation: translation,
            energy_rotation: kinetic - translation,
            energy_wear: wear,
            energy_friction: friction,
            energy_other: 1.0 - kinetic - wear - friction,
            ..Impact::default()
        }
    }
}

/// Sees where a body goes.
struct Track<'a> {
    shape: &'a Shape,
    /// Below the unworn plate [m].
    depth: f64,
    /// Least and largest coordinates of its centre, along x and y [m].
    way: [[f64; 2]; 2],
}

impl<'a> Track<'a> {
    fn new(shape: &'a Shape, start: &State) -> Self {
        let at = [start.position.x, start.position.y];
        Self { shape, depth: 0.0, way: [at; 2] }
    }
}

impl Observer for Track<'_> {
    fn observe(&mut self, instant: &Instant<'_, '_>) {
        let State { position, rotation, .. } = instant.state;
        self.depth = self.depth.max(-position.z - self.shape.lowest(rotation, &Vector3::z()));
        let [low, high] = &mut self.way;
        for (axis, x) in [position.x, position.y].into_iter().enumerate() {
            low[axis] = low[axis].min(x);
            high[axis] = high[axis].max(x);
        }
    }
}
