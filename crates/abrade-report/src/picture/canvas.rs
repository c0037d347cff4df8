//! A sheet to draw on, in pixels of the finished picture. It is kept larger than the picture and
//! averaged down at the end, which smooths every edge.

use plotters::coord::Shift;
use plotters::prelude::*;

use super::colour::{INK, Rgb, blend};
use super::letters::Fonts;
use crate::error::ReportError;

/// Sheet pixels per picture pixel.
pub(crate) const SCALE: usize = 2;

/// The sheet.
pub(crate) struct Canvas {
    size: [usize; 2],
    pixels: Vec<u8>,
    fonts: Fonts,
}

/// A part of the picture [pixels].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rect {
    pub(crate) left: f64,
    pub(crate) right: f64,
    pub(crate) top: f64,
    pub(crate) bottom: f64,
}

/// How a text looks.
#[derive(Clone, Copy)]
pub(crate) struct Text {
    pub(crate) size: f64,
    pub(crate) bold: bool,
    pub(crate) colour: Rgb,
    pub(crate) align: Align,
    /// Read from below.
    pub(crate) upright: bool,
}

/// Which end of a text is placed; up and down it is the middle of a capital.
#[derive(Clone, Copy)]
pub(crate) enum Align {
    Left,
    Centre,
    Right,
}

impl Default for Text {
    fn default() -> Self {
        Self { size: 20.0, bold: false, colour: INK, align: Align::Centre, upright: false }
    }
}

/// `text` in lines of at most `width` pixels, broken between words; a word that is longer has a line of its own.
pub(crate) fn lines(text: &str, look: Text, width: f64) -> Result<Vec<String>, ReportError> {
    let fonts = Fonts::load()?;
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        let longer = lines.last().map(|line| format!("{line} {word}"));
        match (longer, lines.last_mut()) {
            (Some(longer), Some(line)) if fonts.width(&longer, look.size, look.bold) <= width => {
                *line = longer;
            }
            _ => lines.push(word.to_owned()),
        }
    }
    Ok(lines)
}

impl Canvas {
    /// A white sheet for a picture of this size.
    pub(crate) fn new(width: usize, height: usize) -> Result<Self, ReportError> {
        let size = [width * SCALE, height * SCALE];
        let pixels = vec![255; size[0] * size[1] * 3];
        Ok(Self { size, pixels, fonts: Fonts::load()? })
    }

    /// Sets the sheet's own pixels inside `rect`, row by row; `None` leaves one as it is.
    pub(crate) fn paint(&mut self, rect: &Rect, pixel: impl Fn(usize, usize) -> Option<Rgb>) {
        let [left, top] = [sheet(rect.left) as usize, sheet(rect.top) as usize];
        let [width, height] = rect.sheet_size();
        for row in 0..height {
            for column in 0..width {
                if let Some(colour) = pixel(column, row) {
                    let i = 3 * ((top + row) * self.size[0] + left + column);
                    self.pixels[i..i + 3].copy_from_slice(&colour);
                }
            }
        }
    }

    pub(crate) fn line(
        &mut self,
        points: &[[f64; 2]],
        colour: Rgb,
        width: f64,
    ) -> Result<(), ReportError> {
        let points: Vec<_> = points.iter().map(|p| (sheet(p[0]), sheet(p[1]))).collect();
        let style = rgb(colour).stroke_width(sheet(width).max(1) as u32);
        self.draw(|area| area.draw(&PathElement::new(points, style)))
    }

    pub(crate) fn fill(&mut self, corners: &[[f64; 2]], colour: Rgb) -> Result<(), ReportError> {
        let corners: Vec<_> = corners.iter().map(|p| (sheet(p[0]), sheet(p[1]))).collect();
        self.draw(|area| area.draw(&Polygon::new(corners, rgb(colour).filled())))
    }

    pub(crate) fn dot(
        &mut self,
        at: [f64; 2],
        radius: f64,
        colour: Rgb,
    ) -> Result<(), ReportError> {
        let at = (sheet(at[0]), sheet(at[1]));
        self.draw(|area| area.draw(&Circle::new(at, sheet(radius), rgb(colour).filled())))
    }

    pub(crate) fn frame(&mut self, rect: &Rect, colour: Rgb) -> Result<(), ReportError> {
        let Rect { left, right, top, bottom } = *rect;
        let corners = [[left, top], [right, top], [right, bottom], [left, bottom], [left, top]];
        self.line(&corners, colour, 1.0)
    }

    pub(crate) fn text(&mut self, at: [f64; 2], text: &str, look: Text) {
        let size = look.size * SCALE as f64;
        let width = self.fonts.width(text, size, look.bold);
        let back = match look.align {
            Align::Left => 0.0,
            Align::Centre => width / 2.0,
            Align::Right => width,
        };
        let (x, y, back) = (sheet(at[0]), sheet(at[1]), back.round() as i32);
        let [columns, rows] = self.size.map(|side| side as i32);
        let pixels = &mut self.pixels;
        self.fonts.draw(text, size, look.bold, |along, down, share| {
            let along = along - back;
            let (x, y) = if look.upright { (x + down, y - along) } else { (x + along, y + down) };
            if (0..columns).contains(&x) && (0..rows).contains(&y) {
                let i = 3 * (y * columns + x) as usize;
                let under = [pixels[i], pixels[i + 1], pixels[i + 2]];
                pixels[i..i + 3].copy_from_slice(&blend(under, look.colour, f64::from(share)));
            }
        });
    }

    /// `text`, cut to `width` pixels.
    pub(crate) fn fitted(&self, text: &str, look: Text, width: f64) -> String {
        let fits = |text: &str| self.fonts.width(text, look.size, look.bold) <= width;
        let mut kept = text.to_owned();
        let mut line = kept.clone();
        while !fits(&line) && kept.pop().is_some() {
            line = format!("{}…", kept.trim_end());
        }
        line
    }

    /// The finished picture as PNG.
    pub(crate) fn to_png(&self) -> Result<Vec<u8>, ReportError> {
        let [width, height] = self.size.map(|side| side / SCALE);
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, width as u32, height as u32);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&self.averaged(width, height))?;
        writer.finish()?;
        Ok(bytes)
    }

    /// Every picture pixel as the mean of its sheet pixels.
    fn averaged(&self, width: usize, height: usize) -> Vec<u8> {
        let area = (SCALE * SCALE) as u16;
        let mut sums = vec![0_u16; width * height * 3];
        for (y, row) in self.pixels.chunks_exact(3 * self.size[0]).enumerate() {
            let first = 3 * width * (y / SCALE);
            for (x, pixel) in row.chunks_exact(3).enumerate() {
                let at = first + 3 * (x / SCALE);
                sums[at] += u16::from(pixel[0]);
                sums[at + 1] += u16::from(pixel[1]);
                sums[at + 2] += u16::from(pixel[2]);
            }
        }
        sums.iter().map(|sum| ((sum + area / 2) / area) as u8).collect()
    }

    fn draw<E: std::error::Error + Send + Sync + 'static>(
        &mut self,
        act: impl FnOnce(&DrawingArea<BitMapBackend<'_>, Shift>) -> Result<(), E>,
    ) -> Result<(), ReportError> {
        let size = (self.size[0] as u32, self.size[1] as u32);
        let area = BitMapBackend::with_buffer(&mut self.pixels, size).into_drawing_area();
        act(&area).map_err(ReportError::draw)
    }
}

impl Rect {
    pub(crate) fn width(&self) -> f64 {
        self.right - self.left
    }

    pub(crate) fn height(&self) -> f64 {
        self.bottom - self.top
    }

    /// Columns and rows of the sheet inside.
    pub(crate) fn sheet_size(&self) -> [usize; 2] {
        [self.width(), self.height()].map(|side| (side * SCALE as f64).round() as usize)
    }
}

fn sheet(pixels: f64) -> i32 {
    (pixels * SCALE as f64).round() as i32
}

fn rgb([red, green, blue]: Rgb) -> RGBColor {
    RGBColor(red, green, blue)
}
