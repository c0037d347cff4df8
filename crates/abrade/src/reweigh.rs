//! A carrier that has lost material: its new mass, and the motion of what stays.

use nalgebra::{Isometry3, Point3};

use crate::body::Inertia;
use crate::carrier::Carrier;
use crate::encounter::Placed;
use crate::mesh::mass;
use crate::surface::Surface;

impl Surface {
    /// Mass and inertia about the centre of mass of the worn solid at this `density` [kg/m3], in
    /// the surface's frame, and the centre of mass [m]; None for a strip, which bounds no solid.
    /// The cost goes with the number of facets, about 20 nanoseconds for each.
    pub fn mass_properties(&self, density: f64) -> Option<(Inertia, Point3<f64>)> {
        let triangles = self.facets()?;
        let nodes = self.nodes();
        let place = |i: usize| nodes.rest_position[i] - nodes.normal[i] * self.depth(i);
        let vertices: Vec<Point3<f64>> = (0..nodes.len()).map(place).collect();
        Some(mass::of_solid(&vertices, triangles, density))
    }
}

impl Carrier {
    /// Makes the body what is left of it: of this mass and inertia about `centre_local` [m], both
    /// in the frame that lies at `frame`. What stays keeps its motion: the velocity becomes that of
    /// the material at the new centre of mass, v' = v + w x (c' - c), and the spin stays, so that
    /// momentum and angular momentum are those of the material that stays; what is gone has taken
    /// its own along. The body's axes stay as they are. A led body keeps its unbounded mass.
    pub fn reduce_to(
        &mut self,
        frame: &Isometry3<f64>,
        inertia: &Inertia,
        centre_local: &Point3<f64>,
    ) {
        let Self { state, inertia: own, .. } = self;
        let centre = frame * centre_local;
        state.velocity += state.spin.cross(&(centre - state.position));
        state.position = centre;
        if let Some(own) = own {
            let turn = (state.rotation.inverse() * frame.rotation).to_rotation_matrix();
            let tensor = turn * inertia.tensor * turn.inverse();
            *own = Inertia { mass: inertia.mass, tensor };
        }
    }
}

impl Placed<'_> {
    /// Gives the carrier, if there is one, the mass and inertia of the worn solid at this `density`
    /// [kg/m3], as [`Carrier::reduce_to`]. False for a strip, which bounds no solid.
    pub fn reweigh(&mut self, density: f64) -> bool {
        let Some((inertia, centre)) = self.surface.mass_properties(density) else { return false };
        if let Some(carrier) = &mut self.carrier {
            carrier.reduce_to(&self.pose, &inertia, &centre);
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix3, Translation3, UnitQuaternion, Vector3};

    use super::*;
    use crate::body::State;
    use crate::encounter::Loads;
    use crate::material::Material;
    use crate::mesh::TriangleMesh;
    use crate::surface::SurfaceLaws;

    fn block(half: Vector3<f64>) -> Inertia {
        let mass = 8.0 * half.x * half.y * half.z;
        let squares = half.component_mul(&half);
        let moments = (Vector3::repeat(squares.sum()) - squares) * (mass / 3.0);
        Inertia { mass, tensor: Matrix3::from_diagonal(&moments) }
    }

    /// Momentum and angular momentum about the origin.
    fn momenta(carrier: &Carrier) -> [Vector3<f64>; 2] {
        let Carrier { state, inertia, .. } = carrier;
        let inertia = inertia.expect("a free body");
        let p = state.velocity * inertia.mass;
        let spin = state.rotation.inverse_transform_vector(&state.spin);
        [p, state.position.coords.cross(&p) + state.rotation * (inertia.tensor * spin)]
    }

    /// A block that flies and turns, in a frame of its own at the block's middle.
    fn flying() -> (Carrier, Isometry3<f64>) {
        let state = State {
            position: Point3::new(4.0, 1.0, -2.0),
            rotation: UnitQuaternion::from_scaled_axis(Vector3::new(0.7, 0.2, -0.5)),
            velocity: Vector3::new(1.0, -2.0, 0.5),
            spin: Vector3::new(3.0, 1.0, -2.0),
        };
        let frame = Isometry3::from_parts(
            Translation3::from(state.position.coords),
            UnitQuaternion::from_scaled_axis(Vector3::new(-0.2, 1.1, 0.6)),
        );
        let turn = (state.rotation.inverse() * frame.rotation).to_rotation_matrix();
        let inertia = block(Vector3::new(0.3, 0.2, 0.1));
        let tensor = turn * inertia.tensor * turn.inverse();
        let inertia = Some(Inertia { tensor, ..inertia });
        (Carrier { state, inertia, loads: Loads::default() }, frame)
    }

    /// Fails for a centre that moves without its velocity, for a tensor that is left in the
    /// surface's frame, and for a spin scaled so that the whole keeps its angular momentum: the two
    /// parts of a block that is cut must together have the momenta of the block.
    #[test]
    fn the_parts_of_a_block_have_the_momenta_of_the_block() {
        let (whole, frame) = flying();
        let half = |x: f64| block(Vector3::new(x, 0.2, 0.1));
        let [mut stays, mut goes] = [whole; 2];
        stays.reduce_to(&frame, &half(0.25), &Point3::new(-0.05, 0.0, 0.0));
        goes.reduce_to(&frame, &half(0.05), &Point3::new(0.25, 0.0, 0.0));
        let [all, stays, goes] = [whole, stays, goes].map(|carrier| momenta(&carrier));
        for k in 0..2 {
            let miss = (stays[k] + goes[k] - all[k]).norm();
            assert!(miss < 1e-12 * all[k].norm(), "{k}: {miss}");
        }
    }

    /// Fails for a mass that is that of the undeformed solid, and for a led body that gets one.
    #[test]
    fn a_worn_block_weighs_what_is_left_of_it() {
        let half = Vector3::new(0.3, 0.2, 0.1);
        let cuboid = TriangleMesh::cuboid(half, 0.05).expect("a block");
        let laws = SurfaceLaws::of(Material {
            hardness: 1.0,
            shear_ratio: 0.25,
            young: Some(100.0),
            poisson: 0.3,
            friction: 0.0,
        });
        let mut surface = Surface::mesh(&cuboid, laws).expect("a surface");
        let face = |i: &u32| surface.nodes().rest_position[*i as usize].x == 0.3;
        let along = |i: &u32| surface.nodes().normal[*i as usize].x == 1.0;
        let flat: Vec<u32> = (0..surface.nodes().len() as u32).filter(face).filter(along).collect();
        flat.iter().for_each(|&i| surface.sink(i, 1e-3));
        let (carrier, pose) = flying();
        let mut placed = Placed { surface: &mut surface, pose, carrier: Some(carrier), skin: None };
        assert!(placed.reweigh(1.0));
        let after = placed.carrier.expect("a carrier");
        let lost = carrier.inertia.expect("mass").mass - after.inertia.expect("mass").mass;
        let shift = pose.inverse_transform_point(&after.state.position);
        assert!((lost / placed.surface.wear_volume() - 1.0).abs() < 1e-9, "{lost}");
        assert!(shift.x < -1e-4 && shift.y.abs() < 1e-12, "{shift}");
        placed.carrier = Some(Carrier { inertia: None, ..carrier });
        assert!(placed.reweigh(1.0) && placed.carrier.is_some_and(|c| c.inertia.is_none()));
    }
}
