//! A ball on springs, `Foundation` and `CapozzaHanley(lateral: Projected)`, on a flat plate: the
//! formulas of a node written straight, with nothing that the case does not need. The limit for
//! what a node evaluation can cost.

use abrade::probe::{Candidate, Course, Outcome, Recording};
use abrade::{FlowLaw, Lateral, Piece};
use nalgebra::Vector3;

use crate::Bare;

/// Cosine below which a face is too steep, tolerance and steps of the root.
const STEEP: f64 = 0.05;
const ROOT: f64 = 1e-9;
const ROOT_STEPS: usize = 40;

pub struct BareBall {
    nodes: Vec<Candidate>,
    new: Vec<Spring>,
    course: Course,
    laws: Laws,
    n: Vector3<f64>,
}

#[derive(Clone, Copy)]
struct Laws {
    radius: f64,
    hardness: f64,
    shear_hardness: f64,
    friction: f64,
    tangential_ratio: f64,
}

/// What a node remembers, and its drop.
#[expect(dead_code, reason = "a bare step is taken again, not gone on from")]
#[derive(Clone, Copy, Default)]
struct Spring {
    stretch: Vector3<f64>,
    overlap: f64,
    excess: [f64; 2],
    drop: f64,
    attack: f64,
}

/// A node in a step: from the centre of the ball, before it sinks, and its stretch.
struct Node {
    r: Vector3<f64>,
    n: Vector3<f64>,
    xi: Vector3<f64>,
    area: f64,
    /// Normal and tangential stiffness [N/m].
    stiffness: [f64; 2],
    heading: Vector3<f64>,
    laws: Laws,
}

#[derive(Clone, Copy)]
struct Loaded {
    m: Vector3<f64>,
    overlap: f64,
    cosine: f64,
    total: Vector3<f64>,
    stretch: Vector3<f64>,
    normal: f64,
    lateral: f64,
}

impl BareBall {
    pub fn new(recording: &Recording, i: usize) -> Self {
        let laws = recording.laws();
        assert!(laws.flow == FlowLaw::CapozzaHanley { lateral: Lateral::Projected });
        let [Piece::Ball(ball)] = recording.shape().pieces() else { panic!("not a ball") };
        let m = &laws.material;
        let nodes = recording.candidates(i);
        Self {
            new: vec![Spring::default(); nodes.len()],
            n: nodes[0].n,
            nodes,
            course: recording.course(i),
            laws: Laws {
                radius: ball.radius,
                hardness: m.hardness,
                shear_hardness: m.shear_ratio * m.hardness,
                friction: m.friction,
                tangential_ratio: 2.0 * (1.0 - m.poisson) / (2.0 - m.poisson),
            },
        }
    }
}

impl Bare for BareBall {
    #[inline(never)]
    fn run(&mut self) -> Outcome {
        let Self { nodes, new, course, laws, n } = self;
        let (centre, dt) = (course.poses[1].position, course.dt);
        let reach = laws.radius * laws.radius;
        let step = course.velocity * dt;
        let tangential = step - *n * step.dot(n);
        let heading = tangential.try_normalize(0.0).unwrap_or(tangential);
        let mut sum = Sum::default();
        for (old, new) in nodes.iter().zip(new) {
            let r: Vector3<f64> = old.x - centre;
            let square = r.norm_squared();
            if square >= reach {
                new.overlap = 0.0;
                continue;
            }
            let distance = square.sqrt();
            let m = r / distance;
            let overlap = laws.radius - distance;
            let moved = step + course.spin.cross(&m) * (laws.radius * dt);
            let approach = m.dot(&moved);
            let touched = old.overlap > 0.0;
            let share =
                if touched || approach <= 0.0 { 1.0 } else { (overlap / approach).min(1.0) };
            let slid = (moved - m * approach) * share;
            let stiffness = course.coefficient * old.area;
            let node = Node {
                r,
                n: old.n,
                xi: if touched { turned(&old.stretch, &m) + slid } else { slid },
                area: old.area,
                stiffness: [stiffness, laws.tangential_ratio * stiffness],
                heading,
                laws: Laws {
                    hardness: laws.hardness * old.factor,
                    shear_hardness: laws.shear_hardness * old.factor,
                    ..*laws
                },
            };
            let (drops, end) = node.flow(overlap, m, old, &step, share);
            sum.add(
                &node,
                &end,
                drops,
                if touched { (end.overlap - old.overlap).abs() } else { overlap },
            );
            *new = Spring {
                stretch: end.stretch,
                overlap: end.overlap,
                excess: [node.normal_excess(&end), node.lateral_excess(&end)],
                drop: drops[0] + drops[1],
                attack: m.dot(&heading),
            };
        }
        std::hint::black_box(&sum);
        Outcome { push: sum.force, torque: sum.torque * laws.radius, touching: sum.touching }
    }

    fn drops(&self) -> Vec<f64> {
        self.new.iter().map(|s| if s.overlap > 0.0 { s.drop } else { 0.0 }).collect()
    }

    fn narrow(&mut self) {
        let pairs = self.nodes.iter().zip(&self.new);
        let kept = pairs.filter(|(old, new)| old.overlap > 0.0 || new.overlap > 0.0);
        self.nodes = kept.map(|(old, _)| *old).collect();
        self.new.truncate(self.nodes.len());
    }
}

/// What a step of the body needs to know.
#[derive(Default)]
struct Sum {
    force: Vector3<f64>,
    torque: Vector3<f64>,
    stiffness: [f64; 2],
    load: f64,
    flow_area: f64,
    overlap_change: f64,
    touching: usize,
}

impl Sum {
    #[inline(always)]
    fn add(&mut self, node: &Node, end: &Loaded, drops: [f64; 2], overlap_change: f64) {
        self.force -= end.total;
        self.torque -= end.m.cross(&end.total);
        self.stiffness[0] += node.stiffness[0];
        self.stiffness[1] += node.stiffness[1];
        self.load += end.normal;
        if drops[0] > 0.0 {
            self.flow_area += node.area / end.cosine.max(STEEP);
        }
        self.overlap_change = self.overlap_change.max(overlap_change);
        self.touching += 1;
    }
}

impl Node {
    /// The node after sinking by `drop`.
    #[inline(always)]
    fn at(&self, drop: f64) -> Loaded {
        let r = self.r - self.n * drop;
        let distance = r.norm();
        self.loaded(r / distance, self.laws.radius - distance, drop)
    }

    #[inline(always)]
    fn loaded(&self, m: Vector3<f64>, overlap: f64, drop: f64) -> Loaded {
        let overlap = overlap.max(0.0);
        let force = self.stiffness[0] * overlap;
        let cosine = -m.dot(&self.n);
        let xi = self.xi + (self.n + m * cosine) * drop;
        let (pull, limit) = (self.stiffness[1] * xi.norm(), self.laws.friction * force);
        let kept = if pull > limit { limit / pull } else { 1.0 };
        let stretch = xi * kept;
        let total = m * force + stretch * self.stiffness[1];
        let (normal, lateral) = (-total.dot(&self.n), total.dot(&self.heading));
        Loaded { m, overlap, cosine, total, stretch, normal, lateral }
    }

    /// Parts of the drop, normal first, and the node after it (Eqs. 7-9).
    #[inline(always)]
    fn flow(
        &self,
        overlap: f64,
        m: Vector3<f64>,
        old: &Candidate,
        step: &Vector3<f64>,
        share: f64,
    ) -> ([f64; 2], Loaded) {
        let start = self.loaded(m, overlap, 0.0);
        if start.cosine <= STEEP || start.normal <= 0.0 {
            return ([0.0; 2], start);
        }
        let touched = old.overlap > 0.0;
        let along = step.dot(&self.n);
        let after = [self.normal_excess(&start), self.lateral_excess(&start)];
        let before = match touched {
            true => old.excess,
            false => [after[0] - start.normal, after[1] - start.lateral],
        };
        // A gate whose excess falls of itself closes, and does not hold the node back.
        let closes = before[1] > 0.0 && after[1] < before[1];
        let open = if closes { 1.0 } else { open_share(before[1], after[1]) };
        let mut limit = 0.0;
        if open > 0.0 {
            let advance = match touched {
                true => (overlap - old.overlap) / start.cosine + along,
                false => share * m.dot(&(step - self.n * along)) / start.cosine,
            };
            limit = open * advance.max(0.0);
        }
        let down = |from: f64, at: &Loaded| {
            let excess = self.normal_excess(at);
            let limit = -share * open_share(before[0], excess) * along;
            if excess <= 0.0 || limit <= 0.0 {
                return (0.0, *at);
            }
            self.sink(from, limit, at, at.normal, excess, |k| self.normal_excess(k))
        };
        let aside = |from: f64, at: &Loaded, excess: f64| {
            self.sink(from, limit, at, at.lateral, excess, |k| self.lateral_excess(k))
        };
        let (mut lateral, mut now) = (0.0, start);
        let yields = limit > 0.0 && !closes;
        if yields {
            (lateral, now) = aside(0.0, &start, after[1]);
        } else if limit > 0.0 {
            (lateral, now) = (limit, self.at(limit));
            let excess = self.lateral_excess(&now);
            if excess < 0.0 {
                lateral = limit * open_share(before[1], excess);
                now = self.at(lateral);
            }
        }
        let mut normal;
        (normal, now) = down(lateral, &now);
        if yields && normal > 0.0 && self.lateral_excess(&now) < 0.0 {
            (normal, now) = down(0.0, &start);
            let excess = self.lateral_excess(&now);
            lateral = 0.0;
            if excess > 0.0 {
                (lateral, now) = aside(normal, &now, excess);
            }
        }
        ([normal, lateral], now)
    }

    #[inline(always)]
    fn lateral_excess(&self, k: &Loaded) -> f64 {
        k.lateral - self.area * self.laws.shear_hardness / k.cosine.max(STEEP)
    }

    #[inline(always)]
    fn normal_excess(&self, k: &Loaded) -> f64 {
        k.normal - self.area * self.laws.hardness / k.cosine.max(STEEP)
    }

    /// The drop within `limit` that brings an excess to zero, by secants between brackets.
    #[inline(always)]
    fn sink(
        &self,
        from: f64,
        limit: f64,
        start: &Loaded,
        load: f64,
        excess: f64,
        of: impl Fn(&Loaded) -> f64,
    ) -> (f64, Loaded) {
        let slope = load * start.cosine / start.overlap;
        let tolerance = ROOT * (excess + slope * limit);
        let (mut low, mut high, mut last) = (0.0, limit, (0.0, excess));
        let mut drop = (excess / slope).min(limit);
        let mut at = self.at(from + drop);
        let mut asked = false;
        for _ in 0..ROOT_STEPS {
            let g = of(&at);
            if g.abs() <= tolerance || (g > 0.0 && drop == limit) {
                break;
            }
            let secant = drop - g * (drop - last.0) / (g - last.1);
            last = (drop, g);
            *(if g > 0.0 { &mut low } else { &mut high }) = drop;
            drop = match (secant > low && secant < high, asked) {
                (true, _) => secant,
                (false, false) => limit,
                (false, true) => 0.5 * (low + high),
            };
            asked |= drop == limit;
            at = self.at(from + drop);
        }
        (drop, at)
    }
}

/// Share of the step over which a gate was open.
#[inline(always)]
fn open_share(before: f64, after: f64) -> f64 {
    match (before >= 0.0, after > 0.0) {
        (true, true) => 1.0,
        (false, true) => after / (after - before),
        (_, false) if before > 0.0 => before / (before - after),
        _ => 0.0,
    }
}

/// The stretch turned into the tangent plane of `m`, its length kept.
#[inline(always)]
fn turned(stretch: &Vector3<f64>, m: &Vector3<f64>) -> Vector3<f64> {
    let flat = stretch - m * stretch.dot(m);
    let new = flat.norm();
    if new > 0.0 { flat * (stretch.norm() / new) } else { flat }
}
