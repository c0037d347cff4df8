//! What became of the asperities: figures from what moved and what parted, and a label from the figures.
//!
//! The thresholds are the same for every case. What the paper tells by eye is told here by the volume that
//! was ground or cut into small pieces, and by the largest piece that was torn off.

use crate::asperities::{Part, Place};
use crate::components::Components;
use crate::pairs::Pair;

/// Pieces of up to this share of an asperity are small [-]; so are those of three elements.
const SMALL: f64 = 0.02;
/// Share of the asperities in small pieces from which on they are ground [-].
const GROUND: f64 = 0.20;
/// Small pieces that moved per element of the facets from which on they are ground [-].
const GROUND_PIECES: f64 = 3.0;
/// Share of an asperity from which on a piece that was torn off is a cleavage, and a breakaway [-].
const CLEAVED: f64 = 0.05;
const BROKEN_AWAY: f64 = 0.15;
/// Elements that left their body by this many diameters have moved [-].
pub(crate) const MOVED: f64 = 2.0;
/// Linked elements are beside each other up to this many diameters more than at the start [-].
const BESIDE: f64 = 0.2;

/// What became of the asperities, in the paper's words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// They never touched, so that nothing is told of what they would have come to.
    NoContact,
    /// They slipped past each other.
    Slipping,
    /// Their facing layers were ground into small pieces.
    Grinding,
    /// A piece of 5 to 15 % of an asperity split off.
    Cleavage,
    /// A piece of 15 % or more was torn off.
    Breakaway,
    /// Grinding and cleavage.
    GrindingAndCleavage,
    /// Grinding and breakaway.
    GrindingAndBreakaway,
}

impl Mode {
    /// Its name, in the words of the paper where it has one.
    pub fn name(self) -> &'static str {
        match self {
            Self::NoContact => "no contact",
            Self::Slipping => "slipping",
            Self::Grinding => "grinding",
            Self::Cleavage => "cleavage",
            Self::Breakaway => "breakaway",
            Self::GrindingAndCleavage => "grinding + cleavage",
            Self::GrindingAndBreakaway => "grinding + breakaway",
        }
    }
}

/// What the label goes by, and more. Shares are of the elements of both asperities where nothing else is
/// said.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figures {
    /// Elements in small pieces of what was never parted, ground or cut by healed slip, over those of both
    /// asperities; pieces that came off a base count, so that it can exceed 1 [-].
    pub ground: f64,
    /// Largest piece that moved as a whole, as a share of one asperity [-].
    pub largest_piece: f64,
    /// Small pieces that moved, of any size, per element of the two facets [-].
    pub small_pieces: f64,
    /// Share that left its body by two diameters: the volume worn [-].
    pub worn: f64,
    /// Share that moves with the other body at the end [-].
    pub transferred: f64,
    /// Share that moves with neither [-].
    pub debris: f64,
    /// Share of the links of the start that failed once or more [-].
    pub failed: f64,
    /// Share of them whose ends lie apart at the end [-].
    pub parted: f64,
    /// Whether links lead from the rigid row of one body to that of the other at the end.
    pub are_joined: bool,
    /// Whether any faces became a link or any link failed on the way: else the bodies did not touch.
    pub have_touched: bool,
}

impl Figures {
    /// Whether the asperities were ground.
    pub fn is_ground(&self) -> bool {
        self.have_touched && (self.ground >= GROUND || self.small_pieces >= GROUND_PIECES)
    }

    /// Whether a large piece came off.
    pub fn is_split(&self) -> bool {
        self.have_touched && self.largest_piece >= CLEAVED
    }

    /// The label.
    pub fn mode(&self) -> Mode {
        if !self.have_touched {
            return Mode::NoContact;
        }
        let is_large = self.largest_piece >= BROKEN_AWAY;
        match (self.is_ground(), self.is_split()) {
            (false, false) => Mode::Slipping,
            (true, false) => Mode::Grinding,
            (false, true) if is_large => Mode::Breakaway,
            (false, true) => Mode::Cleavage,
            (true, true) if is_large => Mode::GrindingAndBreakaway,
            (true, true) => Mode::GrindingAndCleavage,
        }
    }
}

/// What the figures are taken from.
pub(crate) struct State<'a> {
    pub(crate) parts: &'a [Part],
    pub(crate) pairs: &'a [Pair],
    pub(crate) diameter: f64,
    /// Length after which everything repeats along x, and positions at the start [m].
    pub(crate) period: f64,
    pub(crate) start: &'a [[f64; 2]],
    /// Elements of a facet.
    pub(crate) facet: f64,
    /// How far each element left its body [m].
    pub(crate) left: &'a [f64],
    /// Velocity along x at the end over that of the lower body [-].
    pub(crate) pace: &'a [f64],
    pub(crate) have_touched: bool,
}

impl State<'_> {
    /// Whether the ends of a pair that was linked at the start are about as near as then: the links of
    /// a body are not all a diameter long.
    fn are_beside(&self, pair: &Pair) -> bool {
        let [i, j] = pair.ends.map(|end| self.start[end as usize]);
        let dx = j[0] - i[0];
        let dx = dx - self.period * (dx / self.period).round();
        pair.distance <= dx.hypot(j[1] - i[1]) + BESIDE * self.diameter
    }
}

/// The figures of a state.
pub(crate) fn figures(state: &State) -> Figures {
    let is_asperity = |at: usize| state.parts[at].place == Place::Asperity;
    let count = (0..state.parts.len()).filter(|at| is_asperity(*at)).count().max(2);
    let small = (SMALL * 0.5 * count as f64).floor().max(3.0) as usize;
    let moved: Vec<bool> = state.left.iter().map(|left| *left > MOVED * state.diameter).collect();
    let original = || state.pairs.iter().filter(|pair| pair.is_original);
    let share = |number: usize| number as f64 / count as f64;
    let of = |what: &dyn Fn(usize) -> bool| {
        share((0..state.parts.len()).filter(|at| is_asperity(*at) && what(*at)).count())
    };
    // Lower bodies go at 1, upper ones at -1.
    let own = |at: usize| if state.parts[at].is_upper { -state.pace[at] } else { state.pace[at] };
    let (largest, small_pieces) = pieces(state, &moved, small);
    let apart = |pair: &&Pair| !state.are_beside(pair);
    let links = original().count().max(1) as f64;
    Figures {
        ground: share(ground(state, small)),
        largest_piece: largest as f64 / (0.5 * count as f64),
        small_pieces: small_pieces as f64 / (2.0 * state.facet),
        worn: of(&|at| moved[at]),
        transferred: of(&|at| own(at) < -0.5),
        debris: of(&|at| own(at).abs() < 0.5),
        failed: original().filter(|pair| pair.breaks > 0).count() as f64 / links,
        parted: original().filter(apart).count() as f64 / links,
        are_joined: are_joined(state),
        have_touched: state.have_touched,
    }
}

/// Number of elements in small pieces of links that never failed, of bases too, but not those that hold a part of
/// a rigid row.
fn ground(state: &State, small: usize) -> usize {
    let mut pieces = Components::new(state.parts.len());
    for pair in state.pairs.iter().filter(|pair| pair.is_original && pair.breaks == 0) {
        pieces.join(pair.ends);
    }
    let mut is_base = vec![false; state.parts.len()];
    for at in (0..state.parts.len()).filter(|at| state.parts[*at].place == Place::Rigid) {
        is_base[pieces.root(at)] = true;
    }
    let is_ground = |at: &usize| {
        let root = pieces.root(*at);
        !is_base[root] && pieces.size(root) <= small
    };
    (0..state.parts.len()).filter(is_ground).count()
}

/// Elements of the largest piece of what moved, and the number of small ones.
fn pieces(state: &State, moved: &[bool], small: usize) -> (usize, usize) {
    let mut pieces = Components::new(state.parts.len());
    let beside = |pair: &&Pair| {
        let [i, j] = pair.ends.map(|end| moved[end as usize]);
        pair.is_original && i && j && state.are_beside(pair)
    };
    for pair in state.pairs.iter().filter(beside) {
        pieces.join(pair.ends);
    }
    let roots: Vec<usize> =
        (0..moved.len()).filter(|at| moved[*at] && pieces.root(*at) == *at).collect();
    let sizes = || roots.iter().map(|root| pieces.size(*root));
    (sizes().max().unwrap_or(0), sizes().filter(|size| *size <= small).count())
}

/// Whether links lead from one rigid row to the other.
fn are_joined(state: &State) -> bool {
    let mut pieces = Components::new(state.parts.len());
    for pair in state.pairs.iter().filter(|pair| pair.state == crate::LinkState::Linked) {
        pieces.join(pair.ends);
    }
    let mut of_lower = vec![false; state.parts.len()];
    let rigid = |is_upper: bool| {
        let part = Part { is_upper, place: Place::Rigid };
        (0..state.parts.len()).filter(move |at| state.parts[*at] == part)
    };
    for at in rigid(false) {
        of_lower[pieces.root(at)] = true;
    }
    rigid(true).any(|at| of_lower[pieces.root(at)])
}
