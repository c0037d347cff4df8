//! What becomes of the faces of a pair: a link fails, parted faces adhere, open, and weld when they meet.
//!
//! Faces deform: what counts as a gap is the distance left when the faces are drawn by the stress they
//! bear. With pv, the stress that the pair would bear if its faces just touched, the gap under the
//! traction s is g(s) = d (pv - s) / (2 G).

use crate::block::Line;
use crate::elements::Elements;
use crate::pairs::{Face, LinkState, Pairs};
use crate::solid::Constants;

/// A pair that may change.
pub(crate) struct Change<'a> {
    pub(crate) ends: [u32; 2],
    pub(crate) line: &'a mut Line,
    pub(crate) face: &'a mut Face,
}

/// What faces change of the elements, and what they go by.
pub(crate) struct Faces<'a> {
    pub(crate) constants: &'a Constants,
    pub(crate) mean: &'a [f64],
    pub(crate) mean_sum: &'a [f64],
    pub(crate) released: &'a mut [f64],
    pub(crate) linked: &'a mut [u32],
    pub(crate) response: &'a mut [f64],
    pub(crate) failures: &'a mut u64,
    pub(crate) welds: &'a mut u64,
}

impl Faces<'_> {
    /// Changes the state of a pair if it is due; returns the energy that was released [J].
    pub(crate) fn change(&mut self, mut pair: Change, does_fail: bool) -> f64 {
        let state = pair.face.state;
        let fails = does_fail && pair.face.can_break;
        if state == LinkState::Far || (state == LinkState::Linked && !fails) {
            return 0.0;
        }
        let [i, j] = pair.ends.map(|end| end as usize);
        let mean = self.mean[i] + self.mean[j];
        let held = self.mean_sum[i] + self.mean_sum[j];
        let before = pair_work(pair.line, self.constants, held) + self.mean_work(&pair);
        match state {
            LinkState::Linked => self.fail(&mut pair, mean),
            LinkState::Adhering => self.adhere(&mut pair, mean),
            LinkState::Open => self.meet(&mut pair, mean),
            LinkState::Far => {}
        }
        before - pair_work(pair.line, self.constants, held) - self.mean_work(&pair)
    }

    /// What the mean stress of a changing pair's ends takes with it [J]: their energy as it will be when
    /// what faces released is in, by the number of linked faces, less half the work of the step of a
    /// linked pair, which the new stress does.
    fn mean_work(&self, pair: &Change) -> f64 {
        let constants = self.constants;
        let ends = pair.ends.map(|end| end as usize);
        let held = |end: usize| {
            let response = self.response[end];
            mean_energy(constants, self.mean_sum[end] + response * self.released[end], response)
        };
        let mean = ends.iter().map(|end| self.mean_sum[*end]).sum::<f64>();
        let half = 0.25 * constants.coupling * mean * pair.line.strain[0];
        ends.into_iter().map(held).sum::<f64>()
            - pair.line.live * half * constants.face * constants.diameter
    }

    /// A link fails. Under a tension that adhesion bears, its faces stay in touch and slip; it fails anew
    /// in the next step if the stresses that are left are too much for it.
    fn fail(&mut self, pair: &mut Change, mean: f64) {
        let Self { constants, .. } = self;
        pair.face.breaks += 1;
        *self.failures += 1;
        pair.line.stress[1] = 0.0;
        let stress = pair.line.stress[0];
        if stress <= constants.adhesion {
            return;
        }
        let own = stress - 0.5 * constants.coupling * mean;
        pair.face.contact = pair.line.distance - constants.diameter * own / constants.twice_shear;
        pair.line.live = 0.0;
        let adheres = stress - constants.adhesion <= range_stress(constants);
        let kept = if adheres { constants.adhesion } else { 0.0 };
        pair.face.state = if adheres { LinkState::Adhering } else { LinkState::Open };
        pair.line.stress[0] = kept;
        self.release(pair.ends, stress - kept);
        for end in pair.ends {
            self.count_face(end, self.linked[end as usize] - 1);
        }
    }

    /// Adhering faces open beyond the range, and weld when they touch.
    fn adhere(&mut self, pair: &mut Change, mean: f64) {
        let adhesion = self.constants.adhesion;
        let apart = self.touching_stress(pair, mean) - adhesion;
        if apart <= 0.0 {
            self.weld(pair, apart + adhesion);
        } else if apart > range_stress(self.constants) {
            pair.face.state = LinkState::Open;
            pair.line.stress[0] = 0.0;
            self.release(pair.ends, adhesion);
        }
    }

    /// Open faces that come within the range are drawn together: into touch, where adhesion is
    /// stronger than the faces are stiff over its range.
    fn meet(&mut self, pair: &mut Change, mean: f64) {
        let adhesion = self.constants.adhesion;
        let stress = self.touching_stress(pair, mean);
        let range = range_stress(self.constants);
        if stress > range {
            return;
        }
        if adhesion > range || stress <= 0.0 {
            self.weld(pair, stress);
        } else {
            pair.face.state = LinkState::Adhering;
            pair.line.stress[0] = adhesion;
            self.release(pair.ends, -adhesion);
        }
    }

    /// Faces in touch are one: a link that bears `stress` [Pa].
    fn weld(&mut self, pair: &mut Change, stress: f64) {
        *self.welds += 1;
        self.release(pair.ends, pair.line.stress[0] - stress);
        pair.face.state = LinkState::Linked;
        pair.line.live = 1.0;
        pair.line.stress = [stress, 0.0];
        for end in pair.ends {
            self.count_face(end, self.linked[end as usize] + 1);
        }
    }

    /// Stress that the pair would bear if its faces just touched, pv [Pa].
    fn touching_stress(&self, pair: &Change, mean: f64) -> f64 {
        let Self { constants, .. } = self;
        let strain = (pair.line.distance - pair.face.contact) / constants.diameter;
        constants.twice_shear * strain + 0.5 * constants.coupling * mean
    }

    /// Faces give by the strain s / (2 G) when the traction `drop` [Pa] leaves them at fixed
    /// centres; the next mean stress takes it in.
    fn release(&mut self, ends: [u32; 2], drop: f64) {
        for end in ends {
            self.released[end as usize] -= drop / self.constants.twice_shear;
        }
    }

    fn count_face(&mut self, end: u32, linked: u32) {
        self.linked[end as usize] = linked;
        self.response[end as usize] = self.constants.response_of(linked);
    }
}

/// Stress that closes the range of adhesion, 2 G delta / d [Pa].
fn range_stress(constants: &Constants) -> f64 {
    constants.twice_shear * constants.adhesion_range / constants.diameter
}

/// What the faces of a linked pair hold [J]; `mean` is the sum of both ends' `mean_sum` [Pa].
pub(crate) fn pair_energy(line: &Line, constants: &Constants, mean: f64) -> f64 {
    let [normal, across] = line.stress;
    let own = normal - 0.5 * constants.coupling * mean;
    let square = line.live * (own * own + across * across);
    constants.face * constants.diameter * square / (2.0 * constants.twice_shear)
}

/// What the mean stress of an element of `response` [Pa] holds beside its pairs [J],
/// 1/2 A mean^2 / (3 c_N) of its volume; `mean` is its `mean_sum` [Pa].
pub(crate) fn mean_energy(constants: &Constants, mean: f64, response: f64) -> f64 {
    0.5 * constants.coupling * mean * mean / (3.0 * response) * constants.volume
}

/// What a pair that changes takes with it [J]: the energy from before the step, and the work of the
/// step, half of which the old stress did while the new one does the other half.
fn pair_work(line: &Line, constants: &Constants, mean: f64) -> f64 {
    let [normal, across] = line.stress;
    let own = normal - 0.5 * constants.coupling * mean;
    let old_own = own - constants.twice_shear * line.strain[0];
    let old_across = across - constants.twice_shear * line.strain[1];
    let product = line.live * (own * old_own + across * old_across);
    constants.face * constants.diameter * product / (2.0 * constants.twice_shear)
}

/// Counts the linked faces of all elements.
pub(crate) fn count_links(elements: &mut Elements, pairs: &Pairs, constants: &Constants) {
    elements.linked.fill(0);
    for (at, _) in pairs.linked() {
        for end in pairs.ends.of(at) {
            elements.linked[end as usize] += 1;
        }
    }
    for (response, linked) in elements.response.iter_mut().zip(&elements.linked) {
        *response = constants.response_of(*linked);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assembly::{Assembly, Element};
    use crate::solid::Solid;

    /// Fails for a count that begins anew at 256: the middle would have no linked face.
    #[test]
    fn an_element_may_have_hundreds_of_links() {
        let place = |at: usize| if at == 0 { [0.0; 2] } else { [1.0, at as f64] };
        let elements =
            (0..=256).map(|at| Element { position: place(at), ..Element::default() }).collect();
        let mut star = Assembly { diameter: 1.0, period: None, elements, links: Vec::new() };
        star.link_within(1e3, |i, _| i == 0);
        let constants = Constants::new(&Solid::default(), 1.0);
        let mut elements = Elements::new(&star, &constants, 1.0);
        let pairs = Pairs::new(&star, &elements);
        count_links(&mut elements, &pairs, &constants);
        assert_eq!(elements.response[0], constants.response[6]);
        assert_eq!(elements.response[1], constants.response[1]);
    }
}
