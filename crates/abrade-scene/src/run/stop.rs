//! When a run ends.

use crate::run::bodies::Bodies;
use crate::run::engine::{Engine, Stepped};
use crate::scene::{Run, Stop};

/// Why a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum End {
    Rebounded,
    Exited,
    TimeOver,
    Slid,
    Impacts,
    Interrupted,
    Failed,
}

impl End {
    /// In words, for the summary.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Rebounded => "every body moves away from every surface, or rests",
            Self::Exited => "the body has left the surface, or has come to rest in it",
            Self::TimeOver => "the time limit is reached",
            Self::Slid => "every driven body has slid its distance",
            Self::Impacts => "the number of impacts is reached",
            Self::Interrupted => "interrupted",
            Self::Failed => "failed",
        }
    }

    /// True for the end that the scene asks for.
    pub(crate) fn is_complete(self) -> bool {
        !matches!(self, Self::Interrupted | Self::Failed)
    }
}

/// Length of the next step [s].
pub(crate) fn step_length(run: &Run, time: f64) -> f64 {
    match run.stop {
        Stop::Time { limit } => run.step.min(limit - time),
        _ => run.step,
    }
}

/// The end of the run, once its rule holds.
pub(crate) fn reached(
    run: &Run,
    engine: &dyn Engine,
    bodies: &Bodies,
    stepped: &Stepped,
    time: f64,
) -> Option<End> {
    let away = || bodies.all_away(engine, time).then_some(End::Rebounded);
    match run.stop {
        Stop::AllRebounded => away(),
        Stop::FirstExit if stepped.exited => Some(End::Exited),
        Stop::FirstExit => away(),
        Stop::Time { limit } => (time >= limit).then_some(End::TimeOver),
        Stop::Distance => slid(engine, bodies).then_some(End::Slid),
        Stop::Impacts { count } if bodies.impacts >= count => Some(End::Impacts),
        Stop::Impacts { .. } => away(),
    }
}

/// Part of the run that is done, where the rule tells.
pub(crate) fn share(run: &Run, engine: &dyn Engine, bodies: &Bodies, time: f64) -> Option<f64> {
    match run.stop {
        Stop::Time { limit } => Some(time / limit),
        Stop::Impacts { count } if count > 0 => Some(bodies.impacts as f64 / count as f64),
        _ => {
            let driven =
                (0..bodies.tracks.len()).filter(|&body| bodies.tracks[body].slide.is_some());
            let slides = driven.filter_map(|body| {
                let driven = engine.driven(body)?;
                let distance = driven.drive().distance;
                (distance > 0.0).then(|| driven.travelled() / distance)
            });
            slides.reduce(f64::min).or(bodies.share_come())
        }
    }
}

fn slid(engine: &dyn Engine, bodies: &Bodies) -> bool {
    let mut driven = (0..bodies.tracks.len()).filter_map(|body| engine.driven(body));
    driven.all(abrade::Driven::is_done)
}
