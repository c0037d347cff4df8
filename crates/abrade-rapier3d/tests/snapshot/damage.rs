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
