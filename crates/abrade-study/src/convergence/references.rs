//! What errors are counted from.

use crate::convergence::ladder::{Against, Ladder, Rung, Variant};
use crate::convergence::measure::{INTERRUPTED, Measured};
use crate::convergence::quantities::Quantities;
use crate::error::StudyError;
use crate::sets;
use abrade_scene::scene::Resolve;

/// Ratios of pitches and of accuracies below which the reference is hardly closer to the truth than
/// a run is.
const CLOSE_PITCH: f64 = 1.9;
const CLOSE_ACCURACY: f64 = 2.9;

/// The runs of every ladder, and the results that they are compared with.
pub(crate) struct References<'a> {
    climbed: &'a [(&'a Ladder, Vec<Measured>)],
    /// That of total errors, and its setting; none for results from elsewhere.
    pub whole: Quantities,
    finest: Option<&'a Rung>,
    words: String,
}

impl<'a> References<'a> {
    /// # Errors
    /// No run came to its end.
    pub fn new(
        climbed: &'a [(&'a Ladder, Vec<Measured>)],
        given: Option<&(Quantities, String)>,
    ) -> Result<Self, StudyError> {
        if let Some((whole, words)) = given {
            let (whole, words) = (whole.clone(), words.clone());
            return Ok(Self { climbed, whole, finest: None, words });
        }
        let Some((rung, run)) = finest(climbed) else {
            let failures = climbed.iter().flat_map(|(_, runs)| runs);
            let reason = failures.filter_map(|run| run.failure.clone()).next();
            return Err(match reason {
                Some(reason) if reason != INTERRUPTED => StudyError::Nothing { reason },
                _ => StudyError::Interrupted,
            });
        };
        let words = match rung.pitch < 1.0 {
            true => format!("the finest run, {}", sets::told(&rung.sets)),
            false => format!(
                "the finest run, {}, whose nodes are no finer than the scene's: total errors do not \
                 hold that of the pitch",
                sets::told(&rung.sets)
            ),
        };
        Ok(Self { climbed, whole: Quantities::mean(&run.landings), finest: Some(rung), words })
    }

    pub fn words(&self) -> String {
        self.words.clone()
    }

    /// True for results from elsewhere.
    pub fn are_given(&self) -> bool {
        self.finest.is_none()
    }

    /// True for a setting that total errors tell about: results from elsewhere do of any, the finest
    /// run of those that are clearly coarser.
    pub fn tell_of(&self, rung: &Rung) -> bool {
        self.finest.is_none_or(|finest| {
            let coarser = rung.accuracy > CLOSE_ACCURACY * finest.accuracy;
            let pitch_known = finest.pitch < 1.0;
            rung.pitch > CLOSE_PITCH * finest.pitch || coarser && !pitch_known
        })
    }

    /// What a run of a ladder is compared with.
    pub fn of(&self, ladder: &Ladder, rung: &Rung) -> Option<(&'a Rung, &'a Measured)> {
        match ladder.against {
            Against::Finest => self.runs(ladder.variant).last(),
            Against::FinestOf(variant) => self.runs(variant).last(),
            Against::SameOf(variant) => {
                self.runs(variant).find(|(other, _)| other.value == rung.value)
            }
            Against::Scene => self.runs(ladder.variant).find(|(other, _)| other.value == 1.0),
        }
    }

    /// The runs of a variant that came to their end, from coarse to fine.
    fn runs(&self, variant: Variant) -> impl Iterator<Item = (&'a Rung, &'a Measured)> + use<'a> {
        let climbed = self.climbed.iter().filter(move |(ladder, _)| ladder.variant == variant);
        climbed.flat_map(|(ladder, runs)| ladder.rungs.iter().zip(runs)).filter(is_done)
    }
}

fn is_done((_, run): &(&Rung, &Measured)) -> bool {
    run.is_done()
}

/// The run of the model, as it is in `f64`, on the finest nodes, and of those the most accurate.
fn finest<'a>(climbed: &'a [(&'a Ladder, Vec<Measured>)]) -> Option<(&'a Rung, &'a Measured)> {
    let of_model = |variant: Variant, rung: &Rung| match variant {
        Variant::Accuracy | Variant::Pitch | Variant::Both => true,
        Variant::Step(resolve) => resolve == Resolve::Auto,
        Variant::Stiffness | Variant::Young => rung.value == 1.0,
        Variant::Single => false,
    };
    let runs = climbed.iter().flat_map(|(ladder, runs)| {
        let runs = ladder.rungs.iter().zip(runs).filter(is_done);
        runs.filter(move |(rung, _)| of_model(ladder.variant, rung))
    });
    let fineness = |rung: &Rung| [rung.pitch, rung.accuracy];
    runs.min_by(|(a, _), (b, _)| {
        fineness(a).partial_cmp(&fineness(b)).unwrap_or(std::cmp::Ordering::Equal)
    })
}
