//! A surface as bytes hold it: its lattice or its mesh is laid out anew.

use std::sync::Arc;

use nalgebra::Point3;

use crate::mesh::TriangleMesh;
use crate::nodes::Nodes;
use crate::renewal::Past;
use crate::state::{Fault, finite, not_negative, positive, require};
use crate::sunk::Sunk;
use crate::surface::{Surface, SurfaceLaws};
use crate::worn::Worn;

/// Where the nodes lie.
#[derive(serde::Serialize, serde::Deserialize)]
enum LayoutState {
    Strip { columns_rows: [usize; 2], area: f64 },
    Mesh { vertices: Vec<Point3<f64>>, triangles: Vec<[u32; 3]> },
}

/// What is written of a surface.
#[derive(serde::Serialize, serde::Deserialize)]
pub(crate) struct SurfaceState {
    layout: LayoutState,
    pitch: f64,
    laws: SurfaceLaws,
    worn: Worn,
    gain: Worn,
    depth: Vec<f64>,
    past: Option<Past>,
    sunk: Option<Vec<u32>>,
    hardness: Option<Vec<f32>>,
}

impl From<Surface> for SurfaceState {
    fn from(surface: Surface) -> Self {
        let layout = match (surface.columns_rows(), surface.facets()) {
            (Some(columns_rows), _) => {
                LayoutState::Strip { columns_rows, area: surface.nodes().rest_area[0] }
            }
            (None, facets) => LayoutState::Mesh {
                vertices: surface.nodes().rest_position.clone(),
                triangles: facets.unwrap_or_default().to_vec(),
            },
        };
        // A leaf is written as the surface that it has become.
        let depth = (0..surface.nodes().len()).map(|i| surface.depth(i)).collect();
        Self {
            layout,
            pitch: surface.pitch(),
            hardness: surface.hardness_factors().map(<[f32]>::to_vec),
            laws: surface.laws,
            worn: surface.worn,
            gain: surface.gain,
            depth,
            past: surface.past.map(Arc::unwrap_or_clone),
            sunk: surface.sunk.map(|sunk| sunk.sorted()),
        }
    }
}

impl TryFrom<SurfaceState> for Surface {
    type Error = Fault;

    fn try_from(state: SurfaceState) -> Result<Self, Fault> {
        let SurfaceState { layout, pitch, laws, worn, gain, depth, past, sunk, hardness } = state;
        require(positive(pitch), "the pitch of a surface is out of range")?;
        require(laws.check().is_empty(), "the laws of a surface are out of range")?;
        let whole = |w: &Worn| {
            finite(&[w.normal, w.lateral, w.archard, w.chip, w.removed]) && finite(&w.by_attack)
        };
        let fine = whole(&worn) && whole(&gain) && depth.iter().all(|&depth| not_negative(depth));
        require(fine, "a depth is below zero or not finite")?;
        let mut surface = match layout {
            LayoutState::Strip { columns_rows, area } => {
                strip(columns_rows, pitch, area, depth.len(), laws)?
            }
            LayoutState::Mesh { vertices, triangles } => mesh(vertices, triangles, laws)?,
        };
        require(surface.nodes.len() == depth.len(), "a surface lacks nodes")?;
        if let Some(past) = past {
            let depths = past.depth.iter().all(|&depth| depth.is_finite());
            let sums = not_negative(past.volume) && past.depth.len() == depth.len();
            let fine = depths && sums && surface.can_be_renewed();
            require(fine, "what a surface has worn before it was renewed is out of range")?;
            surface.past = Some(Arc::new(past));
        }
        if let Some(nodes) = sunk {
            let fault = Fault("the nodes of a surface that have sunk are out of range");
            surface.sunk = Some(Box::new(Sunk::of(nodes, depth.len()).ok_or(fault)?));
        }
        if let Some(factors) = hardness {
            let fault = Fault("the hardness of a node is out of range");
            surface.set_hardness_factors(factors).map_err(|_| fault)?;
        }
        (surface.worn, surface.gain) = (worn, gain);
        surface.deepest = depth.iter().copied().fold(0.0, f64::max);
        surface.nodes.depth = depth;
        Ok(surface)
    }
}

fn strip(
    columns_rows: [usize; 2],
    pitch: f64,
    area: f64,
    nodes: usize,
    laws: SurfaceLaws,
) -> Result<Surface, Fault> {
    let [columns, rows] = columns_rows;
    let count = columns.checked_mul(rows);
    require(count == Some(nodes) && count != Some(0), "a surface lacks nodes")?;
    let extent = pitch * columns.max(rows) as f64;
    require(positive(area) && extent.is_finite(), "the extent of a surface is out of range")?;
    Ok(Surface::lattice(columns_rows, pitch, area, laws))
}

fn mesh(
    vertices: Vec<Point3<f64>>,
    triangles: Vec<[u32; 3]>,
    laws: SurfaceLaws,
) -> Result<Surface, Fault> {
    let fault = Fault("the mesh of a surface bounds no solid");
    let mesh = TriangleMesh::new(vertices, triangles).map_err(|_| fault)?;
    let nodes: Nodes = mesh.nodes();
    Surface::closed(nodes, mesh.triangles(), mesh.pitch(), laws).ok_or(fault)
}
