//! `abrade view`: a page of a finished run.

use std::path::Path;

use abrade_report::quantity_text::{count, memory};
use abrade_study::adhesive::PICTURE;
use abrade_view::{Page, ViewError};
use anyhow::anyhow;

use crate::arguments::ViewArguments;
use crate::failure::Failure;
use crate::{output_folder, say};

/// Size of a page above which browsers take long to open it [bytes].
const LARGE: usize = 50_000_000;

/// Reads the run's folder, writes the page and says where it is.
pub(crate) fn view(arguments: &ViewArguments) -> Result<(), Failure> {
    if let Err(error) = arguments.folder.metadata() {
        let fault = abrade_scene::unread(&arguments.folder, &error);
        let place = Path::new(output_folder::RUNS).join(&arguments.folder);
        return Err(Failure::Input(match place.is_dir() {
            true => {
                // What else has such a name, as the scene, was not meant.
                let fault = fault.split("; did you mean").next().unwrap_or(&fault);
                anyhow!("{fault}; its run is in `{}`", place.display())
            }
            false => anyhow!(fault),
        }));
    }
    if arguments.folder.join(PICTURE).exists() {
        return Err(Failure::Input(anyhow!(
            "{} is the folder of a collision of asperities: open {PICTURE}, or elements.pvd in ParaView",
            arguments.folder.display()
        )));
    }
    let page = Page::of_run(&arguments.folder).map_err(failure)?;
    let path = arguments.out.clone().unwrap_or_else(|| arguments.folder.join("view.html"));
    page.write(&path).map_err(|error| Failure::Input(error.into()))?;
    let Page { html, instants, nodes, bodies } = &page;
    let text = format!(
        "{}\n  {}: {}, {}, {}\n",
        path.display(),
        memory(html.len() as f64),
        count(*instants, "instant", "instants"),
        count(*nodes, "node", "nodes"),
        count(*bodies, "body", "bodies"),
    );
    say::say(&text)?;
    if let Some(note) = size_note(html.len()) {
        say::aside(&note);
    }
    Ok(())
}

/// What to say of a page of `size` [bytes] that is too large to open at once.
fn size_note(size: usize) -> Option<String> {
    let large = memory(LARGE as f64);
    (size > LARGE).then(|| {
        format!(
            "note: a page of more than {large} opens slowly; a longer `every` in \
             `Surface(every: ..)`, or a coarser pitch, makes it smaller"
        )
    })
}

/// A folder that holds no run to show is bad input; a file that cannot be read is a failure.
fn failure(error: ViewError) -> Failure {
    match error {
        ViewError::NoRun { .. } | ViewError::NoSurface { .. } | ViewError::NoInstant { .. } => {
            Failure::Input(error.into())
        }
        ViewError::File(_)
        | ViewError::Mixed { .. }
        | ViewError::Bent { .. }
        | ViewError::Json { .. } => Failure::Run(error.into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for a note that comes with every page, or never.
    #[test]
    fn only_a_large_page_is_noted() {
        assert_eq!(size_note(LARGE), None);
        let note = size_note(LARGE + 1).expect("a note");
        assert!(note.starts_with("note: a page of more than 50 MB opens slowly"), "{note}");
    }
}
