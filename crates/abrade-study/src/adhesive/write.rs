//! The files of a map: `cases.csv`, `points.csv`, `boundary.csv` and `map.png`.

use std::fmt::Write as _;
use std::path::Path;

use abrade_report::quantity_text::count;
use abrade_report::{Cell, Regimes, atomic};

use super::fit::Boundary;
use super::map::{MODES, Map};
use crate::error::StudyError;

/// A* of the paper's Fig. 7, where a = 1: sigma_0* = A* sigma_j.
const SLOPE: f64 = 1.2;
/// beta_1 of the paper's Eq. 4, of which it says that it is of the order of unity.
const DECREASE: f64 = 1.0;
/// a_crit of that equation.
const CRITICAL: f64 = 1.5;

/// The paper's Eq. 4: sigma_0* / sigma_j at the ratio a, with beta_0 = 1.2 / (1 + nu) and beta_1 = 1.
fn paper(ratio: f64, poisson: f64) -> f64 {
    SLOPE - DECREASE * (ratio.min(CRITICAL) - 1.0) * (1.0 + poisson)
}

/// Writes what a map came to into `out`.
///
/// # Errors
/// The file system refuses, or the drawing library does.
pub fn write(map: &Map, out: &Path) -> Result<(), StudyError> {
    atomic::write(&out.join("cases.csv"), cases(map).as_bytes())?;
    atomic::write(&out.join("points.csv"), points(map).as_bytes())?;
    atomic::write(&out.join("boundary.csv"), boundaries(map).as_bytes())?;
    atomic::write(&out.join("map.png"), &picture(map)?)?;
    Ok(())
}

fn cases(map: &Map) -> String {
    let mut text =
        "case,strength_ratio,shear_strength_Pa,adhesion_ratio,gap_d,mode,ground,largest_piece,\
                    small_pieces,worn,transferred,debris,failed,parted,joined,failure\n"
            .to_owned();
    for (case, made) in &map.cases {
        let _ = write!(
            text,
            "{},{},{},{},{},",
            case.number, case.strength_ratio, case.shear_strength, case.adhesion_ratio, case.gap
        );
        let _ = match made {
            Ok(f) => writeln!(
                text,
                "{},{},{},{},{},{},{},{},{},{},",
                f.mode().name(),
                f.ground,
                f.largest_piece,
                f.small_pieces,
                f.worn,
                f.transferred,
                f.debris,
                f.failed,
                f.parted,
                f.are_joined
            ),
            Err(failure) => writeln!(text, ",,,,,,,,,,\"{}\"", failure.replace('"', "'")),
        };
    }
    text
}

fn points(map: &Map) -> String {
    let names: Vec<String> = MODES.iter().map(|mode| mode.name().replace(" + ", "_and_")).collect();
    let mut text = format!(
        "strength_ratio,shear_strength_Pa,adhesion_ratio,runs,failed,ground,split,{},mean_ground,\
         mean_largest_piece,mean_worn\n",
        names.join(",")
    );
    for point in &map.points {
        let modes = point.modes.map(|count| count.to_string()).join(",");
        let [ground, piece, worn] = point.means;
        let _ = writeln!(
            text,
            "{},{},{},{},{},{},{},{modes},{ground},{piece},{worn}",
            point.strength_ratio,
            point.shear_strength,
            point.adhesion_ratio,
            point.runs,
            point.failed,
            point.ground,
            point.split
        );
    }
    text
}

fn boundaries(map: &Map) -> String {
    let mut text = "strength_ratio,shear_strength_Pa,boundary,low95,high95,paper_eq4\n".to_owned();
    for (ratio, strength, boundary) in map.boundaries() {
        let found = match boundary {
            Some(Boundary { at, interval: [low, high], .. }) => format!("{at},{low},{high}"),
            None => ",,".to_owned(),
        };
        let paper = paper(ratio, map.file.solid.poisson);
        let _ = writeln!(text, "{ratio},{strength},{found},{paper}");
    }
    text
}

/// Over a; or over sigma_j, with sigma_0 upwards, where several of those stand at one a.
fn picture(map: &Map) -> Result<Vec<u8>, StudyError> {
    let over_strength = map.file.strength_ratios.len() == 1 && map.file.shear_strengths.len() > 1;
    let place = |ratio: f64, strength: f64| if over_strength { strength / 1e6 } else { ratio };
    let cells = map.points.iter().map(|point| Cell {
        at: [place(point.strength_ratio, point.shear_strength), point.adhesion_ratio],
        counts: point.modes.to_vec(),
    });
    let mut fitted = abrade_report::Boundary {
        name: "half of the runs grind, 95 %".into(),
        ..abrade_report::Boundary::default()
    };
    let mut eq4 = abrade_report::Boundary {
        name: if over_strength { "Fig. 7: 1.2 sigma_j" } else { "Eq. 4, beta_1 = 1" }.into(),
        is_dashed: true,
        ..abrade_report::Boundary::default()
    };
    for (ratio, strength, boundary) in map.boundaries() {
        let x = place(ratio, strength);
        eq4.points.push([x, paper(ratio, map.file.solid.poisson)]);
        if let Some(boundary) = boundary {
            fitted.points.push([x, boundary.at]);
            fitted.intervals.push(boundary.interval);
        }
    }
    let names = MODES.map(|mode| mode.name());
    let caption = format!(
        "overlap {}, {} per point; a cell is cut by the shares of its runs",
        map.file.bodies.overlap,
        count(map.file.gaps.len(), "gap", "gaps")
    );
    let x = if over_strength { "shear strength sigma_j (MPa)" } else { "ratio of strengths a" };
    let regimes = Regimes {
        title: &map.file.name,
        caption: &caption,
        axes: [x, "sigma_0 / sigma_j"],
        classes: &names,
        cells: cells.collect(),
        boundaries: vec![fitted, eq4],
    };
    Ok(regimes.to_png()?)
}
