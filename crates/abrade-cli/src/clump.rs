//! `abrade clump`: mass properties and overlaps of a clump file, and conversion.

use abrade_report::quantity_text::{count, digits};
use abrade_scene::clump::{self, ClumpFile, Format, Report};
use anyhow::{Context, anyhow};

use crate::arguments::{ClumpArguments, ConvertFormat};
use crate::failure::Failure;
use crate::say::say;

/// Prints what there is to say about the file, and converts it if asked to.
pub(crate) fn clump(arguments: &ClumpArguments) -> Result<(), Failure> {
    for (name, value) in [("--density", arguments.density), ("--scale", arguments.scale)] {
        if !(value.is_finite() && value > 0.0) {
            return Err(Failure::Input(anyhow!(
                "{name} is {value}, it must be finite and above zero"
            )));
        }
    }
    let file = clump::read(&arguments.file).map_err(|error| Failure::Input(error.into()))?;
    let file = file.scaled(arguments.scale);
    let report = file.report().map_err(|error| Failure::Input(error.into()))?;
    say(&text(&file, &report, arguments.density))?;
    if let (Some(format), Some(out)) = (arguments.convert, &arguments.out) {
        let format = match format {
            ConvertFormat::Xyzr => Format::Xyzr,
            ConvertFormat::Csv => Format::Csv,
            ConvertFormat::Kratos => Format::Kratos,
            ConvertFormat::Lammps => Format::Lammps,
        };
        let text = clump::write(&file, format, arguments.density, &report.union);
        std::fs::write(out, text)
            .with_context(|| format!("`{}` cannot be written", out.display()))
            .map_err(Failure::Input)?;
        say(&format!("written   {} ({})\n", out.display(), format.name()))?;
    }
    Ok(())
}

fn text(file: &ClumpFile, report: &Report, density: f64) -> String {
    let union = &report.union;
    let tensor = union.tensor * density;
    // What the integration cannot tell from zero is shown as zero.
    let noise = union.error.max(1e-9);
    let clean =
        |value: f64, size: f64| digits(if value.abs() < noise * size { 0.0 } else { value });
    let centre = union.centre.coords.map(|x| clean(x, report.bounding_radius));
    let inertia =
        [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|at| clean(tensor[at], tensor.norm()));
    let mut rows = vec![
        ("file", format!("{} ({})", file.path.display(), file.format.name())),
        ("spheres", report.spheres.to_string()),
        ("overlaps", overlaps(report)),
        ("volume", format!("{} m3, the union's", digits(union.volume))),
        ("mass", format!("{} kg at {} kg/m3", digits(union.volume * density), digits(density))),
        ("centre", format!("({}) m", centre.as_slice().join(", "))),
        ("inertia", format!("xx yy zz xy xz yz: {} kg m2, about the centre", inertia.join(" "))),
        ("reach", format!("{} m from the centre", digits(report.bounding_radius))),
        ("error", format!("{:.0e} of volume and inertia, at most", union.error)),
    ];
    if let Some(difference) = report.difference() {
        rows.push(("note", difference));
    }
    rows.iter().map(|(name, text)| format!("{name:<9} {text}\n")).collect()
}

fn overlaps(report: &Report) -> String {
    let share = digits(100.0 * report.overlap_share().max(0.0));
    match report.overlapping_pairs {
        0 => "none".into(),
        pairs => format!("{}, {share} % of the spheres' volume", count(pairs, "pair", "pairs")),
    }
}
