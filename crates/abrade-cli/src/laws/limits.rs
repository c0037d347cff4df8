//! `abrade laws contact --limits`: the pull-off force from DMT to JKR.

use std::f64::consts::PI;
use std::path::Path;

use abrade_laws::contact::{
    Advice, ContactError, ContactModel, Dmt, Jkr, LAMBDA_OVER_TABOR, MaugisDugdale, Pair,
};
use abrade_report::chart::{Axis, Chart, Scale, Series, Stroke};

use crate::failure::Failure;
use crate::say::say;

/// Exponents of ten of Tabor's parameter, and steps of the table and of the curve in a decade.
const DECADES: [i32; 2] = [-3, 2];
const STEPS: [i32; 2] = [3, 20];

/// A pull-off force over pi w R at a Tabor parameter [-].
#[derive(Clone, Copy)]
struct Row {
    tabor: f64,
    maugis: f64,
    advice: Advice,
}

/// Prints the table, and draws the curve if there is a file for it.
pub(super) fn limits(csv: bool, out: Option<&Path>) -> Result<(), Failure> {
    let input = |error: ContactError| Failure::Input(error.into());
    let [dmt, jkr] = ends().map_err(input)?;
    if let Some(path) = out {
        let curve = rows(STEPS[1]).map_err(input)?;
        draw(&curve, [dmt, jkr], path)?;
    }
    let rows = rows(STEPS[0]).map_err(input)?;
    let text = match csv {
        true => {
            let line = |row: &Row| {
                let lambda = LAMBDA_OVER_TABOR * row.tabor;
                format!("{:e},{lambda:e},{dmt:e},{:e},{jkr:e}\n", row.tabor, row.maugis)
            };
            let head = "tabor [-],lambda [-],dmt [-],maugis-dugdale [-],jkr [-]\n".to_owned();
            head + &rows.iter().map(line).collect::<String>()
        }
        false => {
            let line = |row: &Row| {
                let [mu, force] = [row.tabor, row.maugis];
                format!("  {mu:<10.4} {force:<16.6} {}\n", row.advice.name())
            };
            let head = format!(
                "pull-off force over pi w R: DMT {dmt:.4}, JKR {jkr:.4}\n\n  {:<10} {:<16} holds\n",
                "Tabor's mu", "maugis-dugdale"
            );
            let picture = out.map_or_else(String::new, |path| format!("\n{}\n", path.display()));
            head + &rows.iter().map(line).collect::<String>() + &picture
        }
    };
    say(&text)
}

/// Any pair: the forces over pi w R do not depend on it.
const RADIUS: f64 = 1e-3;
const ADHESION: f64 = 0.1;

fn pair() -> Result<Pair, ContactError> {
    Pair::new(RADIUS, 1e9)
}

fn reduced(model: &dyn ContactModel) -> f64 {
    model.parting().pull_off / (PI * ADHESION * RADIUS)
}

/// DMT's and JKR's.
fn ends() -> Result<[f64; 2], ContactError> {
    let [dmt, jkr]: [Box<dyn ContactModel>; 2] =
        [Box::new(Dmt::new(pair()?, ADHESION)?), Box::new(Jkr::new(pair()?, ADHESION)?)];
    Ok([reduced(dmt.as_ref()), reduced(jkr.as_ref())])
}

fn rows(steps: i32) -> Result<Vec<Row>, ContactError> {
    let places = DECADES[0] * steps..=DECADES[1] * steps;
    let row = |place: i32| {
        let tabor = 10f64.powf(f64::from(place) / f64::from(steps));
        let maugis = reduced(&MaugisDugdale::with_tabor(pair()?, ADHESION, tabor)?);
        Ok(Row { tabor, maugis, advice: Advice::of(tabor) })
    };
    places.map(row).collect()
}

fn draw(rows: &[Row], [dmt, jkr]: [f64; 2], path: &Path) -> Result<(), Failure> {
    let ends = [rows[0].tabor, rows[rows.len() - 1].tabor];
    let level = |name: &str, force: f64| Series {
        name: name.to_owned(),
        points: ends.map(|tabor| [tabor, force]).to_vec(),
        stroke: Stroke::Dashes,
        ..Series::default()
    };
    let curve = Series {
        name: "Maugis-Dugdale".to_owned(),
        points: rows.iter().map(|row| [row.tabor, row.maugis]).collect(),
        stroke: Stroke::Line,
        ..Series::default()
    };
    let limit = |name: String, tabor: f64| {
        let nearest = |a: &&Row, b: &&Row| {
            let far = |row: &&Row| (row.tabor / tabor).ln().abs();
            far(a).total_cmp(&far(b))
        };
        let row = rows.iter().min_by(nearest);
        let points = row.map(|row| [row.tabor, row.maugis]).into_iter().collect();
        Series { name, points, ..Series::default() }
    };
    let [low, high] = Advice::LIMITS;
    let series = [
        curve,
        level("DMT, \u{2212}2", dmt),
        level("JKR, \u{2212}1.5", jkr),
        limit(format!("below {low} take DMT"), low),
        limit(format!("above {high} take JKR"), high),
    ];
    let chart = Chart {
        title: "Pull-off force from DMT to JKR",
        caption: "elastic balls; attraction as strong as that of Lennard-Jones surfaces",
        x: Axis { name: "Tabor's parameter (R w² / E*² z0³)^(1/3)", scale: Scale::Log },
        y: Axis { name: "pull-off force / (pi w R)", scale: Scale::Linear },
        series: &series,
    };
    chart.write(path).map_err(|error| Failure::Input(error.into()))
}
