//! Pairs of elements, in blocks of four: first blocks whose ends follow each other in the
//! columns of elements, then loose pairs. Pairs that were linked at the start keep their places; those
//! that met later stand behind them and are listed anew from time to time.

use crate::assembly::{Assembly, Link};
use crate::block::{Block, Line};
use crate::elements::Elements;
use crate::four::LANES;
use crate::lanes::{AllEnds, Loose, Run};

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
    /// In how many steps its link failed.
    pub breaks: u32,
    /// Whether it was linked at the start.
    pub is_original: bool,
}

/// What of a pair its faces need when they change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Face {
    pub(crate) state: LinkState,
    /// Whether a link may fail.
    pub(crate) can_break: bool,
    /// In how many steps the link failed.
    pub(crate) breaks: u32,
    /// Distance at which the faces would just touch without stress [m].
    pub(crate) contact: f64,
}

/// A pair that met, while pairs are listed anew.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Met {
    pub(crate) ends: [u32; 2],
    pub(crate) face: Face,
    line: Line,
}

/// All pairs.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Pairs {
    pub(crate) ends: AllEnds,
    /// Pairs before this one, loose or not, were linked at the start.
    pub(crate) original: usize,
    /// What every step takes of them, by fours, and what changes take.
    pub(crate) blocks: Vec<Block>,
    pub(crate) faces: Vec<Face>,
    /// In how many steps links failed, of all pairs together, with those that are no longer listed.
    pub(crate) failures: u64,
    /// How often faces became a link, of all pairs together.
    pub(crate) welds: u64,
}

impl Pairs {
    /// The links of an assembly between `elements`.
    pub(crate) fn new(assembly: &Assembly, elements: &Elements) -> Self {
        let (diameter, period) = (assembly.diameter, assembly.period);
        let (runs, loose) = runs(&links(assembly));
        let mut pairs = Self {
            ends: AllEnds {
                runs: runs.iter().map(|run| Run(run[0].ends)).collect(),
                loose: Vec::new(),
            },
            original: 0,
            blocks: Vec::new(),
            faces: Vec::new(),
            failures: 0,
            welds: 0,
        };
        for link in runs.iter().flatten() {
            pairs.push(diameter, elements, link.ends, period);
            pairs.link_last(link.can_break);
        }
        for link in &loose {
            pairs.push_loose(diameter, elements, link.ends, period);
            pairs.link_last(link.can_break);
        }
        pairs.pad(diameter, elements);
        pairs.original = pairs.len();
        pairs
    }

    pub(crate) fn len(&self) -> usize {
        self.faces.len()
    }

    /// What every step takes of pair `at`.
    pub(crate) fn line(&self, at: usize) -> Line {
        self.blocks[at / LANES].line(at % LANES)
    }

    /// The linked pairs, each with its place.
    pub(crate) fn linked(&self) -> impl Iterator<Item = (usize, Line)> {
        let is_linked = |at: &usize| self.faces[*at].state == LinkState::Linked;
        (0..self.len()).filter(is_linked).map(|at| (at, self.line(at)))
    }

    /// Adds a loose pair, which is open, with faces that would touch at `contact` [m].
    pub(crate) fn push_loose(
        &mut self,
        contact: f64,
        elements: &Elements,
        ends: [u32; 2],
        period: Option<f64>,
    ) {
        let lane = self.len() % LANES;
        if lane == 0 {
            self.ends.loose.push(Loose([[0; LANES]; 2]));
        }
        let Loose([first, second]) = self.ends.loose.last_mut().expect("a block with room");
        [first[lane], second[lane]] = ends;
        self.push(contact, elements, ends, period);
    }

    /// Fills the last block with pairs of ghosts.
    pub(crate) fn pad(&mut self, diameter: f64, elements: &Elements) {
        while !self.len().is_multiple_of(LANES) {
            self.push_loose(diameter, elements, elements.ghosts(), None);
            self.last_face().state = LinkState::Far;
        }
    }

    /// What pair `at` keeps while pairs are listed anew.
    pub(crate) fn met(&self, at: usize) -> Met {
        Met { ends: self.ends.of(at), face: self.faces[at], line: self.line(at) }
    }

    /// Gives the last pair what it kept.
    pub(crate) fn restore_last(&mut self, met: &Met) {
        *self.last_face() = met.face;
        let lane = (self.len() - 1) % LANES;
        self.last_block().put(lane, &met.line);
    }

    /// Measures pair `at` anew to the nearest image of its second end, if that is another than before.
    pub(crate) fn measure(&mut self, at: usize, elements: &Elements, period: Option<f64>) {
        let found = Line::new(elements, self.ends.of(at), period);
        let Line { direction, distance, image, .. } = found;
        let line = self.line(at);
        if image != line.image {
            self.blocks[at / LANES].put(at % LANES, &Line { direction, distance, image, ..line });
        }
    }

    /// Takes off all pairs that were not linked at the start.
    pub(crate) fn take_off_met(&mut self) {
        let blocks = self.original / LANES;
        self.ends.loose.truncate(blocks - self.ends.runs.len());
        self.blocks.truncate(blocks);
        self.faces.truncate(self.original);
    }

    fn push(&mut self, contact: f64, elements: &Elements, ends: [u32; 2], period: Option<f64>) {
        let lane = self.len() % LANES;
        if lane == 0 {
            self.blocks.push(Block::EMPTY);
        }
        self.last_block().put(lane, &Line::new(elements, ends, period));
        self.faces.push(Face { state: LinkState::Open, can_break: true, breaks: 0, contact });
    }

    fn link_last(&mut self, can_break: bool) {
        let lane = (self.len() - 1) % LANES;
        self.last_block().live.0[lane] = 1.0;
        let face = self.last_face();
        (face.state, face.can_break) = (LinkState::Linked, can_break);
    }

    fn last_block(&mut self) -> &mut Block {
        self.blocks.last_mut().expect("a pair")
    }

    fn last_face(&mut self) -> &mut Face {
        self.faces.last_mut().expect("a pair")
    }
}

/// A link at the start.
#[derive(Clone, Copy)]
struct Ended {
    ends: [u32; 2],
    can_break: bool,
}

/// The links of an assembly, each once, by the distance of their ends' indices, then by the first
/// end.
fn links(assembly: &Assembly) -> Vec<Ended> {
    let ended = |link: &Link| {
        let [i, j] = link.ends;
        Ended { ends: [i.min(j), i.max(j)], can_break: link.can_break }
    };
    let mut links: Vec<Ended> = assembly.links.iter().map(ended).collect();
    links.sort_unstable_by_key(|Ended { ends: [i, j], .. }| (j - i, *i));
    links.dedup_by_key(|link| link.ends);
    links
}

/// Blocks of links whose ends follow each other, and the links left over, each in the order of the
/// elements.
fn runs(links: &[Ended]) -> (Vec<[Ended; LANES]>, Vec<Ended>) {
    let follows = |a: &Ended, b: &Ended| b.ends == a.ends.map(|end| end + 1);
    let mut stretches: Vec<&[Ended]> = links.chunk_by(follows).collect();
    stretches.sort_by_key(|stretch| stretch[0].ends);
    let (mut runs, mut loose) = (Vec::new(), Vec::new());
    for stretch in stretches {
        let (whole, rest) = stretch.as_chunks::<LANES>();
        runs.extend_from_slice(whole);
        loose.extend_from_slice(rest);
    }
    (runs, loose)
}
