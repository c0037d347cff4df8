//! Bodies that fall on a face, an edge, a vertex or a tip and do not turn, in units of 1 mm.

use std::f64::consts::TAU;

use crate::run::{Row, Verdict, number, table};
use crate::theory::{End, LANDINGS, land, landing};

/// How a row is run.
struct Fall {
    scene: &'static str,
    body: &'static str,
    sets: Vec<String>,
    /// Volume of the body.
    volume: f64,
    /// Height of its centre of mass over its lowest point.
    height: f64,
    /// Extent of the imprint.
    size: f64,
}

fn polyhedron(kind: &str, volume: f64, height: f64, size: f64, attitude: &str) -> Fall {
    let sets =
        vec![format!("bodies.grit.shape.kind={kind}"), format!("bodies.grit.rotation={attitude}")];
    Fall { scene: "octa_vertex", body: "grit", sets, volume, height, size }
}

/// A pyramid of `sides` whose slopes stand `semi` degrees off the axis, twice as high as `depth`.
fn pyramid(sides: u32, semi: f64, depth: f64) -> Fall {
    let height = 2.0 * depth;
    let half_angle = TAU / f64::from(sides) / 2.0;
    let apothem = height * semi.to_radians().tan();
    let corner = |i: u32| {
        let radius = apothem / half_angle.cos();
        let (y, x) = (TAU * (f64::from(i) + 0.5) / f64::from(sides)).sin_cos();
        format!("(\"{} mm\", \"{} mm\", \"0 mm\")", radius * x, radius * y)
    };
    let corners: Vec<_> = (0..sides).map(corner).collect();
    let points = format!("[(\"0 mm\", \"0 mm\", \"{} mm\"), {}]", -height, corners.join(", "));
    Fall {
        scene: "vickers",
        body: "pyramid",
        sets: vec![format!("bodies.pyramid.shape.points={points}")],
        volume: f64::from(sides) * half_angle.tan() * apothem * apothem * height / 3.0,
        height: 0.75 * height,
        size: 2.4 * depth * semi.to_radians().tan() / half_angle.cos(),
    }
}

fn fall(row: &Row) -> Fall {
    let depth = number(row, "hmax");
    let turned =
        |axis: &str, angle: f64| format!("AxisAngle(axis: ({axis}, 0), angle: \"{angle} deg\")");
    // Turns the body's (1, 1, 1) up, or down.
    let diagonal = 3f64.sqrt().recip().acos().to_degrees();
    let (upright, quarter) = (turned("0, 1", 0.0), turned("0, 1", 45.0));
    let (up, down) = (turned("1, -1", diagonal), turned("-1, 1", 180.0 - diagonal));
    let octahedron = 2f64.sqrt() / 3.0;
    match row["shape"].as_str() {
        "cube face (L=1)" => polyhedron("Cube", 1.0, 0.5, 1.2, &upright),
        "cube edge (L=1)" => polyhedron("Cube", 1.0, 0.5f64.sqrt(), 1.2, &quarter),
        "cube corner (L=1)" => polyhedron("Cube", 1.0, 0.75f64.sqrt(), 8.0 * depth, &up),
        "octa vertex (edge 1)" => {
            polyhedron("Octahedron", octahedron, 0.5f64.sqrt(), 8.0 * depth, &upright)
        }
        "tetra vertex (edge 1)" => {
            let height = 6f64.sqrt() / 4.0;
            polyhedron("Tetrahedron", 1.0 / 72f64.sqrt(), height, 8.0 * depth, &down)
        }
        "Vickers 136deg" => pyramid(4, 68.0, depth),
        "Berkovich 65.27deg" => pyramid(3, 65.27, depth),
        "cube-corner indenter 35.2644deg" => pyramid(3, 35.264_389_682_754_654, depth),
        "cone 45deg semi" => pyramid(128, 45.0, depth),
        "cone 70.2996deg semi (Vickers eq.)" => pyramid(128, 70.299_6, depth),
        _ => Fall {
            scene: "sphere_normal",
            body: "ball",
            sets: vec!["bodies.ball.rotation_locked=true".into()],
            volume: 2.0 * TAU / 3.0,
            height: 1.0,
            size: 3.0 * (2.0 * depth).sqrt(),
        },
    }
}

/// Every row that its table calls valid, but of spheres with friction: its closed form leaves out the
/// slope of a sphere, and `rigid_plastic_sphere_normal` does not. Fails for a wrong price, slope or
/// friction of a face that goes straight down, and for a lock that does not hold.
#[test]
fn faces_edges_vertices_and_tips() {
    let mut verdict = Verdict::default();
    let rubbed = |row: &Row| row["shape"].starts_with("sphere") && number(row, "mu") > 0.0;
    let rows = table("rigid_plastic_selfsimilar");
    for row in rows.iter().filter(|row| row["valid"] == "1" && !rubbed(row)) {
        let Fall { scene, body, sets, volume, height, size } = fall(row);
        let (energy, depth) = (number(row, "E0_over_HL3"), number(row, "hmax"));
        let pitch = (depth / 16.0).max(size / 300.0);
        let mut changes = sets;
        changes.extend([
            // E0 = rho V v^2 / 2
            format!("bodies.{body}.density={}", 2e5 * energy / volume),
            format!("materials.plate.friction={}", number(row, "mu")),
            format!("surfaces.plate.geometry.pitch={pitch} mm"),
            format!("surfaces.plate.geometry.length={size} mm"),
            format!("surfaces.plate.geometry.width={size} mm"),
        ]);
        let ends = LANDINGS.map(|place| {
            let sets = [&changes[..], &[landing(body, pitch, place)]].concat();
            land(scene, body, &sets)
        });
        let wear = ends.iter().map(|end| end.wear).sum::<f64>() / ends.len() as f64;
        let w = wear / number(row, "W_H_over_E0") - 1.0;
        // The tip may lie beside the deepest node, and the body may have risen a little at the end:
        // it was as deep as the deeper of the two, over all landings.
        let reached = |end: &End| end.deepest.max(height - end.height);
        let h = ends.iter().map(reached).fold(0.0, f64::max) / depth - 1.0;
        // A stopped body is known to within its last step, a tenth of a pitch.
        verdict.row(
            w.abs() <= 1e-2 && h.abs() <= 2e-2 + 0.1 * pitch / depth,
            format!("{} E0 {energy} mu {}: W {w:+.1e} depth {h:+.1e}", row["shape"], row["mu"]),
        );
    }
    verdict.close();
}
