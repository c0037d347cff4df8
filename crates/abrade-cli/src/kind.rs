//! The kinds of files that commands read: each is loaded here, so that a file given to a command that reads
//! another kind is told by its command instead of by the words that are strange to this one.

use std::path::Path;

use abrade_scene::{Checked, SceneError, file_text};
use abrade_study::adhesive::{self, MapFile, SceneFile};
use abrade_study::erosion::{self, StudyFile};
use anyhow::anyhow;

use crate::failure::Failure;
use crate::part;

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

/// The kinds; a file that could be of several is taken for the first.
const KINDS: [Kind; 4] = [Kind::Scene, Kind::Erosion, Kind::Asperities, Kind::Map];

/// A scene of bodies and surfaces.
pub(crate) fn scene(path: &Path, sets: &[String]) -> Result<Checked, Failure> {
    Kind::Scene.load(path, |text| scene_of(path, text, sets))
}

/// A study of erosion.
pub(crate) fn erosion(path: &Path, sets: &[String]) -> Result<StudyFile, Failure> {
    Kind::Erosion.load(path, |text| erosion::load_text(path, text, sets))
}

/// A scene of two asperities.
pub(crate) fn asperities(path: &Path, sets: &[String]) -> Result<SceneFile, Failure> {
    Kind::Asperities.load(path, |text| adhesive::load_scene_text(path, text, sets))
}

/// A map of two asperities.
pub(crate) fn map(path: &Path, sets: &[String]) -> Result<MapFile, Failure> {
    Kind::Map.load(path, |text| adhesive::load_map_text(path, text, sets))
}

/// A file of whatever kind it is: of several that know as many of its names, of the first that finds no fault.
pub(crate) fn any(path: &Path, sets: &[String]) -> Result<Read, Failure> {
    let text = Kind::Scene.text(path)?;
    let mut faults = Vec::new();
    for kind in Kind::likely(&text) {
        match kind.read(path, text.clone(), sets) {
            Ok(read) => return Ok(read),
            Err(error) => faults.push(error),
        }
    }
    Err(part_or(path, faults.swap_remove(0)))
}

/// That the file at `path` is a part of scenes, or else what is wrong with it.
fn part_or(path: &Path, error: SceneError) -> Failure {
    part::told(path).map_or(Failure::Scene(error), |told| Failure::Input(anyhow!(told)))
}

fn scene_of(path: &Path, text: String, sets: &[String]) -> Result<Checked, SceneError> {
    let folder = path.parent().map(Path::to_owned).unwrap_or_default();
    abrade_scene::load_text(&path.display().to_string(), text, folder, sets)
}

impl Kind {
    /// What `read` makes of the text of the file at `path`, which is read once: it may be a pipe.
    fn load<T>(
        self,
        path: &Path,
        read: impl FnOnce(String) -> Result<T, SceneError>,
    ) -> Result<T, Failure> {
        let text = self.text(path)?;
        read(text.clone()).map_err(|error| self.refused(path, &text, error))
    }

    fn text(self, path: &Path) -> Result<String, Failure> {
        file_text(path, self.name()).map_err(|error| part_or(path, error))
    }

    fn read(self, path: &Path, text: String, sets: &[String]) -> Result<Read, SceneError> {
        match self {
            Self::Scene => scene_of(path, text, sets).map(Box::new).map(Read::Scene),
            Self::Erosion => erosion::load_text(path, text, sets).map(Read::Erosion),
            Self::Asperities => adhesive::load_scene_text(path, text, sets).map(Read::Asperities),
            Self::Map => adhesive::load_map_text(path, text, sets).map(Read::Map),
        }
    }

    /// The kinds that know the most of the names in `text`; at least one.
    fn likely(text: &str) -> Vec<Self> {
        let names = abrade_scene::field_names(text);
        let known = KINDS.map(|kind| kind.known(&names));
        let most = known.into_iter().max().unwrap_or(0);
        let all = KINDS.into_iter().zip(known);
        all.filter(|(_, known)| *known == most).map(|(kind, _)| kind).collect()
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

    /// What a file of this kind is called in messages.
    fn name(self) -> &'static str {
        match self {
            Self::Scene | Self::Asperities => "scene",
            Self::Erosion => "study",
            Self::Map => "map",
        }
    }

    /// What is wrong with the file of this `text`: `error`, unless other kinds know more of its names.
    fn refused(self, path: &Path, text: &str, error: SceneError) -> Failure {
        let likely = Self::likely(text);
        match likely.first() {
            Some(kind) if !likely.contains(&self) => {
                Failure::Input(anyhow!("{} is a file for `{}`", path.display(), kind.command()))
            }
            _ => part_or(path, error),
        }
    }
}
