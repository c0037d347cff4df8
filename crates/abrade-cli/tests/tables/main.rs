//! The reference tables through the command line: scenes as shipped, rows by `--set`.

mod closed;
mod independence;
mod paper;
mod polyhedra;
mod prisms;
mod run;
mod scenes;
mod selfsimilar;
mod spheres;
mod streams;
mod theory;
