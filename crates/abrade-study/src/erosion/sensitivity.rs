//! How much the debris of a study hangs on the critical angle of attack, which nobody has measured: the
//! sphere's over that of each grain, for one critical angle after the other.

use abrade::{ATTACK_BIN, Removal};

use super::case::{Case, Made};
use super::file::StudyFile;
use super::quantities::cut_from;
use super::statistics::Estimate;

/// Multiples of [`ATTACK_BIN`] that are looked at: 10 to 60 degrees.
const BINS: [usize; 11] = [2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12];

/// Debris of the reference over that of a grain, at one angle and speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensitivity {
    /// Name of the grain.
    pub grain: String,
    /// Angle from the surface [rad].
    pub angle: f64,
    /// Critical angles [rad], the same for all grains, and the ratios there; not finite where the grain leaves
    /// no debris.
    pub ratios: Vec<(f64, Estimate)>,
}

/// Of every grain but the reference, at every angle of the first speed; nothing for removal rules without
/// a critical angle.
pub(crate) fn sensitivities(file: &StudyFile, made: &[(Case, Made)]) -> Vec<Sensitivity> {
    let Removal::AttackAngle { .. } = file.target.removal else { return Vec::new() };
    let Some(reference) = &file.reference else { return Vec::new() };
    let find = |grain: &String, angle: f64| {
        let found = made.iter().find(|(case, _)| case.is(grain, file.speeds[0], angle));
        found.map(|(_, made)| made)
    };
    let mut found = Vec::new();
    for grain in file.grains.keys().filter(|grain| *grain != reference) {
        for &angle in &file.angles {
            let (Some(base), Some(one)) = (find(reference, angle), find(grain, angle)) else {
                continue;
            };
            let ratio = |bin: usize| (bin as f64 * ATTACK_BIN, cut_from(bin).ratio(base, one));
            let ratios = BINS.into_iter().map(ratio).collect();
            found.push(Sensitivity { grain: grain.clone(), angle, ratios });
        }
    }
    found
}
