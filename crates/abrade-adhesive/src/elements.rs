//! Elements as columns. Behind the last element stand ghosts: ends of pairs that are not there, so that
//! pairs and elements fill whole blocks.

use crate::assembly::{Assembly, Hold};
use crate::column::Column;
use crate::four::LANES;
use crate::lanes::Sum;
use crate::solid::Constants;

/// Columns of elements, each `padded` long.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Elements {
    /// Number of elements without ghosts.
    pub(crate) count: usize,
    /// Position [m], velocity [m/s], spin [rad/s].
    pub(crate) x: Column,
    pub(crate) y: Column,
    pub(crate) vx: Column,
    pub(crate) vy: Column,
    pub(crate) spin: Column,
    /// One over the mass [1/kg] and inertia [1/(kg m2)]; zero where the motion is held.
    pub(crate) mobility_x: Column,
    pub(crate) mobility_y: Column,
    pub(crate) mobility_spin: Column,
    /// Share of the velocity over that of the start that a step's drag takes along x and y [-], and
    /// that velocity.
    pub(crate) drag: [Column; 2],
    pub(crate) led_x: Column,
    pub(crate) led_y: Column,
    /// Elements with a held motion.
    pub(crate) held: Vec<(u32, Hold)>,
    /// First elements of the blocks with a drag.
    pub(crate) dragged: Vec<u32>,
    /// Number of linked faces, and the response that goes with it [Pa].
    pub(crate) linked: Vec<u32>,
    pub(crate) response: Column,
    /// Equivalent plastic strain [-].
    pub(crate) plastic_strain: Column,
    /// Strain of faces whose traction changed at fixed centres, for the next mean stress [-].
    pub(crate) released: Column,
    /// Increment of the mean stress in this step [Pa].
    pub(crate) mean_step: Column,
    /// Sum of those increments [Pa]: what the energies go by. The mean of the stress tensor has a share of
    /// the neighbours in it.
    pub(crate) mean_sum: Column,
    /// Stress [Pa].
    pub(crate) sxx: Column,
    pub(crate) syy: Column,
    pub(crate) sxy: Column,
    pub(crate) szz: Column,
    /// Mean stress [Pa], factor M of the return [-], (1 - M) times the mean stress [Pa].
    pub(crate) mean: Column,
    pub(crate) kept: Column,
    pub(crate) shifted: Column,
    /// Square of the greater of equivalent and mean stress [Pa2]; infinite where a block flows.
    pub(crate) level: Column,
    /// Sums over pairs: strain of faces; stress times 3; force [N] and torque [N m].
    pub(crate) strain: Sum,
    pub(crate) face_xx: Sum,
    pub(crate) face_yy: Sum,
    pub(crate) face_xy: Sum,
    pub(crate) force_x: Sum,
    pub(crate) force_y: Sum,
    pub(crate) torque: Sum,
}

impl Elements {
    /// The elements of an assembly, at rest in themselves; a step takes `step` [s].
    pub(crate) fn new(assembly: &Assembly, constants: &Constants, step: f64) -> Self {
        let count = assembly.elements.len();
        // Two ghosts at least: the ends of a pair lie apart.
        let padded = (count + 2).next_multiple_of(LANES);
        let zeros = || Column::new(0.0, padded);
        let sum = || [zeros(), zeros()];
        let mut elements = Self {
            count,
            x: zeros(),
            y: zeros(),
            vx: zeros(),
            vy: zeros(),
            spin: zeros(),
            mobility_x: zeros(),
            mobility_y: zeros(),
            mobility_spin: zeros(),
            drag: [zeros(), zeros()],
            led_x: zeros(),
            led_y: zeros(),
            held: Vec::new(),
            dragged: Vec::new(),
            linked: vec![0; padded],
            response: Column::new(constants.response_of(0), padded),
            plastic_strain: zeros(),
            released: zeros(),
            mean_step: zeros(),
            mean_sum: zeros(),
            sxx: zeros(),
            syy: zeros(),
            sxy: zeros(),
            szz: zeros(),
            mean: zeros(),
            kept: Column::new(1.0, padded),
            shifted: zeros(),
            level: zeros(),
            strain: sum(),
            face_xx: sum(),
            face_yy: sum(),
            face_xy: sum(),
            force_x: sum(),
            force_y: sum(),
            torque: sum(),
        };
        elements.place(assembly, constants, step);
        elements
    }

    fn place(&mut self, assembly: &Assembly, constants: &Constants, step: f64) {
        for (at, element) in assembly.elements.iter().enumerate() {
            [self.x[at], self.y[at]] = element.position;
            [self.vx[at], self.vy[at]] = element.velocity;
            [self.led_x[at], self.led_y[at]] = element.velocity;
            let hold = element.hold;
            let free = |is_held: bool, inertia: f64| if is_held { 0.0 } else { 1.0 / inertia };
            self.mobility_x[at] = free(hold.x, constants.mass);
            self.mobility_y[at] = free(hold.y, constants.mass);
            self.mobility_spin[at] = free(hold.spin, constants.inertia);
            let drag = (element.drag * step).min(1.0);
            self.drag[0][at] = if hold.x { 0.0 } else { drag };
            self.drag[1][at] = if hold.y { 0.0 } else { drag };
            if hold.x || hold.y {
                self.held.push((at as u32, hold));
            }
            let block = (at - at % LANES) as u32;
            if drag > 0.0 && self.dragged.last() != Some(&block) {
                self.dragged.push(block);
            }
        }
        for ghost in self.count..self.x.len() {
            self.x[ghost] = (ghost - self.count) as f64 * constants.diameter;
        }
    }

    /// The two ghosts that pairs end at which are not there.
    pub(crate) fn ghosts(&self) -> [u32; 2] {
        [self.count as u32, self.count as u32 + 1]
    }
}
