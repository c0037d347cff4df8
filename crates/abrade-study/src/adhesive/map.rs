//! What the cases of a map come to: shares of the modes at its points, and where grinding begins.

use std::collections::BTreeMap;
use std::path::Path;

use abrade_adhesive::{Figures, Mode};
use abrade_report::quantity_text::count;

use super::case::{self, Case, Made};
use super::file::MapFile;
use super::fit::{self, Boundary, Share};

/// Number of modes.
const KINDS: usize = 7;
/// The modes in the order of the map's colours.
pub(crate) const MODES: [Mode; KINDS] = [
    Mode::Slipping,
    Mode::Cleavage,
    Mode::Grinding,
    Mode::Breakaway,
    Mode::GrindingAndCleavage,
    Mode::GrindingAndBreakaway,
    Mode::NoContact,
];

/// The cases that are there.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// The map's file.
    pub file: MapFile,
    /// The cases and what became of each.
    pub cases: Vec<(Case, Made)>,
    /// Its points, with one case or more each.
    pub points: Vec<Point>,
}

/// One point of a map, over all gaps.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point {
    /// a [-].
    pub strength_ratio: f64,
    /// sigma_j [Pa].
    pub shear_strength: f64,
    /// sigma_0 / sigma_j [-].
    pub adhesion_ratio: f64,
    /// Cases that came to their end.
    pub runs: usize,
    /// Cases that ended early.
    pub early_runs: usize,
    /// Of those that did not: in each mode.
    pub modes: [usize; KINDS],
    /// Of those: whose asperities were ground.
    pub ground_runs: usize,
    /// Of those: in which a large piece came off.
    pub split_runs: usize,
    /// Means of the share that was ground, the largest piece and the share that was worn [-].
    pub means: [f64; 3],
}

/// What the cases in the results folder `out` come to.
pub fn result(file: &MapFile, out: &Path) -> Map {
    let read = |case: Case| case::read(file, &case, out).map(|made| (case, made));
    let cases: Vec<(Case, Made)> = file.cases().into_iter().filter_map(read).collect();
    let mut made: BTreeMap<[u64; 3], Vec<&Made>> = BTreeMap::new();
    for (case, one) in &cases {
        let at = [case.strength_ratio, case.shear_strength, case.adhesion_ratio];
        made.entry(at.map(f64::to_bits)).or_default().push(one);
    }
    let mut points = Vec::new();
    for &strength_ratio in &file.strength_ratios {
        for &shear_strength in &file.shear_strengths {
            for &adhesion_ratio in &file.adhesion_ratios {
                let mut point =
                    Point { strength_ratio, shear_strength, adhesion_ratio, ..Point::default() };
                let at = [strength_ratio, shear_strength, adhesion_ratio].map(f64::to_bits);
                if let Some(own) = made.get(&at) {
                    point.count(own);
                    points.push(point);
                }
            }
        }
    }
    Map { file: file.clone(), cases, points }
}

impl Point {
    /// Cases that came to their end and whose bodies touched.
    fn touched(&self) -> usize {
        let apart = MODES.iter().zip(self.modes).filter(|(mode, _)| **mode == Mode::NoContact);
        self.runs - apart.map(|(_, count)| count).sum::<usize>()
    }

    fn count(&mut self, own: &[&Made]) {
        let figures: Vec<&Figures> = own.iter().filter_map(|made| made.as_ref().ok()).collect();
        self.runs = figures.len();
        self.early_runs = own.len() - figures.len();
        for figures in &figures {
            let mode = MODES.iter().position(|mode| *mode == figures.mode()).unwrap_or(0);
            self.modes[mode] += 1;
            self.ground_runs += usize::from(figures.is_ground());
            self.split_runs += usize::from(figures.is_split());
        }
        let mean = |of: fn(&Figures) -> f64| {
            figures.iter().map(|figures| of(figures)).sum::<f64>() / self.runs.max(1) as f64
        };
        self.means = [mean(|f| f.ground), mean(|f| f.largest_piece), mean(|f| f.worn)];
    }
}

/// The interval in words: `<=` and `>=` where the runs do not bound it.
fn interval(Boundary { interval: [low, high], is_bounded: [from, to], .. }: &Boundary) -> String {
    let (from, to) = (if *from { "" } else { "<= " }, if *to { "" } else { ">= " });
    format!("{from}{low:.2} to {to}{high:.2}")
}

impl Map {
    /// Number of cases that are missing.
    pub fn missing(&self) -> usize {
        self.file.cases().len() - self.cases.len()
    }

    /// Number of points of which every case that is there ended early.
    pub fn fruitless(&self) -> usize {
        self.points.iter().filter(|point| point.runs == 0).count()
    }

    /// How many cases ended early, and why the first of them did; nothing where none did.
    fn failures(&self) -> String {
        let early: Vec<(&Case, &String)> = self
            .cases
            .iter()
            .filter_map(|(case, made)| made.as_ref().err().map(|cause| (case, cause)))
            .collect();
        match early.first() {
            Some((case, cause)) => format!(
                "{} of {} ended early; the first, case {}: {cause}\n",
                early.len(),
                count(self.cases.len(), "case", "cases"),
                case.number
            ),
            None => String::new(),
        }
    }

    /// Where grinding begins along sigma_0 / sigma_j, for each a and sigma_j; none where that is not
    /// between the points.
    pub fn boundaries(&self) -> Vec<(f64, f64, Option<Boundary>)> {
        let mut found = Vec::new();
        for &ratio in &self.file.strength_ratios {
            for &strength in &self.file.shear_strengths {
                let is_own = |p: &&Point| p.strength_ratio == ratio && p.shear_strength == strength;
                let share = |p: &Point| Share {
                    value: p.adhesion_ratio,
                    runs: p.touched(),
                    hits: p.ground_runs,
                };
                let shares: Vec<Share> = self.points.iter().filter(is_own).map(share).collect();
                if !shares.is_empty() {
                    found.push((ratio, strength, fit::boundary(&shares)));
                }
            }
        }
        found
    }

    /// The points as a table to read.
    pub fn table(&self) -> String {
        let mut text = "     a  sigma_j MPa  s0/sj  runs  ground  split  modes\n".to_owned();
        for point in &self.points {
            let modes: Vec<String> = MODES
                .iter()
                .zip(point.modes)
                .filter(|(_, count)| *count > 0)
                .map(|(mode, count)| format!("{count} {}", mode.name()))
                .collect();
            let failed = match point.early_runs {
                0 => String::new(),
                count => format!("; {count} ended early"),
            };
            text += &format!(
                "{:6.2} {:12.3} {:6.3} {:5} {:7} {:6}  {}{failed}\n",
                point.strength_ratio,
                point.shear_strength / 1e6,
                point.adhesion_ratio,
                point.runs,
                point.ground_runs,
                point.split_runs,
                modes.join(", "),
            );
        }
        for (ratio, strength, boundary) in self.boundaries() {
            let (ratio, strength) = (format!("a = {ratio}"), strength / 1e6);
            text += &match boundary {
                Some(boundary) => format!(
                    "{ratio}, sigma_j {strength} MPa: half of the runs grind at sigma_0/sigma_j = \
                     {:.2} ({})\n",
                    boundary.at,
                    interval(&boundary)
                ),
                None => {
                    format!("{ratio}, sigma_j {strength} MPa: no boundary among these points\n")
                }
            };
        }
        text + &self.failures()
    }
}
