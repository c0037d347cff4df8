//! What a case tells of its impacts: every quantity a ratio of two sums over them.

use super::case::Made;
use super::impact::Impact;
use super::statistics::{self, Estimate};

/// A quantity of a case: the sum over all impacts of the one over that of the other.
pub(crate) struct Quantity {
    /// Name of its column, with the unit.
    pub(crate) name: &'static str,
    above: Term,
    below: fn(&Impact) -> f64,
}

/// What is summed.
#[derive(Clone, Copy)]
enum Term {
    Of(fn(&Impact) -> f64),
    /// Chips, and what faces displaced at angles of attack from this bin on [m3].
    CutFrom(usize),
}

impl Term {
    fn of(self, impact: &Impact) -> f64 {
        match self {
            Self::Of(term) => term(impact),
            Self::CutFrom(bin) => {
                impact.chip_m3 + impact.displaced_by_attack_m3[bin..].iter().sum::<f64>()
            }
        }
    }
}

impl Quantity {
    /// Its estimate from `impacts`.
    pub(crate) fn of(&self, impacts: &[Impact]) -> Estimate {
        let rows: Vec<[f64; 2]> =
            impacts.iter().map(|impact| [self.above.of(impact), (self.below)(impact)]).collect();
        statistics::estimate(&rows, rows.len(), |sums| sums[0] / sums[1])
    }

    /// Its value for `case` over that for `other`, both made with the same samples, as far as they go.
    pub(crate) fn ratio(&self, case: &Made, other: &Made) -> Estimate {
        let cases = [case, other];
        statistics::estimate(&self.rows(&cases), fewest(&cases), |sums| {
            sums[0] / sums[1] / (sums[2] / sums[3])
        })
    }

    /// The exponent of speed to which it goes, by least squares of the logarithms over `cases` at these
    /// `speeds` [m/s], made with the same samples.
    pub(crate) fn exponent(&self, speeds: &[f64], cases: &[&Made]) -> Estimate {
        statistics::estimate(&self.rows(cases), fewest(cases), |sums| {
            let values = sums.chunks(2).map(|pair| (pair[0] / pair[1]).ln());
            let points = speeds.iter().map(|v| v.ln()).zip(values).map(<[f64; 2]>::from);
            slope(&points.collect::<Vec<_>>())
        })
    }

    /// A row per sample with both terms of every case; zeros where a case has no result of the sample,
    /// which leaves it out of that case's sums.
    fn rows(&self, cases: &[&Made]) -> Vec<Vec<f64>> {
        let count = cases.iter().map(|made| made.impacts.len()).max().unwrap_or(0);
        let terms = |made: &&Made, k: usize| match made.impacts.get(k) {
            Some(Ok(impact)) => [self.above.of(impact), (self.below)(impact)],
            _ => [0.0; 2],
        };
        (0..count).map(|k| cases.iter().flat_map(|made| terms(made, k)).collect()).collect()
    }
}

/// Samples with a result, of the case that has the fewest.
fn fewest(cases: &[&Made]) -> usize {
    cases.iter().map(|made| made.impacts.iter().flatten().count()).min().unwrap_or(0)
}

/// Slope of the line through `points` by least squares.
fn slope(points: &[[f64; 2]]) -> f64 {
    let mean = |a: usize| points.iter().map(|p| p[a]).sum::<f64>() / points.len() as f64;
    let [x, y] = [mean(0), mean(1)];
    let product = |f: &dyn Fn(&[f64; 2]) -> f64| points.iter().map(f).sum::<f64>();
    product(&|p| (p[0] - x) * (p[1] - y)) / product(&|p| (p[0] - x).powi(2))
}

/// Cubic millimetres per cubic metre.
const MM3: f64 = 1e9;
/// Speed at the rim of a grain, over that of its centre before, below which it counts as not turned.
pub(crate) const STILL: f64 = 0.02;

/// Displaced volume per mass of grains.
pub(crate) const WEAR: Quantity = per_mass("wear_mm3_per_kg", |i| i.wear_volume_m3 * MM3);

/// Debris per mass of grains.
pub(crate) const REMOVED: Quantity = per_mass("removed_mm3_per_kg", |i| i.removed_volume_m3 * MM3);

/// Debris per mass of grains, were it what faces cut at angles of attack from a multiple `bin` of
/// [`ATTACK_BIN`](abrade::ATTACK_BIN) on.
pub(crate) fn cut_from(bin: usize) -> Quantity {
    let name = "cut_m3_per_kg";
    Quantity { name, above: Term::CutFrom(bin), below: |i| i.mass_kg }
}

/// All of them.
pub(crate) const ALL: [Quantity; 20] = [
    WEAR,
    REMOVED,
    per_impact("wear_volume_m3", |i| i.wear_volume_m3),
    per_impact("removed_volume_m3", |i| i.removed_volume_m3),
    of_energy("wear_energy_share", |i| i.energy_wear * i.energy_j),
    of_energy("friction_energy_share", |i| i.energy_friction * i.energy_j),
    of_energy("translation_energy_share", |i| i.energy_translation * i.energy_j),
    of_energy("rotation_energy_share", |i| i.energy_rotation * i.energy_j),
    of_energy("other_energy_share", |i| i.energy_other * i.energy_j),
    of_wear("lateral_share", |i| i.lateral_m3),
    of_wear("chip_share", |i| i.chip_m3),
    of_wear("removed_share", |i| i.removed_volume_m3),
    per_impact("depth_m", |i| i.depth_m),
    per_impact("restitution", |i| i.restitution),
    per_impact("restitution_normal", |i| i.restitution_normal),
    per_impact("restitution_tangential", |i| i.restitution_tangential),
    per_impact("spin_rad_s", |i| i.spin_rad_s),
    per_impact("forward_share", |i| share(i.rim > STILL)),
    per_impact("backward_share", |i| share(i.rim < -STILL)),
    per_impact("embedded_share", |i| share(i.is_embedded)),
];

const fn per_impact(name: &'static str, above: fn(&Impact) -> f64) -> Quantity {
    Quantity { name, above: Term::Of(above), below: |_| 1.0 }
}

const fn per_mass(name: &'static str, above: fn(&Impact) -> f64) -> Quantity {
    Quantity { name, above: Term::Of(above), below: |i| i.mass_kg }
}

/// A share of the energy before the impact.
const fn of_energy(name: &'static str, above: fn(&Impact) -> f64) -> Quantity {
    Quantity { name, above: Term::Of(above), below: |i| i.energy_j }
}

/// A share of the displaced volume.
const fn of_wear(name: &'static str, above: fn(&Impact) -> f64) -> Quantity {
    Quantity { name, above: Term::Of(above), below: |i| i.wear_volume_m3 }
}

fn share(is: bool) -> f64 {
    f64::from(u8::from(is))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for a slope of something else, or an exponent without its interval.
    #[test]
    fn the_exponent_is_that_of_the_law_that_made_the_impacts() {
        let impact = |speed: f64, k: u32| {
            let scatter = 1.0 + 0.1 * f64::from(k % 7);
            Impact {
                wear_volume_m3: 1e-12 * speed.powf(2.3) * scatter,
                mass_kg: 1e-8,
                ..Impact::default()
            }
        };
        let speeds = [20.0, 50.0, 110.0];
        let made = |speed: f64| Made {
            pitch: 1e-6,
            impacts: (0..70).map(|k| Ok(impact(speed, k))).collect(),
        };
        let cases = speeds.map(made);
        let exponent = WEAR.exponent(&speeds, &cases.each_ref());
        // The same scatter at every speed leaves the exponent alone.
        assert!((exponent.value - 2.3).abs() < 1e-9 && exponent.half_width < 1e-9, "{exponent:?}");
    }

    /// Fails for a ratio that drops samples which only one of both has, or whose interval does not see
    /// that the others are the same: what is common to both cancels.
    #[test]
    fn a_ratio_counts_every_sample_and_cancels_what_is_common() {
        let impact = |k: u32, factor: f64| {
            let scatter = 1.0 + 0.5 * f64::from(k % 2);
            Impact { wear_volume_m3: factor * scatter, mass_kg: 1.0, ..Impact::default() }
        };
        let made = |count: u32, factor: f64| Made {
            pitch: 1e-6,
            impacts: (0..count).map(|k| Ok(impact(k, factor))).collect(),
        };
        let (short, long) = (made(100, 1.0), made(400, 3.0));
        let same = WEAR.ratio(&made(100, 3.0), &short);
        assert!((same.value - 3.0).abs() < 1e-12 && same.half_width < 1e-12, "{same:?}");
        let more = WEAR.ratio(&long, &short);
        // Standard deviation over mean is 0.2; what 300 further samples do not share is left.
        // Student's factor is that of the 100.
        let rest = 3.0 * 1.984 * 0.2 * (1.0_f64 / 100.0 - 1.0 / 400.0).sqrt();
        assert!((more.value - 3.0).abs() < 1e-12, "{more:?}");
        assert!((more.half_width / rest - 1.0).abs() < 0.02, "{more:?} {rest}");
    }
}
