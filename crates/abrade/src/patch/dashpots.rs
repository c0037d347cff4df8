//! The springs of a patch as their dashpots need them.

use super::Patch;
use crate::damping::{Dashpots, Shear, Sprung};
use crate::elastic::{Elastic, Foundation, HertzNodes};
use crate::laws::ElasticLaw;
use crate::material::Material;
use crate::node_law::{STEEP, Spring};
use crate::query::{BodyQuery, Query, Touch};
use crate::surface::SurfaceLaws;

impl Patch {
    /// Hands over every spring that the last trial pressed or let go.
    pub(crate) fn press(&self, laws: &SurfaceLaws, dashpots: &mut Dashpots) {
        let material = &laws.material;
        let poisson = material.poisson;
        let foundation = Foundation::new(poisson);
        let hertz = HertzNodes::new(poisson);
        match (&laws.elastic, &self.query) {
            (ElasticLaw::HertzNodes { .. }, BodyQuery::Ball(query)) => {
                self.press_with(hertz, query, material, dashpots);
            }
            (ElasticLaw::HertzNodes { .. }, BodyQuery::Clump(query)) => {
                self.press_with(hertz, query, material, dashpots);
            }
            (_, BodyQuery::Ball(query)) => self.press_with(foundation, query, material, dashpots),
            (_, BodyQuery::Clump(query)) => self.press_with(foundation, query, material, dashpots),
            // Two surfaces that meet have no dashpots.
            (_, BodyQuery::Mesh(_)) => {}
        }
    }

    fn press_with<E: Elastic, Q: Query>(
        &self,
        elastic: E,
        query: &Q,
        &Material { hardness, friction, .. }: &Material,
        dashpots: &mut Dashpots,
    ) {
        for (slot, (old, new)) in self.candidates.slots.iter().zip(self.old.iter().zip(&self.new)) {
            let overlaps = [old.overlap, new.overlap];
            if overlaps == [0.0; 2] {
                continue;
            }
            let x = slot.x - slot.n * new.drop.total();
            let touch = query.touch(&x, &slot.n);
            let cosine = -touch.contact_normal.dot(&slot.n);
            let [before, after] =
                overlaps.map(|d| elastic.normal_force(touch.coefficient, d, slot.area));
            let stored = overlaps.map(|d| elastic.normal_energy(touch.coefficient, d, slot.area));
            dashpots.add(Sprung {
                normal: touch.contact_normal,
                arm: touch.arm,
                cosine,
                // A contact of a part of the step has the force that does the spring's work.
                force: match overlaps {
                    [0.0, overlap] => stored[1] / overlap,
                    [overlap, 0.0] => stored[0] / overlap,
                    _ => 0.5 * (before + after),
                },
                advance: new.overlap - old.overlap + new.drop.archard * cosine,
                cap: slot.area * hardness * slot.factor / cosine.max(STEEP),
                stored,
                stiffness: elastic.normal_stiffness(touch.coefficient, new.overlap, slot.area),
                shear: shear(elastic, &touch, slot.area, [old, new], friction),
            });
        }
    }
}

/// Share of friction's limit above which a tangential spring slips, to round-off.
const SLIPS: f64 = 1.0 - 1e-9;

/// The tangential spring of a node over a step. One that was touched, let go or slips has no
/// dashpot: its change is not that of the body's way.
fn shear<E: Elastic>(
    elastic: E,
    touch: &Touch,
    area: f64,
    [old, new]: [&Spring; 2],
    friction: f64,
) -> Shear {
    let limit = friction * elastic.normal_force(touch.coefficient, new.overlap, area);
    if old.overlap == 0.0 || new.overlap == 0.0 || new.tangential_force >= SLIPS * limit {
        return Shear::default();
    }
    let overlap = 0.5 * (old.overlap + new.overlap);
    let stiffness = elastic.tangential_stiffness(touch.coefficient, overlap, area);
    Shear {
        force: (old.stretch + new.stretch) * (0.5 * stiffness),
        limit,
        stiffness,
        advance: new.stretch - old.stretch,
    }
}
