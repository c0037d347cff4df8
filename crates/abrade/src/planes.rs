//! The planes of a hull in blocks of four, which a line is clipped against at once: what a branch for each
//! plane would cost is more than its arithmetic. The loops over the four become vectors, as wide as the
//! processor has them, with the same bits.

use std::array::from_fn;

use multiversion::multiversion;
use nalgebra::{Point3, Vector3};

/// Planes in a block.
const LANES: usize = 4;
/// Blocks between two looks whether anything of the line is left.
const LOOK: usize = 4;

/// A number of each of four planes.
type Four = [f64; LANES];

/// Four planes. Those that fill the last block have no normal, and everything is below them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block {
    /// Outward normals, by component.
    normal: [Four; 3],
    /// Their offsets [m].
    offset: Four,
    /// Parts of the normals along the level, if there is one; never the zero below zero.
    slope: Four,
}

/// How planes lean against a line.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Line {
    /// Along the level that the blocks were made for.
    Level,
    /// Along this direction.
    Along([f64; 3]),
}

impl Line {
    /// Along `n`, which is `level` where there is one.
    #[inline]
    pub(crate) fn new(level: Option<Vector3<f64>>, n: &Vector3<f64>) -> Self {
        level.map_or_else(|| Self::Along([n.x, n.y, n.z]), |_| Self::Level)
    }
}

/// Adds the planes of a hull, outward normals and offsets [m], in whole blocks.
pub(crate) fn add(
    blocks: &mut Vec<Block>,
    planes: impl Iterator<Item = (Vector3<f64>, f64)>,
    level: Option<Vector3<f64>>,
) {
    let none = [(Vector3::zeros(), f64::INFINITY); LANES];
    let (mut four, mut count) = (none, 0);
    for plane in planes {
        four[count] = plane;
        count += 1;
        if count == LANES {
            blocks.push(Block::new(&four, level));
            (four, count) = (none, 0);
        }
    }
    if count > 0 {
        blocks.push(Block::new(&four, level));
    }
}

/// The part of the line from `x` within `ends` [m] that lies inside the hull of these planes, each moved out
/// by `margin` [m]; None where there is none.
#[multiversion(targets("x86_64+avx2"))]
pub(crate) fn inside(
    blocks: &[Block],
    x: &Point3<f64>,
    line: Line,
    ends: [f64; 2],
    margin: f64,
) -> Option<[f64; 2]> {
    let x = [x.x, x.y, x.z];
    let [mut lows, mut highs] = ends.map(|end| [end; LANES]);
    for blocks in blocks.chunks(LOOK) {
        for block in blocks {
            let (slope, above) = (block.slope(line), dot(&block.normal, x));
            for lane in 0..LANES {
                let room = block.offset[lane] + margin - above[lane];
                let bound = room / slope[lane];
                let (low, high) = (lows[lane], highs[lane]);
                lows[lane] = if (slope[lane] < 0.0) & (bound > low) { bound } else { low };
                // Along a plane the bound is without end or before any beginning; it is no number,
                // and above and below none, where the line lies in the plane.
                highs[lane] = if (slope[lane] >= 0.0) & (bound < high) { bound } else { high };
            }
        }
        if greatest(lows) >= least(highs) {
            return None;
        }
    }
    Some([greatest(lows), least(highs)])
}

/// Outward normal of the first of these planes that the line from `x` crosses at `low` [m] on its way in.
#[multiversion(targets("x86_64+avx2"))]
pub(crate) fn crossed_at(
    blocks: &[Block],
    x: &Point3<f64>,
    line: Line,
    low: f64,
) -> Option<Vector3<f64>> {
    let x = [x.x, x.y, x.z];
    for block in blocks {
        let (slope, above) = (block.slope(line), dot(&block.normal, x));
        let bound: Four = from_fn(|lane| (block.offset[lane] - above[lane]) / slope[lane]);
        let is_it: [bool; LANES] = from_fn(|lane| (slope[lane] < 0.0) & (bound[lane] == low));
        if let Some(lane) = is_it.iter().position(|is_it| *is_it) {
            return Some(Vector3::from(block.normal.map(|part| part[lane])));
        }
    }
    None
}

/// Distance [m] of the line from `x` from the farthest of these planes from which it leads away.
#[multiversion(targets("x86_64+avx2"))]
pub(crate) fn clearance(blocks: &[Block], x: &Point3<f64>, line: Line) -> f64 {
    let x = [x.x, x.y, x.z];
    let mut farthest = [f64::NEG_INFINITY; LANES];
    for block in blocks {
        let (slope, above) = (block.slope(line), dot(&block.normal, x));
        for lane in 0..LANES {
            let (distance, far) = (above[lane] - block.offset[lane], farthest[lane]);
            farthest[lane] = if (slope[lane] <= 0.0) & (distance > far) { distance } else { far };
        }
    }
    greatest(farthest)
}

impl Block {
    fn new(planes: &[(Vector3<f64>, f64); LANES], level: Option<Vector3<f64>>) -> Self {
        let slope = |n: &Vector3<f64>| level.map_or(0.0, |level| n.dot(&level)) + 0.0;
        Self {
            normal: from_fn(|axis| planes.map(|(normal, _)| normal[axis])),
            offset: planes.map(|(_, offset)| offset),
            slope: planes.map(|(normal, _)| slope(&normal)),
        }
    }

    /// Parts of the normals along the line; never the zero below zero.
    #[inline(always)]
    fn slope(&self, line: Line) -> Four {
        match line {
            Line::Level => self.slope,
            Line::Along(n) => dot(&self.normal, n).map(|slope| slope + 0.0),
        }
    }
}

#[inline(always)]
fn dot([x, y, z]: &[Four; 3], v: [f64; 3]) -> Four {
    from_fn(|lane| x[lane] * v[0] + y[lane] * v[1] + z[lane] * v[2])
}

#[inline(always)]
fn greatest([a, b, c, d]: Four) -> f64 {
    let higher = |a: f64, b: f64| if b > a { b } else { a };
    higher(higher(a, b), higher(c, d))
}

#[inline(always)]
fn least([a, b, c, d]: Four) -> f64 {
    let lower = |a: f64, b: f64| if b < a { b } else { a };
    lower(lower(a, b), lower(c, d))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The planes of a cube of edge 2 about the origin.
    fn cube(level: Option<Vector3<f64>>) -> Vec<Block> {
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
        let mut blocks = Vec::new();
        add(&mut blocks, axes.into_iter().flat_map(|axis| [(axis, 1.0), (-axis, 1.0)]), level);
        blocks
    }

    /// Fails for a line along a plane that is taken for one on its other side, for a filling plane that cuts
    /// something off, and for the wrong face at the lower end.
    #[test]
    fn lines_cross_a_cube_between_its_faces() {
        let (up, whole) = (Vector3::z(), [f64::NEG_INFINITY, f64::INFINITY]);
        for level in [None, Some(up)] {
            let (blocks, line) = (cube(level), Line::new(level, &up));
            let inside =
                |x: f64, y: f64, ends| inside(&blocks, &Point3::new(x, y, 5.0), line, ends, 0.0);
            assert_eq!(inside(0.3, -0.4, whole), Some([-6.0, -4.0]));
            assert_eq!(inside(0.3, -0.4, [-5.0, 0.0]), Some([-5.0, -4.0]));
            assert_eq!(inside(0.3, -0.4, [-3.5, 0.0]), None);
            assert_eq!(inside(1.0, 0.0, whole), Some([-6.0, -4.0]));
            assert_eq!(inside(1.1, 0.0, whole), None);
            assert_eq!(inside(0.0, -1.1, whole), None);
            let deep = crossed_at(&blocks, &Point3::new(0.3, -0.4, 5.0), line, -6.0);
            assert_eq!(deep, Some(-Vector3::z()));
            assert!((clearance(&blocks, &Point3::new(1.5, 0.0, 5.0), line) - 0.5).abs() < 1e-15);
        }
    }
}
