//! One column in one step of the swept rule: what is taken, which face pays, what the spring does.

use nalgebra::{Point3, Vector3};

use crate::candidates::Slot;
use crate::column::{Column, Interval, Pieces};
use crate::damping::{Shear, Sprung};
use crate::elastic::coefficient;
use crate::laws::{ElasticLaw, FlowLaw};
use crate::node_law::{Motion, STEEP};
use crate::price::Price;
use crate::shape::Shape;
#[cfg(feature = "state")]
use crate::state::{Fault, not_negative, positive, require};
use crate::surface::Surface;
use crate::sweep::{Entry, Span, Swept};
use crate::toll::{Push, Toll};

/// Midpoints at which a removed piece is charged, and for a piece longer than `LONG` steps.
const SAMPLES: usize = 2;
const LONG_SAMPLES: usize = 4;
const LONG: f64 = 3.0;

/// Laws of a body on the columns of a surface.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct ColumnLaw {
    price: Price,
    /// k_w [Pa/m]; infinite without springs.
    stiffness: f64,
    /// g_y = H / k_w [m]; zero without springs. Of a node it is that times its factor.
    material_overlap: f64,
    /// g_y of the softest node [m].
    pub yield_overlap: f64,
    /// K / H [1/Pa] of Archard's law; zero without it.
    wear_rate: f64,
}

/// What a column needs to know of the step.
pub(crate) struct Step<'a> {
    pub swept: &'a Swept,
    pub motion: &'a Motion,
    /// Mid-step centre of mass.
    pub middle: Point3<f64>,
    /// Displacement of the fastest point [m].
    pub reach: f64,
    /// Unit tangential direction of the motion over the column; zero at rest.
    pub heading: Vector3<f64>,
    /// How far below the column's node the material is its own [m].
    pub own: f64,
}

/// A step's trial on a column.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Cut {
    /// The column, by its place in the list.
    pub index: u32,
    /// The body left the spring sideways.
    pub lost: bool,
    /// Solid that the body swept.
    pub pieces: Pieces,
    /// Share of their length swept sideways, and the sine of the angle of attack.
    pub lateral: f64,
    pub attack: f64,
    /// Compression of the spring at the end [m], and before Archard's law lets it down.
    pub squeeze: f64,
    pub pressed: f64,
    /// Height that Archard's law takes from the solid below the deep end, and where that begins [m].
    pub archard: f64,
    pub level: f64,
}

/// Sums over the pieces taken from a column, weighted by their lengths.
#[derive(Clone, Copy, Debug, Default)]
struct Taken {
    length: f64,
    lateral: f64,
    attack: f64,
    /// Way that their faces slid over them times their force [N m], for Archard's law.
    rubbed: f64,
}

impl ColumnLaw {
    pub(crate) fn new(shape: &Shape, surface: &Surface) -> Self {
        let laws = &surface.laws;
        let material = &laws.material;
        let stiffness = match laws.elastic {
            ElasticLaw::Rigid => f64::INFINITY,
            ElasticLaw::Foundation { .. } | ElasticLaw::HertzNodes { .. } => {
                shape.pieces().iter().map(|p| coefficient(surface, p)).fold(0.0, f64::max)
            }
        };
        let shear_hardness = match laws.flow {
            FlowLaw::CapozzaHanley { .. } => Some(material.shear_ratio * material.hardness),
            FlowLaw::NormalPressure {} => None,
        };
        let (hardness, friction) = (material.hardness, material.friction);
        Self {
            price: Price { hardness, shear_hardness, friction },
            stiffness,
            material_overlap: hardness / stiffness,
            yield_overlap: surface.least_hardness() / stiffness,
            wear_rate: laws.archard.as_ref().map_or(0.0, |archard| archard.rate(material)),
        }
    }

    /// Overlap at which a node yields [m].
    #[inline]
    fn yield_overlap_of(&self, slot: &Slot) -> f64 {
        self.material_overlap * slot.factor
    }

    /// Energy of a spring under a column of `area` [m2] [J].
    pub(crate) fn stored(&self, area: f64, squeeze: f64) -> f64 {
        if squeeze > 0.0 { 0.5 * self.stiffness * area * squeeze * squeeze } else { 0.0 }
    }

    /// True if faces rub.
    pub(crate) fn rubs(&self) -> bool {
        self.price.friction > 0.0
    }

    /// True if the law asks for the heading.
    pub(crate) fn heads(&self) -> bool {
        self.price.shear_hardness.is_some()
    }

    /// True if what slides wears.
    pub(crate) fn wears(&self) -> bool {
        self.wear_rate > 0.0
    }

    /// One column in one step; None where nothing changes. `RUBS`, `HEADS` and `WEARS`: whether faces
    /// rub, whether the heading counts, and whether what slides wears.
    #[inline]
    pub(crate) fn sweep<const RUBS: bool, const HEADS: bool, const WEARS: bool>(
        &self,
        step: &Step<'_>,
        slot: &Slot,
        column: &Column,
        toll: &mut Toll,
    ) -> Option<Cut> {
        let Some(span) = step.swept.span(&slot.x, &slot.n, step.own) else {
            // The body left sideways: what the spring still held pushes nobody.
            let stored = self.stored(slot.area, column.squeeze);
            toll.elastic -= stored;
            toll.lost += stored;
            return (column.squeeze > 0.0).then(|| Cut { lost: true, ..Cut::default() });
        };
        // With springs the body sweeps as if lifted by the yield overlap.
        let yield_overlap = self.yield_overlap_of(slot);
        let (low, high) = (span.low + yield_overlap, span.high + yield_overlap);
        if span.low >= -column.open_depth() && column.squeeze == 0.0 {
            return None;
        }
        let mut cut = Cut::default();
        let mut flow = Taken::default();
        if low < 0.0 {
            cut.pieces = column.solid(low.max(-step.own), high);
            for piece in cut.pieces.iter() {
                self.charge::<RUBS, HEADS, WEARS>(step, slot, &span, piece, &mut flow, toll);
            }
        }
        let flows = flow.length > 0.0;
        if yield_overlap > 0.0 {
            let level = if flows { low } else { column.level_below(low) };
            let after = match flows {
                // The deep end lies in the material of other columns.
                _ if low < -step.own => 0.0,
                true => yield_overlap,
                false => (level - span.low).clamp(0.0, yield_overlap),
            };
            let squeezes = [column.squeeze, after];
            let force = self.squeeze::<RUBS>(step, slot, &span, squeezes, flows, toll);
            (cut.squeeze, cut.pressed) = (after, after);
            if WEARS {
                let arm = slot.x + slot.n * span.low - step.middle;
                let rubbed = flow.rubbed + force * slide(step, &span.deep_normal, &arm);
                let own = (level + step.own).max(0.0);
                cut.archard = self.wear(slot, squeezes, rubbed).min(own);
                cut.level = level;
                cut.squeeze = (after - cut.archard).max(0.0);
                let worn_off = self.stored(slot.area, after) - self.stored(slot.area, cut.squeeze);
                toll.elastic -= worn_off;
                toll.archard += worn_off;
            }
        }
        if flows {
            if HEADS {
                cut.lateral = flow.lateral / flow.length;
                cut.attack = flow.attack / flow.length;
            }
            toll.flow_area += slot.area / (-span.deep_normal.dot(&slot.n)).max(STEEP);
        }
        let touches = flows || cut.pressed > 0.0;
        toll.touching += usize::from(touches);
        (touches || column.squeeze > 0.0).then_some(cut)
    }

    /// Charges the removal of the piece between `low` and `high` of a column.
    #[inline]
    fn charge<const RUBS: bool, const HEADS: bool, const WEARS: bool>(
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
            let touched = slot.x + slot.n * (z - self.yield_overlap_of(slot));
            let arm = touched - step.middle;
            let entry = step
                .swept
                .entry(&touched, step.reach)
                .unwrap_or_else(|| blocked_entry(&way(step, &arm), &span.deep_normal));
            let (price, lateral) = match HEADS {
                true => self.price.of(&entry, &slot.n, step, &arm),
                false => (self.price.hardness, 0.0),
            };
            let energy = price * slot.factor * slot.area * length;
            toll.wear += energy;
            let force = energy / entry.displacement;
            let impulse = self.press::<RUBS>(step, &entry.normal, &arm, force, &mut toll.flow);
            toll.flow.normal += impulse.dot(&slot.n);
            flow.length += length;
            if WEARS {
                flow.rubbed += force * slide(step, &entry.normal, &arm);
            }
            if HEADS {
                flow.lateral += lateral * length;
                flow.attack += entry.normal.dot(&step.heading) * length;
            }
        }
    }

    /// A force [N] over the step along minus a face normal, with its friction. Returns its impulse [N s].
    #[inline]
    fn press<const RUBS: bool>(
        &self,
        step: &Step<'_>,
        normal: &Vector3<f64>,
        arm: &Vector3<f64>,
        force: f64,
        push: &mut Push,
    ) -> Vector3<f64> {
        let mut pull = -normal * force;
        if RUBS {
            let friction = self.price.friction;
            let slip = slip(step, normal, arm);
            let speed = slip.norm();
            if speed > 0.0 {
                pull -= slip * (friction * force / speed);
                push.friction += friction * force * speed * step.motion.dt;
            }
        }
        let impulse = pull * step.motion.dt;
        push.impulse += impulse;
        push.torque += arm.cross(&impulse);
        impulse
    }

    /// The spring below the deep end, compressed from `before` to `after` [m]. Returns its force in
    /// the mean over the step [N].
    fn squeeze<const RUBS: bool>(
        &self,
        step: &Step<'_>,
        slot: &Slot,
        span: &Span,
        [before, after]: [f64; 2],
        flows: bool,
        toll: &mut Toll,
    ) -> f64 {
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
        let force = match (in_part, change * displacement > 0.0) {
            // Loaded or released in a part of the step: what the spring took or gave over what
            // the face advanced.
            (true, true) => (change / displacement).min(mean),
            (true, false) => 0.0,
            (false, _) => mean,
        };
        toll.elastic += change;
        toll.stiffness += self.stiffness * slot.area / (cosine * cosine);
        let impulse = self.press::<RUBS>(step, &span.deep_normal, &arm, force, &mut toll.spring);
        toll.spring.normal += impulse.dot(&slot.n);
        force
    }

    /// What Archard's law takes from a column [m] for the `rubbed` way of forces on it [N m]: no more
    /// than its spring was pressed in, which bounds the slip of a step in which all of it counts to 2 g_y /
    /// K. The force is that of the whole step, before the loss.
    fn wear(&self, slot: &Slot, [before, after]: [f64; 2], rubbed: f64) -> f64 {
        let loss = self.wear_rate / slot.factor * rubbed / slot.area;
        loss.min(before.max(after))
    }
}

impl ColumnLaw {
    /// The spring under a column's deep end, compressed along the normal from the first to the
    /// second of `squeezes` [m], as its dashpot sees it.
    pub(crate) fn pressed(
        &self,
        slot: &Slot,
        span: &Span,
        arm: Vector3<f64>,
        squeezes: [f64; 2],
    ) -> Sprung {
        let cosine = (-span.deep_normal.dot(&slot.n)).max(STEEP);
        let [before, after] = squeezes;
        Sprung {
            normal: span.deep_normal,
            arm,
            cosine,
            force: 0.5 * self.stiffness * slot.area * (before + after) / cosine,
            // Work of the force: what the spring took.
            advance: (after - before) * cosine,
            cap: self.price.hardness * slot.factor * slot.area / cosine,
            stored: squeezes.map(|squeeze| self.stored(slot.area, squeeze)),
            stiffness: self.stiffness * slot.area / (cosine * cosine),
            shear: Shear::default(),
        }
    }
}

#[cfg(feature = "bench")]
impl ColumnLaw {
    /// k_w [Pa/m].
    pub(crate) fn stiffness(&self) -> f64 {
        self.stiffness
    }
}

/// Velocity of a face of `normal` at `arm` along itself [m/s].
#[inline]
fn slip(step: &Step<'_>, normal: &Vector3<f64>, arm: &Vector3<f64>) -> Vector3<f64> {
    let velocity = step.motion.velocity + step.motion.spin.cross(arm);
    velocity - normal * velocity.dot(normal)
}

/// Way of a face of `normal` at `arm` along itself [m].
#[inline]
fn slide(step: &Step<'_>, normal: &Vector3<f64>, arm: &Vector3<f64>) -> f64 {
    slip(step, normal, arm).norm() * step.motion.dt
}

/// Way of a point of the body at `arm` over the step [m].
#[inline]
fn way(step: &Step<'_>, arm: &Vector3<f64>) -> Vector3<f64> {
    (step.motion.velocity + step.motion.spin.cross(arm)) * step.motion.dt
}

/// Only after a blocked step: the deep end pays; a receding one opposes the motion. Where there is
/// none nothing can pay, whatever the force.
fn blocked_entry(moved: &Vector3<f64>, deep_normal: &Vector3<f64>) -> Entry {
    let advance = deep_normal.dot(moved);
    if advance > 0.0 {
        return Entry { normal: *deep_normal, displacement: advance };
    }
    let length = moved.norm();
    if length < f64::MIN_POSITIVE {
        return Entry { normal: *deep_normal, displacement: 1.0 };
    }
    Entry { normal: moved / length, displacement: length }
}

#[cfg(feature = "state")]
impl ColumnLaw {
    pub(crate) fn check(&self) -> Result<(), Fault> {
        let Price { hardness, shear_hardness, friction } = self.price;
        let priced = positive(hardness) && not_negative(shear_hardness.unwrap_or(0.0));
        let overlaps = [self.material_overlap, self.yield_overlap];
        let sprung = self.stiffness > 0.0 && overlaps.into_iter().all(not_negative);
        let rubbed = not_negative(self.wear_rate);
        require(
            priced && not_negative(friction) && sprung && rubbed,
            "the laws of columns are out of range",
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for a force without a direction, or without a bound, on a body that has stopped to the bit.
    #[test]
    fn what_does_not_move_enters_by_its_deep_face() {
        let down = -Vector3::z();
        let stopped = blocked_entry(&Vector3::zeros(), &down);
        assert!(stopped.normal == down && stopped.displacement >= f64::MIN_POSITIVE);
        assert!((1e6 / stopped.displacement).is_finite());
        let receding = blocked_entry(&Vector3::new(3.0, 0.0, 4.0), &down);
        assert_eq!(receding.normal, Vector3::new(0.6, 0.0, 0.8));
        assert_eq!(receding.displacement, 5.0);
    }
}
