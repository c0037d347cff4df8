//! Paths of bodies with few points: those that a line through the others would miss.
//!
//! D. H. Douglas, T. K. Peucker, Cartographica 10 (1973) 112, without recursion.

use nalgebra::{Point3, Vector3};

/// `places` without those that lie within `distance` [m] of the line that is left.
pub(crate) fn thinned(places: &[Point3<f64>], distance: f64) -> Vec<Point3<f64>> {
    let Some(last) = places.len().checked_sub(1) else { return Vec::new() };
    let mut kept = vec![false; places.len()];
    (kept[0], kept[last]) = (true, true);
    let mut spans = vec![(0, last)];
    while let Some((start, end)) = spans.pop() {
        let off = |at: usize| off_segment(places[at], places[start], places[end]);
        let farthest = (start + 1..end).max_by(|a, b| off(*a).total_cmp(&off(*b)));
        if let Some(farthest) = farthest.filter(|farthest| off(*farthest) > distance) {
            kept[farthest] = true;
            spans.extend([(start, farthest), (farthest, end)]);
        }
    }
    places.iter().zip(kept).filter(|(_, kept)| *kept).map(|(place, _)| *place).collect()
}

/// Distance of `place` from the segment [m].
fn off_segment(place: Point3<f64>, start: Point3<f64>, end: Point3<f64>) -> f64 {
    let along: Vector3<f64> = end - start;
    let length = along.norm_squared();
    let share = if length > 0.0 { (place - start).dot(&along) / length } else { 0.0 };
    (place - (start + along * share.clamp(0.0, 1.0))).norm()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for a path that loses its bend or the way back along itself, or keeps all of a straight
    /// flight.
    #[test]
    fn a_bend_and_a_way_back_stay_and_a_straight_flight_is_two_points() {
        let at = |x: f64, z: f64| Point3::new(x, 0.0, z);
        let mut places: Vec<_> = (0..=10).map(|i| at(f64::from(i), 0.0)).collect();
        assert_eq!(thinned(&places, 1e-6), [at(0.0, 0.0), at(10.0, 0.0)]);
        places.extend((1..=10).map(|i| at(10.0, f64::from(i))));
        places.extend((1..=10).rev().map(|i| at(10.0, f64::from(i - 1))));
        let corners = [at(0.0, 0.0), at(10.0, 0.0), at(10.0, 10.0), at(10.0, 0.0)];
        assert_eq!(thinned(&places, 1e-6), corners);
        assert!(thinned(&[], 1.0).is_empty());
    }
}
