//! The map of ends: how cases end over E/H and speed, and over size and angle. Every cell is a
//! stack of the shares.

use std::fmt::Write;

use crate::case::Case;
use crate::finding::Finding;
use crate::run::End;

/// Groups of ends, from the bottom of a stack, with their colours.
pub const GROUPS: [(&str, &str); 7] = [
    ("a result", "#cfe3c8"),
    ("never touched", "#eeeeee"),
    ("too many steps", "#5b8bd0"),
    ("Engulfed", "#a06a3a"),
    ("Unbalanced", "#d0463b"),
    ("refused", "#8b5bb0"),
    ("another error", "#222222"),
];

/// A cell of a map, in pixels.
const CELL: f64 = 34.0;
const LEFT: f64 = 64.0;
const TOP: f64 = 46.0;

/// An axis: its name, the number that a case has on it, and where its parts begin and end.
pub struct Axis {
    pub name: &'static str,
    pub of: fn(&Case) -> f64,
    pub edges: Vec<f64>,
}

/// Powers of ten from one exponent to another.
fn decades(low: i32, high: i32) -> Vec<f64> {
    (low..=high).map(|exponent| 10f64.powi(exponent)).collect()
}

/// The maps: name, x and y.
pub fn maps() -> [(&'static str, Axis, Axis); 2] {
    let speeds = [decades(-4, 3), vec![5e3]].concat();
    let angles = vec![0.1, 1.0, 3.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 90.0];
    [
        (
            "E/H and speed",
            Axis { name: "E/H [-]", of: |case| case.young / case.hardness, edges: decades(-5, 10) },
            Axis { name: "V [m/s]", of: |case| case.speed, edges: speeds },
        ),
        (
            "size and angle",
            Axis { name: "size [m]", of: |case| case.size, edges: decades(-6, 1) },
            Axis { name: "angle [deg]", of: |case| case.angle, edges: angles },
        ),
    ]
}

/// The group of an end, by its place in [`GROUPS`].
pub fn group(end: &End) -> usize {
    match end {
        End::Rebounded | End::Stays => 0,
        End::Apart => 1,
        End::Long | End::HandedOn(_) => 2,
        End::Refused(_) | End::Unbuilt(_) => 5,
        End::Failed(_) => match end.name() {
            "TooManySteps" | "LoadNotReached" => 2,
            "Engulfed" => 3,
            "Unbalanced" => 4,
            _ => 6,
        },
    }
}

impl Axis {
    fn part(&self, case: &Case) -> Option<usize> {
        let x = (self.of)(case);
        self.edges.windows(2).position(|edge| x >= edge[0] && x < edge[1])
    }
}

/// Counts by row, column and group.
pub fn counts(findings: &[Finding], x: &Axis, y: &Axis) -> Vec<Vec<[usize; GROUPS.len()]>> {
    let row = vec![[0; GROUPS.len()]; x.edges.len() - 1];
    let mut counts = vec![row; y.edges.len() - 1];
    for finding in findings {
        if let (Some(column), Some(row)) = (x.part(&finding.case), y.part(&finding.case)) {
            counts[row][column][group(&finding.end)] += 1;
        }
    }
    counts
}

fn label(value: f64) -> String {
    match value {
        v if (0.1..1e3).contains(&v) => format!("{v}"),
        v => format!("{v:.0e}"),
    }
}

fn text(svg: &mut String, [x, y]: [f64; 2], anchor: &str, text: &str) {
    let _ = writeln!(svg, r#"<text x="{x:.1}" y="{y:.1}" text-anchor="{anchor}">{text}</text>"#);
}

fn map(svg: &mut String, top: f64, findings: &[Finding], x: &Axis, y: &Axis) -> f64 {
    let counts = counts(findings, x, y);
    let rows = counts.len();
    for (row, line) in counts.iter().enumerate() {
        let below = top + (rows - row) as f64 * CELL;
        for (column, cell) in line.iter().enumerate() {
            let total: usize = cell.iter().sum();
            let mut foot = below;
            for (count, (_, colour)) in cell.iter().zip(GROUPS) {
                let height = CELL * *count as f64 / total.max(1) as f64;
                foot -= height;
                let left = LEFT + column as f64 * CELL;
                let _ = writeln!(
                    svg,
                    r#"<rect x="{left:.1}" y="{foot:.2}" width="{CELL}" height="{height:.2}" fill="{colour}"/>"#
                );
            }
        }
        text(svg, [LEFT - 4.0, below + 4.0], "end", &label(y.edges[row]));
    }
    let bottom = top + rows as f64 * CELL;
    for (column, edge) in x.edges.iter().enumerate() {
        text(svg, [LEFT + column as f64 * CELL, bottom + 14.0], "middle", &label(*edge));
    }
    text(svg, [LEFT, top - 8.0], "end", y.name);
    text(svg, [LEFT + x.edges.len() as f64 * CELL, bottom + 14.0], "start", x.name);
    bottom + 70.0
}

/// The maps as one picture.
pub fn of(findings: &[Finding]) -> String {
    let mut body = String::new();
    let mut top = TOP + 24.0;
    for (_, x, y) in maps() {
        top = map(&mut body, top, findings, &x, &y);
    }
    let mut legend = String::new();
    for (number, (name, colour)) in GROUPS.iter().enumerate() {
        let x = LEFT + 96.0 * number as f64;
        let _ = writeln!(
            legend,
            r#"<rect x="{x}" y="12" width="12" height="12" fill="{colour}" stroke="gray"/>"#
        );
        text(&mut legend, [x + 16.0, 22.0], "start", name);
    }
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"760\" height=\"{top:.0}\" \
         font-family=\"sans-serif\" font-size=\"11\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n{legend}{body}</svg>\n"
    )
}
