//! The candidates of columns as benches see them.

use super::Columns;
use crate::body::State;
use crate::candidates::travel;
use crate::probe::Candidate;
use crate::shape::Shape;

impl Columns {
    /// Depth of every column that the last trial took away [m].
    pub(crate) fn drops(&self) -> Vec<f64> {
        let mut drops = vec![0.0; self.columns.len()];
        for cut in &self.cuts {
            drops[cut.index as usize] = cut.pieces.iter().map(|piece| piece[1] - piece[0]).sum();
        }
        drops
    }

    pub(crate) fn coefficient(&self) -> f64 {
        self.law.stiffness()
    }

    /// The marks before a step that `before` had yet to take.
    pub(crate) fn marks_of(&self, before: &Self) -> Vec<f64> {
        let ids =
            |columns: &Self| columns.candidates.slots.iter().map(|s| s.id).collect::<Vec<_>>();
        match ids(self) == ids(before) {
            true => before.marks.clone(),
            false => vec![0.0; self.marks.len()],
        }
    }

    pub(crate) fn set_marks(&mut self, marks: &[f64]) {
        self.marks.copy_from_slice(marks);
        self.dues.fill(0.0);
    }

    /// How long the body's way is at `end`, the end of a step from where it stood [m].
    pub(crate) fn way(&self, shape: &Shape, end: &State) -> f64 {
        self.stood.1 + travel(shape, &self.stood.0, end)
    }

    /// The candidates with these marks.
    pub(crate) fn recorded(&self, marks: &[f64]) -> Vec<Candidate> {
        let pairs = self.candidates.slots.iter().zip(&self.columns).zip(marks);
        let of = pairs.map(|((slot, column), &mark)| {
            let (voids, count) = column.recorded();
            Candidate {
                x: slot.x,
                n: slot.n,
                area: slot.area,
                factor: slot.factor,
                stretch: Default::default(),
                overlap: column.squeeze,
                excess: [0.0; 2],
                mark,
                voids,
                count,
            }
        });
        of.collect()
    }
}
