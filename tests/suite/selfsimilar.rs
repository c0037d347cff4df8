//! Normal impacts of polyhedra on a face, an edge or a vertex: closed forms of the rigid-plastic
//! theory, in units of the edge.

use abrade::{HexStrip, Polyhedron};
use nalgebra::{UnitQuaternion, Vector3};

use crate::table::{Row, number, read};
use crate::theory::{End, Shot, hull, offsets, rigid};

/// The attitude of a row's shape, if it is a polyhedron, and the size of its imprint.
fn attitude(row: &Row, depth: f64) -> Option<(Polyhedron, UnitQuaternion<f64>, f64)> {
    let diagonal = Vector3::new(1.0, 1.0, 1.0);
    let on_diagonal = UnitQuaternion::rotation_between(&diagonal, &-Vector3::z());
    let quarter = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 45f64.to_radians());
    let upright = UnitQuaternion::identity();
    Some(match row["shape"].as_str() {
        "cube face (L=1)" => (Polyhedron::Cube, upright, 1.2),
        "cube edge (L=1)" => (Polyhedron::Cube, quarter, 1.2),
        "cube corner (L=1)" => (Polyhedron::Cube, on_diagonal?, 8.0 * depth),
        "octa vertex (edge 1)" => (Polyhedron::Octahedron, upright, 8.0 * depth),
        "tetra vertex (edge 1)" => (Polyhedron::Tetrahedron, on_diagonal?, 8.0 * depth),
        _ => return None,
    })
}

/// Fails for a wrong price, slope or friction of a face that goes straight down.
#[test]
fn faces_edges_and_vertices_go_as_deep_as_the_theory() {
    let mut misses = Vec::new();
    let mut rows = 0;
    for row in read("rigid_plastic_selfsimilar") {
        let depth = number(&row, "hmax");
        let Some((kind, rotation, size)) = attitude(&row, depth) else { continue };
        rows += 1;
        let mass = 2.0 * number(&row, "E0_over_HL3");
        let (shape, inertia) = hull(&kind.vertices(1.0), mass);
        let pitch = (depth / 16.0).max(size / 400.0);
        let strip = HexStrip { length: size, width: size, pitch, rest_area: None };
        let shot = Shot {
            rotation,
            friction: number(&row, "mu"),
            rotation_locked: true,
            ..rigid(shape, inertia, 90.0, strip)
        };
        let ends: Vec<_> = offsets(pitch, 2).into_iter().map(|at| shot.land(at)).collect();
        let mean = |f: &dyn Fn(&End) -> f64| ends.iter().map(f).sum::<f64>() / ends.len() as f64;
        let w = mean(&|end| end.paid / end.energy[0]) / number(&row, "W_H_over_E0") - 1.0;
        let lowest = |end: &End| {
            end.state.position.z + shot.shape.lowest(&end.state.rotation, &Vector3::z())
        };
        let h = -mean(&lowest) / depth - 1.0;
        let line = format!(
            "{} E0 {} mu {}: W {w:+.1e} depth {h:+.1e}",
            row["shape"], row["E0_over_HL3"], row["mu"]
        );
        println!("{line}");
        // A stopped body is known to within its last step, a tenth of a pitch.
        if w.abs() > 1e-2 || h.abs() * depth > 2e-2 * depth + 0.1 * pitch {
            misses.push(line);
        }
    }
    assert!(rows == 20 && misses.is_empty(), "{rows} rows\n{}", misses.join("\n"));
}
