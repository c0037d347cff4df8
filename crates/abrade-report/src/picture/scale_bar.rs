//! A bar of a round length, with the length beside it.

use super::canvas::{Align, Canvas, Text};
use super::colour::INK;
use crate::error::ReportError;
use crate::quantity_text::digits;
use crate::units::of_length;

/// Draws the bar from its left end on: a metre is `metre` pixels, and the bar at most `longest` pixels.
pub(super) fn draw(
    canvas: &mut Canvas,
    [left, y]: [f64; 2],
    metre: f64,
    longest: f64,
) -> Result<(), ReportError> {
    let (length, name) = round(longest / metre);
    let end = left + length * metre;
    canvas.line(&[[left, y], [end, y]], INK, 3.0)?;
    let look = Text { align: Align::Left, ..Text::default() };
    canvas.text([end + 14.0, y], &name, look);
    Ok(())
}

/// The longest of 1, 2 and 5 times a power of ten that is not above `most` [m], and what it is called.
fn round(most: f64) -> (f64, String) {
    let unit = of_length(most);
    let raw = most / unit.size;
    let decade = 10f64.powf(raw.log10().floor());
    let factors = [5.0, 2.0, 1.0].map(|factor| factor * decade);
    let length = factors.into_iter().find(|length| *length <= raw).unwrap_or(decade);
    (length * unit.size, format!("{}\u{a0}{}", digits(length), unit.name))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for a bar that is longer than there is room for, or whose name is not its length.
    #[test]
    fn a_bar_is_of_a_round_length_that_there_is_room_for() {
        for (most, length, name) in [
            (3.3e-4, 2e-4, "200\u{a0}µm"),
            (1.01e-3, 1e-3, "1\u{a0}mm"),
            (9.9e-9, 5e-9, "5\u{a0}nm"),
            (4e-11, 2e-11, "0.02\u{a0}nm"),
        ] {
            let (found, called) = round(most);
            assert!((found - length).abs() < 1e-12 * length, "{found} for {length}");
            assert_eq!(called, name);
        }
    }
}
