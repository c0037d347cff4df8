//! Reads back what this module writes: the layout of `poly` and `block`, and no other of the many
//! that VTK's XML allows. An array is decompressed when it is asked for.

use std::fs;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use flate2::read::ZlibDecoder;
use nalgebra::{Point3, Vector3};

use super::block::BLOCK;
use super::poly::{DATA, check_triangles};
use crate::error::{FileAction, ReportError};

/// A file of [`super::write_surface`] or [`super::write_bodies`].
#[derive(Debug)]
pub struct VtpFile {
    path: PathBuf,
    bytes: Vec<u8>,
    /// Where the arrays begin [bytes].
    data: usize,
    points: usize,
}

impl VtpFile {
    /// Reads a file.
    ///
    /// # Errors
    /// The file system refuses, or the file is not as this crate writes it.
    pub fn open(path: &Path) -> Result<Self, ReportError> {
        let bytes = fs::read(path).map_err(ReportError::file(FileAction::Read, path))?;
        let mark = DATA.as_bytes();
        let data = bytes.windows(mark.len()).position(|window| window == mark);
        let mut file = Self { path: path.to_owned(), bytes, data: 0, points: 0 };
        file.data = data.ok_or_else(|| file.damaged(DATA.trim_end()))? + mark.len();
        let points = attribute(file.element("Piece")?, "NumberOfPoints");
        file.points = points.ok_or_else(|| file.damaged("NumberOfPoints"))?;
        Ok(file)
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.points
    }

    /// True for a file without points.
    pub fn is_empty(&self) -> bool {
        self.points == 0
    }

    /// The points [m], in the world.
    ///
    /// # Errors
    /// The array is missing or damaged.
    pub fn points(&self) -> Result<Vec<Point3<f64>>, ReportError> {
        Ok(self.triples("Points", "Points")?.into_iter().map(Point3::from).collect())
    }

    /// A number per point, such as `depth_m` [m].
    ///
    /// # Errors
    /// The array is missing or damaged.
    pub fn scalars(&self, name: &str) -> Result<Vec<f64>, ReportError> {
        let words = self.words("PointData", name, Some(self.points))?;
        Ok(words.into_iter().map(f64::from_le_bytes).collect())
    }

    /// A vector per point, such as `normal`.
    ///
    /// # Errors
    /// The array is missing or damaged.
    pub fn vectors(&self, name: &str) -> Result<Vec<Vector3<f64>>, ReportError> {
        Ok(self.triples("PointData", name)?.into_iter().map(Vector3::from).collect())
    }

    /// Three points per triangle; every one of them is there.
    ///
    /// # Errors
    /// The array is missing or damaged, or a triangle names no point.
    pub fn triangles(&self) -> Result<Vec<[u32; 3]>, ReportError> {
        let words = self.words("Polys", "connectivity", None)?;
        let corner = |word: &[u8; 8]| u32::try_from(i64::from_le_bytes(*word)).ok();
        let corners: Option<Vec<u32>> = words.iter().map(corner).collect();
        let corners = corners.ok_or_else(|| self.damaged("a corner"))?;
        let (triangles, rest) = corners.as_chunks::<3>();
        if !rest.is_empty() {
            return Err(self.damaged("three corners per triangle"));
        }
        check_triangles(triangles, self.points)?;
        Ok(triangles.to_vec())
    }

    /// True when both files hold the same triangles; nothing is decompressed for it.
    pub fn has_triangles_of(&self, other: &Self) -> bool {
        let mine = self.packed("Polys", "connectivity");
        mine.is_some() && mine == other.packed("Polys", "connectivity")
    }

    /// An array as it lies in the file.
    fn packed(&self, element: &str, name: &str) -> Option<&[u8]> {
        let data = self.data(element, name)?;
        data.get(..Header::of(data)?.end)
    }

    fn triples(&self, element: &str, name: &str) -> Result<Vec<[f64; 3]>, ReportError> {
        let words = self.words(element, name, self.points.checked_mul(3))?;
        let (triples, _) = words.as_chunks::<3>();
        Ok(triples.iter().map(|triple| triple.map(f64::from_le_bytes)).collect())
    }

    /// The words of an array, `expected` of them where that is known.
    fn words(
        &self,
        element: &str,
        name: &str,
        expected: Option<usize>,
    ) -> Result<Vec<[u8; 8]>, ReportError> {
        let damaged = || self.damaged(name);
        let bytes = self.data(element, name).and_then(inflated).ok_or_else(damaged)?;
        let (words, rest) = bytes.as_chunks::<8>();
        match rest.is_empty() && expected.is_none_or(|expected| expected == words.len()) {
            true => Ok(words.to_vec()),
            false => Err(damaged()),
        }
    }

    /// The bytes from where an array begins.
    fn data(&self, element: &str, name: &str) -> Option<&[u8]> {
        let named = format!("Name=\"{name}\"");
        let arrays = self.element(element).ok()?.split("<DataArray ").skip(1);
        let offset = attribute(arrays.into_iter().find(|array| array.contains(&named))?, "offset")?;
        self.bytes.get(self.data..)?.get(offset..)
    }

    /// The head from where an element opens to where it closes.
    fn element(&self, name: &str) -> Result<&str, ReportError> {
        let head = std::str::from_utf8(&self.bytes[..self.data]);
        let (open, close) = (format!("<{name}"), format!("</{name}>"));
        let element = head.ok().and_then(|head| Some(&head[head.find(&open)?..]));
        let element = element.and_then(|text| Some(&text[..text.find(&close)?]));
        element.ok_or_else(|| self.damaged(&open))
    }

    fn damaged(&self, missing: &str) -> ReportError {
        ReportError::Damaged { path: self.path.clone(), missing: missing.to_owned() }
    }
}

/// The whole number that an element's attribute holds.
fn attribute(element: &str, name: &str) -> Option<usize> {
    let (_, value) = element.split_once(&format!("{name}=\""))?;
    value.split('"').next()?.parse().ok()
}

/// What stands before the blocks of an array.
struct Header {
    blocks: usize,
    /// Bytes of the last block when it is decompressed, 0 for a whole one.
    last: usize,
    /// Where the blocks end [bytes].
    end: usize,
}

impl Header {
    /// The header at the start of `data`; `None` when the blocks would not be in it.
    fn of(data: &[u8]) -> Option<Self> {
        let [blocks, block, last] = [word(data, 0)?, word(data, 1)?, word(data, 2)?];
        if block != BLOCK || last >= block || blocks > data.len() / 8 {
            return None;
        }
        let first = 8 * (3 + blocks);
        let end =
            (0..blocks).try_fold(first, |end, number| end.checked_add(word(data, 3 + number)?));
        end.filter(|end| *end <= data.len()).map(|end| Self { blocks, last, end })
    }
}

/// The bytes of an array at the start of `data`; `None` when header and blocks do not agree.
fn inflated(data: &[u8]) -> Option<Vec<u8>> {
    let Header { blocks, last, .. } = Header::of(data)?;
    let mut payload = data.get(8 * (3 + blocks)..)?;
    let mut bytes = Vec::new();
    for number in 0..blocks {
        let (packed, rest) = payload.split_at_checked(word(data, 3 + number)?)?;
        payload = rest;
        let is_short = number + 1 == blocks && last > 0;
        let (before, size) = (bytes.len(), if is_short { last } else { BLOCK });
        // One byte more than there may be, so that a longer block is noticed and ends early.
        ZlibDecoder::new(packed).take(size as u64 + 1).read_to_end(&mut bytes).ok()?;
        if bytes.len() - before != size {
            return None;
        }
    }
    Some(bytes)
}

/// The whole number at place `at` of an array's header.
fn word(data: &[u8], at: usize) -> Option<usize> {
    let bytes = data.get(8 * at..)?.first_chunk::<8>()?;
    usize::try_from(u64::from_le_bytes(*bytes)).ok()
}

#[cfg(test)]
mod tests;
