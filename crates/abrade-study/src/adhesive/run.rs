//! One collision, with its files: ParaView series, time series, picture, summary.

use std::path::Path;

use abrade_adhesive::{AdhesiveError, Collision};
use abrade_report::run_files;
use abrade_scene::Progress;

use super::file::SceneFile;
use super::frames::{Frames, PICTURE};
use super::series::Series;
use super::summary::Summary;
use crate::error::StudyError;

/// Files of a run; of a series its list.
const FILES: [&str; 5] = ["summary.json", "elements.pvd", "links.pvd", "timeseries.csv", PICTURE];
/// Steps between two looks at the user's wish to stop.
const STRETCH: usize = 256;

/// How a run ended.
#[derive(Debug)]
pub struct Ended {
    /// What came of it, as far as it went.
    pub summary: Summary,
    /// Why it ended before the bodies were past each other.
    pub failure: Option<AdhesiveError>,
    /// The user broke it off.
    pub interrupted: bool,
}

/// Runs the scene and writes its files into `folder`, in the place of what an earlier run left there; those of a run that ends early as well.
///
/// # Errors
/// The bodies overlap at the start, or a file cannot be written.
pub fn run(
    file: &SceneFile,
    folder: &Path,
    progress: &mut dyn Progress,
) -> Result<Ended, StudyError> {
    let mut collision = Collision::new(&file.solid, &file.bodies)?;
    run_files::begin(folder, &FILES.map(str::to_owned))?;
    let mut frames = Frames::new(file, folder);
    let mut series = Series::new(file);
    let (mut failure, mut interrupted) = (None, false);
    while collision.share() < 1.0 && failure.is_none() && !interrupted {
        frames.see(&collision)?;
        series.see(&collision);
        // Up to the next instant that a file shows.
        let due = frames.next().min(series.next()).min(1.0);
        let mut steps = 0;
        while collision.share() < due && steps < STRETCH && failure.is_none() {
            failure = collision.step().err();
            steps += 1;
        }
        interrupted = !progress.advance(collision.simulation().time(), Some(collision.share()));
    }
    frames.finish(&collision)?;
    series.finish(&collision, folder)?;
    let summary = Summary::of(file, &collision, failure.as_ref());
    summary.write(folder)?;
    Ok(Ended { summary, failure, interrupted })
}
