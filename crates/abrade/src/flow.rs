//! Flow part: which node sinks, and by how much.

use nalgebra::Vector3;

use crate::elastic::Elastic;
use crate::node_law::{Advance, Drop, Excess, Loaded, NodeStep, STEEP, Spring};
use crate::query::Query;

/// A flow law.
pub(crate) trait Flow {
    /// True where the pressure alone moves the node: what friction does on the way down then counts
    /// as friction, not as wear.
    const FACE_PRESSURE: bool;

    /// True where the body's heading counts.
    const HEADS: bool;

    /// The law of a node whose hardness is `factor` times that of the material.
    fn times(&self, factor: f64) -> Self;

    /// The drop of a node in one step and the node after it.
    fn flow<E: Elastic, Q: Query>(
        &self,
        node: &NodeStep<'_, E, Q>,
        start: &Loaded,
        advance: &Advance,
        old: &Spring,
    ) -> (Drop, Loaded);

    /// Loads less their caps; their signs over a step tell how long the gates were open.
    fn excess(&self, area: f64, loaded: &Loaded) -> Excess;
}

/// Geometry of the lateral drop.
pub(crate) trait LateralGeometry {
    /// Cosine by which the effective area a_i = a_s / c grows (Eq. A.1).
    fn area_cosine(loaded: &Loaded) -> f64;

    /// Lateral advance of the step down the normal [m], of a node that the normal flow takes down by
    /// `sinking` [m]; of directions the body's heading and the node's normal.
    fn advance(
        start: &Loaded,
        advance: &Advance,
        directions: [&Vector3<f64>; 2],
        sinking: f64,
    ) -> f64;
}

/// Exact and signed: what the normal part does not explain of the advance.
pub(crate) struct Projected;

/// Eq. 5 and Eq. A.1 to the letter.
pub(crate) struct Eq5;

impl LateralGeometry for Projected {
    #[inline(always)]
    fn area_cosine(loaded: &Loaded) -> f64 {
        loaded.cosine
    }

    #[inline(always)]
    fn advance(start: &Loaded, advance: &Advance, [_, n]: [&Vector3<f64>; 2], _: f64) -> f64 {
        let m = start.touch.contact_normal;
        let along = advance.step.dot(n);
        let lateral = if advance.was_in_contact {
            advance.overlap_change / start.cosine + along
        } else {
            advance.share * m.dot(&(advance.step - n * along)) / start.cosine
        };
        lateral.max(0.0)
    }
}

impl LateralGeometry for Eq5 {
    #[inline(always)]
    fn area_cosine(loaded: &Loaded) -> f64 {
        loaded.touch.literal_cosine
    }

    #[inline(always)]
    fn advance(
        start: &Loaded,
        advance: &Advance,
        [heading, n]: [&Vector3<f64>; 2],
        sinking: f64,
    ) -> f64 {
        // h_i: r - h_i is the height of the body's centre above the node. It is taken in the middle
        // of the step, as far as rise and sinking change it; the drop itself is exact: so the volume
        // converges with the square of the step.
        let r = start.touch.radius;
        let rise = advance.share * advance.step.dot(n);
        let above = r * start.touch.literal_cosine - 0.5 * (rise - sinking);
        let half_chord = (r * r - above * above).max(0.0).sqrt();
        let dx = (advance.share * advance.step.dot(heading)).max(0.0).min(half_chord);
        (above * above + (2.0 * half_chord - dx) * dx).sqrt() - above
    }
}

/// Capozza & Hanley (2022): two gates, Eqs. 7-9.
pub(crate) struct CapozzaHanley<L> {
    pub hardness: f64,
    /// H_l = mu_a H [Pa].
    pub shear_hardness: f64,
    pub lateral: std::marker::PhantomData<L>,
}

impl<L: LateralGeometry> CapozzaHanley<L> {
    #[inline(always)]
    fn effective_area(area: f64, loaded: &Loaded) -> f64 {
        area / L::area_cosine(loaded).max(STEEP)
    }
}

impl<L: LateralGeometry> Flow for CapozzaHanley<L> {
    const FACE_PRESSURE: bool = false;
    const HEADS: bool = true;

    #[inline(always)]
    fn times(&self, factor: f64) -> Self {
        let (hardness, shear_hardness) = (self.hardness * factor, self.shear_hardness * factor);
        Self { hardness, shear_hardness, lateral: self.lateral }
    }

    #[inline(always)]
    fn flow<E: Elastic, Q: Query>(
        &self,
        node: &NodeStep<'_, E, Q>,
        start: &Loaded,
        advance: &Advance,
        old: &Spring,
    ) -> (Drop, Loaded) {
        if start.cosine <= STEEP || start.normal_load <= 0.0 {
            return (Drop::default(), *start);
        }
        let lateral_excess = |k: &Loaded| self.excess(node.area, k).lateral;
        let normal_excess = |k: &Loaded| self.excess(node.area, k).normal;
        let g = self.excess(node.area, start);
        let before = match advance.was_in_contact {
            true => old.excess,
            false => {
                let (normal, lateral) = (start.normal_load, start.lateral_load);
                Excess { normal: g.normal - normal, lateral: g.lateral - lateral }
            }
        };
        // How far the gates let the node sink, each while it is open. The bound is the law: a node
        // sinks with the body, never ahead of it.
        let normal_limit = |excess: f64| {
            let share = advance.share * open_share(before.normal, excess);
            (-share * advance.step.dot(&node.n)).max(0.0)
        };
        // An open gate whose excess falls of itself does not hold the node back: it closes.
        let closes = before.lateral > 0.0 && g.lateral < before.lateral;
        let open = if closes { 1.0 } else { open_share(before.lateral, g.lateral) };
        let lateral_limit = match open > 0.0 {
            true => {
                let directions = [&node.heading, &node.n];
                let way = L::advance(start, advance, directions, normal_limit(g.normal));
                (open * way).max(0.0)
            }
            false => 0.0,
        };
        let sink_down = |from: f64, at: &Loaded| {
            let excess = normal_excess(at);
            match excess > 0.0 {
                true => node.sink([from, normal_limit(excess)], at, at.normal_load, normal_excess),
                false => (0.0, *at),
            }
        };
        // Friction may pull a node up as it sinks aside: one that nothing presses any more stays.
        let while_pressed =
            |from: f64, at: &Loaded, (drop, now): (f64, Loaded)| match now.normal_load < 0.0 {
                true => node.sink([from, drop], at, at.normal_load, |k| k.normal_load),
                false => (drop, now),
            };
        let sink_aside = |from: f64, at: &Loaded| {
            let sunk = node.sink([from, lateral_limit], at, at.lateral_load, lateral_excess);
            while_pressed(from, at, sunk)
        };
        let is_yielding = lateral_limit > 0.0 && !closes;
        let (lateral, now) = match lateral_limit > 0.0 {
            true if closes => {
                let sunk = close(node, lateral_limit, before.lateral, lateral_excess);
                while_pressed(0.0, start, sunk)
            }
            true => sink_aside(0.0, start),
            false => (0.0, *start),
        };
        let (normal, now) = sink_down(lateral, &now);
        if is_yielding && normal > 0.0 && lateral_excess(&now) < 0.0 {
            // The way down relieves the lateral load as well: that gate has but the rest to do.
            let (normal, now) = sink_down(0.0, start);
            let (lateral, now) = match lateral_excess(&now) > 0.0 {
                true => sink_aside(normal, &now),
                false => (0.0, now),
            };
            return (Drop { normal, lateral, archard: 0.0 }, now);
        }
        (Drop { normal, lateral, archard: 0.0 }, now)
    }

    #[inline(always)]
    fn excess(&self, area: f64, loaded: &Loaded) -> Excess {
        let area = Self::effective_area(area, loaded);
        Excess {
            normal: loaded.normal_load - area * self.hardness,
            lateral: loaded.lateral_load - area * self.shear_hardness,
        }
    }
}

/// Drop of a node that a gate lets sink by `limit` [m] in the step until its excess, which was `before`
/// at the start, has fallen to zero, and the node after it.
#[inline(always)]
fn close<E: Elastic, Q: Query>(
    node: &NodeStep<'_, E, Q>,
    limit: f64,
    before: f64,
    excess: impl Fn(&Loaded) -> f64,
) -> (f64, Loaded) {
    let end = node.at(limit);
    let after = excess(&end);
    if after >= 0.0 {
        return (limit, end);
    }
    let drop = limit * open_share(before, after);
    (drop, node.at(drop))
}

/// Share of the step over which a gate was open: its excess taken as linear in time.
#[inline(always)]
fn open_share(before: f64, after: f64) -> f64 {
    match (before >= 0.0, after > 0.0) {
        (true, true) => 1.0,
        (false, true) => after / (after - before),
        (_, false) if before > 0.0 => before / (before - after),
        _ => 0.0,
    }
}

/// Pressure H normal to the face: one gate on F = a_s H / c, no lateral part.
pub(crate) struct NormalPressure {
    pub hardness: f64,
}

impl Flow for NormalPressure {
    const FACE_PRESSURE: bool = true;
    const HEADS: bool = false;

    #[inline(always)]
    fn times(&self, factor: f64) -> Self {
        Self { hardness: self.hardness * factor }
    }

    #[inline(always)]
    fn flow<E: Elastic, Q: Query>(
        &self,
        node: &NodeStep<'_, E, Q>,
        start: &Loaded,
        _: &Advance,
        _: &Spring,
    ) -> (Drop, Loaded) {
        // A face too steep to push the node down stops it: it sinks no farther than to there.
        let excess = |k: &Loaded| match k.cosine > STEEP {
            true => k.normal_force - node.area * self.hardness / k.cosine,
            false => -k.normal_force,
        };
        if excess(start) <= 0.0 {
            return (Drop::default(), *start);
        }
        // No bound by the advance: H per volume is the law, also where the face turns on a node.
        let out_of_contact = start.touch.overlap / start.cosine;
        let mut sunk = node.sink([0.0, out_of_contact], start, start.normal_force, excess);
        if Q::HAS_PIECES && is_of_another_piece(start, &sunk) {
            sunk = sink_to_another_piece(node, start, out_of_contact, excess);
        }
        let (normal, now) = sunk;
        (Drop { normal, ..Drop::default() }, now)
    }

    #[inline(always)]
    fn excess(&self, area: f64, loaded: &Loaded) -> Excess {
        let normal = loaded.normal_force * loaded.cosine - area * self.hardness;
        Excess { normal, lateral: 0.0 }
    }
}

/// Share of an overlap by which it may be rounded.
const OVERLAP_ROUNDING: f64 = 1e-6;
/// Bisections of the way down to another piece.
const PIECE_STEPS: usize = 40;

/// True where another piece than at `start` holds a node that has sunk by a drop [m]: from a ball or a
/// face it gets away at least as fast as at first.
#[inline(always)]
fn is_of_another_piece(start: &Loaded, (drop, now): &(f64, Loaded)) -> bool {
    let most = start.touch.overlap * (1.0 + OVERLAP_ROUNDING) - start.cosine * drop;
    now.touch.overlap > most
}

/// The largest drop within `limit` [m] before which `excess` is above zero and no other piece of the
/// body comes upon the node, and the node after it.
#[inline(never)]
fn sink_to_another_piece<E: Elastic, Q: Query>(
    node: &NodeStep<'_, E, Q>,
    start: &Loaded,
    limit: f64,
    excess: impl Fn(&Loaded) -> f64,
) -> (f64, Loaded) {
    let (mut sunk, mut high) = ((0.0, *start), limit);
    for _ in 0..PIECE_STEPS {
        let drop = 0.5 * (sunk.0 + high);
        let next = (drop, node.at(drop));
        if excess(&next.1) > 0.0 && !is_of_another_piece(start, &next) {
            sunk = next;
        } else {
            high = drop;
        }
    }
    sunk
}

#[cfg(test)]
mod tests;
