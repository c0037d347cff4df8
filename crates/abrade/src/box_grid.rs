//! A uniform grid over a few boxes: which of them may hold a point.

use nalgebra::{Point3, Vector3};

/// Cells per box: more would not shorten the lists.
const CELLS: f64 = 8.0;

/// Cells of boxes, in compressed rows: `items[start[c]..start[c + 1]]` are those that meet cell
/// `c`, in their order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Boxes {
    low: Point3<f64>,
    per_metre: f64,
    dims: [usize; 3],
    start: Vec<u32>,
    items: Vec<u32>,
    /// Next free place of every cell, while they are filled.
    next: Vec<u32>,
}

impl Boxes {
    /// Takes these boxes, each given by its lowest and its highest corner, in place of others.
    pub(crate) fn set(&mut self, boxes: impl Iterator<Item = [Point3<f64>; 2]> + Clone) {
        let whole = boxes.clone().reduce(|[low, high], [l, h]| [low.inf(&l), high.sup(&h)]);
        let count = boxes.clone().count() as f64;
        self.items.clear();
        self.start.clear();
        let Some([low, high]) = whole else { return };
        self.low = low;
        let extent: Vector3<f64> = high - low;
        let mut cell = extent.max() / (CELLS * count).cbrt();
        let dims = |cell: f64| extent.map(|e| (e / cell).floor() + 1.0);
        while dims(cell).product() < CELLS * count && cell > 0.0 && cell.is_finite() {
            cell *= 0.8;
        }
        let cell = cell / 0.8;
        if !(cell > 0.0 && cell.is_finite()) {
            return;
        }
        self.per_metre = 1.0 / cell;
        let dims = dims(cell);
        self.dims = std::array::from_fn(|a| dims[a] as usize);
        self.start.resize(self.dims.iter().product::<usize>() + 1, 0);
        for each in boxes.clone() {
            self.visit(&each, |this, cell| this.start[cell + 1] += 1);
        }
        for cell in 1..self.start.len() {
            self.start[cell] += self.start[cell - 1];
        }
        self.next.clone_from(&self.start);
        self.items.resize(self.start.last().map_or(0, |&end| end as usize), 0);
        for (number, each) in boxes.enumerate() {
            self.visit(&each, |this, cell| {
                this.items[this.next[cell] as usize] = number as u32;
                this.next[cell] += 1;
            });
        }
    }

    /// The boxes that may hold `x`.
    #[inline]
    pub(crate) fn at(&self, x: &Point3<f64>) -> &[u32] {
        let place = (x - self.low) * self.per_metre;
        let within = |a: usize| place[a] >= 0.0 && place[a] < self.dims[a] as f64;
        if self.start.is_empty() || !(within(0) && within(1) && within(2)) {
            return &[];
        }
        let cell = self.number([place.x, place.y, place.z].map(|p| p as usize));
        &self.items[self.start[cell] as usize..self.start[cell + 1] as usize]
    }

    fn number(&self, [i, j, k]: [usize; 3]) -> usize {
        (k * self.dims[1] + j) * self.dims[0] + i
    }

    /// Calls `act` with every cell that the box meets.
    fn visit(&mut self, [low, high]: &[Point3<f64>; 2], act: impl Fn(&mut Self, usize)) {
        let place = |p: &Point3<f64>, a: usize| {
            (((p[a] - self.low[a]) * self.per_metre) as usize).min(self.dims[a] - 1)
        };
        let [from, to] = [low, high].map(|p| [0, 1, 2].map(|a| place(p, a)));
        for k in from[2]..=to[2] {
            for j in from[1]..=to[1] {
                for i in from[0]..=to[0] {
                    let cell = self.number([i, j, k]);
                    act(self, cell);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for a box that a point in it does not find, and for a grid that lists every box
    /// everywhere.
    #[test]
    fn a_point_finds_the_boxes_that_hold_it() {
        let at = |n: usize| Point3::new((n % 10) as f64, (n / 10) as f64, 0.0);
        let list: Vec<_> = (0..100).map(|n| [at(n), at(n) + Vector3::repeat(1.2)]).collect();
        let mut boxes = Boxes::default();
        boxes.set(list.iter().copied());
        let mut most = 0;
        for n in 0..5000 {
            let x = Point3::new(0.013 * (n % 700) as f64, 0.0021 * n as f64, 0.1);
            let found = boxes.at(&x);
            let holds =
                |[low, high]: &[Point3<f64>; 2]| (0..3).all(|a| x[a] >= low[a] && x[a] <= high[a]);
            let wanted = (0..100u32).filter(|&n| holds(&list[n as usize]));
            wanted.for_each(|n| assert!(found.contains(&n), "{x} {n}"));
            most = most.max(found.len());
        }
        assert!(most < 17, "{most}");
        assert!(boxes.at(&Point3::new(-0.1, 0.0, 0.0)).is_empty());
        boxes.set(std::iter::empty());
        assert!(boxes.at(&Point3::origin()).is_empty());
    }
}
