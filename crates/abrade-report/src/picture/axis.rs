//! Axes: ticks at round values, their numbers, the name with its unit.

use super::canvas::{Align, Canvas, Rect, Text};
use super::colour::INK;
use crate::error::ReportError;
use crate::units::{Unit, tick_text, ticks};

/// Length of a tick [pixels].
const TICK: f64 = 7.0;
/// Distance between ticks that is aimed at, across and down [pixels].
const PACE: [f64; 2] = [110.0, 64.0];

/// A linear scale: values `ends` [SI] stand at the two ends of a side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale<'a> {
    pub(super) ends: [f64; 2],
    pub(super) unit: Unit,
    /// What is measured; the unit is added.
    pub(super) name: &'a str,
}

impl Scale<'_> {
    /// Along the lower side of `rect`, from left to right.
    pub(super) fn below(&self, canvas: &mut Canvas, rect: &Rect) -> Result<(), ReportError> {
        for (share, text) in self.marks(rect.width() / PACE[0]) {
            let x = rect.left + share * rect.width();
            canvas.line(&[[x, rect.bottom], [x, rect.bottom + TICK]], INK, 1.0)?;
            canvas.text([x, rect.bottom + 23.0], &text, Text::default());
        }
        let middle = [(rect.left + rect.right) / 2.0, rect.bottom + 54.0];
        canvas.text(middle, &self.label(), Text::default());
        Ok(())
    }

    /// Along the left side of `rect`, from top to bottom.
    pub(super) fn left(&self, canvas: &mut Canvas, rect: &Rect) -> Result<(), ReportError> {
        for (share, text) in self.marks(rect.height() / PACE[1]) {
            let y = rect.top + share * rect.height();
            canvas.line(&[[rect.left - TICK, y], [rect.left, y]], INK, 1.0)?;
            let look = Text { align: Align::Right, ..Text::default() };
            canvas.text([rect.left - 13.0, y], &text, look);
        }
        let middle = [rect.left - 84.0, (rect.top + rect.bottom) / 2.0];
        canvas.text(middle, &self.label(), Text { upright: true, ..Text::default() });
        Ok(())
    }

    /// Along the right side of `rect`, from top to bottom, named above.
    pub(super) fn right(&self, canvas: &mut Canvas, rect: &Rect) -> Result<(), ReportError> {
        for (share, text) in self.marks(rect.height() / PACE[1]) {
            let y = rect.top + share * rect.height();
            canvas.line(&[[rect.right, y], [rect.right + TICK, y]], INK, 1.0)?;
            let look = Text { align: Align::Left, ..Text::default() };
            canvas.text([rect.right + 13.0, y], &text, look);
        }
        let look = Text { align: Align::Left, ..Text::default() };
        canvas.text([rect.left, rect.top - 24.0], &self.label(), look);
        Ok(())
    }

    fn label(&self) -> String {
        format!("{} ({})", self.name, self.unit.name)
    }

    /// Where ticks stand, as a share of the side, and their texts.
    fn marks(&self, wanted: f64) -> Vec<(f64, String)> {
        let [first, last] = self.ends.map(|value| value / self.unit.size);
        let (values, decimals) = ticks(first.min(last), first.max(last), wanted.max(2.0));
        let share = |value: f64| (value - first) / (last - first);
        values.into_iter().map(|v| (share(v), tick_text(v, decimals))).collect()
    }
}
