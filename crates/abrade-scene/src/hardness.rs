//! From the hardness map and the regions of a surface to the hardness of every node.

use abrade::ParameterError;
use abrade_report::quantity_text::count;
use nalgebra::Point3;

use crate::number_rows::{Line, Rows};
use crate::scene::RegionBox;

/// Range of a hardness over that of the material.
const RANGE: [f64; 2] = [1e-6, 1e6];

/// An error unless `hardness` [Pa] is one that a part of a surface can have whose material has
/// `of_material`.
pub(crate) fn check(hardness: f64, of_material: f64) -> Option<ParameterError> {
    let [low, high] = RANGE.map(|factor| factor * of_material);
    ParameterError::within("hardness", hardness, low, high)
}

/// A place and its hardness [Pa].
#[derive(Clone, Copy, Debug, PartialEq)]
struct Place {
    at: Point3<f64>,
    hardness: f64,
    row: usize,
}

/// Places with a hardness, by x.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Places(Vec<Place>);

/// A row that says no hardness of a place, by its line and why not.
pub(crate) type BadRow = (Line, String);

impl Places {
    /// The places in `rows`, whose lengths are multiplied by `scale`.
    pub(crate) fn of(rows: &Rows, scale: f64, of_material: f64) -> Result<Self, BadRow> {
        let mut places = Vec::with_capacity(rows.rows.len());
        for (row, (numbers, line)) in rows.rows.iter().zip(&rows.lines).enumerate() {
            let &[x, y, z, hardness] = &numbers[..] else {
                let numbers = count(numbers.len(), "number", "numbers");
                let fault = format!("has {numbers}, not x, y, z and a hardness");
                return Err((line.clone(), fault));
            };
            if let Some(error) = check(hardness, of_material) {
                let fault = format!("the hardness {hardness} Pa must be {}", error.allowed);
                return Err((line.clone(), fault));
            }
            places.push(Place { at: Point3::new(x, y, z) * scale, hardness, row });
        }
        places.sort_by(|a, b| a.at.x.total_cmp(&b.at.x));
        Ok(Self(places))
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Hardness of the place nearest to `node` [Pa]; of several as near, that of the first row.
    pub(crate) fn hardness(&self, node: &Point3<f64>) -> Option<f64> {
        let middle = self.0.partition_point(|place| place.at.x < node.x);
        let (before, after) = self.0.split_at(middle);
        let mut best: Option<(f64, Place)> = None;
        for side in
            [&mut before.iter().rev() as &mut dyn Iterator<Item = &Place>, &mut after.iter()]
        {
            for place in side {
                let along = place.at.x - node.x;
                if best.is_some_and(|(least, _)| along * along > least) {
                    break;
                }
                let far = (place.at - node).norm_squared();
                let nearer = |(least, other): &(f64, Place)| {
                    far < *least || far == *least && place.row < other.row
                };
                if best.as_ref().is_none_or(nearer) {
                    best = Some((far, *place));
                }
            }
        }
        best.map(|(_, place)| place.hardness)
    }
}

/// The nodes in a box.
pub(crate) fn inside<'a>(
    extent: &RegionBox,
    nodes: &'a [Point3<f64>],
) -> impl Iterator<Item = usize> + use<'a> {
    let RegionBox { from, to } = *extent;
    let is_inside =
        move |p: &Point3<f64>| (0..3).all(|axis| p[axis] >= from[axis] && p[axis] <= to[axis]);
    nodes.iter().enumerate().filter_map(move |(i, node)| is_inside(node).then_some(i))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for a search that stops at the nearest x, or that takes the last of equal rows.
    #[test]
    fn a_node_has_the_hardness_of_the_nearest_row() {
        let rows: Vec<Vec<f64>> =
            [[0.0, 5.0, 0.0, 1.0], [3.0, 0.0, 0.0, 2.0], [-3.0, 0.0, 0.0, 3.0]]
                .map(Vec::from)
                .into();
        let line = Line { file: "a.csv".into(), number: 1, text: String::new() };
        let rows = Rows { rows, lines: vec![line; 3] };
        let places = Places::of(&rows, 1e-3, 1.0).expect("places");
        let hardness = |x: f64, y: f64| places.hardness(&Point3::new(1e-3 * x, 1e-3 * y, 0.0));
        assert_eq!(hardness(0.1, 0.0), Some(2.0));
        assert_eq!(hardness(-0.1, 0.0), Some(3.0));
        assert_eq!(hardness(0.0, 4.0), Some(1.0));
        assert_eq!(hardness(0.0, 0.0), Some(2.0));
        assert_eq!((hardness(9.0, 9.0), hardness(9.0, 0.0)), (Some(1.0), Some(2.0)));
    }
}
