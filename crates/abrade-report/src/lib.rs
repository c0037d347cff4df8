//! Files of a run: summary, history, ParaView files, meshes, picture, page; and the way back for
//! those that are read again.
//!
//! Everything here takes `&`: nothing that writes can change a run. Every file appears under its
//! final name only when it is complete ([`atomic`]). Which files a run writes, and when, is the
//! caller's business.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod atomic;
pub mod chart;
mod error;
pub mod history;
pub mod impacts;
mod mesh;
pub mod mesh_files;
pub mod page;
pub mod picture;
pub mod pvd;
pub mod quantity_text;
pub mod run_files;
pub mod sheet;
pub mod summary;
mod units;
pub mod vtp;

pub use error::{FileAction, ReportError};
pub use history::History;
pub use mesh::Mesh;
pub use picture::gallery::{Crater, Gallery};
pub use picture::regimes::{Boundary, Cell, Regimes};
pub use picture::rounds::{Instant, Rounds};
pub use picture::{Mark, Picture, SolidPicture};
pub use pvd::Series;
pub use summary::Summary;
