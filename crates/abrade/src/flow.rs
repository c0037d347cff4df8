//! Flow part: which node sinks, and by how much.

use nalgebra::Vector3;

use crate::elastic::Elastic;
use crate::node_law::{Advance, Drop, Loaded, NodeStep, STEEP, Spring};
use crate::query::Query;

/// A flow law.
pub(crate) trait Flow {
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

    /// Lateral load less its cap [N]; its sign over a step tells how long the gate was open.
    fn lateral_excess(&self, area: f64, loaded: &Loaded) -> f64;
}

/// Geometry of the lateral drop.
pub(crate) trait LateralGeometry {
    /// Cosine by which the effective area a_i = a_s / c grows (Eq. A.1).
    fn area_cosine(loaded: &Loaded) -> f64;

    /// Lateral advance of the step down the normal [m].
    fn advance(start: &Loaded, advance: &Advance, heading: &Vector3<f64>, n: &Vector3<f64>) -> f64;
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
    fn advance(start: &Loaded, advance: &Advance, _: &Vector3<f64>, n: &Vector3<f64>) -> f64 {
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
    fn advance(start: &Loaded, advance: &Advance, heading: &Vector3<f64>, _: &Vector3<f64>) -> f64 {
        // h_i: r - h_i is the height of the body's centre above the node.
        let r = start.touch.radius;
        let above = r * start.touch.literal_cosine;
        let dx = (advance.share * advance.step.dot(heading)).max(0.0);
        let half_chord = (r * r - above * above).max(0.0).sqrt();
        (above * above + 2.0 * half_chord * dx).sqrt() - above
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
        let lateral_excess = |k: &Loaded| self.lateral_excess(node.area, k);
        let normal_excess =
            |k: &Loaded| k.normal_load - Self::effective_area(node.area, k) * self.hardness;
        let g = lateral_excess(start);
        let g_old =
            if advance.was_in_contact { old.lateral_excess } else { g - start.lateral_load };
        let open = open_share(g_old, g);
        let mut lateral = 0.0;
        let mut now = *start;
        if open > 0.0 {
            let limit = open * L::advance(start, advance, &node.heading, &node.n);
            if limit > 0.0 {
                (lateral, now) = match g > 0.0 {
                    true => node.sink([0.0, limit], start, start.lateral_load, lateral_excess),
                    false => (limit, node.at(limit)),
                };
            }
        }
        let mut normal = 0.0;
        if normal_excess(&now) > 0.0 {
            // The bound is the law: a node sinks with the body, never ahead of it.
            let limit = (-advance.share * advance.step.dot(&node.n)).max(0.0);
            (normal, now) = node.sink([lateral, limit], &now, now.normal_load, normal_excess);
        }
        (Drop { normal, lateral }, now)
    }

    #[inline(always)]
    fn lateral_excess(&self, area: f64, loaded: &Loaded) -> f64 {
        loaded.lateral_load - Self::effective_area(area, loaded) * self.shear_hardness
    }
}

/// Share of the step over which the lateral gate was open: its excess taken as linear in time.
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
        let excess = |k: &Loaded| k.normal_force - node.area * self.hardness / k.cosine.max(STEEP);
        if start.cosine <= STEEP || excess(start) <= 0.0 {
            return (Drop::default(), *start);
        }
        // No bound by the advance: H per volume is the law, also where the face turns on a node.
        let out_of_contact = start.touch.overlap / start.cosine;
        let (normal, now) = node.sink([0.0, out_of_contact], start, start.normal_force, excess);
        (Drop { normal, lateral: 0.0 }, now)
    }

    #[inline(always)]
    fn lateral_excess(&self, _: f64, _: &Loaded) -> f64 {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::State;
    use crate::elastic::Foundation;
    use crate::node_law::{Motion, resolve};
    use crate::query::BallQuery;
    use crate::shape::Ball;
    use nalgebra::Point3;

    const AREA: f64 = 1e-4;

    /// A unit ball whose centre is at `centre`, on a foundation of 1e3 Pa/m.
    fn ball(centre: Point3<f64>) -> BallQuery {
        let ball = Ball { centre: Point3::origin(), radius: 1.0 };
        let mut query = BallQuery::new(&ball, 1e3, 0.0);
        query.place(&State::at(centre));
        query
    }

    fn node<'a>(query: &'a BallQuery, x: Point3<f64>) -> NodeStep<'a, Foundation, BallQuery> {
        NodeStep {
            query,
            elastic: Foundation::new(0.3),
            x,
            n: Vector3::z(),
            area: AREA,
            friction: 0.0,
            jump: f64::INFINITY,
            steep: f64::NEG_INFINITY,
            heading: Vector3::zeros(),
            trial_stretch: Vector3::zeros(),
        }
    }

    /// Fails for a node that sinks too far, too little, or ahead of the body.
    #[test]
    fn a_node_under_a_ball_keeps_the_hardness_and_no_more() {
        let flow = CapozzaHanley::<Projected> {
            hardness: 1.0,
            shear_hardness: 0.25,
            lateral: Default::default(),
        };
        // Pressed in by 10 mm in one step from touch; the hardness allows 1 mm of overlap.
        let query = ball(Point3::new(0.0, 0.0, 0.99));
        let zero = Vector3::zeros();
        let motion = Motion { velocity: -Vector3::z(), spin: zero, drag: zero, dt: 0.01 };
        let answer =
            resolve(&flow, &mut node(&query, Point3::origin()), &Spring::default(), &motion);
        let spring = answer.expect("a contact").spring;
        assert!((spring.normal_load / AREA - 1.0).abs() < 1e-8);
        assert!((spring.drop.normal - 9e-3).abs() < 1e-10 && spring.drop.lateral == 0.0);
        // At half the way the body cannot have pushed it down by more than it moved itself.
        let motion = Motion { dt: 0.004, ..motion };
        let old = Spring { overlap: 6e-3, normal_load: AREA, ..Spring::default() };
        let answer = resolve(&flow, &mut node(&query, Point3::origin()), &old, &motion);
        assert_eq!(answer.expect("a contact").spring.drop.normal, 0.004);
    }

    /// Fails for an Eq. 5 that is not the drop onto the moved sphere in the plane of motion.
    #[test]
    fn eq5_is_the_exact_drop_in_the_plane_of_motion_as_the_advance_vanishes() {
        let query = ball(Point3::new(0.0, 0.0, 0.9));
        let below = |x: f64| 0.9 - (1.0 - x * x).sqrt();
        let x = 0.2;
        let start = node(&query, Point3::new(x, 0.0, below(x))).at(0.0);
        let miss = |dx: f64| {
            let advance = Advance {
                step: Vector3::new(dx, 0.0, 0.0),
                share: 1.0,
                was_in_contact: true,
                overlap_change: 0.0,
            };
            let drop = Eq5::advance(&start, &advance, &Vector3::x(), &Vector3::z());
            let exact = below(x) - below(x - dx);
            (drop / exact - 1.0).abs()
        };
        assert!(miss(1e-3) < 5e-3 && miss(1e-5) < 5e-5, "{:e} {:e}", miss(1e-3), miss(1e-5));
    }

    /// Fails for a gate that counts the closed part of a step.
    #[test]
    fn the_lateral_gate_counts_the_open_share_of_a_step() {
        let cases = [(1.0, 1.0, 1.0), (-1.0, 3.0, 0.75), (3.0, -1.0, 0.75), (-1.0, -1.0, 0.0)];
        for (before, after, share) in cases {
            assert_eq!(open_share(before, after), share, "{before} {after}");
        }
    }
}
