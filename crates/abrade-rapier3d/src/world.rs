//! What stands beside a physics world: wear surfaces, what is known of the bodies that wear them,
//! and what an embedder reads from both.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::Index;

use abrade::{Ledger, State, Surface};
use nalgebra::{Isometry3, Vector3};
use rapier::dynamics::{RigidBodyHandle, RigidBodySet};
use rapier::geometry::ColliderSet;

use crate::booking::Contact;
use crate::changed::Changed;
use crate::collision::{self, Bores};
use crate::drive::DrivenBody;
use crate::error::WearError;
use crate::event::{Refusal, WearEvent};
use crate::extent::Extent;
use crate::gate::Lie;
use crate::glance::Glances;
use crate::guard::Taken;
use crate::held::{Before, Held};
use crate::neighbours::Neighbours;
use crate::obstacle::Obstacles;
use crate::resolver::Resolver;
use crate::settings::{Counters, StepReport, WearSettings};
use crate::shadow;
use crate::steer::Steered;
use crate::surface::{SurfaceId, WornCollider};
use crate::tool::Tool;
use crate::tracked::Tracked;

/// Wear surfaces and the bodies that wear them, beside a physics world of Rapier's.
///
/// With the feature `serde-serialize`, which turns on Rapier's of the same name, it is written and
/// read by any binary format of serde between two steps, in the middle of contacts too: a run that
/// goes on from Rapier's world and this one gives the same bits. The events of the last step are
/// not kept.
#[derive(Default)]
pub struct WearWorld {
    pub(crate) settings: WearSettings,
    pub(crate) surfaces: Vec<WornCollider>,
    /// By index of the body's handle, so that every loop runs in that order.
    pub(crate) bodies: Vec<Option<Tracked>>,
    pub(crate) taken: Taken,
    pub(crate) obstacles: Obstacles,
    pub(crate) neighbours: Neighbours,
    pub(crate) changed: Changed,
    pub(crate) lies: Vec<Lie>,
    /// Bodies near a wear surface in this step.
    pub(crate) candidates: Vec<RigidBodyHandle>,
    /// The first look at every body, and whom it picked in this step.
    pub(crate) glances: Glances,
    pub(crate) picked: Vec<RigidBodyHandle>,
    /// Bodies that the embedder has registered and that were there at the last step.
    pub(crate) registered: Vec<RigidBodyHandle>,
    /// Bodies carried through this step.
    pub(crate) integrated: Vec<Integrated>,
    pub(crate) steered: Vec<Steered>,
    /// Bodies that Rapier keeps in hand through this step.
    pub(crate) held: Vec<Held>,
    /// Bodies that sleep on a surface.
    pub(crate) sleepers: Vec<RigidBodyHandle>,
    /// States before this step, if any body is held.
    pub(crate) before: Before,
    /// What the contacts of crowded surfaces bear, between the steps.
    pub(crate) bores: Bores,
    pub(crate) driven: Vec<DrivenBody>,
    pub(crate) tools: Vec<Tool>,
    pub(crate) events: Vec<WearEvent>,
    pub(crate) counters: Counters,
    /// Body steps that Micro did not resolve, by who did and why it was not Micro.
    pub(crate) reasons: Reasons,
    /// Energies of encounters that have ended.
    pub(crate) closed: Ledger,
    /// The step under way.
    pub(crate) current: Current,
    pub(crate) last_step: StepReport,
}

/// Body steps, and pressed contacts among others, by resolver and [`Refusal::name`](crate::Refusal::name).
pub(crate) type Reasons = BTreeMap<(Resolver, Cow<'static, str>), u64>;

/// Where the integration of a body ended, given in `frame`.
pub(crate) struct Integrated {
    pub body: RigidBodyHandle,
    pub end: State,
    pub frame: Isometry3<f64>,
}

/// What is known of the step under way.
#[derive(Default)]
pub(crate) struct Current {
    pub dt: f64,
    /// Time within which a contact that is to come matters: the step and another substep [s].
    pub sight: f64,
    /// Gap over which Rapier makes contacts [m].
    pub contacts: f64,
    pub exited: Option<RigidBodyHandle>,
    pub failure: Option<WearError>,
    /// Box around wherever bodies near a surface may get.
    pub reach: Option<Extent>,
    /// Dynamic bodies whose surfaces have been struck, which were carried with what struck them,
    /// and boxes around wherever they may have got.
    pub carried: Vec<(RigidBodyHandle, Extent)>,
    /// Surfaces whose contacts wear by their impulses, and why; the bodies that were left to Rapier
    /// for it, in order.
    pub crowded: Vec<(SurfaceId, Refusal)>,
    pub among: Vec<(u32, u32)>,
}

impl WearWorld {
    /// An empty registry.
    pub fn new(settings: WearSettings) -> Self {
        Self { settings, ..Self::default() }
    }

    /// Frame of a surface in the world.
    ///
    /// # Errors
    /// The surface is not of this world, or its proxy is gone.
    pub fn frame(
        &self,
        surface: SurfaceId,
        colliders: &ColliderSet,
    ) -> Result<Isometry3<f64>, WearError> {
        let worn = self.worn(surface)?;
        let missing = WearError::NoSuchCollider { collider: worn.proxy };
        Ok(worn.pose(colliders.get(worn.proxy).ok_or(missing)?))
    }

    /// A surface by its name, which may be that of another world.
    pub(crate) fn worn(&self, surface: SurfaceId) -> Result<&WornCollider, WearError> {
        self.surfaces.get(surface.0).ok_or(WearError::NoSuchSurface { surface })
    }

    /// State of a body in the world: exact as long as it was resolved here and not moved since,
    /// else as Rapier holds it.
    pub fn state(&self, handle: RigidBodyHandle, bodies: &RigidBodySet) -> Option<State> {
        self.state_from(&Isometry3::identity(), handle, bodies)
    }

    /// State of a driven body in the world.
    pub fn driven_state(&self, handle: RigidBodyHandle, colliders: &ColliderSet) -> Option<State> {
        let driven = self.driven.iter().find(|driven| driven.handle == handle)?;
        Some(driven.state(&self.frame(driven.surface(), colliders).ok()?))
    }

    /// State of a body in the frame that `frame` places, such as a surface's.
    pub fn state_from(
        &self,
        frame: &Isometry3<f64>,
        handle: RigidBodyHandle,
        bodies: &RigidBodySet,
    ) -> Option<State> {
        let rb = bodies.get(handle)?;
        let shadow = self.tracked(handle).and_then(|tracked| tracked.shadow.as_ref());
        Some(shadow::read(rb, shadow, frame))
    }

    /// True while a node carries force on the body.
    pub fn in_contact(&self, handle: RigidBodyHandle) -> bool {
        let live = self.tracked(handle).and_then(|tracked| tracked.live.as_ref());
        let cuts = self.find_tool(handle).map_or(&[][..], |tool| &tool.cuts);
        live.is_some_and(|live| live.encounter.in_contact())
            || cuts.iter().any(|cut| cut.encounter.in_contact())
    }

    /// Impulse on the body, in the world [N s], and time [s] of its contacts that have begun and not
    /// ended; None while there is none. [`WearEvent::Ended`](crate::WearEvent::Ended) tells it of those
    /// that have.
    pub fn open_contact(&self, handle: RigidBodyHandle) -> Option<(Vector3<f64>, f64)> {
        let own = self.tracked(handle).and_then(|tracked| tracked.contact.as_ref());
        let cuts = self.find_tool(handle).map_or(&[][..], |tool| &tool.cuts);
        let lying = collision::open_contacts(&self.bores, handle);
        let open = own.into_iter().chain(cuts.iter().filter_map(|cut| cut.contact.as_ref()));
        let sums = open.chain(lying).map(Contact::so_far);
        sums.reduce(|(impulse, time), (more, longer)| (impulse + more, time.max(longer)))
    }

    /// True while the energies of the body's present encounter still grow: from when it comes near
    /// a surface until it is far from all of them.
    pub fn in_encounter(&self, handle: RigidBodyHandle) -> bool {
        self.tracked(handle).is_some_and(|tracked| tracked.live.is_some())
            || self.find_tool(handle).is_some_and(|tool| !tool.cuts.is_empty())
    }

    fn tracked(&self, handle: RigidBodyHandle) -> Option<&Tracked> {
        Tracked::find(&self.bodies, handle)
    }

    /// The surfaces, in the order of insertion.
    pub fn surfaces(&self) -> impl Iterator<Item = (SurfaceId, &Surface)> {
        self.surfaces.iter().enumerate().map(|(id, worn)| (SurfaceId(id), &*worn.surface))
    }

    /// What happened in the last step.
    pub fn events(&self) -> &[WearEvent] {
        &self.events
    }

    /// The energies of all contacts so far [J]; zeros unless asked for.
    pub fn ledger(&self) -> Ledger {
        let mut sum = self.closed;
        for tracked in self.bodies.iter().flatten() {
            tracked.live.iter().for_each(|live| sum += *live.encounter.ledger());
            tracked.against.iter().for_each(|against| sum += *against.encounter.ledger());
            tracked.pressing.iter().for_each(|pressing| sum += *pressing.ledger());
        }
        self.driven.iter().for_each(|driven| sum += *driven.ledger());
        self.rub_ledgers().for_each(|ledger| sum += *ledger);
        self.tools.iter().for_each(|tool| sum += tool.ledger());
        sum
    }

    /// Body steps that Micro did not resolve since the world was made, and contacts among others that
    /// QuasiStatic pressed: by whom, why not by Micro
    /// ([`Refusal::name`](crate::Refusal::name)), and how many.
    pub fn reasons(&self) -> impl Iterator<Item = (Resolver, &str, u64)> {
        self.reasons.iter().map(|((by, why), count)| (*by, &**why, *count))
    }

    /// What the last step did, one that ended in an error too; nothing before the first, or after a world was read.
    pub fn last_step(&self) -> StepReport {
        self.last_step
    }

    /// What was done since the world was made.
    pub fn counters(&self) -> &Counters {
        &self.counters
    }
}

impl Index<SurfaceId> for WearWorld {
    type Output = Surface;

    /// # Panics
    /// The surface is of another world.
    fn index(&self, id: SurfaceId) -> &Surface {
        &self.surfaces[id.0].surface
    }
}
