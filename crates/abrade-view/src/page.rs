//! The page: markup, styles and scripts that lie beside this file, three.js and the run's data, in
//! one text.

use std::path::Path;

use abrade_report::picture::depth_colours;
use abrade_report::{ReportError, atomic, pvd};

use crate::block::{Block, Packed};
use crate::error::ViewError;
use crate::folder::RunFolder;
use crate::gather::{self, Bounds};

/// A page of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Page {
    /// The text of the file.
    pub html: String,
    /// Instants that its time slider has.
    pub instants: usize,
    /// Nodes of all surfaces.
    pub nodes: usize,
    /// Bodies drawn.
    pub bodies: usize,
}

impl Page {
    /// The page of the run that `abrade run` left in `folder`.
    ///
    /// # Errors
    /// The folder is not a run's, the run wrote no surface, or its files cannot be read or are not
    /// of one run.
    pub fn of_run(folder: &Path) -> Result<Self, ViewError> {
        let run = RunFolder::open(folder)?;
        let bounds = Bounds::of_surfaces(&run)?;
        let origin = bounds.middle();
        let mut surfaces = Vec::new();
        for (name, files) in &run.surfaces {
            surfaces.push(gather::surface(name, files, origin)?);
        }
        let shapes = surfaces.iter().filter_map(|surface| surface.shapes.last());
        let nodes = shapes.map(|shape| shape.points).sum();
        let expected = run.summary.surfaces.values().map(|surface| surface.nodes).sum();
        gather::check_count(folder, "nodes", nodes, expected)?;
        let files = run.bodies.as_ref();
        let bodies = files.map(|files| gather::bodies(&run, files, origin, &bounds)).transpose()?;
        let count = bodies.as_ref().map_or(0, |bodies| bodies.names.len());
        let block = Block {
            summary: &run.summary,
            origin_m: origin.into(),
            times_s: &run.times,
            surfaces,
            bodies,
            colours: Packed::bytes(depth_colours().concat()),
        };
        let html = assembled(&run.summary.scene, &serde_json::to_string(&block)?);
        Ok(Self { html, instants: run.times.len(), nodes, bodies: count })
    }

    /// Writes the page to `path`.
    ///
    /// # Errors
    /// The file system refuses.
    pub fn write(&self, path: &Path) -> Result<(), ReportError> {
        atomic::write(path, self.html.as_bytes())
    }
}

/// The page called `title` with `data`, a JSON text.
fn assembled(title: &str, data: &str) -> String {
    // A `<` could end the script that holds the data; inside a JSON text it may be written so.
    let data = data.replace('<', "\\u003c");
    let scripts = SCRIPTS.concat();
    let parts = [
        ("{{title}}", pvd::escape(title)),
        ("{{style}}", STYLE.to_owned()),
        ("{{title}}", pvd::escape(title)),
        ("{{data}}", data),
        ("{{three}}", format!("/*\n{THREE_LICENSE}*/\n{THREE}")),
        ("{{scripts}}", scripts),
    ];
    let (mut html, mut rest) = (String::new(), PAGE);
    for (mark, text) in &parts {
        let (before, after) = rest.split_once(mark).expect("page.html has every mark, in order");
        html.extend([before, text]);
        rest = after;
    }
    html + rest
}

const PAGE: &str = include_str!("page/page.html");
const STYLE: &str = include_str!("page/style.css");
/// One script for old and new browsers, which sets the global `THREE`; see its README.
const THREE: &str = include_str!("../vendor/three/three.min.js");
/// Goes with every copy, so with every page.
const THREE_LICENSE: &str = include_str!("../vendor/three/LICENSE");
/// Joined into one module: an inline module of a file from disk cannot import another.
const SCRIPTS: [&str; 10] = [
    include_str!("page/units.js"),
    include_str!("page/data.js"),
    include_str!("page/colour.js"),
    include_str!("page/parts.js"),
    include_str!("page/section.js"),
    include_str!("page/enclosing.js"),
    include_str!("page/chart.js"),
    include_str!("page/stage.js"),
    include_str!("page/panel.js"),
    include_str!("page/main.js"),
];
