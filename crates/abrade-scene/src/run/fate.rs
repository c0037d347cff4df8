//! What became of a body, as far as a summary may speak of a rebound.

use nalgebra::Vector3;

use crate::run::bodies::Track;
use crate::run::summary::Run;

/// Speed over that of the approach below which a body has come to rest.
const REST: f64 = 1e-4;

/// What became of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fate {
    /// It is in contact, or rests.
    Stays,
    /// It has left, or flies on its way to a surface again.
    Left,
    /// It has touched nothing.
    Missed,
    /// It is below the flat surface that it was aimed at, and goes on down.
    FellThrough,
    /// It cannot be moved, or slides on a drive.
    Led,
}

/// The fate of the body `index`, whose path is `track`.
pub(crate) fn fate(run: &Run<'_>, index: usize, track: &Track) -> Fate {
    if track.slide.is_some() || track.inertia.is_immovable() {
        return Fate::Led;
    }
    let state = run.engine.state(index);
    let speed = track.approach.unwrap_or(track.start.velocity).norm();
    if run.engine.open_contact(index).is_some() || state.velocity.norm() <= REST * speed {
        return Fate::Stays;
    }
    let below = track.aim.is_some_and(|frame| {
        let local = state.seen_from(&frame);
        local.position.z < 0.0 && local.velocity.z < 0.0
    });
    let touched = track.contact_time > 0.0 || track.impulse != Vector3::zeros();
    match track.approach.is_some() || touched {
        true if below => Fate::FellThrough,
        true => Fate::Left,
        false => Fate::Missed,
    }
}
