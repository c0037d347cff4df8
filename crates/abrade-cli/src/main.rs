//! The `abrade` command: arguments, messages, exit codes. Reads scenes through `abrade-scene`;
//! holds no physics.
//!
//! Exit codes: 0 done, 1 the run failed, 2 bad input, 130 interrupted.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod adhesive;
mod adhesive_text;
mod arguments;
mod check;
mod clump;
mod digest;
mod earlier;
mod erosion;
mod failure;
mod interrupt;
mod kind;
mod laws;
mod output_folder;
mod part;
mod progress;
mod render;
mod run;
mod say;
mod scene_text;
mod schema;
mod study;
mod study_text;
mod sweep;
mod view;

use std::process::ExitCode;

use clap::Parser;

use arguments::{AdhesiveCommand, Arguments, Command, StudyCommand};

fn main() -> ExitCode {
    let result = match Arguments::parse().command {
        Command::Run(arguments) => run::run(&arguments),
        Command::Check(arguments) => check::check(&arguments),
        Command::Study(StudyCommand::Convergence(arguments)) => study::convergence(&arguments),
        Command::Study(StudyCommand::Erosion(arguments)) => erosion::erosion(&arguments),
        Command::Sweep(arguments) => sweep::sweep(&arguments),
        Command::Adhesive(AdhesiveCommand::Run(arguments)) => adhesive::run(&arguments),
        Command::Adhesive(AdhesiveCommand::Map(arguments)) => adhesive::map(&arguments),
        Command::Clump(arguments) => clump::clump(&arguments),
        Command::Laws(arguments) => laws::laws(&arguments),
        Command::Schema(arguments) => schema::schema(&arguments),
        Command::View(arguments) => view::view(&arguments),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            failure.print();
            ExitCode::from(failure.exit_code())
        }
    }
}
