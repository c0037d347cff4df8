//! ParaView files of a run: surfaces and bodies, instant after instant.

use std::path::Path;

use abrade::Nodes;
use abrade_report::{Mesh, ReportError, Series, vtp};
use nalgebra::Isometry3;

use crate::build::Built;
use crate::run::bodies::Bodies;
use crate::run::engine::Engine;
use crate::run::entries::{Entry, stem};

/// ParaView series.
pub(crate) struct Frames {
    /// A series for every surface; copies share one.
    surfaces: Vec<(Series, Entry)>,
    bodies: Option<(Series, Vec<Mesh>)>,
    pub(crate) at_end: bool,
}

impl Frames {
    pub(crate) fn new(
        built: &Built,
        entries: &[Entry],
        folder: &Path,
        with_bodies: bool,
        at_end: bool,
    ) -> Result<Self, ReportError> {
        let bodies = match with_bodies {
            true => {
                let meshes = built.bodies.values().map(|body| Mesh::of_shape(&body.shape));
                Some((Series::new(folder, "bodies"), meshes.collect::<Result<_, _>>()?))
            }
            false => None,
        };
        let series = |entry: &Entry| (Series::new(folder, &stem(entries, entry)), entry.clone());
        Ok(Self { surfaces: entries.iter().map(series).collect(), bodies, at_end })
    }

    pub(crate) fn write(
        &mut self,
        engine: &dyn Engine,
        bodies: &Bodies,
        time: f64,
    ) -> Result<(), ReportError> {
        for (series, entry) in &mut self.surfaces {
            let Shown { nodes, hardness, facets } = shown(engine, bodies, &entry.members);
            let world = Isometry3::identity();
            vtp::write_surface(&series.next_path(), &nodes, hardness.as_deref(), &world, &facets)?;
            series.push(time);
            series.write()?;
        }
        let Some((series, meshes)) = &mut self.bodies else { return Ok(()) };
        let states: Vec<_> = (0..meshes.len()).map(|body| engine.state(body)).collect();
        let placed: Vec<_> = meshes
            .iter()
            .zip(&states)
            .map(|(mesh, state)| vtp::PlacedBody { mesh, state })
            .collect();
        vtp::write_bodies(&series.next_path(), &placed)?;
        series.push(time);
        series.write()
    }
}

/// What a file shows of some surfaces, in the world.
#[derive(Default)]
struct Shown {
    nodes: Nodes,
    /// Of every node [Pa], where it differs from node to node.
    hardness: Option<Vec<f64>>,
    facets: Vec<[u32; 3]>,
}

/// The surfaces of these indices, one after the other.
fn shown(engine: &dyn Engine, bodies: &Bodies, members: &[usize]) -> Shown {
    let mut shown = Shown::default();
    for &index in members {
        let (surface, frame) = (engine.surface(index), &bodies.frames[index]);
        let (nodes, before) = (surface.nodes_since_made(), shown.nodes.len() as u32);
        let facets = surface.triangles();
        shown.facets.extend(facets.iter().map(|facet| facet.map(|corner| corner + before)));
        if surface.hardness_factors().is_some() {
            let all = (0..nodes.len()).map(|node| surface.hardness(node));
            shown.hardness.get_or_insert_default().extend(all);
        }
        let placed = &mut shown.nodes;
        placed.rest_position.extend(nodes.rest_position.iter().map(|place| frame * place));
        placed.normal.extend(nodes.normal.iter().map(|normal| frame * normal));
        placed.rest_area.extend(&nodes.rest_area);
        placed.depth.extend(&nodes.depth);
    }
    shown
}
