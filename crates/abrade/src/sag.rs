//! How far a worn surface lies below its undeformed self, as something that rests on it feels it:
//! an engine's contact with the undeformed shape is re-placed by that much.

use nalgebra::{Point3, Vector3};

use crate::surface::Surface;

impl Surface {
    /// How much deeper than on the undeformed nodes a ball comes to lie on the worn ones [m], when
    /// it is let down along minus the surface's normal from `centre`. Flat surfaces alone: zero
    /// where normals differ.
    pub fn sag_under_ball(&self, centre: &Point3<f64>, radius: f64) -> f64 {
        let Some(n) = self.level().filter(|_| self.deepest() > 0.0) else { return 0.0 };
        // A node farther out than this cannot be the first that the ball touches.
        let deepest = (self.deepest() + self.pitch() * self.pitch() / radius).min(radius);
        let reach = (deepest * (2.0 * radius - deepest)).sqrt() + self.pitch();
        let (mut rest, mut worn) = (f64::INFINITY, f64::INFINITY);
        self.visit_around(centre, reach, |x, depth| {
            let arm: Vector3<f64> = x - centre;
            let height = arm.dot(&n);
            let aside = arm.norm_squared() - height * height;
            if aside < radius * radius {
                let gap = -(radius * radius - aside).sqrt() - height;
                rest = rest.min(gap);
                worn = worn.min(gap + depth);
            }
        });
        if worn.is_finite() { worn - rest } else { 0.0 }
    }

    /// Smallest depth of the nodes within `reach` [m] of `point`, seen along the normal [m]: how
    /// deep a corner comes to lie there. Zero where there is no node, or normals differ.
    pub fn sag_at(&self, point: &Point3<f64>, reach: f64) -> f64 {
        let Some(n) = self.level().filter(|_| self.deepest() > 0.0) else { return 0.0 };
        let mut smallest = f64::INFINITY;
        self.visit_around(point, reach, |x, depth| {
            let arm: Vector3<f64> = x - point;
            let height = arm.dot(&n);
            if arm.norm_squared() - height * height <= reach * reach {
                smallest = smallest.min(depth);
            }
        });
        if smallest.is_finite() { smallest } else { 0.0 }
    }

    /// Shows the undeformed position and the depth of the nodes within `reach` [m] of `point` and
    /// of some more, whatever their height.
    fn visit_around(
        &self,
        point: &Point3<f64>,
        reach: f64,
        mut show: impl FnMut(Point3<f64>, f64),
    ) {
        let [bottom, top] = self.bounds();
        let (mut low, mut high) = (point - Vector3::repeat(reach), point + Vector3::repeat(reach));
        (low.z, high.z) = (low.z.min(bottom.z), high.z.max(top.z));
        let rest = &self.nodes().rest_position;
        self.grid().visit(&low, &high, |i| show(rest[i], self.depth(i)));
    }
}
