//! Body and surface of a case for the core.

use abrade::{
    Adhesion, Ball, ElasticLaw, FlowLaw, HexStrip, Hull, Lateral, Material, MeshError, Piece,
    Shape, Surface, SurfaceError, SurfaceLaws, TriangleMesh, cuboid_vertices,
};
use nalgebra::{Point3, Vector3};

use crate::case::{Case, Elastic, Flow, Form, Target};

/// Nodes of a strip at most.
const NODES: f64 = 2000.0;
/// Pitches in the radius of the expected contact.
const PITCHES: f64 = 6.0;
/// Pitches in half the extent of a solid.
const SOLID_PITCHES: f64 = 9.0;

/// Balls of a clump: centre along x and radius, of half the size.
pub const CLUMP: [(f64, f64); 3] = [(-0.6, 0.4), (0.0, 0.5), (0.6, 0.4)];
/// Half the width of a needle and half the thickness of a plate, of half the size.
const THIN: f64 = 0.05;

/// The corners of a body with faces [m]; none for others.
pub fn corners(case: &Case) -> Vec<Point3<f64>> {
    let half = 0.5 * case.size;
    match case.form {
        Form::Ball | Form::Clump => Vec::new(),
        Form::Cube => cuboid_vertices(&Vector3::repeat(half / 3f64.sqrt())),
        Form::Needle => {
            let axes = [Vector3::x(), THIN * Vector3::y(), THIN * Vector3::z()];
            axes.iter().flat_map(|a| [Point3::from(half * a), Point3::from(-half * a)]).collect()
        }
        Form::Plate => cuboid_vertices(&(half * Vector3::new(0.7, 0.7, 0.7 * THIN))),
    }
}

pub fn shape(case: &Case) -> Shape {
    let half = 0.5 * case.size;
    match case.form {
        Form::Ball => Shape::ball(half).expect("a ball"),
        Form::Clump => {
            let ball = |(x, radius): (f64, f64)| {
                Piece::Ball(Ball { centre: Point3::new(half * x, 0.0, 0.0), radius: half * radius })
            };
            Shape::union(CLUMP.into_iter().map(ball).collect()).expect("a clump")
        }
        Form::Cube | Form::Needle | Form::Plate => {
            Shape::hull(Hull::solid(&corners(case), 1.0).expect("a hull").0)
        }
    }
}

/// The lowest point of the turned shape, about its middle [m].
pub fn lowest(case: &Case, shape: &Shape) -> Vector3<f64> {
    let turned = |p: &Point3<f64>| case.rotation * p.coords;
    let of = |piece: &Piece| match piece {
        Piece::Ball(ball) => turned(&ball.centre) - ball.radius * Vector3::z(),
        Piece::Hull(hull) => {
            let turned = hull.vertices().iter().map(turned);
            turned.min_by(|a, b| a.z.total_cmp(&b.z)).expect("a hull has vertices")
        }
    };
    let points = shape.pieces().iter().map(of);
    points.min_by(|a, b| a.z.total_cmp(&b.z)).expect("a shape has pieces")
}

fn laws(case: &Case) -> SurfaceLaws {
    let material = Material {
        hardness: case.hardness,
        shear_ratio: case.shear_ratio,
        young: Some(case.young),
        poisson: 0.3,
        friction: case.friction,
    };
    let elastic = match case.elastic {
        Elastic::Foundation => ElasticLaw::Foundation { stiffness: None },
        Elastic::Rigid => ElasticLaw::Rigid,
    };
    let flow = match case.flow {
        Flow::CapozzaHanley => FlowLaw::CapozzaHanley { lateral: Lateral::Projected },
        Flow::NormalPressure => FlowLaw::NormalPressure {},
    };
    let adhesion = case.adhesion.map(|[traction, range]| {
        let range = range * case.contact_radius();
        Adhesion::new(traction * case.hardness * range, range)
    });
    SurfaceLaws { elastic, flow, adhesion, ..SurfaceLaws::of(material) }
}

/// What cannot be built, as a typed error.
#[derive(Debug)]
pub enum Unbuilt {
    Mesh(MeshError),
    Surface(SurfaceError),
}

/// The surface, its top at z = 0 of the body's frame at the start, and half its extent [m].
pub fn surface(case: &Case) -> Result<(Surface, Vector3<f64>), Unbuilt> {
    let pitch = case.contact_radius() / PITCHES;
    let laws = laws(case);
    let mesh = |mesh: Result<TriangleMesh, MeshError>, laws| {
        Surface::mesh(&mesh.map_err(Unbuilt::Mesh)?, laws).map_err(Unbuilt::Surface)
    };
    match case.target {
        Target::Strip => {
            // Twice the contact to both sides, and the way along the plate until it turns back.
            let steep = case.angle.to_radians().tan();
            let way = 4.0 * case.contact_radius() + 3.0 * case.depth() / steep;
            let rows = 4.0 * PITCHES;
            let length = way.min(NODES / rows * pitch);
            let width = rows * pitch;
            let strip = HexStrip { length, width, pitch, rest_area: None };
            let surface = Surface::hex_strip(strip, laws).map_err(Unbuilt::Surface)?;
            Ok((surface, Vector3::new(0.5 * length, 0.5 * width, 2.0 * case.size)))
        }
        Target::Cuboid => {
            let half = Vector3::repeat(SOLID_PITCHES * pitch);
            Ok((mesh(TriangleMesh::cuboid(half, pitch), laws)?, half))
        }
        Target::Sphere => {
            let radius = SOLID_PITCHES * pitch;
            Ok((mesh(TriangleMesh::sphere(radius, pitch), laws)?, Vector3::repeat(radius)))
        }
    }
}

impl Unbuilt {
    pub fn name(&self) -> String {
        match self {
            Self::Mesh(error) => format!("mesh: {error}"),
            Self::Surface(error) => format!("surface: {error}"),
        }
    }
}
