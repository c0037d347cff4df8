//! The hooks of the private world: wear pairs are ours, unless the body rests on them.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use rapier::dynamics::RigidBodyHandle;
use rapier::geometry::{ColliderHandle, SolverFlags};
use rapier::pipeline::{ContactModificationContext, PairFilterContext, PhysicsHooks};

/// Which pairs are taken from Rapier.
pub(crate) struct Filter {
    pub proxies: Vec<ColliderHandle>,
    /// Bodies that wear, and whether they rest on contacts of Rapier's.
    pub wearers: Vec<(RigidBodyHandle, bool)>,
    /// Per pair of colliders, the distance at which a resting body came to rest.
    settled: Mutex<BTreeMap<[(u32, u32); 2], f64>>,
}

impl Filter {
    pub fn new(proxies: Vec<ColliderHandle>) -> Self {
        Self { proxies, wearers: Vec::new(), settled: Mutex::default() }
    }

    fn is_proxy(&self, collider: ColliderHandle) -> bool {
        self.proxies.contains(&collider)
    }

    /// Whether `body` rests, if it wears.
    fn rests(&self, body: Option<RigidBodyHandle>) -> Option<bool> {
        self.wearers.iter().find(|(handle, _)| Some(*handle) == body).map(|(_, rests)| *rests)
    }

    /// Forgets where bodies came to rest.
    pub fn forget(&self) {
        self.settled.lock().unwrap_or_else(PoisonError::into_inner).clear();
    }
}

impl PhysicsHooks for Filter {
    fn filter_contact_pair(&self, context: &PairFilterContext) -> Option<SolverFlags> {
        let rests = match (self.is_proxy(context.collider1), self.is_proxy(context.collider2)) {
            (true, false) => self.rests(context.rigid_body2),
            (false, true) => self.rests(context.rigid_body1),
            _ => None,
        };
        (rests != Some(false)).then_some(SolverFlags::default())
    }

    /// A body that rests does so where it is, whatever the proxy's undeformed shape says.
    fn modify_solver_contacts(&self, context: &mut ContactModificationContext) {
        let pair = [context.collider1, context.collider2].map(ColliderHandle::into_raw_parts);
        let Some(manifold) = context.rigid_mut() else { return };
        let lowest = manifold.solver_contacts.iter().map(|c| c.dist).fold(f64::INFINITY, f64::min);
        let mut settled = self.settled.lock().unwrap_or_else(PoisonError::into_inner);
        let rest = *settled.entry(pair).or_insert(lowest.min(0.0));
        for contact in manifold.solver_contacts.iter_mut() {
            contact.dist -= rest;
        }
    }
}
