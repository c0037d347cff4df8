//! A wear surface: nodes, laws, and what has been worn off.

use std::sync::Arc;

use nalgebra::{Point3, Vector3};

use crate::error::{ParameterError, SurfaceError};
use crate::grid::Grid;
use crate::hardness::HardnessMap;
use crate::laws::{Adhesion, Archard, ElasticLaw, FlowLaw, Lateral, Removal};
use crate::layout::{HexStrip, Layout, strip_positions};
use crate::leaf::{Changes, Leaf};
use crate::material::Material;
use crate::mesh::TriangleMesh;
use crate::nodes::Nodes;
use crate::renewal::Past;
use crate::sunk::Sunk;
#[cfg(feature = "state")]
use crate::surface_state::SurfaceState;
use crate::worn::Worn;

/// Nodes a surface may have: indices are 32 bits wide, and a node takes about 90 bytes.
pub const NODE_LIMIT: f64 = 2e8;
/// Most nodes of a solid, which takes 1 to 1.5 kB for each while it is made and looked over.
pub const SOLID_NODE_LIMIT: f64 = 5e6;

/// The laws a surface obeys.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub struct SurfaceLaws {
    /// What it is made of.
    pub material: Material,
    /// Elastic part.
    pub elastic: ElasticLaw,
    /// Flow part.
    pub flow: FlowLaw,
    /// Which part of the displaced volume is debris.
    pub removal: Removal,
    /// Coefficient of restitution of an impact below yield [-], from 0.01 to 1: no damping. Above
    /// yield dashpots still take their part while nodes load and unload, up to the cap of the flow
    /// law: less wear and less rebound. `Rigid` has no springs to damp.
    pub restitution: f64,
    /// Adhesion to bodies; None for a surface that nothing sticks to.
    pub adhesion: Option<Adhesion>,
    /// Wear under what slides, below the hardness too; None for a surface that flow alone wears.
    pub archard: Option<Archard>,
}

/// A surface that wears. The frame of a strip has its origin at the node nearest its middle; that
/// of a mesh is the one in which the mesh is given.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "state", serde(try_from = "SurfaceState", into = "SurfaceState"))]
pub struct Surface {
    /// Empty for a leaf, as the grid.
    pub(crate) nodes: Nodes,
    pub(crate) grid: Grid,
    pub(crate) leaf: Option<Box<Leaf>>,
    /// What was worn before the last renewal; None before the first.
    pub(crate) past: Option<Arc<Past>>,
    /// Largest depth of a node since the last renewal [m].
    pub(crate) deepest: f64,
    /// None for a surface that nobody watches.
    pub(crate) sunk: Option<Box<Sunk>>,
    pub(crate) laws: SurfaceLaws,
    /// None where the material's hardness holds everywhere.
    pub(crate) hardness_map: Option<Arc<HardnessMap>>,
    /// What was worn until the last [`Surface::settle`], and since.
    pub(crate) worn: Worn,
    pub(crate) gain: Worn,
    /// The normal of every node, where they agree.
    level: Option<Vector3<f64>>,
    pub(crate) layout: Layout,
    pub(crate) pitch: f64,
    /// Area that few nodes are smaller than [m2].
    pub(crate) least_area: f64,
}

/// Restitution below which a surface is refused: the body would take some 1/restitution times as
/// long to leave as it took to come.
const LEAST_RESTITUTION: f64 = 0.01;

impl SurfaceLaws {
    /// The laws that hold unless others are chosen: a calibrated `Foundation`, `CapozzaHanley`
    /// with `Projected`, all of the volume removed, no damping.
    pub fn of(material: Material) -> Self {
        Self {
            material,
            elastic: ElasticLaw::Foundation { stiffness: None },
            flow: FlowLaw::CapozzaHanley { lateral: Lateral::Projected },
            removal: Removal::All,
            restitution: 1.0,
            adhesion: None,
            archard: None,
        }
    }

    /// An error unless `restitution` is one that a surface can have.
    pub fn check_restitution(restitution: f64) -> Option<ParameterError> {
        ParameterError::within("restitution", restitution, LEAST_RESTITUTION, 1.0)
    }

    /// Every value outside its range, and parameters that a law misses.
    pub fn check(&self) -> Vec<SurfaceError> {
        let mut found: Vec<SurfaceError> = self
            .material
            .check()
            .into_iter()
            .chain(self.elastic.check())
            .chain(self.removal.check())
            .chain(Self::check_restitution(self.restitution))
            .chain(self.adhesion.iter().flat_map(|adhesion| adhesion.check(&self.material)))
            .chain(self.archard.iter().flat_map(Archard::check))
            .map(SurfaceError::from)
            .collect();
        let law = match self.elastic {
            ElasticLaw::Foundation { stiffness: None } => Some("Foundation() without a stiffness"),
            ElasticLaw::HertzNodes { .. } => Some("HertzNodes"),
            _ => None,
        };
        if let (Some(law), None) = (law, self.material.young) {
            found.push(SurfaceError::Missing { law, field: "young" });
        }
        found
    }
}

impl Surface {
    /// A flat strip in the plane z = 0, normals along +z.
    ///
    /// # Errors
    /// A parameter out of range, no node, too many nodes.
    pub fn hex_strip(strip: HexStrip, laws: SurfaceLaws) -> Result<Self, SurfaceError> {
        if let Some(error) = strip.check().into_iter().next() {
            return Err(error.into());
        }
        if let Some(error) = laws.check().into_iter().next() {
            return Err(error);
        }
        let [columns, rows] = strip.columns_rows();
        if columns < 1.0 || rows < 1.0 {
            let reason = format!(
                "length {} m and width {} m give {columns} columns of {rows} rows at a pitch of {} m",
                strip.length, strip.width, strip.pitch
            );
            return Err(SurfaceError::NoNodes { reason });
        }
        if columns * rows > NODE_LIMIT {
            return Err(SurfaceError::TooManyNodes { nodes: columns * rows, limit: NODE_LIMIT });
        }
        let columns_rows = [columns as usize, rows as usize];
        let area = strip.rest_area.unwrap_or(0.75f64.sqrt() * strip.pitch * strip.pitch);
        Ok(Self::lattice(columns_rows, strip.pitch, area, laws))
    }

    /// A flat lattice of the given numbers of columns and rows, unworn.
    pub(crate) fn lattice(
        columns_rows: [usize; 2],
        pitch: f64,
        area: f64,
        laws: SurfaceLaws,
    ) -> Self {
        let rest_position = strip_positions(columns_rows, pitch);
        let count = rest_position.len();
        Self {
            grid: Grid::strip(&rest_position, columns_rows, pitch),
            nodes: Nodes {
                rest_position,
                normal: vec![Vector3::z(); count],
                rest_area: vec![area; count],
                depth: vec![0.0; count],
            },
            leaf: None,
            past: None,
            deepest: 0.0,
            sunk: None,
            laws,
            hardness_map: None,
            worn: Worn::default(),
            gain: Worn::default(),
            level: Some(Vector3::z()),
            layout: Layout::Strip { columns_rows },
            pitch,
            least_area: area,
        }
    }

    /// The surface of a solid: a node at every vertex of `mesh`, its normal and its area from the
    /// facets around it. A node wears what lies below it, down to where another part
    /// of the surface is as near.
    ///
    /// # Errors
    /// A parameter out of range, or a mesh that bounds no solid.
    pub fn mesh(mesh: &TriangleMesh, laws: SurfaceLaws) -> Result<Self, SurfaceError> {
        if let Some(error) = laws.check().into_iter().next() {
            return Err(error);
        }
        Self::closed(mesh.nodes(), mesh.triangles(), mesh.pitch(), laws)
            .ok_or(SurfaceError::NoNodes { reason: "the mesh bounds no solid".into() })
    }

    /// The surface of the solid that `triangles` bound, unworn; None when they bound none.
    pub(crate) fn closed(
        nodes: Nodes,
        triangles: &[[u32; 3]],
        pitch: f64,
        laws: SurfaceLaws,
    ) -> Option<Self> {
        Some(Self {
            layout: Layout::mesh(&nodes, triangles)?,
            grid: Grid::new(&nodes.rest_position, 4.0 * pitch),
            least_area: small_area(&nodes.rest_area),
            nodes,
            leaf: None,
            past: None,
            deepest: 0.0,
            sunk: None,
            laws,
            hardness_map: None,
            worn: Worn::default(),
            gain: Worn::default(),
            level: None,
            pitch,
        })
    }

    /// A leaf of `below`: wears as it would, and leaves it as it is. See [`Surface::into_changes`].
    pub fn leaf(below: &Arc<Self>) -> Self {
        Self {
            nodes: Nodes::default(),
            grid: Grid::default(),
            leaf: Some(Box::new(Leaf::new(below))),
            past: below.past.clone(),
            deepest: below.deepest,
            sunk: None,
            laws: below.laws.clone(),
            hardness_map: below.hardness_map.clone(),
            worn: below.worn(),
            gain: Worn::default(),
            level: below.level,
            layout: below.layout.clone(),
            pitch: below.pitch,
            least_area: below.least_area,
        }
    }

    /// What a leaf has worn; nothing for a surface that is none. Lets go of the surface below.
    pub fn into_changes(self) -> Changes {
        let gain = self.gain;
        self.leaf.map_or_else(Changes::default, |leaf| leaf.into_changes(gain))
    }

    /// Takes over what a leaf of this surface has worn. Nodes that the surface does not have are left out: a
    /// leaf has none.
    pub fn apply(&mut self, changes: &Changes) {
        self.settle();
        self.deepest = self.deepest.max(changes.write(&mut self.nodes.depth));
        self.worn += *changes.gain();
        if let Some(sunk) = &mut self.sunk {
            let is_there = |id: &u32| (*id as usize) < self.nodes.depth.len();
            changes.nodes().filter(is_there).for_each(|id| sunk.note(id));
        }
    }

    /// Books what was worn since the last call, as one sum: so a total does not depend on
    /// whether a leaf has worn it. Returns it.
    pub fn settle(&mut self) -> Worn {
        let gain = std::mem::take(&mut self.gain);
        self.worn += gain;
        gain
    }

    /// The nodes; of a leaf, those of the surface below.
    pub fn nodes(&self) -> &Nodes {
        match &self.leaf {
            None => &self.nodes,
            Some(leaf) => leaf.below().nodes(),
        }
    }

    /// Finds nodes by their undeformed positions.
    pub(crate) fn grid(&self) -> &Grid {
        match &self.leaf {
            None => &self.grid,
            Some(leaf) => leaf.below().grid(),
        }
    }

    /// Depth of node `i` [m], since the last renewal.
    #[inline]
    pub fn depth(&self, i: usize) -> f64 {
        match &self.leaf {
            None => self.nodes.depth[i],
            Some(leaf) => leaf.depth(i as u32),
        }
    }

    /// Present position of node `i` [m].
    #[inline]
    pub fn position(&self, i: usize) -> Point3<f64> {
        let nodes = self.nodes();
        nodes.rest_position[i] - nodes.normal[i] * self.depth(i)
    }

    /// The laws.
    pub fn laws(&self) -> &SurfaceLaws {
        &self.laws
    }

    /// Volumes worn off so far.
    pub fn worn(&self) -> Worn {
        let mut worn = self.worn;
        worn += self.gain;
        worn
    }

    /// Distance of neighbouring nodes [m]; of a mesh, that of a close packing of as many.
    pub fn pitch(&self) -> f64 {
        self.pitch
    }

    /// Numbers of columns along x and of rows along y of a strip. Node `row` of a column is the
    /// column's number times the rows, plus `row`; odd columns are shifted by half a pitch.
    pub fn columns_rows(&self) -> Option<[usize; 2]> {
        match self.layout {
            Layout::Strip { columns_rows } => Some(columns_rows),
            Layout::Mesh(_) => None,
        }
    }

    /// True for a strip, whose normals all point along +z.
    pub fn is_flat(&self) -> bool {
        self.level.is_some()
    }

    /// How far below node `i` the material is its own [m]: without end under a strip, down to the
    /// medial axis of a solid.
    pub(crate) fn reach(&self, i: u32) -> f64 {
        match &self.layout {
            Layout::Strip { .. } => f64::INFINITY,
            Layout::Mesh(meshed) => meshed.reach[i as usize],
        }
    }

    /// True for the surface of a solid that is no leaf.
    pub(crate) fn can_be_renewed(&self) -> bool {
        self.leaf.is_none() && matches!(self.layout, Layout::Mesh(_))
    }

    /// Radius of a ball of the solid's volume [m]; infinite for a strip.
    pub(crate) fn size(&self) -> f64 {
        match &self.layout {
            Layout::Strip { .. } => f64::INFINITY,
            Layout::Mesh(meshed) => meshed.size,
        }
    }

    /// Centre and radius of a ball around the undeformed nodes [m]; None for a strip.
    pub(crate) fn ball(&self) -> Option<(Point3<f64>, f64)> {
        let [low, high] = self.bounds();
        let around = || (nalgebra::center(&low, &high), 0.5 * (high - low).norm());
        (!self.is_flat()).then(around)
    }

    /// Depth of the deepest node since the last renewal [m].
    pub fn deepest(&self) -> f64 {
        self.deepest
    }

    /// Rest area that few nodes are smaller than [m2]; on a flat surface, that of every node.
    pub fn least_area(&self) -> f64 {
        self.least_area
    }

    /// Depth of a point of the surface's frame below the undeformed surface [m]; zero outside, and
    /// beside a strip down to `beside` [m].
    pub(crate) fn depth_of(&self, point: &Point3<f64>, beside: f64) -> f64 {
        let [low, high] = self.bounds();
        match &self.layout {
            Layout::Strip { .. } => {
                let over = (0..2).all(|a| point[a] > low[a] && point[a] < high[a]);
                let depth = high.z - point.z;
                if depth > if over { 0.0 } else { beside } { depth } else { 0.0 }
            }
            Layout::Mesh(meshed) => meshed.solid.depth(point),
        }
    }

    /// Facets of a mesh, with the nodes at their corners; None for a strip.
    pub fn facets(&self) -> Option<&[[u32; 3]]> {
        match &self.layout {
            Layout::Strip { .. } => None,
            Layout::Mesh(meshed) => Some(meshed.solid.triangles()),
        }
    }

    /// The normal of every node, where they agree.
    pub(crate) fn level(&self) -> Option<Vector3<f64>> {
        self.level
    }

    /// Sinks node `id` by `drop` [m].
    pub(crate) fn sink(&mut self, id: u32, drop: f64) {
        let depth = match &mut self.leaf {
            None => {
                let depth = &mut self.nodes.depth[id as usize];
                *depth += drop;
                *depth
            }
            Some(leaf) => leaf.sink(id, drop),
        };
        self.deepest = self.deepest.max(depth);
        let depth = depth + self.past_depth(id as usize);
        self.gain.max_depth = self.gain.max_depth.max(depth);
        // Last, so that a surface that nobody watches pays no more than the question.
        self.note_sunk(id);
    }

    /// W_V [m3] = sum of rest_area * depth (Eq. 6), chips included, over all renewals.
    pub fn wear_volume(&self) -> f64 {
        let added = self.leaf.as_ref().map_or(0.0, |leaf| leaf.added_volume());
        let past = self.past.as_ref().map_or(0.0, |past| past.volume);
        past + self.nodes().wear_volume() + added
    }

    /// Corners of the box around the undeformed nodes, in the surface's frame [m].
    pub fn bounds(&self) -> [Point3<f64>; 2] {
        self.grid().bounds()
    }

    /// Triangles between neighbouring nodes; of a mesh, its facets.
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        self.layout.triangles()
    }
}

/// Share of the nodes of a mesh whose areas may be smaller than what counts as small: a cusp must
/// not make every contact stiff.
const FEW: usize = 100;

/// Area that one node in [`FEW`] is smaller than [m2].
pub(crate) fn small_area(areas: &[f64]) -> f64 {
    let mut sorted = areas.to_vec();
    let at = sorted.len() / FEW;
    let (_, small, _) = sorted.select_nth_unstable_by(at, f64::total_cmp);
    *small
}
