//! How large a scene is: nodes, memory, and about how long it runs. Orders of magnitude, from the
//! energy of each body and the stated costs; nothing is built.

use std::collections::BTreeMap;

use abrade::{ElasticLaw, HexStrip, Material, TriangleMesh};

use crate::check::Checked;
use crate::place;
use crate::scene::{Motion, SceneBody, SceneSurface, Solution};
use crate::solid::Solid;

/// Bytes per node: position, normal, area, depth, and its place in the grid.
const NODE_BYTES: f64 = 90.0;
/// Bytes per node of a closed surface while it is built: also its facets and the trees over them.
const MESH_NODE_BYTES: f64 = 1500.0;
/// Seconds to lay a node.
const LAY_NODE: f64 = 1e-7;
/// Seconds to lay a node of a closed surface.
const LAY_MESH_NODE: f64 = 3e-5;
/// Seconds to take a node through the laws once.
const EVALUATE_NODE: f64 = 3e-7;
/// Steps of an oblique contact at an accuracy of 3e-3.
const STEPS_OF_CONTACT: f64 = 40.0;

/// Size of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Size {
    /// Surfaces by name.
    pub surfaces: BTreeMap<String, SurfaceSize>,
    /// Memory of the nodes [bytes].
    pub memory: f64,
    /// Estimated time of the run, within a factor of ten [s].
    pub seconds: f64,
}

/// Size of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceSize {
    /// Number of nodes.
    pub nodes: f64,
    /// Columns, along x, and rows, along y, of a plate.
    pub columns_rows: Option<[f64; 2]>,
    /// Distance of neighbouring nodes [m].
    pub pitch: f64,
    /// Area a node stands for [m2].
    pub rest_area: f64,
}

impl SurfaceSize {
    fn of_strip(strip: &HexStrip) -> Self {
        let [columns, rows] = strip.columns_rows();
        let pitch = strip.pitch;
        let rest_area = strip.rest_area.unwrap_or(0.75f64.sqrt() * pitch * pitch);
        Self { nodes: columns * rows, columns_rows: Some([columns, rows]), pitch, rest_area }
    }

    fn of_mesh(mesh: &TriangleMesh) -> Self {
        let nodes = mesh.vertices().len() as f64;
        Self { nodes, columns_rows: None, pitch: mesh.pitch(), rest_area: mesh.area() / nodes }
    }

    fn bytes(&self) -> f64 {
        self.nodes * if self.columns_rows.is_some() { NODE_BYTES } else { MESH_NODE_BYTES }
    }

    /// Time to lay the nodes [s].
    fn seconds(&self) -> f64 {
        self.nodes * if self.columns_rows.is_some() { LAY_NODE } else { LAY_MESH_NODE }
    }
}

impl Checked {
    /// Sizes the scene.
    pub fn size(&self) -> Size {
        let sized = self.scene.surfaces.iter().filter_map(|(name, surface)| {
            let size = match self.meshes.get(name) {
                Some(mesh) => SurfaceSize::of_mesh(mesh),
                None => SurfaceSize::of_strip(&place::strip(&surface.geometry)?),
            };
            Some((name.clone(), size))
        });
        let surfaces: BTreeMap<_, _> = sized.collect();
        let memory = surfaces.values().map(SurfaceSize::bytes).sum();
        let laying: f64 = surfaces.values().map(SurfaceSize::seconds).sum();
        let contacts: f64 = self
            .scene
            .bodies
            .iter()
            .filter_map(|(name, body)| {
                let (surface_name, surface) = self.met_by(body)?;
                let material = self.scene.materials.get(&surface.material)?;
                let contact = Contact {
                    solid: self.solids.get(name)?,
                    material,
                    surface,
                    size: surfaces.get(surface_name)?,
                    accuracy: self.scene.run.accuracy,
                };
                Some(contact.evaluations(&body.motion) * EVALUATE_NODE)
            })
            .sum();
        Size { memory, seconds: laying + contacts, surfaces }
    }

    /// The surface that a body is placed on, else the first one.
    fn met_by(&self, body: &SceneBody) -> Option<(&String, &SceneSurface)> {
        match body.position.surface() {
            Some(surface) => self.scene.surfaces.get_key_value(surface),
            None => self.scene.surfaces.iter().next(),
        }
    }
}

struct Contact<'a> {
    solid: &'a Solid,
    material: &'a Material,
    surface: &'a SceneSurface,
    size: &'a SurfaceSize,
    accuracy: f64,
}

impl Contact<'_> {
    /// Nodes taken through the laws over the whole motion.
    fn evaluations(&self, motion: &Motion) -> f64 {
        match *motion {
            Motion::Fixed => 0.0,
            Motion::Impact { speed, angle, .. } => {
                self.impact(speed * angle.sin(), speed * angle.cos())
            }
            Motion::Free { velocity: [x, y, z], .. } => self.impact(z.abs(), x.hypot(y)),
            Motion::Drive { indent_to, load, speed, distance, ref solution, .. } => {
                let load = load.unwrap_or(indent_to).max(indent_to);
                let area = load / self.material.hardness;
                let nodes = (area / self.size.rest_area).max(1.0);
                let steps = match solution {
                    Solution::QuasiStatic { increment } => {
                        let increment = increment.unwrap_or(0.125 * self.size.pitch);
                        10.0 * (1.0 + distance / increment)
                    }
                    Solution::Dynamic {} => {
                        let stiffness = self.stiffness() * area;
                        let frequency = (stiffness / self.solid.inertia.mass).sqrt();
                        let time = if speed > 0.0 { distance / speed } else { 0.0 };
                        STEPS_OF_CONTACT + time * frequency / self.step_fraction()
                    }
                };
                nodes * steps
            }
        }
    }

    /// A ball of the body's size that ploughs in until its energy is spent against H.
    fn impact(&self, down: f64, along: f64) -> f64 {
        let radius = self.solid.shape.bounding_radius();
        let hardness = self.material.hardness;
        let pi = std::f64::consts::PI;
        let time = (self.solid.inertia.mass / (2.0 * pi * radius * hardness)).sqrt();
        let (depth, slide) = (down * time, along * time * pi);
        let contact = (2.0 * radius * depth).sqrt().min(radius);
        let nodes = ((pi * contact * contact) / self.size.rest_area).max(1.0);
        let steps = match self.surface.elastic {
            ElasticLaw::Rigid => (depth + slide) / (0.1 * self.size.pitch) + 1.0,
            _ => STEPS_OF_CONTACT * 0.1 / self.step_fraction(),
        };
        nodes * steps
    }

    /// Stiffness of the surface per area [Pa/m].
    fn stiffness(&self) -> f64 {
        match self.surface.elastic {
            ElasticLaw::Foundation { stiffness: Some(stiffness) } => stiffness,
            _ => self.material.hardness / (1e-3 * self.solid.shape.bounding_radius()),
        }
    }

    /// Step times frequency that the accuracy asks for (eta).
    fn step_fraction(&self) -> f64 {
        (0.1 * (self.accuracy / 3e-3).sqrt()).min(0.7)
    }
}
