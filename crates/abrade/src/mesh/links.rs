//! Which facets meet at which edges. Half-edge `3 f + k` goes from corner `k` of facet `f` to the
//! next one.

/// A half-edge under the sorted pair of its ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Side {
    /// Ends, the lower index first.
    pub(super) ends: [u32; 2],
    /// The half-edge.
    pub(super) half: u32,
}

/// All half-edges, sorted by their ends: those of one edge are neighbours.
pub(super) fn sides(triangles: &[[u32; 3]]) -> Vec<Side> {
    let side = |half: usize| {
        let [from, to] = ends(triangles, half);
        Side { ends: [from.min(to), from.max(to)], half: half as u32 }
    };
    let mut sides: Vec<_> = (0..3 * triangles.len()).map(side).collect();
    sides.sort_unstable();
    sides
}

/// Runs of sides with the same ends: the edges.
pub(super) fn edges(sides: &[Side]) -> impl Iterator<Item = &[Side]> {
    sides.chunk_by(|a, b| a.ends == b.ends)
}

/// Where half-edge `half` begins and ends.
pub(super) fn ends(triangles: &[[u32; 3]], half: usize) -> [u32; 2] {
    let corners = triangles[half / 3];
    [corners[half % 3], corners[(half + 1) % 3]]
}

/// For each half-edge the one on the other side; `u32::MAX` where the edge has not two sides.
pub(super) fn twins(sides: &[Side]) -> Vec<u32> {
    let mut twins = vec![u32::MAX; sides.len()];
    for edge in edges(sides) {
        if let [a, b] = edge {
            twins[a.half as usize] = b.half;
            twins[b.half as usize] = a.half;
        }
    }
    twins
}

/// For each facet the number of its shell, and how many shells there are. Facets belong together
/// across edges with two sides.
pub(super) fn shells(twins: &[u32]) -> (Vec<u32>, usize) {
    regions(twins, |_| true)
}

/// For each facet the number of its region, and how many there are: facets belong together across
/// the half-edges that `joins` names.
pub(super) fn regions(twins: &[u32], joins: impl Fn(usize) -> bool) -> (Vec<u32>, usize) {
    let mut label = vec![u32::MAX; twins.len() / 3];
    let mut count = 0;
    let mut stack = Vec::new();
    for start in 0..label.len() {
        if label[start] != u32::MAX {
            continue;
        }
        label[start] = count;
        stack.push(start);
        while let Some(facet) = stack.pop() {
            for half in 3 * facet..3 * facet + 3 {
                let Some(other) = across(twins, half) else { continue };
                if label[other] == u32::MAX && joins(half) {
                    label[other] = count;
                    stack.push(other);
                }
            }
        }
        count += 1;
    }
    (label, count as usize)
}

/// The facet on the other side of a half-edge.
pub(super) fn across(twins: &[u32], half: usize) -> Option<usize> {
    (twins[half] != u32::MAX).then(|| twins[half] as usize / 3)
}

/// For each vertex the number of closed fans that its facets form: one where the surface is a disc.
/// Every edge must have two sides that run in opposite directions.
pub(super) fn fans(triangles: &[[u32; 3]], twins: &[u32], vertices: usize) -> Vec<u32> {
    let mut fans = vec![0; vertices];
    let mut seen = vec![false; twins.len()];
    for start in 0..twins.len() {
        if seen[start] {
            continue;
        }
        fans[ends(triangles, start)[0] as usize] += 1;
        let mut half = start;
        while !seen[half] {
            seen[half] = true;
            let previous = half - half % 3 + (half % 3 + 2) % 3;
            half = twins[previous] as usize;
        }
    }
    fans
}
