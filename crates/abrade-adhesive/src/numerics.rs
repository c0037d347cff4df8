//! How time is cut, and the longest step that is stable.

use abrade::ParameterError;

use crate::solid::Solid;

/// A sum of lengths of links over those of a lattice that differs by less is that of a lattice [-].
const ROUNDING: f64 = 1e-9;

/// How finely time is cut, and how much the links dampen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Numerics {
    /// Step, in times that a longitudinal wave takes through an element [-]; below
    /// [`Numerics::limit`].
    pub courant: f64,
    /// Relaxation time of the links' dashpots, in the same times [-].
    pub viscosity: f64,
}

impl Default for Numerics {
    fn default() -> Self {
        Self { courant: 0.5, viscosity: 0.1 }
    }
}

impl Numerics {
    /// Every value outside its range, with the field it stands in.
    pub fn check(&self) -> Vec<ParameterError> {
        let found = [
            ParameterError::positive("courant", self.courant),
            ParameterError::within("courant", self.courant, 0.0, 1.0),
            ParameterError::within("viscosity", self.viscosity, 0.0, 1.0),
        ];
        found.into_iter().flatten().take(1).collect()
    }

    /// The courant from which on a lattice of a solid with `poisson`, whose dashpots are those of
    /// `viscosity`, is unstable [-].
    ///
    /// The fastest motion is the spin w of all elements alike, where the centres rest: each of the
    /// six links is sheared by -w dt and bears -2 G times its turn, on a lever of d / 2. With
    /// S0 = d / sqrt(3), the mass of the hexagon and the inertia J of the disc of its area,
    ///
    /// omega^2 = 6 (d / 2) S0 2 G / J = (16 pi / sqrt(3)) (c_s / d)^2,
    ///
    /// so W = (omega d / c_l)^2 = (16 pi / sqrt(3)) (1 - 2 nu) / (2 (1 - nu)). A dashpot takes the
    /// strain of the step that went, so that a step of the turn goes as
    /// z^2 - (2 - W C^2 - W C v) z + 1 - W C v, which leaves the unit circle at z = -1 where
    /// W C^2 + 2 W C v = 4. Waves of any other length are slower, but above nu = 0.47, where none
    /// is unstable at a courant up to 1.
    pub fn limit(viscosity: f64, poisson: f64) -> f64 {
        limit_of(1.0, viscosity, poisson)
    }

    /// Length of a step in `solid` of elements of `diameter` [m] [s].
    pub(crate) fn step(&self, solid: &Solid, diameter: f64) -> f64 {
        self.courant * (diameter / solid.longitudinal_speed())
    }

    /// A fault if the step is not stable in `solid`, where an element is linked `linkage` times as
    /// much as one of a lattice: the lengths of its links over six diameters.
    pub(crate) fn unstable(&self, solid: &Solid, linkage: f64) -> Option<ParameterError> {
        let (v, nu) = (self.viscosity, solid.poisson);
        let limit = limit_of(linkage, v, nu);
        let allowed = || {
            let dense = match linkage > 1.0 + ROUNDING {
                true => format!(", and links {linkage:.3} times as dense as in a lattice"),
                false => String::new(),
            };
            format!("below {limit:.4} with `viscosity` {v}, `poisson` {nu}{dense}: spins run away")
        };
        let is_fine = self.courant < limit;
        (!is_fine).then(|| ParameterError {
            field: "courant",
            value: self.courant,
            allowed: allowed(),
        })
    }
}

/// The limit where spins are `linkage` times as stiff as in a lattice.
fn limit_of(linkage: f64, viscosity: f64, poisson: f64) -> f64 {
    let speeds = (1.0 - 2.0 * poisson) / (2.0 * (1.0 - poisson));
    let stiffness = linkage * 16.0 * std::f64::consts::PI / 3f64.sqrt() * speeds;
    (viscosity * viscosity + 4.0 / stiffness).sqrt() - viscosity
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assembly::{Assembly, Element};
    use crate::simulation::Simulation;

    const D: f64 = 25e-6;

    /// A periodic layer with a little noise in its velocities; links hold.
    fn layer() -> Assembly {
        let (columns, rows) = (24, 28);
        let mut noise = 1u32;
        let mut draw = || {
            noise = noise.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            1e-3 * (f64::from(noise >> 8) / f64::from(1u32 << 24) - 0.5)
        };
        let mut element = |at: usize| {
            let (row, column) = (at / columns, at % columns);
            let x = column as f64 + 0.5 * (row % 2) as f64;
            let position = [x * D, 3f64.sqrt() / 2.0 * row as f64 * D];
            Element { position, velocity: [draw(), draw()], ..Element::default() }
        };
        let elements = (0..rows * columns).map(&mut element).collect();
        let period = Some(columns as f64 * D);
        let mut layer = Assembly { diameter: D, period, elements, links: Vec::new() };
        layer.link_within(1.01, |_, _| true);
        layer.links.iter_mut().for_each(|link| link.can_break = false);
        layer
    }

    /// Energy after some steps over that at the start; infinite where speeds ran away.
    fn growth(poisson: f64, numerics: Numerics) -> f64 {
        let solid = Solid { poisson, yield_stress: 1e15, hardening: 0.0, ..Solid::default() };
        let mut simulation = Simulation::begin(&solid, &layer(), numerics);
        let energy = |simulation: &Simulation| {
            let ledger = simulation.ledger();
            ledger.kinetic + ledger.elastic
        };
        let start = energy(&simulation);
        match (0..3000).try_for_each(|_| simulation.step()) {
            Ok(()) => energy(&simulation) / start,
            Err(_) => f64::INFINITY,
        }
    }

    /// Fails for a limit without the spin, Poisson's ratio or the dashpots, and for one that refuses
    /// what is stable.
    #[test]
    fn steps_are_stable_up_to_the_limit_and_no_further() {
        for poisson in [-0.5, 0.0, 0.17, 0.3, 0.45] {
            for viscosity in [0.0, 0.1, 0.5] {
                let limit = Numerics::limit(viscosity, poisson);
                let at =
                    |share: f64| growth(poisson, Numerics { courant: share * limit, viscosity });
                let (below, above) = (at(0.97), at(1.03));
                assert!(below < 2.0, "{poisson} {viscosity}: {below:e} below {limit}");
                assert!(above > 1e6, "{poisson} {viscosity}: {above:e} above {limit}");
            }
        }
    }
}
