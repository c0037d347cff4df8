//! Solids over a grid: cuboids and height fields.

use std::collections::HashMap;

use nalgebra::{Point3, Vector3};

use super::TriangleMesh;
use super::check::bound_count;
use super::error::MeshError;
use super::solids::check_sizes;
use crate::error::ParameterError;
use crate::surface::SOLID_NODE_LIMIT;

impl TriangleMesh {
    /// A box about the origin with these `half_extents` [m]. Each face is a regular grid, its
    /// spacing the nearest to `pitch` [m] that divides the face.
    ///
    /// # Errors
    /// Sizes out of range, too many vertices.
    pub fn cuboid(half_extents: Vector3<f64>, pitch: f64) -> Result<Self, MeshError> {
        let [x, y, z] = half_extents.into();
        check_sizes([
            ("half_extents", x),
            ("half_extents", y),
            ("half_extents", z),
            ("pitch", pitch),
        ])?;
        let parts = half_extents.map(|h| (2.0 * h / pitch).round().max(1.0));
        let [l, m, n] = parts.into();
        bound_count("vertices", 2.0 * (l * m + m * n + n * l) + 2.0, SOLID_NODE_LIMIT)?;
        let mut lattice = Lattice {
            half_extents,
            parts: [l, m, n].map(|count| count as u32),
            vertices: Vec::new(),
            triangles: Vec::new(),
            number: HashMap::new(),
        };
        (0..3).for_each(|axis| lattice.add_faces(axis));
        Self::new(lattice.vertices, lattice.triangles)
    }

    /// The ground between the plane z = `base` [m] and a grid of heights [m]: a row of them runs
    /// along x, `spacing_x` [m] apart, rows follow each other along y, `spacing_y` [m] apart; the
    /// first height of the first row stands at x = y = 0. Walls and bottom, which close it, are
    /// coarse: a wall is one facet high, and the bottom a fan about its middle.
    ///
    /// # Errors
    /// Sizes out of range, rows of different lengths, fewer than two by two heights, a height that
    /// is not above the base, too many vertices.
    pub fn height_field(
        heights: &[Vec<f64>],
        spacing_x: f64,
        spacing_y: f64,
        base: f64,
    ) -> Result<Self, MeshError> {
        check_sizes([("spacing_x", spacing_x), ("spacing_y", spacing_y)])?;
        if !base.is_finite() {
            let error = ParameterError { field: "base", value: base, allowed: "finite".into() };
            return Err(error.into());
        }
        let [columns, rows] = check_heights(heights, base)?;
        let rim_count = 2 * (columns + rows) - 4;
        bound_count(
            "vertices",
            columns as f64 * rows as f64 + rim_count as f64 + 1.0,
            SOLID_NODE_LIMIT,
        )?;
        let place = |column: usize, row: usize, z: f64| {
            Point3::new(column as f64 * spacing_x, row as f64 * spacing_y, z)
        };
        let along = |(row, line): (usize, &Vec<f64>)| -> Vec<Point3<f64>> {
            line.iter().enumerate().map(|(column, z)| place(column, row, *z)).collect()
        };
        let mut vertices: Vec<_> = heights.iter().enumerate().flat_map(along).collect();
        let mut triangles = ground(columns, rows);
        let top = vertices.len() as u32;
        let rim = rim(columns, rows);
        vertices
            .extend(rim.iter().map(|&i| place(i % columns, i / columns, base)).collect::<Vec<_>>());
        let middle = vertices.len() as u32;
        let half = |count: usize, spacing: f64| 0.5 * (count - 1) as f64 * spacing;
        vertices.push(Point3::new(half(columns, spacing_x), half(rows, spacing_y), base));
        for k in 0..rim.len() {
            let l = (k + 1) % rim.len();
            let [a, b] = [rim[k] as u32, rim[l] as u32];
            let [c, d] = [top + k as u32, top + l as u32];
            triangles.extend([[a, c, d], [a, d, b], [c, middle, d]]);
        }
        Self::new(vertices, triangles)
    }
}

/// Numbers of columns and rows.
fn check_heights(heights: &[Vec<f64>], base: f64) -> Result<[usize; 2], MeshError> {
    let columns = heights.first().map_or(0, Vec::len);
    if columns < 2 || heights.len() < 2 {
        return Err(MeshError::RaggedHeights { row: 0, heights: columns });
    }
    for (row, line) in heights.iter().enumerate() {
        if line.len() != columns {
            return Err(MeshError::RaggedHeights { row, heights: line.len() });
        }
        let low = |height: &f64| !(height.is_finite() && *height > base);
        if let Some(column) = line.iter().position(low) {
            return Err(MeshError::LowHeight { row, column, height: line[column], base });
        }
    }
    Ok([columns, heights.len()])
}

/// Facets of a grid of nodes, facing up.
fn ground(columns: usize, rows: usize) -> Vec<[u32; 3]> {
    let mut triangles = Vec::with_capacity(2 * columns * rows);
    for row in 0..rows - 1 {
        for column in 0..columns - 1 {
            let a = (row * columns + column) as u32;
            let [b, c, d] = [a + 1, a + columns as u32, a + columns as u32 + 1];
            triangles.extend([[a, b, d], [a, d, c]]);
        }
    }
    triangles
}

/// Nodes on the border of a grid, counter-clockwise as seen from above.
fn rim(columns: usize, rows: usize) -> Vec<usize> {
    let last = (rows - 1) * columns;
    let front = 0..columns - 1;
    let right = (0..rows - 1).map(|row| row * columns + columns - 1);
    let back = (1..columns).rev().map(|column| last + column);
    let left = (1..rows).rev().map(|row| row * columns);
    front.chain(right).chain(back).chain(left).collect()
}

/// The nodes of a box's faces on a lattice.
struct Lattice {
    half_extents: Vector3<f64>,
    parts: [u32; 3],
    vertices: Vec<Point3<f64>>,
    triangles: Vec<[u32; 3]>,
    number: HashMap<[u32; 3], u32>,
}

impl Lattice {
    /// Both faces across `axis`.
    fn add_faces(&mut self, axis: usize) {
        let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
        for i in 0..self.parts[u] {
            for j in 0..self.parts[v] {
                for end in [0, self.parts[axis]] {
                    let mut site = |di: u32, dj: u32| {
                        let mut key = [0; 3];
                        (key[axis], key[u], key[v]) = (end, i + di, j + dj);
                        self.node(key)
                    };
                    let [a, b, c, d] = [site(0, 0), site(1, 0), site(1, 1), site(0, 1)];
                    self.triangles.extend(match end {
                        0 => [[a, c, b], [a, d, c]],
                        _ => [[a, b, c], [a, c, d]],
                    });
                }
            }
        }
    }

    fn node(&mut self, key: [u32; 3]) -> u32 {
        *self.number.entry(key).or_insert_with(|| {
            // From -1 to 1, both met exactly, and symmetric about 0.
            let share = |a: usize| {
                let n = f64::from(self.parts[a]);
                (2.0 * f64::from(key[a]) - n) / n
            };
            let place = Vector3::from_fn(|a, _| share(a) * self.half_extents[a]);
            self.vertices.push(Point3::from(place));
            self.vertices.len() as u32 - 1
        })
    }
}
