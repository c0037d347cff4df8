//! Names of the files that a run leaves, by what its scene asks for.

use crate::check::Checked;
use crate::run::entries::{entries, stem};
use crate::scene::{MeshFormat, Output};

/// The names; of a series that of its list. The page that `abrade view` makes of a run is among them.
pub(crate) fn names(checked: &Checked) -> Vec<String> {
    let entries = entries(checked);
    let of_surfaces = |end: &str| -> Vec<String> {
        entries.iter().map(|entry| stem(&entries, entry) + end).collect()
    };
    let one = |name: &str| vec![name.to_owned()];
    let asked = checked.scene.outputs.iter().flat_map(|output| match output {
        Output::History { .. } => one("history.csv"),
        Output::Surface { .. } => of_surfaces(".pvd"),
        Output::Bodies => [one("bodies.pvd"), of_surfaces(".pvd")].concat(),
        Output::Mesh { format: MeshFormat::Stl } => of_surfaces(".stl"),
        Output::Mesh { format: MeshFormat::Obj } => of_surfaces(".obj"),
        Output::Picture => of_surfaces(".png"),
        Output::Report => one("report.html"),
        Output::Laws { .. } => one("impacts.csv"),
        Output::Energy => Vec::new(),
    });
    [one("summary.json"), one("view.html")].concat().into_iter().chain(asked).collect()
}
