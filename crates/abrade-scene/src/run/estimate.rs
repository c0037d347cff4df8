//! How far the wear volume of a run may be off, told by the run itself. docs/errors.md sets the
//! estimates beside the errors of studies, from which their factors are.

use abrade::{ElasticLaw, Piece};
use abrade_report::summary::{EnergySummary, ErrorEstimate};

use crate::check::Checked;
use crate::run::engine::Engine;

/// Error by time over the share of the dissipated energy that is numerical.
const TIME: f64 = 0.8;
/// Error by pitch over the scatter on coarser lattices, where energy goes elsewhere than into wear.
const PITCH: f64 = 0.48;

/// The estimate for the surfaces of `checked`, the first ones of an engine.
pub(crate) fn of(
    checked: &Checked,
    engine: &dyn Engine,
    energy: Option<&EnergySummary>,
) -> ErrorEstimate {
    let time = energy.filter(|_| on_springs(checked)).and_then(by_time);
    let pitch = by_pitch(engine, checked.scene.surfaces.len(), energy);
    let bases = [
        time.map(|_| "time: the ledger's numerical part over the energy dissipated"),
        pitch.map(|_| "pitch: the scatter of the wear volume over coarser lattices in the nodes"),
    ];
    let bases: Vec<&str> = bases.into_iter().flatten().collect();
    ErrorEstimate { time, pitch, basis: (!bases.is_empty()).then(|| bases.join("; ")) }
}

/// True where springs alone carry the bodies: the ledger of columns is closed by a projection, and
/// tells nothing of their error. A fixed body counts: free surfaces meet its faces.
fn on_springs(checked: &Checked) -> bool {
    let is_ball = |piece: &Piece| matches!(piece, Piece::Ball(_));
    let balls = checked.solids.values().all(|solid| solid.shape.pieces().iter().all(is_ball));
    checked.scene.surfaces.values().all(|surface| match surface.elastic {
        ElasticLaw::Rigid => false,
        ElasticLaw::Foundation { .. } => balls,
        ElasticLaw::HertzNodes { .. } => true,
    })
}

fn by_time(energy: &EnergySummary) -> Option<f64> {
    let dissipated = energy.wear + energy.friction + energy.damping;
    (dissipated > 0.0).then(|| TIME * energy.numerical.abs() / dissipated)
}

/// Of all surfaces together, their errors taken as independent; none where one has worn whose nodes
/// are no lattice.
fn by_pitch(engine: &dyn Engine, count: usize, energy: Option<&EnergySummary>) -> Option<f64> {
    let (mut square, mut whole) = (0.0, 0.0);
    for surface in (0..count).map(|index| engine.surface(index)) {
        let volume = surface.wear_volume();
        if volume > 0.0 {
            square += (surface.sublattice_scatter()? * volume).powi(2);
            whole += volume;
        }
    }
    (whole > 0.0).then(|| PITCH * square.sqrt() / whole * energy.map_or(1.0, leeway))
}

/// How much of the energy has elsewhere to go than into wear: where it has not, the volume is
/// bound to it, however coarse the nodes are.
fn leeway(energy: &EnergySummary) -> f64 {
    let spent = energy.initial + energy.external_work.max(0.0);
    if spent > 0.0 { (1.0 - energy.wear / spent).clamp(0.0, 1.0).sqrt() } else { 1.0 }
}
