//! From a surface with copies to surfaces. Their places come from a product and a sum alone, which
//! every machine rounds alike.

use crate::scene::{Copies, Rotation, SceneSurface};
use crate::stream::numbered;

/// Most copies of a surface.
pub(crate) const MOST: u64 = 10_000;

impl Copies {
    /// Number of all copies.
    pub(crate) fn count(&self) -> u64 {
        let Self::Grid { counts, .. } = self;
        counts.iter().fold(1, |product, &count| product.saturating_mul(u64::from(count)))
    }

    /// Way from the first copy to the one of this `number`, from 0 [m].
    fn way(&self, number: u64) -> [f64; 3] {
        let Self::Grid { counts, spacing } = self;
        let mut rest = number;
        std::array::from_fn(|axis| {
            let along = u64::from(counts[axis]).max(1);
            let place = rest % along;
            rest /= along;
            spacing[axis] * place as f64
        })
    }
}

impl SceneSurface {
    /// The surfaces that `name` stands for, in the order of their numbers: its copies, at most
    /// [`MOST`], or itself if it has none.
    pub(crate) fn copies(&self, name: &str) -> impl Iterator<Item = (String, Self)> {
        let count = self.copies.as_ref().map_or(1, Copies::count);
        (0..count.min(MOST)).map(move |number| {
            let Some(copies) = &self.copies else { return (name.to_owned(), self.clone()) };
            let way = copies.way(number);
            let position = std::array::from_fn(|axis| self.position[axis] + way[axis]);
            let rotation = turned(&self.rotation, number);
            let copy = Self { position, rotation, copies: None, ..self.clone() };
            (numbered(name, number + 1, count), copy)
        })
    }
}

/// The rotation of the copy of this `number`.
fn turned(first: &Rotation, number: u64) -> Rotation {
    match *first {
        Rotation::Random { seed } => Rotation::Random { seed: seed.wrapping_add(number) },
        ref rotation => rotation.clone(),
    }
}
