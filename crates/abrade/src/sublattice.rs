//! How well a lattice resolves its craters: what the coarser lattices in it would have told.

use crate::layout::Layout;
use crate::surface::Surface;

/// Coarser lattices: of every second and of every third node, along and across.
const STRIDES: [usize; 2] = [2, 3];

impl Surface {
    /// How far the wear volume scatters over coarser lattices among the nodes, relative [-]: the
    /// root mean square over those of every second and of every third node, the latter taken to the
    /// distance of the former as the square of it. None for the nodes of a mesh, and where nothing
    /// has worn.
    pub fn sublattice_scatter(&self) -> Option<f64> {
        let Layout::Strip { columns_rows: [_, rows] } = self.layout else { return None };
        let depths = || (0..self.nodes().len()).map(|node| self.depth(node));
        let total: f64 = depths().sum();
        if total <= 0.0 {
            return None;
        }
        let (mut squares, mut count) = (0.0, 0.0);
        for stride in STRIDES {
            let lattices = (stride * stride) as f64;
            let mut sums = [0.0; 9];
            for (node, depth) in depths().enumerate().filter(|(_, depth)| *depth > 0.0) {
                sums[(node / rows) % stride * stride + (node % rows) % stride] += depth;
            }
            let coarser = (STRIDES[0] as f64 / stride as f64).powi(4);
            let apart = |sum: &f64| (sum * lattices / total - 1.0).powi(2);
            squares += coarser * sums[..stride * stride].iter().map(apart).sum::<f64>();
            // The lattices share the total.
            count += lattices - 1.0;
        }
        Some((squares / count).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Point3;

    use super::*;
    use crate::layout::HexStrip;
    use crate::material::Material;
    use crate::surface::SurfaceLaws;

    /// A plate of 36 columns and 36 rows or, at half the pitch, of four times as many nodes.
    fn plate(pitch: f64, depth: impl Fn(usize, &Point3<f64>) -> f64) -> Surface {
        let (length, width) = (36.0 * 0.75f64.sqrt() * 0.1, 3.6);
        let strip = HexStrip { length, width, pitch, rest_area: None };
        let young = Some(100.0);
        let (hardness, shear_ratio, poisson, friction) = (1.0, 0.25, 0.3, 0.3);
        let material = Material { hardness, shear_ratio, young, poisson, friction };
        let mut surface = Surface::hex_strip(strip, SurfaceLaws::of(material)).expect("a plate");
        for i in 0..surface.nodes.len() {
            surface.nodes.depth[i] = depth(i, &surface.nodes.rest_position[i]);
        }
        surface
    }

    /// Fails for a lattice that is not every second column and row: here one of four has it all.
    #[test]
    fn what_one_lattice_has_alone_scatters() {
        let alone = plate(0.1, |i, _| if i / 36 % 2 == 1 && i % 2 == 0 { 1.0 } else { 0.0 });
        let expected = ((9.0 + 3.0) / 11f64).sqrt();
        let found = alone.sublattice_scatter().expect("a scatter");
        assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        assert_eq!(plate(0.1, |_, _| 0.0).sublattice_scatter(), None);
    }

    /// Fails for one that measures the depths and not how well they are sampled.
    #[test]
    fn a_dent_scatters_less_on_a_finer_lattice() {
        // Root mean square over the places where its middle lies.
        let scatter = |pitch: f64| {
            let places = (0..8).map(|i| f64::from(i) * 0.013);
            let scatters = places.map(|x| {
                let apart = |at: &Point3<f64>| (at.x - x).powi(2) + (at.y + 0.7 * x).powi(2);
                let dent = plate(pitch, |_, at| (1.0 - apart(at)).max(0.0));
                dent.sublattice_scatter().expect("a scatter").powi(2)
            });
            scatters.sum::<f64>().sqrt()
        };
        let ratio = scatter(0.1) / scatter(0.05);
        assert!(ratio > 2.0, "{ratio}");
    }
}
