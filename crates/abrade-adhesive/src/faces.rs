//! What becomes of the faces of a pair: a link fails, parted faces adhere, open, and weld when they meet.
//!
//! Faces deform: what counts as a gap is the distance left when the faces are drawn by the stress they
//! bear. With pv, the stress that the pair would bear if its faces just touched, the gap under the
//! traction s is g(s) = d (pv - s) / (2 G).

use crate::elements::Elements;
use crate::pairs::{LinkState, Pairs};
use crate::solid::Constants;

/// Changes the state of a pair if it is due; returns the energy that was released [J].
pub(crate) fn change(
    elements: &mut Elements,
    pairs: &mut Pairs,
    constants: &Constants,
    at: usize,
    does_fail: bool,
) -> f64 {
    if pairs.state[at] == LinkState::Far || (pairs.state[at] == LinkState::Linked && !does_fail) {
        return 0.0;
    }
    let ends = pairs.ends.of(at).map(|end| end as usize);
    let mean = elements.mean[ends[0]] + elements.mean[ends[1]];
    let held = elements.mean_sum[ends[0]] + elements.mean_sum[ends[1]];
    let before = pair_work(pairs, constants, at, held) + mean_work(elements, pairs, constants, at);
    match pairs.state[at] {
        LinkState::Linked => fail(elements, pairs, constants, (at, ends), mean),
        LinkState::Adhering => adhere(elements, pairs, constants, (at, ends), mean),
        LinkState::Open => meet(elements, pairs, constants, (at, ends), mean),
        LinkState::Far => {}
    }
    before - pair_work(pairs, constants, at, held) - mean_work(elements, pairs, constants, at)
}

/// What the faces of a linked pair hold [J]; `mean` is the sum of both ends' `mean_sum` [Pa].
pub(crate) fn pair_energy(pairs: &Pairs, constants: &Constants, at: usize, mean: f64) -> f64 {
    let own = pairs.normal[at] - 0.5 * constants.coupling * mean;
    let across = pairs.tangential[at];
    let square = pairs.live[at] * (own * own + across * across);
    constants.face * constants.diameter * square / (2.0 * constants.twice_shear)
}

/// What a pair that changes takes with it [J]: the energy from before the step, and the work of the step,
/// half of which the old stress did while the new one does the other half.
fn pair_work(pairs: &Pairs, constants: &Constants, at: usize, mean: f64) -> f64 {
    let own = pairs.normal[at] - 0.5 * constants.coupling * mean;
    let across = pairs.tangential[at];
    let old_own = own - constants.twice_shear * pairs.stretch[at];
    let old_across = across - constants.twice_shear * pairs.shear[at];
    let product = pairs.live[at] * (own * old_own + across * old_across);
    constants.face * constants.diameter * product / (2.0 * constants.twice_shear)
}

/// What the mean stress of a changing pair's ends takes with it [J]: their energy as it will be when what
/// faces released is in, by the number of linked faces, less half the work of the step of a linked pair,
/// which the new stress does.
fn mean_work(elements: &Elements, pairs: &Pairs, constants: &Constants, at: usize) -> f64 {
    let ends = pairs.ends.of(at).map(|end| end as usize);
    let held = |end: usize| {
        let response = elements.response[end];
        mean_energy(constants, elements.mean_sum[end] + response * elements.released[end], response)
    };
    let mean = ends.iter().map(|end| elements.mean_sum[*end]).sum::<f64>();
    let half = 0.25 * constants.coupling * mean * pairs.stretch[at];
    ends.into_iter().map(held).sum::<f64>()
        - pairs.live[at] * half * constants.face * constants.diameter
}

/// What the mean stress of an element of `response` [Pa] holds beside its pairs [J],
/// 1/2 A mean^2 / (3 c_N) of its volume; `mean` is its `mean_sum` [Pa].
pub(crate) fn mean_energy(constants: &Constants, mean: f64, response: f64) -> f64 {
    0.5 * constants.coupling * mean * mean / (3.0 * response) * constants.volume
}

/// Stress that the pair would bear if its faces just touched, pv [Pa].
fn touching_stress(pairs: &Pairs, constants: &Constants, at: usize, mean: f64) -> f64 {
    let strain = (pairs.distance[at] - pairs.contact[at]) / constants.diameter;
    constants.twice_shear * strain + 0.5 * constants.coupling * mean
}

/// Stress that closes the range of adhesion, 2 G delta / d [Pa].
fn range_stress(constants: &Constants) -> f64 {
    constants.twice_shear * constants.adhesion_range / constants.diameter
}

/// A link fails. Under a tension that adhesion bears, its faces stay in touch and slip; it fails anew in
/// the next step if the stresses that are left are too much for it.
fn fail(
    elements: &mut Elements,
    pairs: &mut Pairs,
    constants: &Constants,
    (at, ends): (usize, [usize; 2]),
    mean: f64,
) {
    pairs.breaks[at] += 1;
    pairs.failures += 1;
    pairs.tangential[at] = 0.0;
    let stress = pairs.normal[at];
    if stress <= constants.adhesion {
        return;
    }
    let own = stress - 0.5 * constants.coupling * mean;
    pairs.contact[at] = pairs.distance[at] - constants.diameter * own / constants.twice_shear;
    pairs.live[at] = 0.0;
    let adheres = stress - constants.adhesion <= range_stress(constants);
    let kept = if adheres { constants.adhesion } else { 0.0 };
    pairs.state[at] = if adheres { LinkState::Adhering } else { LinkState::Open };
    pairs.normal[at] = kept;
    release(elements, constants, ends, stress - kept);
    for end in ends {
        elements.count_face(end, elements.linked[end] - 1, constants);
    }
}

/// Adhering faces open beyond the range, and weld when they touch.
fn adhere(
    elements: &mut Elements,
    pairs: &mut Pairs,
    constants: &Constants,
    (at, ends): (usize, [usize; 2]),
    mean: f64,
) {
    let apart = touching_stress(pairs, constants, at, mean) - constants.adhesion;
    if apart <= 0.0 {
        weld(elements, pairs, constants, (at, ends), apart + constants.adhesion);
    } else if apart > range_stress(constants) {
        pairs.state[at] = LinkState::Open;
        pairs.normal[at] = 0.0;
        release(elements, constants, ends, constants.adhesion);
    }
}

/// Open faces that come within the range are drawn together: into touch, where adhesion is stronger
/// than the faces are stiff over its range.
fn meet(
    elements: &mut Elements,
    pairs: &mut Pairs,
    constants: &Constants,
    (at, ends): (usize, [usize; 2]),
    mean: f64,
) {
    let stress = touching_stress(pairs, constants, at, mean);
    let range = range_stress(constants);
    if stress > range {
        return;
    }
    if constants.adhesion > range || stress <= 0.0 {
        weld(elements, pairs, constants, (at, ends), stress);
    } else {
        pairs.state[at] = LinkState::Adhering;
        pairs.normal[at] = constants.adhesion;
        release(elements, constants, ends, -constants.adhesion);
    }
}

/// Faces in touch are one: a link that bears `stress` [Pa].
fn weld(
    elements: &mut Elements,
    pairs: &mut Pairs,
    constants: &Constants,
    (at, ends): (usize, [usize; 2]),
    stress: f64,
) {
    release(elements, constants, ends, pairs.normal[at] - stress);
    pairs.state[at] = LinkState::Linked;
    pairs.live[at] = 1.0;
    pairs.normal[at] = stress;
    pairs.tangential[at] = 0.0;
    for end in ends {
        elements.count_face(end, elements.linked[end] + 1, constants);
    }
}

/// Faces give by the strain s / (2 G) when the traction `drop` [Pa] leaves them at fixed centres; the next
/// mean stress takes it in.
fn release(elements: &mut Elements, constants: &Constants, ends: [usize; 2], drop: f64) {
    for end in ends {
        elements.released[end] -= drop / constants.twice_shear;
    }
}

/// Counts the linked faces of all elements.
pub(crate) fn count_links(elements: &mut Elements, pairs: &Pairs, constants: &Constants) {
    let mut linked = vec![0u32; elements.x.len()];
    for at in (0..pairs.len()).filter(|at| pairs.state[*at] == LinkState::Linked) {
        for end in pairs.ends.of(at) {
            linked[end as usize] += 1;
        }
    }
    for (at, linked) in linked.into_iter().enumerate() {
        elements.count_face(at, linked, constants);
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
        let pairs = Pairs::new(&star, &elements, constants.strength);
        count_links(&mut elements, &pairs, &constants);
        assert_eq!(elements.response[0], constants.response[6]);
        assert_eq!(elements.response[1], constants.response[1]);
    }
}
