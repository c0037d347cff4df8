//! Two asperities that collide: plane-strain movable cellular automata with elasticity, plastic flow,
//! links that fail and heal, and adhesion (Dimaki, Shilko, Dudkin, Psakhie, Popov, Scientific Reports
//! 10 (2020) 1585, "the paper" here).
//!
//! A [`Collision`] leads two bodies with [`Asperities`] past each other and tells what became of them. Below
//! it, an [`Assembly`] of round elements and their links becomes a [`Simulation`] of one [`Solid`]; each
//! [`Simulation::step`] is one step of its motion. The thickness is 1 m: forces are per metre. No
//! files, no clock.
#![forbid(unsafe_code)]
#![warn(missing_docs)]
#![allow(rustdoc::broken_intra_doc_links, reason = "units stand in brackets")]

mod asperities;
mod assembly;
mod block;
mod classify;
mod collision;
mod column;
mod components;
mod elastic;
mod elements;
mod error;
mod faces;
mod flow;
mod forces;
mod four;
mod grid;
mod kinematics;
mod lanes;
mod ledger;
mod motion;
mod neighbours;
mod numerics;
mod packing;
mod pairs;
mod profile;
mod returned;
mod settle;
mod simulation;
mod solid;
mod start;

pub use asperities::{Asperities, Part, Place};
pub use assembly::{Assembly, Element, Hold, Link};
pub use classify::{Figures, Mode};
pub use collision::Collision;
pub use error::AdhesiveError;
pub use ledger::Ledger;
pub use numerics::Numerics;
pub use packing::Packing;
pub use pairs::{LinkState, Pair};
pub use profile::Profile;
pub use simulation::Simulation;
pub use solid::{HardeningSlope, Solid};
