//! One body against one surface by the swept rule: every newly removed bit of a column is charged
//! to the face it entered through, with that face's own displacement.
//!
//! A column is dropped by the lowest face over it, but the face that did the work may be another
//! one: a steep wall or an undercut face passing over. Forces built from the deep-end face alone
//! cut for free.

use nalgebra::{Isometry3, Point3, Vector3};

use crate::body::State;
use crate::candidates::{Candidates, Slot};
use crate::column::{Column, Interval, Pieces};
use crate::elastic::coefficient;
use crate::laws::{ElasticLaw, FlowLaw};
use crate::node_law::{Motion, STEEP};
use crate::patch::removed_share;
use crate::shape::Shape;
use crate::surface::{Surface, SurfaceLaws};
use crate::sweep::{Entry, Span, Swept};

/// Midpoints at which a removed piece is charged, and for a piece longer than `LONG` steps.
const SAMPLES: usize = 2;
const LONG_SAMPLES: usize = 4;
const LONG: f64 = 3.0;

/// Columns between one body and one surface.
#[derive(Clone, Debug)]
pub(crate) struct Columns {
    candidates: Candidates,
    columns: Vec<Column>,
    cuts: Vec<Cut>,
    carried: Vec<(Slot, Column)>,
    swept: Swept,
    price: Price,
    /// k_w [Pa/m] and the yield overlap g_y = H / k_w [m]; zero overlap without springs.
    stiffness: f64,
    yield_overlap: f64,
    friction: f64,
}

/// A step's trial on a column.
#[derive(Clone, Copy, Debug, Default)]
struct Cut {
    /// Solid that the body swept.
    pieces: Pieces,
    /// Share of their length swept sideways, and the sine of the angle of attack.
    lateral: f64,
    attack: f64,
    squeeze: f64,
}

/// Impulses on a body over a step.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Push {
    /// Impulse [N s] and impulsive torque about the centre of mass [N m s].
    pub impulse: Vector3<f64>,
    pub torque: Vector3<f64>,
    /// Energy that slip under these impulses dissipates [J].
    pub friction: f64,
}

/// What a step takes from the body.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Toll {
    /// Of the faces that sweep, and the price of the removed volume [J].
    pub flow: Push,
    pub wear: f64,
    /// Of the springs, the change of their energy [J], and the part of it lost sideways.
    pub spring: Push,
    pub elastic: f64,
    pub lost: f64,
    /// Sum of stiffnesses along the face normals [N/m].
    pub stiffness: f64,
    pub flow_area: f64,
    pub touching: usize,
}

impl Push {
    fn add(&mut self, other: &Self, pose: &Isometry3<f64>) {
        self.impulse += pose * other.impulse;
        self.torque += pose * other.torque;
        self.friction += other.friction;
    }

    /// Scaled, friction included.
    pub(crate) fn scaled(&self, scale: f64) -> Self {
        Self {
            impulse: self.impulse * scale,
            torque: self.torque * scale,
            friction: self.friction * scale,
        }
    }
}

/// Energy per volume that a face pays.
#[derive(Clone, Copy, Debug)]
struct Price {
    hardness: f64,
    /// mu_a H [Pa] for `CapozzaHanley`; None for `NormalPressure`.
    shear_hardness: Option<f64>,
    friction: f64,
}

impl Price {
    /// Energy per volume [Pa] charged to a face of outward `normal`, and the lateral share of it.
    ///
    /// `NormalPressure`: H. `CapozzaHanley`: its balance is sum f_z ds with f_z = a_s H / c, so a
    /// down face pays H / c for its normal advance; for its lateral advance it pays what the
    /// lateral gate lets through, mu_a H / (m.t + mu c); a vertical or undercut face pays mu_a H.
    fn of(
        &self,
        entry: &Entry,
        n: &Vector3<f64>,
        motion: &Motion,
        arm: &Vector3<f64>,
    ) -> (f64, f64) {
        let Some(shear) = self.shear_hardness else { return (self.hardness, 0.0) };
        let m = entry.normal;
        let cosine = -m.dot(n);
        if cosine <= STEEP {
            return (shear, 1.0);
        }
        let turning = motion.spin.cross(arm);
        let split = (motion.velocity + m * m.dot(&turning)) * motion.dt;
        let down = -split.dot(n) * cosine / entry.displacement;
        let lateral = 1.0 - down.clamp(0.0, 1.0);
        let tangential = motion.velocity - n * motion.velocity.dot(n);
        let heading = tangential / tangential.norm().max(f64::MIN_POSITIVE);
        let attack = m.dot(&heading).max(0.0);
        let normal_price = self.hardness / cosine;
        let lateral_price = (shear / (attack + self.friction * cosine)).min(normal_price);
        let share = if attack > 0.0 { lateral } else { 0.0 };
        (normal_price + share * (lateral_price - normal_price), share)
    }
}

impl Toll {
    /// Adds the toll of another surface, whose frame is `pose`.
    pub(crate) fn add(&mut self, other: &Self, pose: &Isometry3<f64>) {
        self.flow.add(&other.flow, pose);
        self.spring.add(&other.spring, pose);
        self.wear += other.wear;
        self.elastic += other.elastic;
        self.lost += other.lost;
        self.stiffness += other.stiffness;
        self.touching += other.touching;
    }
}

/// What a column needs to know of the step.
struct Step<'a> {
    swept: &'a Swept,
    motion: &'a Motion,
    /// Mid-step centre of mass.
    middle: Point3<f64>,
    /// Displacement of the fastest point [m].
    reach: f64,
}

impl Columns {
    pub(crate) fn new(shape: &Shape, laws: &SurfaceLaws) -> Self {
        let material = &laws.material;
        let stiffness = match laws.elastic {
            ElasticLaw::Rigid => f64::INFINITY,
            _ => shape.pieces().iter().map(|p| coefficient(laws, p)).fold(0.0, f64::max),
        };
        let shear_hardness = match laws.flow {
            FlowLaw::CapozzaHanley { .. } => Some(material.shear_ratio * material.hardness),
            FlowLaw::NormalPressure {} => None,
        };
        Self {
            candidates: Candidates::default(),
            columns: Vec::new(),
            cuts: Vec::new(),
            carried: Vec::new(),
            swept: Swept::default(),
            price: Price {
                hardness: material.hardness,
                shear_hardness,
                friction: material.friction,
            },
            stiffness,
            yield_overlap: material.hardness / stiffness,
            friction: material.friction,
        }
    }

    /// g_y [m]; zero without springs.
    pub(crate) fn yield_overlap(&self) -> f64 {
        self.yield_overlap
    }

    /// Elastic energy stored now [J].
    pub(crate) fn elastic(&self) -> f64 {
        let columns = self.candidates.slots.iter().zip(&self.columns);
        columns.map(|(slot, column)| self.stored(slot.area, column.squeeze)).sum()
    }

    fn stored(&self, area: f64, squeeze: f64) -> f64 {
        if squeeze > 0.0 { 0.5 * self.stiffness * area * squeeze * squeeze } else { 0.0 }
    }

    /// Largest depth of a node inside the body at `state` [m].
    pub(crate) fn deepest(&mut self, shape: &Shape, state: &State) -> f64 {
        self.swept.place(shape, state, state);
        let inside = |slot: &Slot| {
            let span = self.swept.span(&slot.x, &slot.n);
            span.map_or(0.0, |s| if s.high > 0.0 { -s.low } else { 0.0 })
        };
        self.candidates.slots.iter().map(inside).fold(0.0, f64::max)
    }

    /// Makes sure that the candidates cover the body at `state`, whose columns may be crossed
    /// anywhere below their nodes.
    pub(crate) fn cover(&mut self, surface: &Surface, shape: &Shape, state: &State, margin: f64) {
        if self.candidates.slack(shape, state) >= 0.0 {
            return;
        }
        self.carried.clear();
        let columns = self.candidates.slots.iter().zip(&self.columns);
        self.carried.extend(
            columns
                .filter(|(_, c)| c.is_cut() || c.squeeze > 0.0)
                .map(|(slot, column)| (*slot, *column)),
        );
        self.candidates.collect_columns(surface, shape, state, margin);
        let slots = &mut self.candidates.slots;
        slots.retain(|slot| self.carried.binary_search_by_key(&slot.id, |(s, _)| s.id).is_err());
        slots.extend(self.carried.iter().map(|(slot, _)| *slot));
        slots.sort_unstable_by_key(|slot| slot.id);
        let mut from = self.carried.iter().peekable();
        self.columns.clear();
        self.columns.extend(slots.iter().map(|slot| {
            from.next_if(|(carried, _)| carried.id == slot.id)
                .map_or_else(Column::default, |(_, column)| *column)
        }));
        self.cuts.clear();
        self.cuts.resize(self.columns.len(), Cut::default());
    }

    /// Takes every column through a step; commits nothing.
    pub(crate) fn trial(
        &mut self,
        shape: &Shape,
        start: &State,
        end: &State,
        motion: &Motion,
    ) -> Toll {
        let mut swept = std::mem::take(&mut self.swept);
        swept.place(shape, start, end);
        let reach = (end.position - start.position).norm()
            + motion.spin.norm() * motion.dt * shape.bounding_radius();
        let middle = nalgebra::center(&start.position, &end.position);
        let step = Step { swept: &swept, motion, middle, reach };
        let mut toll = Toll::default();
        let mut cuts = std::mem::take(&mut self.cuts);
        let columns = self.candidates.slots.iter().zip(&self.columns);
        for ((slot, column), cut) in columns.zip(&mut cuts) {
            *cut = self.column(&step, slot, column, &mut toll);
        }
        self.cuts = cuts;
        self.swept = swept;
        toll
    }

    /// One column in one step.
    #[inline]
    fn column(&self, step: &Step<'_>, slot: &Slot, column: &Column, toll: &mut Toll) -> Cut {
        let mut cut = Cut::default();
        let Some(span) = step.swept.span(&slot.x, &slot.n) else {
            // The body left sideways: what the spring still held pushes nobody.
            let stored = self.stored(slot.area, column.squeeze);
            toll.elastic -= stored;
            toll.lost += stored;
            return cut;
        };
        // With springs the body sweeps as if lifted by the yield overlap.
        let (low, high) = (span.low + self.yield_overlap, span.high + self.yield_overlap);
        let mut flow = Taken::default();
        if low < 0.0 {
            cut.pieces = column.solid(low, high);
            for piece in cut.pieces.iter() {
                self.charge(step, slot, &span, piece, &mut flow, toll);
            }
        }
        if self.yield_overlap > 0.0 {
            cut.squeeze = self.squeeze(step, slot, column, &span, flow.length > 0.0, toll);
        }
        if flow.length > 0.0 {
            cut.lateral = flow.lateral / flow.length;
            cut.attack = flow.attack / flow.length;
            toll.flow_area += slot.area / (-span.deep_normal.dot(&slot.n)).max(STEEP);
        }
        toll.touching += usize::from(flow.length > 0.0 || cut.squeeze > 0.0);
        cut
    }

    /// Charges the removal of the piece between `low` and `high` of a column.
    fn charge(
        &self,
        step: &Step<'_>,
        slot: &Slot,
        span: &Span,
        &[low, high]: &Interval,
        flow: &mut Taken,
        toll: &mut Toll,
    ) {
        let samples = if high - low > LONG * step.reach { LONG_SAMPLES } else { SAMPLES };
        let length = (high - low) / samples as f64;
        for i in 0..samples {
            let z = low + (i as f64 + 0.5) * length;
            let p = slot.x + slot.n * z;
            let touched = p - slot.n * self.yield_overlap;
            let arm = touched - step.middle;
            let entry = step.swept.entry(&touched, step.reach).unwrap_or_else(|| {
                // Only after a blocked step: the deep end pays; a receding one opposes the motion.
                let moved = (step.motion.velocity + step.motion.spin.cross(&arm)) * step.motion.dt;
                let advance = span.deep_normal.dot(&moved);
                let speed = moved.norm().max(f64::MIN_POSITIVE);
                match advance > 0.0 {
                    true => Entry { normal: span.deep_normal, displacement: advance },
                    false => Entry { normal: moved / speed, displacement: speed },
                }
            });
            let (price, lateral) = self.price.of(&entry, &slot.n, step.motion, &arm);
            let energy = price * slot.area * length;
            toll.wear += energy;
            self.press(step, &entry.normal, &arm, energy / entry.displacement, &mut toll.flow);
            flow.length += length;
            flow.lateral += lateral * length;
            flow.attack += attack(&entry.normal, &slot.n, &step.motion.velocity) * length;
        }
    }

    /// A force [N] over the step along minus a face normal, with its friction.
    fn press(
        &self,
        step: &Step<'_>,
        normal: &Vector3<f64>,
        arm: &Vector3<f64>,
        force: f64,
        push: &mut Push,
    ) {
        let mut pull = -normal * force;
        if self.friction > 0.0 {
            let velocity = step.motion.velocity + step.motion.spin.cross(arm);
            let slip = velocity - normal * velocity.dot(normal);
            let speed = slip.norm();
            if speed > 0.0 {
                pull -= slip * (self.friction * force / speed);
                push.friction += self.friction * force * speed * step.motion.dt;
            }
        }
        let impulse = pull * step.motion.dt;
        push.impulse += impulse;
        push.torque += arm.cross(&impulse);
    }

    /// The spring below the deep end; returns its new compression [m].
    #[allow(clippy::too_many_arguments, reason = "one column's geometry")]
    fn squeeze(
        &self,
        step: &Step<'_>,
        slot: &Slot,
        column: &Column,
        span: &Span,
        flows: bool,
        toll: &mut Toll,
    ) -> f64 {
        let before = column.squeeze;
        let lifted = span.low + self.yield_overlap;
        let over = column.level_below(lifted) - span.low;
        let after = if flows { self.yield_overlap } else { over.clamp(0.0, self.yield_overlap) };
        if before == 0.0 && after == 0.0 {
            return 0.0;
        }
        let change = self.stored(slot.area, after) - self.stored(slot.area, before);
        let cosine = (-span.deep_normal.dot(&slot.n)).max(STEEP);
        let arm = slot.x + slot.n * span.low - step.middle;
        let mean = 0.5 * self.stiffness * slot.area * (before + after) / cosine;
        let moved = (step.motion.velocity + step.motion.spin.cross(&arm)) * step.motion.dt;
        let displacement = span.deep_normal.dot(&moved);
        let in_part = flows || before == 0.0 || after == 0.0;
        let force = if in_part && change * displacement > 0.0 {
            // Loaded or released in a part of the step: what the spring took or gave over what
            // the face advanced.
            (change / displacement).min(mean)
        } else if in_part {
            0.0
        } else {
            mean
        };
        toll.elastic += change;
        toll.stiffness += self.stiffness * slot.area / (cosine * cosine);
        self.press(step, &span.deep_normal, &arm, force, &mut toll.spring);
        after
    }

    /// Makes the trial the state; a blocked body (`share` < 1) takes only that share.
    pub(crate) fn commit(&mut self, surface: &mut Surface, share: f64, toll: &Toll, dt: f64) {
        let removal = surface.laws.removal.clone();
        let columns = self.candidates.slots.iter().zip(&mut self.columns);
        for ((slot, column), cut) in columns.zip(&self.cuts) {
            column.squeeze = cut.squeeze;
            for piece in cut.pieces.iter() {
                let total = share * (piece[1] - piece[0]);
                let broken = column.dig(piece, share);
                surface.sink(slot.id, total + broken);
                let worn = &mut surface.worn;
                worn.lateral += slot.area * total * cut.lateral;
                worn.normal += slot.area * total * (1.0 - cut.lateral);
                worn.chip += slot.area * broken;
                worn.removed += slot.area * (total * removed_share(&removal, cut.attack) + broken);
            }
        }
        let worn = &mut surface.worn;
        let force = (toll.flow.impulse + toll.spring.impulse) / dt;
        worn.peak_normal_force = worn.peak_normal_force.max(force.norm());
        worn.peak_touching = worn.peak_touching.max(toll.touching);
        worn.indented_area = worn.indented_area.max(toll.flow_area);
    }

    /// End of a contact: overhangs break off, unpaid.
    pub(crate) fn end_contact(&mut self, surface: &mut Surface) {
        for (slot, column) in self.candidates.slots.iter().zip(&mut self.columns) {
            let standing = column.standing();
            if standing > 0.0 {
                surface.sink(slot.id, standing);
                surface.worn.chip += slot.area * standing;
                surface.worn.removed += slot.area * standing;
            }
            *column = Column::default();
        }
        self.candidates.forget();
    }
}

/// Sums over the pieces taken from a column, weighted by their lengths.
#[derive(Clone, Copy, Debug, Default)]
struct Taken {
    length: f64,
    lateral: f64,
    attack: f64,
}

/// Sine of the angle at which a face attacks in its sliding direction.
fn attack(normal: &Vector3<f64>, n: &Vector3<f64>, velocity: &Vector3<f64>) -> f64 {
    let tangential = velocity - n * velocity.dot(n);
    normal.dot(&tangential) / tangential.norm().max(f64::MIN_POSITIVE)
}
