//! A collision of asperities: the simulation, how far it is, and what it comes to.

use crate::asperities::{Asperities, Part, Place};
use crate::classify::{self, Figures, State};
use crate::error::AdhesiveError;
use crate::pairs::Pair;
use crate::simulation::Simulation;
use crate::solid::Solid;

/// Share of the travel at whose end the pace of the elements is taken.
const LAST: f64 = 0.1;

/// Two bodies on their way past each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Collision {
    simulation: Simulation,
    parts: Vec<Part>,
    speed: f64,
    travel: f64,
    diameter: f64,
    period: f64,
    facet: f64,
    /// Positions at the start, and where the last part of the travel began, with the time there [m, s].
    start: Vec<[f64; 2]>,
    before: Vec<f64>,
    before_time: f64,
    /// Rigid elements of the lower body, and the sum of the forces on them over the steps [N].
    led: Vec<usize>,
    force: [f64; 2],
    steps: u64,
}

impl Collision {
    /// The bodies of a solid at the start.
    ///
    /// # Errors
    /// A parameter is out of range, adhesion reaches further than pairs are followed, the step is not stable in
    /// the solid, or the bodies overlap.
    pub fn new(solid: &Solid, asperities: &Asperities) -> Result<Self, AdhesiveError> {
        if let Some(error) = solid.check().into_iter().chain(asperities.check()).next() {
            return Err(error.into());
        }
        if let Some(error) = asperities.beyond_reach(solid) {
            return Err(error.into());
        }
        let (assembly, parts) = asperities.assemble(solid)?;
        let simulation = Simulation::new(solid, &assembly, asperities.numerics())?;
        let start: Vec<[f64; 2]> = assembly.elements.iter().map(|e| e.position).collect();
        let lower = Part { is_upper: false, place: Place::Rigid };
        let period = asperities.whole_period();
        Ok(Self {
            led: (0..parts.len()).filter(|at| parts[*at] == lower).collect(),
            before: start.iter().map(|position| position[0]).collect(),
            before_time: 0.0,
            simulation,
            parts,
            speed: asperities.speed,
            travel: asperities.whole_travel(),
            diameter: asperities.diameter,
            period,
            facet: asperities.profile.facing(period) / asperities.diameter,
            start,
            force: [0.0; 2],
            steps: 0,
        })
    }

    /// Goes on by one step.
    ///
    /// # Errors
    /// An element moved further than a step resolves.
    pub fn step(&mut self) -> Result<(), AdhesiveError> {
        if self.before_time == 0.0 && self.share() >= 1.0 - LAST {
            self.before_time = self.simulation.time();
            for (at, x) in self.before.iter_mut().enumerate() {
                *x = self.simulation.position(at)[0];
            }
        }
        self.simulation.step()?;
        let [fx, fy] = self.load();
        self.force = [self.force[0] + fx, self.force[1] + fy];
        self.steps += 1;
        Ok(())
    }

    /// Share of the travel that is done [-]; 1 and more at its end.
    pub fn share(&self) -> f64 {
        2.0 * self.speed * self.simulation.time() / self.travel
    }

    /// The simulation.
    pub fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    /// The part that each element belongs to.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// Force that the lower body's links exert on its rigid row now [N], per metre of thickness.
    pub fn load(&self) -> [f64; 2] {
        let forces = self.led.iter().map(|at| self.simulation.force(*at));
        forces.fold([0.0; 2], |[x, y], [fx, fy]| [x + fx, y + fy])
    }

    /// Mean of [`Collision::load`] so far [N].
    pub fn mean_load(&self) -> [f64; 2] {
        self.force.map(|force| force / self.steps.max(1) as f64)
    }

    /// How far an element has left its body [m].
    pub fn left(&self, element: usize) -> f64 {
        let speed = if self.parts[element].is_upper { -self.speed } else { self.speed };
        let ([x, y], [x0, y0]) = (self.simulation.position(element), self.start[element]);
        (x - x0 - speed * self.simulation.time()).hypot(y - y0)
    }

    /// Velocity of an element along x in the last part of the travel, over that of the lower body [-]; that of its
    /// own body before the first step.
    fn pace(&self, element: usize) -> f64 {
        let passed = self.simulation.time() - self.before_time;
        match passed > 0.0 {
            true => {
                let way = self.simulation.position(element)[0] - self.before[element];
                way / (self.speed * passed)
            }
            false if self.parts[element].is_upper => -1.0,
            false => 1.0,
        }
    }

    /// What the collision has come to so far.
    pub fn figures(&self) -> Figures {
        let pairs: Vec<Pair> = self.simulation.pairs().collect();
        let left: Vec<f64> = (0..self.parts.len()).map(|at| self.left(at)).collect();
        let pace: Vec<f64> = (0..self.parts.len()).map(|at| self.pace(at)).collect();
        classify::figures(&State {
            parts: &self.parts,
            pairs: &pairs,
            diameter: self.diameter,
            period: self.period,
            start: &self.start,
            facet: self.facet,
            left: &left,
            pace: &pace,
            have_touched: self.simulation.welds() > 0 || self.simulation.failures() > 0,
        })
    }
}
