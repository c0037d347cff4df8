//! Colours. Depth runs from a light yellow to a dark violet at a steady pace of lightness and hue
//! in the Oklab space (B. Ottosson, "A perceptual color space for image processing", 2020), so
//! equal differences of depth look equally different, also in print and to the colour-blind.

/// Red, green, blue, 0 to 255.
pub(crate) type Rgb = [u8; 3];

pub(crate) const WHITE: Rgb = [255, 255, 255];
/// Text and axes.
pub(crate) const INK: Rgb = [34, 38, 45];
/// Text of less weight.
pub(crate) const SOFT: Rgb = [92, 98, 108];
/// A surface that nothing touched.
pub(crate) const UNTOUCHED: Rgb = [233, 234, 237];
/// The material below a cross-section.
pub(crate) const BODY: Rgb = [214, 217, 222];

/// `over` laid on `under` with the opacity `share`.
pub(super) fn blend(under: Rgb, over: Rgb, share: f64) -> Rgb {
    let share = share.clamp(0.0, 1.0);
    let mix = |a: u8, b: u8| (f64::from(a) + (f64::from(b) - f64::from(a)) * share).round() as u8;
    std::array::from_fn(|i| mix(under[i], over[i]))
}

/// The colours from no depth to the largest, in equal steps of depth.
pub fn depth_colours() -> [[u8; 3]; 256] {
    std::array::from_fn(|i| of_share(i as f64 / 255.0))
}

/// Lightness, chroma and hue [rad] at no depth and at the largest.
const SHALLOW: [f64; 3] = [0.93, 0.150, 1.83];
const DEEP: [f64; 3] = [0.22, 0.120, 5.15];
/// The screen shows less chroma between the ends, in green and blue, than a straight path asks for.
const DIP: f64 = 0.045;

/// Colour of a depth, as a share of the largest.
pub(super) fn of_share(share: f64) -> Rgb {
    let t = share.clamp(0.0, 1.0);
    let [l, c, h] = std::array::from_fn(|i| SHALLOW[i] + (DEEP[i] - SHALLOW[i]) * t);
    let mut chroma = c - DIP * (std::f64::consts::PI * t).sin();
    loop {
        let rgb = linear_rgb(l, chroma * h.cos(), chroma * h.sin());
        if rgb.iter().all(|v| (-1e-4..=1.0001).contains(v)) || chroma < 1e-3 {
            return rgb.map(|v| (encode(v.clamp(0.0, 1.0)) * 255.0).round() as u8);
        }
        chroma *= 0.98;
    }
}

/// Oklab to linear sRGB, by the matrices of its author.
fn linear_rgb(l: f64, a: f64, b: f64) -> [f64; 3] {
    let long = (l + 0.396_337_777_4 * a + 0.215_803_757_3 * b).powi(3);
    let medium = (l - 0.105_561_345_8 * a - 0.063_854_172_8 * b).powi(3);
    let short = (l - 0.089_484_177_5 * a - 1.291_485_548_0 * b).powi(3);
    [
        4.076_741_662_1 * long - 3.307_711_591_3 * medium + 0.230_969_929_2 * short,
        -1.268_438_004_6 * long + 2.609_757_401_1 * medium - 0.341_319_396_5 * short,
        -0.004_196_086_3 * long - 0.703_418_614_7 * medium + 1.707_614_701_0 * short,
    ]
}

/// The sRGB transfer curve.
fn encode(linear: f64) -> f64 {
    match linear <= 0.003_130_8 {
        true => 12.92 * linear,
        false => 1.055 * linear.powf(1.0 / 2.4) - 0.055,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance, as screens make it.
    fn luminance(rgb: Rgb) -> f64 {
        let linear = rgb.map(|v| {
            let v = f64::from(v) / 255.0;
            if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
        });
        0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
    }

    /// A rainbow, or a conversion with a wrong matrix, would go dark and light again.
    #[test]
    fn deeper_is_always_darker() {
        let steps: Vec<f64> = (0..=50).map(|i| luminance(of_share(f64::from(i) / 50.0))).collect();
        assert!(steps.windows(2).all(|pair| pair[1] < pair[0]), "{steps:?}");
        assert!(steps[0] > 0.7 && steps[50] < 0.03, "{steps:?}");
    }
}
