//! An island of bodies, with its contacts and joints, in a private Rapier world in `f64` whose
//! steps are as small as the wear contacts need.
//!
//! Rapier's rigid contacts and joints transmit within a step of nanoseconds what they cannot at
//! an embedder's: an impact through a chain of bodies, or on a body that a joint holds. Wear
//! contacts are taken from Rapier and act as forces, from the same laws as everywhere else.
//!
//! A step of the island:
//! 1. length: the shortest that a wear contact asks for, long where none can be touched;
//! 2. forces of the present instant, the embedder's among them;
//! 3. Rapier's step;
//! 4. follow: every wear surface follows its bodies; a step that was too long for the springs it
//!    met is taken back and tried shorter;
//! 5. calm: where the island may rest, a body that only rings on its springs is put on a contact
//!    of Rapier's, so that the rest of the time passes in long steps. One that is struck there goes
//!    back to springs, which are not loaded by what it has moved meanwhile.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub use rapier;

mod articulation;
mod calm;
mod convert;
mod filter;
mod island;
mod pairs;
mod parameters;
mod rewind;
mod round;
#[cfg(feature = "state")]
mod state;
mod wearer;

pub use articulation::{Coordinates, Link, LinkJoint};
pub use convert::{from_vector, to_pose, to_vector};
pub use filter::Proxy;
pub use island::{Done, Island, IslandSettings};
pub use wearer::Wearer;
