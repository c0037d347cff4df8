//! The page that shows a finished run: its worn surfaces coloured by depth, the bodies along their
//! paths, a cross-section, the numbers. One HTML file that needs no other file and no network.
//!
//! Reads what `abrade run` left in a folder (`summary.json`, `surface.pvd`, `bodies.pvd`,
//! `history.csv` and the files that they name); computes no wear. [`Page::of_run`] is all of it:
//! `folder` finds the files, `gather` reads them, `moving` finds what stays between instants,
//! `block` packs it, `page` puts it into the markup, styles and scripts that lie beside it.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod block;
mod error;
mod folder;
mod gather;
mod moving;
mod page;
mod path;
mod rigid;

pub use error::ViewError;
pub use page::Page;
