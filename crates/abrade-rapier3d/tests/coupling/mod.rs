//! The plug-in against Rapier: gate, hooks, and independence of the embedder's step and origin.
//! Both precisions run the same tests.

mod closed;
mod collision;
mod crowd;
mod drive;
mod gate;
mod hail;
mod hooks;
mod independence;
mod leave;
mod lying;
mod query_collider;
mod query_tiles;
mod renewal;
mod rig;
mod shadow;
mod tool;
mod tumble;
mod wall;
