//! The hooks of the private world: wear pairs are ours, unless the body rests on them.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use rapier::dynamics::RigidBodyHandle;
use rapier::geometry::{ColliderHandle, SolverFlags};
use rapier::pipeline::{ContactModificationContext, PairFilterContext, PhysicsHooks};

/// Two colliders and their parts.
type Pair = [(u32, u32, u32); 2];

/// Which pairs are taken from Rapier.
pub(crate) struct Filter {
    pub proxies: Vec<Proxy>,
    /// Bodies that wear.
    pub wearers: Vec<Wearing>,
    /// The distances at which resting bodies came to rest.
    settled: Mutex<BTreeMap<Pair, f64>>,
}

/// What a surface of the island stands on.
#[derive(Clone, Copy, Debug)]
pub struct Proxy {
    /// The collider.
    pub collider: ColliderHandle,
    /// Friction of what rests on the surface [-].
    pub friction: f64,
}

/// A body that wears surfaces.
pub(crate) struct Wearing {
    pub body: RigidBodyHandle,
    /// It rests on contacts of Rapier's.
    pub rests: bool,
    /// The surfaces, by their places in the island.
    pub uses: Vec<usize>,
}

impl Filter {
    pub fn new(proxies: Vec<Proxy>) -> Self {
        Self { proxies, wearers: Vec::new(), settled: Mutex::default() }
    }

    /// The place of the surface that `collider` is the proxy of.
    fn place(&self, collider: ColliderHandle) -> Option<usize> {
        self.proxies.iter().position(|proxy| proxy.collider == collider)
    }

    /// Whether `body` rests on the surface at `place`, if it wears it.
    fn rests(&self, body: Option<RigidBodyHandle>, place: usize) -> Option<bool> {
        let wearing = self.wearers.iter().find(|wearing| Some(wearing.body) == body)?;
        wearing.uses.contains(&place).then_some(wearing.rests)
    }

    /// Whether one of a pair rests on the other, the proxy of a surface that it wears; None for any
    /// other pair.
    pub fn rests_on_wear(
        &self,
        colliders: [ColliderHandle; 2],
        bodies: [Option<RigidBodyHandle>; 2],
    ) -> Option<bool> {
        match colliders.map(|collider| self.place(collider)) {
            [Some(place), None] => self.rests(bodies[1], place),
            [None, Some(place)] => self.rests(bodies[0], place),
            _ => None,
        }
    }

    /// Forgets where bodies came to rest.
    pub fn forget(&self) {
        self.settled.lock().unwrap_or_else(PoisonError::into_inner).clear();
    }
}

impl PhysicsHooks for Filter {
    fn filter_contact_pair(&self, context: &PairFilterContext) -> Option<SolverFlags> {
        let pair = [context.collider1, context.collider2];
        let rests = self.rests_on_wear(pair, [context.rigid_body1, context.rigid_body2]);
        (rests != Some(false)).then_some(SolverFlags::default())
    }

    /// A body that rests does so where it is, whatever the proxy's undeformed shape says, with the
    /// friction of the surface.
    fn modify_solver_contacts(&self, context: &mut ContactModificationContext) {
        let pair = [context.collider1, context.collider2];
        let rests = self.rests_on_wear(pair, [context.rigid_body1, context.rigid_body2]);
        let Some(manifold) = context.rigid_mut().filter(|_| rests == Some(true)) else { return };
        let place = pair.into_iter().find_map(|collider| self.place(collider));
        if let Some(place) = place {
            *manifold.friction = self.proxies[place].friction;
        }
        let lowest = manifold.solver_contacts.iter().map(|c| c.dist).fold(f64::INFINITY, f64::min);
        let parts = [manifold.manifold.subshape1, manifold.manifold.subshape2];
        let part = |at: usize| {
            let (index, generation) = pair[at].into_raw_parts();
            (index, generation, parts[at])
        };
        let mut settled = self.settled.lock().unwrap_or_else(PoisonError::into_inner);
        let rest = *settled.entry([part(0), part(1)]).or_insert(lowest.min(0.0));
        for contact in manifold.solver_contacts.iter_mut() {
            contact.dist -= rest;
        }
    }
}
