//! The table of ends.

use std::collections::BTreeMap;
use std::fmt::Write;

use crate::chart;
use crate::finding::Finding;

/// Gain of energy that is worth a line.
const GAIN: f64 = 0.05;

/// How many cases ended how, and what time integration did to those that ended with a result.
pub fn of(findings: &[Finding]) -> String {
    let mut ends: BTreeMap<&str, Vec<u64>> = BTreeMap::new();
    for finding in findings {
        ends.entry(finding.end.name()).or_default().push(finding.case.number);
    }
    let mut text = format!("{} cases\n", findings.len());
    for (name, numbers) in &ends {
        let share = 100.0 * numbers.len() as f64 / findings.len() as f64;
        let few = &numbers[..numbers.len().min(8)];
        let _ = writeln!(text, "{name:>16} {:>7} {share:>7.2} % {few:?}", numbers.len());
    }
    let gained = findings.iter().filter(|f| !f.end.is_normal() && f.left > 1.0 + GAIN);
    let gained: Vec<u64> = gained.map(|finding| finding.case.number).collect();
    let _ = writeln!(text, "with more energy than at the start, in Rapier's hands: {gained:?}");
    let normal = findings.iter().filter(|finding| finding.end.is_normal());
    let mut numerical: Vec<f64> = normal.map(|finding| finding.numerical).collect();
    numerical.sort_by(f64::total_cmp);
    for share in [0.5, 0.9, 0.99, 0.999, 1.0] {
        let at = ((numerical.len() as f64 * share) as usize).min(numerical.len().saturating_sub(1));
        if let Some(value) = numerical.get(at) {
            let _ = writeln!(text, "numerical / start, {share:>5}: {value:.2e}");
        }
    }
    text
}

/// One row per case: what it is, how it ended, and its energies over that at the start.
pub fn rows(findings: &[Finding]) -> String {
    let mut text = String::from(
        "case,form,target,elastic,flow,precision,end,steps,touches,left,numerical,wear,friction,\
         stored,history,price,broken\n",
    );
    for Finding { case, end, steps, touches, left, shares, broken, .. } in findings {
        let kind = format!("{:?},{:?},{:?},{:?}", case.form, case.target, case.elastic, case.flow);
        let shares = shares.map(|share| format!("{share:e}")).join(",");
        let (number, precision, end, broken) =
            (case.number, case.precision, end.name(), broken.join("; "));
        let _ = writeln!(
            text,
            "{number},{kind},{precision:?},{end},{steps},{touches},{left:e},{shares},\"{broken}\""
        );
    }
    text
}

/// The counts of the map: one row per cell and group of ends.
pub fn csv(findings: &[Finding]) -> String {
    let mut text = String::from("map,x_low,x_high,y_low,y_high,end,cases\n");
    for (name, x, y) in chart::maps() {
        for (row, line) in chart::counts(findings, &x, &y).iter().enumerate() {
            for (column, cell) in line.iter().enumerate() {
                let [xs, ys] = [&x.edges[column..], &y.edges[row..]];
                for (count, (end, _)) in cell.iter().zip(chart::GROUPS) {
                    let cell = [xs[0], xs[1], ys[0], ys[1]].map(|edge| format!("{edge:e}"));
                    let _ = writeln!(text, "{name},{},{end},{count}", cell.join(","));
                }
            }
        }
    }
    text
}
