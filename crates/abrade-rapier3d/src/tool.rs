//! Tools: kinematic bodies that the embedder has said cut. They wear what they are led through, and
//! nothing that they meet turns them aside, so that each of their contacts is on its own.

use abrade::{Advance, Inertia, Ledger, State};
use nalgebra::{Isometry3, Vector3};
use rapier::dynamics::{RigidBody, RigidBodyHandle, RigidBodySet, RigidBodyType};

use crate::cut::Cut;
use crate::error::{Led, WearError};
use crate::event::Refusal;
use crate::free;
use crate::gate::{self, Course, Lie};
use crate::held;
use crate::observer::WearObserver;
use crate::shadow::Shadow;
use crate::surface::{SurfaceId, WornCollider};
use crate::tracked::{Known, Tracked};
use crate::view::WorldView;
use crate::world::WearWorld;
use crate::{derive, scalar, steer};

/// A tool and its contacts.
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Tool {
    pub handle: RigidBodyHandle,
    pub cuts: Vec<Cut>,
    pub load: ToolLoad,
    /// Surfaces that it comes near in the step under way.
    #[cfg_attr(feature = "serde-serialize", serde(skip))]
    pub near: Vec<SurfaceId>,
    /// Where it ends in the step under way, in a frame.
    #[cfg_attr(feature = "serde-serialize", serde(skip))]
    pub end: Option<(Isometry3<f64>, State)>,
    /// Surfaces whose contacts with it are left to Rapier in the step under way.
    #[cfg_attr(feature = "serde-serialize", serde(skip))]
    pub left: Vec<SurfaceId>,
}

/// What the wear surfaces did to a tool in the last step, in the world.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
pub struct ToolLoad {
    /// Impulse on the tool [N s].
    pub impulse: Vector3<f64>,
    /// Angular impulse about its centre of mass [N m s]; what Rapier's contacts bore is left out.
    pub twist: Vector3<f64>,
    /// Time for which it was in contact [s].
    pub contact_time: f64,
    /// Length of the step [s].
    pub dt: f64,
}

impl ToolLoad {
    /// Adds what a contact did that was carried in `frame`.
    pub(crate) fn take(&mut self, frame: &Isometry3<f64>, advance: &Advance) {
        self.impulse += frame * advance.impulse;
        self.twist += frame * advance.twist;
        self.contact_time = self.contact_time.max(advance.contact_time);
    }

    /// Mean force on the tool over the step [N]; zero before the first.
    pub fn force(&self) -> Vector3<f64> {
        self.mean(&self.impulse)
    }

    /// Mean torque on the tool about its centre of mass over the step [N m]; zero before the first.
    pub fn torque(&self) -> Vector3<f64> {
        self.mean(&self.twist)
    }

    fn mean(&self, sum: &Vector3<f64>) -> Vector3<f64> {
        if self.dt > 0.0 { sum / self.dt } else { Vector3::zeros() }
    }
}

impl Tool {
    fn new(handle: RigidBodyHandle) -> Self {
        let (cuts, load, end) = (Vec::new(), ToolLoad::default(), None);
        Self { handle, cuts, load, near: Vec::new(), end, left: Vec::new() }
    }

    /// True while a contact of it with `surface` is open.
    pub fn touches(&self, surface: SurfaceId) -> bool {
        self.cuts.iter().any(|cut| cut.surface == surface && cut.encounter.is_open())
    }

    pub fn ledger(&self) -> Ledger {
        let mut sum = Ledger::default();
        self.cuts.iter().for_each(|cut| sum += *cut.encounter.ledger());
        sum
    }
}

impl WearWorld {
    /// Makes a kinematic body a tool: it wears whatever wear surface it is led into, by its
    /// velocity or to its next position, and keeps its motion. Other kinematic bodies wear nothing.
    /// It must be clear of a surface to begin with.
    ///
    /// # Errors
    /// There is no such body, or it is not kinematic, or it is driven.
    pub fn add_tool(
        &mut self,
        handle: RigidBodyHandle,
        bodies: &RigidBodySet,
    ) -> Result<(), WearError> {
        let rb = bodies.get(handle).filter(|rb| rb.is_kinematic());
        rb.ok_or(WearError::NotKinematic { body: handle })?;
        if self.driven(handle).is_some() {
            return Err(WearError::LedAlready { body: handle, led: Led::Driven });
        }
        if self.find_tool(handle).is_none() {
            self.tools.push(Tool::new(handle));
        }
        Ok(())
    }

    /// Makes a tool an ordinary body again.
    pub fn remove_tool(&mut self, handle: RigidBodyHandle) {
        if let Some(at) = self.tools.iter().position(|tool| tool.handle == handle) {
            let mut tool = self.tools.remove(at);
            self.end_cuts(&mut tool, |_| true);
        }
    }

    /// What a tool bore in the last step; None for a body that is no tool.
    pub fn tool_load(&self, handle: RigidBodyHandle) -> Option<ToolLoad> {
        self.find_tool(handle).map(|tool| tool.load)
    }

    pub(crate) fn find_tool(&self, handle: RigidBodyHandle) -> Option<&Tool> {
        self.tools.iter().find(|tool| tool.handle == handle)
    }

    /// Finds the surfaces that tools come near in the step; ends the contacts of those that are away,
    /// gone, or elsewhere than they were left.
    pub(crate) fn look_at_tools(&mut self, world: &mut WorldView<'_>) {
        let mut tools = std::mem::take(&mut self.tools);
        tools.retain_mut(|tool| {
            (tool.load, tool.end) = (ToolLoad::default(), None);
            tool.left.clear();
            tool.near.clear();
            self.look_at_tool(tool, world);
            world.bodies.contains(tool.handle)
        });
        self.tools = tools;
    }

    fn look_at_tool(&mut self, tool: &mut Tool, world: &mut WorldView<'_>) {
        let handle = tool.handle;
        let Some(rb) = world.bodies.get_mut(handle).filter(|rb| is_led(rb)) else {
            return self.end_cuts(tool, |_| true);
        };
        let tracked = Tracked::slot(&mut self.bodies, handle);
        // What it was in the middle of as a dynamic body is over.
        tracked.leave(&mut self.surfaces, &mut self.closed, &mut self.events);
        let mut lost = tracked.drop_lost_shadow(rb);
        if tracked.is_stale(rb, world.colliders) {
            rb.recompute_mass_properties_from_colliders(world.colliders);
            tracked.refresh(rb, world.colliders);
            lost = true;
        }
        let state = gate::led(rb, tracked.state(rb), self.current.dt);
        let course = Course::from_state(state, Vector3::zeros(), tracked.radius);
        let surfaces = &self.surfaces;
        let mut near = std::mem::take(&mut tool.near);
        course.near(&self.lies, surfaces, [self.current.sight, 0.0], &mut near);
        near.retain(|id| gate::feels(rb, &surfaces[id.0], world.colliders));
        let leads = near.iter().filter_map(|id| Lie::find(&self.lies, *id)?.lead);
        for (lead, free) in leads.filter_map(|lead| Some((lead, lead.free?))) {
            let rb = world.bodies.get(free.body);
            let radius = rb.map_or(0.0, |rb| derive::radius(rb, world.colliders));
            let reach = free::reach(&lead, radius, &course, self.current.dt);
            let reach = reach.joined(&course.reach(&Isometry3::identity(), self.current.dt));
            let joined = self.current.reach.map_or(reach, |others| others.joined(&reach));
            self.current.reach = Some(joined);
        }
        self.end_cuts(tool, |cut| lost || !near.contains(&cut.surface));
        tool.near = near;
    }

    /// Leads every tool through the surfaces that it is near.
    pub(crate) fn lead_tools(&mut self, world: &WorldView<'_>, observer: &mut dyn WearObserver) {
        let mut tools = std::mem::take(&mut self.tools);
        for tool in &mut tools {
            tool.load.dt = self.current.dt;
            self.lead_tool(tool, world, observer);
        }
        self.tools = tools;
    }

    fn lead_tool(
        &mut self,
        tool: &mut Tool,
        world: &WorldView<'_>,
        observer: &mut dyn WearObserver,
    ) {
        let handle = tool.handle;
        let tracked = Tracked::slot(&mut self.bodies, handle);
        let rb = world.bodies.get(handle).filter(|rb| is_led(rb));
        let (Some(rb), Some(&first)) = (rb, tool.near.first()) else { return };
        let own = |worn: &WornCollider| rb.colliders().contains(&worn.proxy);
        let refusal = match tracked.derive(rb, world.colliders) {
            Err(refusal) => Some(refusal),
            Ok(()) => self.surfaces.iter().any(own).then_some(Refusal::Wears),
        };
        if let Some(refusal) = refusal {
            self.end_cuts(tool, |_| true);
            return self.refuse(handle, first, refusal);
        }
        let state = gate::led(rb, tracked.state(rb), self.current.dt);
        // Taken out, and put back: it holds a shape.
        let known = std::mem::replace(&mut tracked.known, Known::Unseen);
        let Known::Ready(mut body) = known else { return };
        let inertia = std::mem::replace(&mut body.inertia, Inertia::immovable());
        for at in 0..tool.near.len() {
            let surface = tool.near[at];
            if let Err(left) = self.cut(tool, &mut body, surface, &state, world, observer) {
                self.end_cuts(tool, |cut| cut.surface == surface);
                self.leave_cut(tool, surface, left);
            }
        }
        body.inertia = inertia;
        Tracked::slot(&mut self.bodies, handle).known = Known::Ready(body);
    }

    /// After Rapier's step: where the tools are exactly, and what they bore by its contacts.
    pub(crate) fn settle_tools(&mut self, world: &mut WorldView<'_>) {
        for tool in &mut self.tools {
            let Some(rb) = world.bodies.get_mut(tool.handle) else { continue };
            for id in tool.left.drain(..) {
                let worn = &self.surfaces[id.0];
                tool.load.impulse += held::impulse(rb.colliders(), worn, world.narrow_phase);
            }
            let Some((frame, state)) = tool.end.take() else { continue };
            if rb.body_type() == RigidBodyType::KinematicVelocityBased {
                // Rapier turns bodies in straight lines, and rounds.
                let com = Isometry3::from(-scalar::vector(rb.local_center_of_mass()));
                let pose = state.placed_by(&frame).pose() * com;
                rb.set_position(scalar::to_pose(&pose), false);
                steer::carry_colliders(rb, world.colliders);
            }
            let tracked = Tracked::slot(&mut self.bodies, tool.handle);
            tracked.shadow = Some(Shadow::of(rb, frame, state));
        }
    }
}

/// True for a body that may be a tool in this step.
fn is_led(rb: &RigidBody) -> bool {
    rb.is_kinematic() && rb.is_enabled()
}
