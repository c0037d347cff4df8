//! Cells over points, to find what is near a point.

use std::ops::Range;

/// Cells over points, each with the points in it in their order.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Grid {
    corner: [f64; 2],
    cell: [f64; 2],
    cells: [usize; 2],
    period: Option<f64>,
    reach: f64,
    /// Where the points of each cell begin in `members`.
    starts: Vec<usize>,
    members: Vec<u32>,
    /// Where the members are [m].
    places: Vec<[f64; 2]>,
    /// Room for sorting: the cell of each point, the next place in each cell.
    cell_of_point: Vec<usize>,
    next: Vec<usize>,
}

impl Grid {
    /// A grid over `points` that finds what is nearer than `reach` [m].
    pub(crate) fn new(points: &[[f64; 2]], period: Option<f64>, reach: f64) -> Self {
        let mut grid = Self {
            corner: [0.0; 2],
            cell: [reach; 2],
            cells: [1; 2],
            period,
            reach,
            starts: Vec::new(),
            members: Vec::new(),
            places: Vec::new(),
            cell_of_point: Vec::new(),
            next: Vec::new(),
        };
        grid.renew(points);
        grid
    }

    /// The grid over the points where they are now.
    pub(crate) fn renew(&mut self, points: &[[f64; 2]]) {
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        for point in points {
            for axis in 0..2 {
                low[axis] = low[axis].min(point[axis]);
                high[axis] = high[axis].max(point[axis]);
            }
        }
        let mut span = [0, 1].map(|axis| (high[axis] - low[axis]).max(self.reach));
        if let Some(period) = self.period {
            (low[0], span[0]) = (0.0, period);
        }
        // Points that flew far do not make the grid larger than the list of points.
        let most = (points.len() as f64).sqrt().ceil().max(1.0) * 4.0;
        self.corner = low;
        // No `clamp`: of a span over the reach that is no number there is one cell.
        self.cells = span.map(|span| (span / self.reach).floor().max(1.0).min(most) as usize);
        self.cell = [0, 1].map(|axis| span[axis] / self.cells[axis] as f64);
        self.sort(points);
    }

    /// Sorts the points by their cells.
    fn sort(&mut self, points: &[[f64; 2]]) {
        self.cell_of_point.clear();
        for point in points {
            let cell = self.index(self.cell_of(*point));
            self.cell_of_point.push(cell);
        }
        self.starts.clear();
        self.starts.resize(self.cells[0] * self.cells[1] + 1, 0);
        for cell in &self.cell_of_point {
            self.starts[cell + 1] += 1;
        }
        for cell in 1..self.starts.len() {
            self.starts[cell] += self.starts[cell - 1];
        }
        self.next.clone_from(&self.starts);
        self.members.resize(points.len(), 0);
        self.places.resize(points.len(), [0.0; 2]);
        for (point, cell) in self.cell_of_point.iter().enumerate() {
            let next = &mut self.next[*cell];
            self.members[*next] = point as u32;
            self.places[*next] = points[point];
            *next += 1;
        }
    }

    fn cell_of(&self, [x, y]: [f64; 2]) -> [usize; 2] {
        let x = match self.period {
            Some(period) if !(0.0..period).contains(&x) => x.rem_euclid(period),
            _ => x,
        };
        let along = |value: f64, axis: usize| {
            let at = (value - self.corner[axis]) / self.cell[axis];
            (at.max(0.0) as usize).min(self.cells[axis] - 1)
        };
        [along(x, 0), along(y, 1)]
    }

    fn index(&self, [column, row]: [usize; 2]) -> usize {
        row * self.cells[0] + column
    }

    /// Calls `found` with every point after point `i`, which is `point`, that is nearer to it than
    /// the reach.
    pub(crate) fn each_later(&self, i: usize, point: [f64; 2], mut found: impl FnMut(usize)) {
        let at = self.cell_of_point[i];
        let [column, row] = [at % self.cells[0], at / self.cells[0]];
        for row in row.saturating_sub(1)..=(row + 1).min(self.cells[1] - 1) {
            for columns in self.around(column) {
                let cells = self.index([columns.start, row])..self.index([columns.end, row]);
                let members = self.starts[cells.start]..self.starts[cells.end];
                for (j, other) in self.members[members.clone()].iter().zip(&self.places[members]) {
                    if *j as usize > i && self.square(point, *other) < self.reach * self.reach {
                        found(*j as usize);
                    }
                }
            }
        }
    }

    /// Square of the distance of two points [m2].
    fn square(&self, [x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) -> f64 {
        let (mut dx, dy) = (x1 - x0, y1 - y0);
        if let Some(period) = self.period
            && dx.abs() > 0.5 * period
        {
            dx -= period * (dx / period).round();
        }
        dx * dx + dy * dy
    }

    /// The columns beside `column` and itself, each once: those in a line with it, and one beyond
    /// the period's end.
    fn around(&self, column: usize) -> [Range<usize>; 2] {
        let count = self.cells[0];
        let beside = column.saturating_sub(1)..(column + 2).min(count);
        let beyond = match column {
            _ if self.period.is_none() || beside.len() == count => 0..0,
            0 => count - 1..count,
            _ if column + 1 == count => 0..1,
            _ => 0..0,
        };
        [beside, beyond]
    }
}
