//! Whether wear reaches the rim of a plate, where it ends for want of nodes and not of force.

use abrade::Surface;

/// Part of a pitch within which a node stands at the rim. Rows end half a pitch before those beside them; the next
/// row along x is 0.87 of a pitch away.
const BESIDE: f64 = 0.6;

/// Whether worn nodes stand at the ends of a plate along x and along y. No closed surface has ends, nor has a plate
/// across its only row: that is a section of an endless one.
pub(crate) fn reached(surface: &Surface) -> [bool; 2] {
    if !surface.is_flat() {
        return [false; 2];
    }
    let [low, high] = surface.bounds();
    let pitch = surface.pitch();
    let beside = BESIDE * pitch;
    let nodes = surface.nodes();
    let worn = nodes.rest_position.iter().zip(&nodes.depth).filter(|(_, depth)| **depth > 0.0);
    worn.fold([false; 2], |[along, across], (p, _)| {
        let is_at_rim = |axis: usize| {
            let has_rows = high[axis] - low[axis] > pitch;
            has_rows && (p[axis] < low[axis] + beside || p[axis] > high[axis] - beside)
        };
        [along || is_at_rim(0), across || is_at_rim(1)]
    })
}

#[cfg(test)]
mod tests {
    use abrade::{Changes, HexStrip, Material, SurfaceLaws};

    use super::*;

    /// Fails for a rim that is a row too wide or too narrow, or that of one row alone, and for sides that are swapped.
    #[test]
    fn the_rim_is_the_last_node_of_every_row() {
        let strip = |width| HexStrip { length: 10.0, width, pitch: 1.0, rest_area: None };
        let material = Material {
            hardness: 1.0,
            shear_ratio: 0.25,
            young: Some(1.0),
            poisson: 0.3,
            friction: 0.0,
        };
        let plate = |width| {
            Surface::hex_strip(strip(width), SurfaceLaws::of(material.clone())).expect("a plate")
        };
        let fresh = plate(6.0);
        let nodes = &fresh.nodes().rest_position;
        let all = || nodes.iter().enumerate();
        let ends = |axis: usize, of: f64| {
            // Of the nodes of one row, or of one line across the rows.
            let row = all().filter(|(_, p)| (p[1 - axis] - of).abs() < 1e-9).map(|(_, p)| p[axis]);
            [row.clone().fold(f64::INFINITY, f64::min), row.fold(f64::NEG_INFINITY, f64::max)]
        };
        let columns = nodes.iter().map(|p| p.x);
        let [first, last] = [
            columns.clone().fold(f64::INFINITY, f64::min),
            columns.fold(f64::NEG_INFINITY, f64::max),
        ];
        for (id, p) in all() {
            let mut worn = fresh.clone();
            worn.apply(&Changes::to_depths(vec![(id as u32, 0.1)]));
            let [low, high] = ends(1, p.x);
            assert_eq!(
                reached(&worn),
                [p.x == first || p.x == last, p.y == low || p.y == high],
                "{p}"
            );
        }
        assert_eq!(reached(&fresh), [false; 2]);
        let mut section = plate(1.0);
        let all = (0..section.nodes().len() as u32).map(|id| (id, 0.1)).collect();
        section.apply(&Changes::to_depths(all));
        assert_eq!(reached(&section), [true, false]);
    }
}
