//! Text on a sheet of pixels, in the font that comes with this crate. Own, because plotters drops
//! the room that a glyph keeps at its left, which pulls words apart and together.

use ab_glyph::{Font, FontRef, ScaleFont};

use crate::error::ReportError;

const REGULAR: &[u8] = include_bytes!("../../fonts/OpenSans-Regular.ttf");
const BOLD: &[u8] = include_bytes!("../../fonts/OpenSans-Semibold.ttf");
/// Height of a font's box over the size of its letters: ab_glyph scales by the former.
const BOX: f32 = 1.362;
/// Height of a capital over the size.
const CAPITAL: f32 = 0.714;

/// The two weights.
pub(super) struct Fonts {
    regular: FontRef<'static>,
    bold: FontRef<'static>,
}

impl Fonts {
    pub(super) fn load() -> Result<Self, ReportError> {
        let font =
            |bytes, name| FontRef::try_from_slice(bytes).map_err(|_| ReportError::Font { name });
        let regular = font(REGULAR, "Open Sans Regular")?;
        Ok(Self { regular, bold: font(BOLD, "Open Sans Semibold")? })
    }

    /// Width of `text` [pixels].
    pub(super) fn width(&self, text: &str, size: f64, bold: bool) -> f64 {
        let font = self.font(bold).as_scaled(size as f32 * BOX);
        f64::from(text.chars().map(|c| font.h_advance(font.glyph_id(c))).sum::<f32>())
    }

    /// Hands out how much each pixel is covered; (0, 0) is the left end at half the height of a
    /// capital.
    pub(super) fn draw(
        &self,
        text: &str,
        size: f64,
        bold: bool,
        mut cover: impl FnMut(i32, i32, f32),
    ) {
        let font = self.font(bold).as_scaled(size as f32 * BOX);
        let mut x = 0.0;
        for c in text.chars() {
            let id = font.glyph_id(c);
            let baseline = size as f32 * CAPITAL / 2.0;
            let glyph = id.with_scale_and_position(font.scale(), ab_glyph::point(x, baseline));
            if let Some(outline) = font.outline_glyph(glyph) {
                let corner = outline.px_bounds().min;
                let (left, top) = (corner.x as i32, corner.y as i32);
                outline.draw(|dx, dy, share| cover(left + dx as i32, top + dy as i32, share));
            }
            x += font.h_advance(id);
        }
    }

    fn font(&self, bold: bool) -> &FontRef<'static> {
        if bold { &self.bold } else { &self.regular }
    }
}
