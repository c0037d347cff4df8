//! Damaged bytes of a wear world beside the world that they belong to.

use super::cases::CASES;
use super::save::Save;
use crate::plugin::WearWorld;

/// Steps that a damaged world takes.
const STEPS: usize = 3;

/// True when the bytes are read and give a world that stays finite; false when they are refused.
fn goes_on(world: &[u8], wear: &[u8]) -> bool {
    let Ok(wear) = postcard::from_bytes::<WearWorld>(wear) else { return false };
    let world = postcard::from_bytes(world).expect("a world");
    let mut save = Save { world, wear };
    for _ in 0..STEPS {
        // A body that is no longer inside the model is left to Rapier.
        let _ = save.wear.step(&mut save.world, &(), &());
    }
    assert!(save.is_finite());
    true
}

/// Fails for a check that is missing: what is read is stepped, whatever it is.
#[test]
fn damaged_bytes_are_refused_or_stay_finite() {
    for case in &CASES {
        let save = case.begun();
        let world = postcard::to_stdvec(&save.world).expect("bytes");
        let wear = postcard::to_stdvec(&save.wear).expect("bytes");
        assert!(goes_on(&world, &wear), "{}", case.name);
        for length in (0..wear.len()).step_by(1 + wear.len() / 200) {
            assert!(!goes_on(&world, &wear[..length]), "{}: {length} bytes", case.name);
        }
        // The settings, a sample of the depths, and more of what is kept of the bodies.
        let nodes =
            save.wear.surfaces().map(|(_, surface)| 8 * surface.nodes().len()).sum::<usize>();
        let (head, tail) = (300, 300 + nodes.min(wear.len() - 300));
        let stride = 1 + (wear.len() - tail) / 250;
        let places = (0..head).step_by(3).chain((head..tail).step_by(1 + nodes / 20));
        let places = places.chain((tail..wear.len()).step_by(stride));
        let (mut read, mut refused) = (0, 0);
        for (number, at) in places.enumerate() {
            let mut damaged = wear.clone();
            damaged[at] ^= 1 << [0, 4, 6, 7][(number * 7 + number / 5) % 4];
            match goes_on(&world, &damaged) {
                true => read += 1,
                false => refused += 1,
            }
        }
        println!("{}: {read} read, {refused} refused", case.name);
    }
}

/// Numbers from a seed: splitmix64 (Steele, Lea & Flood 2014).
struct Draw(u64);

impl Draw {
    fn below(&mut self, limit: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % limit as u64) as usize
    }

    /// Turns a bit, sets a byte or eight to an extreme, leaves some out, or repeats some.
    fn damage(&mut self, bytes: &mut Vec<u8>) {
        let at = self.below(bytes.len());
        let end = (at + 1 + self.below(16)).min(bytes.len());
        match self.below(5) {
            0 => bytes[at] ^= 1 << self.below(8),
            1 => bytes[at] = [0, 1, 0x7f, 0x80, 0xff][self.below(5)],
            2 => {
                let extremes = [0.0, -1.0, f64::NAN, f64::INFINITY, f64::MAX, 5e-324, 1e-160];
                let number = extremes[self.below(extremes.len())].to_le_bytes();
                let end = (at + 8).min(bytes.len());
                bytes[at..end].copy_from_slice(&number[..end - at]);
            }
            3 => drop(bytes.drain(at..end)),
            _ => {
                let again = bytes[at..end].to_vec();
                bytes.splice(at..at, again);
            }
        }
    }
}

/// Fails for a check that the places above miss. `DAMAGE_CASES` takes another number for each world.
#[test]
fn bytes_damaged_at_random_are_refused_or_stay_finite() {
    let count = std::env::var("DAMAGE_CASES").ok().and_then(|count| count.parse().ok());
    for case in &CASES {
        let save = case.begun();
        let world = postcard::to_stdvec(&save.world).expect("bytes");
        let wear = postcard::to_stdvec(&save.wear).expect("bytes");
        let mut draw = Draw(1);
        let (mut read, mut refused) = (0, 0);
        for _ in 0..count.unwrap_or(60) {
            let mut damaged = wear.clone();
            for _ in 0..=draw.below(2) {
                draw.damage(&mut damaged);
            }
            match goes_on(&world, &damaged) {
                true => read += 1,
                false => refused += 1,
            }
        }
        println!("{}: {read} read, {refused} refused at random", case.name);
    }
}
