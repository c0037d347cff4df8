//! What is wrong with the mesh of a closed surface, at its place in the scene or in its file.

use abrade::{MeshError, ParameterError, SOLID_NODE_LIMIT};

use super::Checker;
use crate::closed::ClosedTrouble;
use crate::number_rows::RowsTrouble;
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
                self.refuse_row(&file, "height field", line, message);
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
                let message =
                    format!("the surface `{name}` has more than {SOLID_NODE_LIMIT:.0e} nodes");
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
}
