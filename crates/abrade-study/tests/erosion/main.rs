//! Erosion studies: against theory, and as files that parts of them leave.

#![allow(missing_docs, reason = "tests")]

mod grains;
mod parts;
mod theory;

use std::path::Path;

use abrade_scene::Progress;
use abrade_study::erosion::{self, Case, Erosion, StudyFile};

/// Never stops.
struct Quiet;

impl Progress for Quiet {
    fn advance(&mut self, _: f64, _: Option<f64>) -> bool {
        true
    }
}

/// The study of this text.
fn study(text: &str) -> StudyFile {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("study.ron");
    std::fs::write(&path, text).expect("a file");
    erosion::load(&path, &[]).unwrap_or_else(|error| panic!("{error}"))
}

/// Makes `cases` in `out`.
fn make(file: &StudyFile, cases: &[Case], out: &Path) {
    assert_eq!(erosion::make(file, Path::new(""), cases, out, &mut Quiet).expect("cases"), []);
}

/// The whole study, made in a folder of its own.
fn whole(file: &StudyFile) -> Erosion {
    let folder = tempfile::tempdir().expect("a folder");
    make(file, &file.cases(), folder.path());
    erosion::result(file, Path::new(""), folder.path()).expect("a result")
}

/// A sphere's speed at which m V^2 / (2 pi H R^3) = 0.01, for a density of 2650 kg/m3 and a hardness of
/// 1.7 GPa [m/s].
const SPEED: f64 = 98.1;

/// A study of `grains` at `angles`, with `least` impacts per case.
fn text(grains: &str, angles: &str, least: u32) -> String {
    format!(
        "(version: 1, name: \"test\",
          target: (material: (hardness: \"1.7 GPa\"), removal: AttackAngle(critical: \"35 deg\")),
          grains: {{ {grains} }}, density: 2650.0, size: Volume(diameter: \"200 um\"),
          speeds: [{SPEED}], angles: [{angles}], samples: (least: {least}, most: {least}))"
    )
}
