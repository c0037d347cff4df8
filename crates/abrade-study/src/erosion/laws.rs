//! What closed-form laws say of a study's impacts, per mass of grains.

use abrade_laws::{Dnv, Finnie1960, Finnie1972, Grit, Impact, Oka, Steel, SteelCurve};
use abrade_report::quantity_text::digits;

use super::file::StudyFile;

/// Volume per mass that counts as none [mm3/kg].
const TINY: f64 = 1e-12;

/// A law at the conditions of a study.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Prediction {
    /// The law.
    pub(crate) name: &'static str,
    /// What it was given beside speed and angle.
    pub(crate) given: String,
    /// Volume per mass of grains at each angle of the study [mm3/kg].
    pub(crate) volumes: Vec<f64>,
}

/// Each law at the angles of the study and this `speed` [m/s]; those that tell ratios of masses where the
/// study tells the target's density.
pub(crate) fn predictions(file: &StudyFile, speed: f64) -> Vec<Prediction> {
    predictions_at(file, speed, &file.angles)
}

/// [`predictions`] at any angles [rad].
pub(crate) fn predictions_at(file: &StudyFile, speed: f64, angles: &[f64]) -> Vec<Prediction> {
    let hardness = file.target.material.hardness;
    let diameter = file.size.diameter();
    let impacts = || angles.iter().map(|&angle| Impact { mass: 1.0, speed, angle });
    let of = |name, given: String, volume: &dyn Fn(&Impact) -> f64| Prediction {
        name,
        given,
        // The cosine of a right angle is round-off.
        volumes: impacts()
            .map(|impact| volume(&impact))
            .map(|v| if v < TINY { 0.0 } else { v })
            .collect(),
    };
    let gigapascal = hardness / 1e9;
    let finnie = Finnie1960::of(hardness);
    let later = Finnie1972::of(hardness);
    let oka = Oka { hardness, diameter, grit: Grit::QUARTZ };
    let mut predictions = vec![
        of("Finnie 1960", format!("p = H = {gigapascal} GPa, c = 1, psi = K = 2"), &|impact| {
            1e9 * finnie.volume(impact)
        }),
        of("Finnie 1972", format!("p = H = {gigapascal} GPa, c = 0.1, K = 2, a ball"), &|impact| {
            1e9 * later.volume(impact)
        }),
        of(
            "Oka 2005, quartz",
            format!("Hv = {gigapascal} GPa, D = {} um", digits(1e6 * diameter)),
            &|impact| 1e9 * oka.volume_per_mass(impact),
        ),
    ];
    if let Some(density) = file.target.density {
        let volume = move |ratio: f64| 1e9 * ratio / density;
        let brinell = Steel::brinell_of(hardness);
        let steel = |sharpness| Steel {
            curve: SteelCurve::Zhang,
            factor: SteelCurve::Zhang.factor(),
            brinell,
            sharpness,
        };
        let (round, sharp) = (steel(0.2), steel(1.0));
        predictions.extend([
            of("DNV RP-O501, steel", "K = 2e-9, n = 2.6".into(), &|impact| {
                volume(Dnv::STEEL.ratio(impact))
            }),
            of("E/CRC, round", format!("BH = {brinell:.0}, F_s = 0.2"), &|impact| {
                volume(round.ratio(impact))
            }),
            of("E/CRC, angular", format!("BH = {brinell:.0}, F_s = 1"), &|impact| {
                volume(sharp.ratio(impact))
            }),
        ]);
    }
    predictions
}
