//! Streams: when bodies come, where, how large, and that seeds mean the same everywhere.

use super::*;
use crate::scene::{ShapeShare, Sizes};

fn stream() -> Stream {
    Stream {
        shape: Some(SceneShape::Ball { radius: 1e-3 }),
        shapes: Vec::new(),
        shares: Shares::Number,
        sizes: None,
        density: Some(2500.0),
        count: 4000,
        every: Some(2e-3),
        rate: None,
        mass_rate: None,
        position: Placement::At { point: [1.0, 2.0, 3.0] },
        motion: Motion::Free { velocity: [3.0, -4.0, 12.0], spin: [0.0; 3] },
        spread: 0.1,
        divergence: 0.0,
        seed: 7,
    }
}

/// A ball of unit mass and diameter.
const UNIT: Kind = Kind { share: 1.0, mass: 1.0, diameter: 1.0 };

fn bodies(stream: &Stream) -> Vec<Coming> {
    stream.bodies("sand", &[UNIT]).collect()
}

/// Fails for bodies that come at other times, off the disc, or heaped about its middle.
#[test]
fn bodies_follow_each_other_spread_over_a_disc() {
    let velocity = Vector3::new(3.0, -4.0, 12.0);
    let (mut sum, mut square) = (Vector3::zeros(), 0.0);
    let bodies = bodies(&stream());
    for (k, coming) in bodies.iter().enumerate() {
        let Placement::At { point } = coming.body.position else { panic!("{coming:?}") };
        let aside = Vector3::from(point) - Vector3::new(1.0, 2.0, 3.0);
        assert!((coming.due - 2e-3 * k as f64).abs() < 1e-12, "{k}: {}", coming.due);
        assert!(aside.norm() <= 0.1 + 1e-12 && aside.dot(&velocity).abs() < 1e-12);
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
    let long = bodies(&stream());
    assert!(long.is_sorted_by(|a, b| a.name < b.name));
    assert_eq!(long[0].name, "sand_0001");
    let short = bodies(&Stream { count: 10, ..stream() });
    let same = short.iter().zip(&long).filter(|(a, b)| a.body == b.body);
    assert_eq!((short[9].name.as_str(), same.count()), ("sand_10", 10));
    let other = bodies(&Stream { seed: 8, ..stream() });
    assert_ne!(other[0].body, long[0].body);
}

/// Fails for sizes, shapes or a divergence that change where bodies start and how they are turned:
/// studies that vary one of them compare the same stream.
#[test]
fn places_do_not_depend_on_sizes_and_directions() {
    let plain = bodies(&stream());
    let sizes = Some(Sizes::Uniform { from: 0.5, to: 2.0 });
    let varied = bodies(&Stream { sizes, divergence: 0.1, ..stream() });
    for (a, b) in plain.iter().zip(&varied) {
        assert_eq!((&a.body.position, &a.body.rotation), (&b.body.position, &b.body.rotation));
        let (velocity, _) = place::velocity(&b.body.motion);
        let axis = Vector3::new(3.0, -4.0, 12.0);
        assert!((velocity.norm() - 13.0).abs() < 1e-12);
        assert!(velocity.angle(&axis) <= 0.1 + 1e-7 && a.body.motion != b.body.motion);
        assert!((0.5..=2.0).contains(&b.factor) && a.factor == 1.0);
    }
}

/// Fails for a mass rate that counts bodies, or that lets a body wait for its own mass.
#[test]
fn a_mass_rate_is_kept_whatever_the_sizes() {
    let sizes = Some(Sizes::Uniform { from: 0.5, to: 2.0 });
    let all = bodies(&Stream { every: None, mass_rate: Some(4.0), sizes, ..stream() });
    let mut before = 0.0;
    for coming in &all {
        assert!((coming.due - before / 4.0).abs() < 1e-9 * (1.0 + before), "{}", coming.name);
        before += coming.factor.powi(3);
    }
    let even = bodies(&Stream { every: None, rate: Some(500.0), ..stream() });
    assert!((even[3].due - 6e-3).abs() < 1e-15);
}

/// Fails for shares by mass that are taken by number.
#[test]
fn shares_count_number_or_mass() {
    let kind = |radius| ShapeShare { shape: SceneShape::Ball { radius }, share: 0.5 };
    let shapes = vec![kind(1.0), kind(2.0)];
    let mixed = Stream { shape: None, shapes, ..stream() };
    let kinds = [1.0, 8.0].map(|mass| Kind { share: 0.5, mass, diameter: 1.0 });
    let heavy = |shares| {
        let stream = Stream { shares, ..mixed.clone() };
        stream.bodies("sand", &kinds).filter(|coming| coming.kind == 1).count() as f64
    };
    // Standard deviations of 32 and 20 in 4000.
    assert!((heavy(Shares::Number) - 2000.0).abs() < 130.0);
    assert!((heavy(Shares::Mass) - 4000.0 / 9.0).abs() < 80.0);
}

/// Fails for a stream of one broken grain over and over.
#[test]
fn every_body_of_a_random_form_is_another_one() {
    let form = Form::Grit { points: 10, elongation: [1.0; 2], flatness: [1.0; 2] };
    let shape = SceneShape::Grain { form, diameter: 1e-3, spheres: None, seed: 1 };
    let all = bodies(&Stream { shape: Some(shape), count: 20, ..stream() });
    let seeds = all.iter().map(|coming| match coming.body.shape {
        SceneShape::Grain { seed, .. } => seed,
        _ => panic!("{coming:?}"),
    });
    assert_eq!(seeds.collect::<std::collections::BTreeSet<_>>().len(), 20);
}

/// Fails for a generator or a way to draw from it that differs from machine to machine, or from
/// release to release: runs are named by their seeds. The rotation's bits are those of PCG32 and the same
/// sums written out in Python; the place is from the two draws before.
#[test]
fn places_are_the_same_bits_everywhere() {
    let body = &bodies(&stream())[2].body;
    let (Placement::At { point }, Rotation::Quaternion { xyzw }) = (&body.position, &body.rotation)
    else {
        panic!("{body:?}");
    };
    let bits: Vec<u64> = point.iter().chain(xyzw).map(|x| x.to_bits()).collect();
    let expected: [u64; 7] = [
        4607199131057175027,
        4611561313677590456,
        4613914945083962208,
        4605582545013080790,
        13815827187218362688,
        13817662943778700562,
        4603040664350758979,
    ];
    assert_eq!(bits, expected);
}
