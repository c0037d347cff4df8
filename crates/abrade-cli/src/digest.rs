//! The short summary that `abrade run` prints.

use std::fmt::Write;
use std::path::Path;

use abrade_report::Summary;
use abrade_report::quantity_text::{count, digits, length, volume};
use abrade_report::summary::ErosionSummary;
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
        let removed = volume(surface.removed_volume);
        if removed != volume(surface.wear_volume) {
            write!(parts, ", removed {removed}")?;
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
            (Some(restitution), Some(angle)) => {
                format!("restitution {restitution:.4}, leaves at {angle:.1} deg")
            }
            (Some(restitution), None) => format!("restitution {restitution:.4}"),
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
            1 => format!("{all}, 1 has struck and left, restitution {mean:.4}"),
            _ => format!("{all}, {left} have struck and left, mean restitution {mean:.4}"),
        };
        writeln!(out, "  stream  {name:12} {line}")?;
    }
    if let Some(erosion) = &summary.erosion {
        writeln!(out, "  erosion {}", erosion_text(erosion))?;
    }
    if let Some(energy) = &summary.energy {
        let work = match energy.external_work {
            work if work.abs() <= NOTHING * (energy.initial + energy.wear) => String::new(),
            work => format!(" and {work:.4e} J of work on it"),
        };
        let others = [
            ("springs", energy.elastic),
            ("damping", energy.damping),
            ("history", energy.history),
            ("adhesion", energy.adhesion),
        ];
        let scale = energy.initial + energy.external_work.abs();
        let others: String = others
            .into_iter()
            .filter(|(_, part)| part.abs() > NOTHING * scale)
            .map(|(name, part)| format!("{name} {part:.4e}, "))
            .collect();
        writeln!(
            out,
            "  energy  {:.4e} J at the start{work}: kinetic {:.4e}, wear {:.4e}, friction {:.4e}, \
             {others}numerical {:.1e}",
            energy.initial, energy.kinetic, energy.wear, energy.friction, energy.numerical
        )?;
    }
    if let Some(laws) = &summary.laws {
        let own = volume(laws.wear_volume);
        let said: Vec<_> =
            laws.predicted.iter().map(|(name, sum)| format!("{name} {}", volume(*sum))).collect();
        let impacts = count(laws.impacts, "impact", "impacts");
        let said = said.join(", ");
        writeln!(out, "  laws    {impacts} over, displaced {own}; by the laws {said}")?;
    }
    for warning in &summary.warnings {
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
    let [x, y, z] = force.map(|part| if part.abs() > NOTHING * largest { part } else { 0.0 });
    format!("mean force ({x:.4e}, {y:.4e}, {z:.4e}) N")
}

/// Debris per mass of what has struck.
fn erosion_text(erosion: &ErosionSummary) -> String {
    let per_mass = |rate: Option<f64>| rate.map_or(String::new(), |r| format!(" ({r:.3e} kg/kg)"));
    let ErosionSummary { struck, mass, rate, .. } = *erosion;
    let mut text = format!(
        "{rate:.4} mm3/kg{} by {} of {:.4e} kg",
        per_mass(erosion.rate_by_mass),
        count(struck, "body", "bodies"),
        mass
    );
    if let Some((steady, deviation)) = erosion.steady.zip(erosion.steady_deviation) {
        text += &format!(
            "; steady {steady:.4} +- {deviation:.4} mm3/kg{}",
            per_mass(erosion.steady_by_mass)
        );
    }
    text
}
