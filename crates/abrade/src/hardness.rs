//! Hardness that differs from node to node: inclusions, hard facing, soft seams. A surface without
//! it has that of its material everywhere.

use std::sync::Arc;

use crate::error::SurfaceError;
use crate::surface::Surface;

/// The hardness of every node over that of the material.
#[derive(Clone, Debug)]
pub(crate) struct HardnessMap {
    /// One per node, finite and above zero [-].
    factors: Vec<f32>,
    least: f32,
}

impl Surface {
    /// Gives node `i` the hardness `factors[i]` times that of the material [-]; its shear hardness
    /// goes with it. Springs stay those of the material, so that a harder node yields at a larger
    /// overlap. Nodes keep their factors in a renewal, which
    /// may move them along the surface by a part of the pitch. A contact that has begun goes on with those
    /// that it found: give them before.
    ///
    /// # Errors
    /// Not as many factors as nodes; one that is not finite and above zero; a node so soft that the traction of
    /// the surface's adhesion reaches its hardness.
    pub fn set_hardness_factors(&mut self, factors: Vec<f32>) -> Result<(), SurfaceError> {
        let nodes = self.nodes().len();
        if factors.len() != nodes {
            return Err(SurfaceError::HardnessCount { factors: factors.len(), nodes });
        }
        let is_wrong = |factor: &f32| !(factor.is_finite() && *factor > 0.0);
        if let Some(node) = factors.iter().position(is_wrong) {
            return Err(SurfaceError::HardnessFactor { node, factor: factors[node] });
        }
        let least = factors.iter().copied().fold(f32::INFINITY, f32::min);
        if let Some(adhesion) = &self.laws().adhesion {
            let hardness = self.laws().material.hardness * f64::from(least);
            adhesion.below(hardness).map_or(Ok(()), Err)?;
        }
        self.hardness_map = Some(Arc::new(HardnessMap { factors, least }));
        Ok(())
    }

    /// The factors that were given, one per node [-].
    pub fn hardness_factors(&self) -> Option<&[f32]> {
        self.hardness_map.as_ref().map(|map| &*map.factors)
    }

    /// H [Pa] of node `i`.
    pub fn hardness(&self, i: usize) -> f64 {
        self.laws().material.hardness * self.hardness_factor(i)
    }

    /// H [Pa] of the softest node.
    pub fn least_hardness(&self) -> f64 {
        self.laws().material.hardness * self.least_hardness_factor()
    }

    #[inline]
    pub(crate) fn hardness_factor(&self, i: usize) -> f64 {
        self.hardness_map.as_ref().map_or(1.0, |map| f64::from(map.factors[i]))
    }

    pub(crate) fn least_hardness_factor(&self) -> f64 {
        self.hardness_map.as_ref().map_or(1.0, |map| f64::from(map.least))
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Isometry3, Point3, Vector3};

    use super::*;
    use crate::body::{Body, Inertia, State};
    use crate::encounter::{Encounter, EncounterSettings, Loads, Placed, Until};
    use crate::hull::{Hull, Polyhedron};
    use crate::laws::{ElasticLaw, FlowLaw, HertzConvention, Lateral};
    use crate::layout::HexStrip;
    use crate::material::Material;
    use crate::shape::Shape;
    use crate::surface::SurfaceLaws;

    fn plate(hardness: f64, elastic: &ElasticLaw, flow: &FlowLaw) -> Surface {
        let young = Some(100.0);
        let material = Material { hardness, shear_ratio: 0.25, young, poisson: 0.3, friction: 0.3 };
        let (elastic, flow) = (elastic.clone(), flow.clone());
        let laws = SurfaceLaws { elastic, flow, restitution: 1.0, ..SurfaceLaws::of(material) };
        let strip = HexStrip { length: 2.0, width: 1.6, pitch: 0.06, rest_area: None };
        Surface::hex_strip(strip, laws).expect("a plate")
    }

    /// Volume worn by a body that comes in at 45 degrees, and its velocity afterwards.
    fn blow(mut surface: Surface, shape: &Shape) -> (f64, Vector3<f64>) {
        let lift = 0.03 - shape.lowest(&State::at(Point3::origin()).rotation, &Vector3::z());
        let state = State {
            velocity: Vector3::new(0.7, 0.1, -0.7),
            ..State::at(Point3::new(0.01, 0.02, lift))
        };
        let inertia = Inertia::of_ball(0.5, 0.04);
        let mut body = Body { shape: shape.clone(), inertia, state, rotation_locked: false };
        let settings = EncounterSettings::default();
        let mut encounter = Encounter::new(&body, [&surface], settings).expect("an encounter");
        let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
        let loads = Loads::default();
        let until = Until::FirstExit;
        encounter.advance(&mut body, &mut placed, &loads, 20.0, until, &mut ()).expect("a blow");
        (surface.wear_volume(), body.state.velocity)
    }

    /// Fails for a law, a price, a yield overlap or a cap that forgets the factor.
    #[test]
    fn twice_the_factor_is_twice_the_hardness() {
        let ball = Shape::ball(0.5).expect("a ball");
        let (hull, ..) = Hull::solid(&Polyhedron::Cube.vertices(0.8), 1.0).expect("a cube");
        let convention = HertzConvention::ElasticPair;
        let laws = [
            ElasticLaw::Foundation { stiffness: Some(100.0) },
            ElasticLaw::HertzNodes { node_radius: 0.02, convention },
            ElasticLaw::Rigid,
        ];
        let flows =
            [FlowLaw::CapozzaHanley { lateral: Lateral::Projected }, FlowLaw::NormalPressure {}];
        for shape in [ball, Shape::hull(hull)] {
            for elastic in &laws {
                for flow in &flows {
                    let mut mapped = plate(0.5, elastic, flow);
                    let count = mapped.nodes().len();
                    mapped.set_hardness_factors(vec![2.0; count]).expect("factors");
                    assert_eq!(mapped.least_hardness(), 1.0);
                    let (once, twice) =
                        (blow(plate(1.0, elastic, flow), &shape), blow(mapped, &shape));
                    let half = blow(plate(0.5, elastic, flow), &shape);
                    assert_eq!(once, twice, "{elastic:?} {flow:?}");
                    assert!(half.0 > 1.1 * once.0, "{elastic:?} {flow:?}: {half:?} {once:?}");
                }
            }
        }
    }

    /// Fails for a map that names other nodes, or lets a node be weightless to wear.
    #[test]
    fn factors_are_checked() {
        let mut surface = plate(1.0, &ElasticLaw::Rigid, &FlowLaw::NormalPressure {});
        let nodes = surface.nodes().len();
        let error = surface.set_hardness_factors(vec![1.0; 3]);
        assert_eq!(error, Err(SurfaceError::HardnessCount { factors: 3, nodes }));
        for wrong in [0.0, -1.0, f32::INFINITY] {
            let mut factors = vec![1.0; nodes];
            factors[5] = wrong;
            let error = surface.set_hardness_factors(factors);
            assert_eq!(error, Err(SurfaceError::HardnessFactor { node: 5, factor: wrong }));
        }
        assert_eq!((surface.hardness_factors(), surface.hardness(5)), (None, 1.0));
    }
}
