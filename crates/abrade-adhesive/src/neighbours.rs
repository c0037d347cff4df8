//! Which elements may meet: pairs within a cut are listed, and listed anew before anything can have come
//! from beyond it.

use crate::elements::Elements;
use crate::grid::Grid;
use crate::pairs::{LinkState, Met, Pairs};

/// How far beyond the distance at which its faces touch a pair is listed, in diameters: faces that bear
/// stress meet within 0.05 of it, the rest is for motion.
const REACH: f64 = 0.4;
/// The same for elements that were never linked, whose faces touch at a diameter.
const CUT: f64 = 1.0 + REACH;
/// Room for motion until the next list, in diameters.
pub(crate) const ROOM: f64 = 0.35;
/// Faces that are no further apart than this, in diameters, are in the list at any time.
pub(crate) const SURE: f64 = REACH - ROOM;

/// The list's own memory.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Neighbours {
    period: Option<f64>,
    diameter: f64,
    grid: Grid,
    /// Second ends of the original pairs of each element, from `starts` on.
    starts: Vec<usize>,
    partners: Vec<u32>,
    /// Positions at the last list.
    positions: Vec<[f64; 2]>,
    /// Room for the pairs that met, while they are listed anew, and for those of one element.
    met: Vec<Met>,
    near: Vec<u32>,
}

impl Neighbours {
    pub(crate) fn new(
        elements: &Elements,
        pairs: &Pairs,
        diameter: f64,
        period: Option<f64>,
    ) -> Self {
        let mut original: Vec<[u32; 2]> = (0..pairs.original)
            .filter(|at| pairs.faces[*at].state == LinkState::Linked)
            .map(|at| pairs.ends.of(at))
            .collect();
        original.sort_unstable();
        let starts = (0..=elements.count as u32)
            .map(|i| original.partition_point(|ends| ends[0] < i))
            .collect();
        let partners = original.iter().map(|ends| ends[1]).collect();
        let positions: Vec<[f64; 2]> =
            (0..elements.count).map(|at| [elements.x[at], elements.y[at]]).collect();
        let grid = Grid::new(&positions, period, CUT * diameter);
        let (met, near) = (Vec::new(), Vec::new());
        Self { period, diameter, grid, starts, partners, positions, met, near }
    }

    /// The furthest that an element has come since the last list [m].
    pub(crate) fn moved(&self, elements: &Elements) -> f64 {
        let square = |at: usize| {
            let [x, y] = self.positions[at];
            let (dx, dy) = (elements.x[at] - x, elements.y[at] - y);
            dx * dx + dy * dy
        };
        (0..elements.count).map(square).fold(0.0, f64::max).sqrt()
    }

    /// Lists the pairs anew: original ones are near or far, others come and go. What is linked stays.
    pub(crate) fn list(&mut self, elements: &Elements, pairs: &mut Pairs) {
        self.judge_original(elements, pairs);
        self.met.clear();
        self.met.extend((pairs.original..pairs.len()).map(|at| pairs.met(at)));
        pairs.take_off_met();
        for (at, position) in self.positions.iter_mut().enumerate() {
            *position = [elements.x[at], elements.y[at]];
        }
        self.grid.renew(&self.positions);
        let mut begun = 0;
        for i in 0..elements.count {
            let of_i = self.met[begun..].iter().take_while(|met| met.ends[0] as usize <= i).count();
            self.find_near(i, begun..begun + of_i);
            for j in &self.near {
                let ends = [i as u32, *j];
                pairs.push_loose(self.diameter, elements, ends, self.period);
                let own = self.met[begun..begun + of_i].iter().find(|met| met.ends == ends);
                if let Some(met) = own {
                    pairs.restore_last(met);
                }
            }
            begun += of_i;
        }
        pairs.pad(self.diameter, elements);
    }

    /// Original pairs are far where their faces cannot meet before the next list. A far one may meet at
    /// another image of its end than it parted from: it is measured to the nearest.
    fn judge_original(&self, elements: &Elements, pairs: &mut Pairs) {
        for at in 0..pairs.original {
            // Not a pair of ghosts.
            let is_pair = (pairs.ends.of(at)[0] as usize) < self.positions.len();
            if pairs.faces[at].state == LinkState::Far && is_pair {
                pairs.measure(at, elements, self.period);
            }
            let distance = pairs.line(at).distance;
            let face = &mut pairs.faces[at];
            let is_near = distance <= face.contact + REACH * self.diameter;
            match face.state {
                LinkState::Open if !is_near => face.state = LinkState::Far,
                LinkState::Far if is_near && is_pair => face.state = LinkState::Open,
                _ => {}
            }
        }
    }

    /// Second ends of the pairs that element `i` begins and that were not linked at the start, in order.
    fn find_near(&mut self, i: usize, of_i: std::ops::Range<usize>) {
        let partners = &self.partners[self.starts[i]..self.starts[i + 1]];
        let near = &mut self.near;
        near.clear();
        self.grid.each_later(i, self.positions[i], |j| {
            if !partners.contains(&(j as u32)) {
                near.push(j as u32);
            }
        });
        let holds = |met: &&Met| matches!(met.face.state, LinkState::Linked | LinkState::Adhering);
        near.extend(self.met[of_i].iter().filter(holds).map(|met| met.ends[1]));
        near.sort_unstable();
        near.dedup();
    }
}
