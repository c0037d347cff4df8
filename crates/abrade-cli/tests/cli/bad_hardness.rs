//! Hardness by place that cannot be: the whole message.

use super::refused;

const LAW: &str = "motion: Fixed,";
const MAP: &str = r#"hardness_map: (file: "weld.csv", scale: 1e-3),"#;

#[test]
fn a_region_without_a_node() {
    refused(
        "a_region_without_a_node",
        &[(
            LAW,
            r#"regions: [
        (hardness: "9 GPa", box: (from: (-1, -1, 0), to: (1, 1, 0))),
        (hardness: "4 GPa", box: (from: (0.1, 0, 0), to: (0.2, 0.1, 0))),
      ],"#,
        )],
        &[],
        &[],
        r#"error: `surfaces.plate.regions.1` has no node in its box
  --> scene.ron:16:9
   |
16 |         (hardness: "4 GPa", box: (from: (0.1, 0, 0), to: (0.2, 0.1, 0))),
   |         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ the nodes are between (-1.494e-2, -5.925e-3, 0.000e0) and (1.494e-2, 6.000e-3, 0.000e0) m

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_box_from_top_to_bottom() {
    refused(
        "a_box_from_top_to_bottom",
        &[(LAW, r#"regions: [(hardness: "9 GPa", box: (from: (0, 1, 0), to: (1, "-1 mm", 0)))],"#)],
        &[],
        &[],
        r#"error: `surfaces.plate.regions.0.box` is empty along y
  --> scene.ron:14:68
   |
14 |       regions: [(hardness: "9 GPa", box: (from: (0, 1, 0), to: (1, "-1 mm", 0)))],
   |                                                                    ^^^^^^^ is below `from`, which is 1 m

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_region_as_soft_as_nothing() {
    refused(
        "a_region_as_soft_as_nothing",
        &[(LAW, r#"regions: [(hardness: 0, box: (from: (-1, -1, 0), to: (1, 1, 0)))],"#)],
        &[],
        &[],
        r#"error: `surfaces.plate.regions.0.hardness` is out of range
  --> scene.ron:14:28
   |
14 |       regions: [(hardness: 0, box: (from: (-1, -1, 0), to: (1, 1, 0)))],
   |                            ^ must be between 6600 and 6600000000000000

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_hardness_map_that_is_not_there() {
    refused(
        "a_hardness_map_that_is_not_there",
        &[(LAW, MAP)],
        &[],
        &[],
        r#"error: the hardness map `weld.csv` cannot be read: there is no `weld.csv` in `{here}`
  --> scene.ron:14:28
   |
14 |       hardness_map: (file: "weld.csv", scale: 1e-3),
   |                            ^^^^^^^^^^

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_hardness_map_with_a_bad_line() {
    refused(
        "a_hardness_map_with_a_bad_line",
        &[(LAW, MAP)],
        &[("weld.csv", "# mm, mm, mm, Pa\n0, 0, 0, 9e9\n1, 0, 9e9\n")],
        &[],
        r#"error: the hardness map `weld.csv` has a bad line
  --> weld.csv:3:1
   |
 3 | 1, 0, 9e9
   | ^^^^^^^^^ has 3 numbers, not x, y, z and a hardness
   |
  ::: scene.ron:14:28
   |
14 |       hardness_map: (file: "weld.csv", scale: 1e-3),
   |                            ---------- named here

scene.ron: 1 problem, nothing was run
"#,
    );
}

#[test]
fn a_hardness_map_without_a_line() {
    refused(
        "a_hardness_map_without_a_line",
        &[(LAW, MAP)],
        &[("weld.csv", "# mm, mm, mm, Pa\n")],
        &[],
        r#"error: the hardness map `weld.csv` has no line
  --> scene.ron:14:28
   |
14 |       hardness_map: (file: "weld.csv", scale: 1e-3),
   |                            ^^^^^^^^^^

scene.ron: 1 problem, nothing was run
"#,
    );
}
