//! How large a scene is: nodes, memory, and about how long it runs. Orders of magnitude, from what
//! its bodies do and the stated costs; nothing is built.

use std::collections::BTreeMap;

use abrade::{HexStrip, TriangleMesh};

use crate::check::Checked;
use crate::place;

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
/// Seconds of a contact step, beside its nodes.
const CONTACT_STEP: f64 = 1e-5;

/// Size of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Size {
    /// Surfaces by name.
    pub surfaces: BTreeMap<String, SurfaceSize>,
    /// Memory of the nodes [bytes].
    pub memory: f64,
    /// Estimated contact steps of the run; within a factor of ten for the scenes that come with
    /// abrade.
    pub steps: f64,
    /// Estimated time of the run, from its steps and the nodes of each; an order of magnitude [s].
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
        let work = self.work(&surfaces);
        let contacts = work.steps * CONTACT_STEP + work.evaluations * EVALUATE_NODE;
        Size { memory, steps: work.steps, seconds: laying + contacts, surfaces }
    }
}
