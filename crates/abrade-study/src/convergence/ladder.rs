//! What a study varies: ladders of settings, coarse before fine.

use abrade_scene::scene::{Motion, Resolve, SurfaceMotion};
use abrade_scene::{Checked, Precision};

use crate::sets;

/// What is varied along a curve of the study.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variant {
    /// The target of the time error, on the scene's own nodes.
    Accuracy,
    /// The distance of the nodes, at the scene's own accuracy.
    Pitch,
    /// The distance of the nodes, and the accuracy with its square.
    Both,
    /// The target of the time error, with an engine in `f32`.
    Single,
    /// The step of the engine, and who resolves the contacts.
    Step(Resolve),
    /// The stiffness of the surfaces where the scene gives it: what softer springs save, and what
    /// that changes.
    Stiffness,
    /// Young's modulus where the stiffness follows from it; that of `Foundation` does so within
    /// bounds.
    Young,
}

/// What a ladder's runs are compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Against {
    /// Its own finest run.
    Finest,
    /// The finest run of another ladder.
    FinestOf(Variant),
    /// The run of another ladder at the same value.
    SameOf(Variant),
    /// The run at the value 1: the scene as it is.
    Scene,
}

/// A setting to run at.
#[derive(Clone, Debug, PartialEq)]
pub struct Rung {
    /// The number that is varied.
    pub value: f64,
    /// The scene's changes.
    pub sets: Vec<String>,
    /// Precision of the engine.
    pub precision: Precision,
    /// Factor of the scene's pitch [-].
    pub pitch: f64,
    /// Accuracy of the run [-].
    pub accuracy: f64,
}

/// The settings of a curve, from coarse to fine.
#[derive(Clone, Debug, PartialEq)]
pub struct Ladder {
    /// What is varied.
    pub variant: Variant,
    /// The settings.
    pub rungs: Vec<Rung>,
    pub(crate) against: Against,
}

const ACCURACIES: [f64; 9] = [1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5, 1e-6];
const COARSE_ACCURACIES: [f64; 4] = [1e-1, 1e-2, 1e-3, 1e-4];
/// Factors of the scene's pitch.
const PITCHES: [f64; 9] = [4.0, 2.8, 2.0, 1.4, 1.0, 0.7, 0.5, 0.35, 0.25];
/// Factors of the scene's step.
const STEPS: [f64; 6] = [8.0, 4.0, 2.0, 1.0, 0.5, 0.25];
/// Factors of the scene's stiffness, and of Young's modulus.
const STIFFNESSES: [f64; 7] = [1.0 / 64.0, 1.0 / 16.0, 0.25, 0.5, 1.0, 4.0, 16.0];

impl Variant {
    /// Every variant, in the order of a study.
    pub const ALL: [Self; 9] = [
        Self::Accuracy,
        Self::Pitch,
        Self::Both,
        Self::Single,
        Self::Step(Resolve::Auto),
        Self::Step(Resolve::Lockstep),
        Self::Step(Resolve::QuasiStatic),
        Self::Stiffness,
        Self::Young,
    ];

    /// Its name in tables and pictures.
    pub fn name(self) -> &'static str {
        match self {
            Self::Accuracy => "accuracy",
            Self::Pitch => "pitch",
            Self::Both => "pitch and accuracy",
            Self::Single => "accuracy, f32",
            Self::Step(Resolve::Auto) => "step",
            Self::Step(Resolve::Micro) => "step, Micro",
            Self::Step(Resolve::Lockstep) => "step, Lockstep",
            Self::Step(Resolve::QuasiStatic) => "step, QuasiStatic",
            Self::Stiffness => "stiffness",
            Self::Young => "Young's modulus",
        }
    }

    /// What its number is, in tables; an `x` for a factor of what the scene has.
    pub fn counts(self) -> &'static str {
        match self {
            Self::Accuracy | Self::Single => "accuracy",
            Self::Pitch | Self::Both => "pitch x",
            Self::Step(_) => "step x",
            Self::Stiffness => "stiffness x",
            Self::Young => "Young x",
        }
    }

    /// True when its number is an error of computing: smaller is closer to the model.
    pub fn refines(self) -> bool {
        !matches!(self, Self::Stiffness | Self::Young)
    }
}

impl Ladder {
    /// The ladder of `variant` for a scene; none where the scene has nothing to vary.
    pub(crate) fn of(variant: Variant, checked: &Checked) -> Option<Self> {
        let run = &checked.scene.run;
        let accuracy = |value: f64| vec![sets::number("run.accuracy", value)];
        let rung = |value: f64, sets: Vec<String>| Rung {
            value,
            sets,
            precision: Precision::Double,
            pitch: 1.0,
            accuracy: run.accuracy,
        };
        let by_accuracy = |a: f64| Rung { accuracy: a, ..rung(a, accuracy(a)) };
        let by_pitch = |f: f64| Rung { pitch: f, ..rung(f, sets::pitch(checked, f)) };
        let (rungs, against): (Vec<Rung>, _) = match variant {
            Variant::Accuracy => {
                (ACCURACIES.into_iter().map(by_accuracy).collect(), Against::Finest)
            }
            Variant::Single => {
                let single = |a| Rung { precision: Precision::Single, ..by_accuracy(a) };
                let rungs = COARSE_ACCURACIES.into_iter().map(single);
                (rungs.collect(), Against::SameOf(Variant::Accuracy))
            }
            Variant::Pitch => (PITCHES.into_iter().map(by_pitch).collect(), Against::Finest),
            Variant::Both => {
                let rungs = PITCHES.into_iter().map(|f| {
                    let a = run.accuracy * f * f;
                    let mut rung = Rung { accuracy: a, ..by_pitch(f) };
                    rung.sets.extend(accuracy(a));
                    rung
                });
                (rungs.collect(), Against::Finest)
            }
            Variant::Step(resolve) => {
                let rungs = STEPS.into_iter().map(|f| {
                    let step = sets::number("run.step", run.step * f);
                    rung(f, vec![format!("run.resolve={resolve:?}"), step])
                });
                (rungs.collect(), Against::FinestOf(Variant::Step(Resolve::Auto)))
            }
            Variant::Stiffness => {
                let rungs = STIFFNESSES.into_iter().map(|f| rung(f, sets::stiffness(checked, f)));
                (rungs.collect(), Against::Scene)
            }
            Variant::Young => {
                let rungs = STIFFNESSES.into_iter().map(|f| rung(f, sets::young(checked, f)));
                (rungs.collect(), Against::Scene)
            }
        };
        let varies = rungs.iter().all(|rung| !rung.sets.is_empty())
            && (!matches!(variant, Variant::Pitch | Variant::Both)
                || !sets::pitch(checked, 1.0).is_empty());
        let idle = idles(variant, checked);
        (varies && !idle).then_some(Self { variant, rungs, against })
    }
}

/// True for what makes no difference to a scene, or cannot resolve it: a driven body is led by its
/// drive, whoever resolves the others; on closed and moving surfaces Lockstep and QuasiStatic do not
/// take bodies; QuasiStatic knows no impacts.
fn idles(variant: Variant, checked: &Checked) -> bool {
    let scene = &checked.scene;
    let motions = || scene.bodies.values().map(|body| &body.motion);
    let is_driven = motions().any(|motion| matches!(motion, Motion::Drive { .. }));
    let is_struck = motions().any(|motion| matches!(motion, Motion::Impact { .. }));
    let plates = scene
        .surfaces
        .values()
        .all(|surface| !surface.geometry.is_closed() && surface.motion == SurfaceMotion::Fixed);
    match variant {
        Variant::Single | Variant::Step(Resolve::Auto | Resolve::Micro) => is_driven,
        Variant::Step(Resolve::Lockstep) => is_driven || !plates,
        Variant::Step(Resolve::QuasiStatic) => is_driven || is_struck || !plates,
        Variant::Accuracy
        | Variant::Pitch
        | Variant::Both
        | Variant::Stiffness
        | Variant::Young => false,
    }
}
