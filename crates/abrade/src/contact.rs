//! One body against one surface: by springs (the return mapping) or by columns (the swept rule).

use nalgebra::Point3;

use crate::body::{Body, State};
use crate::columns::Columns;
use crate::damping::{Damping, Dashpots};
use crate::encounter::{Placed, Skin};
use crate::error::PhysicsError;
use crate::laws::{ElasticLaw, FlowLaw, Lateral};
use crate::mutual::Mutual;
use crate::patch::Patch;
use crate::shape::{Piece, Shape};
use crate::surface::{Surface, SurfaceLaws};

/// Displacement of a body per step of the swept rule, in pitches and in yield overlaps.
const SWEEP_PITCH: f64 = 0.1;
const SWEEP_YIELD: f64 = 0.4;

/// Reach of a candidate list in displacements of the step, and its least value in pitches: small
/// for springs, which ask every candidate, larger for columns, which know when they are due, and for
/// two surfaces, whose lists are long in the making.
const LIST_STEPS: f64 = 8.0;
const LIST_PITCH: f64 = 0.05;
const SWEPT_PITCH: f64 = 2.0;
const MUTUAL_PITCH: f64 = 1.0;

/// How a body meets a surface.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub(crate) enum Contact {
    Springs(Box<Patch>),
    Columns(Box<Columns>),
    /// The body has a worn surface of its own.
    Mutual(Box<Mutual>),
}

impl Contact {
    /// Bodies with faces and laws without springs go by the swept rule; `HertzNodes` puts a ball
    /// on every node and so knows no faces.
    pub(crate) fn new(
        shape: &Shape,
        surface: &Surface,
        keeps_ledger: bool,
    ) -> Result<Self, PhysicsError> {
        let laws = &surface.laws;
        let rigid = laws.elastic == ElasticLaw::Rigid;
        if laws.flow == (FlowLaw::CapozzaHanley { lateral: Lateral::Eq5 }) {
            let lone_ball = matches!(shape.pieces(), [Piece::Ball(_)]);
            if !lone_ball || rigid {
                return Err(PhysicsError::Unsupported {
                    what: "CapozzaHanley(lateral: Eq5) is the paper's formula for one ball on \
                           springs; take lateral: Projected",
                });
            }
        }
        if rigid && laws.adhesion.is_some() {
            return Err(PhysicsError::Unsupported {
                what: "adhesion holds a body against its springs, and Rigid has none: take \
                       Foundation, or HertzNodes",
            });
        }
        if rigid && laws.archard.is_some() {
            return Err(PhysicsError::Unsupported {
                what: "Archard's law asks for the pressure below a body that slides, and Rigid has \
                       none: take Foundation, or HertzNodes",
            });
        }
        let hertz = matches!(laws.elastic, ElasticLaw::HertzNodes { .. });
        if hertz && shape.has_faces() && !surface.is_flat() {
            return Err(PhysicsError::Unsupported {
                what: "HertzNodes on a mesh knows no faces: take Foundation, or a body of balls",
            });
        }
        Ok(match rigid || (shape.has_faces() && !hertz) {
            true => Self::Columns(Box::new(Columns::new(shape, surface))),
            false => Self::Springs(Box::new(Patch::new(shape, surface, keeps_ledger))),
        })
    }

    /// Of a body with a worn surface of its own.
    pub(crate) fn mutual(
        shape: &Shape,
        skin: &Skin<'_>,
        surface: &Surface,
        keeps_ledger: bool,
    ) -> Result<Self, PhysicsError> {
        let mutual = Mutual::new(shape, skin, surface, keeps_ledger)?;
        Ok(Self::Mutual(Box::new(mutual)))
    }

    /// True if this is the surface of the body's own, or none, that it was made with.
    pub(crate) fn fits(&mut self, skin: Option<&Skin<'_>>, touched: bool) -> bool {
        match (self, skin) {
            (Self::Mutual(mutual), Some(skin)) => mutual.fits(skin, touched),
            (Self::Springs(_) | Self::Columns(_), None) => true,
            _ => false,
        }
    }

    /// r_s for `HertzNodes`, zero otherwise [m].
    pub(crate) fn inflation(&self) -> f64 {
        match self {
            Self::Springs(patch) => patch.inflation(),
            Self::Columns(_) | Self::Mutual(_) => 0.0,
        }
    }

    /// Smallest overlap at which a node yields [m]; infinite without springs.
    pub(crate) fn yield_overlap(&self) -> f64 {
        match self {
            Self::Springs(patch) => patch.yield_overlap(),
            Self::Columns(_) if self.is_rigid() => f64::INFINITY,
            Self::Columns(columns) => columns.yield_overlap(),
            Self::Mutual(mutual) => mutual.yield_overlap(),
        }
    }

    /// True without springs.
    pub(crate) fn is_rigid(&self) -> bool {
        matches!(self, Self::Columns(columns) if columns.yield_overlap() == 0.0)
    }

    /// Largest displacement of a step [m], if the swept rule bounds it.
    pub(crate) fn sweep_reach(&self, surface: &Surface) -> Option<f64> {
        let Self::Columns(columns) = self else { return None };
        let pitch = SWEEP_PITCH * surface.pitch();
        Some(if self.is_rigid() { pitch } else { pitch.min(SWEEP_YIELD * columns.yield_overlap()) })
    }

    /// Makes sure that the candidates cover the `body` at `state`, where a step ends in which it moves by
    /// `reach` [m].
    pub(crate) fn cover(&mut self, placed: &Placed<'_>, body: &Body, state: &State, reach: f64) {
        let (surface, shape) = (&*placed.surface, &body.shape);
        let margin = |pitches: f64| (LIST_STEPS * reach).max(pitches * surface.pitch());
        match self {
            Self::Springs(patch) => patch.cover(surface, shape, state, margin(LIST_PITCH)),
            Self::Columns(columns) => columns.cover(surface, shape, state, margin(SWEPT_PITCH)),
            Self::Mutual(mutual) => mutual.cover(placed, body, state, margin(MUTUAL_PITCH)),
        }
    }

    /// zeta of the dashpots; zero without them.
    pub(crate) fn damping_ratio(&self) -> f64 {
        match self {
            Self::Springs(patch) => patch.damping_ratio(),
            Self::Columns(columns) => columns.damping_ratio(),
            Self::Mutual(_) => 0.0,
        }
    }

    /// Hands over every spring that the last trial pressed or let go.
    pub(crate) fn press(&self, laws: &SurfaceLaws, dashpots: &mut Dashpots) {
        match self {
            Self::Springs(patch) => patch.press(laws, dashpots),
            Self::Columns(columns) => columns.press(dashpots),
            Self::Mutual(_) => {}
        }
    }

    /// Counts what the dashpots do over the last trial.
    pub(crate) fn take_damping(&mut self, damping: &Damping) {
        match self {
            Self::Springs(patch) => patch.add_load(damping.normal_load),
            Self::Columns(columns) => columns.take_damping(damping),
            Self::Mutual(_) => {}
        }
    }

    /// Largest overlap of a node with the body at `state` [m].
    pub(crate) fn deepest(&mut self, placed: &Placed<'_>, shape: &Shape, state: &State) -> f64 {
        match self {
            Self::Springs(patch) => patch.deepest(state),
            Self::Columns(columns) => columns.deepest(placed.surface, shape, state),
            Self::Mutual(mutual) => mutual.deepest(placed, state),
        }
    }

    /// Box around the undeformed nodes whose depths were read since the last call.
    pub(crate) fn take_read(&mut self) -> Option<[Point3<f64>; 2]> {
        match self {
            Self::Springs(patch) => patch.candidates.read.take(),
            Self::Columns(columns) => columns.candidates.read.take(),
            Self::Mutual(mutual) => mutual.take_read(),
        }
    }

    /// Lets go of the surface, wherever the body is.
    pub(crate) fn let_go(&mut self, surface: &mut Surface) {
        match self {
            Self::Springs(patch) => patch.let_go(),
            Self::Columns(columns) => columns.end_contact(surface),
            Self::Mutual(mutual) => mutual.let_go(),
        }
    }

    /// Forgets the nodes, once the contact is over.
    pub(crate) fn forget(&mut self) {
        match self {
            Self::Springs(patch) => patch.let_go(),
            Self::Columns(columns) => columns.forget(),
            Self::Mutual(mutual) => mutual.let_go(),
        }
    }

    /// End of a contact.
    pub(crate) fn end(&mut self, surface: &mut Surface) {
        match self {
            Self::Springs(_) => {}
            Self::Columns(columns) => columns.end_contact(surface),
            Self::Mutual(mutual) => mutual.let_go(),
        }
    }
}

#[cfg(feature = "state")]
impl Contact {
    /// True when every candidate is one of `nodes`.
    pub(crate) fn lies_on(&self, nodes: usize) -> bool {
        match self {
            Self::Springs(patch) => patch.lies_on(nodes),
            Self::Columns(columns) => columns.lies_on(nodes),
            Self::Mutual(mutual) => mutual.lies_on(nodes),
        }
    }
}
