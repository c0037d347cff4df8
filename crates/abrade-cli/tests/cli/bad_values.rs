//! Values, names and files that do not fit: the whole message.

use super::refused;

#[test]
fn a_negative_value() {
    refused(
        "a_negative_value",
        &[(r#""3 mm""#, r#""-3 mm""#)],
        &[],
        &[],
        r#"error: `bodies.ball.shape.radius` is out of range
  --> scene.ron:20:27
   |
20 |       shape: Ball(radius: "-3 mm"),
   |                           ^^^^^^^ must be finite and above zero

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_value_that_is_not_finite() {
    refused(
        "a_value_that_is_not_finite",
        &[("density: 2500.0", "density: inf")],
        &[],
        &[],
        r#"error: `bodies.ball.density`: `inf` is not a finite number
  --> scene.ron:21:16
   |
21 |       density: inf,
   |                ^^^ expected a density in kg/m3, kg/m^3, g/cm3 or g/cm^3

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn wear_faster_than_its_slip() {
    refused(
        "wear_faster_than_its_slip",
        &[(r#"material: "plate","#, r#"material: "plate", archard: (coefficient: 1.5),"#)],
        &[],
        &[],
        r#"error: `surfaces.plate.archard.coefficient` is out of range
  --> scene.ron:10:49
   |
10 |       material: "plate", archard: (coefficient: 1.5),
   |                                                 ^^^ must be between 0 and 1

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn wear_below_faces_without_springs() {
    refused(
        "wear_below_faces_without_springs",
        &[("elastic: Foundation(),", "elastic: Rigid, archard: (coefficient: 1e-3),")],
        &[],
        &[],
        r#"error: `archard` asks for the pressure below a body that slides
  --> scene.ron:13:32
   |
13 |       elastic: Rigid, archard: (coefficient: 1e-3),
   |                                ^^^^^^^^^^^^^^^^^^^ `Rigid` has none; take `Foundation()`

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_plain_number_that_is_not_finite() {
    refused(
        "a_plain_number_that_is_not_finite",
        &[("friction: 0.5", "friction: NaN")],
        &[],
        &[],
        r#"error: `materials.plate.friction` is out of range
 --> scene.ron:6:97
  |
6 |     "plate": (hardness: "6.6 GPa", shear_ratio: 0.25, young: "200 GPa", poisson: 0.3, friction: NaN),
  |                                                                                                 ^^^ must be between 0 and 10

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn an_undefined_material() {
    refused(
        "an_undefined_material",
        &[(r#"material: "plate""#, r#"material: "plat""#)],
        &[],
        &[],
        r#"error: there is no material `plat`
  --> scene.ron:10:17
   |
10 |       material: "plat",
   |                 ^^^^^^ expected `plate`
   |
   = help: did you mean `plate`?

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_clump_file_with_a_bad_line() {
    refused(
        "a_clump_file_with_a_bad_line",
        &[(r#"Ball(radius: "3 mm")"#, r#"Clump(file: "grit.txt")"#)],
        &[("grit.txt", "# x y z r\n0 0 0 1e-3\n1e-3 0 zero 1e-3\n")],
        &[],
        r#"error: the clump file `grit.txt` has a bad line
  --> grit.txt:3:1
   |
 3 | 1e-3 0 zero 1e-3
   | ^^^^^^^^^^^^^^^^ `zero` is not a finite number
   |
  ::: scene.ron:20:26
   |
20 |       shape: Clump(file: "grit.txt"),
   |                          ---------- named here

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn an_empty_hull() {
    refused(
        "an_empty_hull",
        &[(r#"Ball(radius: "3 mm")"#, "ConvexHull(points: [])")],
        &[],
        &[],
        r#"error: `bodies.ball.shape` is empty
  --> scene.ron:20:33
   |
20 |       shape: ConvexHull(points: []),
   |                                 ^^ nothing in it

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_coplanar_hull() {
    refused(
        "a_coplanar_hull",
        &[(
            r#"Ball(radius: "3 mm")"#,
            r#"ConvexHull(points: [(0, 0, 0), ("1 mm", 0, 0), (0, "1 mm", 0), ("1 mm", "1 mm", 0)])"#,
        )],
        &[],
        &[],
        r#"error: `bodies.ball.shape`: the 4 points of the hull are coplanar: their thickness is 0e0 m, less than 1e-9 of their extent 1e-3 m
  --> scene.ron:20:33
   |
20 |       shape: ConvexHull(points: [(0, 0, 0), ("1 mm", 0, 0), (0, "1 mm", 0), ("1 mm", "1 mm", 0)]),
   |                                 ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ has no volume

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_body_that_starts_inside_the_surface() {
    refused(
        "a_body_that_starts_inside_the_surface",
        &[(r#"gap: "1 um""#, r#"gap: "-1 mm""#)],
        &[],
        &[],
        r#"error: the body `ball` starts 1.000e-3 m inside the surface `plate`
  --> scene.ron:22:72
   |
22 |       position: OnSurface(surface: "plate", at: ("0 mm", "0 mm"), gap: "-1 mm"),
   |                                                                        ^^^^^^^ must lie above the surface

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn zero_nodes() {
    refused(
        "zero_nodes",
        &[(r#"pitch: "0.15 mm""#, "nodes: 0")],
        &[],
        &[],
        r#"error: `surfaces.plate.geometry.nodes` is out of range
  --> scene.ron:11:66
   |
11 |       geometry: HexStrip(length: "30 mm", width: "12 mm", nodes: 0),
   |                                                                  ^ must be at least 1

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_plate_smaller_than_its_pitch() {
    refused(
        "a_plate_smaller_than_its_pitch",
        &[(r#"length: "30 mm""#, r#"length: "30 um""#)],
        &[],
        &[],
        r#"error: the surface `plate` has no nodes
  --> scene.ron:11:17
   |
11 |       geometry: HexStrip(length: "30 um", width: "12 mm", pitch: "0.15 mm"),
   |                 ^^^^^^^^ gives 0 columns of 80 rows

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_body_with_faces_under_eq5() {
    refused(
        "a_body_with_faces_under_eq5",
        &[
            ("lateral: Projected", "lateral: Eq5"),
            (r#"Ball(radius: "3 mm")"#, r#"Cuboid(size: ("1 mm", "1 mm", "1 mm"))"#),
        ],
        &[],
        &[],
        r#"error: `bodies.ball` cannot meet the surface `plate` under `Eq5`
  --> scene.ron:20:14
   |
12 |       flow: CapozzaHanley(lateral: Eq5),
   |                                    --- for balls alone
...
20 |       shape: Cuboid(size: ("1 mm", "1 mm", "1 mm")),
   |              ^^^^^^ is not a `Ball`
   |
   = help: `Projected` goes with every shape

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn several_faults() {
    refused(
        "several_faults",
        &[
            (r#"young: "200 GPa", "#, ""),
            ("friction: 0.5", "friction: -0.5"),
            (r#"surface: "plate""#, r#"surface: "plato""#),
            ("accuracy: 1e-3", "accuracy: 7"),
        ],
        &[],
        &[],
        r#"error: `materials.plate.friction` is out of range
 --> scene.ron:6:79
  |
6 |     "plate": (hardness: "6.6 GPa", shear_ratio: 0.25, poisson: 0.3, friction: -0.5),
  |                                                                               ^^^^ must be between 0 and 10

error: Foundation() without a stiffness needs `young`, which the material `plate` does not give
  --> scene.ron:13:16
   |
 6 |     "plate": (hardness: "6.6 GPa", shear_ratio: 0.25, poisson: 0.3, friction: -0.5),
   |     ------- gives no `young`
...
13 |       elastic: Foundation(),
   |                ^^^^^^^^^^ needs `young`

error: there is no surface `plato`
  --> scene.ron:22:36
   |
22 |       position: OnSurface(surface: "plato", at: ("0 mm", "0 mm"), gap: "1 um"),
   |                                    ^^^^^^^ expected `plate`
   |
   = help: did you mean `plate`?

error: `run.accuracy` is out of range
  --> scene.ron:28:54
   |
28 |   run: (stop: AllRebounded, resolve: Auto, accuracy: 7),
   |                                                      ^ must be between 0.000001 and 0.5

scene.ron: 4 problems, nothing was run
"#,
    );
}
