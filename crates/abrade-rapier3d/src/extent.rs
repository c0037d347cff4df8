//! Boxes around where a body can be over a time: cheap, and never too small.

use nalgebra::{Isometry3, Point3, Vector3};

/// A box along the axes of some frame [m].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Extent {
    pub low: Point3<f64>,
    pub high: Point3<f64>,
}

impl Extent {
    /// A floor that nothing is over.
    pub const NO_FLOOR: Self = Self {
        low: Point3::new(f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY),
        high: Point3::new(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::INFINITY),
    };

    /// Around the path of a point that starts at `from` with `velocity` [m/s] and is accelerated
    /// [m/s2] for `time` [s]. The turning point of the parabola lies within the margin.
    pub fn of_path(
        from: &Point3<f64>,
        velocity: &Vector3<f64>,
        acceleration: &Vector3<f64>,
        time: f64,
    ) -> Self {
        let straight = from + velocity * time;
        let bend = (acceleration * (0.5 * time * time)).abs();
        Self { low: from.inf(&straight) - bend, high: from.sup(&straight) + bend }
    }

    /// As [`Extent::of_path`], from one time to another [s].
    pub fn of_part(
        from: &Point3<f64>,
        velocity: &Vector3<f64>,
        acceleration: &Vector3<f64>,
        [start, end]: [f64; 2],
    ) -> Self {
        let at = from + velocity * start + acceleration * (0.5 * start * start);
        Self::of_path(&at, &(velocity + acceleration * start), acceleration, end - start)
    }

    /// This box and `by` [m] around it.
    pub fn grown(&self, by: f64) -> Self {
        let margin = Vector3::repeat(by);
        Self { low: self.low - margin, high: self.high + margin }
    }

    /// Do the boxes share a point?
    pub fn meets(&self, other: &Self) -> bool {
        (0..3).all(|a| self.low[a] <= other.high[a] && other.low[a] <= self.high[a])
    }

    /// The box, along the axes of the outer frame, around this one placed by `frame`.
    pub fn placed_by(&self, frame: &Isometry3<f64>) -> Self {
        let centre = frame * nalgebra::center(&self.low, &self.high);
        let turn = frame.rotation.to_rotation_matrix();
        let half = turn.matrix().abs() * self.half();
        Self { low: centre - half, high: centre + half }
    }

    /// Does `other` lie in this box?
    pub fn holds(&self, other: &Self) -> bool {
        (0..3).all(|a| self.low[a] <= other.low[a] && other.high[a] <= self.high[a])
    }

    /// Half the edges [m].
    pub fn half(&self) -> Vector3<f64> {
        (self.high - self.low) / 2.0
    }

    /// Does this box lie within the borders, in x and y, of `surface`?
    pub fn is_over(&self, surface: &Self) -> bool {
        (0..2).all(|a| surface.low[a] <= self.low[a] && self.high[a] <= surface.high[a])
    }

    /// The part above the plane `z` [m]: what lies below a surface is behind it.
    pub fn above(&self, z: f64) -> Self {
        let mut cut = *self;
        cut.low.z = cut.low.z.max(z).min(cut.high.z);
        cut
    }

    /// The box around this one and another.
    pub fn joined(&self, other: &Self) -> Self {
        Self { low: self.low.inf(&other.low), high: self.high.sup(&other.high) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for a box that ends at the end points of the path.
    #[test]
    fn a_path_that_turns_back_stays_inside_its_box() {
        let (up, g) = (Vector3::new(1.0, 0.0, 3.0), Vector3::new(0.0, 0.0, -9.81));
        let extent = Extent::of_path(&Point3::origin(), &up, &g, 0.7);
        for i in 0..=100 {
            let t = 0.7 * i as f64 / 100.0;
            let p = Point3::from(up * t + g * (0.5 * t * t));
            assert!(extent.meets(&Extent { low: p, high: p }), "at {t} s");
        }
    }

    /// Fails for a box that is turned about the wrong point, or not widened.
    #[test]
    fn a_turned_box_still_holds_its_corners() {
        let box_ = Extent { low: Point3::new(1.0, 2.0, 3.0), high: Point3::new(2.0, 5.0, 4.0) };
        let frame = Isometry3::new(Vector3::new(7.0, 0.0, -1.0), Vector3::new(0.3, -0.8, 0.5));
        let placed = box_.placed_by(&frame).grown(1e-12);
        for i in 0..8 {
            let pick = |a: usize| if i >> a & 1 == 0 { box_.low[a] } else { box_.high[a] };
            let corner = frame * Point3::new(pick(0), pick(1), pick(2));
            assert!(placed.meets(&Extent { low: corner, high: corner }));
        }
    }
}
