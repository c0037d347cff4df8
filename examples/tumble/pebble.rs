//! How the pebble is thrown, measured and written.

use std::error::Error;
use std::path::Path;
use std::{fs, io};

use abrade::{MeshError, Surface, TriangleMesh};
use abrade_rapier3d::rapier::prelude::*;
use abrade_rapier3d::scalar;
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

/// Numbers that follow no pattern.
pub struct Numbers(pub u64);

impl Numbers {
    /// A vector of the cube from -1 to 1.
    fn vector(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| {
            let next = self.0.wrapping_mul(6_364_136_223_846_793_005);
            self.0 = next.wrapping_add(1_442_695_040_888_963);
            (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        })
    }
}

/// Turns the body at random and sends it down on the floor, from just above it, at 1 m/s.
pub fn aim(numbers: &mut Numbers, surface: &Surface, body: &mut RigidBody) {
    let turn = UnitQuaternion::from_scaled_axis(numbers.vector() * 3.0);
    let nodes = surface.nodes();
    let height = |i: usize| (turn * nodes.position(i)).z;
    let lowest = (0..nodes.len()).map(height).fold(f64::INFINITY, f64::min);
    let pose = Isometry3::from_parts(Translation3::new(0.0, 0.0, 2e-5 - lowest), turn);
    let velocity = 0.5 * numbers.vector() - Vector3::z();
    body.set_position(scalar::to_pose(&pose), true);
    body.set_linvel(scalar::to_vector(&velocity), true);
    body.set_angvel(scalar::to_vector(&(20.0 * numbers.vector())), true);
}

/// The pebble after a throw.
pub struct Point {
    pub throw: u32,
    /// Of the mesh [m3].
    pub volume: f64,
    /// Area of a ball of that volume over that of the mesh [-].
    pub sphericity: f64,
    /// Sum of rest area times depth over all nodes and renewals [m3].
    pub charged: f64,
}

impl Point {
    /// An error for a mesh that is not closed, or that crosses itself.
    pub fn of(surface: &Surface, throw: u32) -> Result<Self, MeshError> {
        let nodes = surface.nodes();
        let corners = (0..nodes.len()).map(|i| nodes.position(i)).collect();
        let mesh = TriangleMesh::new(corners, surface.triangles())?;
        let volume = mesh.volume();
        let sphericity = (36.0 * std::f64::consts::PI * volume * volume).cbrt() / mesh.area();
        Ok(Self { throw, volume, sphericity, charged: surface.wear_volume() })
    }

    /// Share by which the volume lost since `first` differs from the one charged.
    pub fn miss(&self, first: &Self) -> f64 {
        ((first.volume - self.volume) / self.charged - 1.0).abs()
    }
}

/// Writes the mesh, the curve, and mass, centre and inertia as the rigid body has them.
pub fn write(
    folder: &Path,
    surface: &Surface,
    body: &RigidBody,
    curve: &[Point],
) -> Result<(), Box<dyn Error>> {
    fs::create_dir_all(folder)?;
    let mesh = folder.join("pebble.obj");
    abrade_report::mesh_files::write_obj(&mesh, surface.nodes(), &surface.triangles())?;
    let mut rows = String::from("throw,volume_m3,sphericity,charged_m3\n");
    for Point { throw, volume, sphericity, charged } in curve {
        rows += &format!("{throw},{volume:e},{sphericity},{charged:e}\n");
    }
    fs::write(folder.join("curve.csv"), rows)?;
    Ok(weigh(&folder.join("pebble.json"), body)?)
}

fn weigh(path: &Path, body: &RigidBody) -> io::Result<()> {
    let properties = body.mass_properties().local_mprops;
    let tensor = scalar::matrix(&properties.reconstruct_inertia_matrix());
    let (mass, centre) = (properties.mass(), scalar::vector(properties.local_com));
    let row = |v: Vector3<f64>| format!("[{:e}, {:e}, {:e}]", v.x, v.y, v.z);
    let rows: Vec<String> = tensor.column_iter().map(|column| row(column.into())).collect();
    let (centre, rows) = (row(centre), rows.join(", "));
    let text =
        format!("{{\"mass_kg\": {mass:e}, \"centre_m\": {centre}, \"inertia_kg_m2\": [{rows}]}}\n");
    fs::write(path, text)
}
