//! Round solids about z as meshes with evenly spread vertices on their true surface.

use std::f64::consts::TAU;

use super::TriangleMesh;
use super::error::MeshError;
use super::lathe::{Piece, turn};
use crate::error::ParameterError;

/// Fewest nodes around a round part.
const LEAST_AROUND: f64 = 8.0;

impl TriangleMesh {
    /// A sphere of this `radius` [m] about the origin, vertices `pitch` [m] apart.
    ///
    /// # Errors
    /// Sizes out of range, too coarse, too many vertices.
    pub fn sphere(radius: f64, pitch: f64) -> Result<Self, MeshError> {
        check_sizes([("radius", radius), ("pitch", pitch)])?;
        check_round("radius", radius, pitch)?;
        turn(&[Piece::Quarter { z: 0.0, radius }], pitch)
    }

    /// A cylinder of this `radius` [m] and `length` [m] along z, its middle in the origin, vertices
    /// `pitch` [m] apart.
    ///
    /// # Errors
    /// Sizes out of range, too coarse, too many vertices.
    pub fn cylinder(radius: f64, length: f64, pitch: f64) -> Result<Self, MeshError> {
        check_sizes([("radius", radius), ("length", length), ("pitch", pitch)])?;
        check_round("radius", radius, pitch)?;
        let low = -length / 2.0;
        let end = Piece::Line([0.0, low], [radius, low]);
        let wall = Piece::Line([radius, low], [radius, 0.0]);
        turn(&[end, wall], pitch)
    }

    /// A pipe between the radii `inner` and `outer` [m], of this `length` [m] along z, its middle
    /// in the origin, vertices `pitch` [m] apart. Its bore is the inside of a cylinder.
    ///
    /// # Errors
    /// Sizes out of range, too coarse (also for the wall: chords of the outer circle may not reach
    /// the bore), too many vertices.
    pub fn tube(inner: f64, outer: f64, length: f64, pitch: f64) -> Result<Self, MeshError> {
        check_sizes([("inner", inner), ("outer", outer), ("length", length), ("pitch", pitch)])?;
        if inner >= outer {
            let allowed = format!("below `outer`, which is {outer}");
            return Err(ParameterError { field: "inner", value: inner, allowed }.into());
        }
        check_round("inner", inner, pitch)?;
        check_round("outer", outer, pitch)?;
        let low = -length / 2.0;
        let bore = Piece::Line([inner, 0.0], [inner, low]);
        let end = Piece::Line([inner, low], [outer, low]);
        let wall = Piece::Line([outer, low], [outer, 0.0]);
        turn(&[bore, end, wall], pitch)
    }

    /// A cylinder with round ends: everything within `radius` [m] of a line of this `length` [m]
    /// along z, its middle in the origin, vertices `pitch` [m] apart.
    ///
    /// # Errors
    /// Sizes out of range, too coarse, too many vertices.
    pub fn capsule(radius: f64, length: f64, pitch: f64) -> Result<Self, MeshError> {
        check_sizes([("radius", radius), ("length", length), ("pitch", pitch)])?;
        check_round("radius", radius, pitch)?;
        let z = -length / 2.0;
        turn(&[Piece::Quarter { z, radius }, Piece::Line([radius, z], [radius, 0.0])], pitch)
    }
}

/// Fails unless every size is finite and above zero.
pub(super) fn check_sizes<const N: usize>(
    sizes: [(&'static str, f64); N],
) -> Result<(), MeshError> {
    let wrong = |(field, value)| ParameterError::positive(field, value);
    match sizes.into_iter().find_map(wrong) {
        None => Ok(()),
        Some(error) => Err(error.into()),
    }
}

pub(super) fn check_round(field: &'static str, radius: f64, pitch: f64) -> Result<(), MeshError> {
    let around = (TAU * radius / pitch).round();
    if around >= LEAST_AROUND {
        return Ok(());
    }
    let would_do = TAU * radius / LEAST_AROUND;
    Err(MeshError::TooCoarse { field, radius, pitch, around, least: LEAST_AROUND, would_do })
}
