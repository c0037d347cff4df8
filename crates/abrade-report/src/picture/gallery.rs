//! Craters side by side, all to one scale: a picture per case, rows and columns named.

use std::path::Path;

use super::canvas::{self, Align, Canvas, Rect, Text};
use super::colour::{INK, SOFT};
use super::plan::{colour_bar, shade, shades};
use super::raster::Grid;
use super::scale_bar;
use super::view::Seen;
use crate::atomic;
use crate::error::ReportError;

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
/// From the last line of the head to the first row [pixels].
const TOP: f64 = 73.0;
/// Left and right of title and caption [pixels].
const EDGES: f64 = 40.0;
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
        let head = self.head(width - 2.0 * EDGES)?;
        let first = TOP + head.last().map_or(0.0, |(_, down, _)| *down);
        let height = first + down * (EDGE + GAP) + FOOT;
        let mut canvas = Canvas::new(width as usize, height as usize)?;
        for (line, down, look) in &head {
            canvas.text([EDGES, *down], line, *look);
        }
        let [reach, deepest] = self.extent();
        for (at, name) in self.columns.iter().enumerate() {
            canvas.text([place(at, LEFT) + EDGE / 2.0, first - 24.0], name, Text::default());
        }
        for (row, (name, craters)) in self.rows.iter().enumerate() {
            let look = Text { align: Align::Right, ..Text::default() };
            let name = canvas.fitted(name, look, LEFT - 60.0);
            canvas.text([LEFT - 20.0, place(row, first) + EDGE / 2.0], &name, look);
            for (column, crater) in craters.iter().enumerate() {
                let (left, top) = (place(column, LEFT), place(row, first));
                let rect = Rect { left, right: left + EDGE, top, bottom: top + EDGE };
                crater.paint(&mut canvas, &rect, reach, deepest);
                canvas.frame(&rect, INK)?;
            }
        }
        let end = place(self.columns.len(), LEFT) - GAP;
        let bottom = place(self.rows.len(), first) - GAP;
        let all = Rect { left: LEFT, right: end, top: first, bottom: bottom.min(first + 600.0) };
        colour_bar(&mut canvas, &all, deepest)?;
        scale_bar::draw(&mut canvas, [LEFT, bottom + 34.0], EDGE / (2.0 * reach), EDGE / 2.0)?;
        canvas.to_png()
    }

    /// Writes the picture to `path`.
    ///
    /// # Errors
    /// The drawing library's own, or the file system refuses.
    pub fn write(&self, path: &Path) -> Result<(), ReportError> {
        atomic::write(path, &self.to_png()?)
    }

    /// The lines of title and caption, of `width` pixels at most, each with its middle [pixels] and its look.
    fn head(&self, width: f64) -> Result<Vec<(String, f64, Text)>, ReportError> {
        let title = Text { size: 34.0, bold: true, align: Align::Left, ..Text::default() };
        let caption = Text { size: 22.0, bold: false, colour: SOFT, ..title };
        let mut head = Vec::new();
        let mut down = 40.0;
        for line in canvas::lines(self.title, title, width)? {
            head.push((line, down, title));
            down += 47.0;
        }
        for line in canvas::lines(self.caption, caption, width)? {
            head.push((line, down, caption));
            down += 31.0;
        }
        Ok(head)
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for a gallery that needs craters to be drawn, that shows them to a scale of their own, or whose
    /// head is cut where it has few columns.
    #[test]
    fn all_craters_are_drawn_to_one_scale_below_a_whole_head() {
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
        let one =
            Gallery { title: "Craters of each grain", caption: "to one scale", ..gallery.clone() };
        let head: Vec<String> =
            one.head(200.0).unwrap().into_iter().map(|(line, ..)| line).collect();
        assert!(head.len() > 2, "the title is in lines: {head:?}");
        assert_eq!(head.join(" "), "Craters of each grain to one scale");
        assert!(gallery.to_png().unwrap().starts_with(b"\x89PNG"));
        let empty = Gallery { rows: Vec::new(), columns: Vec::new(), ..gallery };
        assert!(empty.to_png().unwrap().starts_with(b"\x89PNG"));
    }
}
