//! Plastic wear of surfaces by rigid bodies: nodes, laws, contact integrator, energy ledger.
//!
//! The model is that of Capozza & Hanley, Powder Technology 410 (2022) 117864, and the
//! generalisation it proposes. No engine, no files, no clock; everything is `f64` and SI.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod adhesion;
mod archard;
mod balance;
mod body;
mod booking;
mod box_grid;
mod candidates;
mod carried;
mod carrier;
mod clump_query;
mod column;
mod column_law;
mod columns;
mod contact;
mod damping;
mod debt;
mod drive;
mod elastic;
mod encounter;
mod error;
mod exit;
mod extent;
mod facets;
mod flight;
mod flow;
mod grid;
mod ground;
mod hardness;
mod hull;
mod inner_loop;
mod integrate;
mod laws;
mod layout;
mod leaf;
mod ledger;
mod material;
mod medial;
mod mesh;
mod mesh_query;
mod mutual;
mod node_law;
mod nodes;
mod patch;
mod planes;
mod press;
mod price;
#[cfg(feature = "bench")]
#[doc(hidden)]
pub mod probe;
mod projection;
#[cfg(feature = "serde")]
pub mod quantity;
mod query;
mod reject;
mod renewal;
mod reweigh;
mod ride;
mod rotation;
mod sag;
mod settle;
mod shape;
mod solid;
#[cfg(feature = "state")]
mod state;
mod sublattice;
mod sunk;
mod surface;
#[cfg(feature = "state")]
mod surface_state;
mod sweep;
mod toll;
mod trial;
mod union_inertia;
mod worn;

pub use body::{Body, Inertia, State};
pub use carried::{Carried, Grip, Met};
pub use carrier::Carrier;
pub use drive::{Drive, DriveSolution, Driven};
pub use elastic::{CALIBRATED_YIELD, ball_radius, calibrated_yield, reference_radius};
pub use encounter::{
    Advance, Encounter, EncounterSettings, Instant, Loads, Observer, Placed, Skin, Until,
};
pub use error::{ParameterError, PhysicsError, ShapeError, SurfaceError};
pub use hull::{Hull, Plane, Polyhedron, cuboid_vertices};
pub use laws::{
    ATTACK_BIN, ATTACK_BINS, Adhesion, Archard, ElasticLaw, FlowLaw, HertzConvention, Lateral,
    Removal,
};
pub use layout::HexStrip;
pub use leaf::Changes;
pub use ledger::Ledger;
pub use material::Material;
pub use mesh::{Bend, Mended, MeshError, TriangleMesh};
pub use mutual::can_meet;
pub use nodes::Nodes;
pub use press::{Hold, Pressed};
pub use renewal::{RenewError, Renewal};
pub use shape::{Ball, Piece, Shape};
pub use surface::{NODE_LIMIT, SOLID_NODE_LIMIT, Surface, SurfaceLaws};
pub use union_inertia::{UnionInertia, overlapping_pairs};
pub use worn::Worn;
