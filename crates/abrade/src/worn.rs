//! What has been worn off a surface, by cause.

use std::ops::AddAssign;

use crate::laws::{ATTACK_BINS, Debris};

/// Volumes worn off a surface [m3], and its largest load.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub struct Worn {
    /// Displaced by the normal flow.
    pub normal: f64,
    /// Displaced by the lateral flow.
    pub lateral: f64,
    /// Lost to slip under load, by Archard's law; all of it is debris.
    pub archard: f64,
    /// Broken off as overhangs, unpaid by the ledger.
    pub chip: f64,
    /// Debris: of what flows by the surface's removal rule, and all of what is rubbed or breaks off.
    pub removed: f64,
    /// Displaced by faces of each angle of attack, from 0 on in steps of 5 degrees; chips and what is
    /// rubbed off left out. Only where the removal rule asks for that angle, else zeros.
    pub by_attack: [f64; ATTACK_BINS],
    /// Largest depth of a node [m], renewals included.
    pub max_depth: f64,
    /// Largest total force along minus the normals [N].
    pub peak_normal_force: f64,
    /// Largest number of nodes that carried force at one instant.
    pub peak_touching: usize,
    /// Largest sum of the effective areas of nodes in normal flow [m2] (Eq. 19).
    pub indented_area: f64,
}

impl Worn {
    /// W_V [m3] as the sum of its parts.
    pub fn displaced(&self) -> f64 {
        self.normal + self.lateral + self.archard + self.chip
    }

    /// Books a `volume` [m3] lost to slip.
    pub(crate) fn rub_off(&mut self, volume: f64) {
        self.archard += volume;
        self.removed += volume;
    }

    /// Books an overhang of a `volume` [m3] that breaks off.
    pub(crate) fn break_off(&mut self, volume: f64) {
        self.chip += volume;
        self.removed += volume;
    }

    /// Books a displaced `volume` [m3] of which `debris` tells what leaves.
    pub(crate) fn take_off(&mut self, volume: f64, debris: &Debris) {
        self.removed += volume * debris.share;
        if let Some(bin) = debris.bin {
            self.by_attack[bin] += volume;
        }
    }
}

impl AddAssign for Worn {
    fn add_assign(&mut self, other: Self) {
        self.normal += other.normal;
        self.lateral += other.lateral;
        self.archard += other.archard;
        self.chip += other.chip;
        self.removed += other.removed;
        for (sum, more) in self.by_attack.iter_mut().zip(other.by_attack) {
            *sum += more;
        }
        self.max_depth = self.max_depth.max(other.max_depth);
        self.peak_normal_force = self.peak_normal_force.max(other.peak_normal_force);
        self.peak_touching = self.peak_touching.max(other.peak_touching);
        self.indented_area = self.indented_area.max(other.indented_area);
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Isometry3, Point3, Vector3};

    use crate::body::{Body, State};
    use crate::encounter::{Encounter, EncounterSettings, Instant, Loads, Observer, Placed, Until};
    use crate::hull::{Hull, Polyhedron};
    use crate::laws::ElasticLaw;
    use crate::layout::HexStrip;
    use crate::material::Material;
    use crate::shape::Shape;
    use crate::surface::{Surface, SurfaceLaws};

    /// Largest force along the normal of a plate, and of any direction [N].
    #[derive(Default)]
    struct Seen {
        along: f64,
        whole: f64,
    }

    impl Observer for Seen {
        fn observe(&mut self, instant: &Instant<'_, '_>) {
            self.along = self.along.max(instant.force.z);
            self.whole = self.whole.max(instant.force.norm());
        }
    }

    /// Fails for a force of faces that is counted with what friction and steep faces exert along the surface.
    #[test]
    fn the_peak_of_faces_is_the_part_along_the_normal() {
        for elastic in [ElasticLaw::Rigid, ElasticLaw::Foundation { stiffness: Some(100.0) }] {
            let (hull, inertia, _) =
                Hull::solid(&Polyhedron::Octahedron.vertices(0.5), 0.04).expect("a hull");
            let young = Some(100.0);
            let material =
                Material { hardness: 1.0, shear_ratio: 0.25, young, poisson: 0.3, friction: 1.2 };
            let laws = SurfaceLaws { elastic, ..SurfaceLaws::of(material) };
            let strip = HexStrip { length: 3.0, width: 1.6, pitch: 0.04, rest_area: None };
            let mut surface = Surface::hex_strip(strip, laws).expect("a plate");
            let shape = Shape::hull(hull);
            let mut state = State::at(Point3::new(-0.5, 0.0, 0.0));
            state.position.z = 1e-6 - shape.lowest(&state.rotation, &Vector3::z());
            state.velocity = Vector3::new(2.0, 0.0, -0.7);
            let mut body = Body { shape, inertia, state, rotation_locked: true };
            let settings = EncounterSettings::default();
            let mut encounter = Encounter::new(&body, [&surface], settings).expect("an encounter");
            let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
            let mut seen = Seen::default();
            let (loads, until) = (Loads::default(), Until::FirstExit);
            encounter
                .advance(&mut body, &mut placed, &loads, 20.0, until, &mut seen)
                .expect("a blow");
            let Seen { along, whole } = seen;
            let peak = surface.worn().peak_normal_force;
            assert!((peak / along - 1.0).abs() < 1e-9, "{peak} {along}");
            assert!(whole > 1.3 * along, "{whole} {along}");
        }
    }
}
