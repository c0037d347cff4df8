//! `report.html`: the picture and the summary of a run on one page that needs no other file. No
//! scripts; every text is escaped.

use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

use crate::atomic;
use crate::error::ReportError;
use crate::pvd::escape;
use crate::summary::{BodySummary, EnergySummary, MotionSummary, Summary, SurfaceSummary};

/// The page as text; `picture` is a PNG file's bytes, if there is one.
pub fn to_html(summary: &Summary, picture: Option<&[u8]>) -> String {
    let title = escape(&summary.scene);
    let mut body = format!("<h1>{title}</h1>\n<p class=\"sub\">{}</p>\n", subtitle(summary));
    body.push_str(&warnings(summary));
    if let Some(png) = picture {
        let data = STANDARD.encode(png);
        let alt = "The worn surface, coloured by depth.";
        body.push_str(&format!("<img src=\"data:image/png;base64,{data}\" alt=\"{alt}\">\n"));
    }
    let blocks = [surfaces(summary), bodies(summary), energies(summary), run(summary)];
    body.push_str(&format!("<div class=\"grid\">\n{}</div>\n", blocks.concat()));
    document(&title, &body)
}

/// A page with this `title` and `body`, both markup.
pub(crate) fn document(title: &str, body: &str) -> String {
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<main>\n{body}</main>\n\
         </body>\n</html>\n"
    )
}

/// Writes the page to `path`.
///
/// # Errors
/// The file system refuses.
pub fn write(path: &Path, summary: &Summary, picture: Option<&[u8]>) -> Result<(), ReportError> {
    atomic::write(path, to_html(summary, picture).as_bytes())
}

fn subtitle(summary: &Summary) -> String {
    let end = match (&summary.stop, summary.complete) {
        (Some(stop), true) => escape(stop),
        (Some(stop), false) => format!("broken off: {}", escape(stop)),
        (None, true) => "complete".to_owned(),
        (None, false) => "broken off".to_owned(),
    };
    format!("{} simulated · {end}", quantity(summary.simulated, "s"))
}

fn warnings(summary: &Summary) -> String {
    if summary.warnings.is_empty() {
        return String::new();
    }
    let items = summary.warnings.iter().map(|text| format!("<li>{}</li>\n", escape(text)));
    format!(
        "<section class=\"warn\"><h2>Warnings</h2>\n<ul>\n{}</ul></section>\n",
        String::from_iter(items)
    )
}

fn surfaces(summary: &Summary) -> String {
    let table = |(name, s): (&String, &SurfaceSummary)| {
        let mut rows = vec![
            ("Displaced", quantity(s.wear_volume, "m³")),
            ("by normal flow", quantity(s.wear_volume_normal, "m³")),
            ("by lateral flow", quantity(s.wear_volume_lateral, "m³")),
            ("by slip under load", quantity(s.wear_volume_archard, "m³")),
            ("Debris", quantity(s.removed_volume, "m³")),
            ("Chips", quantity(s.chip_volume, "m³")),
            ("Largest depth", quantity(s.max_depth, "m")),
            ("Worn nodes", format!("{} of {}", s.worn_nodes, s.nodes)),
            ("Largest normal force", quantity(s.peak_normal_force, "N")),
            ("Indented area", quantity(s.indented_area, "m²")),
            ("Wear rate at the end", optional(s.wear_rate.map(|rate| 1e6 * rate), "mm³/mm")),
        ];
        if let Some(MotionSummary { position, rotation_xyzw, velocity, spin }) = s.motion {
            rows.extend(motion(&position, &rotation_xyzw, &velocity, &spin));
        }
        block(&format!("Surface {}", escape(name)), &rows)
    };
    summary.surfaces.iter().map(table).collect()
}

fn bodies(summary: &Summary) -> String {
    let table = |(name, b): (&String, &BodySummary)| {
        let mut rows = motion(&b.position, &b.rotation_xyzw, &b.velocity, &b.spin).to_vec();
        rows.extend([
            ("Speed after over before", optional(b.restitution, "")),
            ("Leaves from the surface at", optional(b.rebound_angle, "°")),
            ("Normal restitution", optional(b.restitution_normal, "")),
            ("Mean force", vector(&b.mean_force, "N")),
        ]);
        block(&format!("Body {}", escape(name)), &rows)
    };
    summary.bodies.iter().map(table).collect()
}

fn motion(
    position: &[f64; 3],
    rotation_xyzw: &[f64; 4],
    velocity: &[f64; 3],
    spin: &[f64; 3],
) -> [(&'static str, String); 4] {
    [
        ("Position", vector(position, "m")),
        ("Rotation (x, y, z, w)", vector(rotation_xyzw, "")),
        ("Velocity", vector(velocity, "m/s")),
        ("Spin", vector(spin, "rad/s")),
    ]
}

fn energies(summary: &Summary) -> String {
    let Some(EnergySummary {
        initial,
        kinetic,
        elastic,
        friction,
        wear,
        damping,
        external_work,
        history,
        adhesion,
        numerical,
    }) = summary.energy
    else {
        return String::new();
    };
    let rows = [
        ("At the start", initial),
        ("External work", external_work),
        ("Kinetic now", kinetic),
        ("Stored in springs", elastic),
        ("Friction", friction),
        ("Wear", wear),
        ("Damping", damping),
        ("Tangential history", history),
        ("Adhesion", adhesion),
        ("Numerical", numerical),
    ];
    block("Energy", &rows.map(|(name, value)| (name, quantity(value, "J"))))
}

fn run(summary: &Summary) -> String {
    let estimate = &summary.error_estimate;
    let counts = summary.resolver;
    let rows = [
        ("Steps", summary.steps.to_string()),
        ("Node evaluations", summary.node_evaluations.to_string()),
        ("Wall time", quantity(summary.wall, "s")),
        ("Precision of the engine", escape(&summary.precision)),
        ("Body steps in contact, by the core", counts.micro.to_string()),
        ("Body steps under a load", counts.quasi_static.to_string()),
        ("Body steps in lockstep", counts.lockstep.to_string()),
        ("Blows as collisions of two", counts.collision.to_string()),
        ("Error by time steps", optional(estimate.time, "")),
        ("Error by node distance", optional(estimate.pitch, "")),
        ("Basis of the estimate", estimate.basis.as_deref().map_or(ABSENT.into(), escape)),
        ("abrade", escape(&summary.abrade)),
    ];
    block("Run", &rows)
}

/// A heading and a table of names and ready markup.
fn block(heading: &str, rows: &[(&str, String)]) -> String {
    let row =
        |(name, value): &(&str, String)| format!("<tr><th>{name}</th><td>{value}</td></tr>\n");
    let rows: String = rows.iter().map(row).collect();
    format!("<section>\n<h2>{heading}</h2>\n<table>\n{rows}</table>\n</section>\n")
}

const ABSENT: &str = "–";

fn optional(value: Option<f64>, unit: &str) -> String {
    value.map_or(ABSENT.into(), |value| quantity(value, unit))
}

fn vector(values: &[f64], unit: &str) -> String {
    let numbers: Vec<_> = values.iter().map(|value| number(*value)).collect();
    spaced(&format!("({})", numbers.join(", ")), unit)
}

fn quantity(value: f64, unit: &str) -> String {
    spaced(&number(value), unit)
}

fn spaced(number: &str, unit: &str) -> String {
    match unit {
        "" | "°" => format!("{number}{unit}"),
        unit => format!("{number}&nbsp;{unit}"),
    }
}

/// Five significant digits, as a power of ten where the plain number would be long.
fn number(value: f64) -> String {
    let plain = value == 0.0 || !value.is_finite() || (1e-3..1e5).contains(&value.abs());
    let text = match plain {
        true => {
            let whole = value.abs().max(1e-3).log10().floor() as i32;
            let text = format!("{value:.*}", (4 - whole).clamp(0, 7) as usize);
            let text = if text.contains('.') { text.trim_end_matches('0') } else { &text };
            text.trim_end_matches('.').to_owned()
        }
        false => {
            let text = format!("{value:.4e}");
            let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
            let digits = digits.trim_end_matches('0').trim_end_matches('.');
            format!("{digits}&nbsp;×&nbsp;10<sup>{power}</sup>")
        }
    };
    text.replace('-', "−")
}

const STYLE: &str = include_str!("page/style.css");

#[cfg(test)]
mod tests;
