//! Lines of x, y, z, radius: what CLUMP, MClump, LIGGGHTS and DEM-Engine read and write.

use std::path::Path;

use super::lines::{Line, lines};
use super::{ClumpError, ClumpFile, Format, Given, LineTrouble};

const COLUMNS: &str = "4 (x, y, z, radius)";

/// Reads the lines. A first line of words is a header; it may name the columns in another order.
/// Without one, a fifth column (a sphere's type) is let pass.
pub(super) fn parse(path: &Path, text: &str) -> Result<ClumpFile, ClumpError> {
    let mut spheres = Vec::new();
    let mut order = None;
    let mut header = false;
    for line in lines(path, text, "#") {
        if spheres.is_empty() && !header && is_header(&line) {
            order = columns(&line)?;
            header = true;
            continue;
        }
        let numbers = line.numbers()?;
        let picked = match order {
            Some(columns) => columns.map(|column| numbers.get(column).copied()),
            None if numbers.len() > 5 => [None; 4],
            None => [0, 1, 2, 3].map(|column| numbers.get(column).copied()),
        };
        let [Some(x), Some(y), Some(z), Some(r)] = picked else {
            let trouble = LineTrouble::Columns { found: numbers.len(), expected: COLUMNS };
            return Err(line.error(trouble));
        };
        spheres.push(line.sphere([x, y, z, r])?);
    }
    let format = if header && text.contains(',') { Format::Csv } else { Format::Xyzr };
    Ok(ClumpFile { path: path.to_owned(), format, spheres, given: Given::default() })
}

/// True when no word is a number.
fn is_header(line: &Line) -> bool {
    line.words().all(|word| word.parse::<f64>().is_err())
}

/// Where a header puts x, y, z and the radius; none if it names them otherwise.
fn columns(line: &Line) -> Result<Option<[usize; 4]>, ClumpError> {
    let words: Vec<String> =
        line.words().map(|word| word.trim_matches('"').to_lowercase()).collect();
    let place = |names: &[&str]| words.iter().position(|word| names.contains(&word.as_str()));
    let named =
        [place(&["x"]), place(&["y"]), place(&["z"]), place(&["r", "radius", "radii", "rad"])];
    match named {
        [Some(x), Some(y), Some(z), Some(r)] => Ok(Some([x, y, z, r])),
        _ if words.len() >= 4 => Ok(None),
        _ => {
            let trouble = LineTrouble::Columns { found: words.len(), expected: COLUMNS };
            Err(line.error(trouble))
        }
    }
}
