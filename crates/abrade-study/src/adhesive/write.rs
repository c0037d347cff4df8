//! The files of a map: `cases.csv`, `points.csv`, `boundary.csv` and `map.png`.

use std::fmt::Write as _;
use std::path::Path;

use abrade_adhesive::Mode;
use abrade_report::quantity_text::count;
use abrade_report::{Cell, Regimes, atomic};

use super::map::{MODES, Map};
use crate::error::StudyError;

/// What the legend calls cases that ended early.
const EARLY: &str = "ended early";
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
                    small_pieces,worn,transferred,debris,failed,parted,are_joined,failure\n"
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
    let column = |mode: &Mode| mode.name().replace(" + ", "_and_").replace(' ', "_");
    let names: Vec<String> = MODES.iter().map(column).collect();
    let mut text = format!(
        "strength_ratio,shear_strength_Pa,adhesion_ratio,runs,early_runs,ground_runs,split_runs,{},mean_ground,\
         mean_largest_piece,mean_worn\n",
        names.join(",")
    );
    for point in &map.points {
        let modes = point.modes.map(|count| count.to_string()).join(",");
        // Of no run there is no mean.
        let mean = |value: f64| if point.runs > 0 { value.to_string() } else { String::new() };
        let [ground, piece, worn] = point.means.map(mean);
        let _ = writeln!(
            text,
            "{},{},{},{},{},{},{},{modes},{ground},{piece},{worn}",
            point.strength_ratio,
            point.shear_strength,
            point.adhesion_ratio,
            point.runs,
            point.early_runs,
            point.ground_runs,
            point.split_runs
        );
    }
    text
}

fn boundaries(map: &Map) -> String {
    let mut text = "strength_ratio,shear_strength_Pa,boundary,low95,high95,paper_eq4\n".to_owned();
    for (ratio, strength, boundary) in map.boundaries() {
        let found = match boundary {
            Some(boundary) => {
                let [low, high] =
                    boundary.ends().map(|end| end.map_or(String::new(), |end| end.to_string()));
                format!("{},{low},{high}", boundary.at)
            }
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
        counts: [&point.modes[..], &[point.early_runs]].concat(),
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
            fitted.intervals.push(boundary.ends());
        }
    }
    let names: Vec<&str> = MODES.iter().map(|mode| mode.name()).chain([EARLY]).collect();
    let caption = format!(
        "overlap {}, {}; a cell is cut by the shares of its runs",
        map.file.bodies.overlap,
        drawn(map)
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

/// How many runs the cells show.
fn drawn(map: &Map) -> String {
    match map.missing() {
        0 => format!("{} per point", count(map.file.gaps.len(), "gap", "gaps")),
        missing => {
            let there = map.cases.len();
            format!("{there} of {}", count(there + missing, "case", "cases"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::map::Point;
    use super::*;

    /// Fails for an open end of an interval that is written as if it were one: the runs do not bound it above.
    #[test]
    fn an_open_end_is_an_empty_cell() {
        let text =
            r#"(version: 1, name: "open", adhesion_ratios: [0.0, 0.4, 0.8, 1.1, 1.35, 1.6])"#;
        let file = super::super::load_map_text(Path::new("map.ron"), text.into(), &[]).unwrap();
        let ground = [0, 0, 2, 2, 4, 3];
        let point = |(&adhesion_ratio, ground)| Point {
            strength_ratio: 1.0,
            shear_strength: 4.5e6,
            adhesion_ratio,
            runs: 5,
            ground_runs: ground,
            ..Point::default()
        };
        let points = file.adhesion_ratios.iter().zip(ground).map(point).collect();
        let map = Map { file, cases: Vec::new(), points };
        let text = boundaries(&map);
        let cells: Vec<&str> = text.lines().nth(1).unwrap().split(',').collect();
        assert!(!cells[3].is_empty() && cells[4].is_empty(), "{text}");
    }

    /// Fails for runs without contact that count as runs which did not grind, or have no column.
    #[test]
    fn runs_without_contact_have_a_column_of_their_own() {
        assert!(MODES.contains(&Mode::NoContact));
        let text = r#"(version: 1, name: "apart", adhesion_ratios: [0.0, 1.0])"#;
        let file = super::super::load_map_text(Path::new("map.ron"), text.into(), &[]).unwrap();
        let mut modes = [0; MODES.len()];
        modes[MODES.len() - 1] = 4;
        let base = Point { strength_ratio: 1.0, shear_strength: 4.5e6, ..Point::default() };
        let points = vec![
            Point { runs: 5, ground_runs: 1, modes, ..base },
            Point { adhesion_ratio: 1.0, runs: 5, ground_runs: 5, ..base },
        ];
        let map = Map { file, cases: Vec::new(), points };
        let head = super::points(&map).lines().next().unwrap().to_owned();
        assert!(head.contains(",grinding_and_breakaway,no_contact,mean_ground"), "{head}");
        // The one run that touched ground as well: there is no boundary.
        assert_eq!(map.boundaries()[0].2, None);
    }
}
