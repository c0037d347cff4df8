//! Everything that can be wrong with a scene whose words are right, found in one go: ranges,
//! names, geometry.

mod body;
mod carrier;
mod closed;
mod copies;
mod hardness;
mod impact_laws;
mod led_path;
mod motion;
mod placement;
mod rows;
mod run;
mod stream;
mod surface;

use std::collections::BTreeMap;
use std::path::PathBuf;

use abrade::{ParameterError, TriangleMesh};

use crate::document;
use crate::led_path::LedPath;
use crate::patched::Patched;
use crate::problem::{Mark, Problem, Source, any_of, suggestion};
use crate::scene::Scene;
use crate::solid::Solid;
use crate::spans::{Node, ScenePath};
use crate::{coarse, unlikely, way};

/// A scene without a known fault, and the solids of its bodies.
#[derive(Clone, Debug, PartialEq)]
pub struct Checked {
    /// The scene, with the bodies of its streams and the copies of its surfaces among the others.
    pub scene: Scene,
    /// Names of the bodies of each stream, in the order in which they come.
    pub streamed: BTreeMap<String, Vec<String>>,
    /// When the bodies of streams come, by their names [s].
    pub due: BTreeMap<String, f64>,
    /// Names of the copies of each surface that has some, in the order of their numbers. The
    /// scene's surfaces are the copies.
    pub copied: BTreeMap<String, Vec<String>>,
    /// Folder in which the files that it names lie.
    pub folder: PathBuf,
    /// Geometry and inertia of each body.
    pub solids: BTreeMap<String, Solid>,
    /// Meshes of the closed surfaces, by name; their vertices are the nodes.
    pub meshes: BTreeMap<String, TriangleMesh>,
    /// Hardness of every node over that of the material, of surfaces where it differs [-].
    pub hardness: BTreeMap<String, Vec<f32>>,
    /// Paths of the surfaces that are led along one, by name.
    pub paths: BTreeMap<String, LedPath>,
    /// What the user should know beside the result.
    pub notes: Vec<String>,
}

impl Checked {
    /// True for the name of a body of a stream.
    pub fn is_streamed(&self, name: &String) -> bool {
        self.due.contains_key(name)
    }
}

/// Checks `scene`, whose text is `patched` and whose tree is `tree`.
pub(crate) fn check(
    mut scene: Scene,
    folder: PathBuf,
    patched: &mut Patched,
    tree: &Node,
) -> Result<Checked, Vec<Problem>> {
    let mut checker = Checker::new(&scene, patched, tree);
    checker.check_name();
    checker.check_finite("gravity", &scene.gravity);
    let mut notes = Vec::new();
    checker.check_materials();
    let meshes = checker.check_surfaces(&folder, &mut notes);
    checker.check_copies(&meshes);
    let hardness = checker.check_hardnesses(&folder, &meshes);
    let mut solids = checker.check_bodies(&folder, &meshes, &mut notes);
    let streamed = checker.check_streams(&folder, &meshes, &mut notes);
    checker.check_run();
    let Checker { problems, paths, .. } = checker;
    if !problems.is_empty() {
        return Err(problems);
    }
    solids.extend(streamed.solids);
    scene.bodies.extend(streamed.bodies);
    let (streamed, due) = (streamed.names, streamed.due);
    let copied = BTreeMap::new();
    let mut checked =
        Checked { scene, streamed, due, copied, folder, solids, meshes, hardness, paths, notes };
    let doubts = [unlikely::notes(&checked), way::notes(&checked), coarse::notes(&checked)];
    checked.notes.extend(doubts.concat());
    checked.copy_surfaces();
    Ok(checked)
}

/// Collects problems and finds their places.
struct Checker<'a> {
    scene: &'a Scene,
    patched: &'a mut Patched,
    tree: &'a Node,
    problems: Vec<Problem>,
    /// Paths of led surfaces, as soon as the surfaces are checked.
    paths: BTreeMap<String, LedPath>,
}

impl<'a> Checker<'a> {
    fn new(scene: &'a Scene, patched: &'a mut Patched, tree: &'a Node) -> Self {
        Self { scene, patched, tree, problems: Vec::new(), paths: BTreeMap::new() }
    }
}

impl Checker<'_> {
    /// The mark of the value at `path`, or of the nearest that is written on the way to it.
    fn mark(&self, path: &ScenePath, label: impl Into<String>) -> Mark {
        document::mark(self.patched, self.tree, path, label)
    }

    fn refuse(&mut self, path: &ScenePath, message: String, label: impl Into<String>) {
        let marks = vec![self.mark(path, label)];
        self.problems.push(Problem { message, marks, help: None });
    }

    /// A value of the field named in `error`, directly inside `path`.
    fn out_of_range(&mut self, path: &ScenePath, error: &ParameterError) {
        let path = path.join(error.field);
        let allowed = document::allowed(error);
        self.refuse(&path, format!("`{path}` is out of range"), format!("must be {allowed}"));
    }

    /// The errors among `results`, each a value inside `path`.
    fn ranges(
        &mut self,
        path: &ScenePath,
        results: impl IntoIterator<Item = Option<ParameterError>>,
    ) {
        for error in results.into_iter().flatten() {
            self.out_of_range(path, &error);
        }
    }

    /// A name at `path` that should be among `known`.
    fn undefined(&mut self, path: &ScenePath, kind: &str, name: &str, known: &[&str]) {
        let label = match known.is_empty() {
            true => format!("the scene defines no {kind}"),
            false => format!("expected {}", any_of(known.iter().copied())),
        };
        let mark = self.mark(path, label);
        self.problems.push(Problem {
            message: format!("there is no {kind} `{name}`"),
            marks: vec![mark],
            help: suggestion(name, known.iter().copied()),
        });
    }

    /// Adds a source that is no part of the scene's text.
    fn add_source(&mut self, source: Source) -> usize {
        self.patched.add_source(source)
    }

    fn check_finite(&mut self, field: &'static str, values: &[f64]) {
        self.ranges(&ScenePath::default(), [vector(field, values)]);
    }

    fn check_name(&mut self) {
        if let Some(fault) = document::name_fault(&self.scene.name) {
            self.refuse(&ScenePath::of(["name"]), "`name` names nothing".into(), fault);
        }
    }

    fn check_materials(&mut self) {
        for (name, material) in &self.scene.materials {
            let path = ScenePath::of(["materials", name]);
            self.ranges(&path, material.check().into_iter().map(Some));
        }
    }
}

/// The error of a value that is not finite.
fn finite(field: &'static str, value: f64) -> ParameterError {
    ParameterError { field, value, allowed: "finite".into() }
}

/// The error of a vector with a component that is not finite.
fn vector(field: &'static str, values: &[f64]) -> Option<ParameterError> {
    values.iter().find(|x| !x.is_finite()).map(|&x| finite(field, x))
}

/// An error unless `value` is finite and not below zero.
fn not_negative(field: &'static str, value: f64) -> Option<ParameterError> {
    let fine = value.is_finite() && value >= 0.0;
    let allowed = "finite and not below zero".to_owned();
    (!fine).then_some(ParameterError { field, value, allowed })
}
