//! What a simulation begins with: elements, links between them, what is held and led.

use abrade::ParameterError;

use crate::error::AdhesiveError;
use crate::grid::Grid;

/// Elements nearer than this are at one place, in diameters: what rounding leaves of a distance.
const ONE_PLACE: f64 = 1e-9;

/// Which motion of an element is prescribed: it keeps that part of its velocity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Hold {
    /// Along x.
    pub x: bool,
    /// Along y.
    pub y: bool,
    /// About z.
    pub spin: bool,
}

impl Hold {
    /// All of it.
    pub const ALL: Self = Self { x: true, y: true, spin: true };
}

/// An element at the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Element {
    /// Position of its centre [m].
    pub position: [f64; 2],
    /// Velocity [m/s].
    pub velocity: [f64; 2],
    /// What of it is prescribed.
    pub hold: Hold,
    /// Rate at which its velocity tends to that of the start [1/s].
    pub drag: f64,
}

/// Two elements that are linked at the start, without stress.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Link {
    /// Indices of the elements.
    pub ends: [u32; 2],
    /// Whether the link may fail.
    pub can_break: bool,
}

/// Elements of one size and their links.
#[derive(Clone, Debug, PartialEq)]
pub struct Assembly {
    /// Diameter d of an element [m].
    pub diameter: f64,
    /// Length after which everything repeats along x [m].
    pub period: Option<f64>,
    /// The elements.
    pub elements: Vec<Element>,
    /// The links.
    pub links: Vec<Link>,
}

impl Assembly {
    /// Links that may fail between all elements whose centres are less than `reach` diameters apart
    /// and which `is_one_body` says belong together.
    pub fn link_within(&mut self, reach: f64, is_one_body: impl Fn(usize, usize) -> bool) {
        let positions: Vec<[f64; 2]> = self.elements.iter().map(|e| e.position).collect();
        let grid = Grid::new(&positions, self.period, reach * self.diameter);
        for (i, position) in positions.iter().enumerate() {
            grid.each_later(i, *position, |j| {
                if is_one_body(i, j) {
                    self.links.push(Link { ends: [i as u32, j as u32], can_break: true });
                }
            });
        }
    }

    /// How much stiffer spins may be than in a lattice [-], 1 at least.
    ///
    /// Against spins, the links of two ends act with their lengths; the largest sum of those of both
    /// ends of a link, over those of a lattice, bounds the stiffness (a matrix with a row for each
    /// link has the same eigenvalues, and none exceeds its largest sum of a row).
    pub(crate) fn linkage(&self) -> f64 {
        let length = |link: &Link| {
            let [i, j] = link.ends.map(|end| self.elements[end as usize].position);
            let dx = j[0] - i[0];
            let image = self.period.map_or(0.0, |period| period * (dx / period).round());
            (dx - image).hypot(j[1] - i[1]) / self.diameter
        };
        let mut sums = vec![0.0; self.elements.len()];
        for link in &self.links {
            link.ends.iter().for_each(|end| sums[*end as usize] += length(link));
        }
        let both = |link: &Link| link.ends.map(|end| sums[end as usize]).iter().sum::<f64>();
        self.links.iter().map(|link| both(link) / 12.0).fold(1.0, f64::max)
    }

    /// The first fault.
    pub(crate) fn check(&self) -> Result<(), AdhesiveError> {
        if let Some(error) = ParameterError::positive("diameter", self.diameter) {
            return Err(error.into());
        }
        if let Some(period) = self.period {
            let least = 4.0 * self.diameter;
            if let Some(error) = ParameterError::within("period", period, least, f64::MAX) {
                return Err(error.into());
            }
        }
        let count = self.elements.len();
        let is_fine = |e: &Element| {
            let numbers = [e.position[0], e.position[1], e.velocity[0], e.velocity[1], e.drag];
            numbers.iter().all(|x| x.is_finite()) && e.drag >= 0.0
        };
        if let Some(element) = self.elements.iter().position(|e| !is_fine(e)) {
            return Err(AdhesiveError::Element { element });
        }
        for (link, Link { ends, .. }) in self.links.iter().enumerate() {
            let [i, j] = ends.map(|end| end as usize);
            if i >= count || j >= count || i == j {
                return Err(AdhesiveError::Link { link, ends: *ends, elements: count });
            }
        }
        match self.at_one_place() {
            Some(ends) => Err(AdhesiveError::OnePlace { ends }),
            None => Ok(()),
        }
    }

    /// The first two elements with no distance that gives their pair a direction.
    fn at_one_place(&self) -> Option<[usize; 2]> {
        let positions: Vec<[f64; 2]> = self.elements.iter().map(|e| e.position).collect();
        let grid = Grid::new(&positions, self.period, ONE_PLACE * self.diameter);
        let mut found = None;
        for (i, position) in positions.iter().enumerate() {
            grid.each_later(i, *position, |j| found = found.or(Some([i, j])));
        }
        found
    }
}
