//! A hail of random convex stones and balls on one plate, at 1/60 s.
//!
//! What to see: how many struck, and the volume they wore. A node pays H for every volume it gives,
//! so that H W (Capozza & Hanley 2022, Eq. 16) stays below the kinetic energy of the hail.
//!
//! `cargo run --release --example gravel`

use abrade::{HexStrip, Material, Surface, SurfaceLaws};
use abrade_rapier3d::rapier::prelude::*;
use abrade_rapier3d::{WearEvent, WearSettings, WearWorld};

const HARDNESS: f64 = 20e6;
const STONES: usize = 40;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = PhysicsWorld { gravity: Vector::Z * -9.81, ..PhysicsWorld::default() };
    // The size of what moves [m].
    world.integration_parameters.length_unit = 0.01;
    world.integration_parameters.normalized_max_linear_velocity = f32::MAX;
    let proxy = ColliderBuilder::cuboid(0.15, 0.15, 0.02).translation(Vector::Z * -0.02);
    let proxy = world.colliders.insert(proxy);
    let mut wear = WearWorld::new(WearSettings::default());
    let plate = wear.insert_on_top(plate()?, proxy, &mut world.colliders)?;

    // Stones meet the plate and not each other: a hail that passes through itself.
    let hail = InteractionGroups::new(Group::GROUP_2, Group::GROUP_1, InteractionTestMode::And);
    let (mut random, mut energy, mut impacts) = (Random(7), 0.0, 0);
    for i in 0..STONES {
        let radius = 0.006 + random.within(0.002).abs();
        let fall = Vector::new(random.within(3.0), random.within(3.0), -10.0);
        let height = 0.05 + 0.02 * i as f32;
        let at = Vector::new(random.within(0.12), random.within(0.12), height);
        let turn = Vector::new(random.within(3.0), random.within(3.0), 0.0);
        let body = RigidBodyBuilder::dynamic().translation(at).rotation(turn).linvel(fall);
        let shape = match i % 3 {
            0 => Some(ColliderBuilder::ball(radius)),
            _ => ColliderBuilder::convex_hull(&random.corners(radius)),
        };
        let shape = shape.ok_or("a flat stone")?.density(2600.0);
        let (stone, _) = world.insert(body, shape.collision_groups(hail));
        let mass = f64::from(world.bodies[stone].mass());
        // What it has when it comes to the plate.
        energy += mass * f64::from(0.5 * fall.length_squared() + 9.81 * height);
    }
    for _ in 0..20 {
        wear.step(&mut world, &(), &())?;
        let events = wear.events().iter();
        impacts += events.filter(|event| matches!(event, WearEvent::Ended { .. })).count();
    }
    let (worn, paid) = (wear[plate].wear_volume(), HARDNESS * wear[plate].wear_volume() / energy);
    println!("{STONES} stones, {impacts} impacts, worn {:.1} mm3", 1e9 * worn);
    println!("H W is {paid:.2} of the kinetic energy of the hail");
    assert!(impacts >= STONES * 3 / 4, "most of the stones strike");
    assert!((0.3..1.0).contains(&paid), "what they lose, they wear");
    Ok(())
}

/// A fixed sequence, the same on every machine.
struct Random(u64);

impl Random {
    /// A number between -limit and limit.
    fn within(&mut self, limit: f32) -> f32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        limit * ((self.0 >> 40) as f32 / (1 << 23) as f32 - 1.0)
    }

    fn corners(&mut self, radius: f32) -> Vec<Vector> {
        let mut corner = || Vector::new(self.within(1.0), self.within(1.0), self.within(1.0));
        (0..14).map(|_| radius * corner().normalize()).collect()
    }
}

fn plate() -> Result<Surface, abrade::SurfaceError> {
    let (hardness, young) = (HARDNESS, Some(1e9));
    let material = Material { hardness, shear_ratio: 0.25, young, poisson: 0.3, friction: 0.3 };
    let strip = HexStrip { length: 0.3, width: 0.3, pitch: 0.5e-3, rest_area: None };
    Surface::hex_strip(strip, SurfaceLaws::of(material))
}
