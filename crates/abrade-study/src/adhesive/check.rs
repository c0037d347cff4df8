//! What can be wrong with a scene or a map whose words are right.

use std::path::Path;

use abrade::ParameterError;
use abrade_adhesive::{Asperities, Profile, Solid};
use abrade_scene::{Document, FileKind, SceneError, file_text, name_fault};

use super::file::{MapFile, SceneFile, VERSION};
use super::outline;

/// Most cases of a map: one takes seconds.
const CASES: usize = 1_000_000;

/// A scene without a known fault; its outline, if it names one, is in `bodies.profile`.
///
/// # Errors
/// Everything that is wrong with the file at `path`, with the `sets` applied.
pub fn load_scene(path: &Path, sets: &[String]) -> Result<SceneFile, SceneError> {
    load_scene_text(path, file_text(path, "scene")?, sets)
}

/// [`load_scene`] for a text that was read from `path`.
///
/// # Errors
/// Everything that is wrong with it.
pub fn load_scene_text(
    path: &Path,
    text: String,
    sets: &[String],
) -> Result<SceneFile, SceneError> {
    let kind = FileKind { name: "scene", version: VERSION };
    let mut document = Document::<SceneFile>::read(&path.display().to_string(), text, sets, kind)?;
    if let Some(outline) = document.value.outline.clone() {
        let folder = path.parent().unwrap_or(Path::new("."));
        if document.gives(&["bodies", "profile"]) {
            let label = "leave out one of them";
            document.refuse(&["outline"], "`outline` and `bodies.profile` are both given", label);
        }
        match outline::read(folder, &outline, &document.value.bodies) {
            Ok(points) => document.value.bodies.profile = Profile::Line { points },
            Err(reason) => document.refuse(&["outline"], reason, ""),
        }
    }
    let file = document.value.clone();
    check_name(&mut document, &file.name);
    if check_bodies(&mut document, &file.solid, &file.bodies)
        && let Some(error) = file.bodies.overlap_at_start()
    {
        document.out_of_range(&["bodies"], &error);
    }
    for (field, value, most) in [("frames", file.frames, 10_000.0), ("rows", file.rows, 1e7)] {
        if let Some(error) = ParameterError::within(field, value.into(), 1.0, most) {
            document.out_of_range(&[], &error);
        }
    }
    document.finish()
}

/// A map without a known fault, with the solid's own ratio and strength where it names none.
///
/// # Errors
/// Everything that is wrong with the file at `path`, with the `sets` applied.
pub fn load_map(path: &Path, sets: &[String]) -> Result<MapFile, SceneError> {
    load_map_text(path, file_text(path, "map")?, sets)
}

/// [`load_map`] for a text that was read from `path`.
///
/// # Errors
/// Everything that is wrong with it.
pub fn load_map_text(path: &Path, text: String, sets: &[String]) -> Result<MapFile, SceneError> {
    let kind = FileKind { name: "map", version: VERSION };
    let mut document = Document::<MapFile>::read(&path.display().to_string(), text, sets, kind)?;
    let solid = document.value.solid;
    let given =
        [&document.value.strength_ratios, &document.value.shear_strengths].map(|v| !v.is_empty());
    if document.value.strength_ratios.is_empty() {
        document.value.strength_ratios = vec![solid.strength_ratio];
    }
    if document.value.shear_strengths.is_empty() {
        document.value.shear_strengths = vec![solid.shear_strength];
    }
    let file = document.value.clone();
    check_name(&mut document, &file.name);
    check_varied(&mut document, given);
    let is_sound = check_bodies(&mut document, &solid, &file.bodies);
    for (field, values, [low, high]) in [
        ("strength_ratios", &file.strength_ratios, [1.0, 1000.0]),
        ("shear_strengths", &file.shear_strengths, [f64::MIN_POSITIVE, f64::MAX]),
        ("adhesion_ratios", &file.adhesion_ratios, [0.0, f64::MAX]),
        ("gaps", &file.gaps, [-1e5, 1e5]),
    ] {
        check_list(&mut document, field, values, [low, high]);
    }
    let sizes = [&file.strength_ratios, &file.shear_strengths, &file.adhesion_ratios, &file.gaps];
    let count: f64 = sizes.iter().map(|list| list.len() as f64).product();
    if count > CASES as f64 {
        let message = format!("the map would have {count:.1e} cases");
        document.refuse(&["gaps"], message, format!("at most {CASES} are allowed"));
    }
    check_cases(&mut document, &file, count);
    if is_sound {
        check_gaps(&mut document, &file);
    }
    document.finish()
}

/// Refuses values that a map would take from its lists all the same; `given` tells whether those of ratios and
/// strengths are.
fn check_varied(document: &mut Document<MapFile>, [ratios, strengths]: [bool; 2]) {
    for (path, list, counts) in [
        (["solid", "adhesion"], "adhesion_ratios", true),
        (["bodies", "gap"], "gaps", true),
        (["solid", "strength_ratio"], "strength_ratios", ratios),
        (["solid", "shear_strength"], "shear_strengths", strengths),
    ] {
        if counts && document.gives(&path) {
            let message = format!("`{}` counts for nothing in this map", path.join("."));
            document.refuse(&path, message, format!("give `{list}` alone"));
        }
    }
}

/// Refuses gaps from which the bodies would overlap.
fn check_gaps(document: &mut Document<MapFile>, file: &MapFile) {
    for (at, &gap) in file.gaps.iter().enumerate() {
        let bodies = Asperities { gap, ..file.bodies.clone() };
        if let Some(error) = bodies.overlap_at_start() {
            let message = format!("`gaps.{at}` is out of range");
            let label = format!("must be {}", error.allowed);
            document.refuse(&["gaps", &at.to_string()], message, label);
        }
    }
}

/// Refuses a map whose points all lie above the tensile strength.
fn check_cases(document: &mut Document<MapFile>, file: &MapFile, points: f64) {
    if points > 0.0 && points <= CASES as f64 && file.cases().is_empty() {
        let label = "all points lie above the tensile strength of the solid";
        document.refuse(&["adhesion_ratios"], "the map has no case", label);
    }
}

fn check_list(
    document: &mut Document<MapFile>,
    field: &'static str,
    values: &[f64],
    [low, high]: [f64; 2],
) {
    if values.is_empty() {
        document.refuse(&[field], format!("`{field}` is empty"), "give at least one");
    }
    for (at, value) in values.iter().enumerate() {
        let place = at.to_string();
        if let Some(error) = ParameterError::within(field, *value, low, high) {
            let label = format!("must be {}", error.allowed);
            document.refuse(&[field, &place], format!("`{field}.{at}` is out of range"), label);
        }
        if values[..at].contains(value) {
            let message = format!("`{field}.{at}` is there twice");
            document.refuse(&[field, &place], message, "leave it out");
        }
    }
}

fn check_name<T>(document: &mut Document<T>, name: &str) {
    if let Some(fault) = name_fault(name) {
        document.refuse(&["name"], "`name` names nothing", fault);
    }
}

/// Refuses what is wrong with solid and bodies; true where nothing is.
fn check_bodies<T>(document: &mut Document<T>, solid: &Solid, bodies: &Asperities) -> bool {
    let faults = [solid.check(), bodies.check()];
    for error in &faults[0] {
        document.out_of_range(&["solid"], error);
    }
    for error in &faults[1] {
        let path: &[&str] = match error.field {
            "top" | "height" | "side" | "points" => &["bodies", "profile"],
            "angle" | "amplitude" => &["bodies", "packing"],
            _ => &["bodies"],
        };
        document.out_of_range(path, error);
    }
    if !faults.concat().is_empty() {
        return false;
    }
    let together = [
        ("bodies", bodies.unstable(solid)),
        ("bodies", bodies.too_fast(solid)),
        ("solid", bodies.beyond_reach(solid)),
    ];
    let mut is_sound = true;
    for (place, error) in together {
        if let Some(error) = error {
            document.out_of_range(&[place], &error);
            is_sound = false;
        }
    }
    is_sound
}
