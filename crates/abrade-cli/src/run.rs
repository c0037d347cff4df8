//! `abrade run`.

use anyhow::anyhow;

use crate::arguments::RunArguments;
use crate::failure::Failure;
use crate::output_folder;

/// Loads and checks the scene, makes sure of its folder, and runs it.
pub(crate) fn run(arguments: &RunArguments) -> Result<(), Failure> {
    let checked = abrade_scene::load(&arguments.scene.scene, &arguments.scene.sets)?;
    let folder = output_folder::chosen(arguments.out.as_deref(), &checked.scene.name);
    output_folder::probe(&folder)?;
    Err(Failure::Run(anyhow!(
        "running is not wired yet: `{}` in {:?}, into `{}`{}",
        checked.scene.name,
        arguments.precision,
        folder.display(),
        if arguments.json { ", as JSON" } else { "" }
    )))
}
