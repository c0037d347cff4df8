//! Pairs of elements as columns, in blocks of four: first blocks whose ends follow each other in the
//! columns of elements, then loose pairs. Pairs that were linked at the start keep their places; those
//! that met later stand behind them and are listed anew from time to time.

use crate::assembly::Assembly;
use crate::elements::Elements;
use crate::lanes::{AllEnds, LANES, Run};

/// What holds a pair together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinkState {
    /// A link: normal and tangential stress.
    Linked,
    /// Parted faces within the range of adhesion, which draws them together.
    Adhering,
    /// Parted faces that may meet.
    Open,
    /// Too far apart to meet.
    Far,
}

/// A pair as it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// Indices of the elements.
    pub ends: [u32; 2],
    /// What holds it.
    pub state: LinkState,
    /// Distance of the centres [m].
    pub distance: f64,
    /// Normal stress, tension above zero, and tangential stress of the face [Pa].
    pub stress: [f64; 2],
    /// In how many steps its link failed; one that slips fails in each that asks more of it than it
    /// bears.
    pub breaks: u32,
    /// Whether it was linked at the start.
    pub is_original: bool,
}

/// What a pair that met keeps while pairs are listed anew.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Met {
    pub(crate) ends: [u32; 2],
    pub(crate) state: LinkState,
    direction: [f64; 2],
    distance: f64,
    image: f64,
    stress: [f64; 2],
    contact: f64,
    breaks: u32,
}

/// Columns of pairs.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Pairs {
    pub(crate) ends: AllEnds,
    /// Pairs before this one, loose or not, were linked at the start.
    pub(crate) original: usize,
    /// Unit vector from the first to the second end, their distance [m], and what periodicity adds to x [m].
    pub(crate) nx: Vec<f64>,
    pub(crate) ny: Vec<f64>,
    pub(crate) distance: Vec<f64>,
    pub(crate) image: Vec<f64>,
    /// Strain of this step along and across [-].
    pub(crate) stretch: Vec<f64>,
    pub(crate) shear: Vec<f64>,
    /// 1 while linked, else 0.
    pub(crate) live: Vec<f64>,
    /// Normal and tangential stress [Pa].
    pub(crate) normal: Vec<f64>,
    pub(crate) tangential: Vec<f64>,
    /// Compressive strength, infinite for links that hold [Pa].
    pub(crate) strength: Vec<f64>,
    pub(crate) state: Vec<LinkState>,
    /// Distance at which the faces would just touch without stress [m].
    pub(crate) contact: Vec<f64>,
    /// In how many steps the link failed.
    pub(crate) breaks: Vec<u32>,
    /// The same of all pairs, with those that are no longer listed.
    pub(crate) failures: u64,
    /// Compressive strength of a link that can break [Pa].
    breaking: f64,
}

impl Pairs {
    /// The links of an assembly between `elements`, with the strength `strength` [Pa] of those that can
    /// break.
    pub(crate) fn new(assembly: &Assembly, elements: &Elements, strength: f64) -> Self {
        let mut links: Vec<([u32; 2], bool)> = assembly
            .links
            .iter()
            .map(|link| {
                ([link.ends[0].min(link.ends[1]), link.ends[0].max(link.ends[1])], link.can_break)
            })
            .collect();
        links.sort_unstable_by_key(|([i, j], _)| (j - i, *i));
        links.dedup_by_key(|(ends, _)| *ends);
        let (runs, loose) = blocks(&links);
        let mut pairs = Self {
            ends: AllEnds {
                runs: runs.iter().map(|run| Run(run[0].0)).collect(),
                loose: [Vec::new(), Vec::new()],
            },
            original: 0,
            nx: Vec::new(),
            ny: Vec::new(),
            distance: Vec::new(),
            image: Vec::new(),
            stretch: Vec::new(),
            shear: Vec::new(),
            live: Vec::new(),
            normal: Vec::new(),
            tangential: Vec::new(),
            strength: Vec::new(),
            state: Vec::new(),
            contact: Vec::new(),
            breaks: Vec::new(),
            failures: 0,
            breaking: strength,
        };
        let diameter = assembly.diameter;
        for (ends, can_break) in runs.iter().flatten() {
            pairs.columns_push(diameter, elements, *ends, assembly.period);
            pairs.link_last(*can_break);
        }
        for (ends, can_break) in &loose {
            pairs.push_loose(diameter, elements, *ends, assembly.period);
            pairs.link_last(*can_break);
        }
        pairs.pad(diameter, elements);
        pairs.original = pairs.len();
        pairs
    }

    pub(crate) fn len(&self) -> usize {
        self.nx.len()
    }

    /// Adds a loose pair, which is open, with faces that would touch at `contact` [m].
    pub(crate) fn push_loose(
        &mut self,
        contact: f64,
        elements: &Elements,
        ends: [u32; 2],
        period: Option<f64>,
    ) {
        self.ends.loose[0].push(ends[0]);
        self.ends.loose[1].push(ends[1]);
        self.columns_push(contact, elements, ends, period);
    }

    /// Fills the last block with pairs of ghosts.
    pub(crate) fn pad(&mut self, diameter: f64, elements: &Elements) {
        while !self.len().is_multiple_of(LANES) {
            self.push_loose(diameter, elements, elements.ghosts(), None);
            let last = self.len() - 1;
            self.state[last] = LinkState::Far;
        }
    }

    /// What pair `at` keeps while pairs are listed anew.
    pub(crate) fn met(&self, at: usize) -> Met {
        Met {
            ends: self.ends.of(at),
            state: self.state[at],
            direction: [self.nx[at], self.ny[at]],
            distance: self.distance[at],
            image: self.image[at],
            stress: [self.normal[at], self.tangential[at]],
            contact: self.contact[at],
            breaks: self.breaks[at],
        }
    }

    /// Gives the last pair what it kept.
    pub(crate) fn restore_last(&mut self, met: &Met) {
        let last = self.len() - 1;
        self.state[last] = met.state;
        self.live[last] = if met.state == LinkState::Linked { 1.0 } else { 0.0 };
        [self.nx[last], self.ny[last]] = met.direction;
        self.distance[last] = met.distance;
        self.image[last] = met.image;
        [self.normal[last], self.tangential[last]] = met.stress;
        self.contact[last] = met.contact;
        self.breaks[last] = met.breaks;
    }

    /// Measures pair `at` anew to the nearest image of its second end, if that is another than before.
    pub(crate) fn measure(&mut self, at: usize, elements: &Elements, period: Option<f64>) {
        let between = Between::of(elements, self.ends.of(at), period);
        if between.image != self.image[at] {
            [self.nx[at], self.ny[at]] = between.direction;
            self.distance[at] = between.distance;
            self.image[at] = between.image;
        }
    }

    /// Takes off all pairs from `count` on.
    pub(crate) fn truncate(&mut self, count: usize) {
        let loose = count - self.ends.runs.len() * LANES;
        self.ends.loose.iter_mut().for_each(|ends| ends.truncate(loose));
        self.numbers().for_each(|column| column.truncate(count));
        self.state.truncate(count);
        self.breaks.truncate(count);
    }

    /// The columns of numbers.
    fn numbers(&mut self) -> impl Iterator<Item = &mut Vec<f64>> {
        [
            &mut self.nx,
            &mut self.ny,
            &mut self.distance,
            &mut self.image,
            &mut self.stretch,
            &mut self.shear,
            &mut self.live,
            &mut self.normal,
            &mut self.tangential,
            &mut self.strength,
            &mut self.contact,
        ]
        .into_iter()
    }

    fn columns_push(
        &mut self,
        contact: f64,
        elements: &Elements,
        ends: [u32; 2],
        period: Option<f64>,
    ) {
        let between = Between::of(elements, ends, period);
        self.numbers().for_each(|column| column.push(0.0));
        let last = self.len() - 1;
        [self.nx[last], self.ny[last]] = between.direction;
        self.distance[last] = between.distance;
        self.image[last] = between.image;
        self.strength[last] = self.breaking;
        self.contact[last] = contact;
        self.state.push(LinkState::Open);
        self.breaks.push(0);
    }

    fn link_last(&mut self, can_break: bool) {
        let last = self.len() - 1;
        self.state[last] = LinkState::Linked;
        self.live[last] = 1.0;
        if !can_break {
            self.strength[last] = f64::INFINITY;
        }
    }
}

/// The way from one element to the nearest image of another.
struct Between {
    direction: [f64; 2],
    distance: f64,
    image: f64,
}

impl Between {
    fn of(elements: &Elements, [i, j]: [u32; 2], period: Option<f64>) -> Self {
        let [i, j] = [i as usize, j as usize];
        let dx = elements.x[j] - elements.x[i];
        let image = period.map_or(0.0, |period| -period * (dx / period).round());
        let (dx, dy) = (dx + image, elements.y[j] - elements.y[i]);
        let distance = dx.hypot(dy);
        Self { direction: [dx / distance, dy / distance], distance, image }
    }
}

type Ended = ([u32; 2], bool);

/// Blocks of links whose ends follow each other, and the links left over, each in the order of the
/// elements. The links come sorted by the distance of their ends' indices, then by the first end.
fn blocks(links: &[Ended]) -> (Vec<[Ended; LANES]>, Vec<Ended>) {
    let follows = |a: &Ended, b: &Ended| b.0[0] == a.0[0] + 1 && b.0[1] == a.0[1] + 1;
    let mut stretches: Vec<&[Ended]> = links.chunk_by(follows).collect();
    stretches.sort_by_key(|stretch| stretch[0].0);
    let (mut runs, mut loose) = (Vec::new(), Vec::new());
    for stretch in stretches {
        let (whole, rest) = stretch.as_chunks::<LANES>();
        runs.extend_from_slice(whole);
        loose.extend_from_slice(rest);
    }
    (runs, loose)
}
