//! The depths at which nodes have swept the volume that they were charged with.
//!
//! Nodes that move from x_i to x_i - s_i n_i sweep the volume sum of s_i n_i . M_i, where M_i is the
//! mean over the way of S_i / 3, the slope of the enclosed volume. S_i is quadratic in the share of
//! the way, so its mean is that of Simpson's rule. A node was charged with rest area * s_i, and the
//! rest area is n_i . S_i / 3 at the start: it has swept that where s_i' n_i . M_i says so.

use nalgebra::{Point3, Vector3};

use super::RenewError;
use crate::mesh::area_vector;
use crate::nodes::Nodes;

/// Rounds after which depths that do not come to rest are given up.
const ROUNDS: usize = 60;
/// Share of the volume to which it is met.
const TOLERANCE: f64 = 1e-10;
/// Least mean area on the way of a node over the undeformed one, and most.
const NARROWED: [f64; 2] = [0.4, 2.5];

/// The depths [m] for which every node has swept what it was charged with.
pub(super) fn depths(nodes: &Nodes, triangles: &[[u32; 3]]) -> Result<Vec<f64>, RenewError> {
    let is_worn = |i: &u32| nodes.depth[*i as usize] > 0.0;
    let facets: Vec<[u32; 3]> =
        triangles.iter().copied().filter(|t| t.iter().any(is_worn)).collect();
    let worn: Vec<u32> = (0..nodes.len() as u32).filter(is_worn).collect();
    let charged = nodes.wear_volume();
    let mut depths = nodes.depth.clone();
    let mut sums = vec![Vector3::zeros(); nodes.len()];
    for _ in 0..ROUNDS {
        sums.fill(Vector3::zeros());
        add_slopes(nodes, &depths, &facets, &mut sums);
        let mut swept = 0.0;
        for i in worn.iter().map(|i| *i as usize) {
            // The sums hold 4 S (half-way) + S (end).
            let area = (nodes.rest_area[i] + nodes.normal[i].dot(&sums[i]) / 3.0) / 6.0;
            swept += area * depths[i];
            let narrowed = area / nodes.rest_area[i];
            if !(NARROWED[0]..=NARROWED[1]).contains(&narrowed) {
                let (at, depth) = (nodes.position(i), nodes.depth[i]);
                return Err(RenewError::Spent { at, depth, narrowed });
            }
            depths[i] = nodes.depth[i] / narrowed;
        }
        if (swept - charged).abs() <= TOLERANCE * charged {
            return Ok(depths);
        }
    }
    Err(RenewError::Unsettled { rounds: ROUNDS })
}

/// Adds 4 S_i half-way and S_i at the end of the way to `sums`, for facets whose nodes move.
fn add_slopes(nodes: &Nodes, depths: &[f64], facets: &[[u32; 3]], sums: &mut [Vector3<f64>]) {
    for corners in facets {
        let at = |share: f64| -> [Point3<f64>; 3] {
            corners.map(|i| {
                let i = i as usize;
                nodes.rest_position[i] - nodes.normal[i] * (share * depths[i])
            })
        };
        let slope = area_vector(&at(0.5), &[0, 1, 2]) * 4.0 + area_vector(&at(1.0), &[0, 1, 2]);
        corners.iter().for_each(|&i| sums[i as usize] += slope);
    }
}
