//! What the runs of a study are compared by.

use std::collections::BTreeMap;

use abrade_report::Summary;
use abrade_report::summary::BodySummary;

/// The results of a run that are compared, or their means over several.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Quantities {
    /// Wear volume of all surfaces [m3].
    pub wear: f64,
    /// Largest depth of a node of any surface [m].
    pub depth: f64,
    /// Largest normal force that a surface bore [N].
    pub force: f64,
    /// Wear volume per sliding distance of driven bodies [m2].
    pub rate: Option<f64>,
    /// The bodies, by their names.
    pub bodies: BTreeMap<String, BodyQuantities>,
}

/// How a body left.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyQuantities {
    /// Speed after over speed before [-].
    pub restitution: Option<f64>,
    /// Angle of the velocity from the surface [deg].
    pub angle: Option<f64>,
    /// Angular velocity [rad/s].
    pub spin: Option<[f64; 3]>,
    /// Speed [m/s].
    pub speed: f64,
    /// Radius of the ball around it [m].
    pub reach: f64,
}

/// Differences of a run from the reference, none below zero; `None` where either has no such
/// quantity, or the reference's is zero.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Errors {
    /// Of the wear volume, relative [-].
    pub wear: Option<f64>,
    /// Of the largest depth, relative [-].
    pub depth: Option<f64>,
    /// Of the peak force, relative [-].
    pub force: Option<f64>,
    /// Of the wear per sliding distance, relative [-].
    pub rate: Option<f64>,
    /// Of the restitution [-]; of several bodies the largest, as of the two below.
    pub restitution: Option<f64>,
    /// Of the rebound angle [deg].
    pub angle: Option<f64>,
    /// Of the spin, as speeds of the body's rim over its speed before [-].
    pub spin: Option<f64>,
}

/// Number of errors of a run.
pub(crate) const COUNT: usize = 7;
/// Their columns in tables.
pub(crate) const NAMES: [&str; COUNT] =
    ["wear", "depth", "force", "rate", "restitution", "angle_deg", "spin"];

impl Quantities {
    /// Of a finished run; `reaches` are the radii of its bodies, by their names [m].
    pub(crate) fn of(summary: &Summary, reaches: &BTreeMap<String, f64>) -> Self {
        let surfaces = || summary.surfaces.values();
        let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
        let body = |(name, body): (&String, &BodySummary)| {
            let quantities = BodyQuantities {
                restitution: body.restitution,
                angle: body.rebound_angle,
                spin: Some(body.spin),
                speed: norm(body.velocity),
                reach: reaches.get(name).copied().unwrap_or(0.0),
            };
            (name.clone(), quantities)
        };
        Self {
            wear: surfaces().map(|s| s.wear_volume).sum(),
            depth: largest(&mut surfaces().map(|s| s.max_depth)),
            force: largest(&mut surfaces().map(|s| s.peak_normal_force)),
            rate: surfaces().find_map(|s| s.wear_rate),
            bodies: summary.bodies.iter().map(body).collect(),
        }
    }

    /// Means over runs that differ in where they land.
    pub(crate) fn mean(all: &[Self]) -> Self {
        let mean = |of: &dyn Fn(&Self) -> f64| mean(all.iter().map(|q| Some(of(q)))).unwrap_or(0.0);
        let names = all.first().into_iter().flat_map(|q| q.bodies.keys());
        let body = |name: &String| {
            let of = || all.iter().map(|q| q.bodies.get(name).copied().unwrap_or_default());
            let number =
                |of: &mut dyn Iterator<Item = f64>| self::mean(of.map(Some)).unwrap_or(0.0);
            let spin = [0, 1, 2].map(|axis| self::mean(of().map(|b| Some(b.spin?[axis]))));
            let quantities = BodyQuantities {
                restitution: self::mean(of().map(|b| b.restitution)),
                angle: self::mean(of().map(|b| b.angle)),
                spin: spin[0].zip(spin[1]).zip(spin[2]).map(|((x, y), z)| [x, y, z]),
                speed: number(&mut of().map(|b| b.speed)),
                reach: number(&mut of().map(|b| b.reach)),
            };
            (name.clone(), quantities)
        };
        Self {
            wear: mean(&|q| q.wear),
            depth: mean(&|q| q.depth),
            force: mean(&|q| q.force),
            rate: self::mean(all.iter().map(|q| q.rate)),
            bodies: names.map(body).collect(),
        }
    }
}

/// The mean of numbers that are all there.
fn mean(values: impl Iterator<Item = Option<f64>>) -> Option<f64> {
    let values = values.collect::<Option<Vec<f64>>>()?;
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

impl Errors {
    /// Of a run against `reference`, relative to the sizes of `scale`: the mean of the reference over
    /// where it lands, for a single landing may wear nothing.
    pub(crate) fn between(run: &Quantities, reference: &Quantities, scale: &Quantities) -> Self {
        let relative = |a: f64, b: f64, size: f64| (size != 0.0).then(|| ((a - b) / size).abs());
        let pairs =
            || run.bodies.iter().filter_map(|(name, own)| Some((own, reference.bodies.get(name)?)));
        let worst = |of: &dyn Fn(&BodyQuantities, &BodyQuantities) -> Option<f64>| {
            pairs().filter_map(|(a, b)| of(a, b)).reduce(f64::max)
        };
        Self {
            wear: relative(run.wear, reference.wear, scale.wear),
            depth: relative(run.depth, reference.depth, scale.depth),
            force: relative(run.force, reference.force, scale.force),
            rate: run.rate.zip(reference.rate).and_then(|(a, b)| relative(a, b, scale.rate?)),
            restitution: worst(&|a, b| Some((a.restitution? - b.restitution?).abs())),
            angle: worst(&|a, b| Some((a.angle? - b.angle?).abs())),
            spin: worst(&|a, b| {
                let (own, other) = (a.spin?, b.spin?);
                let apart = [0, 1, 2].map(|axis| own[axis] - other[axis]);
                let approach = b.speed / b.restitution?;
                (approach > 0.0 && approach.is_finite()).then(|| norm(apart) * a.reach / approach)
            }),
        }
    }

    /// Root mean squares over runs that differ in where they land.
    pub(crate) fn rms(all: &[Self]) -> Self {
        let count = all.len().max(1) as f64;
        let mut means = [None; COUNT];
        for (at, mean) in means.iter_mut().enumerate() {
            let squares: Option<f64> = all.iter().map(|e| e.array()[at].map(|x| x * x)).sum();
            *mean = squares.filter(|_| !all.is_empty()).map(|sum| (sum / count).sqrt());
        }
        let [wear, depth, force, rate, restitution, angle, spin] = means;
        Self { wear, depth, force, rate, restitution, angle, spin }
    }

    /// In the order of [`NAMES`].
    pub(crate) fn array(&self) -> [Option<f64>; COUNT] {
        let Self { wear, depth, force, rate, restitution, angle, spin } = *self;
        [wear, depth, force, rate, restitution, angle, spin]
    }
}

pub(crate) fn norm(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}
