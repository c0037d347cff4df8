//! Mass properties of a clump: of the union of its spheres, or as its file gives them.

use abrade::{Inertia, ShapeError, UnionInertia, overlapping_pairs};
use nalgebra::{Matrix3, Point3, Vector3};

use super::ClumpFile;

/// Where mass properties come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The union of the spheres: an overlap counts once.
    Union,
    /// The clump's file.
    File,
}

/// Mass properties, in units of the file's lengths until the clump is scaled to metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Properties {
    /// Centre of mass [m].
    pub centre: Point3<f64>,
    /// Mass and inertia about the centre of mass.
    pub inertia: Inertia,
}

/// What there is to say about a clump.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Number of spheres.
    pub spheres: usize,
    /// Union of the spheres, of unit density.
    pub union: UnionInertia,
    /// Sum of the spheres' volumes [m3].
    pub summed_volume: f64,
    /// Pairs of spheres that overlap.
    pub overlapping_pairs: usize,
    /// Largest distance of a point of the clump from the centre of mass [m].
    pub bounding_radius: f64,
    /// How much the file's volume differs from the union's, relative to the latter [-].
    pub volume_difference: Option<f64>,
    /// Distance between the file's centre and the union's, relative to the bounding radius [-].
    pub centre_difference: Option<f64>,
    /// Largest difference of a principal moment per mass, relative to the union's largest [-].
    pub inertia_difference: Option<f64>,
}

impl ClumpFile {
    /// Looks the clump over.
    ///
    /// # Errors
    /// No sphere, or one out of range.
    pub fn report(&self) -> Result<Report, ShapeError> {
        let union = UnionInertia::of_balls(&self.spheres)?;
        let reach = |ball: &abrade::Ball| (ball.centre - union.centre).norm() + ball.radius;
        let bounding_radius = self.spheres.iter().map(reach).fold(0.0, f64::max);
        let ball = |radius: f64| 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3);
        let given = &self.given;
        let own = moments(&(union.tensor / union.volume));
        let apart = |tensor: Matrix3<f64>| (moments(&tensor) - own).amax() / own.amax();
        Ok(Report {
            spheres: self.spheres.len(),
            summed_volume: self.spheres.iter().map(|sphere| ball(sphere.radius)).sum(),
            overlapping_pairs: overlapping_pairs(&self.spheres).len(),
            bounding_radius,
            volume_difference: given.volume.map(|volume| volume / union.volume - 1.0),
            centre_difference: given
                .centre
                .map(|centre| (centre - union.centre).norm() / bounding_radius),
            inertia_difference: given.tensor_per_mass.map(apart),
            union,
        })
    }

    /// Mass properties from `source`; none if the file does not give what they need. Without a
    /// mass in the file, it follows from `density` [kg/m3] and the volume.
    pub fn properties(
        &self,
        source: Source,
        density: Option<f64>,
        union: &UnionInertia,
    ) -> Option<Properties> {
        match source {
            Source::Union => {
                let density =
                    density.or_else(|| self.given.mass.map(|mass| mass / union.volume))?;
                let mass = density * union.volume;
                let tensor = union.tensor * density;
                Some(Properties { centre: union.centre, inertia: Inertia { mass, tensor } })
            }
            Source::File => {
                let volume = self.given.volume.unwrap_or(union.volume);
                let by_density = density.map(|density| density * volume);
                let mass = self.given.mass.or(by_density)?;
                let tensor = self.given.tensor_per_mass? * mass;
                let centre = self.given.centre.unwrap_or(union.centre);
                Some(Properties { centre, inertia: Inertia { mass, tensor } })
            }
        }
    }
}

impl Report {
    /// Share of the spheres' volume that lies in overlaps: 1 - union / sum [-].
    pub fn overlap_share(&self) -> f64 {
        1.0 - self.union.volume / self.summed_volume
    }

    /// How the file's own values differ from the union's, in words; none if it gives none.
    pub fn difference(&self) -> Option<String> {
        let named = [
            ("volume", self.volume_difference),
            ("centre", self.centre_difference),
            ("inertia", self.inertia_difference),
        ];
        let parts: Vec<String> = named
            .iter()
            .filter_map(|(name, difference)| {
                difference.map(|d| format!("{name} by {:+.2} %", 100.0 * d))
            })
            .collect();
        let all = parts.join(", ");
        (!parts.is_empty()).then(|| format!("the file's own values differ from the union's: {all}"))
    }
}

/// Principal moments in rising order; not numbers if the tensor is not finite.
pub(super) fn moments(tensor: &Matrix3<f64>) -> Vector3<f64> {
    if !tensor.iter().all(|x| x.is_finite()) {
        return Vector3::repeat(f64::NAN);
    }
    let mut moments: [f64; 3] = tensor.symmetric_eigenvalues().into();
    moments.sort_by(f64::total_cmp);
    moments.into()
}
