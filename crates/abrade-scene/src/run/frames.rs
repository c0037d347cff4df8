//! ParaView files of a run: surfaces and bodies, instant after instant.

use std::path::Path;

use abrade_report::{Mesh, ReportError, Series, vtp};

use crate::build::Built;
use crate::run::bodies::Bodies;
use crate::run::ending::stem;
use crate::run::engine::Engine;

/// ParaView series.
pub(crate) struct Frames {
    surfaces: Vec<Series>,
    bodies: Option<(Series, Vec<Mesh>)>,
    pub(crate) at_end: bool,
}

impl Frames {
    pub(crate) fn new(
        built: &Built,
        names: &[String],
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
        Ok(Self {
            surfaces: names.iter().map(|name| Series::new(folder, &stem(names, name))).collect(),
            bodies,
            at_end,
        })
    }

    pub(crate) fn write(
        &mut self,
        engine: &dyn Engine,
        bodies: &Bodies,
        time: f64,
    ) -> Result<(), ReportError> {
        for (index, series) in self.surfaces.iter_mut().enumerate() {
            let surface = engine.surface(index);
            let (path, frame) = (series.next_path(), &bodies.frames[index]);
            let all = 0..surface.nodes().len();
            let is_mapped = surface.hardness_factors().is_some();
            let hardness: Option<Vec<f64>> =
                is_mapped.then(|| all.map(|i| surface.hardness(i)).collect());
            let facets = surface.triangles();
            let nodes = surface.nodes_since_made();
            vtp::write_surface(&path, &nodes, hardness.as_deref(), frame, &facets)?;
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
