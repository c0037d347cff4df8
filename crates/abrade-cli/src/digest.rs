//! The short summary that `abrade run` prints.

use std::fmt::Write;
use std::path::Path;

use abrade::Removal;
use abrade_report::Summary;
use abrade_report::quantity_text::{count, digits, energy, force_unit, length, volume};
use abrade_report::summary::{EnergySummary, ErosionSummary};
use abrade_scene::Checked;
use abrade_scene::scene::Output;

use crate::say;

/// Share of the energy below which work is rounding.
const NOTHING: f64 = 1e-9;

/// What a run did, in a few lines.
pub(crate) fn digest(checked: &Checked, summary: &Summary, folder: &Path) -> String {
    let mut text = String::new();
    let _ = write_digest(&mut text, checked, summary, folder);
    text
}

/// What is left of a run that failed: its figures end in the middle of a contact, and tell nothing.
pub(crate) fn of_failed(summary: &Summary, folder: &Path) -> String {
    let Summary { scene, simulated, .. } = summary;
    let place = say::place(folder);
    format!(
        "{scene}\n  failed after {simulated:.3e} s simulated; what was done until then is in {place}\n"
    )
}

fn write_digest(
    out: &mut String,
    checked: &Checked,
    summary: &Summary,
    folder: &Path,
) -> std::fmt::Result {
    match summary.complete {
        true => writeln!(out, "{}", summary.scene)?,
        false => writeln!(out, "{} (broken off)", summary.scene)?,
    }
    let is_copy = |name: &String| checked.copied.values().any(|names| names.contains(name));
    for (name, surface) in summary.surfaces.iter().filter(|(name, _)| !is_copy(name)) {
        let mut parts = format!(
            "displaced {}, deepest {}, {} of {}",
            volume(surface.wear_volume),
            length(surface.max_depth),
            surface.worn_nodes,
            count(surface.nodes, "node", "nodes")
        );
        let debris = volume(surface.removed_volume);
        if debris != volume(surface.wear_volume) {
            write!(parts, ", debris {debris}")?;
        }
        if surface.chip_volume > 0.0 {
            write!(parts, ", chips {}", volume(surface.chip_volume))?;
        }
        if let Some(rate) = surface.wear_rate {
            write!(parts, ", wear rate at the end {} mm3/mm", digits(rate * 1e6))?;
        }
        writeln!(out, "  surface {name:12} {parts}")?;
    }
    for (name, names) in &checked.copied {
        let copies: Vec<_> = names.iter().filter_map(|name| summary.surfaces.get(name)).collect();
        let displaced: f64 = copies.iter().map(|copy| copy.wear_volume).sum();
        let (all, displaced) = (count(copies.len(), "copy", "copies"), volume(displaced));
        let deepest = length(copies.iter().map(|copy| copy.max_depth).fold(0.0, f64::max));
        let worn = copies.iter().filter(|copy| copy.wear_volume > 0.0).count();
        let line = format!("{all}, {worn} worn, displaced {displaced}, deepest {deepest}");
        writeln!(out, "  surface {name:12} {line}")?;
    }
    let of_stream = |name: &String| checked.is_streamed(name);
    for (name, body) in summary.bodies.iter().filter(|(name, _)| !of_stream(name)) {
        let line = match (body.restitution, body.rebound_angle) {
            (Some(restitution), Some(angle)) if angle < 0.0 => {
                format!("sinks on with {restitution:.3} of its speed, at {:.1} deg", -angle)
            }
            (Some(restitution), Some(angle)) => {
                format!(
                    "leaves with {restitution:.3} of its speed, at {angle:.1} deg from the surface"
                )
            }
            (Some(restitution), None) => format!("leaves with {restitution:.3} of its speed"),
            _ => force_text(body.mean_force),
        };
        writeln!(out, "  body    {name:12} {line}")?;
    }
    for (name, names) in &checked.streamed {
        let struck = names.iter().filter_map(|name| summary.bodies.get(name)?.restitution);
        let struck: Vec<f64> = struck.collect();
        let (all, left) = (count(names.len(), "body", "bodies"), struck.len());
        let mean = struck.iter().sum::<f64>() / left as f64;
        let line = match left {
            0 => format!("{all}, none of which has struck and left"),
            1 => format!("{all}, 1 has struck and left, with {mean:.3} of its speed"),
            _ => format!(
                "{all}, {left} have struck and left, with {mean:.3} of their speed in the mean"
            ),
        };
        writeln!(out, "  stream  {name:12} {line}")?;
    }
    if let Some(erosion) = &summary.erosion {
        let all = checked.scene.surfaces.values().all(|surface| surface.removal == Removal::All);
        writeln!(out, "  erosion {}", erosion_text(erosion, all))?;
    }
    if let Some(energy) = &summary.energy {
        writeln!(out, "  energy  {}", energy_text(energy))?;
    }
    if let Some(laws) = &summary.laws {
        let own = volume(laws.wear_volume);
        let said: Vec<_> =
            laws.predicted.iter().map(|(name, sum)| format!("{name} {}", volume(*sum))).collect();
        let impacts = count(laws.impacts, "impact", "impacts");
        let said = said.join(", ");
        writeln!(out, "  laws    {impacts} over, displaced {own}; by the laws {said}")?;
    }
    // The notes of the scene were told before it ran.
    for warning in summary.warnings.iter().filter(|warning| !checked.notes.contains(warning)) {
        writeln!(out, "  note: {warning}")?;
    }
    writeln!(
        out,
        "  {:.3e} s simulated, {}, {}, {:.3} s ({})",
        summary.simulated,
        count(summary.steps, "contact step", "contact steps"),
        count(summary.node_evaluations, "node evaluation", "node evaluations"),
        summary.wall,
        summary.precision
    )?;
    let picture = checked.scene.outputs.contains(&Output::Picture);
    let single = summary.surfaces.keys().filter(|name| !is_copy(name));
    let mut surfaces = single.chain(checked.copied.keys());
    let file = match (picture, surfaces.next(), surfaces.next()) {
        (true, Some(first), Some(_)) => format!("surface_{first}.png and more"),
        (true, ..) => "surface.png and more".to_owned(),
        (false, ..) => "summary.json".to_owned(),
    };
    writeln!(out, "  {file} in {}", say::place(folder))
}

/// The mean force on a body [N], without what is rounding beside the rest.
fn force_text(force: [f64; 3]) -> String {
    let largest = force.iter().fold(0.0f64, |largest, part| largest.max(part.abs()));
    if largest == 0.0 {
        return "no force measured".into();
    }
    let (size, unit) = force_unit(largest);
    let [x, y, z] = force.map(|part| match part.abs() > NOTHING * largest {
        true => digits(part / size),
        false => "0".to_owned(),
    });
    format!("mean force ({x}, {y}, {z}) {unit}")
}

/// Where the energy is that was there, and that came.
fn energy_text(ledger: &EnergySummary) -> String {
    let work = match ledger.external_work {
        work if work.abs() <= NOTHING * (ledger.initial + ledger.wear) => String::new(),
        work => format!(" and {} of work on it", joules(work)),
    };
    let scale = ledger.initial + ledger.external_work.abs();
    let others = [
        ("elastic", ledger.elastic),
        ("damping", ledger.damping),
        ("history", ledger.history),
        ("adhesion", ledger.adhesion),
    ];
    let others = others.into_iter().filter(|(_, part)| part.abs() > NOTHING * scale);
    let always =
        [("kinetic", ledger.kinetic), ("wear", ledger.wear), ("friction", ledger.friction)];
    let parts = always.into_iter().chain(others).chain([("numerical", ledger.numerical)]);
    // What is rounding beside the rest is nothing.
    let told =
        |part: f64| if part.abs() > NOTHING * scale { joules(part) } else { "0 J".to_owned() };
    let parts: Vec<_> = parts.map(|(name, part)| format!("{name} {}", told(part))).collect();
    format!("{} at the start{work}: {}", joules(ledger.initial), parts.join(", "))
}

/// `value` [J]; nothing is 0 J.
fn joules(value: f64) -> String {
    if value == 0.0 { "0 J".to_owned() } else { energy(value) }
}

/// What has gone per mass of what has struck; no more than displaced where `all` of that counts as
/// debris.
fn erosion_text(erosion: &ErosionSummary, all: bool) -> String {
    let per_mass =
        |rate: Option<f64>| rate.map_or(String::new(), |r| format!(" ({} kg/kg)", digits(r)));
    let ErosionSummary { struck, mass, rate, .. } = *erosion;
    let (what, bound) = match all {
        true => ("displaced", " (`removal` is `All`: an upper bound of the debris)"),
        false => ("debris", ""),
    };
    let mut text = format!(
        "{what} {} mm3/kg{} by {} of {} kg",
        digits(rate),
        per_mass(erosion.rate_by_mass),
        count(struck, "body", "bodies"),
        digits(mass)
    );
    if let Some((steady, deviation)) = erosion.steady.zip(erosion.steady_deviation) {
        text += &format!(
            "; steady {} mm3/kg{}",
            with_deviation(steady, deviation),
            per_mass(erosion.steady_by_mass)
        );
    }
    text + bound
}

/// `value` with the digits that its standard error leaves it, of which two are shown.
fn with_deviation(value: f64, deviation: f64) -> String {
    if !(deviation.is_finite() && deviation > 0.0) {
        return format!("{} +- {}", digits(value), digits(deviation));
    }
    let places = 1 - deviation.log10().floor() as i32;
    let step = 10f64.powi(-places);
    let [value, deviation] = [value, deviation].map(|x| (x / step).round() * step);
    let places = places.max(0) as usize;
    format!("{value:.places$} +- {deviation:.places$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for digits that the error does not leave, and for a volume without a removal rule
    /// that is told as debris.
    #[test]
    fn a_rate_has_the_digits_that_are_known() {
        assert_eq!(with_deviation(345.217, 25.31), "345 +- 25");
        assert_eq!(with_deviation(345.217, 253.1), "350 +- 250");
        assert_eq!(with_deviation(0.5432, 0.00123), "0.5432 +- 0.0012");
        let mut erosion = ErosionSummary {
            struck: 2,
            mass: 2.5e-6,
            rate: 392.7263,
            steady: None,
            steady_deviation: None,
            rate_by_mass: None,
            steady_by_mass: None,
        };
        assert_eq!(
            erosion_text(&erosion, true),
            "displaced 393 mm3/kg by 2 bodies of 2.5e-6 kg (`removal` is `All`: an upper bound of the debris)"
        );
        erosion.steady = Some(345.217);
        erosion.steady_deviation = Some(25.31);
        assert_eq!(
            erosion_text(&erosion, false),
            "debris 393 mm3/kg by 2 bodies of 2.5e-6 kg; steady 345 +- 25 mm3/kg"
        );
    }

    /// Fails for powers of ten, and for a part that is not told.
    #[test]
    fn forces_and_energies_have_units() {
        assert_eq!(force_text([-1312.5, 0.0, 20.0]), "mean force (-1.31, 0, 0.02) kN");
        let energy = EnergySummary {
            initial: 2.9122,
            kinetic: 1.5,
            wear: 1.2,
            elastic: 0.2,
            friction: 0.0,
            numerical: 1.22e-5,
            ..EnergySummary::default()
        };
        assert_eq!(
            energy_text(&energy),
            "2.91 J at the start: kinetic 1.5 J, wear 1.2 J, friction 0 J, elastic 200 mJ, numerical 12.2 uJ"
        );
    }
}
