//! Scenes from text to bodies in the world.

mod build;
mod closed;
mod copies;
mod extremes;
mod led;
mod moving;
mod mutations;
mod size;
mod words;

use std::path::PathBuf;

use abrade_scene::{Checked, SceneError, load_text};

/// The scene of the interface's page, word for word.
const SCENE: &str = include_str!("impact.ron");

/// [`SCENE`] with arguments as `--set` takes them.
fn set(arguments: &[&str]) -> Result<Checked, SceneError> {
    let arguments: Vec<String> = arguments.iter().map(|&argument| argument.to_owned()).collect();
    load_text("impact.ron", SCENE.to_owned(), PathBuf::new(), &arguments)
}

fn checked(arguments: &[&str]) -> Checked {
    set(arguments).unwrap_or_else(|error| panic!("{arguments:?}: {error}"))
}

fn refusal(arguments: &[&str]) -> String {
    match set(arguments) {
        Ok(_) => panic!("{arguments:?} was accepted"),
        Err(error) => error.to_string(),
    }
}
