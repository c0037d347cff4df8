//! Bodies that hang together by their contacts in a step: a blow that one of them gets is handed on to
//! the others. What it loses is theirs, and no more than that wears them.

use std::collections::BTreeMap;

use crate::collision::blow::Blow;

type Key = (u32, u32);

/// Energies of a cluster [J]: what the blows of its contacts took in the step, and what their blows, each on its
/// own, would have had.
#[derive(Clone, Copy, Default)]
struct Sums {
    taken: f64,
    blows: f64,
}

/// The clusters of a step.
#[derive(Default)]
pub(crate) struct Clusters {
    above: BTreeMap<Key, Key>,
    sums: BTreeMap<Key, Sums>,
}

impl Clusters {
    /// The clusters that the contacts of a step make, each with the part of its impulse that is a
    /// blow [N s].
    /// An approach that is no faster than `rest` [m/s] takes nothing.
    pub fn of<'a>(contacts: impl Iterator<Item = (&'a Blow, f64)> + Clone, rest: f64) -> Self {
        let mut clusters = Self::default();
        for (blow, _) in contacts.clone() {
            if let [Some(a), Some(b)] = blow.bodies.map(|body| body.map(|h| h.into_raw_parts())) {
                let [a, b] = [clusters.root(a), clusters.root(b)];
                clusters.above.insert(a.max(b), a.min(b));
            }
        }
        for (blow, part) in contacts {
            let Some(root) = clusters.of_blow(blow) else { continue };
            let sums = clusters.sums.entry(root).or_default();
            sums.taken += if blow.approach > rest { blow.taken(part) } else { 0.0 };
            sums.blows += blow.energy_of(part);
        }
        clusters
    }

    /// What a contact gets of the energy that those of its cluster took, by the `part` of its impulse
    /// that is a blow [J].
    pub fn share(&self, blow: &Blow, part: f64) -> f64 {
        let sums = self.of_blow(blow).and_then(|root| self.sums.get(&root));
        let Sums { taken, blows } = sums.copied().unwrap_or_default();
        if blows > 0.0 { taken.max(0.0) * blow.energy_of(part) / blows } else { 0.0 }
    }

    fn of_blow(&self, blow: &Blow) -> Option<Key> {
        let body = blow.bodies.into_iter().flatten().next()?;
        Some(self.root(body.into_raw_parts()))
    }

    fn root(&self, of: Key) -> Key {
        let mut root = of;
        while let Some(above) = self.above.get(&root).filter(|above| **above != root) {
            root = *above;
        }
        root
    }
}
