//! Which nodes have sunk since somebody last looked: for whoever shows a surface and would rather
//! read what has changed than every node. A surface that nobody watches does not know of it.

use crate::surface::Surface;

/// The nodes that have sunk since the last look.
#[derive(Clone, Debug)]
pub(crate) struct Sunk {
    /// Per node.
    is_noted: Vec<bool>,
    /// Each once.
    nodes: Vec<u32>,
}

impl Surface {
    /// Begins to note which nodes sink, from none. A leaf notes none; whoever applies its changes
    /// to the surface below has them noted there.
    pub fn watch(&mut self) {
        if self.leaf.is_some() {
            return;
        }
        let count = self.nodes.len();
        self.sunk.get_or_insert_with(|| Box::new(Sunk::new(count))).clear();
    }

    /// Notes that node `id` has sunk, if somebody watches.
    #[inline(always)]
    pub(crate) fn note_sunk(&mut self, id: u32) {
        if let Some(sunk) = &mut self.sunk {
            sunk.note(id);
        }
    }

    /// The nodes that are not where they were at the last [`Surface::watch`], each once; after a
    /// renewal all of them. None for a surface that was never watched.
    pub fn sunk(&self) -> Option<&[u32]> {
        self.sunk.as_ref().map(|sunk| &*sunk.nodes)
    }
}

impl Sunk {
    fn new(count: usize) -> Self {
        Self { is_noted: vec![false; count], nodes: Vec::new() }
    }

    /// Notes node `id`. Out of line, for the sake of surfaces that nobody watches.
    #[inline(never)]
    pub(crate) fn note(&mut self, id: u32) {
        let is_noted = &mut self.is_noted[id as usize];
        if !std::mem::replace(is_noted, true) {
            self.nodes.push(id);
        }
    }

    /// Notes every node.
    pub(crate) fn note_all(&mut self) {
        self.is_noted.fill(true);
        self.nodes = (0..self.is_noted.len() as u32).collect();
    }

    fn clear(&mut self) {
        self.nodes.drain(..).for_each(|id| self.is_noted[id as usize] = false);
    }

    /// The nodes in ascending order, for the bytes of a surface.
    #[cfg(feature = "state")]
    pub(crate) fn sorted(mut self) -> Vec<u32> {
        self.nodes.sort_unstable();
        self.nodes
    }

    /// What [`Sunk::sorted`] gave for a surface of `count` nodes; None when it cannot have.
    #[cfg(feature = "state")]
    pub(crate) fn of(nodes: Vec<u32>, count: usize) -> Option<Self> {
        let is_sorted = nodes.is_sorted_by(|a, b| a < b);
        if !is_sorted || nodes.last().is_some_and(|last| *last as usize >= count) {
            return None;
        }
        let mut sunk = Self::new(count);
        nodes.into_iter().for_each(|id| sunk.note(id));
        Some(sunk)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use nalgebra::Vector3;

    use super::*;
    use crate::material::Material;
    use crate::mesh::TriangleMesh;
    use crate::surface::SurfaceLaws;

    /// Fails for nodes that a leaf or a renewal moves unseen, for one noted twice, and for notes
    /// that nobody asked for.
    #[test]
    fn whatever_moves_a_node_is_noted_once() {
        let hardness = 1e6;
        let (young, poisson, friction) = (Some(1e9), 0.3, 0.3);
        let material = Material { hardness, shear_ratio: 0.25, young, poisson, friction };
        let mesh = TriangleMesh::cuboid(Vector3::new(1.0, 1.0, 1.0), 0.2).expect("a block");
        let mut surface = Surface::mesh(&mesh, SurfaceLaws::of(material)).expect("a surface");
        surface.sink(3, 1e-3);
        assert_eq!(surface.sunk(), None);
        surface.watch();
        assert_eq!(surface.sunk(), Some(&[][..]));
        [7, 2, 7].into_iter().for_each(|i| surface.sink(i, 1e-3));
        assert_eq!(surface.sunk(), Some(&[7, 2][..]));
        let below = Arc::new(surface);
        let mut leaf = Surface::leaf(&below);
        [2, 9].into_iter().for_each(|i| leaf.sink(i, 1e-3));
        let changes = leaf.into_changes();
        let mut surface = Arc::into_inner(below).expect("no leaf");
        surface.apply(&changes);
        assert_eq!(surface.sunk(), Some(&[7, 2, 9][..]));
        surface.watch();
        surface.sink(7, 1e-3);
        assert_eq!(surface.sunk(), Some(&[7][..]));
        surface.renew().expect("a renewal");
        let all = surface.sunk().expect("notes").len();
        assert_eq!(all, surface.nodes().len());
    }
}
