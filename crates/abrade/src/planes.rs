//! The planes of a hull in blocks of four, which a line is clipped against at once: what a branch for each
//! plane would cost is more than its arithmetic.

use nalgebra::{Point3, Vector3};
use wide::f64x4;

/// Planes in a block.
const LANES: usize = 4;
/// Blocks between two looks whether anything of the line is left.
const LOOK: usize = 4;

/// Four planes. Those that fill the last block have no normal, and everything is below them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block {
    /// Outward normals.
    normal: [f64x4; 3],
    /// Their offsets [m].
    offset: f64x4,
    /// Parts of the normals along the level, if there is one; never the zero below zero.
    slope: f64x4,
}

/// How planes lean against a line.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Line {
    /// Along the level that the blocks were made for.
    Level,
    /// Along this direction.
    Along([f64x4; 3]),
}

impl Line {
    /// Along `n`, which is `level` where there is one.
    #[inline]
    pub(crate) fn new(level: Option<Vector3<f64>>, n: &Vector3<f64>) -> Self {
        level.map_or_else(|| Self::Along(splat(n)), |_| Self::Level)
    }
}

/// The blocks of a hull.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Blocks<'a> {
    pub(crate) all: &'a [Block],
    /// Those from the first on that have every plane from which a line leads away, or along which.
    pub(crate) shunned: usize,
}

/// Adds the planes of a hull, outward normals and offsets [m], in whole blocks. Returns up to where there may
/// be planes from which a line leads away, or along which: with a level they come first.
pub(crate) fn add(
    blocks: &mut Vec<Block>,
    planes: impl Iterator<Item = (Vector3<f64>, f64)> + Clone,
    level: Option<Vector3<f64>>,
) -> usize {
    let Some(level) = level else {
        fill(blocks, planes, None);
        return blocks.len();
    };
    let leads_away = |plane: &(Vector3<f64>, f64)| plane.0.dot(&level) <= 0.0;
    fill(blocks, planes.clone().filter(leads_away), Some(level));
    let shunned = blocks.len();
    fill(blocks, planes.filter(|plane| !leads_away(plane)), Some(level));
    shunned
}

/// Adds planes in whole blocks.
fn fill(
    blocks: &mut Vec<Block>,
    planes: impl Iterator<Item = (Vector3<f64>, f64)>,
    level: Option<Vector3<f64>>,
) {
    let (mut four, mut count) = ([(Vector3::zeros(), f64::INFINITY); LANES], 0);
    for plane in planes {
        four[count] = plane;
        count += 1;
        if count == LANES {
            blocks.push(Block::new(&four, level));
            (four, count) = ([(Vector3::zeros(), f64::INFINITY); LANES], 0);
        }
    }
    if count > 0 {
        blocks.push(Block::new(&four, level));
    }
}

/// The part of the line from `x` within `ends` [m] that lies inside the hull of these planes, each moved out
/// by `margin` [m]; None where there is none.
#[inline]
pub(crate) fn inside(
    blocks: Blocks<'_>,
    x: &Point3<f64>,
    line: Line,
    [low, high]: [f64; 2],
    margin: f64,
) -> Option<[f64; 2]> {
    let (x, margin) = (splat(&x.coords), f64x4::splat(margin));
    let (mut lows, mut highs) = (f64x4::splat(low), f64x4::splat(high));
    for blocks in blocks.all.chunks(LOOK) {
        for block in blocks {
            let slope = block.slope(line);
            let room = block.offset + margin - dot(&block.normal, &x);
            let bound = room / slope;
            let (falls, rises) = (slope.simd_lt(f64x4::ZERO), slope.simd_ge(f64x4::ZERO));
            lows = (falls & bound.simd_gt(lows)).select(bound, lows);
            // Along a plane the bound is without end or before any beginning; it is no number, and above
            // and below none, where the line lies in the plane.
            highs = (rises & bound.simd_lt(highs)).select(bound, highs);
        }
        if greatest(lows) >= -greatest(-highs) {
            return None;
        }
    }
    Some([greatest(lows), -greatest(-highs)])
}

/// True when the line from `x` down, `reach` [m] long and longer by `margin` [m] at both ends, has a part in
/// the hull of these planes, each moved out by `margin`.
#[inline]
pub(crate) fn meet(
    blocks: Blocks<'_>,
    x: &Point3<f64>,
    line: Line,
    reach: f64,
    margin: f64,
) -> bool {
    let (at, up) = (splat(&x.coords), f64x4::splat(margin));
    let (mut left, mut farthest) =
        (f64x4::splat(f64::NEG_INFINITY), f64x4::splat(f64::NEG_INFINITY));
    let (shunned, sought) = blocks.all.split_at(blocks.shunned);
    for block in shunned {
        let (slope, distance) = (block.slope(line), dot(&block.normal, &at) - block.offset);
        farthest = farthest.fast_max(distance);
        // Of a line that leads away from a plane, the upper end is the nearest.
        left = left.fast_max(block.shunned(line, distance + slope * up));
    }
    if greatest(left) >= margin {
        return false;
    }
    for block in sought {
        farthest = farthest.fast_max(dot(&block.normal, &at) - block.offset);
    }
    // Mostly `x` itself lies in there.
    let has_x = greatest(farthest) < margin && reach + margin > 0.0;
    has_x || inside(blocks, x, line, [-(reach + margin), margin], margin).is_some()
}

/// Outward normal of the first of these planes that the line from `x` crosses at `low` [m] on its way in.
#[inline]
pub(crate) fn crossed_at(
    blocks: Blocks<'_>,
    x: &Point3<f64>,
    line: Line,
    low: f64,
) -> Option<Vector3<f64>> {
    let x = splat(&x.coords);
    blocks.shunned().iter().find_map(|block| {
        let slope = block.slope(line);
        let bound = (block.offset - dot(&block.normal, &x)) / slope;
        let is_it = slope.simd_lt(f64x4::ZERO) & bound.simd_eq(f64x4::splat(low));
        let lane = is_it.to_bitmask().trailing_zeros() as usize;
        (lane < LANES).then(|| Vector3::from(block.normal.map(|part| part.to_array()[lane])))
    })
}

/// Distance [m] of the line from `depth` [m] below `x` from the farthest of these planes from
/// which it leads away.
#[inline]
pub(crate) fn clearance(blocks: Blocks<'_>, x: &Point3<f64>, line: Line, depth: f64) -> f64 {
    let (x, depth) = (splat(&x.coords), f64x4::splat(depth));
    let mut farthest = f64x4::splat(f64::NEG_INFINITY);
    for block in blocks.shunned() {
        let distance = dot(&block.normal, &x) - block.slope(line) * depth - block.offset;
        farthest = farthest.fast_max(block.shunned(line, distance));
    }
    greatest(farthest)
}

impl<'a> Blocks<'a> {
    #[inline(always)]
    fn shunned(self) -> &'a [Block] {
        &self.all[..self.shunned]
    }
}

impl Block {
    fn new(planes: &[(Vector3<f64>, f64); LANES], level: Option<Vector3<f64>>) -> Self {
        let lanes = |part: &dyn Fn(&Vector3<f64>) -> f64| {
            f64x4::new(std::array::from_fn(|lane| part(&planes[lane].0)))
        };
        Self {
            normal: [lanes(&|n| n.x), lanes(&|n| n.y), lanes(&|n| n.z)],
            offset: f64x4::new(std::array::from_fn(|lane| planes[lane].1)),
            slope: lanes(&|n| level.map_or(0.0, |level| n.dot(&level))) + f64x4::ZERO,
        }
    }

    /// Those of `values` whose planes the line leads away from, or along; of a block with such planes.
    #[inline(always)]
    fn shunned(&self, line: Line, values: f64x4) -> f64x4 {
        match line {
            // A block has no others then.
            Line::Level => values,
            Line::Along(_) => {
                let leads_away = self.slope(line).simd_le(f64x4::ZERO);
                leads_away.select(values, f64x4::splat(f64::NEG_INFINITY))
            }
        }
    }

    /// Parts of the normals along the line; never the zero below zero.
    #[inline(always)]
    fn slope(&self, line: Line) -> f64x4 {
        match line {
            Line::Level => self.slope,
            Line::Along(n) => dot(&self.normal, &n) + f64x4::ZERO,
        }
    }
}

#[inline(always)]
fn splat(v: &Vector3<f64>) -> [f64x4; 3] {
    [f64x4::splat(v.x), f64x4::splat(v.y), f64x4::splat(v.z)]
}

#[inline(always)]
fn dot([ax, ay, az]: &[f64x4; 3], [bx, by, bz]: &[f64x4; 3]) -> f64x4 {
    *ax * *bx + *ay * *by + *az * *bz
}

#[inline(always)]
fn greatest(four: f64x4) -> f64 {
    let [a, b, c, d] = four.to_array();
    let higher = |a: f64, b: f64| if b > a { b } else { a };
    higher(higher(a, b), higher(c, d))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The planes of a cube of edge 2 about the origin.
    fn cube(level: Option<Vector3<f64>>) -> (Vec<Block>, usize) {
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
        let mut blocks = Vec::new();
        let planes = axes.into_iter().flat_map(|axis| [(axis, 1.0), (-axis, 1.0)]);
        let shunned = add(&mut blocks, planes, level);
        (blocks, shunned)
    }

    /// Fails for a line along a plane that is taken for one on its other side, for a filling plane that cuts
    /// something off, and for the wrong face at the lower end.
    #[test]
    fn lines_cross_a_cube_between_its_faces() {
        let (up, whole) = (Vector3::z(), [f64::NEG_INFINITY, f64::INFINITY]);
        for level in [None, Some(up)] {
            let ((all, shunned), line) = (cube(level), Line::new(level, &up));
            let blocks = Blocks { all: &all, shunned };
            let inside =
                |x: f64, y: f64, ends| inside(blocks, &Point3::new(x, y, 5.0), line, ends, 0.0);
            assert_eq!(inside(0.3, -0.4, whole), Some([-6.0, -4.0]));
            assert_eq!(inside(0.3, -0.4, [-5.0, 0.0]), Some([-5.0, -4.0]));
            assert_eq!(inside(0.3, -0.4, [-3.5, 0.0]), None);
            assert_eq!(inside(1.0, 0.0, whole), Some([-6.0, -4.0]));
            assert_eq!(inside(1.1, 0.0, whole), None);
            assert_eq!(inside(0.0, -1.1, whole), None);
            let deep = crossed_at(blocks, &Point3::new(0.3, -0.4, 5.0), line, -6.0);
            assert_eq!(deep, Some(-Vector3::z()));
            assert!(
                (clearance(blocks, &Point3::new(1.5, 0.0, 5.0), line, 3.0) - 0.5).abs() < 1e-15
            );
        }
    }

    /// Fails for a line that is taken for one in the hull, or beside it, without being clipped: through an
    /// overhang, into a roof, up to the end of its reach.
    #[test]
    fn lines_meet_a_hull_where_clipping_leaves_something_of_them() {
        let (up, mut met) = (Vector3::new(0.48, 0.36, 0.8), 0);
        for level in [None, Some(up)] {
            let ((all, shunned), line) = (cube(level), Line::new(level, &up));
            let blocks = Blocks { all: &all, shunned };
            for k in 0..8000 {
                let place = [k % 20, k / 20 % 20, k / 400].map(|i| 0.31 * f64::from(i) - 2.9);
                let x = Point3::from(place);
                for (reach, margin) in [(f64::INFINITY, 0.2), (1.3, 0.2), (1.3, 0.0), (0.0, 0.0)] {
                    let ends = [-(reach + margin), margin];
                    let clipped = inside(blocks, &x, line, ends, margin).is_some();
                    assert_eq!(meet(blocks, &x, line, reach, margin), clipped, "{x}");
                    met += usize::from(clipped);
                }
            }
        }
        assert!(met > 4000, "{met}");
    }
}
