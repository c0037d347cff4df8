//! `summary.json`: the label of a collision, its figures, loads and energies, and what it was made from.

use std::path::Path;

use abrade_adhesive::{AdhesiveError, Asperities, Collision, Figures, Ledger, Mode, Solid};
use abrade_report::{ReportError, atomic};
use serde_json::{Value, json};

use super::file::SceneFile;

/// What came of a collision.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// Name of the scene.
    pub scene: String,
    /// What both bodies consist of.
    pub solid: Solid,
    /// The bodies, with the points of an outline that was read from a file.
    pub bodies: Asperities,
    /// What the reader should know, in sentences.
    pub warnings: Vec<String>,
    /// Share of the travel that was done [-].
    pub share: f64,
    /// Why it ended before, if it did.
    pub failure: Option<String>,
    /// Steps.
    pub steps: u64,
    /// Elements.
    pub elements: usize,
    /// What became of the asperities.
    pub figures: Figures,
    /// Mean force of the lower body's links on its rigid row [N/m].
    pub mean_load: [f64; 2],
    /// Where the energy is and went [J/m].
    pub ledger: Ledger,
}

impl Summary {
    pub(crate) fn of(
        file: &SceneFile,
        collision: &Collision,
        failure: Option<&AdhesiveError>,
    ) -> Self {
        let (simulation, share) = (collision.simulation(), collision.share());
        let figures = collision.figures();
        let mut warnings = file.notes();
        warnings.extend(apart(share, &figures).map(str::to_owned));
        Self {
            scene: file.name.clone(),
            solid: file.solid,
            bodies: file.bodies.clone(),
            warnings,
            share,
            failure: failure.map(ToString::to_string),
            steps: (simulation.time() / simulation.step_length()).round() as u64,
            elements: simulation.count(),
            figures,
            mean_load: collision.mean_load(),
            ledger: simulation.ledger(),
        }
    }

    /// The label; none before the end of the travel.
    fn mode(&self) -> Option<Mode> {
        mode(self.share, &self.figures)
    }

    /// As JSON: a unit in every name but those of `solid` and `bodies`, which are the scene's words, in SI.
    pub fn to_json(&self) -> Value {
        let (figures, ledger) = (&self.figures, &self.ledger);
        json!({
            "scene": self.scene,
            "abrade": env!("CARGO_PKG_VERSION"),
            "complete": self.share >= 1.0,
            "failure": self.failure,
            "mode": self.mode().map(Mode::name),
            "is_ground": self.mode().map(|_| figures.is_ground()),
            "is_split": self.mode().map(|_| figures.is_split()),
            "warnings": self.warnings,
            "figures": figures_json(figures),
            "elements": self.elements,
            "steps": self.steps,
            "mean_force_x_N_m": self.mean_load[0],
            "mean_force_y_N_m": self.mean_load[1],
            "energy": {
                "kinetic_J_m": ledger.kinetic,
                "elastic_J_m": ledger.elastic,
                "plastic_J_m": ledger.plastic,
                "viscous_J_m": ledger.viscous,
                "drag_J_m": ledger.drag,
                "released_J_m": ledger.released,
                "drive_J_m": ledger.drive,
            },
            "solid": self.solid,
            "bodies": self.bodies,
        })
    }

    /// The figures that a person looks for first, a line each.
    pub fn text(&self) -> String {
        let figures = &self.figures;
        let failure =
            self.failure.as_ref().map_or(String::new(), |why| format!("ended early: {why}\n"));
        let note =
            apart(self.share, figures).map_or(String::new(), |note| format!("  note: {note}\n"));
        format!(
            "{failure}{}: {}\n  ground {:.3}, largest piece {:.3} of an asperity, {:.2} small pieces per facet element, \
             moved {:.1} % of the asperities\n  \
             transferred {:.3}, debris {:.3}, links failed {:.3}, joined: {}\n  \
             mean force on the lower body {:.0} N/m along, {:.0} N/m across; {} elements, {} steps\n{note}",
            self.scene,
            self.mode().map_or("broken off, no mode yet", Mode::name),
            figures.ground,
            figures.largest_piece,
            figures.small_pieces,
            100.0 * figures.worn,
            figures.transferred,
            figures.debris,
            figures.failed,
            if figures.are_joined { "yes" } else { "no" },
            self.mean_load[0],
            self.mean_load[1],
            self.elements,
            self.steps,
        )
    }

    pub(crate) fn write(&self, folder: &Path) -> Result<(), ReportError> {
        let text = format!("{:#}\n", self.to_json());
        atomic::write(&folder.join("summary.json"), text.as_bytes())
    }
}

/// The label at a share of the travel; none before its end.
fn mode(share: f64, figures: &Figures) -> Option<Mode> {
    (share >= 1.0).then(|| figures.mode())
}

/// That the bodies did not touch, where they did not.
fn apart(share: f64, figures: &Figures) -> Option<&'static str> {
    (mode(share, figures) == Some(Mode::NoContact)).then_some(
        "the bodies did not touch: `overlap`, `gap`, `travel` or the outline keeps them apart",
    )
}

/// The figures, by the names of their columns.
pub(crate) fn figures_json(figures: &Figures) -> Value {
    json!({
        "ground": figures.ground,
        "largest_piece": figures.largest_piece,
        "small_pieces": figures.small_pieces,
        "worn": figures.worn,
        "transferred": figures.transferred,
        "debris": figures.debris,
        "failed": figures.failed,
        "parted": figures.parted,
        "are_joined": figures.are_joined,
        "have_touched": figures.have_touched,
    })
}
