//! Our hooks for one step: pairs that wear has resolved are taken from Rapier, everything else
//! goes to the embedder's hooks.

use rapier::dynamics::{RigidBodyHandle, RigidBodySet};
use rapier::geometry::{ColliderHandle, ColliderSet, SolverFlags};
use rapier::pipeline::{ActiveHooks, ContactModificationContext, PairFilterContext, PhysicsHooks};

use crate::lay::lay;
use crate::surface::WornCollider;

/// How a surface meets a body that Rapier keeps in hand.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bearing {
    /// Least friction of the contact [-]: more than the material's where the body ploughs.
    pub friction: f64,
    /// It lies on the surface, or in what it has worn: a clamp of its path to the undeformed
    /// proxy would hold it fast.
    pub lies: bool,
}

/// Which pairs are taken; fixed over a step.
#[derive(Default)]
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Taken {
    /// Bodies resolved in this step, sorted.
    #[cfg_attr(feature = "serde-serialize", serde(skip))]
    bodies: Vec<(u32, u32)>,
    /// Bodies that Rapier keeps in hand, sorted.
    #[cfg_attr(feature = "serde-serialize", serde(skip))]
    held: Vec<((u32, u32), Bearing)>,
    /// Bodies with the walls, and colliders of tools, that they were carried against.
    #[cfg_attr(feature = "serde-serialize", serde(skip))]
    walls: Vec<(RigidBodyHandle, ColliderHandle)>,
    /// Proxies with the hooks that the embedder had set on them, sorted by handle.
    proxies: Vec<(ColliderHandle, ActiveHooks)>,
}

impl Taken {
    pub fn clear(&mut self) {
        self.bodies.clear();
        self.held.clear();
        self.walls.clear();
    }

    /// Takes the pair of a wearing body and a wall or a part of a tool.
    pub fn add_wall(&mut self, body: RigidBodyHandle, wall: ColliderHandle) {
        self.walls.push((body, wall));
    }

    fn has_wall(&self, body: Option<RigidBodyHandle>, wall: ColliderHandle) -> bool {
        self.walls.iter().any(|(own, other)| Some(*own) == body && *other == wall)
    }

    pub fn add_held(&mut self, body: RigidBodyHandle, grip: Bearing) {
        let key = body.into_raw_parts();
        if let Err(at) = self.held.binary_search_by_key(&key, |(held, _)| *held) {
            self.held.insert(at, (key, grip));
        }
    }

    fn grip(&self, body: Option<RigidBodyHandle>) -> Option<Bearing> {
        let key = body?.into_raw_parts();
        let at = self.held.binary_search_by_key(&key, |(held, _)| *held).ok()?;
        Some(self.held[at].1)
    }

    pub fn add_proxy(&mut self, proxy: ColliderHandle, user_hooks: ActiveHooks) {
        self.proxies.push((proxy, user_hooks));
        self.proxies.sort_unstable_by_key(|(handle, _)| handle.into_raw_parts());
    }

    pub fn add_body(&mut self, body: RigidBodyHandle) {
        let key = body.into_raw_parts();
        if let Err(at) = self.bodies.binary_search(&key) {
            self.bodies.insert(at, key);
        }
    }

    pub fn has_body(&self, body: Option<RigidBodyHandle>) -> bool {
        body.is_some_and(|body| self.bodies.binary_search(&body.into_raw_parts()).is_ok())
    }

    fn user_hooks(&self, proxy: ColliderHandle) -> Option<ActiveHooks> {
        let key = proxy.into_raw_parts();
        let at = self.proxies.binary_search_by_key(&key, |(handle, _)| handle.into_raw_parts());
        at.ok().map(|at| self.proxies[at].1)
    }
}

/// Hooks to pass to Rapier's step, between `begin_step` and `end_step`.
pub struct WearGuard<'a> {
    pub(crate) taken: &'a Taken,
    pub(crate) surfaces: &'a [WornCollider],
    pub(crate) user: &'a dyn PhysicsHooks,
    pub(crate) dt: f64,
}

impl WearGuard<'_> {
    /// Time that Rapier is to step by [s]: the embedder's, or less when a body's first exit ends
    /// the step.
    pub fn dt(&self) -> f64 {
        self.dt
    }

    /// True when the embedder asked for `hook` on this pair. Proxies carry flags for us, which
    /// must not make the embedder's hooks see pairs they did not ask for.
    fn user_asked(
        &self,
        hook: ActiveHooks,
        colliders: &ColliderSet,
        pair: [ColliderHandle; 2],
    ) -> bool {
        pair.into_iter().any(|handle| {
            let own = colliders.get(handle).map(|collider| collider.active_hooks());
            let flags = self.taken.user_hooks(handle).or(own);
            flags.is_some_and(|flags| flags.contains(hook))
        })
    }

    fn surface_on(&self, proxy: ColliderHandle) -> Option<&WornCollider> {
        self.surfaces.iter().find(|worn| worn.proxy == proxy)
    }
}

/// True between Rapier's solver and the end of its step, when it asks for the clamp of fast bodies;
/// it asks for contacts before.
fn is_on_its_way(bodies: &RigidBodySet, body: Option<RigidBodyHandle>) -> bool {
    let body = body.and_then(|handle| bodies.get(handle));
    body.is_some_and(|rb| rb.next_position() != rb.position())
}

impl PhysicsHooks for WearGuard<'_> {
    fn filter_contact_pair(&self, context: &PairFilterContext) -> Option<SolverFlags> {
        let proxy1 = self.taken.user_hooks(context.collider1).is_some();
        let proxy2 = self.taken.user_hooks(context.collider2).is_some();
        let taken = proxy1 && self.taken.has_body(context.rigid_body2)
            || proxy2 && self.taken.has_body(context.rigid_body1)
            || self.taken.has_wall(context.rigid_body1, context.collider2)
            || self.taken.has_wall(context.rigid_body2, context.collider1);
        let pair = [context.collider1, context.collider2];
        let asked = self.user_asked(ActiveHooks::FILTER_CONTACT_PAIRS, context.colliders, pair);
        let lies = |body| self.taken.grip(body).is_some_and(|grip: Bearing| grip.lies);
        let clamped =
            |proxy: bool, body| proxy && lies(body) && is_on_its_way(context.bodies, body);
        let clamped = clamped(proxy1, context.rigid_body2) || clamped(proxy2, context.rigid_body1);
        match (taken || clamped, asked) {
            (true, _) => None,
            (false, true) => self.user.filter_contact_pair(context),
            (false, false) => Some(SolverFlags::default()),
        }
    }

    fn filter_intersection_pair(&self, context: &PairFilterContext) -> bool {
        self.user.filter_intersection_pair(context)
    }

    fn modify_solver_contacts(&self, context: &mut ContactModificationContext) {
        let pair = [context.collider1, context.collider2];
        for ([own, other], body) in
            [(pair, context.rigid_body2), ([pair[1], pair[0]], context.rigid_body1)]
        {
            if let Some(grip) = self.taken.grip(body)
                && let Some(worn) = self.surface_on(own)
            {
                lay(context, worn, other, grip.friction);
            }
        }
        if self.user_asked(ActiveHooks::MODIFY_SOLVER_CONTACTS, context.colliders, pair) {
            self.user.modify_solver_contacts(context);
        }
    }
}

#[cfg(feature = "serde-serialize")]
impl Taken {
    /// True when its proxies are those of the surfaces, each once.
    pub fn is_of(&self, surfaces: &[WornCollider]) -> bool {
        let sorted =
            self.proxies.is_sorted_by(|(a, _), (b, _)| a.into_raw_parts() < b.into_raw_parts());
        let mut proxies = surfaces.iter().map(|worn| worn.proxy);
        let known = proxies.all(|proxy| self.user_hooks(proxy).is_some());
        let distinct = |(at, worn): (usize, &WornCollider)| {
            surfaces[..at].iter().all(|before| before.proxy != worn.proxy)
        };
        sorted
            && known
            && self.proxies.len() == surfaces.len()
            && surfaces.iter().enumerate().all(distinct)
    }
}
