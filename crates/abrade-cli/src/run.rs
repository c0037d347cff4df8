//! `abrade run`.

use abrade_scene::{Outcome, RunOptions};

use crate::arguments::RunArguments;
use crate::failure::{Failure, Rest};
use crate::progress::Bar;
use crate::{digest, earlier, interrupt, kind, output_folder, say};

/// Loads and checks the scene, makes sure of its folder, runs it and says what came of it.
pub(crate) fn run(arguments: &RunArguments) -> Result<(), Failure> {
    let checked = kind::scene(&arguments.scene.scene, &arguments.scene.sets)?;
    let folder = output_folder::chosen(arguments.out.as_deref(), &arguments.scene.scene);
    output_folder::probe(&folder)?;
    earlier::make_way_for_run(&folder, &checked.scene.name, arguments.out.is_some())?;
    let stop = interrupt::flag();
    // Before it begins: who reads them may wish to break it off.
    checked.notes.iter().for_each(|note| say::aside(&format!("note: {note}")));
    let options = RunOptions { folder, precision: arguments.precision.into() };
    let mut bar = Bar::new(&stop);
    let outcome = abrade_scene::run(&checked, &options, &mut bar);
    bar.clear();
    let Outcome { summary, failure, interrupted } =
        outcome.map_err(|error| Failure::Run(error.into()))?;
    match (arguments.json, &failure) {
        (true, _) => {
            let json = summary.to_json().map_err(|error| Failure::Run(error.into()))?;
            say::say(&format!("{json}\n"))?;
        }
        (false, None) => say::say(&digest::digest(&checked, &summary, &options.folder))?,
        (false, Some(_)) => say::say(&digest::of_failed(&summary, &options.folder))?,
    }
    match (failure, interrupted) {
        (Some(error), _) => Err(Failure::Run(error.into())),
        (None, true) => Err(Failure::Interrupted(Rest::Figures)),
        (None, false) => Ok(()),
    }
}
