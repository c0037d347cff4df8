//! What can be wrong with a triangle mesh, with the place of it.

use nalgebra::Point3;
use thiserror::Error;

use crate::error::ParameterError;

/// A mesh that does not bound a solid, or cannot be built. Places are in the mesh's frame [m];
/// `others` counts further faults of the same kind.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum MeshError {
    /// A size or spacing is out of range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// Fewer facets than a tetrahedron has.
    #[error("the mesh has {facets} facets, a closed one has at least 4")]
    TooFewFacets {
        /// Number of facets.
        facets: usize,
    },
    /// More vertices or facets than the index type or a plain memory bound allows.
    #[error("the mesh would have {count:.3e} {what}, at most {limit:.1e} are allowed")]
    TooMany {
        /// "vertices" or "facets".
        what: &'static str,
        /// Number asked for.
        count: f64,
        /// Largest number allowed.
        limit: f64,
    },
    /// A coordinate is not a number, or infinite.
    #[error("vertex {vertex} is at {} m, which is not finite", place(.at))]
    NotFinite {
        /// Index of the vertex.
        vertex: usize,
        /// Its coordinates [m].
        at: Point3<f64>,
    },
    /// Areas or volumes leave the range of the arithmetic.
    #[error("the mesh is too large to compute with: its area or volume is not finite")]
    TooLarge,
    /// A facet names a vertex that is not there.
    #[error("facet {facet} names vertex {vertex}, the mesh has {vertices} vertices")]
    NoSuchVertex {
        /// Index of the facet.
        facet: usize,
        /// Index of the vertex that it names.
        vertex: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// The corners of a facet lie on one line or coincide.
    #[error(
        "facet {facet} at {} m has no area: its corners lie on one line{}",
        place(.at),
        more(*.others, "facet has none", "facets have none")
    )]
    FlatFacet {
        /// Index of the facet.
        facet: usize,
        /// Its first corner [m].
        at: Point3<f64>,
        /// Further facets without area.
        others: usize,
    },
    /// A vertex that no facet uses.
    #[error(
        "vertex {vertex} at {} m belongs to no facet{}",
        place(.at),
        more(*.others, "vertex belongs to none", "vertices belong to none")
    )]
    UnusedVertex {
        /// Index of the vertex.
        vertex: usize,
        /// Its position [m].
        at: Point3<f64>,
        /// Further unused vertices.
        others: usize,
    },
    /// An edge with a facet on one side only.
    #[error(
        "the mesh is open: the edge from {} to {} m borders on one facet only{}",
        place(.from),
        place(.to),
        more(*.others, "edge does", "edges do")
    )]
    Open {
        /// One end [m].
        from: Point3<f64>,
        /// The other end [m].
        to: Point3<f64>,
        /// Further open edges.
        others: usize,
    },
    /// An edge with more than two facets.
    #[error(
        "the edge from {} to {} m borders on {facets} facets, where two are allowed{}",
        place(.from),
        place(.to),
        more(*.others, "edge borders on too many", "edges border on too many")
    )]
    Crowded {
        /// One end [m].
        from: Point3<f64>,
        /// The other end [m].
        to: Point3<f64>,
        /// Number of facets at the edge.
        facets: usize,
        /// Further edges with more than two facets.
        others: usize,
    },
    /// Two facets that pass along their common edge in the same direction.
    #[error(
        "the two facets at the edge from {} to {} m are turned against each other{}",
        place(.from),
        place(.to),
        more(*.others, "pair is", "pairs are")
    )]
    Turned {
        /// One end [m].
        from: Point3<f64>,
        /// The other end [m].
        to: Point3<f64>,
        /// Further edges of this kind.
        others: usize,
    },
    /// A vertex at which several sheets of the surface meet in a point.
    #[error(
        "the mesh is pinched at {} m: the facets there form {fans} separate fans{}",
        place(.at),
        more(*.others, "vertex is pinched", "vertices are pinched")
    )]
    Pinched {
        /// Position of the vertex [m].
        at: Point3<f64>,
        /// Number of fans of facets.
        fans: usize,
        /// Further vertices of this kind.
        others: usize,
    },
    /// Two facets that meet elsewhere than in a common vertex or along a common edge.
    #[error(
        "facets {first} and {second} cross or touch near {} m{}",
        place(.at),
        more(*.others, "pair of facets does", "pairs of facets do")
    )]
    Crossing {
        /// Index of one facet.
        first: usize,
        /// Index of the other.
        second: usize,
        /// Middle of the boxes' overlap [m].
        at: Point3<f64>,
        /// Further pairs.
        others: usize,
    },
    /// A shell whose facets face the solid.
    #[error("the shell of {facets} facets at {} m {}", place(.at), faces_wrong(*.inside))]
    InsideOut {
        /// Number of its facets.
        facets: usize,
        /// Position of one of its vertices [m].
        at: Point3<f64>,
        /// Number of other shells that it lies inside of.
        inside: usize,
    },
    /// A vertex whose facets' areas cancel.
    #[error("the vertex at {} m has no normal: the areas of its facets cancel", place(.at))]
    NoNormal {
        /// Position of the vertex [m].
        at: Point3<f64>,
    },
    /// Too few nodes around a round part.
    #[error(
        "a pitch of {pitch} m gives {around} nodes around the `{field}` of {radius} m, at least \
         {least} are needed: a pitch of {would_do:.3e} m would do"
    )]
    TooCoarse {
        /// Name of the radius.
        field: &'static str,
        /// Its value [m].
        radius: f64,
        /// Pitch asked for [m].
        pitch: f64,
        /// Nodes around at that pitch.
        around: f64,
        /// Fewest nodes around.
        least: f64,
        /// Largest pitch that gives as many [m].
        would_do: f64,
    },
    /// Rows of a height field that do not make a grid of at least two by two.
    #[error(
        "row {row} of the heights has {heights} values: rows must be alike, two by two or more"
    )]
    RaggedHeights {
        /// Index of the row.
        row: usize,
        /// Number of its values.
        heights: usize,
    },
    /// A height that is not finite or not above the base.
    #[error("height {column} of row {row} is {height} m, it must be finite and above {base} m")]
    LowHeight {
        /// Index of the row.
        row: usize,
        /// Index within the row.
        column: usize,
        /// The height [m].
        height: f64,
        /// Height of the bottom [m].
        base: f64,
    },
    /// The result of resampling does not bound a solid.
    #[error("the mesh cannot be resampled at a pitch of {pitch} m: {reason}")]
    Resample {
        /// Pitch asked for [m].
        pitch: f64,
        /// What is wrong with the result.
        reason: Box<Self>,
    },
}

/// A point as messages show it.
fn place(p: &Point3<f64>) -> String {
    let [x, y, z] = [p.x, p.y, p.z].map(number);
    format!("({x}, {y}, {z})")
}

fn number(x: f64) -> String {
    let plain = x == 0.0 || !x.is_finite() || (1e-4..1e6).contains(&x.abs());
    if plain { format!("{x}") } else { format!("{x:e}") }
}

fn more(others: usize, one: &str, many: &str) -> String {
    match others {
        0 => String::new(),
        1 => format!(", and 1 more {one}"),
        _ => format!(", and {others} more {many}"),
    }
}

fn faces_wrong(inside: usize) -> String {
    let shells = if inside == 1 { "shell" } else { "shells" };
    match inside % 2 {
        1 => format!("lies inside {inside} other {shells}: it must be a cavity, but faces outward"),
        _ if inside == 0 => "is inside out".into(),
        _ => format!("is inside out: it lies inside {inside} other {shells}"),
    }
}
