//! Moves vertices within the surface so that they are evenly spread.

use nalgebra::{Point3, Vector3};

use super::features::Kind;
use super::guard::{area, may_move};
use super::original::Original;
use super::patchwork::Patchwork;

/// Shares of the way that are tried: the first that spoils no facet is gone.
const SHARES: [f64; 4] = [1.0, 0.5, 0.25, 0.0];

/// Moves every vertex that may towards the middle of its neighbours, and onto the original.
pub(super) fn relax(net: &mut Patchwork, original: &Original) {
    for i in 0..net.points.len() as u32 {
        if net.valence(i) == 0 {
            continue;
        }
        let from = net.points[i as usize];
        let Some(way) = way(net, i) else { continue };
        let aims = SHARES.into_iter().map(|share| onto(net, original, i, from + way * share));
        let aim = aims.into_iter().find(|p| may_move(net, &[i], *p));
        net.points[i as usize] = aim.unwrap_or(from);
    }
}

/// Where to: the middle of the two neighbours along a chain, or of the facets around.
pub(super) fn way(net: &Patchwork, i: u32) -> Option<Vector3<f64>> {
    let p = net.points[i as usize];
    match net.kind[i as usize] {
        Kind::Fixed => None,
        Kind::Along(_) => {
            let mut beside = net.neighbours(i).filter(|j| net.chain(i, *j).is_some());
            let (a, b) = (beside.next()?, beside.next()?);
            let [a, b] = [a, b].map(|j| net.points[j as usize] - p);
            Some((a + b) / 2.0)
        }
        Kind::Smooth => {
            let (mut moment, mut weight, mut normal) = (Vector3::zeros(), 0.0, Vector3::zeros());
            for t in net.facets_at(i) {
                let corners = t.map(|k| net.points[k as usize]);
                let facet = area(&corners);
                let size = facet.norm();
                moment += corners.iter().map(|q| q - p).sum::<Vector3<f64>>() * (size / 3.0);
                weight += size;
                normal += facet;
            }
            let way = moment / weight;
            let normal = normal.try_normalize(0.0)?;
            Some(way - normal * normal.dot(&way))
        }
    }
}

fn onto(net: &Patchwork, original: &Original, i: u32, p: Point3<f64>) -> Point3<f64> {
    match (net.kind[i as usize], net.patch_at(i)) {
        (Kind::Along(chain), _) => original.on_chain(p, chain),
        (Kind::Smooth, Some(patch)) => original.on_patch(p, patch),
        _ => p,
    }
}
