//! Random numbers of a stream. They come from sums, products, quotients, square roots and the
//! functions of `libm` alone, which every machine rounds alike.

use nalgebra::Vector4;
use rand::RngExt;
use rand_pcg::Pcg32;

use crate::scene::{Rotation, Sieve, Sizes};

/// A point of the unit disc, evenly.
pub(crate) fn disc(generator: &mut Pcg32) -> [f64; 2] {
    loop {
        let [a, b]: [f64; 2] = generator.random();
        let point = [2.0 * a - 1.0, 2.0 * b - 1.0];
        if point[0] * point[0] + point[1] * point[1] <= 1.0 {
            return point;
        }
    }
}

/// Evenly over all rotations (Marsaglia, Annals of Mathematical Statistics 43 (1972) 645).
pub(super) fn turned(generator: &mut Pcg32) -> Rotation {
    loop {
        let ([a, b], [c, d]) = (disc(generator), disc(generator));
        let (first, second) = (a * a + b * b, c * c + d * d);
        if second > 0.0 {
            let share = ((1.0 - first) / second).sqrt();
            let xyzw = Vector4::new(a, b, c * share, d * share);
            return Rotation::Quaternion { xyzw: xyzw.into() };
        }
    }
}

/// A direction of the cone of half angle `divergence` [rad] about z, evenly over the sphere:
/// components along x, y and z.
pub(super) fn cone(generator: &mut Pcg32, divergence: f64) -> [f64; 3] {
    let [a, b] = disc(generator);
    let square = a * a + b * b;
    // The area of a cap is linear in its height.
    let z = 1.0 - square * (1.0 - libm::cos(divergence));
    let aside = if square > 0.0 { ((1.0 - z * z) / square).sqrt() } else { 0.0 };
    [a * aside, b * aside, z]
}

/// One of the `weights`, by its index.
pub(super) fn pick(generator: &mut Pcg32, weights: impl Iterator<Item = f64> + Clone) -> usize {
    let mut left = generator.random::<f64>() * weights.clone().sum::<f64>();
    let mut last = 0;
    for (index, weight) in weights.enumerate().filter(|(_, weight)| *weight > 0.0) {
        last = index;
        left -= weight;
        if left < 0.0 {
            break;
        }
    }
    last
}

/// A diameter [m].
pub(super) fn diameter(generator: &mut Pcg32, sizes: &Sizes) -> f64 {
    match sizes {
        Sizes::Fixed { diameter } => *diameter,
        Sizes::Uniform { from, to } => from + (to - from) * generator.random::<f64>(),
        Sizes::Normal { mean, deviation, from, to } => {
            within(*from, *to, || mean + deviation * normal(generator))
        }
        Sizes::LogNormal { median, deviation, from, to } => {
            within(*from, *to, || median * libm::exp(deviation * normal(generator)))
        }
        Sizes::Sieves { fractions } => {
            let fraction = fractions[pick(generator, fractions.iter().map(Sieve::number))];
            // The number per diameter falls as 1 / d^3, whose integral is that of -1 / (2 d^2).
            let [most, least] = [fraction.from, fraction.to].map(|d| 1.0 / (d * d));
            1.0 / (most - (most - least) * generator.random::<f64>()).sqrt()
        }
    }
}

impl Sieve {
    /// Number of its bodies, over that of other fractions: mass times the mean of 1 / d^3.
    fn number(&self) -> f64 {
        let Self { from, to, mass } = self;
        mass * (from + to) / (from * from * to * to)
    }
}

/// The first of `draws` from `from` to `to`.
fn within(from: f64, to: f64, mut draw: impl FnMut() -> f64) -> f64 {
    loop {
        let value = draw();
        if value >= from && value <= to {
            return value;
        }
    }
}

/// A normal deviate (the polar method of Marsaglia & Bray, SIAM Review 6 (1964) 260).
fn normal(generator: &mut Pcg32) -> f64 {
    loop {
        let [a, b] = disc(generator);
        let square = a * a + b * b;
        if square > 0.0 {
            return a * (-2.0 * libm::log(square) / square).sqrt();
        }
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;

    use super::*;

    fn drawn(sizes: &Sizes) -> Vec<f64> {
        let mut generator = Pcg32::seed_from_u64(5);
        (0..40_000).map(|_| diameter(&mut generator, sizes)).collect()
    }

    fn mean(values: impl Iterator<Item = f64>) -> f64 {
        let (sum, count) = values.fold((0.0, 0.0), |(sum, n), x| (sum + x, n + 1.0));
        sum / count
    }

    /// Fails for fractions that are taken by number, and for a mass that is heaped at one sieve.
    #[test]
    fn sieve_fractions_hold_their_mass_spread_evenly() {
        let sieve = |from, to, mass| Sieve { from, to, mass };
        let fractions = vec![sieve(1.0, 2.0, 3.0), sieve(2.0, 4.0, 5.0), sieve(4.0, 5.0, 0.0)];
        let all = drawn(&Sizes::Sieves { fractions });
        let mass = |from: f64, to: f64| -> f64 {
            all.iter().filter(|d| (from..to).contains(*d)).map(|d| d.powi(3)).sum()
        };
        let whole = mass(1.0, 5.0);
        for (from, to, share) in [
            (1.0, 2.0, 3.0 / 8.0),
            (2.0, 4.0, 5.0 / 8.0),
            (1.0, 1.5, 1.5 / 8.0),
            (3.0, 4.0, 2.5 / 8.0),
        ] {
            // About 200 bodies lie in the rarest part: 40 000 draws leave less than 2 %.
            assert!((mass(from, to) / whole - share).abs() < 0.02, "{from} {to}");
        }
        assert_eq!(mass(4.0, 5.0), 0.0);
    }

    /// Fails for a deviation that is taken of the diameter, and for cut-offs that pile up at the ends.
    #[test]
    fn normal_sizes_have_their_moments_and_keep_their_cut_offs() {
        let all = drawn(&Sizes::Normal { mean: 3.0, deviation: 0.5, from: 1.0, to: 5.0 });
        let centre = mean(all.iter().copied());
        let variance = mean(all.iter().map(|d| (d - centre).powi(2)));
        // Standard errors: 0.0025 and 0.0018.
        assert!(
            (centre - 3.0).abs() < 0.01 && (variance - 0.25).abs() < 0.008,
            "{centre} {variance}"
        );
        let all = drawn(&Sizes::LogNormal { median: 2.0, deviation: 0.3, from: 0.1, to: 40.0 });
        let centre = mean(all.iter().map(|d| d.ln()));
        let variance = mean(all.iter().map(|d| (d.ln() - centre).powi(2)));
        assert!((centre - 2f64.ln()).abs() < 0.006 && (variance - 0.09).abs() < 0.003);
        let cut = drawn(&Sizes::LogNormal { median: 2.0, deviation: 0.3, from: 1.9, to: 2.2 });
        assert!(cut.iter().all(|d| (1.9..=2.2).contains(d)));
        let ends = cut.iter().filter(|d| **d == 1.9 || **d == 2.2).count();
        assert_eq!(ends, 0);
    }

    /// Fails for directions that crowd about the axis, or go beyond the cone.
    #[test]
    fn a_cone_is_filled_evenly() {
        let mut generator = Pcg32::seed_from_u64(9);
        let half: f64 = 0.6;
        let all: Vec<_> = (0..20_000).map(|_| cone(&mut generator, half)).collect();
        assert!(all.iter().all(|[x, y, z]| (x * x + y * y + z * z - 1.0).abs() < 1e-12));
        assert!(all.iter().all(|[.., z]| *z >= half.cos() - 1e-12));
        // The height is even over a cap.
        let height = mean(all.iter().map(|[.., z]| (1.0 - z) / (1.0 - half.cos())));
        assert!((height - 0.5).abs() < 0.01, "{height}");
        let sides = mean(all.iter().map(|[x, ..]| *x));
        assert!(sides.abs() < 0.01);
    }
}
