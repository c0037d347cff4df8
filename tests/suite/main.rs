//! Tests of the whole: physics against references that this project did not write.

mod adhesion;
mod archard;
mod cap;
mod closed;
mod convergence;
mod drive;
mod faces;
mod foundation;
mod led;
mod ledger;
mod moving;
mod nature;
mod paper;
mod restitution;
mod rig;
mod selfsimilar;
mod shell;
mod sphere;
mod table;
mod theory;
mod two;
