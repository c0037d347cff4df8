//! Craters side by side, all to one scale: a picture per case, rows and columns named.

use std::path::Path;

use super::canvas::{Align, Canvas, Rect, Text};
use super::colour::{INK, SOFT};
use super::plan::{colour_bar, shade, shades};
use super::raster::Grid;
use super::view::Seen;
use crate::atomic;
use crate::error::ReportError;
use crate::units::{of_length, with_unit};

/// Craters in rows and columns.
#[derive(Clone, Debug)]
pub struct Gallery<'a> {
    /// Headline.
    pub title: &'a str,
    /// A line below it.
    pub caption: &'a str,
    /// Names of the columns.
    pub columns: Vec<String>,
    /// Names of the rows, and their craters, column by column.
    pub rows: Vec<(String, Vec<Crater>)>,
}

/// A part of a worn plate, seen from above.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Crater {
    /// Nodes: x, y, depth [m]; (0, 0) is the middle of what is shown.
    pub nodes: Vec<[f64; 3]>,
    /// Distance between nodes [m].
    pub pitch: f64,
}

/// Edge of a crater's picture [pixels].
const EDGE: f64 = 190.0;
/// Between two of them [pixels].
const GAP: f64 = 12.0;
/// Left of the first column, for the names of rows [pixels].
const LEFT: f64 = 280.0;
/// Above the first row [pixels].
const TOP: f64 = 160.0;
/// Right of the last column, for the colour bar [pixels].
const RIGHT: f64 = 190.0;
/// Below the last row, for the scale [pixels].
const FOOT: f64 = 70.0;
/// Part of the edge beyond the widest crater, on either side.
const MARGIN: f64 = 1.15;

impl Gallery<'_> {
    /// The picture as the bytes of a PNG file.
    ///
    /// # Errors
    /// The drawing library's own.
    pub fn to_png(&self) -> Result<Vec<u8>, ReportError> {
        let [across, down] = [self.columns.len(), self.rows.len()].map(|count| count as f64);
        let width = LEFT + across * (EDGE + GAP) + RIGHT;
        let height = TOP + down * (EDGE + GAP) + FOOT;
        let mut canvas = Canvas::new(width as usize, height as usize)?;
        let look = Text { size: 34.0, bold: true, align: Align::Left, ..Text::default() };
        let title = canvas.fitted(self.title, look, width - 80.0);
        canvas.text([40.0, 40.0], &title, look);
        let small = Text { size: 22.0, bold: false, colour: SOFT, ..look };
        canvas.text([40.0, 87.0], self.caption, small);
        let [reach, deepest] = self.extent();
        for (at, name) in self.columns.iter().enumerate() {
            canvas.text([place(at, LEFT) + EDGE / 2.0, TOP - 24.0], name, Text::default());
        }
        for (row, (name, craters)) in self.rows.iter().enumerate() {
            let look = Text { align: Align::Right, ..Text::default() };
            let name = canvas.fitted(name, look, LEFT - 60.0);
            canvas.text([LEFT - 20.0, place(row, TOP) + EDGE / 2.0], &name, look);
            for (column, crater) in craters.iter().enumerate() {
                let (left, top) = (place(column, LEFT), place(row, TOP));
                let rect = Rect { left, right: left + EDGE, top, bottom: top + EDGE };
                crater.paint(&mut canvas, &rect, reach, deepest);
                canvas.frame(&rect, INK)?;
            }
        }
        let end = place(self.columns.len(), LEFT) - GAP;
        let bottom = place(self.rows.len(), TOP) - GAP;
        let all = Rect { left: LEFT, right: end, top: TOP, bottom: bottom.min(TOP + 600.0) };
        colour_bar(&mut canvas, &all, deepest)?;
        scale(&mut canvas, [LEFT, bottom + 34.0], reach)?;
        canvas.to_png()
    }

    /// Writes the picture to `path`.
    ///
    /// # Errors
    /// The drawing library's own, or the file system refuses.
    pub fn write(&self, path: &Path) -> Result<(), ReportError> {
        atomic::write(path, &self.to_png()?)
    }

    /// Half the edge of what is shown, and the largest depth [m].
    fn extent(&self) -> [f64; 2] {
        let nodes = self.rows.iter().flat_map(|(_, craters)| craters).flat_map(|c| &c.nodes);
        let worn = nodes.filter(|[_, _, depth]| *depth > 0.0);
        let [reach, deepest] = worn.fold([0.0_f64; 2], |[reach, deepest], [x, y, depth]| {
            [reach.max(x.abs()).max(y.abs()), deepest.max(*depth)]
        });
        match reach > 0.0 {
            true => [MARGIN * reach, deepest],
            false => [1.0, 1.0],
        }
    }
}

fn place(at: usize, first: f64) -> f64 {
    first + at as f64 * (EDGE + GAP)
}

impl Crater {
    fn paint(&self, canvas: &mut Canvas, rect: &Rect, reach: f64, deepest: f64) {
        let size = rect.sheet_size();
        let step = 2.0 * reach / size[0] as f64;
        let first = reach - step / 2.0;
        let grid = Grid { origin: [-first, first], step: [step, -step], size };
        let near = |node: &&[f64; 3]| node[0].abs().max(node[1].abs()) < reach + 2.0 * self.pitch;
        let seen = |&[x, y, depth]: &[f64; 3]| Seen { at: [x, y], spacing: self.pitch, depth };
        let field = grid.spread(self.nodes.iter().filter(near).map(seen));
        let shades = shades();
        canvas.paint(rect, |column, row| {
            let depth = f64::from(field[row * size[0] + column]);
            depth.is_finite().then(|| shade(&shades, depth / deepest))
        });
    }
}

/// A bar of a round length beside what is shown.
fn scale(canvas: &mut Canvas, [left, y]: [f64; 2], reach: f64) -> Result<(), ReportError> {
    let unit = of_length(reach);
    let raw = reach / unit.size;
    let decade = 10f64.powf(raw.log10().floor());
    let round = [5.0, 2.0, 1.0].map(|f| f * decade).into_iter().find(|length| *length <= raw);
    let length = round.unwrap_or(decade) * unit.size;
    let end = left + length / (2.0 * reach) * EDGE;
    canvas.line(&[[left, y], [end, y]], INK, 3.0)?;
    let look = Text { align: Align::Left, ..Text::default() };
    canvas.text([end + 14.0, y], &with_unit(length, unit), look);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for a gallery that needs craters to be drawn, or that shows them to a scale of their own.
    #[test]
    fn all_craters_are_drawn_to_the_scale_of_the_widest_and_deepest() {
        let crater = |size: f64| Crater {
            nodes: vec![[0.0, 0.0, size], [size, -size, size / 2.0], [3.0 * size, 0.0, 0.0]],
            pitch: size,
        };
        let gallery = Gallery {
            title: "t",
            caption: "c",
            columns: vec!["a".into(), "b".into()],
            rows: vec![("one".into(), vec![crater(1e-6), crater(2e-6)]), ("none".into(), vec![])],
        };
        assert_eq!(gallery.extent(), [MARGIN * 2e-6, 2e-6]);
        assert!(gallery.to_png().unwrap().starts_with(b"\x89PNG"));
        let empty = Gallery { rows: Vec::new(), columns: Vec::new(), ..gallery };
        assert!(empty.to_png().unwrap().starts_with(b"\x89PNG"));
    }
}
