//! The motion of an assembly: one step is a kick, a drift, the passes over pairs and elements, a kick.

use crate::assembly::Assembly;
use crate::block::Line;
use crate::elastic;
use crate::elements::Elements;
use crate::error::AdhesiveError;
use crate::faces;
use crate::flow;
use crate::kinematics;
use crate::lanes::Sum;
use crate::ledger::Ledger;
use crate::motion;
use crate::neighbours::{Neighbours, ROOM};
use crate::numerics::Numerics;
use crate::pairs::{Pair, Pairs};
use crate::settle;
use crate::solid::{Constants, Solid};

/// Most steps from one look at speeds and at the list of pairs to the next.
const LOOK: f64 = 20.0;
/// The furthest that an element may come between two looks at twice its speed, in diameters: what is not
/// yet listed stays out of reach.
const STRIDE: f64 = 0.5 * ROOM;
/// Share of the most steps to the next look that is too few: a list gives the most again.
const SHORT: f64 = 0.25;

/// An assembly in motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Simulation {
    constants: Constants,
    /// Length of a step [s].
    step: f64,
    /// Stress of a dashpot per strain of a step [Pa].
    viscosity: f64,
    steps: u64,
    next_look: u64,
    elements: Elements,
    pairs: Pairs,
    neighbours: Neighbours,
    sums: Ledger,
}

impl Simulation {
    /// The assembly of a solid at its start.
    ///
    /// # Errors
    /// A parameter is out of range, the step is not stable in the solid, or a link or element of the
    /// assembly is impossible.
    pub fn new(
        solid: &Solid,
        assembly: &Assembly,
        numerics: Numerics,
    ) -> Result<Self, AdhesiveError> {
        if let Some(error) = solid.check().into_iter().chain(numerics.check()).next() {
            return Err(error.into());
        }
        assembly.check()?;
        match numerics.unstable(solid, assembly.linkage()) {
            Some(error) => Err(error.into()),
            None => Ok(Self::begin(solid, assembly, numerics)),
        }
    }

    /// The assembly at its start, with parameters that are checked.
    pub(crate) fn begin(solid: &Solid, assembly: &Assembly, numerics: Numerics) -> Self {
        let diameter = assembly.diameter;
        let constants = Constants::new(solid, diameter);
        let step = numerics.step(solid, diameter);
        let mut elements = Elements::new(assembly, &constants, step);
        let mut pairs = Pairs::new(assembly, &elements);
        let mut neighbours = Neighbours::new(&elements, &pairs, diameter, assembly.period);
        neighbours.list(&elements, &mut pairs);
        faces::count_links(&mut elements, &pairs, &constants);
        let viscosity = constants.twice_shear * numerics.viscosity / numerics.courant;
        let sums = Ledger::default();
        Self {
            constants,
            step,
            viscosity,
            steps: 0,
            next_look: 0,
            elements,
            pairs,
            neighbours,
            sums,
        }
    }

    /// Goes on by one step.
    ///
    /// # Errors
    /// An element moved further than a step resolves, or what moves it is no longer a number.
    pub fn step(&mut self) -> Result<(), AdhesiveError> {
        self.sums.drive += motion::drive_work(&self.elements, self.step);
        motion::begin(&mut self.elements, self.step);
        if self.steps == self.next_look {
            self.look()?;
        }
        let Self { constants, step, elements, pairs, sums, .. } = self;
        kinematics::stretch(elements, pairs, constants, *step);
        elastic::mean_stress(elements, constants);
        elastic::trial(elements, pairs, constants);
        sums.plastic += flow::flow(elements, constants);
        let lost = settle::settle(elements, pairs, constants, self.viscosity);
        sums.released += lost.released;
        sums.viscous += lost.viscous;
        sums.drive += motion::drive_work(elements, *step);
        motion::end(elements, *step);
        sums.drag += motion::drag(elements, constants);
        self.steps += 1;
        Ok(())
    }

    /// Refuses speeds that no step resolves, and lists the pairs anew where something may have come near.
    fn look(&mut self) -> Result<(), AdhesiveError> {
        let (square, element) = motion::fastest(&self.elements);
        let speed = square.sqrt();
        let room = STRIDE * self.constants.diameter;
        let stride = 2.0 * speed * self.step;
        if stride.is_nan() || stride > room {
            let allowed = fastest(self.constants.diameter, self.step);
            return Err(AdhesiveError::TooFast { time: self.time(), element, speed, allowed });
        }
        self.refuse_spin()?;
        let most = (room / stride).floor().clamp(1.0, LOOK);
        let left = (room - self.neighbours.moved(&self.elements)) / stride;
        let mut steps = left.floor().min(most);
        if steps < SHORT * most {
            self.neighbours.list(&self.elements, &mut self.pairs);
            steps = most;
        }
        self.next_look = self.steps + steps as u64;
        Ok(())
    }

    /// Refuses spins whose faces move as far as no element may: that is a step that is not stable.
    fn refuse_spin(&self) -> Result<(), AdhesiveError> {
        let radius = 0.5 * self.constants.diameter;
        let allowed = fastest(self.constants.diameter, self.step);
        let spins = &self.elements.spin[..self.elements.count];
        // A spin that is not a number is too fast, too.
        let is_fine = |spin: &f64| spin.abs() * radius <= allowed;
        match spins.iter().position(|spin| !is_fine(spin)) {
            Some(element) => {
                let (time, speed) = (self.time(), spins[element].abs() * radius);
                Err(AdhesiveError::TooFast { time, element, speed, allowed })
            }
            None => Ok(()),
        }
    }

    /// Time since the start [s].
    pub fn time(&self) -> f64 {
        self.steps as f64 * self.step
    }

    /// Length of a step [s].
    pub fn step_length(&self) -> f64 {
        self.step
    }

    /// Number of elements.
    pub fn count(&self) -> usize {
        self.elements.count
    }

    /// Position of an element [m].
    pub fn position(&self, element: usize) -> [f64; 2] {
        [self.elements.x[element], self.elements.y[element]]
    }

    /// Velocity of an element [m/s].
    pub fn velocity(&self, element: usize) -> [f64; 2] {
        [self.elements.vx[element], self.elements.vy[element]]
    }

    /// Spin of an element, anticlockwise [rad/s].
    pub fn spin(&self, element: usize) -> f64 {
        self.elements.spin[element]
    }

    /// Stress of an element, tension above zero: xx, yy, xy, zz [Pa].
    pub fn stress(&self, element: usize) -> [f64; 4] {
        let e = &self.elements;
        [e.sxx[element], e.syy[element], e.sxy[element], e.szz[element]]
    }

    /// Equivalent plastic strain of an element [-].
    pub fn plastic_strain(&self, element: usize) -> f64 {
        self.elements.plastic_strain[element]
    }

    /// Force of its pairs on an element [N], per metre of thickness.
    pub fn force(&self, element: usize) -> [f64; 2] {
        let total = |sum: &Sum| sum[0][element] + sum[1][element];
        [total(&self.elements.force_x), total(&self.elements.force_y)]
    }

    /// Mass of an element [kg] and its moment of inertia [kg m2], per metre of thickness.
    pub fn inertia(&self) -> [f64; 2] {
        [self.constants.mass, self.constants.inertia]
    }

    /// The pairs: those linked at the start, then those within reach of each other.
    pub fn pairs(&self) -> impl Iterator<Item = Pair> {
        let pairs = &self.pairs;
        let is_there = |at: &usize| (pairs.ends.of(*at)[0] as usize) < self.elements.count;
        (0..pairs.len()).filter(is_there).map(|at| {
            let (line, face) = (pairs.line(at), pairs.faces[at]);
            Pair {
                ends: pairs.ends.of(at),
                state: face.state,
                distance: line.distance,
                stress: line.stress,
                breaks: face.breaks,
                is_original: at < pairs.original,
            }
        })
    }

    /// Failures of links so far, also of pairs that are no longer within reach. A link that slips
    /// fails in every step that asks more of it than it bears: this counts steps of links.
    pub fn failures(&self) -> u64 {
        self.pairs.failures
    }

    /// How often faces that had parted or never been linked became a link so far.
    pub fn welds(&self) -> u64 {
        self.pairs.welds
    }

    /// Where the energy is and where it went.
    pub fn ledger(&self) -> Ledger {
        let e = &self.elements;
        let [mass, inertia] = self.inertia();
        let motion = |at: usize| {
            let square = e.vx[at] * e.vx[at] + e.vy[at] * e.vy[at];
            0.5 * (mass * square + inertia * e.spin[at] * e.spin[at])
        };
        // Beside its pairs' an element has that of its mean stress and that of the elastic strain along z
        // which flow leaves, (sigma_zz - A sigma_mean)^2 / (4 G) of its volume.
        let pressed = |at: usize| {
            let mean = e.mean_sum[at];
            let along = e.szz[at] - self.constants.coupling * mean;
            let strained = along * along / (2.0 * self.constants.twice_shear);
            faces::mean_energy(&self.constants, mean, e.response[at])
                + strained * self.constants.volume
        };
        let faces = |(at, line): (usize, Line)| {
            let [i, j] = self.pairs.ends.of(at);
            let mean = e.mean_sum[i as usize] + e.mean_sum[j as usize];
            faces::pair_energy(&line, &self.constants, mean)
        };
        Ledger {
            kinetic: (0..e.count).map(motion).sum(),
            elastic: (0..e.count).map(pressed).sum::<f64>()
                + self.pairs.linked().map(faces).sum::<f64>(),
            ..self.sums
        }
    }
}

/// The highest speed that a step of `step` [s] resolves for elements of `diameter` [m] [m/s].
pub(crate) fn fastest(diameter: f64, step: f64) -> f64 {
    STRIDE * diameter / (2.0 * step)
}
