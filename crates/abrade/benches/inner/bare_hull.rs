//! A hull on columns with springs, `Foundation` and `CapozzaHanley`, on a flat plate: the formulas
//! of a column written straight, with nothing that the case does not need. The limit for what a
//! column can cost.

use abrade::probe::{Candidate, Course, Outcome, Recording};
use abrade::{FlowLaw, Lateral, Piece, Plane, State};
use nalgebra::{Point3, Vector3};

use crate::Bare;

/// Cosine below which a face is too steep; displacement below which one did not move, in steps;
/// samples of a removed piece, and of one longer than `LONG` steps.
const STEEP: f64 = 0.05;
const UNMOVED: f64 = 1e-9;
const SAMPLES: [usize; 2] = [2, 4];
const LONG: f64 = 3.0;

pub struct BareHull {
    columns: Vec<Candidate>,
    new: Vec<Cut>,
    course: Course,
    laws: Laws,
    local: Vec<Plane>,
    planes: Vec<Moved>,
    radius: f64,
}

#[derive(Clone, Copy)]
struct Laws {
    hardness: f64,
    shear_hardness: f64,
    friction: f64,
}

/// A face at the start and the end of a step, and the end normal's part along z.
#[derive(Clone, Copy)]
struct Moved {
    from: (Vector3<f64>, f64),
    to: (Vector3<f64>, f64),
    slope: f64,
}

/// What a step does to a column.
#[derive(Clone, Copy, Default)]
struct Cut {
    index: u32,
    pieces: [[f64; 2]; 5],
    count: usize,
    lateral: f64,
    attack: f64,
    squeeze: f64,
}

/// What a step of the body needs to know: of the faces that sweep and of the springs.
#[derive(Default)]
struct Sum {
    impulse: [Vector3<f64>; 2],
    torque: [Vector3<f64>; 2],
    friction: [f64; 2],
    wear: f64,
    elastic: f64,
    stiffness: f64,
    flow_area: f64,
    touching: usize,
}

struct Step<'a> {
    planes: &'a [Moved],
    laws: Laws,
    velocity: Vector3<f64>,
    spin: Vector3<f64>,
    dt: f64,
    middle: Point3<f64>,
    reach: f64,
    heading: Vector3<f64>,
    stiffness: f64,
}

impl BareHull {
    pub fn new(recording: &Recording, i: usize) -> Self {
        let laws = recording.laws();
        assert!(laws.flow == FlowLaw::CapozzaHanley { lateral: Lateral::Projected });
        let [Piece::Hull(hull)] = recording.shape().pieces() else { panic!("not a hull") };
        let m = &laws.material;
        let columns = recording.candidates(i);
        Self {
            new: Vec::with_capacity(columns.len()),
            columns,
            course: recording.course(i),
            laws: Laws {
                hardness: m.hardness,
                shear_hardness: m.shear_ratio * m.hardness,
                friction: m.friction,
            },
            local: hull.planes().to_vec(),
            planes: Vec::with_capacity(hull.planes().len()),
            radius: recording.shape().bounding_radius(),
        }
    }
}

impl Bare for BareHull {
    #[inline(never)]
    fn run(&mut self) -> Outcome {
        let Self { columns, new, course, laws, local, planes, radius } = self;
        let [start, end] = &course.poses;
        planes.clear();
        planes.extend(local.iter().map(|plane| {
            let to = placed(plane, end);
            Moved { from: placed(plane, start), to, slope: to.0.z }
        }));
        let velocity = course.velocity;
        let flat = Vector3::new(velocity.x, velocity.y, 0.0);
        let step = Step {
            planes,
            laws: *laws,
            velocity,
            spin: course.spin,
            dt: course.dt,
            middle: nalgebra::center(&start.position, &end.position),
            reach: (end.position - start.position).norm()
                + course.spin.norm() * course.dt * *radius,
            heading: flat.try_normalize(0.0).unwrap_or(flat),
            stiffness: course.coefficient,
        };
        let mut sum = Sum::default();
        new.clear();
        for (index, column) in columns.iter().enumerate() {
            if column.mark > course.way {
                continue;
            }
            let mut cut = Cut { index: index as u32, ..Cut::default() };
            if step.sweep(column, &mut cut, &mut sum) {
                new.push(cut);
            }
        }
        let [flow, spring] = sum.impulse;
        let push = flow + spring;
        std::hint::black_box(&sum);
        Outcome { push, torque: sum.torque[0] + sum.torque[1], touching: sum.touching }
    }

    fn drops(&self) -> Vec<f64> {
        let mut drops = vec![0.0; self.columns.len()];
        for cut in &self.new {
            let pieces = &cut.pieces[..cut.count];
            drops[cut.index as usize] = pieces.iter().map(|[low, high]| high - low).sum();
        }
        drops
    }

    fn narrow(&mut self) {
        self.columns = self.new.iter().map(|cut| self.columns[cut.index as usize]).collect();
    }
}

fn placed(plane: &Plane, state: &State) -> (Vector3<f64>, f64) {
    let normal = state.rotation * plane.normal;
    (normal, plane.offset + normal.dot(&state.position.coords))
}

impl Step<'_> {
    /// True where something changes.
    #[inline(always)]
    fn sweep(&self, column: &Candidate, cut: &mut Cut, sum: &mut Sum) -> bool {
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        let mut deep = &self.planes[0];
        for plane in self.planes {
            let room = plane.to.1 - plane.to.0.dot(&column.x.coords);
            if plane.slope < 0.0 {
                let bound = room / plane.slope;
                if bound > low {
                    (low, deep) = (bound, plane);
                }
            } else if plane.slope > 0.0 {
                high = high.min(room / plane.slope);
            } else if room < 0.0 {
                high = f64::NEG_INFINITY;
            }
            if low >= high {
                sum.elastic -= 0.5 * self.stiffness * column.area * column.overlap.powi(2);
                return column.overlap > 0.0;
            }
        }
        let voids = &column.voids[..column.count];
        let open = match voids {
            [[low, high]] if *high >= 0.0 => *low,
            _ => 0.0,
        };
        if low >= open && column.overlap == 0.0 {
            return false;
        }
        let lift = self.laws.hardness / self.stiffness * column.factor;
        let (from, to) = (low + lift, (high + lift).min(0.0));
        let (mut length, mut lateral, mut attack) = (0.0, 0.0, 0.0);
        if from < 0.0 {
            solid(voids, from, to, cut);
            for &[low, high] in &cut.pieces[..cut.count] {
                let samples = SAMPLES[usize::from(high - low > LONG * self.reach)];
                let part = (high - low) / samples as f64;
                for i in 0..samples {
                    let z = low + (i as f64 + 0.5) * part;
                    let point = column.x + column.n * (z - lift);
                    let [side, sine] = self.charge(column, &point, part, deep, sum);
                    length += part;
                    lateral += side * part;
                    attack += sine * part;
                }
            }
        }
        let flows = length > 0.0;
        let after = match flows {
            true => lift,
            false => (level_below(voids, from) - low).clamp(0.0, lift),
        };
        if column.overlap != 0.0 || after != 0.0 {
            let point = column.x + column.n * low;
            self.squeeze(column, &point, [column.overlap, after], flows, deep, sum);
        }
        cut.squeeze = after;
        if flows {
            (cut.lateral, cut.attack) = (lateral / length, attack / length);
            sum.flow_area += column.area / (-deep.slope).max(STEEP);
        }
        let touches = flows || after > 0.0;
        sum.touching += usize::from(touches);
        touches || column.overlap > 0.0
    }

    /// Pays for a part of a column of `length` about `point`; its lateral share and the sine of the
    /// angle of attack.
    #[inline(always)]
    fn charge(
        &self,
        column: &Candidate,
        point: &Point3<f64>,
        length: f64,
        deep: &Moved,
        sum: &mut Sum,
    ) -> [f64; 2] {
        let arm = point - self.middle;
        let moved = (self.velocity + self.spin.cross(&arm)) * self.dt;
        let (m, displacement) = self.entry(point).unwrap_or_else(|| {
            let advance = deep.to.0.dot(&moved);
            if advance > 0.0 {
                return (deep.to.0, advance);
            }
            let length = moved.norm().max(f64::MIN_POSITIVE);
            (moved / length, length)
        });
        let Laws { hardness, shear_hardness, friction } = self.laws;
        let cosine = -m.dot(&column.n);
        let sine = m.dot(&self.heading);
        let (price, share) = if cosine <= STEEP {
            (shear_hardness, 1.0)
        } else {
            let split = self.velocity + m * m.dot(&self.spin.cross(&arm));
            let down = -split.dot(&column.n) * self.dt * cosine / displacement;
            let share = if sine > 0.0 { 1.0 - down.clamp(0.0, 1.0) } else { 0.0 };
            let normal = hardness / cosine;
            let lateral = (shear_hardness / (sine.max(0.0) + friction * cosine)).min(normal);
            (normal + share * (lateral - normal), share)
        };
        let energy = price * column.factor * column.area * length;
        sum.wear += energy;
        self.press(&m, &arm, &moved, energy / displacement, 0, sum);
        [share, sine]
    }

    /// The face through which `point` was entered last, and how far it moved.
    #[inline(always)]
    fn entry(&self, point: &Point3<f64>) -> Option<(Vector3<f64>, f64)> {
        let mut last: Option<(f64, &Moved, f64)> = None;
        let least = UNMOVED * self.reach;
        for plane in self.planes {
            let after = plane.to.0.dot(&point.coords) - plane.to.1;
            if after > least {
                return None;
            }
            let before = plane.from.0.dot(&point.coords) - plane.from.1;
            let displacement = before - after;
            if before > 0.0 && displacement > least {
                let time = before / displacement;
                if last.is_none_or(|(latest, ..)| time > latest) {
                    last = Some((time, plane, displacement));
                }
            }
        }
        last.map(|(_, plane, displacement)| ((plane.from.0 + plane.to.0).normalize(), displacement))
    }

    /// A force on the body against `m`, with its friction.
    #[inline(always)]
    fn press(
        &self,
        m: &Vector3<f64>,
        arm: &Vector3<f64>,
        moved: &Vector3<f64>,
        force: f64,
        whose: usize,
        sum: &mut Sum,
    ) {
        let slip = moved - m * moved.dot(m);
        let length = slip.norm();
        let mut pull = -m * force;
        let rubbed = self.laws.friction * force;
        if length > 0.0 {
            pull -= slip * (rubbed / length);
        }
        sum.friction[whose] += rubbed * length;
        let impulse = pull * self.dt;
        sum.impulse[whose] += impulse;
        sum.torque[whose] += arm.cross(&impulse);
    }

    /// The spring below the deep end at `point`.
    #[inline(always)]
    fn squeeze(
        &self,
        column: &Candidate,
        point: &Point3<f64>,
        [before, after]: [f64; 2],
        flows: bool,
        deep: &Moved,
        sum: &mut Sum,
    ) {
        let stiffness = self.stiffness * column.area;
        let change = 0.5 * stiffness * (after * after - before * before);
        let cosine = (-deep.slope).max(STEEP);
        let arm = point - self.middle;
        let moved = (self.velocity + self.spin.cross(&arm)) * self.dt;
        let displacement = deep.to.0.dot(&moved);
        let mean = 0.5 * stiffness * (before + after) / cosine;
        let force = match (flows || before == 0.0 || after == 0.0, change * displacement > 0.0) {
            (true, true) => (change / displacement).min(mean),
            (true, false) => 0.0,
            (false, _) => mean,
        };
        sum.elastic += change;
        sum.stiffness += stiffness / (cosine * cosine);
        self.press(&deep.to.0, &arm, &moved, force, 1, sum);
    }
}

/// The solid parts between `from` and `to`.
#[inline(always)]
fn solid(voids: &[[f64; 2]], from: f64, to: f64, cut: &mut Cut) {
    let mut from = from;
    let mut add = |low: f64, high: f64| {
        if high > low {
            cut.pieces[cut.count] = [low, high];
            cut.count += 1;
        }
    };
    for &[low, high] in voids {
        if high > from && low < to {
            add(from, low);
            from = high;
        }
    }
    add(from, to);
}

/// Where the solid below a body whose deep end is at `z` ends.
#[inline(always)]
fn level_below(voids: &[[f64; 2]], z: f64) -> f64 {
    match voids.iter().rev().find(|void| void[0] <= z) {
        Some([_, high]) if z > *high && *high < 0.0 => 0.0,
        Some([low, _]) => *low,
        None => 0.0,
    }
}
