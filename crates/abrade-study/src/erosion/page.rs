//! `report.html`: what the study says, in sentences, pictures and tables.

use abrade_report::quantity_text::{count, digits};
use abrade_report::sheet::{Part, Sheet};

use super::charts::Drawn;
use super::descriptors::LEVEL;
use super::laws::{self, Prediction};
use super::method;
use super::quantities::STILL;
use super::sensitivity::Sensitivity;
use super::statistics::Estimate;
use super::summary::{CaseResult, Erosion};
use super::table::{NOTHING, fixed, percent, told};

impl Erosion {
    /// The page, with these pictures.
    pub(crate) fn page(&self, pictures: Vec<Drawn>) -> Sheet {
        let speed = self.file.speeds[0];
        let laws = laws::predictions(&self.file, speed);
        let mut parts =
            vec![Part::Text { heading: "What came out".into(), lines: self.answers(&laws) }];
        parts.extend(pictures.into_iter().map(|Drawn { png, alt, .. }| Part::Picture { png, alt }));
        parts.extend(self.file.speeds.iter().map(|&speed| self.cases_table(speed)));
        parts.push(self.laws_table(&laws));
        parts.extend(self.sensitivity_table());
        parts.push(self.grains_table());
        parts.push(Part::Text { heading: "How it was made".into(), lines: self.method() });
        let impacts: usize = self.cases.iter().map(|result| result.impacts).sum();
        Sheet {
            title: self.file.name.clone(),
            subtitle: format!(
                "{} in {}",
                count(impacts, "impact", "impacts"),
                count(self.cases.len(), "case", "cases")
            ),
            parts,
        }
    }

    /// How much more, at which angle, how certain, and beside which laws.
    fn answers(&self, laws: &[Prediction]) -> Vec<String> {
        let mut lines: Vec<String> =
            self.file.grains.keys().filter_map(|name| self.answer(name)).collect();
        let peaks: Vec<String> = laws.iter().map(|law| self.peak(law)).collect();
        lines.push(format!(
            "Closed-form laws of debris, each where it is largest of these angles: {}.",
            peaks.join("; ")
        ));
        lines.extend(self.wide());
        lines.push(
            "± is half of the 95 % interval. Displaced volume is not mass loss: debris is what the removal \
             rule takes of it."
                .into(),
        );
        lines
    }

    /// The grain of this `name`, in a sentence.
    fn answer(&self, name: &str) -> Option<String> {
        let all = self.of_grain(name, self.file.speeds[0]);
        let (cases, without): (Vec<&CaseResult>, Vec<&CaseResult>) =
            all.partition(|result| result.impacts > 0);
        let (Some(first), Some(last)) = (cases.first(), cases.last()) else {
            return (!without.is_empty()).then(|| format!("{name}: no impact has a result."));
        };
        let degrees = |result: &CaseResult| digits(result.case.angle.to_degrees());
        let debris = |result: &CaseResult| result.quantity("removed_mm3_per_kg");
        // What the samples can tell from none comes first.
        let is_told = |result: &CaseResult| debris(result).value > debris(result).half_width;
        let rank = |result: &CaseResult| (is_told(result), debris(result).value);
        let before = |a: &(bool, f64), b: &(bool, f64)| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1));
        let most = cases.iter().max_by(|a, b| before(&rank(a), &rank(b)))?;
        let leaves = match is_told(most) {
            true => format!("most debris at {} deg, {} mm³/kg", degrees(most), sign(&debris(most))),
            false if debris(most).value > 0.0 => {
                "less debris than the samples can tell from none".to_owned()
            }
            false => "no debris by the removal rule".to_owned(),
        };
        let reference = self.file.reference.as_deref().filter(|reference| *reference != name);
        let ratio = |result: &CaseResult| {
            Some(format!("{} at {} deg", sign(&result.wear_ratio?), degrees(result)))
        };
        Some(match (reference, ratio(first), ratio(last)) {
            (Some(reference), Some(one), Some(other)) => format!(
                "{name}: displaces, per mass, {one} to {other} times as much as {reference} of the same {}; \
                 {leaves}.",
                self.file.size.word()
            ),
            _ => format!("{name}: {leaves}."),
        })
    }

    /// Where a law is largest.
    fn peak(&self, law: &Prediction) -> String {
        let peak = self.file.angles.iter().zip(&law.volumes).max_by(|a, b| a.1.total_cmp(b.1));
        let told = peak.map(|(angle, volume)| {
            format!("{} mm³/kg at {} deg", digits(*volume), digits(angle.to_degrees()))
        });
        format!("{} {}", law.name, told.unwrap_or_default())
    }

    fn of_grain<'a>(&'a self, name: &'a str, speed: f64) -> impl Iterator<Item = &'a CaseResult> {
        self.cases.iter().filter(move |r| r.case.grain == name && r.case.speed == speed)
    }

    fn cases_table(&self, speed: f64) -> Part {
        let head = [
            "grain, angle",
            "impacts",
            "displaced mm³/kg",
            "over reference",
            "debris mm³/kg",
            "over reference",
            "energy in wear",
            "depth µm",
            "restitution",
            "normal",
            "tangential",
            "turns on",
            "turns back",
            "chips",
        ];
        let cases = self.cases.iter().filter(|result| result.case.speed == speed);
        Part::Table {
            heading: format!("Cases at {} m/s", digits(speed)),
            note: format!(
                "Energy in wear is a share of that before the impact. Restitution is speed after over speed \
                 before, and the same of its parts; a grain turns on if its rim goes round, the way a wheel \
                 rolls, at more than {STILL} of its speed. {NOTHING}: no impact \
                 displaces any, or the removal rule takes none of it."
            ),
            head: head.map(str::to_owned).to_vec(),
            rows: cases.map(row).collect(),
        }
    }

    fn laws_table(&self, laws: &[Prediction]) -> Part {
        let degrees = |angle: &f64| format!("{} deg", digits(angle.to_degrees()));
        let head = ["law".to_owned(), "given".to_owned()].into_iter();
        Part::Table {
            heading: "Closed-form laws, in mm³/kg".into(),
            note: format!(
                "At {} m/s. Formulas, constants and sources: abrade laws --list.",
                digits(self.file.speeds[0])
            ),
            head: head.chain(self.file.angles.iter().map(degrees)).collect(),
            rows: laws
                .iter()
                .map(|law| {
                    let names = [law.name.to_owned(), law.given.clone()].into_iter();
                    names.chain(law.volumes.iter().map(|volume| digits(*volume))).collect()
                })
                .collect(),
        }
    }

    /// What the debris hangs on, at the angle nearest to 30 degrees.
    fn sensitivity_table(&self) -> Option<Part> {
        let off = |angle: f64| (angle - 30f64.to_radians()).abs();
        let nearest = self.file.angles.iter().min_by(|a, b| off(**a).total_cmp(&off(**b)))?;
        let at: Vec<_> = self.sensitivities.iter().filter(|s| s.angle == *nearest).collect();
        let reference = self.file.reference.as_deref()?;
        let tells = |column: &usize| at.iter().any(|s| s.ratios[*column].1.value.is_finite());
        let columns: Vec<usize> = (0..at.first()?.ratios.len()).filter(tells).collect();
        let degrees = |angle: f64| format!("{} deg", digits(angle.to_degrees()));
        let cells = |name: &str, cell: &dyn Fn(usize) -> String| {
            let cells = columns.iter().map(|column| cell(*column));
            [name.to_owned()].into_iter().chain(cells).collect::<Vec<_>>()
        };
        let head = cells("grain", &|column| degrees(at[0].ratios[column].0));
        let row = |s: &&Sensitivity| cells(&s.grain, &|column| sign(&s.ratios[column].1));
        Some(Part::Table {
            heading: format!(
                "Debris of {reference} over that of the grain at {}, by critical angle",
                degrees(*nearest)
            ),
            note: format!(
                "Debris is what faces cut at an angle of attack above the critical one, and chips; {NOTHING}: \
                 {reference} leaves none. Factors of shape in use are those of E/CRC: 0.2 for round and 0.53 for \
                 rounded sand, 1 for angular."
            ),
            head,
            rows: at.iter().map(row).collect(),
        })
    }

    fn grains_table(&self) -> Part {
        let head = [
            "grain",
            "mass µg",
            "diameter µm",
            "Feret µm",
            "sphericity",
            "roundness",
            "attack deg",
            "spike SPQ",
            "fit µm",
            "tip µm",
        ];
        let micro = |value: Option<f64>| value.map_or("-".to_owned(), |value| digits(1e6 * value));
        let rows = self.grains.iter().map(|(name, d)| {
            vec![
                name.clone(),
                digits(1e9 * d.mass_kg),
                digits(1e6 * d.volume_diameter_m),
                digits(1e6 * d.feret_diameter_m),
                digits(d.sphericity),
                d.roundness.map_or("-".to_owned(), digits),
                digits(d.attack_angle_rad.to_degrees()),
                digits(d.spike),
                micro(d.fit_error_m),
                micro(d.tip_radius_m),
            ]
        });
        Part::Table {
            heading: "Grains".into(),
            note: format!(
                "Diameter of the sphere of the same volume; sphericity by Wadell; roundness is tip radius over \
                 that of the largest inner sphere; attack is the mean angle from the surface to the front at a \
                 height of {LEVEL} diameters; SPQ by Hamblin and Stachowiak; fit is how far a clump stays below \
                 its form."
            ),
            head: head.map(str::to_owned).to_vec(),
            rows: rows.collect(),
        }
    }

    /// How many cases ran out of samples before their interval was as narrow as asked for.
    pub(crate) fn wide(&self) -> Option<String> {
        let samples = &self.file.samples;
        let wide = self.cases.iter().filter(|result| result.is_wide(samples)).count();
        (wide > 0).then(|| {
            format!(
                "In {wide} of {} the displaced volume is known to no better than ± {} % after {}: give more samples.",
                count(self.cases.len(), "case", "cases"),
                digits(100.0 * samples.interval),
                count(samples.most as usize, "impact", "impacts")
            )
        })
    }

    fn method(&self) -> Vec<String> {
        let mut lines = method::lines(&self.file);
        lines.push(format!("abrade {}.", env!("CARGO_PKG_VERSION")));
        for result in &self.cases {
            if let Some((missed, why)) = &result.missed {
                let impacts = count(*missed, "impact", "impacts");
                lines.push(format!(
                    "{} at {} deg and {} m/s: {impacts} without a result; the first: {why}.",
                    result.case.grain,
                    digits(result.case.angle.to_degrees()),
                    digits(result.case.speed)
                ));
            }
        }
        lines
    }
}

fn row(result: &CaseResult) -> Vec<String> {
    let value = |name: &str| result.quantity(name).value;
    let ratio = |ratio: Option<Estimate>| ratio.map_or("-".into(), |r| sign(&r));
    vec![
        format!("{}, {} deg", result.case.grain, digits(result.case.angle.to_degrees())),
        result.impacts.to_string(),
        sign(&result.quantity("wear_mm3_per_kg")),
        ratio(result.wear_ratio),
        sign(&result.quantity("removed_mm3_per_kg")),
        ratio(result.removed_ratio),
        fixed(value("wear_energy_share"), 3),
        fixed(1e6 * value("depth_m"), 2),
        fixed(value("restitution"), 3),
        fixed(value("restitution_normal"), 3),
        fixed(value("restitution_tangential"), 3),
        percent(value("forward_share"), 0),
        percent(value("backward_share"), 0),
        percent(value("chip_share"), 1),
    ]
}

/// An estimate with the sign that pages have.
fn sign(estimate: &Estimate) -> String {
    told(estimate).replace("+-", "±")
}
