//! How the elements of a body lie: on a close-packed lattice along the surface, turned, or disturbed.

use abrade::ParameterError;
use abrade::quantity::{self, Quantity};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::profile::Profile;

/// Places that differ by less are one, in diameters: what sums of rounded lengths leave.
const SLACK: f64 = 1e-6;

/// How the elements lie.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum Packing {
    /// Close-packed, rows along the surface.
    #[default]
    Regular,
    /// Close-packed, rows at an angle with the surface. What does not fit over the period is left out.
    Rotated {
        /// That angle, anticlockwise [rad].
        #[serde(deserialize_with = "quantity::angle")]
        #[schemars(with = "Quantity")]
        angle: f64,
    },
    /// Rows along the surface, each element moved at random; links are without stress as they then are.
    Disordered {
        /// The furthest that an element is moved, in diameters [-].
        amplitude: f64,
        /// Seed of the random numbers.
        #[serde(default)]
        seed: u64,
    },
}

impl Packing {
    /// Every value outside its range, with the field it stands in.
    pub fn check(&self) -> Vec<ParameterError> {
        let found = match self {
            Self::Regular => None,
            Self::Rotated { angle } => ParameterError::within("angle", *angle, -10.0, 10.0)
                .map(|error| ParameterError { allowed: "between -10 and 10 rad".into(), ..error }),
            // Beyond it the next but one neighbour may come nearer than the next.
            Self::Disordered { amplitude, .. } => {
                ParameterError::within("amplitude", *amplitude, 0.0, 0.15)
            }
        };
        found.into_iter().collect()
    }
}

/// The room that a body fills with elements, in its own frame: the base from y = 0 up, asperities on it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Room<'a> {
    pub(crate) diameter: f64,
    pub(crate) period: f64,
    pub(crate) profile: &'a Profile,
    /// Rows of the base and of the asperities; the lowest centres lie at zero.
    pub(crate) base_rows: usize,
    pub(crate) asperity_rows: usize,
}

impl Room<'_> {
    /// From row to row [m].
    pub(crate) fn row_height(&self) -> f64 {
        0.5 * 3f64.sqrt() * self.diameter
    }

    /// Height of the highest row, which the outline may leave without an element [m].
    pub(crate) fn top(&self) -> f64 {
        (self.base_rows + self.asperity_rows - 1) as f64 * self.row_height()
    }

    /// Centres below this height belong to the base [m].
    pub(crate) fn base_top(&self) -> f64 {
        (self.base_rows as f64 - 0.5) * self.row_height()
    }

    /// Whether the body holds a centre; its lowest edge is half a row below the lowest regular centres.
    fn holds(&self, [x, y]: [f64; 2]) -> bool {
        let slack = SLACK * self.diameter;
        let depth = self.profile.depth(x, self.period, 0.5 * self.diameter);
        y > -0.5 * self.row_height() && (y < self.base_top() || depth <= self.top() - y + slack)
    }

    /// Places of the lattice that [`Room::fill`] looks at.
    pub(crate) fn places(&self, packing: &Packing) -> f64 {
        let rows = (self.base_rows + self.asperity_rows) as f64;
        match packing {
            Packing::Regular | Packing::Disordered { .. } => rows * self.period / self.diameter,
            // A square about the middle of the surface that holds the body however it is turned.
            Packing::Rotated { .. } => {
                let reach = self.period.hypot(rows * self.row_height());
                4.0 * reach * reach / (self.row_height() * self.diameter)
            }
        }
    }

    /// The centres of the elements, row after row of the lattice. `draw` tells bodies of one seed apart.
    pub(crate) fn fill(&self, packing: &Packing, draw: u64) -> Vec<[f64; 2]> {
        match *packing {
            Packing::Regular => self.rows(),
            Packing::Rotated { angle } => self.turned_rows(angle),
            Packing::Disordered { amplitude, seed } => {
                let mut generator = Pcg32::seed_from_u64(seed.wrapping_mul(2).wrapping_add(draw));
                let mut moved = |[x, y]: [f64; 2]| {
                    let [a, b] = disc(&mut generator).map(|c| c * amplitude * self.diameter);
                    [x + a, y + b]
                };
                self.rows().into_iter().map(&mut moved).collect()
            }
        }
    }

    /// Rows along the surface; the highest has as many elements as the facet of a trapezoid has room
    /// for, evenly about its middle.
    fn rows(&self) -> Vec<[f64; 2]> {
        let d = self.diameter;
        let columns = (self.period / d).round() as usize;
        let rows = self.base_rows + self.asperity_rows;
        let in_facet = (self.profile.facing(self.period) / d + SLACK).floor();
        let mut centres = Vec::new();
        for row in 0..rows {
            let shift = 0.5 * (in_facet - 1.0) + 0.5 * ((rows - 1 - row) % 2) as f64;
            let first = (0.5 * self.period / d + shift).rem_euclid(1.0);
            // A column that falls onto the period's end is the one at its beginning.
            let first = if first > 1.0 - SLACK { 0.0 } else { first };
            let y = row as f64 * self.row_height();
            let row = (0..columns).map(|column| [(first + column as f64) * d, y]);
            centres.extend(row.filter(|centre| self.holds(*centre)));
        }
        centres
    }

    /// Rows at an angle, through the middle of the surface.
    fn turned_rows(&self, angle: f64) -> Vec<[f64; 2]> {
        let (d, h) = (self.diameter, self.row_height());
        let (sin, cos) = angle.sin_cos();
        let middle = [0.5 * self.period, self.top()];
        let reach = self.period.hypot(self.top());
        let (rows, columns) = ((reach / h).ceil() as i64, (reach / d).ceil() as i64);
        let mut centres: Vec<[f64; 2]> = Vec::new();
        for row in -rows..=rows {
            for column in -columns..=columns {
                let (a, b) =
                    ((column as f64 + 0.5 * (row.rem_euclid(2)) as f64) * d, row as f64 * h);
                let centre = [middle[0] + cos * a - sin * b, middle[1] + sin * a + cos * b];
                if (0.0..self.period).contains(&centre[0]) && self.holds(centre) {
                    centres.push(centre);
                }
            }
        }
        self.without_those_that_overlap(centres)
    }

    /// Leaves out what overlaps an element beyond the period's beginning by more than a tenth.
    fn without_those_that_overlap(&self, centres: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
        let d = self.diameter;
        let first: Vec<[f64; 2]> = centres.iter().filter(|c| c[0] < d).copied().collect();
        let overlaps = |centre: &[f64; 2]| {
            centre[0] > self.period - d
                && first.iter().any(|other| {
                    let dx = other[0] + self.period - centre[0];
                    dx.hypot(other[1] - centre[1]) < 0.9 * d
                })
        };
        centres.into_iter().filter(|centre| !overlaps(centre)).collect()
    }
}

/// A point of the unit disc, evenly.
fn disc(generator: &mut Pcg32) -> [f64; 2] {
    loop {
        let [a, b]: [f64; 2] = generator.random();
        let point = [2.0 * a - 1.0, 2.0 * b - 1.0];
        if point[0] * point[0] + point[1] * point[1] <= 1.0 {
            return point;
        }
    }
}
