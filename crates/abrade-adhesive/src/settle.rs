//! The last pass over the pairs in a step: each follows the return of its ends, changes if that is
//! due, and acts on them. Changes touch nothing that other pairs of this pass go by.

use multiversion::multiversion;

use crate::block::Block;
use crate::elements::Elements;
use crate::faces::{Change, Faces};
use crate::forces::Forces;
use crate::four::{Four, LANES};
use crate::lanes::{BlockPass, Ends, sides};
use crate::pairs::{Face, Pairs};
use crate::returned::{Criterion, Return};
use crate::solid::Constants;

/// Energies that go in the pass [J].
pub(crate) struct Lost {
    /// What pairs held that failed, less what faces gained that came together.
    pub(crate) released: f64,
    /// What the dashpots took.
    pub(crate) viscous: f64,
}

/// Does the pass; the dashpots of linked pairs add `viscosity` [Pa] times the strain of the step.
#[multiversion(targets("x86_64+avx2"))]
pub(crate) fn settle(
    elements: &mut Elements,
    pairs: &mut Pairs,
    constants: &Constants,
    viscosity: f64,
) -> Lost {
    let count = elements.x.len();
    let mut changes = Changes {
        faces: Faces {
            constants,
            mean: &elements.mean,
            mean_sum: &elements.mean_sum,
            released: &mut elements.released,
            linked: &mut elements.linked,
            response: &mut elements.response,
            failures: &mut pairs.failures,
            welds: &mut pairs.welds,
        },
        pairs: &mut pairs.faces,
        released: 0.0,
    };
    let mut pass = Settle {
        returned: Return { kept: &elements.kept[..count], shifted: &elements.shifted[..count] },
        criterion: Criterion {
            sxx: &elements.sxx[..count],
            syy: &elements.syy[..count],
            sxy: &elements.sxy[..count],
            szz: &elements.szz[..count],
            level: &elements.level[..count],
            constants,
        },
        changes: &mut changes,
        forces: Forces {
            force_x: sides(&mut elements.force_x, count),
            force_y: sides(&mut elements.force_y, count),
            torque: sides(&mut elements.torque, count),
            viscosity: Four::splat(viscosity),
            face: Four::splat(constants.face),
        },
        square: Four::ZERO,
    };
    pairs.ends.sweep(&mut pairs.blocks, &mut pass);
    let viscous = pass.square.sum() * viscosity * constants.face * constants.diameter;
    Lost { released: changes.released, viscous }
}

struct Settle<'a, 'b> {
    returned: Return<'a>,
    criterion: Criterion<'a>,
    changes: &'a mut Changes<'b>,
    forces: Forces<'a>,
    /// Sum of the squares of the strains of dashpots.
    square: Four,
}

impl BlockPass for Settle<'_, '_> {
    #[inline(always)]
    fn block<E: Ends>(&mut self, at: usize, block: &mut Block, ends: E) {
        let (mut stress, mut fails) = ([block.normal, block.tangential], 0);
        if !self.criterion.is_calm(ends, stress) {
            stress = self.returned.follow(block, ends);
            [block.normal, block.tangential] = stress;
            fails = self.criterion.fails(block, ends, stress);
        }
        let due = fails | block.unlinked();
        if due != 0 {
            self.changes.change(at, block, ends, [due, fails]);
            stress = [block.normal, block.tangential];
        }
        self.square += self.forces.act(block, ends, stress);
    }
}

/// Pairs that change.
struct Changes<'a> {
    faces: Faces<'a>,
    pairs: &'a mut [Face],
    released: f64,
}

impl Changes<'_> {
    /// Changes pairs of a block: there is a bit for each that is `due`, and for each that fails if
    /// it is a link.
    #[inline(never)]
    fn change<E: Ends>(&mut self, at: usize, block: &mut Block, ends: E, [due, fails]: [u32; 2]) {
        for lane in (0..LANES).filter(|lane| due & (1 << lane) != 0) {
            let mut line = block.line(lane);
            let face = &mut self.pairs[at * LANES + lane];
            let pair = Change { ends: ends.of(lane), line: &mut line, face };
            self.released += self.faces.change(pair, fails & (1 << lane) != 0);
            block.put(lane, &line);
        }
    }
}
