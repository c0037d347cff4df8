//! Renewal of a solid: time per node where a side of it has worn.
//!
//! `cargo bench -p abrade --bench renewal`. There is no bare loop beside it: what a renewal costs
//! is the search for a sound mesh, not arithmetic per node.

#[path = "impacts/sampling.rs"]
mod sampling;

use std::hint::black_box;
use std::time::Instant;

use abrade::{
    Body, ElasticLaw, Encounter, EncounterSettings, FlowLaw, Hull, Loads, Material, Placed, Shape,
    State, Surface, SurfaceLaws, TriangleMesh, Until, cuboid_vertices,
};
use criterion::BatchSize;
use nalgebra::{Isometry3, Point3, Vector3};

use sampling::criterion;

/// Runs, of which the fastest counts.
const RUNS: usize = 5;

fn main() {
    let mut criterion = criterion(2, 10);
    let cube = TriangleMesh::cuboid(Vector3::repeat(0.5), 0.05).expect("a cube");
    let sphere = TriangleMesh::sphere(0.5, 0.05).expect("a sphere");
    println!("{:28} {:>8} {:>8} {:>12}", "solid", "nodes", "worn", "us per node");
    for (name, mesh) in [("cube", cube), ("sphere", sphere)] {
        let worn = struck(&mesh);
        let name = format!("renewal of a {name}");
        let (mut least, mut worn_nodes) = (f64::INFINITY, 0);
        for _ in 0..RUNS {
            let mut surface = worn.clone();
            let start = Instant::now();
            worn_nodes = black_box(surface.renew().expect("a renewal")).worn_nodes;
            least = least.min(1e6 * start.elapsed().as_secs_f64());
        }
        let nodes = worn.nodes().len();
        println!("{name:28} {nodes:>8} {worn_nodes:>8} {:>12.2}", least / nodes as f64);
        criterion.bench_function(&name, |bencher| {
            bencher.iter_batched_ref(
                || worn.clone(),
                |surface| surface.renew().expect("a renewal"),
                BatchSize::PerIteration,
            );
        });
    }
    criterion.final_summary();
}

/// The surface of `mesh` after a wide plate has come down on it.
fn struck(mesh: &TriangleMesh) -> Surface {
    let material =
        Material { hardness: 1.0, shear_ratio: 0.25, young: None, poisson: 0.3, friction: 0.0 };
    let laws = SurfaceLaws {
        elastic: ElasticLaw::Rigid,
        flow: FlowLaw::NormalPressure {},
        ..SurfaceLaws::of(material)
    };
    let mut surface = Surface::mesh(mesh, laws).expect("a surface");
    let points = cuboid_vertices(&Vector3::new(1.5, 1.5, 0.1));
    let (hull, inertia, _) = Hull::solid(&points, 1.0).expect("a plate");
    let top = surface.bounds()[1].z;
    let mut state = State::at(Point3::new(0.0, 0.0, top + 0.1 + 1e-5));
    state.velocity.z = -0.05;
    let mut body = Body { shape: Shape::hull(hull), inertia, state, rotation_locked: true };
    let mut encounter =
        Encounter::new(&body, [&surface], EncounterSettings::default()).expect("laws");
    let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
    encounter
        .advance(&mut body, &mut placed, &Loads::default(), 1e9, Until::FirstExit, &mut ())
        .expect("a blow");
    surface
}
