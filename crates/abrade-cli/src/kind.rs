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

/// What a file of any kind holds.
pub(crate) enum Read {
    Scene(Box<Checked>),
    Erosion(StudyFile),
    Asperities(SceneFile),
    Map(MapFile),
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

/// A file of whatever kind it is.
pub(crate) fn any(path: &Path, sets: &[String]) -> Result<Read, Failure> {
    match Kind::of(path, Kind::Scene) {
        Kind::Scene => scene(path, sets).map(Box::new).map(Read::Scene),
        Kind::Erosion => erosion(path, sets).map(Read::Erosion),
        Kind::Asperities => asperities(path, sets).map(Read::Asperities),
        Kind::Map => map(path, sets).map(Read::Map),
    }
}

impl Kind {
    /// The kind that knows the most of the names in the file at `path`; of several, `first` or the first.
    fn of(path: &Path, first: Self) -> Self {
        // What cannot be read here has no names, and is refused where it is loaded.
        let text = std::fs::read_to_string(path).unwrap_or_default();
        let names = abrade_scene::field_names(&text);
        let kinds = [first].into_iter().chain(KINDS);
        let known = kinds.map(|kind| (kind.known(&names), kind)).rev();
        known.max_by_key(|(known, _)| *known).map_or(first, |(_, kind)| kind)
    }

    /// How many of `names` are fields of this kind of file.
    fn known(self, names: &[&str]) -> usize {
        let schema = match self {
            Self::Scene => abrade_scene::schema(),
            Self::Erosion => erosion::schema(),
            Self::Asperities => adhesive::scene_schema(),
            Self::Map => adhesive::map_schema(),
        };
        names.iter().filter(|name| schema["properties"].get(**name).is_some()).count()
    }

    fn command(self) -> &'static str {
        match self {
            Self::Scene => "abrade run",
            Self::Erosion => "abrade study erosion",
            Self::Asperities => "abrade adhesive run",
            Self::Map => "abrade adhesive map",
        }
    }

    /// What is wrong with the file: `error`, unless another kind knows more of its names.
    fn refused(self, path: &Path, error: SceneError) -> Failure {
        match Self::of(path, self) {
            kind if kind == self => Failure::Scene(error),
            kind => {
                Failure::Input(anyhow!("{} is a file for `{}`", path.display(), kind.command()))
            }
        }
    }
}
