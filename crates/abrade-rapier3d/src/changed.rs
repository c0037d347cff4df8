//! Where the surfaces were changed in the step under way: what a body has done ahead of its turn
//! holds only if nobody before it has changed a node that it read.

use abrade::Changes;
use nalgebra::Point3;

use crate::bins::Bins;
use crate::extent::Extent;
use crate::surface::WornCollider;

/// The changed places of every surface, in its frame.
#[derive(Default)]
pub(crate) struct Changed {
    places: Vec<Places>,
    noted: bool,
}

#[derive(Default)]
struct Places {
    boxes: Vec<Extent>,
    bins: Bins,
}

impl Changed {
    /// Forgets all places and notes none.
    pub fn clear(&mut self) {
        self.noted = false;
    }

    /// Notes changes from now on, of about `count` bodies.
    pub fn note(&mut self, surfaces: &[WornCollider], count: usize) {
        self.noted = true;
        self.places.resize_with(surfaces.len(), Places::default);
        for (places, worn) in self.places.iter_mut().zip(surfaces) {
            places.boxes.clear();
            places.bins.lay(&worn.bounds, 1, count);
        }
    }

    /// Whether changes are noted.
    pub fn is_noted(&self) -> bool {
        self.noted
    }

    /// Adds what a leaf of surface number `surface` has changed.
    pub fn add(&mut self, surface: usize, worn: &WornCollider, changes: &Changes) {
        let Some([low, high]) = changes.bounds(worn.surface.nodes()) else { return };
        let Some(places) = self.places.get_mut(surface) else { return };
        let extent = Extent { low, high };
        places.bins.insert(0, &extent, places.boxes.len() as u32);
        places.boxes.push(extent);
    }

    /// True when no undeformed node in the box has been changed, nor one that sank into it.
    pub fn spares(&self, surface: usize, worn: &WornCollider, read: [Point3<f64>; 2]) -> bool {
        if worn.broken {
            return false;
        }
        let Some(places) = self.places.get(surface) else { return true };
        let [low, high] = read;
        let read = Extent { low, high }.grown(worn.surface.worn().max_depth);
        !places.bins.find(0, &read).any(|place| places.boxes[place as usize].meets(&read))
    }
}
