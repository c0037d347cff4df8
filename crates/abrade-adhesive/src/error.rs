//! Why an assembly cannot be simulated, or no further.

use abrade::ParameterError;
use thiserror::Error;

/// What is wrong.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum AdhesiveError {
    /// A parameter is out of range.
    #[error("`{}` is {}; must be {}", .0.field, .0.value, .0.allowed)]
    Parameter(#[from] ParameterError),
    /// A link's end is not an element, or both are the same.
    #[error("link {link} joins {} and {}; there are {elements} elements", ends[0], ends[1])]
    Link {
        /// Index of the link.
        link: usize,
        /// Its ends.
        ends: [u32; 2],
        /// Number of elements.
        elements: usize,
    },
    /// A position, velocity or drag is not a finite number, or the drag is below zero.
    #[error("element {element} has no finite place, velocity and drag of at least 0")]
    Element {
        /// Index of the element.
        element: usize,
    },
    /// Two elements are at one place, over the period or not.
    #[error("elements {} and {} are at one place", ends[0], ends[1])]
    OnePlace {
        /// Indices of the elements.
        ends: [usize; 2],
    },
    /// The two bodies overlap before they move.
    #[error("the bodies overlap at the start; `gap` is {gap}, must be such that they do not")]
    Overlap {
        /// The gap [diameters].
        gap: f64,
    },
    /// An element moved further in a step than a step can resolve.
    #[error(
        "at {time:e} s element {element} went at {speed:e} m/s; a step resolves at most {allowed:e} m/s"
    )]
    TooFast {
        /// Time [s].
        time: f64,
        /// The element.
        element: usize,
        /// Its speed [m/s].
        speed: f64,
        /// The highest speed that a step resolves [m/s].
        allowed: f64,
    },
}
