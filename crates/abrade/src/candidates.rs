//! The nodes a body may touch next, cached over the steps of a contact.

use nalgebra::{Point3, Vector3};

use crate::body::State;
use crate::extent::{bounds, bounds_below, clearance};
use crate::grid::Grid;
use crate::shape::{Piece, Shape};
#[cfg(feature = "state")]
use crate::state::{Fault, finite, not_negative, positive, require};
use crate::surface::Surface;
use crate::sweep::Swept;

/// A node in the cache: what the inner loop reads, side by side.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Slot {
    pub id: u32,
    /// Hardness over that of the material [-].
    pub factor: f64,
    /// Present position in the surface's frame [m].
    pub x: Point3<f64>,
    pub n: Vector3<f64>,
    pub area: f64,
}

impl Slot {
    /// Node `i`, which is at `x`.
    fn of(surface: &Surface, i: usize, x: Point3<f64>) -> Self {
        let nodes = surface.nodes();
        Self {
            id: i as u32,
            factor: surface.hardness_factor(i),
            x,
            n: nodes.normal[i],
            area: nodes.rest_area[i],
        }
    }
}

/// The cache: every node whose distance from the body was below a margin when it was made.
#[derive(Clone, Debug, Default)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Candidates {
    pub slots: Vec<Slot>,
    /// Pose at which the cache was made, and how far the body may move from it.
    pub made: Option<(State, f64)>,
    /// Box around the undeformed nodes whose depths were read.
    pub read: Option<[Point3<f64>; 2]>,
}

impl Candidates {
    /// How far any point of the body may still move before the cache must be made anew [m];
    /// negative when it must.
    pub(crate) fn slack(&self, shape: &Shape, state: &State) -> f64 {
        let Some((at, margin)) = &self.made else { return -1.0 };
        margin - travel(shape, at, state)
    }

    /// Collects the nodes within `margin` [m] of the body, which is inflated by `inflation`.
    pub(crate) fn collect(
        &mut self,
        surface: &Surface,
        shape: &Shape,
        state: &State,
        inflation: f64,
        margin: f64,
    ) {
        self.slots.clear();
        let reach = margin + inflation;
        let [low, high] = reach_box(surface.grid(), shape, state, reach);
        self.read(&low, &high);
        surface.grid().visit(&low, &high, |i| {
            let x = surface.position(i);
            if clearance(shape, state, &x) < reach {
                self.slots.push(Slot::of(surface, i, x));
            }
        });
        self.slots.sort_unstable_by_key(|slot| slot.id);
        self.made = Some((*state, margin));
    }

    /// Collects the corners of `facets` that are `near`.
    pub(crate) fn collect_corners(
        &mut self,
        surface: &Surface,
        facets: &[[u32; 3]],
        near: impl Fn(&Point3<f64>) -> bool,
    ) {
        self.slots.clear();
        for i in facets.iter().flatten().map(|&id| id as usize) {
            let x = surface.position(i);
            if near(&x) {
                self.slots.push(Slot::of(surface, i, x));
            }
        }
        self.slots.sort_unstable_by_key(|slot| slot.id);
        self.slots.dedup_by_key(|slot| slot.id);
    }

    /// Collects the nodes whose column, at or below the node, comes within `margin` [m] of the
    /// body that `swept` has placed at `state`, in the grid's order.
    pub(crate) fn collect_columns(
        &mut self,
        surface: &Surface,
        shape: &Shape,
        state: &State,
        swept: &Swept,
        margin: f64,
    ) {
        self.slots.clear();
        let [low, high] = match surface.level() {
            Some(n) => {
                let top = surface.grid().bounds()[1].coords.dot(&n) + margin;
                bounds_below(shape, state, &n, top, margin)
            }
            None => bounds(shape, state, 2.0 * (margin + surface.deepest)),
        };
        let nodes = surface.nodes();
        self.read(&low, &high);
        surface.grid().visit(&low, &high, |i| {
            let x = surface.position(i);
            let n = nodes.normal[i];
            if swept.meets(&x, &n, margin, surface.reach(i as u32) - surface.depth(i)) {
                self.slots.push(Slot::of(surface, i, x));
            }
        });
        self.made = Some((*state, margin));
    }

    /// Notes that the depths of the nodes in a box were read.
    fn read(&mut self, low: &Point3<f64>, high: &Point3<f64>) {
        let [from, to] = self.read.unwrap_or([*low, *high]);
        self.read = Some([from.inf(low), to.sup(high)]);
    }

    /// Forces a new collection at the next step.
    pub(crate) fn forget(&mut self) {
        self.made = None;
    }
}

/// Bound of the distance that any point of the body moved between two poses [m].
pub(crate) fn travel(shape: &Shape, from: &State, to: &State) -> f64 {
    let shift = (to.position - from.position).norm();
    match shape.pieces() {
        [Piece::Ball(ball)] if ball.centre == Point3::origin() => shift,
        _ => shift + shape.bounding_radius() * from.rotation.angle_to(&to.rotation),
    }
}

/// Box that holds every node within `reach` of the shape. A lone ball meets the box of the nodes
/// in a cap that is smaller than itself.
fn reach_box(grid: &Grid, shape: &Shape, state: &State, reach: f64) -> [Point3<f64>; 2] {
    let [Piece::Ball(ball)] = shape.pieces() else {
        return bounds(shape, state, reach);
    };
    let centre = state.position + state.rotation * ball.centre.coords;
    let [low, high] = grid.bounds();
    let off: Vector3<f64> =
        Vector3::from_fn(|a, _| (low[a] - centre[a]).max(centre[a] - high[a]).max(0.0));
    let radius = ball.radius + reach;
    let half: Vector3<f64> = Vector3::from_fn(|a, _| {
        let others = off.norm_squared() - off[a] * off[a];
        (radius * radius - others).max(0.0).sqrt()
    });
    [centre - half, centre + half]
}

#[cfg(feature = "state")]
impl Candidates {
    pub(crate) fn check(&self) -> Result<(), Fault> {
        let sorted = self.slots.is_sorted_by(|a, b| a.id < b.id);
        require(sorted, "candidates are not in their order")?;
        let numbers = |slot: &Slot| {
            let sizes = positive(slot.area) && positive(slot.factor);
            finite(slot.x.coords.iter().chain(slot.n.iter())) && sizes
        };
        let made = self.made.as_ref().is_none_or(|(_, margin)| not_negative(*margin));
        require(made && self.slots.iter().all(numbers), "candidates are out of range")
    }

    /// True when every candidate is one of `nodes`.
    pub(crate) fn lie_on(&self, nodes: usize) -> bool {
        self.slots.last().is_none_or(|slot| (slot.id as usize) < nodes)
    }
}
