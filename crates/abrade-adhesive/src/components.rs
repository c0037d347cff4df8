//! Connected components of a graph over the elements.

/// A graph's components, joined edge by edge.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Components {
    parent: Vec<u32>,
    size: Vec<u32>,
}

impl Components {
    /// `count` vertices without an edge.
    pub(crate) fn new(count: usize) -> Self {
        Self { parent: (0..count as u32).collect(), size: vec![1; count] }
    }

    /// Adds the edge from `i` to `j`.
    pub(crate) fn join(&mut self, [i, j]: [u32; 2]) {
        let (i, j) = (self.root(i as usize), self.root(j as usize));
        if i == j {
            return;
        }
        let (small, large) = if self.size[i] < self.size[j] { (i, j) } else { (j, i) };
        self.parent[small] = large as u32;
        self.size[large] += self.size[small];
    }

    /// The vertex that stands for the component of `i`.
    pub(crate) fn root(&mut self, mut i: usize) -> usize {
        while self.parent[i] as usize != i {
            self.parent[i] = self.parent[self.parent[i] as usize];
            i = self.parent[i] as usize;
        }
        i
    }

    /// Number of vertices in the component that `root` stands for.
    pub(crate) fn size(&self, root: usize) -> usize {
        self.size[root] as usize
    }
}
