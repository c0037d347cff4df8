//! One body against one surface by the return mapping: the springs of the touching nodes, a trial
//! of a step, and its commitment.

mod dashpots;
#[cfg(feature = "bench")]
mod recorded;
mod round;
mod two;

use nalgebra::Vector3;

use crate::body::State;
use crate::candidates::{Candidates, Slot};
use crate::damping::damping_ratio;
use crate::elastic::{Elastic, Foundation, HertzNodes, coefficient};
use crate::flight::time_to_close;
use crate::ground::{Closed, Flat};
use crate::inner_loop::Reaction;
use crate::laws::ElasticLaw;
use crate::ledger::Ledger;
use crate::node_law::{Drop, Motion, Spring, stored};
use crate::query::{BodyQuery, Contactor, Query, Touch};
use crate::shape::Shape;
#[cfg(feature = "state")]
use crate::state::{Fault, not_negative, positive, require};
use crate::surface::{Surface, SurfaceLaws};
use round::Round;

/// Springs between one body and one surface.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "state", serde(remote = "Self"))]
pub(crate) struct Patch {
    query: BodyQuery,
    inflation: f64,
    yield_overlap: f64,
    keeps_ledger: bool,
    /// The surface is that of a solid.
    is_closed: bool,
    /// zeta of the dashpots; zero without them.
    damping_ratio: f64,
    /// The share of its area that a node stands for, and the part of its drops that it takes itself:
    /// the rest is that of the facet that it leans on.
    share: f64,
    own: f64,
    pub(crate) candidates: Candidates,
    /// Springs at the start of the step and at its trial end, one per candidate.
    old: Vec<Spring>,
    #[cfg_attr(feature = "state", serde(skip))]
    new: Vec<Spring>,
    #[cfg_attr(feature = "state", serde(skip))]
    carried: Vec<(u32, Spring, f64)>,
    /// Energy of springs under nodes that were used up, to be booked with the next step [J].
    #[cfg_attr(feature = "state", serde(skip))]
    lost: f64,
    /// Of the last trial: what the nodes did to the body, how it moved, and the energies if they are
    /// kept.
    #[cfg_attr(feature = "state", serde(skip))]
    reaction: Reaction,
    #[cfg_attr(feature = "state", serde(skip))]
    motion: Motion,
    #[cfg_attr(feature = "state", serde(skip))]
    ledger: Ledger,
}

impl Patch {
    pub(crate) fn new(shape: &Shape, surface: &Surface, keeps_ledger: bool) -> Self {
        let contactors: Vec<_> = shape
            .pieces()
            .iter()
            .map(|piece| Contactor {
                piece: piece.clone(),
                coefficient: coefficient(surface, piece),
            })
            .collect();
        let inflation = inflation(&surface.laws.elastic);
        let yield_overlap = yield_overlap(contactors.iter().map(|c| c.coefficient), surface);
        let query = BodyQuery::new(&contactors, inflation);
        Self::with_query(query, inflation, yield_overlap, surface, keeps_ledger)
    }

    fn with_query(
        query: BodyQuery,
        inflation: f64,
        yield_overlap: f64,
        surface: &Surface,
        keeps_ledger: bool,
    ) -> Self {
        Self {
            query,
            inflation,
            yield_overlap,
            keeps_ledger,
            is_closed: !surface.is_flat(),
            damping_ratio: damping_ratio(surface.laws.restitution),
            share: 1.0,
            own: 1.0,
            candidates: Candidates::default(),
            old: Vec::new(),
            new: Vec::new(),
            carried: Vec::new(),
            lost: 0.0,
            reaction: Reaction::default(),
            motion: Motion::default(),
            ledger: Ledger::default(),
        }
    }

    /// r_s for `HertzNodes`, zero otherwise [m].
    pub(crate) fn inflation(&self) -> f64 {
        self.inflation
    }

    /// Smallest overlap at which a node yields [m].
    pub(crate) fn yield_overlap(&self) -> f64 {
        self.yield_overlap
    }

    pub(crate) fn damping_ratio(&self) -> f64 {
        self.damping_ratio
    }

    /// Makes sure that the candidates cover the body at `state`; `margin` [m] is the reach of a
    /// new list.
    pub(crate) fn cover(&mut self, surface: &Surface, shape: &Shape, state: &State, margin: f64) {
        if self.candidates.slack(shape, state) >= 0.0 {
            return;
        }
        let inflation = self.inflation;
        self.collect(&surface.laws, |candidates| {
            candidates.collect(surface, shape, state, inflation, margin);
        });
    }

    /// New candidates, in which the springs of those that stay are kept.
    fn collect(&mut self, laws: &SurfaceLaws, list: impl FnOnce(&mut Candidates)) {
        let mut carried = std::mem::take(&mut self.carried);
        carried.clear();
        let pressed = self.candidates.slots.iter().zip(&self.old).filter(|(_, s)| s.overlap > 0.0);
        carried.extend(pressed.map(|(slot, s)| (slot.id, *s, self.stored(laws, slot, s))));
        list(&mut self.candidates);
        let count = self.candidates.slots.len();
        for springs in [&mut self.old, &mut self.new] {
            springs.clear();
            springs.resize(count, Spring::default());
        }
        let mut from = carried.iter().peekable();
        for (slot, spring) in self.candidates.slots.iter().zip(&mut self.old) {
            while let Some((.., energy)) = from.next_if(|(id, ..)| *id < slot.id) {
                self.lost += energy;
            }
            if let Some((_, kept, _)) = from.next_if(|(id, ..)| *id == slot.id) {
                *spring = *kept;
            }
        }
        self.lost += from.map(|(.., energy)| energy).sum::<f64>();
        self.carried = carried;
    }

    /// Energy of the spring under a candidate [J]; zero where no ledger is kept.
    fn stored(&self, laws: &SurfaceLaws, slot: &Slot, spring: &Spring) -> f64 {
        if !self.keeps_ledger {
            return 0.0;
        }
        let touch = self.touch(slot);
        let (poisson, coefficient) = (laws.material.poisson, touch.coefficient);
        let area = slot.area * self.share;
        match laws.elastic {
            ElasticLaw::HertzNodes { .. } => {
                stored(HertzNodes::new(poisson), coefficient, spring, area)
            }
            _ => stored(Foundation::new(poisson), coefficient, spring, area),
        }
    }

    /// How far the body may move before [`Patch::cover`] collects anew [m].
    pub(crate) fn slack(&self, shape: &Shape, state: &State) -> f64 {
        self.candidates.slack(shape, state)
    }

    /// Shortest time [s] in which a candidate can be touched by the body of `state`, whose points
    /// are no faster than `speed` [m/s] and which nothing accelerates by more than `acceleration`
    /// [m/s2].
    pub(crate) fn time_to_touch(&mut self, state: &State, speed: f64, acceleration: f64) -> f64 {
        self.query.place(state);
        match &self.query {
            // Newton's estimate from the gap and its rate: early, never late, because the
            // distance from a node to a ball in straight motion is convex in time.
            BodyQuery::Ball(query) => {
                self.earliest(query, acceleration, |m| m.dot(&state.velocity))
            }
            BodyQuery::Clump(query) => self.earliest(query, acceleration, |_| speed),
            BodyQuery::Mesh(query) => self.earliest(query.as_ref(), acceleration, |_| speed),
        }
    }

    fn earliest(
        &self,
        query: &impl Query,
        acceleration: f64,
        approach: impl Fn(&Vector3<f64>) -> f64,
    ) -> f64 {
        let times = self.candidates.slots.iter().map(|slot| {
            let touch = query.touch(&slot.x, &slot.n);
            time_to_close(-touch.overlap, approach(&touch.contact_normal), acceleration)
        });
        times.fold(f64::INFINITY, f64::min)
    }

    /// Largest overlap of a node with the body at `state` [m].
    pub(crate) fn deepest(&mut self, state: &State) -> f64 {
        self.query.place(state);
        match &self.query {
            BodyQuery::Ball(query) => self.largest_overlap(query),
            BodyQuery::Clump(query) => self.largest_overlap(query),
            BodyQuery::Mesh(query) => self.largest_overlap(query.as_ref()),
        }
    }

    fn largest_overlap(&self, query: &impl Query) -> f64 {
        let overlaps = self.candidates.slots.iter().map(|s| query.touch(&s.x, &s.n).overlap);
        overlaps.fold(0.0, f64::max)
    }

    /// Takes every candidate through a step that ends at `end`; commits nothing.
    pub(crate) fn trial(&mut self, laws: &SurfaceLaws, end: &State, motion: &Motion) -> &Reaction {
        self.query.place(end);
        let Self { share, yield_overlap, candidates, old, new, ledger, .. } = self;
        let columns = (&candidates.slots[..], &old[..], &mut new[..]);
        let round = Round { laws, motion, columns, ledger: self.keeps_ledger.then_some(ledger) };
        let solid = Closed::solid(*yield_overlap, *share);
        let mut reaction = match (&self.query, self.is_closed) {
            (BodyQuery::Ball(query), false) => round.against(query, Flat),
            (BodyQuery::Ball(query), true) => round.against(query, solid),
            (BodyQuery::Clump(query), false) => round.against(query, Flat),
            (BodyQuery::Clump(query), true) => round.against(query, solid),
            (BodyQuery::Mesh(query), false) => {
                round.on_foundation(query.as_ref(), Closed::plate(*share))
            }
            (BodyQuery::Mesh(query), true) => round.on_foundation(query.as_ref(), solid),
        };
        reaction.overlap_change /= self.yield_overlap;
        self.reaction = reaction;
        self.motion = *motion;
        &self.reaction
    }

    /// Energies of the last trial; zeros unless they are kept.
    pub(crate) fn ledger(&self) -> Ledger {
        Ledger { history: self.ledger.history + self.lost, ..self.ledger }
    }

    /// Sine of the angle at which the face attacked a node in the last trial, which is not yet
    /// committed.
    fn attack(&self, slot: &Slot) -> f64 {
        let touch = self.touch(slot);
        // On a plate that does not turn the heading is the same everywhere.
        let arm = if self.motion.drag.is_some() { touch.arm } else { Vector3::zeros() };
        touch.contact_normal.dot(&self.motion.heading(&arm, &slot.n))
    }

    fn touch(&self, slot: &Slot) -> Touch {
        match &self.query {
            BodyQuery::Ball(query) => query.touch(&slot.x, &slot.n),
            BodyQuery::Clump(query) => query.touch(&slot.x, &slot.n),
            BodyQuery::Mesh(query) => query.touch(&slot.x, &slot.n),
        }
    }

    /// Counts the dashpots' `normal_load` [N] in the last trial.
    pub(crate) fn add_load(&mut self, normal_load: f64) {
        self.reaction.normal_load += normal_load;
    }

    /// Lets every spring go.
    pub(crate) fn let_go(&mut self) {
        self.old.fill(Spring::default());
        self.candidates.forget();
    }

    /// Sum of the normal loads of the last trial [N].
    pub(crate) fn normal_load(&self) -> f64 {
        self.reaction.normal_load
    }

    /// Makes the last trial the state: nodes sink, springs step on.
    pub(crate) fn commit(&mut self, surface: &mut Surface) {
        let part = self.share * self.own;
        for (i, spring) in self.new.iter().enumerate() {
            let whole = spring.drop.total();
            if spring.overlap > 0.0 && whole > 0.0 {
                let slot = &self.candidates.slots[i];
                let debris = surface.laws.removal.debris(|| self.attack(slot));
                let slot = &mut self.candidates.slots[i];
                // In the contact a node stands for both sides: it goes all the way.
                slot.x -= slot.n * whole;
                let Drop { normal, lateral, archard } = spring.drop;
                let volume = part * slot.area;
                surface.sink(slot.id, part * whole);
                surface.gain.normal += volume * normal;
                surface.gain.lateral += volume * lateral;
                if archard > 0.0 {
                    surface.gain.rub_off(volume * archard);
                }
                surface.gain.take_off(volume * (normal + lateral), &debris);
            }
        }
        std::mem::swap(&mut self.old, &mut self.new);
        self.lost = 0.0;
        let (worn, reaction) = (&mut surface.gain, &self.reaction);
        worn.peak_normal_force = worn.peak_normal_force.max(reaction.normal_load);
        worn.peak_touching = worn.peak_touching.max(reaction.touching);
        worn.indented_area = worn.indented_area.max(reaction.normal_flow_area / self.share);
    }
}

fn inflation(elastic: &ElasticLaw) -> f64 {
    match elastic {
        ElasticLaw::HertzNodes { node_radius, .. } => *node_radius,
        _ => 0.0,
    }
}

fn yield_overlap(coefficients: impl Iterator<Item = f64>, surface: &Surface) -> f64 {
    let SurfaceLaws { material, elastic, .. } = &surface.laws;
    let (area, hardness) = (surface.least_area(), surface.least_hardness());
    let of = |coefficient| match elastic {
        ElasticLaw::HertzNodes { .. } => {
            HertzNodes::new(material.poisson).yield_overlap(coefficient, hardness, area)
        }
        _ => Foundation::new(material.poisson).yield_overlap(coefficient, hardness, area),
    };
    coefficients.map(of).fold(f64::INFINITY, f64::min)
}

#[cfg(feature = "state")]
impl Patch {
    pub(crate) fn checked(mut self) -> Result<Self, Fault> {
        let lengths = not_negative(self.inflation)
            && positive(self.yield_overlap)
            && positive(self.share)
            && self.share <= 1.0
            && positive(self.own)
            && self.own <= 1.0;
        require(lengths && not_negative(self.damping_ratio), "a patch is out of range")?;
        self.query.check()?;
        self.candidates.check()?;
        let count = self.candidates.slots.len();
        require(self.old.len() == count, "springs and candidates differ in number")?;
        require(self.old.iter().all(Spring::is_finite), "a spring is not finite")?;
        self.new.resize(count, Spring::default());
        Ok(self)
    }

    /// True when every candidate is one of `nodes`.
    pub(crate) fn lies_on(&self, nodes: usize) -> bool {
        self.candidates.lie_on(nodes)
    }
}
