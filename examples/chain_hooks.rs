//! The embedder's hooks behind those of the wear: a one-way platform above a wear plate.
//!
//! What to see: the ball falls through the platform, which lets through what comes from above,
//! strikes the plate, and is stopped by the platform on its way up.
//!
//! `cargo run --release --example chain_hooks`

use abrade::{HexStrip, Material, Surface, SurfaceLaws};
use abrade_rapier3d::rapier::prelude::*;
use abrade_rapier3d::{WearEvent, WearSettings, WearWorld, WorldView};

/// Solid from below, open from above.
struct OneWay {
    platform: ColliderHandle,
}

impl PhysicsHooks for OneWay {
    fn filter_contact_pair(&self, context: &PairFilterContext) -> Option<SolverFlags> {
        let falls = |body: Option<RigidBodyHandle>| {
            body.is_some_and(|body| context.bodies[body].linvel().z < 0.0)
        };
        let one_way = [context.collider1, context.collider2].contains(&self.platform);
        let open = one_way && (falls(context.rigid_body1) || falls(context.rigid_body2));
        (!open).then_some(SolverFlags::COMPUTE_RIGID_IMPULSES)
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = PhysicsWorld { gravity: Vector::ZERO, ..PhysicsWorld::default() };
    world.integration_parameters.dt = 1.0 / 240.0;
    let proxy = ColliderBuilder::cuboid(0.01, 0.01, 0.01).translation(Vector::new(0.0, 0.0, -0.01));
    let proxy = world.colliders.insert(proxy);
    let mut wear = WearWorld::new(WearSettings::default());
    let plate = wear.insert_on_top(plate()?, proxy, &mut world.colliders)?;
    let platform = ColliderBuilder::cuboid(0.1, 0.1, 0.01)
        .translation(Vector::new(0.0, 0.0, 0.2))
        .active_hooks(ActiveHooks::FILTER_CONTACT_PAIRS);
    let hooks = OneWay { platform: world.colliders.insert(platform) };
    let ball = RigidBodyBuilder::dynamic()
        .translation(Vector::new(0.0, 0.0, 0.4))
        .linvel(Vector::new(0.0, 0.0, -12.0));
    let (ball, _) = world.insert(ball, ColliderBuilder::ball(0.003).density(7800.0));

    for step in 0..30 {
        // The step in three parts, as an embedder with a loop of its own writes it.
        let guard = wear.begin_step(WorldView::of(&mut world), &hooks);
        world.step_with_events(&guard, &());
        wear.end_step(WorldView::of(&mut world))?;
        for event in wear.events() {
            if let WearEvent::Ended { volume, .. } = event {
                println!("step {step}: struck the plate, {:.2e} mm3 worn", 1e9 * volume);
            }
        }
    }
    let z = world.bodies[ball].translation().z;
    println!("the ball is held at z = {z:.3} m, below the platform's 0.19 m");
    println!("worn in all: {:.2e} mm3", 1e9 * wear[plate].wear_volume());
    Ok(())
}

fn plate() -> Result<Surface, abrade::SurfaceError> {
    let material = Material {
        hardness: 1.7e9,
        shear_ratio: 0.25,
        young: Some(200e9),
        poisson: 0.3,
        friction: 0.3,
    };
    let laws = SurfaceLaws::of(material);
    Surface::hex_strip(HexStrip { length: 0.02, width: 0.02, pitch: 0.1e-3, rest_area: None }, laws)
}
