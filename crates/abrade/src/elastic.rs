//! Elastic part of a node's contact: normal force and tangential spring.

use crate::laws::{ElasticLaw, HertzConvention};
use crate::material::Material;
use crate::shape::Piece;
use crate::surface::Surface;

/// A normal law; the coefficient comes with the touched piece.
pub(crate) trait Elastic: Copy {
    /// True when the tangential stiffness does not change with the overlap, so that the springs
    /// are conservative.
    const CONSERVATIVE: bool;

    /// False without friction: the tangential springs then carry nothing.
    const RUBS: bool = true;

    /// Normal force F [N] on a node of `area` [m2] at `overlap` d >= 0 [m].
    fn normal_force(self, coefficient: f64, overlap: f64, area: f64) -> f64;

    /// dF/dd [N/m].
    fn normal_stiffness(self, coefficient: f64, overlap: f64, area: f64) -> f64;

    /// Stiffness of the tangential spring over the normal one [-], the same at any overlap.
    fn tangential_ratio(self) -> f64;

    /// Stiffness [N/m] of the tangential spring: T = k xi.
    #[inline(always)]
    fn tangential_stiffness(self, coefficient: f64, overlap: f64, area: f64) -> f64 {
        self.tangential_ratio() * self.normal_stiffness(coefficient, overlap, area)
    }

    /// Energy [J] of the normal spring.
    fn normal_energy(self, coefficient: f64, overlap: f64, area: f64) -> f64;

    /// Overlap [m] at which a node flat under the body reaches the hardness.
    fn yield_overlap(self, coefficient: f64, hardness: f64, area: f64) -> f64;
}

/// Winkler foundation: p = k_w d, T = k_t a_s xi.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Foundation {
    /// k_t / k_w = 2 (1 - nu) / (2 - nu).
    pub tangential_ratio: f64,
}

/// Hertz nodes: F = K sqrt(R_eff) d^1.5, dF/dd = 3/2 K sqrt(R_eff d), T = k_t sqrt(R_eff d) xi.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HertzNodes {
    /// k_t / (3/2 K) = 2 (1 - nu) / (2 - nu), from K = 2E/(3(1-nu^2)) and k_t = 4G/(2-nu).
    pub tangential_ratio: f64,
}

impl Elastic for Foundation {
    const CONSERVATIVE: bool = true;

    #[inline(always)]
    fn normal_force(self, coefficient: f64, overlap: f64, area: f64) -> f64 {
        coefficient * overlap * area
    }

    #[inline(always)]
    fn normal_stiffness(self, coefficient: f64, _: f64, area: f64) -> f64 {
        coefficient * area
    }

    #[inline(always)]
    fn tangential_ratio(self) -> f64 {
        self.tangential_ratio
    }

    #[inline(always)]
    fn normal_energy(self, coefficient: f64, overlap: f64, area: f64) -> f64 {
        0.5 * coefficient * overlap * overlap * area
    }

    fn yield_overlap(self, coefficient: f64, hardness: f64, _: f64) -> f64 {
        hardness / coefficient
    }
}

impl Elastic for HertzNodes {
    const CONSERVATIVE: bool = false;

    #[inline(always)]
    fn normal_force(self, coefficient: f64, overlap: f64, _: f64) -> f64 {
        coefficient * overlap * overlap.sqrt()
    }

    #[inline(always)]
    fn normal_stiffness(self, coefficient: f64, overlap: f64, _: f64) -> f64 {
        1.5 * coefficient * overlap.sqrt()
    }

    #[inline(always)]
    fn tangential_ratio(self) -> f64 {
        self.tangential_ratio
    }

    #[inline(always)]
    fn normal_energy(self, coefficient: f64, overlap: f64, _: f64) -> f64 {
        0.4 * coefficient * overlap * overlap * overlap.sqrt()
    }

    fn yield_overlap(self, coefficient: f64, hardness: f64, area: f64) -> f64 {
        (area * hardness / coefficient).powf(2.0 / 3.0)
    }
}

/// The law `E` without friction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Smooth<E>(pub E);

impl<E: Elastic> Elastic for Smooth<E> {
    const CONSERVATIVE: bool = E::CONSERVATIVE;
    const RUBS: bool = false;

    #[inline(always)]
    fn normal_force(self, coefficient: f64, overlap: f64, area: f64) -> f64 {
        self.0.normal_force(coefficient, overlap, area)
    }

    #[inline(always)]
    fn normal_stiffness(self, coefficient: f64, overlap: f64, area: f64) -> f64 {
        self.0.normal_stiffness(coefficient, overlap, area)
    }

    #[inline(always)]
    fn tangential_ratio(self) -> f64 {
        self.0.tangential_ratio()
    }

    #[inline(always)]
    fn normal_energy(self, coefficient: f64, overlap: f64, area: f64) -> f64 {
        self.0.normal_energy(coefficient, overlap, area)
    }

    fn yield_overlap(self, coefficient: f64, hardness: f64, area: f64) -> f64 {
        self.0.yield_overlap(coefficient, hardness, area)
    }
}

impl Foundation {
    pub(crate) fn new(poisson: f64) -> Self {
        Self { tangential_ratio: tangential_ratio(poisson) }
    }
}

impl HertzNodes {
    pub(crate) fn new(poisson: f64) -> Self {
        Self { tangential_ratio: tangential_ratio(poisson) }
    }
}

/// Stiffness of a contact sideways over that along its normal (Mindlin) [-].
fn tangential_ratio(poisson: f64) -> f64 {
    2.0 * (1.0 - poisson) / (2.0 - poisson)
}

/// Least and largest [`calibrated_yield`] over the radius [-]. Where E asks for more or less, it no
/// longer changes the stiffness.
pub const CALIBRATED_YIELD: [f64; 2] = [1e-4, 2e-2];

/// H / k_w [m], the overlap at which `Foundation` without a stiffness of its own yields, under a striker of
/// the reference `radius` [m]: that of Hertz, 9 pi^2 R H^2 (1 - nu^2)^2 / (16 E^2), within
/// [`CALIBRATED_YIELD`].
pub fn calibrated_yield(material: &Material, radius: f64) -> f64 {
    let plane_strain = plane_strain(material);
    let pi = std::f64::consts::PI;
    let hertz = 16.0 * plane_strain * plane_strain / (9.0 * pi * pi * radius * material.hardness);
    let [low, high] = CALIBRATED_YIELD.map(|d| d * radius);
    // No `clamp`, which panics for a radius that is none.
    (material.hardness / hertz).max(low).min(high)
}

/// k_w [Pa/m] of `Foundation` between two worn surfaces, by the laws of the one whose nodes they are;
/// infinity for another law.
pub(crate) fn coefficient_of_two(surface: &Surface, other: &Surface) -> f64 {
    match surface.laws().elastic {
        ElasticLaw::Foundation { stiffness } => {
            stiffness.unwrap_or_else(|| calibrated(surface, other.size()))
        }
        _ => f64::INFINITY,
    }
}

/// E / (1 - nu^2) [Pa]; zero for a material without a modulus.
fn plane_strain(material: &Material) -> f64 {
    material.young.unwrap_or(0.0) / (1.0 - material.poisson * material.poisson)
}

/// k_w [Pa/m] calibrated for a striker of the reference `radius` [m].
fn calibrated(surface: &Surface, radius: f64) -> f64 {
    let material = &surface.laws.material;
    // On a solid that is smaller than the striker, the contact is as small as the solid.
    material.hardness / calibrated_yield(material, radius.min(surface.size()))
}

/// The elastic coefficient of `piece` against `surface`: k_w [Pa/m], K sqrt(R_eff) [N/m^1.5], or
/// infinity for `Rigid`.
pub(crate) fn coefficient(surface: &Surface, piece: &Piece) -> f64 {
    let laws = &surface.laws;
    let material = &laws.material;
    let plane_strain = plane_strain(material);
    match laws.elastic {
        ElasticLaw::Foundation { stiffness: Some(stiffness) } => stiffness,
        ElasticLaw::Foundation { stiffness: None } => calibrated(surface, reference_radius(piece)),
        ElasticLaw::HertzNodes { node_radius, convention } => {
            let doubled = match convention {
                HertzConvention::ElasticPair => 1.0,
                HertzConvention::RigidBody => 2.0,
            };
            let effective = match piece {
                Piece::Ball(ball) => node_radius * ball.radius / (node_radius + ball.radius),
                Piece::Hull(_) => node_radius,
            };
            doubled * 2.0 / 3.0 * plane_strain * effective.sqrt()
        }
        ElasticLaw::Rigid => f64::INFINITY,
    }
}

/// R of the calibration [m]: a ball's own radius, the radius of a hull's volume-equivalent ball.
pub fn reference_radius(piece: &Piece) -> f64 {
    match piece {
        Piece::Ball(ball) => ball.radius,
        Piece::Hull(hull) => ball_radius(hull.volume()),
    }
}

/// Radius of a ball of this `volume` [m3] [m].
pub fn ball_radius(volume: f64) -> f64 {
    (volume * 0.75 / std::f64::consts::PI).cbrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::TriangleMesh;
    use crate::shape::Ball;
    use crate::surface::SurfaceLaws;
    use nalgebra::{Point3, Vector3};

    /// Fails for a calibration by the size of a floor on which a small body wears.
    #[test]
    fn a_large_body_is_as_stiff_as_one_of_the_size_of_the_solid() {
        let material = Material {
            hardness: 1e8,
            shear_ratio: 0.25,
            young: Some(2e9),
            poisson: 0.3,
            friction: 0.0,
        };
        let mesh = TriangleMesh::cuboid(Vector3::repeat(0.01), 0.002).expect("a cube");
        let cube = Surface::mesh(&mesh, SurfaceLaws::of(material)).expect("a surface");
        let ball = |radius| Piece::Ball(Ball { centre: Point3::origin(), radius });
        let size = (8e-6 * 0.75 / std::f64::consts::PI).cbrt();
        let [floor, same, small] = [1.0, size, 0.5 * size].map(|r| coefficient(&cube, &ball(r)));
        assert!((floor / same - 1.0).abs() < 1e-9, "{floor:e} {same:e}");
        assert!((small / same - 2.0).abs() < 1e-9, "{small:e} {same:e}");
    }
}
