//! One body against one surface by the return mapping: the springs of the touching nodes, a trial
//! of a step, and its commitment.

use std::marker::PhantomData;

use nalgebra::{Isometry3, Vector3};

use crate::body::State;
use crate::candidates::Candidates;
use crate::elastic::{Elastic, Foundation, HertzNodes, coefficient};
use crate::flow::{CapozzaHanley, Eq5, Flow, NormalPressure, Projected};
use crate::laws::{ElasticLaw, FlowLaw, Lateral, Removal};
use crate::ledger::Ledger;
use crate::node_law::{Motion, NodeStep, Spring, resolve};
use crate::query::{BodyQuery, Contactor, Query};
use crate::shape::Shape;
use crate::surface::{Surface, SurfaceLaws};

/// Springs between one body and one surface.
#[derive(Clone, Debug)]
pub(crate) struct Patch {
    contactors: Vec<Contactor>,
    inflation: f64,
    yield_overlap: f64,
    candidates: Candidates,
    /// Springs at the start of the step and at its trial end, one per candidate.
    old: Vec<Spring>,
    new: Vec<Spring>,
    carried: Vec<(u32, Spring)>,
}

/// What the nodes of a patch do to the body at the end of a step.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Reaction {
    /// Force on the body [N], torque about its centre of mass [N m].
    pub force: Vector3<f64>,
    pub torque: Vector3<f64>,
    /// Sums of the elastic stiffnesses [N/m].
    pub normal_stiffness: f64,
    pub tangential_stiffness: f64,
    /// Sum of the nodes' normal loads [N], and the same along their normals.
    pub normal_load: f64,
    pub push: Vector3<f64>,
    /// Sums of the effective areas of the nodes that flow [m2].
    pub normal_flow_area: f64,
    pub lateral_flow_area: f64,
    /// Largest change of an overlap over its yield overlap.
    pub overlap_change: f64,
    /// Largest lever of a contact force [m].
    pub reach: f64,
    pub touching: usize,
    pub evaluations: u64,
    pub ledger: Ledger,
}

impl Reaction {
    /// Adds the reaction of another surface, whose frame is `pose`.
    pub(crate) fn add(&mut self, other: &Self, pose: &Isometry3<f64>) {
        self.force += pose * other.force;
        self.torque += pose * other.torque;
        self.normal_stiffness += other.normal_stiffness;
        self.tangential_stiffness += other.tangential_stiffness;
        self.normal_load += other.normal_load;
        self.push += pose * other.push;
        self.overlap_change = self.overlap_change.max(other.overlap_change);
        self.reach = self.reach.max(other.reach);
        self.touching += other.touching;
        self.evaluations += other.evaluations;
        self.ledger += other.ledger;
    }
}

impl Patch {
    pub(crate) fn new(shape: &Shape, surface: &Surface) -> Self {
        let laws = &surface.laws;
        let contactors: Vec<_> = shape
            .pieces()
            .iter()
            .map(|piece| Contactor { piece: piece.clone(), coefficient: coefficient(laws, piece) })
            .collect();
        Self {
            yield_overlap: yield_overlap(&contactors, surface),
            contactors,
            inflation: inflation(&laws.elastic),
            candidates: Candidates::default(),
            old: Vec::new(),
            new: Vec::new(),
            carried: Vec::new(),
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

    /// Makes sure that the candidates cover the body at `state`; `margin` [m] is the reach of a
    /// new list.
    pub(crate) fn cover(&mut self, surface: &Surface, shape: &Shape, state: &State, margin: f64) {
        if self.candidates.slack(shape, state) >= 0.0 {
            return;
        }
        self.carried.clear();
        let slots = self.candidates.slots.iter().zip(&self.old);
        self.carried.extend(
            slots
                .filter(|(_, spring)| spring.overlap > 0.0)
                .map(|(slot, spring)| (slot.id, *spring)),
        );
        self.candidates.collect(surface, shape, state, self.inflation, margin);
        let count = self.candidates.slots.len();
        for springs in [&mut self.old, &mut self.new] {
            springs.clear();
            springs.resize(count, Spring::default());
        }
        let mut from = self.carried.iter().peekable();
        for (slot, spring) in self.candidates.slots.iter().zip(&mut self.old) {
            while from.peek().is_some_and(|(id, _)| *id < slot.id) {
                from.next();
            }
            if let Some((_, carried)) = from.next_if(|(id, _)| *id == slot.id) {
                *spring = *carried;
            }
        }
    }

    /// How far the body may move before [`Patch::cover`] collects anew [m].
    pub(crate) fn slack(&self, shape: &Shape, state: &State) -> f64 {
        self.candidates.slack(shape, state)
    }

    /// Shortest time [s] in which a candidate can be touched, the body moving as in `state`.
    pub(crate) fn time_to_touch(&self, state: &State) -> f64 {
        let query = BodyQuery::new(&self.contactors, state, self.inflation);
        match &query {
            BodyQuery::Ball(query) => self.earliest(query, state),
            BodyQuery::Clump(_) => 0.0,
        }
    }

    /// Newton's estimate from the gap and its rate: early, never late, because the distance from
    /// a node to a ball in straight motion is convex in time.
    fn earliest(&self, query: &impl Query, state: &State) -> f64 {
        let times = self.candidates.slots.iter().map(|slot| {
            let touch = query.touch(&slot.x, &slot.n);
            let approach = touch.contact_normal.dot(&state.velocity);
            if approach > 0.0 { (-touch.overlap / approach).max(0.0) } else { f64::INFINITY }
        });
        times.fold(f64::INFINITY, f64::min)
    }

    /// Largest overlap of a node with the body at `state` [m].
    pub(crate) fn deepest(&self, state: &State) -> f64 {
        let query = BodyQuery::new(&self.contactors, state, self.inflation);
        let overlap = |slot: &crate::candidates::Slot| match &query {
            BodyQuery::Ball(query) => query.touch(&slot.x, &slot.n).overlap,
            BodyQuery::Clump(query) => query.touch(&slot.x, &slot.n).overlap,
        };
        self.candidates.slots.iter().map(overlap).fold(0.0, f64::max)
    }

    /// Takes every candidate through a step that ends at `end`; commits nothing.
    pub(crate) fn trial(
        &mut self,
        surface: &Surface,
        end: &State,
        motion: &Motion,
        ledger: bool,
    ) -> Reaction {
        let poisson = surface.laws.material.poisson;
        match surface.laws.elastic {
            ElasticLaw::HertzNodes { .. } => {
                self.with_elastic(HertzNodes::new(poisson), surface, end, motion, ledger)
            }
            _ => self.with_elastic(Foundation::new(poisson), surface, end, motion, ledger),
        }
    }

    fn with_elastic<E: Elastic>(
        &mut self,
        elastic: E,
        surface: &Surface,
        end: &State,
        motion: &Motion,
        ledger: bool,
    ) -> Reaction {
        let material = &surface.laws.material;
        let hardness = material.hardness;
        let shear_hardness = material.shear_ratio * hardness;
        match surface.laws.flow {
            FlowLaw::CapozzaHanley { lateral: Lateral::Projected } => {
                let flow =
                    CapozzaHanley::<Projected> { hardness, shear_hardness, lateral: PhantomData };
                self.with_flow(elastic, flow, material.friction, end, motion, ledger)
            }
            FlowLaw::CapozzaHanley { lateral: Lateral::Eq5 } => {
                let flow = CapozzaHanley::<Eq5> { hardness, shear_hardness, lateral: PhantomData };
                self.with_flow(elastic, flow, material.friction, end, motion, ledger)
            }
            FlowLaw::NormalPressure {} => {
                let flow = NormalPressure { hardness };
                self.with_flow(elastic, flow, material.friction, end, motion, ledger)
            }
        }
    }

    fn with_flow<E: Elastic, F: Flow>(
        &mut self,
        elastic: E,
        flow: F,
        friction: f64,
        end: &State,
        motion: &Motion,
        ledger: bool,
    ) -> Reaction {
        match (BodyQuery::new(&self.contactors, end, self.inflation), ledger) {
            (BodyQuery::Ball(query), false) => {
                self.run::<E, F, _, false>(elastic, flow, friction, &query, motion)
            }
            (BodyQuery::Ball(query), true) => {
                self.run::<E, F, _, true>(elastic, flow, friction, &query, motion)
            }
            (BodyQuery::Clump(query), false) => {
                self.run::<E, F, _, false>(elastic, flow, friction, &query, motion)
            }
            (BodyQuery::Clump(query), true) => {
                self.run::<E, F, _, true>(elastic, flow, friction, &query, motion)
            }
        }
    }

    /// The inner loop.
    fn run<E: Elastic, F: Flow, Q: Query, const LEDGER: bool>(
        &mut self,
        elastic: E,
        flow: F,
        friction: f64,
        query: &Q,
        motion: &Motion,
    ) -> Reaction {
        let mut sum = Reaction::default();
        let mut largest_change: f64 = 0.0;
        let springs = self.old.iter().zip(&mut self.new);
        for (slot, (old, new)) in self.candidates.slots.iter().zip(springs) {
            let answer = query.near(&slot.x).then(|| {
                let node = NodeStep {
                    query,
                    elastic,
                    x: slot.x,
                    n: slot.n,
                    area: slot.area,
                    friction,
                    heading: Vector3::zeros(),
                    trial_stretch: Vector3::zeros(),
                };
                resolve(&flow, node, old, motion)
            });
            let Some(answer) = answer.flatten() else {
                if old.overlap > 0.0 {
                    let fall = old.overlap - query.touch(&slot.x, &slot.n).overlap;
                    largest_change = largest_change.max(fall);
                }
                if new.overlap != 0.0 {
                    *new = Spring::default();
                }
                continue;
            };
            let Spring { overlap, drop, .. } = answer.spring;
            let k = &answer.loaded;
            let coefficient = k.touch.coefficient;
            let force = k.touch.contact_normal * k.normal_force + k.tangential;
            sum.force -= force;
            sum.torque -= k.touch.arm.cross(&force);
            let stiffness = elastic.normal_stiffness(coefficient, overlap, slot.area);
            let spring = elastic.tangential_stiffness(coefficient, overlap, slot.area);
            sum.normal_stiffness += stiffness;
            sum.tangential_stiffness += spring;
            sum.normal_load += k.normal_load;
            sum.push += slot.n * k.normal_load;
            let flow_area = slot.area / k.cosine.max(crate::node_law::STEEP);
            sum.normal_flow_area += if drop.normal > 0.0 { flow_area } else { 0.0 };
            sum.lateral_flow_area += if drop.lateral > 0.0 { flow_area } else { 0.0 };
            largest_change = largest_change.max(answer.overlap_change);
            sum.reach = sum.reach.max(k.touch.arm.norm());
            sum.touching += 1;
            sum.evaluations += 1;
            if LEDGER {
                let tangential = answer.spring.tangential_force;
                let stretched =
                    if spring > 0.0 { 0.5 * tangential * tangential / spring } else { 0.0 };
                let ledger = &mut sum.ledger;
                ledger.elastic +=
                    elastic.normal_energy(coefficient, overlap, slot.area) + stretched;
                ledger.friction += 0.5 * (old.tangential_force + tangential) * k.slip;
                let flowed = old.drop.normal + old.drop.lateral > 0.0;
                let mean =
                    if flowed { 0.5 * (old.normal_load + k.normal_load) } else { k.normal_load };
                ledger.wear += mean * (drop.normal + drop.lateral);
                if !E::CONSERVATIVE && old.overlap > 0.0 {
                    let before = elastic.tangential_stiffness(coefficient, old.overlap, slot.area);
                    ledger.history -= 0.5 * (spring - before) * old.stretch.norm_squared();
                }
            }
            *new = answer.spring;
        }
        sum.overlap_change = largest_change / self.yield_overlap;
        sum
    }

    /// Makes the trial the state: nodes sink, springs step on.
    pub(crate) fn commit(&mut self, surface: &mut Surface, reaction: &Reaction) {
        let removal = surface.laws.removal.clone();
        for (slot, spring) in self.candidates.slots.iter_mut().zip(&self.new) {
            let Spring { drop, attack, .. } = *spring;
            let total = drop.normal + drop.lateral;
            if spring.overlap > 0.0 && total > 0.0 {
                slot.x -= slot.n * total;
                surface.sink(slot.id, total);
                surface.worn.normal += slot.area * drop.normal;
                surface.worn.lateral += slot.area * drop.lateral;
                surface.worn.removed += slot.area * total * removed_share(&removal, attack);
            }
        }
        std::mem::swap(&mut self.old, &mut self.new);
        let worn = &mut surface.worn;
        worn.peak_normal_force = worn.peak_normal_force.max(reaction.normal_load);
        worn.peak_touching = worn.peak_touching.max(reaction.touching);
        worn.indented_area = worn.indented_area.max(reaction.normal_flow_area);
    }
}

/// Share of a drop that becomes debris; `attack` is the sine of the face's angle of attack.
pub(crate) fn removed_share(removal: &Removal, attack: f64) -> f64 {
    match removal {
        Removal::All => 1.0,
        Removal::Fraction { of } => *of,
        Removal::AttackAngle { critical } => f64::from(u8::from(attack >= critical.sin())),
    }
}

fn inflation(elastic: &ElasticLaw) -> f64 {
    match elastic {
        ElasticLaw::HertzNodes { node_radius, .. } => *node_radius,
        _ => 0.0,
    }
}

fn yield_overlap(contactors: &[Contactor], surface: &Surface) -> f64 {
    let SurfaceLaws { material, elastic, .. } = &surface.laws;
    let area = surface.nodes.rest_area[0];
    let of = |c: &Contactor| match elastic {
        ElasticLaw::HertzNodes { .. } => {
            HertzNodes::new(material.poisson).yield_overlap(c.coefficient, material.hardness, area)
        }
        _ => {
            Foundation::new(material.poisson).yield_overlap(c.coefficient, material.hardness, area)
        }
    };
    contactors.iter().map(of).fold(f64::INFINITY, f64::min)
}
