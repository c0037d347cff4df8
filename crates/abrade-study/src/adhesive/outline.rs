//! Outlines from files: lines of places along x and heights, which go over the period once and close.

use std::path::Path;

use abrade_adhesive::Asperities;
use abrade_scene::{NumberPair, number_pairs};

/// The points of the outline `file` in `folder`, for `bodies` whose other values are sound.
///
/// # Errors
/// What is wrong with it, in words, with file and line.
pub(crate) fn read(
    folder: &Path,
    file: &str,
    bodies: &Asperities,
) -> Result<Vec<[f64; 2]>, String> {
    let pairs = number_pairs(folder, "outline", file)
        .map_err(|reason| format!("{reason}; a line is a place along x and a height, in metres"))?;
    check(&pairs, bodies.whole_period(), bodies.diameter)
        .map_err(|reason| format!("{reason}; places and heights are in metres"))?;
    Ok(pairs.into_iter().map(|pair| pair.numbers).collect())
}

/// That the line rises along x, and goes from 0 to the period and closes there to within a diameter: what is
/// smaller than an element changes nothing.
fn check(pairs: &[NumberPair], period: f64, diameter: f64) -> Result<(), String> {
    let [Some(first), Some(last)] = [pairs.first(), pairs.last()] else {
        return Err("the outline has no line with numbers".to_owned());
    };
    for two in pairs.windows(2) {
        let [x1, x2] = [two[0].numbers[0], two[1].numbers[0]];
        if x2 <= x1 {
            return Err(format!("{}: x is {x2:e} after {x1:e}, and must rise", two[1].place));
        }
    }
    let ([from, start], [to, end]) = (first.numbers, last.numbers);
    if !(0.0..=diameter).contains(&from) {
        let place = &first.place;
        return Err(format!("{place}: the outline begins at x = {from:e}, and must at 0"));
    }
    if to > period * (1.0 + 1e-9) || to < period - diameter {
        let place = &last.place;
        return Err(format!(
            "{place}: the outline ends at x = {to:e}, and must at the period, {period:e}"
        ));
    }
    if (end - start).abs() > diameter {
        let place = &last.place;
        return Err(format!(
            "{place}: the outline ends at the height {end:e} and begins at {start:e}: it does not close"
        ));
    }
    Ok(())
}
