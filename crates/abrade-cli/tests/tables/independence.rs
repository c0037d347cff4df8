//! Micro results depend neither on the engine's step nor on the origin nor on its precision.

use crate::run::{Verdict, at, run, run_with, vector};

/// Fails for a resolver that leaks the engine's step, rounding or place into the contact.
#[test]
fn foundation_impacts_are_the_same_at_any_step_place_and_precision() {
    let mut verdict = Verdict::default();
    for (scene, top) in
        [("foundation/oblique_impact.ron", 35.0), ("foundation/normal_impact.ron", 45.0)]
    {
        let mut reference: Option<(f64, [f64; 3])> = None;
        for step in ["1/60 s", "1 ms", "0.1 ms"] {
            for origin in [0.0, 10.0] {
                for precision in ["f64", "f32"] {
                    let sets = [
                        format!("run.step={step}"),
                        format!("surfaces.plate.position=({origin}, {origin}, {origin})"),
                    ];
                    let summary = run_with(scene, &sets, &["--precision", precision]);
                    let w = at(&summary, "surfaces.plate.wear_volume_m3");
                    let v = vector(&summary, "bodies.ball.velocity_m_s");
                    let (w0, v0) = *reference.get_or_insert((w, v));
                    let dv: f64 = v.iter().zip(v0).map(|(a, b)| (a - b).powi(2)).sum();
                    let (dv, dw) = (dv.sqrt() / top, (w / w0 - 1.0).abs());
                    verdict.row(
                        dv < 5e-4 && dw < 2e-3,
                        format!(
                            "{scene} {step} at {origin} m {precision}: dv/v {dv:.1e} dW/W {dw:.1e}"
                        ),
                    );
                }
            }
        }
    }
    verdict.close();
}

/// Fails for a fast ball that passes through the plate within a long step.
#[test]
fn a_fast_ball_is_caught() {
    for precision in ["f64", "f32"] {
        let sets = ["bodies.ball.motion.speed=100 m/s".into(), "run.step=1/60 s".into()];
        let summary = run_with("foundation/oblique_impact.ron", &sets, &["--precision", precision]);
        assert!(at(&summary, "bodies.ball.velocity_m_s.2") > 0.0);
        assert!(at(&summary, "surfaces.plate.wear_volume_m3") > 1e-11);
    }
}

/// Fails for a run that looks away from a body before it has seen what the summary tells of it: how
/// it came, and all of its slide.
#[test]
fn a_summary_is_the_same_with_a_history_and_without_one() {
    let slide = ["bodies.indenter.motion.distance=2 mm", "bodies.indenter.motion.rate_over=1 mm"];
    for (scene, sets) in [("first_impact.ron", &[][..]), ("paper/scratch.ron", &slide)] {
        let summary = |outputs: &str| {
            let sets = sets.iter().chain([&outputs]).map(|set| set.to_string());
            let mut summary = run(scene, &sets.collect::<Vec<_>>());
            let times = ["wall_s", "setup_s"].map(|key| summary[key].take().as_f64());
            assert!(times[1] > Some(0.0) && times[1] < times[0], "{times:?}");
            summary
        };
        let watched = summary("outputs=[History(every: \"10 us\")]");
        assert_eq!(summary("outputs=[]"), watched, "{scene}");
    }
}
