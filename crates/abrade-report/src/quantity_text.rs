//! Numbers with units, for the lines of a terminal.

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
    scaled(value, &[(1.0, "m"), (1e-3, "mm"), (1e-6, "um"), (1e-9, "nm")])
}

/// `value` [bytes].
pub fn memory(value: f64) -> String {
    scaled(value, &[(1e9, "GB"), (1e6, "MB"), (1e3, "kB"), (1.0, "B")])
}

/// `value` [s].
pub fn time(value: f64) -> String {
    scaled(value, &[(3600.0, "h"), (60.0, "min"), (1.0, "s"), (1e-3, "ms"), (1e-6, "us")])
}

fn scaled(value: f64, units: &[(f64, &str)]) -> String {
    let fits = units.iter().find(|(factor, _)| value.abs() >= 0.9995 * factor);
    match fits.or(units.last()) {
        Some((factor, unit)) => format!("{} {unit}", digits(value / factor)),
        None => digits(value),
    }
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
    }
}
