//! From a stream to its bodies: what comes when, where, how turned and how large.

mod draw;

use nalgebra::Vector3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;

use crate::place;
use crate::scene::{Form, Motion, Placement, Rotation, SceneBody, SceneShape, Shares, Stream};

pub(crate) use draw::disc;

/// Most bodies of a stream.
pub(crate) const MOST: u32 = 100_000;
/// Added to the seed for sizes and shapes, so that places and rotations do not depend on them.
const OTHER: u64 = 0x9e37_79b9_7f4a_7c15;

/// A shape of a stream, as large as it is written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Kind {
    /// Share among the others, as written [-].
    pub share: f64,
    /// Mass [kg].
    pub mass: f64,
    /// Diameter of the sphere of its volume [m]; matters where the stream has sizes.
    pub diameter: f64,
}

/// A body of a stream.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Coming {
    pub name: String,
    /// When it starts [s].
    pub due: f64,
    /// As it starts. Its shape is as large as it is written.
    pub body: SceneBody,
    /// Index of its shape.
    pub kind: usize,
    /// How many times as large as written it is [-].
    pub factor: f64,
}

impl Stream {
    /// Its shapes with their shares.
    pub(crate) fn kinds(&self) -> impl Iterator<Item = (&SceneShape, f64)> {
        let single = self.shape.iter().map(|shape| (shape, 1.0));
        single.chain(self.shapes.iter().map(|kind| (&kind.shape, kind.share)))
    }

    /// The bodies of the stream `name`, in the order in which they come; `kinds` tells of its shapes.
    pub(crate) fn bodies(&self, name: &str, kinds: &[Kind]) -> impl Iterator<Item = Coming> {
        let (velocity, spin) = place::velocity(&self.motion);
        let [across, up] = square_to(&velocity);
        let [mut places, mut others] =
            [self.seed, self.seed.wrapping_add(OTHER)].map(Pcg32::seed_from_u64);
        let shapes: Vec<_> = self.kinds().map(|(shape, _)| shape).collect();
        let weights: Vec<_> = kinds.iter().map(|kind| self.weight(kind)).collect();
        let mut before = 0.0;
        (0..self.count).map(move |k| {
            let [a, b] = disc(&mut places).map(|share| share * self.spread);
            let rotation = draw::turned(&mut places);
            let kind = match weights.len() {
                1 => 0,
                _ => draw::pick(&mut others, weights.iter().copied()),
            };
            let diameter = self.sizes.as_ref().map(|sizes| draw::diameter(&mut others, sizes));
            let factor = diameter.map_or(1.0, |diameter| diameter / kinds[kind].diameter);
            let motion = match self.divergence > 0.0 {
                true => {
                    let [x, y, z] = draw::cone(&mut others, self.divergence);
                    let aside = across * x + up * y;
                    let velocity = (velocity * z + aside * velocity.norm()).into();
                    Motion::Free { velocity, spin: spin.into() }
                }
                false => self.motion.clone(),
            };
            let due = self.due(k, before);
            before += kinds[kind].mass * factor.powi(3);
            let body = SceneBody {
                position: moved(&self.position, &(across * a + up * b)),
                rotation,
                motion,
                ..self.body(drawn(shapes[kind], &mut others))
            };
            let name = numbered(name, u64::from(k) + 1, u64::from(self.count));
            Coming { name, due, body, kind, factor }
        })
    }

    /// A body of `shape` that starts in the middle of the disc, not turned.
    pub(crate) fn body(&self, shape: SceneShape) -> SceneBody {
        SceneBody {
            shape,
            density: self.density,
            position: self.position.clone(),
            rotation: Rotation::default(),
            motion: self.motion.clone(),
            rotation_locked: false,
        }
    }

    /// How often a shape comes, over the other ones [-].
    fn weight(&self, kind: &Kind) -> f64 {
        match self.shares {
            // All shapes have the same sizes.
            Shares::Mass if self.sizes.is_none() => kind.share / kind.mass,
            Shares::Number | Shares::Mass => kind.share,
        }
    }

    /// When the body of number `k`, from 0 on, starts [s], after others with a mass of `before` [kg].
    fn due(&self, k: u32, before: f64) -> f64 {
        match (self.every, self.rate, self.mass_rate) {
            (Some(every), ..) => every * f64::from(k),
            (_, Some(rate), _) => f64::from(k) / rate,
            (.., Some(mass_rate)) => before / mass_rate,
            (None, None, None) => 0.0,
        }
    }
}

/// True for a shape of which every seed makes another body.
pub(crate) fn is_random(shape: &SceneShape) -> bool {
    matches!(shape, SceneShape::Grain { form: Form::Grit { .. }, .. })
}

/// The shape of one body: of a random form, another one for every body.
fn drawn(shape: &SceneShape, generator: &mut Pcg32) -> SceneShape {
    let mut shape = shape.clone();
    if is_random(&shape)
        && let SceneShape::Grain { seed, .. } = &mut shape
    {
        *seed = generator.random();
    }
    shape
}

/// Name of the one with this `number` of the `count` that `name` stands for; names sort like numbers.
pub(crate) fn numbered(name: &str, number: u64, count: u64) -> String {
    let digits = count.to_string().len();
    format!("{name}_{number:0digits$}")
}

/// Two directions square to `v` and to each other.
fn square_to(v: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let mut axis = Vector3::zeros();
    axis[v.iamin()] = 1.0;
    let across = v.cross(&axis).normalize();
    [across, v.normalize().cross(&across)]
}

/// The place that lies by `way` from `position`, in the axes of that one.
fn moved(position: &Placement, way: &Vector3<f64>) -> Placement {
    let mut moved = position.clone();
    match &mut moved {
        Placement::OnSurface { at, gap, .. } => {
            at[0] += way.x;
            at[1] += way.y;
            *gap += way.z;
        }
        Placement::InFrame { point, .. } | Placement::At { point } => {
            for (x, step) in point.iter_mut().zip(way) {
                *x += step;
            }
        }
    }
    moved
}

#[cfg(test)]
mod tests;
