//! Closed-form laws of wear and of contact: what erosion by impacts, wear along a slide and the contact of
//! round bodies come to by formulas that engineers use beside a simulation. No nodes, no time: every law
//! is a function of its conditions.
//!
//! Each law is a struct of its constants with one method ([`Finnie1960::volume`],
//! [`Archard::volume`]), or a [`contact::ContactModel`], and an entry in [`laws`], which tells formula, constants, source and
//! [`Status`] and is evaluated by the names of its parameters ([`Law::evaluate`]).
//!
//! Angles are measured from the surface [rad].
#![forbid(unsafe_code)]
#![warn(missing_docs)]
#![allow(rustdoc::broken_intra_doc_links, reason = "units stand in brackets")]

mod catalogue;
pub mod contact;
pub mod erosion;
mod law;
pub mod sliding;

pub use catalogue::laws;
pub use erosion::{
    Arabnejad, Bitter, Dnv, Evans, Finnie1960, Finnie1972, Grit, Huang, Impact, NeilsonGilchrist,
    Oka, Steel, SteelCurve, TabakoffGrant, bitter_threshold,
};
pub use law::{Allowed, Law, LawError, Output, Parameter, Status};
pub use sliding::{Archard, cone_section, groove_section, preston_depth};
