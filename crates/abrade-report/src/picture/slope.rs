//! The slope of the worn surface at each node, from its neighbours by least squares. With it the
//! field between nodes follows an inclined plane exactly, instead of stepping from node to node.

use super::view::Seen;

/// Neighbours are sought this far, in node distances.
const REACH: f64 = 1.4;

/// Change of depth along both axes at every node [-]; zero where neighbours do not tell.
pub(super) fn slopes(nodes: &[Seen]) -> Vec<[f64; 2]> {
    let Some(cells) = Cells::of(nodes) else {
        return vec![[0.0; 2]; nodes.len()];
    };
    nodes.iter().map(|node| slope(node, cells.near(node, nodes))).collect()
}

/// The plane through the node's own depth that its neighbours fit best.
fn slope<'a>(node: &Seen, neighbours: impl Iterator<Item = &'a Seen>) -> [f64; 2] {
    let (mut xx, mut xy, mut yy, mut xs, mut ys) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for other in neighbours {
        let [x, y] = [0, 1].map(|k| other.at[k] - node.at[k]);
        let step = other.depth - node.depth;
        xx += x * x;
        xy += x * y;
        yy += y * y;
        xs += x * step;
        ys += y * step;
    }
    let determinant = xx * yy - xy * xy;
    // Neighbours on one line, or none, do not tell a slope.
    match determinant > 1e-6 * (xx + yy) * (xx + yy) {
        true => [(xs * yy - ys * xy) / determinant, (ys * xx - xs * xy) / determinant],
        false => [0.0; 2],
    }
}

/// Nodes sorted into square cells.
struct Cells {
    low: [f64; 2],
    side: f64,
    size: [usize; 2],
    /// Where each cell begins in `order`, and the end.
    starts: Vec<usize>,
    order: Vec<usize>,
}

impl Cells {
    fn of(nodes: &[Seen]) -> Option<Self> {
        let first = nodes.first()?.at;
        let (mut low, mut high, mut spacing) = (first, first, 0.0);
        for node in nodes {
            low = [0, 1].map(|k| low[k].min(node.at[k]));
            high = [0, 1].map(|k| high[k].max(node.at[k]));
            spacing += node.spacing / nodes.len() as f64;
        }
        // Cells never outnumber the nodes by much, however uneven these are.
        let least = ((high[0] - low[0]) * (high[1] - low[1]) / nodes.len() as f64).sqrt();
        let side = (REACH * spacing).max(least);
        let size = [0, 1].map(|k| ((high[k] - low[k]) / side) as usize + 1);
        if !(side > 0.0 && side.is_finite()) {
            return None;
        }
        let mut cells = Self { low, side, size, starts: Vec::new(), order: Vec::new() };
        cells.sort(nodes);
        Some(cells)
    }

    fn sort(&mut self, nodes: &[Seen]) {
        self.starts = vec![0; self.size[0] * self.size[1] + 1];
        let cell = |node: &Seen| {
            let [x, y] = [0, 1].map(|k| self.index(k, node.at[k]));
            y * self.size[0] + x
        };
        let homes: Vec<usize> = nodes.iter().map(cell).collect();
        homes.iter().for_each(|home| self.starts[home + 1] += 1);
        for i in 1..self.starts.len() {
            self.starts[i] += self.starts[i - 1];
        }
        let mut next = self.starts.clone();
        self.order = vec![0; nodes.len()];
        for (i, home) in homes.into_iter().enumerate() {
            self.order[next[home]] = i;
            next[home] += 1;
        }
    }

    fn index(&self, k: usize, at: f64) -> usize {
        (((at - self.low[k]) / self.side).max(0.0) as usize).min(self.size[k] - 1)
    }

    /// The nodes within reach of `node`, itself included.
    fn near<'a>(&'a self, node: &Seen, nodes: &'a [Seen]) -> impl Iterator<Item = &'a Seen> {
        let reach = REACH * node.spacing;
        let at = node.at;
        let [columns, rows] =
            [0, 1].map(|k| self.index(k, at[k] - reach)..=self.index(k, at[k] + reach));
        let cells = rows.flat_map(move |y| columns.clone().map(move |x| y * self.size[0] + x));
        let inside = cells.flat_map(|cell| &self.order[self.starts[cell]..self.starts[cell + 1]]);
        inside
            .map(|&i| &nodes[i])
            .filter(move |other| (other.at[0] - at[0]).hypot(other.at[1] - at[1]) <= reach)
    }
}
