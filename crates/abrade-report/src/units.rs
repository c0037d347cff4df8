//! Numbers as people read them: a unit that fits the size, ticks at round values.

/// A unit and its size in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Unit {
    pub(crate) name: &'static str,
    pub(crate) size: f64,
}

const LENGTHS: [Unit; 4] = [
    Unit { name: "m", size: 1.0 },
    Unit { name: "mm", size: 1e-3 },
    Unit { name: "µm", size: 1e-6 },
    Unit { name: "nm", size: 1e-9 },
];

const VOLUMES: [Unit; 5] = [
    Unit { name: "m³", size: 1.0 },
    Unit { name: "cm³", size: 1e-6 },
    Unit { name: "mm³", size: 1e-9 },
    Unit { name: "µm³", size: 1e-18 },
    Unit { name: "nm³", size: 1e-27 },
];

/// The largest unit of length in which `length` [m] is at least one.
pub(crate) fn of_length(length: f64) -> Unit {
    fitting(&LENGTHS, length)
}

/// Millimetres for the extent of a view [m], unless it is too small for them.
pub(crate) fn of_extent(extent: f64) -> Unit {
    match extent < 1e-4 {
        true => of_length(extent),
        false => LENGTHS[1],
    }
}

/// Cubic millimetres for anything from a thousandth of one to a cubic centimetre; beyond, the largest unit
/// of volume in which `volume` [m3] is at least one.
pub(crate) fn of_volume(volume: f64) -> Unit {
    match (1e-12..1e-6).contains(&volume.abs()) {
        true => VOLUMES[2],
        false => fitting(&VOLUMES, volume),
    }
}

fn fitting(units: &[Unit], value: f64) -> Unit {
    // A value that is one unit but for rounding belongs to that unit.
    let fits = |unit: &&Unit| value.abs() >= unit.size * (1.0 - 1e-9);
    *units.iter().find(fits).unwrap_or(&units[units.len() - 1])
}

/// `value` [SI] in `unit` with four significant digits, the unit behind it.
pub(crate) fn with_unit(value: f64, unit: Unit) -> String {
    let value = value / unit.size;
    let text = match value.abs() {
        0.0 => "0".to_owned(),
        tiny if tiny < 1e-3 => format!("{value:.3e}"),
        size if size >= 1e6 => format!("{value:.3e}"),
        size => grouped(&format!("{value:.*}", (3 - size.log10().floor() as i32).max(0) as usize)),
    };
    format!("{text}\u{a0}{}", unit.name)
}

/// `count` with a gap between thousands.
pub(crate) fn counted(count: usize) -> String {
    grouped(&count.to_string())
}

/// Puts a gap between the thousands of a plain number of five or more digits before the point.
fn grouped(number: &str) -> String {
    let (whole, rest) = number.split_at(number.find('.').unwrap_or(number.len()));
    let digits = whole.trim_start_matches('-').len();
    if digits < 5 {
        return number.to_owned();
    }
    let mut out = String::new();
    for (i, c) in whole.chars().enumerate() {
        let left = whole.len() - i;
        if left.is_multiple_of(3) && i > 0 && left < digits {
            out.push('\u{a0}');
        }
        out.push(c);
    }
    out + rest
}

/// Round values between `low` and `high`, about `wanted` of them, and the decimals they need.
pub(crate) fn ticks(low: f64, high: f64, wanted: f64) -> (Vec<f64>, usize) {
    let raw = (high - low) / wanted;
    if !(raw.is_finite() && raw > 0.0) {
        return (Vec::new(), 0);
    }
    let decade = 10.0_f64.powi(raw.log10().floor() as i32);
    let factor = [1.0, 2.0, 5.0, 10.0].into_iter().find(|f| f * decade >= raw * 0.999);
    let step = factor.unwrap_or(10.0) * decade;
    // Ends that miss a round value by rounding alone still carry their tick.
    let slack = 1e-9;
    let first = (low / step - slack).ceil() as i64;
    let last = (high / step + slack).floor() as i64;
    let decimals = (-step.log10() - slack).ceil().max(0.0) as usize;
    ((first..=last).map(|i| i as f64 * step).collect(), decimals)
}

/// The text of a tick, with a true minus sign.
pub(crate) fn tick_text(value: f64, decimals: usize) -> String {
    let zero = value.abs() < 0.5 * 10.0_f64.powi(-(decimals as i32));
    format!("{:.decimals$}", if zero { 0.0 } else { value }).replace('-', "\u{2212}")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A program off by a power of ten, or that took micrometres where a millimetre is reached,
    /// would mislabel a colour bar.
    #[test]
    fn lengths_and_volumes_take_the_unit_that_fits() {
        assert_eq!(of_length(1.2e-5).name, "µm");
        assert_eq!(of_length(1e-3).name, "mm");
        assert_eq!(of_length(0.0).name, "nm");
        assert_eq!(with_unit(1.23456e-5, of_length(1.23456e-5)), "12.35\u{a0}µm");
        assert_eq!(with_unit(5e-11, of_volume(5e-11)), "0.05000\u{a0}mm³");
        assert_eq!(with_unit(1.2346e-13, of_volume(1.2346e-13)), "123\u{a0}460\u{a0}µm³");
    }

    /// A program that put gaps at the wrong end would print 12 34 5.
    #[test]
    fn thousands_are_counted_from_the_point() {
        assert_eq!(counted(5012), "5012");
        assert_eq!(counted(1_234_567), "1\u{a0}234\u{a0}567");
    }

    /// A program that stepped from `low` itself would tick at 0.03, 0.23..; one with a drifting
    /// sum would miss the end.
    #[test]
    fn ticks_are_round_and_reach_both_ends() {
        let (values, decimals) = ticks(-0.4, 0.6, 5.0);
        let texts: Vec<_> = values.iter().map(|v| tick_text(*v, decimals)).collect();
        assert_eq!(texts, ["\u{2212}0.4", "\u{2212}0.2", "0.0", "0.2", "0.4", "0.6"]);
        assert_eq!(ticks(0.03, 0.97, 5.0).0.first(), Some(&0.2));
        assert!(ticks(1.0, 1.0, 5.0).0.is_empty());
    }
}
