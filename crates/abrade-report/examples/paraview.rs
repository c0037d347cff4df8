//! Writes a surface and two bodies as ParaView files, to be opened in ParaView or read by vtk.
//!
//! cargo run -p abrade-report --example paraview -- FOLDER

use std::error::Error;
use std::path::Path;

use abrade::{Ball, Nodes, State};
use abrade_report::{Mesh, Series, vtp};
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};

/// A grid of `side` by `side` nodes, 1 mm apart, `deepest` [m] worn in the middle.
fn surface(side: u32, deepest: f64) -> (Nodes, Vec<[u32; 3]>) {
    let (mut nodes, mut triangles) = (Nodes::default(), Vec::new());
    for i in 0..side {
        for j in 0..side {
            let [x, y] = [i, j].map(|k| f64::from(k) * 2.0 / f64::from(side - 1) - 1.0);
            nodes.rest_position.push(Point3::new(f64::from(i), f64::from(j), 0.0) * 1e-3);
            nodes.normal.push(Vector3::z());
            nodes.rest_area.push(1e-6);
            nodes.depth.push(deepest * (1.0 - x * x - y * y).max(0.0));
            if i + 1 < side && j + 1 < side {
                let at = i * side + j;
                triangles.push([at, at + side, at + 1]);
                triangles.push([at + 1, at + side, at + side + 1]);
            }
        }
    }
    (nodes, triangles)
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).ok_or("which folder?")?;
    let folder = Path::new(&folder);
    let turn = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), 0.3);
    let pose = Isometry3::from_parts(Translation3::new(0.1, 0.2, 0.3), turn);
    let ball = Mesh::of_ball(&Ball { centre: Point3::origin(), radius: 2e-3 });
    let corners = [(1.0, 1.0, 1.0), (1.0, -1.0, -1.0), (-1.0, 1.0, -1.0), (-1.0, -1.0, 1.0)];
    let grit = Mesh::of_convex(&corners.map(|(x, y, z)| Point3::new(x, y, z) * 1e-3))?;
    let mut surfaces = Series::new(folder, "surface");
    let mut bodies = Series::new(folder, "bodies");
    for frame in 0..3 {
        let time = 1e-6 * f64::from(frame);
        let (nodes, triangles) = surface(200, 1e-3 * f64::from(frame));
        vtp::write_surface(&surfaces.next_path(), &nodes, None, &pose, &triangles)?;
        surfaces.push(time);
        let state = |x: f64| State { spin: Vector3::y(), ..State::at(Point3::new(x, 0.0, 5e-3)) };
        let placed = [(&ball, &state(0.01)), (&grit, &state(0.03))];
        let placed = placed.map(|(mesh, state)| vtp::PlacedBody { mesh, state });
        vtp::write_bodies(&bodies.next_path(), &placed)?;
        bodies.push(time);
    }
    let (nodes, _) = surface(50, 1e-3);
    vtp::write_surface(&folder.join("points.vtp"), &nodes, None, &Isometry3::identity(), &[])?;
    vtp::write_surface(&folder.join("empty.vtp"), &Nodes::default(), None, &pose, &[])?;
    surfaces.write()?;
    Ok(bodies.write()?)
}
