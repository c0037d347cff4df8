//! Every contact, at every step: rows of bodies that lie, are jointed, stacked, struck or pushed,
//! against the same in lockstep, fine. Both precisions run the same tests.

mod beyond;
mod far;
mod rig;
mod rows;
mod soak;
mod table;
