//! Round elements in a plane at some instants: coloured by a quantity on the left, their links on the right.

use super::canvas::{Align, Canvas, Rect, Text};
use super::colour::{self, INK, Rgb, SOFT};
use super::scale_bar;
use crate::error::ReportError;

/// Elements at some instants, one below the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Rounds<'a> {
    /// Headline.
    pub title: &'a str,
    /// A line below it.
    pub caption: &'a str,
    /// What the colour shows, with its unit.
    pub quantity: &'a str,
    /// Diameter of the elements [m].
    pub diameter: f64,
    /// Lower left and upper right corner of what is shown [m].
    pub window: [[f64; 2]; 2],
    /// The instants.
    pub instants: Vec<Instant>,
}

/// Elements at an instant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Instant {
    /// What it is called.
    pub name: String,
    /// Centres [m], and the quantity there.
    pub elements: Vec<([f64; 2], f64)>,
    /// Ends of the links [m], and whether a link was made on the way.
    pub links: Vec<([[f64; 2]; 2], bool)>,
}

/// Width of a panel [pixels].
const WIDTH: f64 = 720.0;
/// Left of the panels, between them, above the first row [pixels].
const LEFT: f64 = 40.0;
const GAP: f64 = 24.0;
const TOP: f64 = 150.0;
/// Between rows, for the name of the next [pixels].
const BETWEEN: f64 = 44.0;
/// Below the last row, for the colours [pixels].
const FOOT: f64 = 100.0;
/// Longest bar that shows the scale, and the room for its name [pixels].
const BAR: f64 = 200.0;
const NAME: f64 = 100.0;
/// A link that was there from the start, and one that was made.
const OLD: Rgb = [96, 110, 130];
const NEW: Rgb = [213, 94, 0];

impl Rounds<'_> {
    /// The picture as the bytes of a PNG file.
    ///
    /// # Errors
    /// The drawing library's own.
    pub fn to_png(&self) -> Result<Vec<u8>, ReportError> {
        let [low, high] = self.window;
        let scale = WIDTH / (high[0] - low[0]).max(f64::MIN_POSITIVE);
        let height = ((high[1] - low[1]) * scale).clamp(40.0, 4000.0);
        let rows = self.instants.len() as f64;
        let size = [2.0 * (LEFT + WIDTH) + GAP, TOP + rows * (height + BETWEEN) + FOOT];
        let mut canvas = Canvas::new(size[0] as usize, size[1] as usize)?;
        let look = Text { size: 34.0, bold: true, align: Align::Left, ..Text::default() };
        let title = canvas.fitted(self.title, look, size[0] - 2.0 * LEFT);
        canvas.text([LEFT, 40.0], &title, look);
        let small = Text { size: 22.0, bold: false, colour: SOFT, ..look };
        let caption = canvas.fitted(self.caption, small, size[0] - 2.0 * LEFT);
        canvas.text([LEFT, 87.0], &caption, small);
        let largest = self.largest();
        for (row, instant) in self.instants.iter().enumerate() {
            let top = TOP + row as f64 * (height + BETWEEN);
            let panel = |left: f64| Rect { left, right: left + WIDTH, top, bottom: top + height };
            let look = Text { align: Align::Left, ..Text::default() };
            canvas.text([LEFT, top - 18.0], &instant.name, look);
            let left = panel(LEFT);
            self.elements(&mut canvas, &left, instant, largest)?;
            let right = panel(LEFT + WIDTH + GAP);
            self.links(&mut canvas, &right, instant)?;
            canvas.frame(&left, INK)?;
            canvas.frame(&right, INK)?;
        }
        scale_bar::draw(&mut canvas, [LEFT + WIDTH - BAR - NAME, TOP - 18.0], scale, BAR)?;
        self.legend(&mut canvas, size[1] - FOOT, largest)?;
        canvas.to_png()
    }

    fn largest(&self) -> f64 {
        let all = self.instants.iter().flat_map(|instant| &instant.elements);
        all.map(|(_, value)| *value).filter(|value| value.is_finite()).fold(0.0, f64::max)
    }

    /// Where a place is in a panel; nothing for one outside it.
    fn place(&self, panel: &Rect, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        let [low, high] = self.window;
        let inside = (low[0]..=high[0]).contains(&x) && (low[1]..=high[1]).contains(&y);
        let scale = panel.width() / (high[0] - low[0]);
        inside.then(|| [panel.left + (x - low[0]) * scale, panel.bottom - (y - low[1]) * scale])
    }

    fn elements(
        &self,
        canvas: &mut Canvas,
        panel: &Rect,
        instant: &Instant,
        largest: f64,
    ) -> Result<(), ReportError> {
        let radius = 0.5 * self.diameter * panel.width() / (self.window[1][0] - self.window[0][0]);
        for (centre, value) in &instant.elements {
            if let Some(at) = self.place(panel, *centre) {
                let share = if largest > 0.0 { value / largest } else { 0.0 };
                canvas.dot(at, radius, colour::of_share(share))?;
            }
        }
        Ok(())
    }

    fn links(
        &self,
        canvas: &mut Canvas,
        panel: &Rect,
        instant: &Instant,
    ) -> Result<(), ReportError> {
        for made in [false, true] {
            for (ends, _) in instant.links.iter().filter(|link| link.1 == made) {
                if let [Some(a), Some(b)] = ends.map(|end| self.place(panel, end)) {
                    let (colour, width) = if made { (NEW, 2.0) } else { (OLD, 1.0) };
                    canvas.line(&[a, b], colour, width)?;
                }
            }
        }
        Ok(())
    }

    fn legend(&self, canvas: &mut Canvas, top: f64, largest: f64) -> Result<(), ReportError> {
        let bar = Rect { left: LEFT, right: LEFT + 300.0, top, bottom: top + 22.0 };
        let [columns, _] = bar.sheet_size();
        canvas.paint(&bar, |column, _| Some(colour::of_share(column as f64 / columns as f64)));
        canvas.frame(&bar, INK)?;
        let middle = top + 11.0;
        let look = Text { align: Align::Left, ..Text::default() };
        let text = format!("0 to {largest:.3}: {}", self.quantity);
        canvas.text([bar.right + 16.0, middle], &text, look);
        let mut left = LEFT + WIDTH + GAP;
        for (colour, text) in [(OLD, "links of the start"), (NEW, "links made on the way")] {
            canvas.line(&[[left, middle], [left + 40.0, middle]], colour, 3.0)?;
            canvas.text([left + 52.0, middle], text, look);
            left += 300.0;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for elements outside the window, or a quantity that is zero everywhere, that stop the picture.
    #[test]
    fn any_instant_can_be_drawn() {
        let inside = ([0.5, 0.5], 0.0);
        let outside = ([7.0, -1.0], f64::NAN);
        let instant = Instant {
            name: "start".into(),
            elements: vec![inside, outside],
            links: vec![([[0.5, 0.5], [0.6, 0.5]], true), ([[0.5, 0.5], [9.0, 0.5]], false)],
        };
        let rounds = Rounds {
            title: "t",
            caption: "c",
            quantity: "q",
            diameter: 0.1,
            window: [[0.0, 0.0], [1.0, 1.0]],
            instants: vec![instant],
        };
        assert!(rounds.to_png().unwrap().starts_with(b"\x89PNG"));
    }
}
