//! The QuasiStatic resolver: Rapier has kept the contact through the step; the nodes under the
//! body sink until they carry the load that Rapier measured, along the way that the body went.
//!
//! Rapier's penetration never enters: the body's height is the one at which the load balances.

use abrade::{Advance, Body, Hold, Ledger, PhysicsError, Pressed, State, Surface};
use nalgebra::{Isometry3, Vector3};
use rapier::dynamics::RigidBodyHandle;

use crate::gate::Lie;
use crate::micro::{self, Volumes, place};
use crate::observer::{Relay, WearObserver};
use crate::surface::{SurfaceId, WornCollider};
use crate::track::Trace;

/// Balances of the load per pitch of the way.
pub(crate) const SAMPLES: f64 = 4.0;
/// Most balances of a step: beyond it the way is sampled more coarsely.
pub(crate) const LIMIT: u64 = 4000;
/// Share of a pitch below which a way is none, and of a load below which it has not grown.
const STILL: f64 = 1e-6;
/// Pitches by which a body that is elsewhere than it was left has been moved by somebody.
const ASTRAY: f64 = 0.05;

/// A body pressed against one surface.
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Pressing {
    pub surface: SurfaceId,
    pressed: Pressed,
    /// State in the surface's frame, at the height at which the load is balanced.
    body: Body,
    /// Largest load so far [N].
    load: f64,
}

/// Where a pressed body goes in a step.
pub(crate) struct Move<'a> {
    /// Its state at the end, but for the height, in the surface's frame.
    pub end: &'a State,
    /// Load that presses it down [N].
    pub load: f64,
    /// Length of the step [s].
    pub dt: f64,
}

/// What a step pressed into a surface.
pub(crate) struct Outcome {
    pub advance: Advance,
    /// Friction that Rapier's contact should have [-].
    pub friction: f64,
}

/// True when nothing is worn under `load` [N]: no node can flow, and nothing wears below that. None
/// bears more than all of it, and the least that moves a node is its rest area times the smaller
/// hardness. On a closed surface a few nodes at its edges stand for less than the area taken.
pub(crate) fn holds(surface: &Surface, load: f64) -> bool {
    if surface.laws().archard.is_some() {
        return false;
    }
    let material = &surface.laws().material;
    let hardness = surface.least_hardness() * material.shear_ratio.min(1.0);
    load * 1f64.hypot(material.friction) < hardness * surface.least_area()
}

impl Pressing {
    pub fn new(
        body: &Body,
        state: State,
        surface: SurfaceId,
        worn: &WornCollider,
        settings: abrade::EncounterSettings,
    ) -> Result<Self, PhysicsError> {
        let body = Body { state, ..body.clone() };
        let pressed = Pressed::new(&body, [&*worn.surface], settings)?;
        Ok(Self { surface, pressed, body, load: 0.0 })
    }

    /// True while the body, at `start` of a step in the surface's frame, is where it was left.
    pub fn is_at(&self, start: &State, worn: &WornCollider) -> bool {
        let state = &self.body.state;
        let turn = state.rotation.angle_to(&start.rotation) * self.body.shape.bounding_radius();
        let aside = (state.position - start.position).xy().norm() + turn;
        aside < ASTRAY * worn.surface.pitch()
    }

    /// Moves on; `None` where nothing moved and no load grew.
    pub fn advance(
        &mut self,
        handle: RigidBodyHandle,
        surfaces: &mut [WornCollider],
        lies: &[Lie],
        way: &Move<'_>,
        observer: &mut dyn WearObserver,
    ) -> Result<Option<Outcome>, PhysicsError> {
        let Move { end, load, dt } = *way;
        let pitch = surfaces[self.surface.0].surface.pitch();
        let way = end.position - self.body.state.position;
        let turn = self.body.state.rotation.angle_to(&end.rotation);
        let way = way.xy().norm() + turn * self.body.shape.bounding_radius();
        if way < STILL * pitch && load < (1.0 + STILL) * self.load {
            return Ok(None);
        }
        let Some(lie) = Lie::find(lies, self.surface) else { return Ok(None) };
        let frame = lie.pose;
        let mut placed = place(surfaces, self.surface, (Isometry3::identity(), None));
        let trace = Trace::new(end.position, Vector3::zeros(), dt);
        let ids = &[self.surface];
        let mut relay = Relay { observer, body: handle, frame, surfaces: ids, began: 0.0, trace };
        let hold = Hold {
            load: -Vector3::z() * load,
            duration: dt,
            increment: pitch / SAMPLES,
            limit: LIMIT,
            reach: None,
        };
        let advance = self.pressed.advance(&mut self.body, &mut placed, end, &hold, &mut relay)?;
        self.load = if way < pitch { self.load.max(load) } else { load };
        let friction = placed[0].surface.laws().material.friction;
        let force = self.pressed.force();
        let ratio = force.xy().norm() / force.z.max(f64::MIN_POSITIVE);
        let friction = if force.z > 0.0 { friction.max(ratio) } else { friction };
        Ok(Some(Outcome { advance, friction }))
    }

    /// Ends the contact: overhangs break off. Returns its energies, and the volumes that broke off.
    pub fn end(mut self, surfaces: &mut [WornCollider]) -> (Ledger, Volumes) {
        let broken = micro::end(surfaces, &[self.surface], None, |placed| self.pressed.end(placed));
        (*self.pressed.ledger(), broken)
    }

    /// The energies so far.
    pub fn ledger(&self) -> &Ledger {
        self.pressed.ledger()
    }
}

#[cfg(feature = "serde-serialize")]
impl Pressing {
    /// True when it is pressed against these surfaces by a load that can be.
    pub fn is_sound<'a>(&self, surfaces: impl Iterator<Item = &'a Surface>) -> bool {
        self.load.is_finite() && self.load >= 0.0 && self.pressed.is_made_for(surfaces)
    }
}
