//! One body against one surface by the swept rule: every newly removed bit of a column is charged
//! to the face it entered through, with that face's own displacement.
//!
//! A column is dropped by the lowest face over it, but the face that did the work may be another
//! one: a steep wall or an undercut face passing over. Forces built from the deep-end face alone
//! cut for free.

#[cfg(feature = "bench")]
mod recorded;
#[cfg(test)]
mod tests;

use nalgebra::{Point3, Vector3};

use crate::body::State;
use crate::candidates::{Candidates, Slot, travel};
use crate::column::Column;
use crate::column_law::{ColumnLaw, Cut, Step};
use crate::damping::{Damping, Dashpots, damping_ratio};
use crate::laws::ElasticLaw;
use crate::node_law::Motion;
use crate::projection::Paid;
use crate::shape::Shape;
#[cfg(feature = "state")]
use crate::state::{Fault, finite, not_negative, require};
use crate::surface::Surface;
use crate::sweep::{Swept, UNMOVED};
use crate::toll::Toll;

/// Bisections of the travel after which a column may be touched.
const GAP_STEPS: usize = 6;
/// Candidates that are passed over together.
const BLOCK: usize = 16;
/// Stands for the open depth of a column with a spring under the body.
const PRESSED: f64 = -1.0;

/// Columns between one body and one surface.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "state", serde(remote = "Self"))]
pub(crate) struct Columns {
    law: ColumnLaw,
    /// zeta of the dashpots; zero without them.
    damping_ratio: f64,
    #[cfg_attr(feature = "state", serde(skip))]
    swept: Swept,
    pub(crate) candidates: Candidates,
    /// One per candidate: the column, and how deep it was open when the candidates were collected
    /// [m], or `PRESSED`.
    columns: Vec<Column>,
    opens: Vec<f64>,
    /// How far the body may move from where the candidates were collected before it can touch a
    /// column [m]; None until that is asked for.
    #[cfg_attr(feature = "state", serde(skip))]
    least_gap: Option<Gap>,
    /// Per candidate, the mark on the body's way before which it cannot come to this column [m].
    marks: Vec<f64>,
    /// The least mark of every `BLOCK` candidates, or less [m].
    #[cfg_attr(feature = "state", serde(skip))]
    dues: Vec<f64>,
    /// Where the body was before the last trial, and how long its way to there was [m].
    stood: (State, f64),
    #[cfg_attr(feature = "state", serde(skip))]
    carried: Vec<(Slot, Column)>,
    #[cfg_attr(feature = "state", serde(skip))]
    merged: Vec<Slot>,
    /// Of the last trial.
    #[cfg_attr(feature = "state", serde(skip))]
    cuts: Vec<Cut>,
    #[cfg_attr(feature = "state", serde(skip))]
    toll: Toll,
    /// Mid-step centre of mass, and impulse of the dashpots [N s].
    #[cfg_attr(feature = "state", serde(skip))]
    middle: Point3<f64>,
    #[cfg_attr(feature = "state", serde(skip))]
    damping: Vector3<f64>,
    /// Their mean force along minus the nodes' normals over it [N].
    #[cfg_attr(feature = "state", serde(skip))]
    damping_load: f64,
}

/// A least gap between a body and columns [m].
#[derive(Clone, Copy, Debug)]
struct Gap {
    most: f64,
    /// False where it may be less.
    is_exact: bool,
}

impl Columns {
    pub(crate) fn new(shape: &Shape, surface: &Surface) -> Self {
        let laws = &surface.laws;
        Self {
            law: ColumnLaw::new(shape, surface),
            damping_ratio: match laws.elastic {
                ElasticLaw::Rigid => 0.0,
                ElasticLaw::Foundation { .. } | ElasticLaw::HertzNodes { .. } => {
                    damping_ratio(laws.restitution)
                }
            },
            swept: Swept::default(),
            candidates: Candidates::default(),
            columns: Vec::new(),
            opens: Vec::new(),
            least_gap: None,
            marks: Vec::new(),
            dues: Vec::new(),
            stood: (State::at(Point3::origin()), 0.0),
            carried: Vec::new(),
            merged: Vec::new(),
            cuts: Vec::new(),
            toll: Toll::default(),
            middle: Point3::origin(),
            damping: Vector3::zeros(),
            damping_load: 0.0,
        }
    }

    pub(crate) fn damping_ratio(&self) -> f64 {
        self.damping_ratio
    }

    /// g_y of the softest node [m]; zero without springs.
    pub(crate) fn yield_overlap(&self) -> f64 {
        self.law.yield_overlap
    }

    /// Elastic energy stored now [J].
    pub(crate) fn elastic(&self) -> f64 {
        if self.yield_overlap() == 0.0 {
            return 0.0;
        }
        let columns = self.candidates.slots.iter().zip(&self.columns);
        columns.map(|(slot, column)| self.law.stored(slot.area, column.squeeze)).sum()
    }

    /// Largest depth of a node inside the body at `state` [m].
    pub(crate) fn deepest(&mut self, surface: &Surface, shape: &Shape, state: &State) -> f64 {
        self.swept.place(shape, state, state, surface.level());
        let inside = |slot: &Slot| {
            if self.swept.clearance(&slot.x, &slot.n, 0.0) > 0.0 {
                return 0.0;
            }
            let span = self.swept.span(&slot.x, &slot.n, own(surface, slot));
            span.map_or(0.0, |s| if s.high > 0.0 { -s.low } else { 0.0 })
        };
        self.candidates.slots.iter().map(inside).fold(0.0, f64::max)
    }

    /// Makes sure that the candidates cover the body at `state`, whose columns may be crossed
    /// anywhere below their nodes. What the body has left behind is let go, but for overhangs.
    pub(crate) fn cover(&mut self, surface: &Surface, shape: &Shape, state: &State, margin: f64) {
        if self.candidates.slack(shape, state) >= 0.0 {
            return;
        }
        self.swept.place(shape, state, state, surface.level());
        self.carried.clear();
        // The node knows a column that is open to its floor as well.
        let knows_more = |(slot, column): &(&Slot, &Column)| {
            let top = slot.x - slot.n * column.open_depth();
            column.squeeze > 0.0
                || column.standing() > 0.0
                || column.is_cut() && self.swept.meets(&top, &slot.n, margin, own(surface, slot))
        };
        let columns = self.candidates.slots.iter().zip(&self.columns).filter(knows_more);
        self.carried.extend(columns.map(|(slot, column)| (*slot, *column)));
        self.candidates.collect_columns(surface, shape, state, &self.swept, margin);
        self.merge();
        let slots = &self.candidates.slots;
        self.opens.clear();
        self.opens.extend(self.columns.iter().map(|column| match column.squeeze > 0.0 {
            // A spring is let go as soon as the body is past it.
            true => PRESSED,
            false => column.open_depth(),
        }));
        self.least_gap = None;
        self.marks.clear();
        self.marks.resize(slots.len(), 0.0);
        self.dues.clear();
        self.dues.resize(slots.len().div_ceil(BLOCK), 0.0);
        self.stood = (*state, 0.0);
        self.cuts.reserve(slots.len().saturating_sub(self.cuts.len()));
    }

    /// Puts the carried columns in their places between the candidates.
    fn merge(&mut self) {
        self.candidates.slots.sort_unstable_by_key(|slot| slot.id);
        self.columns.clear();
        self.merged.clear();
        let mut carried = self.carried.iter().peekable();
        for slot in &self.candidates.slots {
            while let Some((before, column)) = carried.next_if(|(next, _)| next.id < slot.id) {
                self.merged.push(*before);
                self.columns.push(*column);
            }
            let known = carried.next_if(|(next, _)| next.id == slot.id);
            let (slot, column) = known.copied().unwrap_or((*slot, Column::default()));
            self.merged.push(slot);
            self.columns.push(column);
        }
        for (slot, column) in carried {
            self.merged.push(*slot);
            self.columns.push(*column);
        }
        std::mem::swap(&mut self.candidates.slots, &mut self.merged);
    }

    /// How far the body at `state` may move before it can touch a column [m], or more than that where it is
    /// not `enough`.
    pub(crate) fn room(
        &mut self,
        surface: &Surface,
        shape: &Shape,
        state: &State,
        enough: impl Fn(f64) -> bool,
    ) -> f64 {
        let Some((at, margin)) = self.candidates.made else { return 0.0 };
        let travelled = travel(shape, &at, state);
        let left = |least: f64| (least - travelled).min(margin - travelled).max(0.0);
        let is_enough = |least: f64| enough(left(least));
        let gap = match self.least_gap {
            Some(gap) if gap.is_exact || !is_enough(gap.most) => gap,
            _ => {
                self.swept.place(shape, &at, &at, surface.level());
                *self.least_gap.insert(self.find_gap(surface, margin, is_enough))
            }
        };
        left(gap.most)
    }

    /// The least gap, of candidates that the swept body has around it, within `margin` [m]. The search ends
    /// where it is not `enough`.
    fn find_gap(&self, surface: &Surface, margin: f64, enough: impl Fn(f64) -> bool) -> Gap {
        let mut least = f64::INFINITY;
        for (slot, &open) in self.candidates.slots.iter().zip(&self.opens) {
            if open == PRESSED || least == 0.0 {
                return Gap { most: 0.0, is_exact: true };
            }
            if !enough(least) {
                return Gap { most: least, is_exact: false };
            }
            let (top, own) = (slot.x - slot.n * open, own(surface, slot));
            if self.swept.meets(&top, &slot.n, least.min(margin), own) {
                least = least.min(gap(&self.swept, &top, &slot.n, margin, own));
            } else {
                least = least.min(margin);
            }
        }
        Gap { most: least, is_exact: true }
    }

    /// Takes every column through a step; commits nothing.
    pub(crate) fn trial(
        &mut self,
        surface: &Surface,
        shape: &Shape,
        poses: [&State; 2],
        motion: &Motion,
    ) -> &Toll {
        match self.law.wears() {
            false => self.by_faces::<false>(surface, shape, poses, motion),
            true => self.by_faces::<true>(surface, shape, poses, motion),
        }
        &self.toll
    }

    fn by_faces<const WEARS: bool>(
        &mut self,
        surface: &Surface,
        shape: &Shape,
        poses: [&State; 2],
        motion: &Motion,
    ) {
        let heads = self.law.heads() || surface.laws.removal.asks_attack();
        match (self.law.rubs(), heads) {
            (false, false) => self.sweep::<false, false, WEARS>(surface, shape, poses, motion),
            (false, true) => self.sweep::<false, true, WEARS>(surface, shape, poses, motion),
            (true, false) => self.sweep::<true, false, WEARS>(surface, shape, poses, motion),
            (true, true) => self.sweep::<true, true, WEARS>(surface, shape, poses, motion),
        }
    }

    fn sweep<const RUBS: bool, const HEADS: bool, const WEARS: bool>(
        &mut self,
        surface: &Surface,
        shape: &Shape,
        [start, end]: [&State; 2],
        motion: &Motion,
    ) {
        self.swept.place(shape, start, end, surface.level());
        let mut normal = Vector3::zeros();
        let mut step = Step {
            swept: &self.swept,
            motion,
            middle: nalgebra::center(&start.position, &end.position),
            reach: (end.position - start.position).norm()
                + motion.spin.norm() * motion.dt * shape.bounding_radius(),
            heading: normal,
            own: f64::INFINITY,
        };
        self.toll = Toll::default();
        self.middle = step.middle;
        self.cuts.clear();
        let before = self.stood.1 + travel(shape, &self.stood.0, start);
        self.stood = (*start, before);
        let way = before + travel(shape, start, end);
        let blocks = self.marks.chunks_mut(BLOCK).zip(&mut self.dues).enumerate();
        for (block, (marks, due)) in blocks.filter(|(_, (_, due))| **due <= way) {
            for (index, mark) in (block * BLOCK..).zip(&mut *marks).filter(|(_, m)| **m <= way) {
                let (slot, column) = (&self.candidates.slots[index], &self.columns[index]);
                if column.squeeze == 0.0 {
                    let clear = self.swept.clearance(&slot.x, &slot.n, column.open_depth());
                    if clear > UNMOVED * step.reach {
                        // Seen from where the body stood: the step may yet be rejected.
                        *mark = (before + (clear - (way - before))).max(*mark);
                        continue;
                    }
                }
                if HEADS && (slot.n != normal || motion.drag.is_some()) {
                    normal = slot.n;
                    step.heading = motion.heading(&(slot.x - step.middle), &normal);
                }
                step.own = own(surface, slot);
                let law = &self.law;
                let cut = law.sweep::<RUBS, HEADS, WEARS>(&step, slot, column, &mut self.toll);
                self.cuts.extend(cut.map(|cut| Cut { index: index as u32, ..cut }));
            }
            *due = marks.iter().fold(f64::INFINITY, |least, mark| mark.min(least));
        }
    }

    /// Hands over every spring that the last trial pressed or let go.
    pub(crate) fn press(&self, dashpots: &mut Dashpots) {
        for cut in &self.cuts {
            let index = cut.index as usize;
            let (slot, before) = (&self.candidates.slots[index], self.columns[index].squeeze);
            let span = self.swept.span(&slot.x, &slot.n, f64::INFINITY);
            let Some(span) = span.filter(|_| !cut.lost) else { continue };
            if before != 0.0 || cut.pressed != 0.0 {
                let arm = slot.x + slot.n * span.low - self.middle;
                dashpots.add(self.law.pressed(slot, &span, arm, [before, cut.pressed]));
            }
        }
    }

    /// Counts what the dashpots do over the last trial.
    pub(crate) fn take_damping(&mut self, damping: &Damping) {
        self.damping = damping.impulse;
        self.damping_load = damping.normal_load;
    }

    /// Makes the last trial, of a step of `dt` [s], the state; of the removal of a body that is blocked only the
    /// share that it has `paid`.
    pub(crate) fn commit(&mut self, surface: &mut Surface, paid: &Paid, dt: f64) {
        let share = paid.flow.share;
        for cut in &self.cuts {
            let index = cut.index as usize;
            let (slot, column) = (&self.candidates.slots[index], &mut self.columns[index]);
            column.squeeze = cut.squeeze;
            if cut.squeeze > 0.0 {
                // The body may come back to where it was when the candidates were collected.
                (self.opens[index], self.least_gap) =
                    (PRESSED, Some(Gap { most: 0.0, is_exact: true }));
            }
            for piece in cut.pieces.iter() {
                let total = share * (piece[1] - piece[0]);
                let broken = column.dig(piece, share);
                let debris = surface.laws.removal.debris(|| cut.attack);
                surface.sink(slot.id, total + broken);
                let worn = &mut surface.gain;
                worn.lateral += slot.area * total * cut.lateral;
                worn.normal += slot.area * total * (1.0 - cut.lateral);
                worn.break_off(slot.area * broken);
                worn.take_off(slot.area * total, &debris);
            }
            if cut.archard > 0.0 {
                let broken = column.dig(&[cut.level - cut.archard, cut.level], 1.0);
                surface.sink(slot.id, cut.archard + broken);
                surface.gain.rub_off(slot.area * cut.archard);
                surface.gain.break_off(slot.area * broken);
            }
        }
        let (worn, toll) = (&mut surface.gain, &self.toll);
        let normal = toll.flow.normal * paid.flow.scale + toll.spring.normal * paid.spring;
        let normal_force = normal / dt + self.damping_load;
        worn.peak_normal_force = worn.peak_normal_force.max(normal_force);
        worn.peak_touching = worn.peak_touching.max(toll.touching);
        worn.indented_area = worn.indented_area.max(toll.flow_area);
    }

    /// Impulse of the last trial on the body [N s].
    pub(crate) fn impulse(&self) -> Vector3<f64> {
        self.toll.flow.impulse + self.toll.spring.impulse + self.damping
    }

    /// Forgets the columns, of which none stands.
    pub(crate) fn forget(&mut self) {
        self.columns.fill(Column::default());
        self.candidates.forget();
    }

    /// End of a contact: overhangs break off, unpaid.
    pub(crate) fn end_contact(&mut self, surface: &mut Surface) {
        for (slot, column) in self.candidates.slots.iter().zip(&mut self.columns) {
            let standing = column.standing();
            if standing > 0.0 {
                surface.sink(slot.id, standing);
                surface.gain.break_off(slot.area * standing);
            }
            *column = Column::default();
        }
        self.candidates.forget();
    }
}

/// How far below the place of a column at the first touch the material is its own [m].
fn own(surface: &Surface, slot: &Slot) -> f64 {
    let reach = surface.reach(slot.id);
    if reach == f64::INFINITY {
        return reach;
    }
    let worn = (surface.nodes().rest_position[slot.id as usize] - slot.x).dot(&slot.n);
    (reach - worn).max(0.0)
}

/// A travel [m], at most `margin`, within which the body cannot touch the column down along -n
/// whose solid begins at `top`.
fn gap(swept: &Swept, top: &Point3<f64>, n: &Vector3<f64>, margin: f64, reach: f64) -> f64 {
    let meets = |travel: f64| swept.meets(top, n, travel, reach);
    if !meets(margin) {
        return margin;
    }
    if meets(0.0) {
        return 0.0;
    }
    let (mut clear, mut met) = (0.0, margin);
    for _ in 0..GAP_STEPS {
        let middle = 0.5 * (clear + met);
        if meets(middle) {
            met = middle;
        } else {
            clear = middle;
        }
    }
    clear
}

#[cfg(feature = "state")]
impl Columns {
    pub(crate) fn checked(mut self) -> Result<Self, Fault> {
        self.law.check()?;
        require(not_negative(self.damping_ratio), "columns are out of range")?;
        self.candidates.check()?;
        let count = self.candidates.slots.len();
        let same = [self.columns.len(), self.opens.len(), self.marks.len()] == [count; 3];
        require(same, "columns and candidates differ in number")?;
        let open = |&open: &f64| open == PRESSED || not_negative(open);
        require(self.opens.iter().all(open), "a column is open above its node")?;
        let way = not_negative(self.stood.1) && finite(&self.marks);
        require(way, "the way of a body over columns is out of range")?;
        self.dues.resize(count.div_ceil(BLOCK), 0.0);
        Ok(self)
    }

    /// True when every candidate is one of `nodes`.
    pub(crate) fn lies_on(&self, nodes: usize) -> bool {
        self.candidates.lie_on(nodes)
    }
}
