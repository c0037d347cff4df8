//! Two bodies with asperities and how they are led past each other: the lower one, and the same turned by
//! half a turn above it.

use abrade::ParameterError;
use abrade::quantity::{self, Quantity};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::assembly::{Assembly, Element, Hold};
use crate::error::AdhesiveError;
use crate::numerics::Numerics;
use crate::packing::{Packing, Room};
use crate::profile::{Profile, within};
use crate::solid::Solid;

/// Centres of one summit are at most this far apart along x, in diameters.
const BESIDE: f64 = 1.5;

/// Elements of a body nearer than this, in diameters, are linked: next neighbours, disordered or not.
const LINKED: f64 = 1.3;

/// Most places of a lattice that a body may lie on: its elements would fill gigabytes.
const PLACES: f64 = 1e7;

/// Two bodies and their way past each other. The paper leaves out facet, sides, base, period, speed and
/// the level that its overlap counts from: those defaults are this program's.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Asperities {
    /// Diameter d of an element (default 25 um) [m].
    #[serde(deserialize_with = "quantity::length")]
    #[schemars(with = "Quantity")]
    pub diameter: f64,
    /// Outline of the asperities (default `Trapezoid()`).
    pub profile: Profile,
    /// Thickness of the base (default 0.25 mm) [m].
    #[serde(deserialize_with = "quantity::length")]
    #[schemars(with = "Quantity")]
    pub base: f64,
    /// Length after which everything repeats, rounded to whole diameters (default 2.25 mm) [m].
    #[serde(deserialize_with = "quantity::length")]
    #[schemars(with = "Quantity")]
    pub period: f64,
    /// How the elements lie (default `Regular`).
    pub packing: Packing,
    /// Overlap: the centres of the highest element that the lower body has and of the lowest of the upper
    /// pass each other d (1 - overlap) apart in height (default 0.3) [-].
    pub overlap: f64,
    /// Distance along x of the corners that come together, in diameters (default 1.2): of the facets of
    /// trapezoids, else of the outermost elements of the highest rows [-].
    pub gap: f64,
    /// Speed of each body: the lower to the right, the upper to the left (default 1 m/s) [m/s].
    #[serde(deserialize_with = "quantity::speed")]
    #[schemars(with = "Quantity")]
    pub speed: f64,
    /// How far one body goes past the other (default: twice the facet or once the period, and six
    /// diameters) [m].
    #[serde(
        deserialize_with = "quantity::optional_length",
        skip_serializing_if = "Option::is_none"
    )]
    #[schemars(with = "Option<Quantity>")]
    pub travel: Option<f64>,
    /// Drag of the bases in shear waves through the base (default 0.5): ringing of the slabs dies out [-].
    pub base_drag: f64,
    /// Step in times that a longitudinal wave takes through an element (default 0.5), below the limit
    /// of `Numerics` [-].
    pub courant: f64,
    /// Relaxation time of the links' dashpots in the same times (default 0.1) [-].
    pub viscosity: f64,
}

impl Default for Asperities {
    fn default() -> Self {
        let numerics = Numerics::default();
        Self {
            diameter: 25e-6,
            profile: Profile::default(),
            base: 0.25e-3,
            period: 2.25e-3,
            packing: Packing::Regular,
            overlap: 0.3,
            gap: 1.2,
            speed: 1.0,
            travel: None,
            base_drag: 0.5,
            courant: numerics.courant,
            viscosity: numerics.viscosity,
        }
    }
}

/// Which part of which body an element belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// Whether it is the upper body.
    pub is_upper: bool,
    /// What of it.
    pub place: Place,
}

/// Where in a body an element lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// The outermost row, which is led.
    Rigid,
    /// The base beside it.
    Base,
    /// An asperity.
    Asperity,
}

impl Asperities {
    /// Every value outside its range, with the field it stands in.
    pub fn check(&self) -> Vec<ParameterError> {
        let d = self.diameter;
        let mut found: Vec<ParameterError> =
            ParameterError::positive("diameter", d).into_iter().collect();
        if !found.is_empty() {
            return found;
        }
        let travel = self.travel.and_then(|travel| ParameterError::positive("travel", travel));
        found.extend(
            [
                within("base", self.base, 2.0 * d, 1000.0 * d),
                within("period", self.period, 4.0 * d, 1e5 * d),
                ParameterError::within("overlap", self.overlap, -1.0, 0.9),
                ParameterError::within("gap", self.gap, -1e5, 1e5),
                ParameterError::positive("speed", self.speed),
                travel,
                ParameterError::within("base_drag", self.base_drag, 0.0, 10.0),
            ]
            .into_iter()
            .flatten(),
        );
        found.extend(self.numerics().check());
        found.extend(self.packing.check());
        if found.is_empty() {
            found.extend(self.profile.check(d, self.whole_period()));
        }
        if found.is_empty() {
            found.extend(self.too_many());
        }
        found
    }

    /// A fault if there are more places for elements than a machine holds.
    fn too_many(&self) -> Option<ParameterError> {
        let places = self.room().places(&self.packing);
        let allowed = format!("such that a body has at most {PLACES:e} places, not {places:.1e}");
        let (field, value) = ("period", self.period);
        (places > PLACES).then_some(ParameterError { field, value, allowed })
    }

    /// How time is cut.
    pub(crate) fn numerics(&self) -> Numerics {
        Numerics { courant: self.courant, viscosity: self.viscosity }
    }

    /// The period in whole diameters [m].
    pub fn whole_period(&self) -> f64 {
        (self.period / self.diameter).round() * self.diameter
    }

    /// How far one body goes past the other [m].
    pub fn whole_travel(&self) -> f64 {
        let facing = match self.profile {
            Profile::Trapezoid { top, .. } => 2.0 * top,
            Profile::Line { .. } => self.whole_period(),
        };
        self.travel.unwrap_or(facing + 6.0 * self.diameter)
    }

    fn room(&self) -> Room<'_> {
        let mut room = Room {
            diameter: self.diameter,
            period: self.whole_period(),
            profile: &self.profile,
            base_rows: 0,
            asperity_rows: 0,
        };
        let rows = |height: f64| (height / room.row_height()).round().max(1.0) as usize;
        (room.base_rows, room.asperity_rows) = (rows(self.base), rows(self.profile.height()));
        room
    }

    /// The elements at the start and the part that each belongs to.
    ///
    /// # Errors
    /// Elements of the two bodies overlap at the start.
    pub(crate) fn assemble(&self, solid: &Solid) -> Result<(Assembly, Vec<Part>), AdhesiveError> {
        let drag = self.base_drag * solid.shear_speed() / self.base;
        let (mut assembly, parts) = self.place(drag);
        assembly.link_within(LINKED, |i, j| parts[i].is_upper == parts[j].is_upper);
        for link in &mut assembly.links {
            let is_rigid = link.ends.map(|end| parts[end as usize].place == Place::Rigid);
            link.can_break = is_rigid != [true, true];
        }
        match self.bodies_overlap(&assembly, &parts) {
            true => Err(AdhesiveError::Overlap { gap: self.gap }),
            false => Ok((assembly, parts)),
        }
    }

    /// The elements at the start, without links, and their parts; `drag` is that of the bases [1/s].
    pub(crate) fn place(&self, drag: f64) -> (Assembly, Vec<Part>) {
        let room = self.room();
        let (d, period) = (self.diameter, room.period);
        let mut assembly =
            Assembly { diameter: d, period: Some(period), elements: Vec::new(), links: Vec::new() };
        let mut parts = Vec::new();
        let bodies = [0, 1].map(|draw| room.fill(&self.packing, draw));
        let [lower, upper] = [highest(&bodies[0]), highest(&bodies[1])];
        // Half a turn about the point between the corners takes one body to the other.
        let along = match self.profile {
            Profile::Trapezoid { top, .. } => period + (top + self.gap * d),
            // An element's edge lies half a diameter beyond its centre.
            Profile::Line { .. } => {
                corner(&bodies[0], &room) + corner(&bodies[1], &room) + d * (1.0 + self.gap)
            }
        };
        let pivot = [along, lower + upper + d * (1.0 - self.overlap)];
        for (is_upper, centres) in [false, true].into_iter().zip(bodies) {
            for [x, y] in centres {
                let place = match y {
                    y if y < 0.5 * room.row_height() => Place::Rigid,
                    y if y < room.base_top() => Place::Base,
                    _ => Place::Asperity,
                };
                let position = if is_upper { [pivot[0] - x, pivot[1] - y] } else { [x, y] };
                let speed = if is_upper { -self.speed } else { self.speed };
                assembly.elements.push(Element {
                    position,
                    velocity: [speed, 0.0],
                    hold: if place == Place::Rigid { Hold::ALL } else { Hold::default() },
                    drag: if place == Place::Base { drag } else { 0.0 },
                });
                parts.push(Part { is_upper, place });
            }
        }
        (assembly, parts)
    }

    pub(crate) fn bodies_overlap(&self, assembly: &Assembly, parts: &[Part]) -> bool {
        let positions: Vec<[f64; 2]> = assembly.elements.iter().map(|e| e.position).collect();
        let grid = crate::grid::Grid::new(&positions, assembly.period, 0.95 * self.diameter);
        let mut overlap = false;
        for (i, position) in positions.iter().enumerate() {
            grid.each_later(i, *position, |j| overlap |= parts[i].is_upper != parts[j].is_upper);
        }
        overlap
    }
}

/// Height of the highest centre. A row may hold none: a peak is narrower than an element, and rows that are
/// turned or disturbed do not end where the outline does.
fn highest(centres: &[[f64; 2]]) -> f64 {
    centres.iter().map(|centre| centre[1]).fold(f64::NEG_INFINITY, f64::max)
}

/// Place along x of the end of the last summit [m], which may lie over the period: of the centres that are at
/// most half a row below the highest, the one with no next to it.
fn corner(centres: &[[f64; 2]], room: &Room<'_>) -> f64 {
    let least = highest(centres) - 0.5 * room.row_height();
    let high: Vec<f64> =
        centres.iter().filter(|centre| centre[1] >= least).map(|centre| centre[0]).collect();
    let last = high.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let mut end = last;
    // A summit as long as the period has no end.
    for _ in 0..high.len() {
        let ahead = high.iter().map(|x| (x - end).rem_euclid(room.period));
        let next = ahead.filter(|way| *way > 0.5 * room.diameter).fold(f64::INFINITY, f64::min);
        if next > BESIDE * room.diameter {
            return end;
        }
        end += next;
    }
    last
}
