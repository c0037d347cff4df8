//! How much the bodies of streams take off, over their mass: the whole run, and its steady part.

use abrade_report::summary::ErosionSummary;

use crate::check::Checked;
use crate::run::engine::Engine;
use crate::scene::SurfaceMotion;

/// Blocks of equal mass of the second half whose scatter tells how well its rate is known.
const BLOCKS: usize = 10;
/// Bodies that must have struck before the second half has a rate.
const LEAST: usize = 4 * BLOCKS;

/// What has struck and what has gone, instant after instant.
#[derive(Default)]
pub(crate) struct Erosion {
    /// Densities of the surfaces [kg/m3], where all have one.
    densities: Option<Vec<f64>>,
    count: u64,
    samples: Vec<Struck>,
}

/// After a step in which bodies struck.
#[derive(Clone, Copy, Default)]
struct Struck {
    /// Bodies that have struck [-], and their mass [kg].
    count: u64,
    mass: f64,
    /// What the surfaces have lost: volume [m3] and mass [kg].
    removed: [f64; 2],
}

impl Erosion {
    pub(crate) fn new(checked: &Checked) -> Self {
        let density = |surface: &crate::scene::SceneSurface| match surface.motion {
            SurfaceMotion::Free { density, .. } => surface.density.or(Some(density)),
            _ => surface.density,
        };
        Self {
            densities: checked.scene.surfaces.values().map(density).collect(),
            ..Self::default()
        }
    }

    /// Takes in a step in which `count` bodies of together `mass` [kg] struck for the first time.
    pub(crate) fn strike(&mut self, engine: &dyn Engine, surfaces: usize, count: u64, mass: f64) {
        let volumes = (0..surfaces).map(|surface| engine.surface(surface).worn().removed);
        let weigh =
            |densities: &Vec<f64>| volumes.clone().zip(densities).map(|(v, rho)| v * rho).sum();
        self.count += count;
        let before = self.samples.last().map_or(0.0, |last| last.mass);
        self.samples.push(Struck {
            count: self.count,
            mass: before + mass,
            removed: [volumes.clone().sum(), self.densities.as_ref().map_or(0.0, weigh)],
        });
    }

    /// The rates, once something has struck; `end` is the volume [m3] lost by each surface at the end.
    pub(crate) fn summary(&self, end: impl Iterator<Item = f64> + Clone) -> Option<ErosionSummary> {
        let mut samples = self.samples.clone();
        let last = samples.last_mut()?;
        // What struck last has gone on to wear.
        last.removed[0] = end.clone().sum();
        if let Some(densities) = &self.densities {
            last.removed[1] = end.zip(densities).map(|(v, rho)| v * rho).sum();
        }
        let last = *last;
        let steady = steady(&samples);
        let known = self.densities.is_some();
        Some(ErosionSummary {
            struck: last.count,
            mass: last.mass,
            rate: 1e9 * last.removed[0] / last.mass,
            steady: steady.map(|[(rate, _), _]| 1e9 * rate),
            steady_deviation: steady.map(|[(_, deviation), _]| 1e9 * deviation),
            rate_by_mass: known.then(|| last.removed[1] / last.mass),
            steady_by_mass: steady.filter(|_| known).map(|[_, (rate, _)]| rate),
        })
    }
}

/// Rates of volume and of mass over the second half of the mass that struck, each with the standard
/// error that the scatter of its blocks tells.
fn steady(samples: &[Struck]) -> Option<[(f64, f64); 2]> {
    let last = samples.last()?;
    if samples.len() < LEAST {
        return None;
    }
    let edge = |block: usize| {
        let mass = last.mass * (0.5 + 0.5 * block as f64 / BLOCKS as f64);
        samples[samples.partition_point(|s| s.mass < mass).min(samples.len() - 1)]
    };
    let edges: Vec<Struck> = (0..=BLOCKS).map(edge).collect();
    let rate = |a: &Struck, b: &Struck, i: usize| (b.removed[i] - a.removed[i]) / (b.mass - a.mass);
    let of = |i: usize| {
        let mean = rate(&edges[0], &edges[BLOCKS], i);
        let off = edges.windows(2).map(|pair| rate(&pair[0], &pair[1], i) - mean);
        let square: f64 = off.map(|off| off * off).sum();
        (mean, (square / (BLOCKS * (BLOCKS - 1)) as f64).sqrt())
    };
    // A body may weigh more than a block: then there are too few.
    edges.windows(2).all(|pair| pair[1].mass > pair[0].mass).then(|| [of(0), of(1)])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(rate: impl Fn(u64) -> f64) -> Vec<Struck> {
        let mut all = vec![Struck::default()];
        for count in 1..=1000 {
            let before = all[all.len() - 1].removed[0];
            all.push(Struck { count, mass: count as f64, removed: [before + rate(count), 0.0] });
        }
        all
    }

    /// Fails for a rate that still holds the incubation of the first half.
    #[test]
    fn the_steady_rate_is_that_of_the_second_half() {
        let [(rate, deviation), _] =
            steady(&samples(|n| if n <= 400 { 0.0 } else { 3.0 })).unwrap();
        assert!((rate - 3.0).abs() < 1e-12 && deviation < 1e-12, "{rate} {deviation}");
    }

    /// Fails for an error that does not tell the scatter of the blocks: every other block has twice
    /// the rate, so that the standard error is 0.5 / sqrt(9) of the lesser one.
    #[test]
    fn the_error_is_that_of_the_mean_of_blocks() {
        let scattered = samples(|n| if (n - 1) / 50 % 2 == 0 { 1.0 } else { 2.0 });
        let [(rate, deviation), _] = steady(&scattered).unwrap();
        assert!((rate - 1.5).abs() < 0.01, "{rate}");
        assert!((deviation - 0.5 / 3.0).abs() < 0.01, "{deviation}");
    }
}
