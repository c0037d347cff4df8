//! Molecules of LAMMPS: a header of `value keyword` lines, then sections by atom number. Spheres
//! come from `Coords` and `Diameters`; mass, centre and inertia from the header.

use std::path::Path;

use abrade::Ball;
use nalgebra::{Matrix3, Point3};

use super::lines::{Line, lines};
use super::{ClumpError, ClumpFile, Format, Given, LineTrouble};

pub(super) fn parse(path: &Path, text: &str) -> Result<ClumpFile, ClumpError> {
    let missing = |what| ClumpError::Missing { path: path.to_owned(), what };
    // A molecule lists each atom on lines of its own.
    let limit = text.lines().count();
    let mut header = Header { limit, atoms: 0, given: Given::default() };
    let mut centres: Vec<Option<Point3<f64>>> = Vec::new();
    let mut radii: Vec<Option<f64>> = Vec::new();
    let mut section = "";
    let mut last = None;
    for line in lines(path, text, "#") {
        last = Some(line);
        if line.text.starts_with(|c: char| c.is_alphabetic()) {
            section = line.text;
        } else if section.is_empty() {
            header.read(&line)?;
            centres.resize(header.atoms, None);
            radii.resize(header.atoms, None);
        } else if section == "Coords" {
            let [atom, x, y, z] = line.first("4 (atom, x, y, z)")?;
            *entry(&mut centres, &line, atom)? = Some(Point3::new(x, y, z));
        } else if section == "Diameters" {
            let [atom, diameter] = line.first("2 (atom, diameter)")?;
            *entry(&mut radii, &line, atom)? = Some(diameter / 2.0);
        }
    }
    let last = last.ok_or_else(|| missing("atoms"))?;
    if header.atoms == 0 {
        return Err(missing("atoms"));
    }
    let mut spheres: Vec<Ball> = Vec::new();
    for (i, (centre, radius)) in centres.iter().zip(&radii).enumerate() {
        let lacks = |section| last.error(LineTrouble::Incomplete { atom: i + 1, section });
        let centre = centre.ok_or_else(|| lacks("Coords"))?;
        let radius = radius.ok_or_else(|| lacks("Diameters"))?;
        spheres.push(last.sphere([centre.x, centre.y, centre.z, radius])?);
    }
    let given = header.given;
    Ok(ClumpFile { path: path.to_owned(), format: Format::Lammps, spheres, given })
}

fn entry<'a, T>(table: &'a mut [T], line: &Line, atom: f64) -> Result<&'a mut T, ClumpError> {
    let count = table.len();
    let index = if atom >= 1.0 && atom.fract() == 0.0 { atom as usize - 1 } else { count };
    table.get_mut(index).ok_or_else(|| line.error(LineTrouble::Atom { atom, count }))
}

struct Header {
    limit: usize,
    atoms: usize,
    given: Given,
}

impl Header {
    /// A line of numbers with the keyword behind them.
    fn read(&mut self, line: &Line) -> Result<(), ClumpError> {
        let words: Vec<&str> = line.words().collect();
        let Some((keyword, values)) = words.split_last() else { return Ok(()) };
        if !matches!(*keyword, "atoms" | "mass" | "com" | "inertia") {
            return Ok(());
        }
        let values: Vec<f64> =
            values.iter().map(|word| line.number(word)).collect::<Result<_, _>>()?;
        let found = values.len();
        match (*keyword, &values[..]) {
            ("atoms", &[count]) if (1.0..=self.limit as f64).contains(&count) => {
                self.atoms = count as usize;
            }
            ("mass", &[mass]) => self.given.mass = Some(mass),
            ("com", &[x, y, z]) => self.given.centre = Some(Point3::new(x, y, z)),
            ("inertia", &[xx, yy, zz, xy, xz, yz]) => {
                let tensor = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
                self.given.tensor_per_mass = self.given.mass.map(|mass| tensor / mass);
            }
            ("atoms", &[atom]) => {
                return Err(line.error(LineTrouble::Atom { atom, count: self.limit }));
            }
            _ => {
                let expected = "1 for atoms and mass, 3 for com, 6 for inertia";
                return Err(line.error(LineTrouble::Columns { found, expected }));
            }
        }
        Ok(())
    }
}
