//! Which loop takes the candidates through a step: shape, ground, laws and books are matched here,
//! outside of it. What a contact refuses has no loop of its own.

use std::marker::PhantomData;

use crate::archard::Rubbed;
use crate::elastic::{Elastic, Foundation, HertzNodes, Smooth};
use crate::flow::{CapozzaHanley, Eq5, Flow, NormalPressure, Projected};
use crate::ground::Ground;
use crate::inner_loop::{Columns, InnerLoop, Reaction};
use crate::laws::{ElasticLaw, FlowLaw, Lateral};
use crate::ledger::Ledger;
use crate::node_law::Motion;
use crate::query::Query;
use crate::surface::SurfaceLaws;

/// The candidates before a step.
pub(super) struct Round<'a> {
    pub laws: &'a SurfaceLaws,
    pub motion: &'a Motion,
    pub columns: Columns<'a>,
    /// Where energies are booked, if they are kept.
    pub ledger: Option<&'a mut Ledger>,
}

impl Round<'_> {
    /// Against a body of balls and hulls.
    pub(super) fn against<Q: Query>(self, query: &Q, ground: impl Ground) -> Reaction {
        match self.laws.elastic {
            ElasticLaw::HertzNodes { .. } => {
                let hertz = HertzNodes::new(self.laws.material.poisson);
                self.with_springs(query, ground, hertz)
            }
            _ => self.on_foundation(query, ground),
        }
    }

    /// Against a body whose springs are a foundation.
    pub(super) fn on_foundation<Q: Query>(self, query: &Q, ground: impl Ground) -> Reaction {
        let foundation = Foundation::new(self.laws.material.poisson);
        self.with_springs(query, ground, foundation)
    }

    fn with_springs<Q: Query, E: Elastic>(
        self,
        query: &Q,
        ground: impl Ground,
        elastic: E,
    ) -> Reaction {
        // Slip counts for Archard's law, friction or not.
        match self.laws.material.friction > 0.0 || self.laws.archard.is_some() {
            true => self.with_elastic(query, ground, elastic),
            false => self.with_elastic(query, ground, Smooth(elastic)),
        }
    }

    fn with_elastic<Q: Query, E: Elastic>(
        self,
        query: &Q,
        ground: impl Ground,
        elastic: E,
    ) -> Reaction {
        let hardness = self.laws.material.hardness;
        let shear_hardness = self.laws.material.shear_ratio * hardness;
        match self.laws.flow {
            FlowLaw::CapozzaHanley { lateral: Lateral::Eq5 } if Q::IS_BALL => {
                let flow = CapozzaHanley::<Eq5> { hardness, shear_hardness, lateral: PhantomData };
                self.run(query, ground, elastic, flow)
            }
            FlowLaw::CapozzaHanley { .. } => {
                let flow =
                    CapozzaHanley::<Projected> { hardness, shear_hardness, lateral: PhantomData };
                self.run(query, ground, elastic, flow)
            }
            FlowLaw::NormalPressure {} => {
                self.run(query, ground, elastic, NormalPressure { hardness })
            }
        }
    }

    fn run<Q: Query, G: Ground, E: Elastic, F: Flow>(
        self,
        query: &Q,
        ground: G,
        elastic: E,
        flow: F,
    ) -> Reaction {
        let Self { laws, motion, columns, ledger } = self;
        let friction = laws.material.friction;
        if let (true, Some(archard)) = (E::RUBS, &laws.archard) {
            let flow = Rubbed { flow, rate: archard.rate(&laws.material) };
            let inner = InnerLoop { elastic, flow, query, friction, motion, ground };
            // It keeps books always: fewer loops to build.
            let mut books = Ledger::default();
            let reaction = inner.run(columns, &mut books);
            if let Some(ledger) = ledger {
                *ledger = books;
            }
            return reaction;
        }
        let inner = InnerLoop { elastic, flow, query, friction, motion, ground };
        match ledger {
            Some(ledger) => {
                *ledger = Ledger::default();
                inner.run(columns, ledger)
            }
            None => inner.run(columns, &mut ()),
        }
    }
}
