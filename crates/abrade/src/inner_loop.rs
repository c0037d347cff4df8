//! The inner loop of the return mapping: every candidate through one step, one monomorphic loop per
//! combination of laws, shape, ground and books.

use nalgebra::{Isometry3, Vector3};

use crate::candidates::Slot;
use crate::carried::Grip;
use crate::elastic::Elastic;
use crate::flow::Flow;
use crate::ground::Ground;
use crate::ledger::Ledger;
use crate::node_law::{Answer, Drop, Motion, NodeStep, STEEP, Spring, resolve, stored};
use crate::query::{Query, Touch};

/// Laws, body and motion of a step.
pub(crate) struct InnerLoop<'a, E, F, Q, G> {
    pub elastic: E,
    pub flow: F,
    pub query: &'a Q,
    pub friction: f64,
    pub motion: &'a Motion,
    pub ground: G,
}

/// The candidates, their springs at the start of a step, and those at its end.
pub(crate) type Columns<'a> = (&'a [Slot], &'a [Spring], &'a mut [Spring]);

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
    /// Sum of the effective areas of the nodes in normal flow [m2] (Eq. 19).
    pub normal_flow_area: f64,
    /// Largest change of an overlap [m]; over its yield overlap once it leaves the patch.
    pub overlap_change: f64,
    /// Square of the largest lever of a contact force [m2].
    pub lever_squared: f64,
    /// Nodes that carry force.
    pub touching: usize,
}

impl Reaction {
    /// Force and torque on the body.
    pub(crate) fn grip(&self) -> Grip {
        Grip { force: self.force, torque: self.torque }
    }

    /// Adds the reaction of another surface, whose frame is `pose`.
    pub(crate) fn add(&mut self, other: &Self, pose: &Isometry3<f64>) {
        self.force += pose * other.force;
        self.torque += pose * other.torque;
        self.normal_stiffness += other.normal_stiffness;
        self.tangential_stiffness += other.tangential_stiffness;
        self.normal_load += other.normal_load;
        self.push += pose * other.push;
        self.overlap_change = self.overlap_change.max(other.overlap_change);
        self.lever_squared = self.lever_squared.max(other.lever_squared);
        self.touching += other.touching;
    }
}

impl<E: Elastic, F: Flow, Q: Query, G: Ground> InnerLoop<'_, E, F, Q, G> {
    /// Takes every candidate from its old spring to its new one.
    pub(crate) fn run<B: Books>(&self, (slots, old, new): Columns<'_>, books: &mut B) -> Reaction {
        let mut sum = Reaction::default();
        let mut node = NodeStep {
            query: self.query,
            elastic: self.elastic,
            x: nalgebra::Point3::origin(),
            n: Vector3::zeros(),
            area: 0.0,
            friction: self.friction,
            heading: Vector3::zeros(),
            trial_stretch: Vector3::zeros(),
        };
        let zero = Vector3::zeros();
        let turns = self.motion.drag.is_some();
        for (slot, (old, new)) in slots.iter().zip(old.iter().zip(new)) {
            if !self.query.near(&slot.x) {
                if old.overlap > 0.0 {
                    let fall = old.overlap - self.query.touch(&slot.x, &slot.n).overlap;
                    sum.overlap_change = sum.overlap_change.max(fall);
                }
                new.release();
                continue;
            }
            if F::HEADS && (slot.n != node.n || turns) {
                let arm = if turns { self.query.touch(&slot.x, &slot.n).arm } else { zero };
                node.heading = self.motion.heading(&arm, &slot.n);
            }
            (node.x, node.n, node.area) = (slot.x, slot.n, self.ground.area(slot.area));
            let flow = self.flow.times(slot.factor);
            match resolve(self.ground, &flow, &mut node, old, self.motion) {
                Some(mut answer) => {
                    sum.take(&answer, &node);
                    books.take(&flow, &mut answer, &node, old);
                    *new = answer.spring;
                }
                None => {
                    sum.overlap_change = sum.overlap_change.max(old.overlap);
                    if old.overlap > 0.0 {
                        books.let_go(&node, old);
                    }
                    new.release();
                }
            }
        }
        sum.tangential_stiffness = self.elastic.tangential_ratio() * sum.normal_stiffness;
        sum
    }
}

impl Reaction {
    /// Adds what one node does.
    #[inline(always)]
    fn take<E: Elastic, Q>(&mut self, answer: &Answer, node: &NodeStep<'_, E, Q>) {
        let Answer { spring, loaded: k, overlap_change } = answer;
        let coefficient = k.touch.coefficient;
        let pressed = k.touch.contact_normal * k.normal_force;
        let force = if E::RUBS { pressed + k.tangential } else { pressed };
        self.force -= force;
        self.torque -= k.touch.arm.cross(&force);
        self.normal_stiffness +=
            node.elastic.normal_stiffness(coefficient, spring.overlap, node.area);
        self.normal_load += k.normal_load;
        self.push += node.n * k.normal_load;
        if spring.drop.normal > 0.0 {
            self.normal_flow_area += node.area / k.cosine.max(STEEP);
        }
        self.overlap_change = self.overlap_change.max(*overlap_change);
        self.lever_squared = self.lever_squared.max(k.touch.arm.norm_squared());
        self.touching += 1;
    }
}

/// Where the energies of nodes are booked; nowhere, if no ledger is kept.
pub(crate) trait Books {
    /// Books one node's step, of whose spring the excess may be left to do.
    #[inline(always)]
    fn take<E: Elastic, F: Flow, Q: Query>(
        &mut self,
        _flow: &F,
        _answer: &mut Answer,
        _node: &NodeStep<'_, E, Q>,
        _old: &Spring,
    ) {
    }

    /// Books a spring that was let go, maybe pressed.
    #[inline(always)]
    fn let_go<E: Elastic, Q: Query>(&mut self, _node: &NodeStep<'_, E, Q>, _old: &Spring) {}
}

impl Books for () {}

impl Books for Ledger {
    // Out of line, so that a count of calls shows who pays for it.
    #[inline(never)]
    fn take<E: Elastic, F: Flow, Q: Query>(
        &mut self,
        flow: &F,
        answer: &mut Answer,
        node: &NodeStep<'_, E, Q>,
        old: &Spring,
    ) {
        if F::FACE_PRESSURE {
            answer.spring.excess = flow.excess(node.area, &answer.loaded);
        }
        let Answer { spring, loaded: k, .. } = answer;
        let coefficient = k.touch.coefficient;
        let stiffness =
            |overlap| node.elastic.tangential_stiffness(coefficient, overlap, node.area);
        let tangential = spring.tangential_force;
        let now = stiffness(spring.overlap);
        self.elastic += stored(node.elastic, coefficient, spring, node.area);
        if F::FACE_PRESSURE && spring.drop.normal > 0.0 && gives_way(old, spring) {
            return self.take_release(answer, node, old);
        }
        self.friction += 0.5 * (old.tangential_force + tangential) * k.slip;
        // A gate that opens within the step does so under the load at its end.
        let mean = |is_open: bool, before: f64, after: f64| {
            if is_open { 0.5 * (before + after) } else { after }
        };
        let Drop { normal, lateral, archard } = spring.drop;
        let opened = old.drop.normal > 0.0 || old.excess.normal > 0.0;
        let aside = old.drop.lateral > 0.0 || old.excess.lateral > 0.0;
        let work = mean(opened, old.normal_load, k.normal_load) * normal
            + mean(aside, old.normal_load, k.normal_load) * lateral;
        self.wear += work + k.normal_load.max(0.0) * archard;
        if F::FACE_PRESSURE && E::RUBS {
            let pressed = k.normal_force * k.cosine;
            let before = pressed + old.excess.normal - spring.excess.normal;
            let rubbed = work - mean(opened, before, pressed) * normal;
            self.wear -= rubbed;
            self.friction += rubbed;
        }
        if !E::CONSERVATIVE && old.overlap > 0.0 {
            self.history -= 0.5 * (now - stiffness(old.overlap)) * old.stretch.norm_squared();
        }
    }

    fn let_go<E: Elastic, Q: Query>(&mut self, node: &NodeStep<'_, E, Q>, old: &Spring) {
        let touch = node.query.touch(&node.x, &node.n);
        // Let go while pressed: the body has come round to the other side of it.
        if touch.overlap > 0.0 {
            self.history += stored(node.elastic, touch.coefficient, old, node.area);
        }
    }
}

impl Ledger {
    /// Books a node that gives way at once, below a body that stands still: the work on its drop is
    /// what its springs held more than they hold now.
    fn take_release<E: Elastic, Q: Query>(
        &mut self,
        answer: &Answer,
        node: &NodeStep<'_, E, Q>,
        old: &Spring,
    ) {
        let start = node.query.touch(&node.x, &node.n);
        let pressed = |touch: &Touch| {
            node.elastic.normal_energy(touch.coefficient, touch.overlap.max(0.0), node.area)
        };
        let now = &answer.loaded.touch;
        let stretched = |spring: &Spring| {
            let Spring { overlap, tangential_force: force, .. } = *spring;
            let stiffness = node.elastic.tangential_stiffness(now.coefficient, overlap, node.area);
            if stiffness > 0.0 { 0.5 * force * force / stiffness } else { 0.0 }
        };
        self.wear += pressed(&start) - pressed(now);
        self.friction += stretched(old) - stretched(&answer.spring);
    }
}

/// Share of its overlap below which a node falls when it gives way to what has held it long.
const GIVEN_WAY: f64 = 0.5;

/// True for a node that something else than its hardness has held until now.
#[inline(always)]
fn gives_way(old: &Spring, now: &Spring) -> bool {
    now.overlap < GIVEN_WAY * old.overlap
}

#[cfg(test)]
mod tests {
    use nalgebra::Point3;

    use crate::body::{Body, Inertia, State};
    use crate::elastic::Foundation;
    use crate::encounter::{Encounter, EncounterSettings, Loads, Placed, Until};
    use crate::flow::NormalPressure;
    use crate::ground::Flat;
    use crate::laws::{ElasticLaw, FlowLaw, HertzConvention, Lateral};
    use crate::layout::HexStrip;
    use crate::material::Material;
    use crate::query::BallQuery;
    use crate::shape::{Ball, Shape};
    use crate::surface::{Surface, SurfaceLaws};

    use super::*;

    /// What is worn and the velocity after a spinning ball has struck a plate of these laws.
    fn blow(friction: f64, elastic: &ElasticLaw, flow: &FlowLaw) -> [f64; 4] {
        let (young, poisson) = (Some(100.0), 0.3);
        let material = Material { hardness: 1.0, shear_ratio: 0.25, young, poisson, friction };
        let (elastic, flow) = (elastic.clone(), flow.clone());
        let laws = SurfaceLaws { elastic, flow, ..SurfaceLaws::of(material) };
        let strip = HexStrip { length: 2.0, width: 1.6, pitch: 0.06, rest_area: None };
        let mut surface = Surface::hex_strip(strip, laws).expect("a plate");
        let velocity = Vector3::new(0.7, 0.1, -0.7);
        let spin = Vector3::new(0.5, 1.0, -0.3);
        let at = State::at(Point3::new(0.01, 0.02, 0.53));
        let state = State { velocity, spin, ..at };
        let shape = Shape::ball(0.5).expect("a ball");
        let inertia = Inertia::of_ball(0.5, 0.04);
        let mut body = Body { shape, inertia, state, rotation_locked: false };
        let settings = EncounterSettings::default();
        let mut encounter = Encounter::new(&body, [&surface], settings).expect("an encounter");
        let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
        let loads = Loads::default();
        encounter
            .advance(&mut body, &mut placed, &loads, 1e9, Until::FirstExit, &mut ())
            .expect("a blow");
        let v = body.state.velocity;
        [surface.wear_volume(), v.x, v.y, v.z]
    }

    /// Fails for work by the mean of the loads before and after the fall, between which the face turns.
    #[test]
    fn a_node_that_gives_way_late_books_what_its_springs_let_go() {
        let ball = Ball { centre: Point3::origin(), radius: 1.0 };
        let mut query = BallQuery::new(&ball, 1e3, 0.0);
        // A flank just flat enough to push the node down, which the body has long leant on.
        query.place(&State::at(Point3::new(0.8, 0.0, 0.041)));
        let elastic = Foundation::new(0.3);
        let (area, friction) = (1e-4, 0.4);
        let overlap = 1.0 - 0.8f64.hypot(0.041);
        let force = elastic.normal_force(1e3, overlap, area);
        let old = Spring { overlap, tangential_force: 0.3 * force, ..Spring::default() };
        let stiffness = elastic.tangential_stiffness(1e3, overlap, area);
        let stretch = Vector3::y() * (old.tangential_force / stiffness);
        let old = Spring { stretch, ..old };
        let motion =
            Motion { velocity: Vector3::zeros(), spin: Vector3::zeros(), drag: None, dt: 1e-9 };
        let flow = NormalPressure { hardness: 1.0 };
        let inner =
            InnerLoop { elastic, flow, query: &query, friction, motion: &motion, ground: Flat };
        let slot = Slot { id: 0, x: Point3::origin(), n: Vector3::z(), area, factor: 1.0 };
        let mut new = [Spring::default()];
        let mut ledger = Ledger::default();
        inner.run((&[slot], &[old], &mut new), &mut ledger);
        let Ledger { elastic: kept, wear, friction, .. } = ledger;
        let held = stored(elastic, 1e3, &old, area);
        let drop = new[0].drop.normal;
        assert!(drop > 0.3 && kept < 1e-2 * held, "{drop} {kept:e} of {held:e}");
        assert!((wear + friction + kept - held).abs() < 1e-12 * held, "{wear:e} {friction:e}");
        assert!(wear > area * drop && friction > 0.0);
    }

    /// Fails for a frictionless loop that leaves out more than what friction carries.
    #[test]
    fn a_surface_without_friction_is_the_limit_of_little_friction() {
        let node_radius = 0.02;
        let hertz =
            ElasticLaw::HertzNodes { node_radius, convention: HertzConvention::ElasticPair };
        let literal = FlowLaw::CapozzaHanley { lateral: Lateral::Eq5 };
        let projected = FlowLaw::CapozzaHanley { lateral: Lateral::Projected };
        for elastic in [ElasticLaw::Foundation { stiffness: None }, hertz] {
            for flow in [&literal, &projected, &FlowLaw::NormalPressure {}] {
                let [none, little] = [0.0, 1e-200].map(|friction| blow(friction, &elastic, flow));
                let differ = none.iter().zip(&little).any(|(a, b)| (a - b).abs() > 1e-12);
                assert!(none[0] > 1e-3 && !differ, "{elastic:?} {flow:?} {none:?} {little:?}");
            }
        }
    }
}
