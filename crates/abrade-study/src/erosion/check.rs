//! What can be wrong with a study whose words are right.

use std::path::Path;

use abrade::{NODE_LIMIT, ParameterError, SurfaceError};
use abrade_report::quantity_text::digits;
use abrade_scene::scene::Form;
use abrade_scene::{Document, FileKind, SceneError, Usual, file_text, material_notes, name_fault};

use super::file::{Plate, StudyFile, VERSION};

/// A study without a known fault.
///
/// # Errors
/// Everything that is wrong with the file at `path`, with the `sets` applied.
pub fn load(path: &Path, sets: &[String]) -> Result<StudyFile, SceneError> {
    load_text(path, file_text(path, "study")?, sets)
}

/// [`load`] for a text that was read from `path`.
///
/// # Errors
/// Everything that is wrong with it.
pub fn load_text(path: &Path, text: String, sets: &[String]) -> Result<StudyFile, SceneError> {
    let kind = FileKind { name: "study", version: VERSION };
    let mut document = Document::<StudyFile>::read(&path.display().to_string(), text, sets, kind)?;
    let folder = path.parent().unwrap_or(Path::new("."));
    check_target(&mut document);
    check_names(&mut document);
    check_ranges(&mut document);
    // No grain has a size that is none, and no plate is made for what is refused.
    if document.value.size.diameter() > 0.0 {
        check_grains(&mut document, folder);
    }
    if document.is_sound() {
        check_plates(&mut document, folder);
    }
    let mut file = document.finish()?;
    if file.reference.is_none() {
        let sphere = file.grains.iter().find(|(_, grain)| grain.form == Form::Sphere);
        file.reference = sphere.map(|(name, _)| name.clone());
    }
    Ok(file)
}

/// Values of a study without a fault that no solid has.
pub fn notes(file: &StudyFile) -> Vec<String> {
    let material = material_notes(&["target", "material"], &file.target.material);
    let others = [
        file.target.density.and_then(|rho| Usual::DENSITY.note(&["target", "density"], rho)),
        Usual::DENSITY.note(&["density"], file.density),
        Usual::GRAIN.note(&["size", "diameter"], file.size.diameter()),
    ];
    material.chain(others.into_iter().flatten()).collect()
}

fn check_target(document: &mut Document<StudyFile>) {
    let target = document.value.target.clone();
    for error in target.material.check() {
        document.out_of_range(&["target", "material"], &error);
    }
    if let Some(error) = target.density.and_then(|rho| ParameterError::positive("density", rho)) {
        document.out_of_range(&["target"], &error);
    }
    for error in target.elastic.check() {
        document.out_of_range(&["target", "elastic"], &error);
    }
    for error in target.removal.check() {
        document.out_of_range(&["target", "removal"], &error);
    }
    // What is out of range was noted above, and has a place of its own.
    let errors = target.laws().check();
    let missing = errors.into_iter().find(|error| !matches!(error, SurfaceError::Parameter(_)));
    if let Some(error) = missing {
        document.refuse(&["target"], error.to_string(), "");
    }
}

fn check_grains(document: &mut Document<StudyFile>, folder: &Path) {
    let names: Vec<String> = document.value.grains.keys().cloned().collect();
    for name in &names {
        if let Err(error) = document.value.grain(name, 0, folder) {
            let path = ["grains", name.as_str(), "form"];
            document.refuse(&path, format!("the grain `{name}`: {error}"), "");
        }
    }
}

fn check_names(document: &mut Document<StudyFile>) {
    let names: Vec<String> = document.value.grains.keys().cloned().collect();
    if names.is_empty() {
        document.refuse(&["grains"], "the study has no grains", "name at least one");
    }
    if let Some(reference) = document.value.reference.clone().filter(|name| !names.contains(name)) {
        let known = names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
        let message = format!("there is no grain `{reference}`");
        document.refuse(&["reference"], message, format!("expected one of {known}"));
    }
}

/// A plate of more nodes than there may be is refused before anything is made.
fn check_plates(document: &mut Document<StudyFile>, folder: &Path) {
    let file = document.value.clone();
    let nodes = |(name, speed): (&String, f64)| {
        let median = file.grain_of_median_size(name, 0, folder).ok()?;
        let [columns, rows] = file.strip(&median, speed).columns_rows();
        (columns * rows > NODE_LIMIT).then(|| (name.clone(), speed, columns * rows))
    };
    let all = file.grains.keys().flat_map(|name| file.speeds.iter().map(move |&v| (name, v)));
    if let Some((name, speed, nodes)) = all.into_iter().find_map(nodes) {
        let message = format!(
            "the plate of the grain `{name}` at {} m/s would have {nodes:.1e} nodes",
            digits(speed)
        );
        let label = format!("lower it: at most {NODE_LIMIT:.0e} nodes are allowed");
        document.refuse(&["resolution"], message, label);
    }
}

fn check_ranges(document: &mut Document<StudyFile>) {
    let file = document.value.clone();
    let (samples, size) = (&file.samples, &file.size);
    let positive = ParameterError::positive;
    let mut errors: Vec<(&[&str], Option<ParameterError>)> = vec![
        (&[], positive("density", file.density)),
        (&["size"], positive("diameter", size.diameter())),
        (&["size"], ParameterError::within("spread", size.spread(), 0.0, 1.0)),
        (&[], ParameterError::within("resolution", file.resolution, 1.0, 1000.0)),
        (&[], ParameterError::within("accuracy", file.accuracy, 1e-6, 0.1)),
        (&["samples"], ParameterError::within("least", samples.least.into(), 2.0, 1e6)),
        (
            &["samples"],
            ParameterError::within("most", samples.most.into(), samples.least.into(), 1e6),
        ),
        (&["samples"], positive("interval", samples.interval)),
    ];
    if let Plate::Worn { width } = file.plate {
        errors.push((&["plate"], positive("width", width)));
    }
    for (path, error) in errors {
        if let Some(error) = error {
            document.out_of_range(path, &error);
        }
    }
    for (field, values) in [("speeds", &file.speeds), ("angles", &file.angles)] {
        if values.is_empty() {
            document.refuse(&[field], format!("`{field}` is empty"), "give at least one");
        }
        for (at, &value) in values.iter().enumerate() {
            let right = std::f64::consts::FRAC_PI_2 * (1.0 + 1e-12);
            let fine = value > 0.0 && (field == "speeds" || value <= right);
            if !fine {
                let label = match field {
                    "speeds" => "must be above zero",
                    _ => "must be above zero and at most 90 deg, a bare number is in rad",
                };
                let path = [field, &at.to_string()];
                document.refuse(&path, format!("`{field}.{at}` is out of range"), label);
            }
            if values[..at].contains(&value) {
                let path = [field, &at.to_string()];
                document.refuse(&path, format!("`{field}.{at}` is there twice"), "leave it out");
            }
        }
    }
    if let Some(fault) = name_fault(&file.name) {
        document.refuse(&["name"], "`name` names nothing", fault);
    }
}
