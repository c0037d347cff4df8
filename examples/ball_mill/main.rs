//! A ball mill: a drum with lifters, whose liner wears, and balls that wear each other and the liner.
//!
//! What to see: the liner loses most where the toe of the charge strikes it, low on the side to which
//! the drum turns; balls and liner lose for good, and nothing gains energy. Into a folder it writes
//! where the liner was struck, as a table and a picture, and the worn liner.
//!
//! `cargo run --release --example ball_mill [REVOLUTIONS [FOLDER]]`

mod drum;
mod toe;

use abrade::{Material, Surface, SurfaceLaws, TriangleMesh};
use abrade_rapier3d::rapier::prelude::*;
use abrade_rapier3d::{SurfaceId, WearEvent, WearSettings, WearWorld};
use toe::Toe;

const RADIUS: f64 = 0.01;
const BALLS: usize = 100;
/// Turns of the drum in a second: two thirds of those at which the charge would cling to it.
const SPEED: f32 = 0.9;
const STEP: f32 = 1.0 / 480.0;

/// A ball and its surface.
type Ball = (RigidBodyHandle, SurfaceId);

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let turns: f32 = std::env::args().nth(1).map_or(Ok(0.5), |text| text.parse())?;
    let mut world = PhysicsWorld { gravity: Vector::Y * -9.81, ..PhysicsWorld::default() };
    world.integration_parameters.dt = STEP;
    world.integration_parameters.length_unit = RADIUS as f32;
    let settings = WearSettings { accuracy: 1e-2, ledger: true, ..WearSettings::default() };
    let mut wear = WearWorld::new(settings);
    let liner = drum::insert(&mut world, &mut wear, Surface::mesh(&drum::mesh()?, laws())?)?;
    let balls = fill(&mut world, &mut wear)?;

    let mut toe = Toe::default();
    let (mut fastest, mut worn) = (0.0f32, Worn::of(&wear, liner, &balls));
    for _ in 0..(turns / SPEED / STEP) as u32 {
        wear.step(&mut world, &(), &())?;
        for event in wear.events() {
            if let WearEvent::Ended { body, surface, volume, .. } = event
                && *surface == liner
            {
                toe.add(world.bodies[*body].translation(), *volume);
            }
        }
        let speeds = balls.iter().map(|(ball, _)| world.bodies[*ball].linvel().length());
        fastest = speeds.fold(fastest, f32::max);
        let now = Worn::of(&wear, liner, &balls);
        assert!(now.liner >= worn.liner && now.balls >= worn.balls, "wear is for good");
        worn = now;
    }
    let counters = wear.counters();
    let renewals: u32 = balls.iter().map(|(_, id)| wear[*id].renewals()).sum();
    println!("{turns} turns, {} blows, {renewals} renewals of balls", counters.collision);
    println!("worn: liner {:.0} mm3, balls {:.0} mm3", 1e9 * worn.liner, 1e9 * worn.balls);
    println!("liner struck most at {:.0} degrees, the fastest ball {fastest:.2} m/s", toe.place());
    let ledger = wear.ledger();
    // The drum holds the charge's weight at the length of its radius at most.
    let mass: f32 = balls.iter().map(|(ball, _)| world.bodies[*ball].mass()).sum();
    let angle = std::f64::consts::TAU * f64::from(turns) + 2.0;
    let given = f64::from(mass) * 9.81 * drum::RADIUS * angle;
    println!("worn {:.2} J of at most {given:.0} J given", ledger.wear);
    println!("numerical {:.1e} J", ledger.numerical());
    assert!(ledger.wear < given && ledger.numerical().abs() < 5e-3 * ledger.wear);
    // From the top of the drum to its bottom, on top of the speed of its wall.
    let limit = (4.0 * 9.81 * drum::RADIUS as f32).sqrt() + SPEED * 6.3 * drum::RADIUS as f32;
    assert!(fastest < limit, "no ball gets faster than its fall makes it: {fastest} m/s");
    let inside = |(ball, _): &Ball| world.bodies[*ball].translation().truncate().length();
    let farthest = balls.iter().map(inside).fold(0.0, f32::max);
    assert!(f64::from(farthest) < drum::RADIUS, "nothing gets through the liner");
    match std::env::args().nth(2) {
        Some(folder) => toe.write(folder.as_ref(), &wear[liner]),
        None => Ok(()),
    }
}

/// Volumes worn off [m3].
struct Worn {
    liner: f64,
    balls: f64,
}

impl Worn {
    fn of(wear: &WearWorld, liner: SurfaceId, balls: &[Ball]) -> Self {
        let balls = balls.iter().map(|(_, id)| wear[*id].wear_volume()).sum();
        Self { liner: wear[liner].wear_volume(), balls }
    }
}

/// Layers of balls in the drum.
fn fill(
    world: &mut PhysicsWorld,
    wear: &mut WearWorld,
) -> Result<Vec<Ball>, Box<dyn std::error::Error>> {
    let mesh = TriangleMesh::sphere(RADIUS, RADIUS / 8.0)?;
    let (apart, row) = (2.1 * RADIUS as f32, 8);
    let place = |number: usize| {
        let [column, across, layer] = [number % row, number / row % 2, number / row / 2];
        let z = (across as f32 - 0.5) * apart;
        Vector::new((column as f32 - 3.5) * apart, (layer as f32 - 4.0) * apart, z)
    };
    let ball = |number: usize| {
        let proxy = ColliderBuilder::ball(RADIUS as f32).density(7800.0).friction(0.4);
        let body = RigidBodyBuilder::dynamic().translation(place(number)).can_sleep(false);
        let (body, proxy) = world.insert(body, proxy);
        let surface = Surface::mesh(&mesh, laws())?;
        Ok((body, wear.insert(surface, proxy, &mut world.colliders)?))
    };
    (0..BALLS).map(ball).collect()
}

fn laws() -> SurfaceLaws {
    let (hardness, young) = (2e7, Some(1e9));
    let material = Material { hardness, shear_ratio: 0.25, young, poisson: 0.3, friction: 0.4 };
    SurfaceLaws::of(material)
}
