//! The invariants of ARCHITECTURE.md and the style rules of CONTRIBUTING.md, as far as a machine
//! can check them. Every fault is told with its file and line.
//!
//! A check is a pure function from a file's text to faults, and each has a test that feeds it a
//! text it must refuse. Sources are read with comments and strings blanked out (`source`).

mod doc_links;
mod fault;
mod invariants;
mod markdown;
mod pages;
mod size;
mod source;
mod style;
mod tree;
