//! Closed surfaces that cannot be: the whole message.

use super::refused;

const PLATE: &str = r#"HexStrip(length: "30 mm", width: "12 mm", pitch: "0.15 mm")"#;
const ON: &str = r#"OnSurface(surface: "plate", at: ("0 mm", "0 mm"), gap: "1 um")"#;
const AT: &str = r#"At(point: (1, 0, 0))"#;

#[test]
fn a_mesh_file_that_is_not_there() {
    refused(
        "a_mesh_file_that_is_not_there",
        &[(PLATE, r#"Mesh(file: "liner.stl")"#), (ON, AT)],
        &[],
        &[],
        r#"error: the mesh `liner.stl` cannot be read: there is no `liner.stl` in `{here}`
  --> scene.ron:11:28
   |
11 |       geometry: Mesh(file: "liner.stl"),
   |                            ^^^^^^^^^^^

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_file_that_is_no_mesh() {
    refused(
        "a_file_that_is_no_mesh",
        &[(PLATE, r#"Mesh(file: "liner.stl")"#), (ON, AT)],
        &[("liner.stl", "a liner, to be drawn\n")],
        &[],
        r#"error: the mesh `liner.stl` cannot be read: it is neither a text nor a binary STL file
  --> scene.ron:11:28
   |
11 |       geometry: Mesh(file: "liner.stl"),
   |                            ^^^^^^^^^^^

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_mesh_with_a_hole() {
    let open = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 2 2 2\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 5 4\n";
    refused(
        "a_mesh_with_a_hole",
        &[(PLATE, r#"Mesh(file: "open.obj")"#), (ON, AT)],
        &[("open.obj", open)],
        &[],
        r#"error: `open.obj` bounds no solid
  --> scene.ron:11:28
   |
11 |       geometry: Mesh(file: "open.obj"),
   |                            ^^^^^^^^^^ the mesh is open: the edge from (0, 1, 0) to (1, 0, 0) m borders on one facet only, and 3 more edges do

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_pitch_that_is_too_coarse() {
    refused(
        "a_pitch_that_is_too_coarse",
        &[(PLATE, r#"Sphere(radius: "10 mm", pitch: "20 mm")"#), (ON, AT)],
        &[],
        &[],
        r#"error: `surfaces.plate.geometry.pitch` is too coarse
  --> scene.ron:11:48
   |
11 |       geometry: Sphere(radius: "10 mm", pitch: "20 mm"),
   |                                                ^^^^^^^ gives 3 nodes around the `radius` of 0.01 m, at least 8 are needed: 7.854e-3 m would do

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn more_nodes_than_can_be() {
    refused(
        "more_nodes_than_can_be",
        &[(PLATE, r#"Cuboid(half_extents: (1, 1, 1), pitch: "1 um")"#), (ON, AT)],
        &[],
        &[],
        r#"error: the surface `plate` has more than 5e6 nodes
  --> scene.ron:11:56
   |
11 |       geometry: Cuboid(half_extents: (1, 1, 1), pitch: "1 um"),
   |                                                        ^^^^^^ gives 2.400e13 vertices

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_bore_wider_than_its_pipe() {
    refused(
        "a_bore_wider_than_its_pipe",
        &[(PLATE, r#"Tube(inner: "9 mm", outer: "8 mm", length: 0.1, pitch: "1 mm")"#), (ON, AT)],
        &[],
        &[],
        r#"error: `surfaces.plate.geometry.inner` is out of range
  --> scene.ron:11:29
   |
11 |       geometry: Tube(inner: "9 mm", outer: "8 mm", length: 0.1, pitch: "1 mm"),
   |                             ^^^^^^ must be below `outer`, which is 0.008

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_height_below_the_base() {
    let field = r#"HeightField(file: "dunes.csv", spacing: (1, 1), base: 0)"#;
    refused(
        "a_height_below_the_base",
        &[(PLATE, field), (ON, AT)],
        &[("dunes.csv", "# heights in m\n1, 1, 1\n1, -2, 1\n")],
        &[],
        r#"error: the height field `dunes.csv` has a bad line
  --> dunes.csv:3:1
   |
 3 | 1, -2, 1
   | ^^^^^^^^ height 1 of row 1 is -2 m, it must be finite and above 0 m
   |
  ::: scene.ron:11:35
   |
11 |       geometry: HeightField(file: "dunes.csv", spacing: (1, 1), base: 0),
   |                                   ----------- named here

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_body_on_the_top_of_a_solid() {
    refused(
        "a_body_on_the_top_of_a_solid",
        &[(PLATE, r#"Sphere(radius: "10 mm", pitch: "1 mm")"#)],
        &[],
        &[],
        r#"error: `bodies.ball` cannot lie on the surface `plate`, which is closed
  --> scene.ron:22:17
   |
11 |       geometry: Sphere(radius: "10 mm", pitch: "1 mm"),
   |                 ------ has no top
...
22 |       position: OnSurface(surface: "plate", at: ("0 mm", "0 mm"), gap: "1 um"),
   |                 ^^^^^^^^^ is for flat surfaces
   |
   = help: place it in the surface's frame: `InFrame(surface: "plate", point: ..)`

scene.ron: 1 problem, nothing was run
"#,
    );
}
