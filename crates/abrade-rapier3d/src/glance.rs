//! The first look at every body of a step: by what is cheapest to read, whether it could come
//! near a wear surface at all. Most bodies of a world never get a second one.
//!
//! What a body reaches about its origin is kept from step to step. Rapier flags what an embedder
//! has changed until its next step, so colliders are compared only where a flag is up; when
//! someone else stepped the world, which takes the flags down, every body is looked at closely.

use nalgebra::Vector3;
use rapier::data::HasModifiedFlag;
use rapier::dynamics::{RigidBody, RigidBodyHandle};
use rapier::geometry::{ColliderHandle, ColliderSet};

use crate::extent::Extent;
use crate::gate::Lie;
use crate::pull::pull;
use crate::scalar;
use crate::tracked::Tracked;
use crate::view::WorldView;

/// Share by which a reach is taken for larger than it is.
const MARGIN: f64 = 1e-3;
/// Roundings by which a position may be off.
const ROUNDINGS: f64 = 8.0;

/// What is kept of one body.
#[derive(Clone, Copy)]
struct Glance {
    /// Generation of the handle, and [`BUSY`], [`LATE`]: one number to compare.
    tag: u64,
    /// Radius about the body's origin that holds its colliders [m].
    outline: f64,
    /// How far from its origin a body without velocity could meet something in a step [m].
    reach: f64,
}

/// Must be looked at closely wherever it is: an encounter or a shadow may have to end.
const BUSY: u64 = 1 << 32;
/// The body's flag was up in the last step: what the embedder set may only have come into force in
/// that step.
const LATE: u64 = 1 << 33;
/// A body that nobody has looked at; no tag of another one.
const NEW: Glance = Glance { tag: u64::MAX, outline: 0.0, reach: 0.0 };

/// What is kept of every body, by the index of its handle.
#[derive(Default)]
pub(crate) struct Glances {
    list: Vec<Glance>,
    /// The span that its reaches are for.
    span: Span,
    /// Boxes around the surfaces of the step.
    targets: Vec<Extent>,
    /// The collider whose flag says that nobody else has stepped the world.
    seal: Option<ColliderHandle>,
}

/// What decides, beside velocity and forces, how far bodies get in a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Span {
    /// Length of the step [s].
    pub dt: f64,
    /// Acceleration of gravity [m/s2].
    pub gravity: Vector3<f64>,
    /// Gap over which Rapier makes contacts [m].
    pub contacts: f64,
}

impl Glances {
    /// Raises the flag of `proxy`, after Rapier's step. The flag alone makes Rapier recompute
    /// nothing.
    pub fn seal(&mut self, proxy: Option<ColliderHandle>, colliders: &mut ColliderSet) {
        self.seal = proxy.filter(|&handle| colliders.get_mut(handle).is_some());
    }

    /// The bodies that could come near one of `lies` in a step, or whose encounter may be over,
    /// in the order of their handles.
    pub fn pick(
        &mut self,
        world: &WorldView<'_>,
        tracked: &[Option<Tracked>],
        lies: &[Lie],
        span: Span,
        picked: &mut Vec<RigidBodyHandle>,
    ) {
        picked.clear();
        self.targets.clear();
        self.targets.extend(lies.iter().map(|lie| target(&lie.extent)));
        self.find_changed(world.colliders);
        if self.span != span {
            self.span = span;
            self.list.iter_mut().for_each(|glance| glance.tag |= LATE);
        }
        let near = [span.dt * (1.0 + MARGIN), span.contacts];
        for (handle, rb) in world.bodies.iter() {
            let (index, generation) = handle.into_raw_parts();
            let index = index as usize;
            if self.list.len() <= index {
                self.list.resize(index + 1, NEW);
            }
            let glance = &mut self.list[index];
            let changed = rb.has_modified_flag();
            if glance.tag != u64::from(generation) || changed {
                glance.renew(handle, rb, tracked, &span);
            }
            let is_busy = glance.tag & BUSY != 0;
            if is_busy || self.targets.iter().any(|t| may_reach(rb, glance.reach, near, t)) {
                picked.push(handle);
            }
        }
    }

    /// Forgets the bodies whose colliders an embedder has changed; all of them when flags were
    /// taken down that nobody here has seen.
    fn find_changed(&mut self, colliders: &ColliderSet) {
        let sealed = self.seal.take().and_then(|handle| colliders.get(handle));
        if !sealed.is_some_and(HasModifiedFlag::has_modified_flag) {
            self.list.clear();
            return;
        }
        for (_, collider) in colliders.iter().filter(|(_, collider)| collider.has_modified_flag()) {
            if let Some(body) = collider.parent() {
                self.forget(body);
            }
        }
    }

    /// Makes sure that `body` is looked at closely in the next step.
    pub fn forget(&mut self, body: RigidBodyHandle) {
        if let Some(glance) = self.list.get_mut(body.into_raw_parts().0 as usize) {
            *glance = NEW;
        }
    }

    /// Keeps what a close look has found.
    pub fn keep(&mut self, body: RigidBodyHandle, rb: &RigidBody, tracked: &Tracked) {
        let Some(glance) = self.list.get_mut(body.into_raw_parts().0 as usize) else { return };
        let busy = tracked.live.is_some() || tracked.shadow.is_some() || !tracked.near.is_empty();
        glance.tag = if busy { glance.tag | BUSY } else { glance.tag & !BUSY };
        glance.outline = tracked.radius + arm(rb);
        glance.read(rb, Some(tracked), &self.span);
    }
}

impl Glance {
    /// Makes the glance one of the body that now has its index.
    fn renew(
        &mut self,
        handle: RigidBodyHandle,
        rb: &RigidBody,
        tracked: &[Option<Tracked>],
        span: &Span,
    ) {
        let (generation, changed) = (handle.into_raw_parts().1, rb.has_modified_flag());
        if self.tag & !(BUSY | LATE) != u64::from(generation) {
            *self = Self { tag: u64::from(generation) | BUSY, ..NEW };
        }
        if changed || self.tag & LATE != 0 {
            self.read(rb, Tracked::find(tracked, handle), span);
        }
        self.tag = if changed { self.tag | LATE } else { self.tag & !LATE };
    }

    /// Reads what an embedder may have changed on the body itself.
    fn read(&mut self, rb: &RigidBody, tracked: Option<&Tracked>, span: &Span) {
        let bend = 0.5 * span.dt * span.dt * pull(rb, tracked, &span.gravity).norm();
        // A course is one of the centre of mass, about which the outline reaches farther.
        self.reach = (1.0 + MARGIN) * (self.outline + 2.0 * arm(rb) + bend);
    }
}

fn arm(rb: &RigidBody) -> f64 {
    scalar::vector(rb.local_center_of_mass()).norm()
}

/// The box `extent`, as roundings of positions next to it may move it.
fn target(extent: &Extent) -> Extent {
    let size = extent.low.coords.amax().max(extent.high.coords.amax());
    extent.grown(ROUNDINGS * scalar::ROUNDING * size)
}

/// Could a body that reaches as far as `reach` [m] come to `target` in `time` [s], or is it as close
/// as `contacts` [m]? As the box around its course, but never smaller, and without its rotation.
#[inline]
fn may_reach(rb: &RigidBody, reach: f64, [time, contacts]: [f64; 2], target: &Extent) -> bool {
    let (at, velocity) = (rb.translation(), rb.linvel());
    let close = |at, velocity, axis: usize| {
        let way = (scalar::wide(velocity).abs() * time).max(contacts);
        let (at, reach) = (scalar::wide(at), reach + way);
        target.low[axis] - at <= reach && at - target.high[axis] <= reach
    };
    close(at.z, velocity.z, 2) && close(at.x, velocity.x, 0) && close(at.y, velocity.y, 1)
}
