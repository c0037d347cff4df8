//! What an embedder saves: Rapier's world, and the wear beside it.

use crate::plugin::rapier::prelude::*;
use crate::plugin::{WearEvent, WearWorld, scalar};

#[derive(serde::Serialize, serde::Deserialize)]
pub struct Save {
    pub world: PhysicsWorld,
    pub wear: WearWorld,
}

impl Save {
    pub fn read(bytes: &[u8]) -> Self {
        postcard::from_bytes(bytes).expect("a save")
    }

    pub fn bytes(&self) -> Vec<u8> {
        postcard::to_stdvec(self).expect("bytes")
    }

    /// Takes so many steps; returns what happened in them.
    pub fn run(&mut self, steps: usize) -> Vec<WearEvent> {
        let step = |_| {
            self.wear.step(&mut self.world, &(), &()).expect("a step inside the model");
            self.wear.events().to_vec()
        };
        (0..steps).flat_map(step).collect()
    }

    /// Takes so many steps and tells every bit that comes of them: the shortest text of a number
    /// is its own.
    pub fn outcome(&mut self, steps: usize) -> String {
        let mut text = format!("{:?}\n", self.run(steps));
        for (_, surface) in self.wear.surfaces() {
            text += &format!("{:?}\n{:?}\n", surface.worn(), surface.nodes());
        }
        for (handle, rb) in self.world.bodies.iter() {
            let exact = self.wear.state(handle, &self.world.bodies);
            let driven = self.wear.driven_state(handle, &self.world.colliders);
            let load = self.wear.tool_load(handle);
            text +=
                &format!("{exact:?} {driven:?} {load:?} {:?}\n", rb.mass_properties().local_mprops);
            text += &format!("{:?} {:?} {:?}\n", rb.position(), rb.linvel(), rb.angvel());
        }
        // Everything is looked at closely again after a save was read.
        let counters = crate::plugin::Counters { looked: 0, ..*self.wear.counters() };
        text + &format!("{counters:?}\n{:?}\n", self.wear.ledger())
    }

    /// True when no body is where no number says.
    pub fn is_finite(&self) -> bool {
        let finite = |v| scalar::vector(v).iter().all(|x| x.is_finite());
        self.world.bodies.iter().all(|(handle, rb)| {
            let exact = self.wear.state(handle, &self.world.bodies);
            let rapiers = [rb.translation(), rb.linvel(), rb.angvel()].into_iter().all(finite);
            rapiers && exact.is_some_and(|state| state.is_finite())
        })
    }
}
