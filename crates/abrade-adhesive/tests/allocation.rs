//! A step allocates nothing once its lists have grown, not even where it lists the pairs anew.

#[path = "../../abrade/tests/counting/mod.rs"]
mod counting;

use abrade_adhesive::{Asperities, Collision, Solid};

/// Fails for lists that are made and dropped, in a step or where bodies have come nearer.
#[test]
fn a_step_allocates_nothing() {
    let mut collision = Collision::new(&Solid::default(), &Asperities::default()).unwrap();
    let mut steps = |count: usize| {
        let before = counting::counted();
        (0..count).for_each(|_| collision.step().unwrap());
        counting::counted() - before
    };
    // Listed anew about every 280 steps; lists grow while the facets come over each other.
    steps(2_000);
    let later = steps(600);
    assert!(later <= 2, "{later} allocations in 600 steps");
}
