//! The kinds of files that commands read: each is loaded here, so that a file given to a command that reads
//! another kind is told by its command instead of by the words that are strange to this one.

use std::path::Path;

use abrade_scene::{Checked, SceneError};
use abrade_study::adhesive::{self, MapFile, SceneFile};
use abrade_study::erosion::{self, StudyFile};
use anyhow::anyhow;

use crate::failure::Failure;

/// A kind of file, by the command that reads it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Scene,
    Erosion,
    Asperities,
    Map,
}

const KINDS: [Kind; 4] = [Kind::Scene, Kind::Erosion, Kind::Asperities, Kind::Map];

/// A scene of bodies and surfaces.
pub(crate) fn scene(path: &Path, sets: &[String]) -> Result<Checked, Failure> {
    abrade_scene::load(path, sets).map_err(|error| Kind::Scene.refused(path, error))
}

/// A study of erosion.
pub(crate) fn erosion(path: &Path, sets: &[String]) -> Result<StudyFile, Failure> {
    erosion::load(path, sets).map_err(|error| Kind::Erosion.refused(path, error))
}

/// A scene of two asperities.
pub(crate) fn asperities(path: &Path, sets: &[String]) -> Result<SceneFile, Failure> {
    adhesive::load_scene(path, sets).map_err(|error| Kind::Asperities.refused(path, error))
}

/// A map of two asperities.
pub(crate) fn map(path: &Path, sets: &[String]) -> Result<MapFile, Failure> {
    adhesive::load_map(path, sets).map_err(|error| Kind::Map.refused(path, error))
}

impl Kind {
    fn command(self) -> &'static str {
        match self {
            Self::Scene => "abrade run",
            Self::Erosion => "abrade study erosion",
            Self::Asperities => "abrade adhesive run",
            Self::Map => "abrade adhesive map",
        }
    }

    fn is_of(self, path: &Path) -> bool {
        match self {
            Self::Scene => abrade_scene::load(path, &[]).is_ok(),
            Self::Erosion => erosion::load(path, &[]).is_ok(),
            Self::Asperities => adhesive::load_scene(path, &[]).is_ok(),
            Self::Map => adhesive::load_map(path, &[]).is_ok(),
        }
    }

    /// What is wrong with the file: `error`, unless it is a sound file of another kind.
    fn refused(self, path: &Path, error: SceneError) -> Failure {
        match KINDS.into_iter().filter(|kind| *kind != self).find(|kind| kind.is_of(path)) {
            Some(kind) => {
                Failure::Input(anyhow!("{} is a file for `{}`", path.display(), kind.command()))
            }
            None => Failure::Scene(error),
        }
    }
}
