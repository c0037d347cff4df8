//! The data of a page: JSON whose long arrays are texts, base64 of zlib of little-endian numbers.
//! The scripts beside it read the same layout; `data.js` is the other end.

use std::io::Write as _;

use abrade_report::Summary;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use serde::Serialize;

/// All that a page shows. Lengths are in metres, from `origin_m`.
#[derive(Debug, Serialize)]
pub(crate) struct Block<'a> {
    pub(crate) summary: &'a Summary,
    /// A point in the middle of the surfaces [m], in the world: f32 resolves distances from it.
    pub(crate) origin_m: [f64; 3],
    pub(crate) times_s: &'a [f64],
    pub(crate) surfaces: Vec<SurfaceBlock>,
    pub(crate) bodies: Option<BodiesBlock>,
    /// Red, green, blue (u8) of 256 depths from none to the largest.
    pub(crate) colours: Packed,
}

/// Points in rigid parts: bodies, or a surface until it is laid out anew.
#[derive(Debug, Serialize)]
pub(crate) struct Shape {
    /// Number of points.
    pub(crate) points: usize,
    /// Number of parts.
    pub(crate) parts: usize,
    /// x, y, z (f32) of each point from the centre of its part [m].
    pub(crate) local: Packed,
    /// x, y, z (f32) of each node's normal; of surfaces alone.
    pub(crate) normal: Option<Packed>,
    /// Part of each point (u32); absent when there is one part.
    pub(crate) part: Option<Packed>,
    /// Three points (u32) per triangle.
    pub(crate) triangles: Packed,
}

/// What is shown at an instant.
#[derive(Debug, Serialize)]
pub(crate) struct Instant {
    /// Which of the shapes.
    pub(crate) shape: usize,
    /// Per part its centre [m] and its rotation since the first instant of the shape, as the
    /// quaternion x, y, z, w (f32).
    pub(crate) poses: Packed,
    /// Depth (f32) of each node [m]; of surfaces alone.
    pub(crate) depth: Option<Packed>,
}

/// A surface, or all copies of one.
#[derive(Debug, Serialize)]
pub(crate) struct SurfaceBlock {
    pub(crate) name: String,
    pub(crate) shapes: Vec<Shape>,
    pub(crate) instants: Vec<Instant>,
    /// Per instant the largest depth [m].
    pub(crate) max_depths_m: Vec<f64>,
}

/// All bodies, a part each.
#[derive(Debug, Serialize)]
pub(crate) struct BodiesBlock {
    pub(crate) names: Vec<String>,
    pub(crate) shapes: [Shape; 1],
    pub(crate) instants: Vec<Instant>,
    /// Per body x, y, z (f32) of the corners of its path [m], where the run wrote a history.
    pub(crate) paths: Option<Vec<Packed>>,
}

/// An array as text.
#[derive(Debug, Serialize)]
#[serde(transparent)]
pub(crate) struct Packed(String);

impl Packed {
    pub(crate) fn f32s(values: impl IntoIterator<Item = f64>) -> Self {
        Self::bytes(values.into_iter().flat_map(|value| (value as f32).to_le_bytes()).collect())
    }

    pub(crate) fn u32s(values: impl IntoIterator<Item = u32>) -> Self {
        Self::bytes(values.into_iter().flat_map(u32::to_le_bytes).collect())
    }

    pub(crate) fn bytes(bytes: Vec<u8>) -> Self {
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
        let packed = encoder.write_all(&bytes).and_then(|()| encoder.finish());
        Self(STANDARD.encode(packed.expect("memory takes every byte")))
    }
}
