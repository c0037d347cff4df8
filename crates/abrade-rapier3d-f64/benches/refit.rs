//! What it costs to show a surface to rays after a blow of a ball: the time of
//! `WearWorld::sync_colliders` on plates and spheres of some numbers of nodes.
//!
//! `cargo bench -p abrade-rapier3d-f64 --bench refit` prints for each surface its tiles, how many
//! of them a blow makes stale, and the time of a sync after a blow, of one when nothing has worn,
//! and of one that makes every tile; medians of some blows.

use std::hint::black_box;
use std::time::{Duration, Instant};

use abrade_rapier3d_f64::abrade::{HexStrip, Material, Surface, SurfaceLaws, TriangleMesh};
use abrade_rapier3d_f64::rapier::math::Vector;
use abrade_rapier3d_f64::rapier::prelude::*;
use abrade_rapier3d_f64::{SurfaceId, WearSettings, WearWorld};

/// Radius of the ball, of the sphere, and edge of the plate [m].
const BALL: f64 = 8e-3;
const SPHERE: f64 = 0.05;
const EDGE: f64 = 0.1;
const NODES: [f64; 3] = [5e3, 5e4, 5e5];
const BLOWS: usize = 41;

fn main() {
    println!("surface     nodes  tiles  stale   us: after a blow  nothing worn     all made");
    for (name, make) in [("plate", plate as fn(f64) -> Scene), ("sphere", sphere)] {
        for nodes in NODES {
            let mut scene = make(nodes);
            let tiles = scene.sync();
            let mut stale = Vec::new();
            let blow = (0..BLOWS).map(|_| {
                scene.strike();
                timed(|| stale.push(scene.sync()))
            });
            let blow = median(blow.collect());
            let nothing = median((0..BLOWS).map(|_| timed(|| scene.sync())).collect());
            let all = (0..BLOWS).map(|_| {
                scene.hide();
                timed(|| scene.sync())
            });
            let all = median(all.collect());
            let (count, stale) = (scene.wear[scene.id].nodes().len(), median(stale));
            print!("{name:<8} {count:>8} {tiles:>6} {stale:>6}   ");
            println!("{:>17.1} {:>13.1} {:>12.1}", us(blow), us(nothing), us(all));
        }
    }
}

fn median<T: Ord>(mut values: Vec<T>) -> T {
    values.sort_unstable();
    values.swap_remove(values.len() / 2)
}

fn us(time: Duration) -> f64 {
    1e6 * time.as_secs_f64()
}

fn timed<T>(run: impl FnOnce() -> T) -> Duration {
    let start = Instant::now();
    black_box(run());
    start.elapsed()
}

/// A world with one wear surface, whose top is at `top` [m].
struct Scene {
    world: PhysicsWorld,
    wear: WearWorld,
    id: SurfaceId,
    top: f64,
    blows: u32,
}

impl Scene {
    fn of(surface: Surface, proxy: ColliderBuilder, top: f64) -> Self {
        let mut world = PhysicsWorld { gravity: Vector::ZERO, ..PhysicsWorld::default() };
        world.integration_parameters.dt = 1e-4;
        world.integration_parameters.length_unit = 0.01;
        world.integration_parameters.normalized_max_linear_velocity = 1e5;
        let proxy = world.colliders.insert(proxy);
        let mut wear = WearWorld::new(WearSettings { accuracy: 1e-2, ..WearSettings::default() });
        let id = match top {
            0.0 => wear.insert_on_top(surface, proxy, &mut world.colliders),
            _ => wear.insert(surface, proxy, &mut world.colliders),
        };
        Self { world, wear, id: id.expect("a proxy"), top, blows: 0 }
    }

    fn sync(&mut self) -> usize {
        self.wear.sync_colliders(self.id, &mut self.world.colliders).expect("a proxy")
    }

    /// Removes every query collider.
    fn hide(&mut self) {
        for handle in self.wear.query_colliders(self.id).to_vec() {
            self.world.remove_collider(handle);
        }
    }

    /// One impact of a ball at 35 m/s, where none was lately.
    fn strike(&mut self) {
        self.blows += 1;
        let turn = 2.399_963 * f64::from(self.blows);
        let aside = 0.6 * SPHERE * (f64::from(self.blows % 97) / 97.0).sqrt();
        let lift = (self.top * self.top - aside * aside).max(0.0).sqrt();
        let foot = Vector::new(aside * turn.cos(), aside * turn.sin(), lift);
        let up = if self.top > 0.0 { foot / self.top } else { Vector::Z };
        let before = self.wear[self.id].wear_volume();
        let body =
            RigidBodyBuilder::dynamic().translation(foot + up * (BALL + 1e-5)).linvel(up * -35.0);
        let (ball, _) = self.world.insert(body, ColliderBuilder::ball(BALL).density(2500.0));
        for _ in 0..3 {
            self.wear.step(&mut self.world, &(), &()).expect("an impact");
        }
        assert!(self.wear[self.id].wear_volume() > before, "a blow wears");
        self.world.remove_body(ball);
    }
}

fn laws() -> SurfaceLaws {
    let material = Material {
        hardness: 50e6,
        shear_ratio: 0.25,
        young: Some(2.5e9),
        poisson: 0.3,
        friction: 0.3,
    };
    SurfaceLaws::of(material)
}

fn plate(nodes: f64) -> Scene {
    let surface = Surface::hex_strip(HexStrip::with_nodes(EDGE, EDGE, nodes), laws());
    let proxy = ColliderBuilder::cuboid(0.5 * EDGE, 0.5 * EDGE, 0.01);
    Scene::of(surface.expect("a plate"), proxy, 0.0)
}

fn sphere(nodes: f64) -> Scene {
    // The area of a node in close packing.
    let area = 4.0 * std::f64::consts::PI * SPHERE * SPHERE / nodes;
    let mesh = TriangleMesh::sphere(SPHERE, (area / 0.75f64.sqrt()).sqrt()).expect("a sphere");
    let surface = Surface::mesh(&mesh, laws()).expect("a surface");
    Scene::of(surface, ColliderBuilder::ball(SPHERE), SPHERE)
}
