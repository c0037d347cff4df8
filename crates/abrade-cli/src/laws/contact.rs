//! `abrade laws contact`: a model of a contact as a table and a picture.

use std::path::Path;

use abrade_laws::contact::{
    Advice, Branches, Contact, ContactModel, LAMBDA_OVER_TABOR, Pair, Parting, branches,
    maugis_lambda, tabor,
};
use abrade_laws::{Law, laws as all};
use abrade_report::chart::{Axis, Chart, Scale, Series, Stroke};
use abrade_report::quantity_text::{
    digits, energy, force, force_unit, length, length_unit, pressure,
};

use super::sides::{Sides, parameter};
use super::values::{self, Values, values};
use super::{find, limits, list, refused};
use crate::arguments::ContactArguments;
use crate::failure::Failure;
use crate::say::say;

/// Rows of a table whose displacements are not given.
const ROWS: u32 = 21;
/// Points of a curve.
const POINTS: u32 = 600;

/// What draws the models, below their list.
const DRAWN: &str = "\
to draw one:       abrade laws contact MODEL NAME=VALUE.. --out FILE.png
their pull-off:    abrade laws contact --limits --out FILE.png
";

/// A model, and what it was made with.
struct Asked {
    law: &'static Law,
    model: Box<dyn ContactModel>,
    /// Constants by name, in SI.
    constants: Vec<(&'static str, f64)>,
    /// Displacements of the table [m].
    displacements: Option<Vec<f64>>,
    /// z0 [m].
    distance: Option<f64>,
}

/// Lists the models, tabulates and draws one, or draws their limits.
pub(super) fn contact(arguments: &ContactArguments) -> Result<(), Failure> {
    if arguments.limits {
        return limits::limits(arguments.csv, arguments.out.as_deref());
    }
    let models = all().filter(|law| law.is_contact());
    let Some(name) = &arguments.model else {
        if arguments.out.is_some() || arguments.csv {
            return Err(refused(
                "there is nothing to show: name a model, or ask for --limits".into(),
            ));
        }
        return say(&format!("{}\n{DRAWN}", list(models)));
    };
    let asked = Asked::new(find("contact model", name, models)?, &arguments.given)?;
    let rows = asked.displacements.clone().unwrap_or_else(|| asked.span(ROWS));
    let table = asked.walk(rows)?;
    if let Some(path) = &arguments.out {
        asked.draw(path)?;
    }
    match arguments.csv {
        true => say(&csv(&table)),
        false => {
            let picture = arguments.out.as_deref().map(|path| format!("\n{}\n", path.display()));
            let text = [asked.told()?, text(&table), picture.unwrap_or_default()];
            say(&text.concat())
        }
    }
}

fn input(error: impl Into<anyhow::Error>) -> Failure {
    Failure::Input(error.into())
}

impl Asked {
    fn new(law: &'static Law, given: &[String]) -> Result<Self, Failure> {
        let (mut constants, mut displacements, mut distance) = (Vec::new(), None, None);
        let mut sides = Sides::default();
        let names = given.iter().map(|text| values::named(text).map(|(name, _)| name));
        values::once(names.collect::<Result<Vec<_>, _>>()?.into_iter())?;
        for text in given {
            if sides.take(text)? {
                continue;
            }
            let (name, list) = values::named(text)?;
            let known = law.find(name).is_ok();
            // Which model holds depends on it, also where the model itself does not.
            let Values { parameter: of, texts, numbers } = match name {
                "distance" if !known => values::of_parameter(parameter("tabor", "distance"), list)?,
                _ => values(law, text)?,
            };
            match (of.name, &numbers[..]) {
                ("displacement", _) => displacements = Some(numbers),
                ("distance", [number]) => distance = Some(*number),
                (name, [number]) => constants.push((name, *number)),
                (name, _) => {
                    let message = format!("`{name}` has {} values; one is needed", texts.len());
                    return Err(refused(message));
                }
            }
        }
        sides.reduce(&mut constants)?;
        if let (Some(distance), Ok(_)) = (distance, law.find("distance")) {
            constants.push(("distance", distance));
        }
        let model = law.contact(constants.iter().copied()).map_err(input)?;
        Ok(Self { law, model, constants, displacements, distance })
    }

    fn constant(&self, name: &str) -> Option<f64> {
        self.constants.iter().find(|(known, _)| *known == name).map(|(_, value)| *value)
    }

    /// `count` displacements over what is worth seeing [m].
    fn span(&self, count: u32) -> Vec<f64> {
        let [low, high] = self.model.usual_span();
        let step = (high - low) / f64::from(count - 1);
        (0..count).map(|i| low + step * f64::from(i)).collect()
    }

    fn walk(&self, displacements: Vec<f64>) -> Result<Branches, Failure> {
        branches(self.model.as_ref(), displacements).map_err(input)
    }

    /// What it is, what it takes to part, whether it holds.
    fn told(&self) -> Result<String, Failure> {
        let Parting { pull_off, pull_off_at, rests_at, touches_at, tears_at, work, loss } =
            self.model.parting();
        let mut lines = vec![self.law.title.to_owned(), format!("  {}", self.caption())];
        if pull_off < 0.0 {
            let place = length(pull_off_at);
            lines
                .push(format!("  pull-off force {} at a displacement of {place}", force(pull_off)));
            lines.push(format!("  without force at {}", length(rests_at)));
            let work = energy(work);
            lines.push(match (touches_at, tears_at) {
                (Some(touch), Some(tear)) => format!(
                    "  holds from {} on as they come together, to {} as they part: {work} part them \
                     from rest, {} are lost each time",
                    length(touch),
                    length(tear),
                    energy(loss)
                ),
                _ => format!("  the force fades over any distance; {work} part them from rest"),
            });
            lines.extend(self.advice()?);
        }
        Ok(lines.join("\n") + "\n\n")
    }

    fn caption(&self) -> String {
        let part = |(name, value): &(&str, f64)| match *name {
            "radius" => format!("R = {}", length(*value)),
            "modulus" => format!("E* = {}", pressure(*value)),
            "adhesion" => format!("w = {} J/m2", digits(*value)),
            "distance" => format!("z0 = {}", length(*value)),
            "strength" => format!("sigma0 = {}", pressure(*value)),
            "cohesion" => format!("k = {} J/m3", digits(*value)),
            name => format!("{name} = {}", digits(*value)),
        };
        self.constants.iter().map(part).collect::<Vec<_>>().join(", ")
    }

    /// Which model holds, where an elastic contact has a work of adhesion.
    fn advice(&self) -> Result<Option<String>, Failure> {
        let constants = ["radius", "modulus", "adhesion"].map(|name| self.constant(name));
        let [Some(radius), Some(modulus), Some(adhesion)] = constants else { return Ok(None) };
        let pair = Pair::new(radius, modulus).map_err(input)?;
        let parameter = match (self.distance, self.constant("strength")) {
            (Some(distance), _) => tabor(&pair, adhesion, distance).map_err(input)?,
            (None, Some(strength)) => {
                maugis_lambda(&pair, adhesion, strength).map_err(input)? / LAMBDA_OVER_TABOR
            }
            (None, None) => {
                let text = "  which model holds: give distance=.., the equilibrium distance z0 of the \
                            surfaces (0.15 to 0.4 nm)";
                return Ok(Some(text.to_owned()));
            }
        };
        let holds = Advice::of(parameter).name();
        let verdict = match holds == self.law.name {
            true => "this model holds".to_owned(),
            false => format!("take {holds}"),
        };
        Ok(Some(format!("  Tabor's parameter {}: {verdict}", digits(parameter))))
    }

    fn draw(&self, path: &Path) -> Result<(), Failure> {
        let walk = self.walk(self.points())?;
        let part = self.model.parting();
        let ends = [walk.displacements[0], walk.displacements[walk.displacements.len() - 1]];
        let longest = ends.map(f64::abs).into_iter().fold(0.0, f64::max);
        let strongest = walk.unloading.iter().map(|c| c.force.abs()).fold(0.0, f64::max);
        let ((metre, short), (newton, strong)) = (length_unit(longest), force_unit(strongest));
        let place = |d: f64, f: f64| [d / metre, f / newton];
        let curve = |contacts: &[Contact]| {
            let pairs = walk.displacements.iter().zip(contacts);
            pairs.map(|(d, contact)| place(*d, contact.force)).collect::<Vec<_>>()
        };
        let mut series = vec![
            Series {
                name: "parting".into(),
                points: curve(&walk.unloading),
                stroke: Stroke::Line,
                ..Series::default()
            },
            Series {
                name: "coming together".into(),
                points: curve(&walk.loading),
                stroke: Stroke::Dashes,
                ..Series::default()
            },
        ];
        if part.pull_off < 0.0 {
            series.push(Series {
                name: format!("pull-off {}", typeset(&force(part.pull_off))),
                points: vec![place(part.pull_off_at, part.pull_off)],
                ..Series::default()
            });
        }
        let x = format!("displacement ({}), negative for a gap", typeset(short));
        let y = format!("force ({}), negative where it pulls", typeset(strong));
        let chart = Chart {
            title: self.law.title.split(':').next().unwrap_or(self.law.title),
            caption: &typeset(&self.caption()),
            x: Axis { name: &x, scale: Scale::Linear },
            y: Axis { name: &y, scale: Scale::Linear },
            series: &series,
        };
        chart.write(path).map_err(input)
    }

    /// Displacements of the curve, with both sides of its leaps.
    fn points(&self) -> Vec<f64> {
        let mut points = match &self.displacements {
            Some(given) => {
                let low = given.iter().copied().fold(f64::INFINITY, f64::min);
                let high = given.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                let step = (high - low) / f64::from(POINTS);
                (0..=POINTS).map(|i| low + step * f64::from(i)).collect()
            }
            None => self.span(POINTS),
        };
        let (low, high) = (points[0], points[points.len() - 1]);
        let part = self.model.parting();
        let leaps = [part.touches_at, part.tears_at].into_iter().flatten();
        let beside = 1e-9 * (high - low);
        let sides = leaps.flat_map(|leap| [leap - beside, leap + beside]);
        points.extend(sides.filter(|d| (low..=high).contains(d)));
        points
    }
}

/// Signs that the letters of a picture have and a terminal may lack.
fn typeset(text: &str) -> String {
    text.replace(" um", " µm")
        .replace(" uN", " µN")
        .replace("J/m2", "J/m²")
        .replace('-', "\u{2212}")
}

/// The rows of both branches, for people.
fn text(table: &Branches) -> String {
    let mut text = format!(
        "{:>17}  {:^29}  {:^29}\n{:>17}  {:>13} {:>15}  {:>13} {:>15}\n",
        "",
        "coming together",
        "parting",
        "displacement [m]",
        "force [N]",
        "radius [m]",
        "force [N]",
        "radius [m]"
    );
    for (d, [up, down]) in rows(table) {
        text += &format!(
            "{d:>17.5e}  {:>13.5e} {:>15.5e}  {:>13.5e} {:>15.5e}\n",
            up.force, up.radius, down.force, down.radius
        );
    }
    text
}

/// The rows of both branches, to every digit.
fn csv(table: &Branches) -> String {
    let head = "displacement [m],loading force [N],loading radius [m],unloading force [N],\
                unloading radius [m]\n";
    let row = |(d, [up, down]): (f64, [&Contact; 2])| {
        format!("{d:e},{:e},{:e},{:e},{:e}\n", up.force, up.radius, down.force, down.radius)
    };
    head.to_owned() + &rows(table).map(row).collect::<String>()
}

fn rows(table: &Branches) -> impl Iterator<Item = (f64, [&Contact; 2])> {
    let pairs = table.loading.iter().zip(&table.unloading);
    table.displacements.iter().zip(pairs).map(|(d, (up, down))| (*d, [up, down]))
}
