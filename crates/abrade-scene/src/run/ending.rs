//! What a run writes at its end: meshes, pictures, the page, the summary.

use std::path::Path;

use abrade_report::{Mark, Picture, ReportError, SolidPicture, Summary, mesh_files, page};

use crate::run::bodies::Bodies;
use crate::run::engine::Engine;
use crate::run::entries::{Entry, stem};
use crate::scene::{MeshFormat, Output};

/// A run that is over.
pub(crate) struct Ending<'a> {
    pub folder: &'a Path,
    pub title: &'a str,
    pub entries: &'a [Entry],
    pub engine: &'a dyn Engine,
    pub bodies: &'a Bodies,
}

impl Ending<'_> {
    /// Writes what `outputs` ask for, and the summary.
    pub(crate) fn write(&self, outputs: &[Output], summary: &Summary) -> Result<(), ReportError> {
        for output in outputs {
            if let Output::Mesh { format } = output {
                self.write_meshes(*format)?;
            }
        }
        let wants = |output: &Output| outputs.contains(output);
        let shown = match (wants(&Output::Picture), wants(&Output::Report)) {
            (true, _) => usize::MAX,
            (false, true) => 1,
            (false, false) => 0,
        };
        let mut first = None;
        for entry in self.entries.iter().take(shown) {
            let picture = self.picture(entry.members[0])?;
            if wants(&Output::Picture) {
                let path = self.folder.join(stem(self.entries, entry) + ".png");
                abrade_report::atomic::write(&path, &picture)?;
            }
            first.get_or_insert(picture);
        }
        if wants(&Output::Report) {
            page::write(&self.folder.join("report.html"), summary, first.as_deref())?;
        }
        summary.write(&self.folder.join("summary.json"))
    }

    /// The mesh file of every surface, of copies of the first.
    fn write_meshes(&self, format: MeshFormat) -> Result<(), ReportError> {
        for entry in self.entries {
            let surface = self.engine.surface(entry.members[0]);
            let (nodes, triangles) = (surface.nodes(), surface.triangles());
            let file = |end: &str| self.folder.join(stem(self.entries, entry) + end);
            match format {
                MeshFormat::Stl => mesh_files::write_stl(&file(".stl"), nodes, &triangles)?,
                MeshFormat::Obj => mesh_files::write_obj(&file(".obj"), nodes, &triangles)?,
            }
        }
        Ok(())
    }

    /// A worn surface with the places where bodies came down.
    fn picture(&self, surface: usize) -> Result<Vec<u8>, ReportError> {
        let (title, tracks) = (self.title, &self.bodies.tracks);
        let marks: Vec<_> = tracks
            .iter()
            .filter(|track| !track.is_streamed)
            .filter_map(|track| {
                let (_, place) = track.landings.iter().find(|(on, _)| *on == surface)?;
                Some(Mark { label: &track.name, position_local: *place })
            })
            .collect();
        let marks = if tracks.len() > 1 { &marks[..] } else { &[] };
        let surface = self.engine.surface(surface);
        let (nodes, wear_volume) = (&*surface.nodes_since_made(), surface.wear_volume());
        match surface.is_flat() {
            true => Picture { title, nodes, wear_volume, marks }.to_png(),
            false => {
                let triangles = &surface.triangles();
                SolidPicture { title, nodes, wear_volume, triangles, marks }.to_png()
            }
        }
    }
}
