//! The craters of a study: the first sample of every case, made once more to be looked at.

use std::path::Path;

use abrade::Surface;
use abrade_report::{Crater, Gallery, ReportError};

use super::case::{Case, Range};
use super::charts::Drawn;
use super::file::{Plate, StudyFile};

/// Distance from the place of impact up to which nodes are shown, in diameters.
const REACH: f64 = 2.5;

/// The picture of the first crater of every grain and angle at the first speed; None for studies on worn
/// plates, where one crater cannot be told from the others.
pub(crate) fn craters(file: &StudyFile, folder: &Path) -> Result<Option<Drawn>, ReportError> {
    if !matches!(file.plate, Plate::Fresh) {
        return Ok(None);
    }
    let cases = file.cases();
    let row = |name: &String| {
        let at = |angle: &f64| {
            let is = |case: &&Case| case.is(name, file.speeds[0], *angle);
            cases.iter().find(is).and_then(|case| crater(file, folder, case)).unwrap_or_default()
        };
        (name.clone(), file.angles.iter().map(at).collect())
    };
    let alt = "Craters of the same attitude of each grain, flying to the right";
    let gallery = Gallery {
        title: alt,
        caption: &format!(
            "the first sample of each case, at {} m/s, all to one scale",
            file.speeds[0]
        ),
        columns: file.angles.iter().map(|angle| format!("{:.0} deg", angle.to_degrees())).collect(),
        rows: file.grains.keys().map(row).collect(),
    };
    Ok(Some(Drawn { name: "craters.png", alt: alt.to_owned(), png: gallery.to_png()? }))
}

/// The crater of the first sample of `case`; None where it has none.
fn crater(file: &StudyFile, folder: &Path, case: &Case) -> Option<Crater> {
    let range = Range::new(file, folder, case).ok()?;
    let landed = range.land(0, &range.plate).ok()?;
    let (_, changes) = landed.outcome.ok()?;
    let mut plate = Surface::clone(&range.plate);
    plate.apply(&changes);
    let (sin, cos) = file.samples.at(0).azimuth.sin_cos();
    let reach = REACH * file.size.diameter();
    let nodes = plate.nodes().rest_position.iter().enumerate();
    let near = nodes.filter(|(_, at)| at.coords.norm() < reach);
    // Turned so that the grain flew along x.
    let seen = |(i, at): (usize, &nalgebra::Point3<f64>)| {
        [at.x * cos + at.y * sin, at.y * cos - at.x * sin, plate.depth(i)]
    };
    Some(Crater { nodes: near.map(seen).collect(), pitch: plate.pitch() })
}
