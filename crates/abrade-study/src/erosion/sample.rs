//! The samples of a study: how the grain of an impact is turned, where in the cell of the nodes it
//! lands, which way over the lattice it flies. The same for every grain, angle and speed, so that
//! differences between these are not those of the samples.

use std::f64::consts::TAU;

use nalgebra::{Quaternion, UnitQuaternion};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;

use super::file::{Samples, Sequence};

/// Numbers that a sample is made of: three of a rotation, two of a place, one of a direction, two of a
/// size.
const NUMBERS: usize = 8;
/// Standard deviations at which the distribution of sizes is cut off on either side.
pub(crate) const CUT: f64 = 2.5;

/// One sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// How the grain is turned.
    pub rotation: UnitQuaternion<f64>,
    /// Where it lands: shares of the area over which impacts are spread [-].
    pub place: [f64; 2],
    /// The way it flies, from the x axis of the plate [rad].
    pub azimuth: f64,
    /// How large the grain is: a normal deviate of its logarithm, cut off at 2.5 on either side [-].
    pub deviate: f64,
}

impl Samples {
    /// Sample `k`.
    pub fn at(&self, k: u32) -> Sample {
        let [u, v, w, x, y, azimuth, a, b] = match self.sequence {
            Sequence::LowDiscrepancy => even(self.seed, k),
            Sequence::Random => {
                // A generator per sample: any sample can be made alone. Streams of one generator would
                // not do, their first numbers are alike.
                Pcg32::seed_from_u64(!self.grain_seed(k)).random()
            }
        };
        Sample {
            rotation: turned([u, v, w]),
            place: [x, y],
            azimuth: azimuth * TAU,
            // G. Box & M. Muller, Ann. Math. Stat. 29 (1958) 610.
            deviate: ((-2.0 * (1.0 - a).ln()).sqrt() * (TAU * b).cos()).clamp(-CUT, CUT),
        }
    }

    /// The seed that chooses the grain of sample `k` among those of a random form.
    pub fn grain_seed(&self, k: u32) -> u64 {
        // Odd, so that no two samples of a study share one.
        self.seed.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(u64::from(k))
    }
}

/// Point `k` of the additive recurrence of M. Roberts (2018), shifted as a whole by a random amount that
/// the seed chooses.
fn even(seed: u64, k: u32) -> [f64; NUMBERS] {
    let mut generator = Pcg32::seed_from_u64(seed);
    let shift: [f64; NUMBERS] = generator.random();
    let base = golden(NUMBERS);
    let mut step = 1.0;
    shift.map(|shift| {
        step /= base;
        (shift + step * f64::from(k)).fract()
    })
}

/// The root above one of x^(d + 1) = x + 1.
fn golden(dimensions: usize) -> f64 {
    let power = 1.0 / (dimensions as f64 + 1.0);
    let mut x = 2.0_f64;
    // A contraction by more than the dimension in each round.
    for _ in 0..60 {
        x = (1.0 + x).powf(power);
    }
    x
}

/// The rotation that belongs to three numbers from 0 to 1; evenly spread where these are (K. Shoemake,
/// Graphics Gems III (1992) 124).
fn turned([u, v, w]: [f64; 3]) -> UnitQuaternion<f64> {
    let (a, b) = ((1.0 - u).sqrt(), u.sqrt());
    let ([s, c], [t, d]) = ([(TAU * v).sin(), (TAU * v).cos()], [(TAU * w).sin(), (TAU * w).cos()]);
    UnitQuaternion::from_quaternion(Quaternion::new(b * d, a * s, a * c, b * t))
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;

    fn samples(sequence: Sequence) -> Samples {
        Samples { sequence, seed: 5, ..Samples::default() }
    }

    /// Fails for rotations heaped anywhere: where each axis of the body goes has a mean of zero, and
    /// second moments of a third; and for places or azimuths that are not even.
    #[test]
    fn samples_are_even_over_attitudes_places_and_directions() {
        for (sequence, close) in [(Sequence::LowDiscrepancy, 4e-3), (Sequence::Random, 0.03)] {
            let samples = samples(sequence);
            let count = 4096;
            for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
                let (mut mean, mut square) = (Vector3::zeros(), Vector3::zeros());
                for k in 0..count {
                    let to = samples.at(k).rotation * axis;
                    mean += to / f64::from(count);
                    square += to.component_mul(&to) / f64::from(count);
                }
                assert!(mean.amax() < close, "{sequence:?} {mean}");
                assert!((square.add_scalar(-1.0 / 3.0)).amax() < close, "{sequence:?} {square}");
            }
            let mean = |f: &dyn Fn(Sample) -> f64| {
                (0..count).map(|k| f(samples.at(k))).sum::<f64>() / f64::from(count)
            };
            assert!((mean(&|s| s.place[0] * s.place[1]) - 0.25).abs() < close);
            assert!((mean(&|s| (s.azimuth / TAU).powi(2)) - 1.0 / 3.0).abs() < close);
            assert!(mean(&|s| s.deviate).abs() < 2.0 * close);
            // Of a normal one with its tails moved to 2.5: 0.9775.
            assert!((mean(&|s| s.deviate.powi(2)) - 0.9775).abs() < 0.06);
        }
    }

    /// Fails for seeds or numbers that change nothing.
    #[test]
    fn a_sample_is_named_by_seed_and_number() {
        for sequence in [Sequence::LowDiscrepancy, Sequence::Random] {
            let samples = samples(sequence);
            assert_ne!(samples.at(17), Samples { seed: 6, ..samples.clone() }.at(17));
            assert_ne!(samples.at(17), samples.at(18));
        }
    }
}
