//! A leaf of a surface: a surface of its own that shares everything with the one below but what it
//! wears, so that several encounters can wear one surface at once without knowing of each other.
//!
//! Whoever owns the surface applies the changes of its leaves, in whatever order it finds right.
//! A leaf gives the bits of the surface itself as long as nobody has changed a node that was read.

use std::sync::Arc;

use nalgebra::Point3;

use crate::nodes::Nodes;
use crate::surface::Surface;
use crate::worn::Worn;

/// Slots that a leaf begins with; a power of two, as all its numbers of slots.
const SLOTS: usize = 128;
/// No node.
const FREE: u32 = u32::MAX;

/// The depths in which a leaf differs from the surface below.
#[derive(Clone, Debug)]
pub(crate) struct Leaf {
    below: Arc<Surface>,
    /// Node and depth [m], open addressing: at the node's slot or the next free one.
    slots: Vec<(u32, f64)>,
    count: usize,
}

/// What a leaf has worn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Changes {
    /// Nodes and their depths [m].
    depths: Vec<(u32, f64)>,
    gain: Worn,
}

impl Leaf {
    pub(crate) fn new(below: &Arc<Surface>) -> Self {
        Self { below: Arc::clone(below), slots: Vec::new(), count: 0 }
    }

    pub(crate) fn below(&self) -> &Surface {
        &self.below
    }

    /// The slot of node `id`, or the free one that it would take.
    fn find(&self, id: u32) -> usize {
        // The golden ratio spreads neighbours over the slots.
        let mask = self.slots.len() - 1;
        let mut at = (id.wrapping_mul(0x9e37_79b9) >> 8) as usize & mask;
        while self.slots[at].0 != id && self.slots[at].0 != FREE {
            at = (at + 1) & mask;
        }
        at
    }

    /// Depth of node `id` [m]. Out of line, for the sake of surfaces that are no leaves.
    #[inline(never)]
    pub(crate) fn depth(&self, id: u32) -> f64 {
        if self.count > 0 {
            let (node, depth) = self.slots[self.find(id)];
            if node == id {
                return depth;
            }
        }
        self.below.depth(id as usize)
    }

    /// Sinks node `id` by `drop` [m] and returns its depth [m]. Out of line as well.
    #[inline(never)]
    pub(crate) fn sink(&mut self, id: u32, drop: f64) -> f64 {
        if 2 * (self.count + 1) > self.slots.len() {
            self.grow();
        }
        let at = self.find(id);
        if self.slots[at].0 == FREE {
            self.slots[at] = (id, self.below.depth(id as usize));
            self.count += 1;
        }
        let depth = &mut self.slots[at].1;
        *depth += drop;
        *depth
    }

    fn grow(&mut self) {
        let more = (2 * self.slots.len()).max(SLOTS);
        let old = std::mem::replace(&mut self.slots, vec![(FREE, 0.0); more]);
        for slot in old.into_iter().filter(|(id, _)| *id != FREE) {
            let at = self.find(slot.0);
            self.slots[at] = slot;
        }
    }

    /// W_V [m3] that the leaf adds to that of the surface below.
    pub(crate) fn added_volume(&self) -> f64 {
        let nodes = self.below.nodes();
        let changed = self.slots.iter().filter(|(id, _)| *id != FREE);
        let added = |&(id, depth): &(u32, f64)| {
            nodes.rest_area[id as usize] * (depth - self.below.depth(id as usize))
        };
        changed.map(added).sum()
    }

    /// The changed nodes with their depths; lets go of the surface below.
    pub(crate) fn into_changes(self, gain: Worn) -> Changes {
        let mut depths = self.slots;
        depths.retain(|(id, _)| *id != FREE);
        Changes { depths, gain }
    }
}

impl Changes {
    /// Changes that bring nodes of a surface down to these depths [m], without volumes; deeper ones stay
    /// where they are. [`Surface::apply`] panics where it has no such node.
    pub fn to_depths(depths: Vec<(u32, f64)>) -> Self {
        Self { depths, gain: Worn::default() }
    }

    /// Volumes worn off by the leaf, and its largest load.
    pub fn gain(&self) -> &Worn {
        &self.gain
    }

    /// Box around the changed nodes, undeformed, in the surface's frame [m].
    pub fn bounds(&self, nodes: &Nodes) -> Option<[Point3<f64>; 2]> {
        let mut positions = self.depths.iter().map(|(id, _)| nodes.rest_position[*id as usize]);
        let first = positions.next()?;
        Some(positions.fold([first; 2], |[low, high], p| [low.inf(&p), high.sup(&p)]))
    }

    /// The changed nodes.
    pub(crate) fn nodes(&self) -> impl Iterator<Item = u32> {
        self.depths.iter().map(|(id, _)| *id)
    }

    /// Writes the changed depths and returns the largest [m].
    pub(crate) fn write(&self, depth: &mut [f64]) -> f64 {
        let mut deepest = 0.0f64;
        for (id, new) in &self.depths {
            if let Some(depth) = depth.get_mut(*id as usize) {
                *depth = depth.max(*new);
                deepest = deepest.max(*depth);
            }
        }
        deepest
    }
}
