//! The candidates of a patch as benches see them.

use super::Patch;
use crate::probe::Candidate;
use crate::query::BodyQuery;

impl Patch {
    /// Depth by which every candidate sank in the last trial [m].
    pub(crate) fn drops(&self) -> impl Iterator<Item = f64> + '_ {
        self.new.iter().map(|spring| spring.drop.total())
    }

    pub(crate) fn coefficient(&self) -> f64 {
        match &self.query {
            BodyQuery::Ball(ball) => ball.coefficient(),
            _ => f64::NAN,
        }
    }

    pub(crate) fn recorded(&self) -> Vec<Candidate> {
        let pairs = self.candidates.slots.iter().zip(&self.old);
        let of = pairs.map(|(slot, old)| Candidate {
            x: slot.x,
            n: slot.n,
            area: slot.area,
            factor: slot.factor,
            stretch: old.stretch,
            overlap: old.overlap,
            excess: [old.excess.normal, old.excess.lateral],
            mark: 0.0,
            voids: Default::default(),
            count: 0,
        });
        of.collect()
    }
}
