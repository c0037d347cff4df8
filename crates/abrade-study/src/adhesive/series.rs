//! `timeseries.csv`: loads and energies over the travel.

use std::fmt::Write as _;
use std::path::Path;

use abrade_adhesive::{Collision, LinkState, Pair};
use abrade_report::{ReportError, atomic};

use super::file::SceneFile;

const HEAD: &str = "time_s,share,force_x_N_m,force_y_N_m,kinetic_J_m,elastic_J_m,plastic_J_m,\
                    viscous_J_m,drag_J_m,released_J_m,drive_J_m,welds,failures\n";

/// The rows so far.
pub(crate) struct Series {
    text: String,
    rows: u32,
    seen: u32,
}

impl Series {
    pub(crate) fn new(file: &SceneFile) -> Self {
        Self { text: HEAD.to_owned(), rows: file.rows, seen: 0 }
    }

    /// Share of the travel at which the next row is due.
    pub(crate) fn next(&self) -> f64 {
        f64::from(self.seen) / f64::from(self.rows)
    }

    /// Writes a row down if one is due, or several: an instant stands once.
    pub(crate) fn see(&mut self, collision: &Collision) {
        if collision.share() >= self.next() {
            self.seen = passed(collision.share(), self.rows).max(self.seen + 1);
            self.add(collision);
        }
    }

    fn add(&mut self, collision: &Collision) {
        let simulation = collision.simulation();
        let (ledger, [fx, fy]) = (simulation.ledger(), collision.load());
        let is_weld = |pair: &Pair| pair.state == LinkState::Linked && !pair.is_original;
        let (welds, failures) = (simulation.pairs().filter(is_weld).count(), simulation.failures());
        let energies = [
            ledger.kinetic,
            ledger.elastic,
            ledger.plastic,
            ledger.viscous,
            ledger.drag,
            ledger.released,
            ledger.drive,
        ]
        .map(|energy| format!("{energy:e}"))
        .join(",");
        let (time, share) = (simulation.time(), collision.share());
        let _ =
            writeln!(self.text, "{time:e},{share:.6},{fx:e},{fy:e},{energies},{welds},{failures}");
    }

    /// Adds the end and writes the file.
    pub(crate) fn finish(
        mut self,
        collision: &Collision,
        folder: &Path,
    ) -> Result<(), ReportError> {
        self.add(collision);
        atomic::write(&folder.join("timeseries.csv"), self.text.as_bytes())
    }
}

/// How many of `count` instants, evenly from the start on, are due after the share `share` of the travel.
pub(crate) fn passed(share: f64, count: u32) -> u32 {
    (share * f64::from(count)).floor() as u32 + 1
}
