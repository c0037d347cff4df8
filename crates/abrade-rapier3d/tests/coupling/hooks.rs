//! The embedder's hooks behind ours.

use std::sync::atomic::{AtomicUsize, Ordering};

use super::rig::{GAP, RADIUS, Rig, towards_plate};
use crate::plugin::rapier::prelude::*;
use crate::plugin::{WorldView, scalar};
use nalgebra::Vector3;

/// Counts calls; lets every contact pass.
#[derive(Default)]
struct Counting {
    filtered: AtomicUsize,
    modified: AtomicUsize,
}

impl PhysicsHooks for Counting {
    fn filter_contact_pair(&self, _: &PairFilterContext) -> Option<SolverFlags> {
        self.filtered.fetch_add(1, Ordering::Relaxed);
        Some(SolverFlags::COMPUTE_RIGID_IMPULSES)
    }

    fn modify_solver_contacts(&self, _: &mut ContactModificationContext) {
        self.modified.fetch_add(1, Ordering::Relaxed);
    }
}

/// A ball that rests on a collider far from the plate, which asks for `hooks`.
fn add_other_pair(rig: &mut Rig, hooks: ActiveHooks) {
    let away = Vector3::new(1.0, 0.0, 0.0);
    let h = scalar::narrow(0.01);
    let box_ = ColliderBuilder::cuboid(h, h, h).active_hooks(hooks);
    rig.world.colliders.insert(box_.translation(scalar::to_vector(&away)));
    rig.ball(away + Vector3::z() * (0.01 + 0.9 * RADIUS), Vector3::zeros());
}

/// Fails for hooks that end at ours.
#[test]
fn other_pairs_reach_the_embedders_hooks() {
    let mut rig = Rig::new(Vector3::zeros(), 1.0 / 60.0);
    let hooks = ActiveHooks::FILTER_CONTACT_PAIRS | ActiveHooks::MODIFY_SOLVER_CONTACTS;
    add_other_pair(&mut rig, hooks);
    let counting = Counting::default();
    rig.wear.step(&mut rig.world, &counting, &()).expect("a step");
    assert!(counting.filtered.load(Ordering::Relaxed) > 0);
    assert!(counting.modified.load(Ordering::Relaxed) > 0);
}

/// Fails for a filter that is asked about pairs for which nobody set its flag, and for one that
/// is asked about a pair that wear has resolved.
#[test]
fn pairs_of_the_plate_reach_the_embedders_filter_only_on_request_and_if_refused() {
    for (asked, jointed, calls) in [(true, true, true), (false, true, false), (true, false, false)]
    {
        let mut rig = Rig::new(Vector3::zeros(), 1.0 / 60.0);
        let ball = rig.ball(Vector3::z() * (RADIUS + GAP), towards_plate(0.1, 90.0));
        if asked {
            let collider = rig.collider(ball);
            rig.world.colliders[collider].set_active_hooks(ActiveHooks::FILTER_CONTACT_PAIRS);
        }
        if jointed {
            let far = rig.ball(Vector3::z(), Vector3::zeros());
            let rope = RopeJointBuilder::new(scalar::narrow(10.0));
            rig.world.impulse_joints.insert(ball, far, rope, true);
        }
        let counting = Counting::default();
        rig.wear.step(&mut rig.world, &counting, &()).expect("a step");
        let called = counting.filtered.load(Ordering::Relaxed) > 0;
        assert_eq!(called, calls, "asked {asked}, jointed {jointed}");
    }
}

/// Fails for a three-part step that is not the one-call step.
#[test]
fn a_step_in_three_parts_is_the_step_in_one() {
    let run = |in_parts: bool| {
        let mut rig = Rig::new(Vector3::zeros(), 1.0 / 60.0);
        let ball = rig.ball(Vector3::z() * 0.1, towards_plate(20.0, 70.0));
        for _ in 0..3 {
            if !in_parts {
                rig.step();
                continue;
            }
            let guard = rig.wear.begin_step(WorldView::of(&mut rig.world), &());
            rig.world.step_with_events(&guard, &());
            rig.wear.end_step(WorldView::of(&mut rig.world)).expect("a step");
        }
        (*rig.world.bodies[ball].position(), rig.wear[rig.plate].wear_volume())
    };
    assert_eq!(run(true), run(false));
}
