//! From a stream to its bodies. Their places come from sums, products, quotients and square roots
//! alone, which every machine rounds alike.

use nalgebra::{Vector3, Vector4};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;

use crate::place;
use crate::scene::{Placement, Rotation, SceneBody, Stream};

/// Most bodies of a stream.
pub(crate) const MOST: u32 = 100_000;

impl Stream {
    /// The bodies of the stream `name`, by their names, in the order in which they come.
    pub(crate) fn bodies(&self, name: &str) -> impl Iterator<Item = (String, SceneBody)> {
        let (velocity, _) = place::velocity(&self.motion);
        let [across, up] = square_to(&velocity);
        let mut generator = Pcg32::seed_from_u64(self.seed);
        (0..self.count).map(move |k| {
            let [a, b] = disc(&mut generator).map(|share| share * self.spread);
            let behind = velocity * (self.every * f64::from(k));
            let body = SceneBody {
                shape: self.shape.clone(),
                density: self.density,
                position: moved(&self.position, &(across * a + up * b - behind)),
                rotation: turned(&mut generator),
                motion: self.motion.clone(),
                rotation_locked: false,
            };
            (numbered(name, u64::from(k) + 1, u64::from(self.count)), body)
        })
    }
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
fn turned(generator: &mut Pcg32) -> Rotation {
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
mod tests {
    use super::*;
    use crate::scene::{Motion, SceneShape};

    fn stream() -> Stream {
        Stream {
            shape: SceneShape::Ball { radius: 1e-3 },
            density: Some(2500.0),
            count: 4000,
            every: 2e-3,
            position: Placement::At { point: [1.0, 2.0, 3.0] },
            motion: Motion::Free { velocity: [3.0, -4.0, 12.0], spin: [0.0; 3] },
            spread: 0.1,
            seed: 7,
        }
    }

    /// Fails for bodies that come at other times, ahead of the first one, or heaped about the middle
    /// of the disc.
    #[test]
    fn bodies_follow_each_other_spread_over_a_disc() {
        let velocity = Vector3::new(3.0, -4.0, 12.0);
        let (mut sum, mut square) = (Vector3::zeros(), 0.0);
        let bodies: Vec<_> = stream().bodies("sand").collect();
        for (k, (_, body)) in bodies.iter().enumerate() {
            let Placement::At { point } = body.position else { panic!("{body:?}") };
            let way = Vector3::from(point) - Vector3::new(1.0, 2.0, 3.0);
            let late = -way.dot(&velocity) / velocity.norm_squared();
            assert!((late - 2e-3 * k as f64).abs() < 1e-12, "{k}: {late}");
            let aside = way + velocity * late;
            assert!(aside.norm() <= 0.1 + 1e-12);
            sum += aside;
            square += aside.norm_squared();
        }
        // Of an even disc: half the radius squared; standard deviations 0.0008 and 5e-5.
        let count = bodies.len() as f64;
        assert!((sum / count).norm() < 4e-3, "{sum}");
        assert!((square / count - 0.5e-2).abs() < 2e-4, "{square}");
    }

    /// Fails for names that do not sort in the order of coming, and for bodies that change when
    /// others are added.
    #[test]
    fn a_longer_stream_begins_like_a_shorter_one() {
        let long: Vec<_> = stream().bodies("sand").collect();
        assert!(long.is_sorted_by(|a, b| a.0 < b.0));
        assert_eq!(long[0].0, "sand_0001");
        let short: Vec<_> = Stream { count: 10, ..stream() }.bodies("sand").collect();
        let same = short.iter().zip(&long).filter(|(a, b)| a.1 == b.1);
        assert_eq!((short[9].0.as_str(), same.count()), ("sand_10", 10));
        let other = Stream { seed: 8, ..stream() };
        assert_ne!(other.bodies("sand").next(), stream().bodies("sand").next());
    }

    /// Fails for a generator or a way to draw from it that differs from machine to machine, or from
    /// release to release: runs are named by their seeds. The bits are those of PCG32 and the same
    /// sums written out in Python.
    #[test]
    fn places_are_the_same_bits_everywhere() {
        let (_, body) = stream().bodies("sand").nth(2).expect("a body");
        let (Placement::At { point }, Rotation::Quaternion { xyzw }) =
            (&body.position, &body.rotation)
        else {
            panic!("{body:?}");
        };
        let bits: Vec<u64> = point.iter().chain(xyzw).map(|x| x.to_bits()).collect();
        let expected: [u64; 7] = [
            4607107756923275754,
            4611633371271628384,
            4613806858692905316,
            4605582545013080790,
            13815827187218362688,
            13817662943778700562,
            4603040664350758979,
        ];
        assert_eq!(bits, expected);
    }
}
