//! Numbers with units, for the lines of a terminal.

use std::fmt::Display;

/// A volume [m3] in the unit that suits it.
pub fn volume(value: f64) -> String {
    let (factor, unit) = match value.abs() {
        size if size >= 1e-6 => (1e-6, "cm3"),
        size if size >= 1e-14 || size == 0.0 => (1e-9, "mm3"),
        _ => (1e-18, "um3"),
    };
    format!("{} {unit}", digits(value / factor))
}

/// `value` [m] with three digits, in the unit that suits it.
pub fn length(value: f64) -> String {
    scaled(value, &LENGTHS)
}

/// `value` [N].
pub fn force(value: f64) -> String {
    scaled(value, &FORCES)
}

/// `value` [J].
pub fn energy(value: f64) -> String {
    const STEPS: [(f64, &str); 6] =
        [(1.0, "J"), (1e-3, "mJ"), (1e-6, "uJ"), (1e-9, "nJ"), (1e-12, "pJ"), (1e-15, "fJ")];
    scaled(value, &STEPS)
}

/// `value` [Pa].
pub fn pressure(value: f64) -> String {
    scaled(value, &[(1e9, "GPa"), (1e6, "MPa"), (1e3, "kPa"), (1.0, "Pa")])
}

/// Size [m] and name of the unit of length that suits `value` [m].
pub fn length_unit(value: f64) -> (f64, &'static str) {
    fitting(value, &LENGTHS)
}

/// Size [N] and name of the unit of force that suits `value` [N].
pub fn force_unit(value: f64) -> (f64, &'static str) {
    fitting(value, &FORCES)
}

const LENGTHS: [(f64, &str); 4] = [(1.0, "m"), (1e-3, "mm"), (1e-6, "um"), (1e-9, "nm")];
const FORCES: [(f64, &str); 6] =
    [(1e3, "kN"), (1.0, "N"), (1e-3, "mN"), (1e-6, "uN"), (1e-9, "nN"), (1e-12, "pN")];

/// `value` [bytes].
pub fn memory(value: f64) -> String {
    scaled(value, &[(1e9, "GB"), (1e6, "MB"), (1e3, "kB"), (1.0, "B")])
}

/// `value` [s].
pub fn time(value: f64) -> String {
    scaled(value, &[(3600.0, "h"), (60.0, "min"), (1.0, "s"), (1e-3, "ms"), (1e-6, "us")])
}

fn scaled<const N: usize>(value: f64, units: &[(f64, &'static str); N]) -> String {
    let (factor, unit) = fitting(value, units);
    format!("{} {unit}", digits(value / factor))
}

/// The largest unit of which `value` is one at least, but for rounding; else the smallest.
fn fitting<const N: usize>(value: f64, units: &[(f64, &'static str); N]) -> (f64, &'static str) {
    let fits = units.iter().find(|(factor, _)| value.abs() >= 0.9995 * factor);
    *fits.unwrap_or(&units[N - 1])
}

/// How many there are, with the word for `one` of them or for `more`.
pub fn count<N: Display + PartialEq + From<u8>>(number: N, one: &str, more: &str) -> String {
    let word = if number == N::from(1) { one } else { more };
    format!("{number} {word}")
}

/// Three significant digits, without trailing zeros.
pub fn digits(value: f64) -> String {
    let rounded: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    match rounded.abs() {
        size if size != 0.0 && !(1e-3..1e5).contains(&size) => format!("{rounded:e}"),
        _ => format!("{rounded}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_is_shown_in_the_unit_that_suits_it() {
        assert_eq!(length(6.0158e-4), "602 um");
        assert_eq!(length(9.9996e-4), "1 mm");
        assert_eq!(length(0.0), "0 nm");
        assert_eq!(time(7200.0), "2 h");
        assert_eq!(memory(123_456.0), "123 kB");
        assert_eq!(digits(2.8274e-7), "2.83e-7");
        assert_eq!(force(-4.71239e-4), "-471 uN");
        assert_eq!(energy(2.5195e-11), "25.2 pJ");
        assert_eq!(pressure(1e9), "1 GPa");
        assert_eq!(length_unit(4.2e-8), (1e-9, "nm"));
        assert_eq!(count(1_u64, "node", "nodes"), "1 node");
        assert_eq!(count(0.0, "node", "nodes"), "0 nodes");
    }
}
