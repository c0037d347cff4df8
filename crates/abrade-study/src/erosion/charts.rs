//! The charts of a study: wear and ratio against angle, debris beside laws, wear against speed.

use abrade_report::ReportError;
use abrade_report::chart::{Axis, Chart, Scale, Series, Stroke};

use super::laws;
use super::statistics::Estimate;
use super::summary::{CaseResult, Erosion};

/// A chart as a file.
pub(crate) struct Drawn {
    /// Name of the file.
    pub(crate) name: &'static str,
    /// What it shows.
    pub(crate) alt: String,
    /// Bytes of a PNG file.
    pub(crate) png: Vec<u8>,
}

/// Debris over the largest below which it is not drawn.
const LEAST: f64 = 1e-4;
/// Steps of a law's curve from 1 to 90 degrees.
const STEPS: u32 = 89;

impl Erosion {
    /// All charts.
    pub(crate) fn charts(&self) -> Result<Vec<Drawn>, ReportError> {
        let mut charts = vec![self.wear()?, self.ratio()?, self.debris()?];
        if self.file.speeds.len() > 1 {
            charts.push(self.speed()?);
        }
        Ok(charts)
    }

    fn wear(&self) -> Result<Drawn, ReportError> {
        let series = self.by_angle(|result| Some(result.quantity("wear_mm3_per_kg")));
        let alt = "Displaced volume per mass of grains against the angle of impact";
        self.chart("wear.png", alt, "displaced volume (mm³/kg)", &series)
    }

    fn ratio(&self) -> Result<Drawn, ReportError> {
        let mut series = self.by_angle(|result| result.wear_ratio);
        series.retain(|series| !series.points.is_empty());
        let reference = self.file.reference.as_deref().unwrap_or("nothing");
        let word = self.file.size.word();
        let alt = format!("Displaced volume per mass over that of {reference}, at equal {word}");
        self.chart("ratio.png", &alt, "ratio (-)", &series)
    }

    fn debris(&self) -> Result<Drawn, ReportError> {
        let mut series = self.by_angle(|result| Some(result.quantity("removed_mm3_per_kg")));
        let speed = self.file.speeds[0];
        let angles: Vec<f64> =
            (1..=STEPS + 1).map(|degree| f64::from(degree).to_radians()).collect();
        for law in laws::predictions_at(&self.file, speed, &angles) {
            let points = angles.iter().zip(&law.volumes);
            series.push(Series {
                name: law.name.to_owned(),
                points: points.map(|(angle, volume)| [angle.to_degrees(), *volume]).collect(),
                stroke: Stroke::Dashes,
                ..Series::default()
            });
        }
        let values = || series.iter().flat_map(|one| one.points.iter().map(|point| point[1]));
        let least = LEAST * values().fold(0.0, f64::max);
        series.iter_mut().for_each(|one| one.leave_out_below(least));
        let alt = "Debris per mass of grains, by the removal rule, beside closed-form laws";
        let axes = [
            Axis { name: ANGLE, scale: Scale::Linear },
            Axis { name: "debris (mm³/kg)", scale: Scale::Log },
        ];
        drawn("debris.png", alt, &self.caption(), axes, &series)
    }

    fn speed(&self) -> Result<Drawn, ReportError> {
        let mut series = Vec::new();
        for name in self.file.grains.keys() {
            for &angle in &self.file.angles {
                let is =
                    |result: &&CaseResult| result.case.grain == *name && result.case.angle == angle;
                let exponent = self.exponents.iter().find(|e| e.grain == *name && e.angle == angle);
                let exponent =
                    exponent.map_or_else(String::new, |e| format!(": V^{:.2}", e.wear.value));
                let of = |result: &CaseResult| result.quantity("wear_mm3_per_kg");
                let mut one = curve(
                    self.cases.iter().filter(is),
                    |result| result.case.speed,
                    |r| Some(of(r)),
                );
                one.name = format!("{name}, {:.0} deg{exponent}", angle.to_degrees());
                series.push(one);
            }
        }
        let axes = [
            Axis { name: "speed (m/s)", scale: Scale::Log },
            Axis { name: "displaced volume (mm³/kg)", scale: Scale::Log },
        ];
        drawn("speed.png", "Displaced volume per mass against speed", "", axes, &series)
    }

    fn chart(
        &self,
        name: &'static str,
        alt: &str,
        y: &str,
        series: &[Series],
    ) -> Result<Drawn, ReportError> {
        let axes =
            [Axis { name: ANGLE, scale: Scale::Linear }, Axis { name: y, scale: Scale::Linear }];
        drawn(name, alt, &self.caption(), axes, series)
    }

    fn caption(&self) -> String {
        format!("at {} m/s; bars are 95 % intervals", self.file.speeds[0])
    }

    /// A curve over the angle per grain, at the first speed.
    fn by_angle(&self, value: impl Fn(&CaseResult) -> Option<Estimate>) -> Vec<Series> {
        let of = |name: &String| {
            let is = |result: &&CaseResult| {
                result.case.grain == *name && result.case.speed == self.file.speeds[0]
            };
            let cases = self.cases.iter().filter(is);
            Series {
                name: name.clone(),
                ..curve(cases, |result| result.case.angle.to_degrees(), &value)
            }
        };
        self.file.grains.keys().map(of).collect()
    }
}

const ANGLE: &str = "angle of impact, from the surface (deg)";

/// The curve of a value of `cases`, in the order of what it is drawn over.
fn curve<'a>(
    cases: impl Iterator<Item = &'a CaseResult>,
    over: impl Fn(&CaseResult) -> f64,
    value: impl Fn(&CaseResult) -> Option<Estimate>,
) -> Series {
    let points = cases.filter_map(|result| Some((over(result), value(result)?)));
    let mut points: Vec<(f64, Estimate)> = points.collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    Series {
        points: points.iter().map(|(x, estimate)| [*x, estimate.value]).collect(),
        bars: points.iter().map(|(_, estimate)| estimate.half_width).collect(),
        ..Series::default()
    }
}

fn drawn(
    name: &'static str,
    alt: &str,
    caption: &str,
    [x, y]: [Axis<'_>; 2],
    series: &[Series],
) -> Result<Drawn, ReportError> {
    let chart = Chart { title: alt, caption, x, y, series };
    Ok(Drawn { name, alt: alt.to_owned(), png: chart.to_png()? })
}
