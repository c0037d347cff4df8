//! What is wrong with the mesh of a closed surface, at its place in the scene or in its file.

use abrade::{MeshError, NODE_LIMIT, ParameterError};

use super::Checker;
use crate::closed::ClosedTrouble;
use crate::number_rows::{Line, RowsTrouble};
use crate::problem::{Mark, Problem, Source};
use crate::spans::ScenePath;

impl Checker<'_> {
    /// Refuses the surface at `path`.
    pub(super) fn refuse_closed(&mut self, path: &ScenePath, name: &str, trouble: ClosedTrouble) {
        let geometry = path.join("geometry");
        let file = geometry.join("file");
        let message = trouble.to_string();
        match trouble {
            ClosedTrouble::File(_) | ClosedTrouble::Heights(RowsTrouble::Unreadable { .. }) => {
                self.refuse(&file, message, "");
            }
            ClosedTrouble::Heights(RowsTrouble::NotANumber { line, .. })
            | ClosedTrouble::Row { line, .. } => {
                let title = format!("the heights `{}` have a bad line", line.file);
                self.refuse_row(&file, title, line, message);
            }
            ClosedTrouble::NoSolid { error, .. } => self.refuse(&file, message, error.to_string()),
            ClosedTrouble::Mesh(error) => self.refuse_mesh(&geometry, name, error),
        }
    }

    /// Sizes that are out of range, too coarse or too fine.
    fn refuse_mesh(&mut self, geometry: &ScenePath, name: &str, error: MeshError) {
        let pitch = geometry.join("pitch");
        match error {
            MeshError::Parameter(error) => {
                let field = match error.field {
                    "spacing_x" | "spacing_y" => "spacing",
                    field => field,
                };
                self.out_of_range(geometry, &ParameterError { field, ..error });
            }
            MeshError::TooCoarse { field, radius, around, least, would_do, .. } => {
                let label = format!(
                    "gives {around} nodes around the `{field}` of {radius} m, at least {least} \
                     are needed: {would_do:.3e} m would do"
                );
                self.refuse(&pitch, format!("`{pitch}` is too coarse"), label);
            }
            MeshError::TooMany { what, count, .. } => {
                let message = format!("the surface `{name}` has more than {NODE_LIMIT:.0e} nodes");
                self.refuse(&pitch, message, format!("gives {count:.3e} {what}"));
            }
            MeshError::Resample { ref reason, .. } => {
                let message = format!("the surface `{name}` cannot have this pitch");
                let label = format!("the nodes would not bound a solid: {reason}");
                self.refuse(&pitch, message, label);
            }
            error => {
                let message = format!("the surface `{name}` bounds no solid");
                self.refuse(geometry, message, error.to_string());
            }
        }
    }

    /// A fault in a file of rows is shown in that file.
    pub(super) fn refuse_row(
        &mut self,
        file: &ScenePath,
        message: String,
        line: Line,
        fault: String,
    ) {
        let named = self.mark(file, "named here");
        let Line { file: name, number: first_line, text } = line;
        let range = 0..text.len();
        let source = self.add_source(Source { name, text, first_line });
        let marks = vec![Mark { source, range, label: fault }, named];
        self.problems.push(Problem { message, marks, help: None });
    }
}
