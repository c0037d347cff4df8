//! The reference tables through the command line: scenes as shipped, rows by `--set`.

mod closed;
mod independence;
mod paper;
mod run;
mod scenes;
mod theory;
