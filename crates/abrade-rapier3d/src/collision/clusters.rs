//! Bodies that hang together by their contacts in a step: a blow that one of them gets is handed on to
//! the others, and to nobody else.

use std::collections::BTreeMap;

use crate::collision::blow::Blow;

type Key = (u32, u32);

/// The fastest direct approach in every cluster.
#[derive(Default)]
pub(crate) struct Clusters {
    above: BTreeMap<Key, Key>,
    speeds: BTreeMap<Key, f64>,
}

impl Clusters {
    /// The clusters that the contacts of a step make.
    pub fn of<'a>(blows: impl Iterator<Item = &'a Blow> + Clone) -> Self {
        let mut clusters = Self::default();
        for blow in blows.clone() {
            if let [Some(a), Some(b)] = blow.bodies.map(|body| body.map(|h| h.into_raw_parts())) {
                let [a, b] = [clusters.root(a), clusters.root(b)];
                clusters.above.insert(a.max(b), a.min(b));
            }
        }
        for blow in blows {
            if let Some(root) = clusters.of_blow(blow) {
                let speed = clusters.speeds.entry(root).or_default();
                *speed = speed.max(blow.approach);
            }
        }
        clusters
    }

    /// The fastest approach among the bodies that hang together with those of a contact [m/s].
    pub fn speed(&self, blow: &Blow) -> f64 {
        let root = self.of_blow(blow);
        root.and_then(|root| self.speeds.get(&root)).copied().unwrap_or_default()
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
