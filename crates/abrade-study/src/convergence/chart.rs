//! The study as `study.png`: error against wall time.

use std::path::Path;

use abrade_report::chart::{Axis, Chart, Scale, Series};

use crate::convergence::Study;
use crate::convergence::compare::Curve;
use crate::error::StudyError;

/// Error that is drawn at least [-]: below lies what no one chooses a setting for.
const DRAWN: f64 = 1e-9;

/// Draws one curve per variant that brings a run closer to the model.
pub(crate) fn write(study: &Study, path: &Path) -> Result<(), StudyError> {
    let refining = study.curves.iter().filter(|curve| curve.variant.refines());
    let series: Vec<Series> = refining.map(series).collect();
    let chart = Chart {
        title: &study.scene,
        caption: "error of the wear volume, each curve against its own finest run",
        x: Axis { name: "wall time of a run (s)", scale: Scale::Log },
        y: Axis { name: "relative error (-)", scale: Scale::Log },
        series: &series,
    };
    Ok(chart.write(path)?)
}

fn series(curve: &Curve) -> Series {
    let rows = curve.rows.iter().filter(|row| row.failure.is_none());
    let points = rows.filter_map(|row| Some([row.wall, row.errors.wear?]));
    let slope = curve.slope.map_or_else(String::new, |slope| format!(": slope {slope:.1}"));
    Series {
        name: format!("{}{slope}", curve.variant.name()),
        points: points.filter(|point| point[1] > DRAWN).collect(),
        ..Series::default()
    }
}
