//! Plastic wear for worlds simulated by Rapier.
//!
//! A [`WearWorld`] stands beside the embedder's physics world. Wear surfaces are registered on
//! colliders (their *proxies*); every dynamic body whose colliders are balls, cuboids, convex
//! polyhedra or compounds of those wears them, registered or not, and so does every kinematic one that
//! was made a tool ([`WearWorld::add_tool`]).
//!
//! A step goes through these stages:
//! 1. choose: bodies whose path over the step comes near a wear surface, fixed order;
//! 2. ahead: each of them is run as if it were alone, in parallel;
//! 3. resolve: a body with a joint, with something else in its way, or at rest on a surface is left
//!    in Rapier's hands for the step, its contact laid on the worn surface; the others are carried
//!    through the whole step in `f64` by [`abrade::Encounter`] (Micro), in a frame that lies on the
//!    surface; what was done ahead is taken over where it would be the same now. Tools are led
//!    through the surfaces in their way;
//! 4. steer: their velocities are set so that Rapier lands where the integration ended, and the
//!    pairs body x proxy are filtered out;
//! 5. engine: Rapier's own step, with the embedder's hooks chained behind ours;
//! 6. settle: poses and end velocities are written, events raised; bodies in Rapier's hands wear by
//!    the load that their contact bore (QuasiStatic), or are taken back with their island and
//!    stepped finely (Lockstep), where it was a blow. In an island the embedder's hooks are not
//!    asked;
//! 7. collide: crowded surfaces wear by the blows that their contacts bore, and by the loads of
//!    what lies there (Collision);
//! 8. renew: solids that have worn deep and that nothing touches begin anew as what is left of
//!    them, and their colliders, masses and centres follow.
//!
//! With the feature `serde-serialize` a [`WearWorld`] is saved beside Rapier's world, in the middle
//! of contacts too, and goes on from the bytes to the bit.
//!
//! The `f32` and `f64` packages are one source; only [`scalar`] knows the difference.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub use abrade;
pub use rapier;

mod afloat;
mod ahead;
mod approach;
mod bins;
mod booking;
mod changed;
mod collision;
mod cut;
mod derive;
mod drive;
mod error;
mod event;
mod extent;
mod fingerprint;
mod free;
mod gate;
mod glance;
mod guard;
mod held;
mod hold;
mod lay;
mod lockstep;
mod micro;
mod neighbours;
mod observer;
mod obstacle;
mod pull;
mod quasi_static;
mod query_collider;
mod register;
mod renew;
mod resolve;
mod resolver;
mod rest;
pub mod scalar;
mod settings;
mod settle;
mod shadow;
mod skin;
#[cfg(feature = "serde-serialize")]
mod snapshot;
mod stand_in;
mod start;
mod steer;
mod step;
mod surface;
mod tiles;
mod tool;
mod track;
mod tracked;
mod view;
mod wall;
mod world;

pub use error::{Led, WearError};
pub use event::{Refusal, WearEvent};
pub use guard::WearGuard;
pub use observer::{MicroStep, WearObserver};
pub use resolver::{Resolve, Resolver};
pub use settings::{Counters, StepReport, WearSettings};
pub use surface::SurfaceId;
pub use tool::ToolLoad;
pub use view::WorldView;
pub use world::WearWorld;
