//! What a picture looks at.

use super::*;

/// A hex strip of columns along x with a depth of `depth(x, y)`; pitch 1, depth along `normal`.
fn strip(columns: i32, rows: i32, depth: impl Fn(f64, f64) -> f64) -> Nodes {
    let mut nodes = Nodes::default();
    for i in -columns..=columns {
        for j in -rows..=rows {
            let shift = if i % 2 == 0 { 0.0 } else { 0.5 };
            let (x, y) = (f64::from(i) * 0.75_f64.sqrt(), f64::from(j) + shift);
            nodes.rest_position.push(Point3::new(x, y, 0.0));
            nodes.normal.push(Vector3::z());
            nodes.rest_area.push(0.75_f64.sqrt());
            nodes.depth.push(depth(x, y));
        }
    }
    nodes
}

/// A program that framed every node with a trace of wear, or the whole plate, would show the
/// crater as a dot.
#[test]
fn the_window_frames_the_worn_region_and_keeps_its_aspect() {
    let inside = |x: f64, y: f64| (x - 20.0).abs() < 10.0 && (y + 5.0).abs() < 10.0;
    let faint = |x: f64, y: f64| if x > 55.0 && y > 40.0 { 1e-5 } else { 0.0 };
    let nodes = strip(80, 50, |x, y| if inside(x, y) { 0.1 } else { faint(x, y) });
    let view = View::of(&nodes, 0.25, 0.5);
    assert!((view.aspect() - 0.5).abs() < 1e-12, "{view:?}");
    let height = view.high[1] - view.low[1];
    assert!((20.0..28.0).contains(&height), "{view:?}");
    assert!(view.low[1] < -15.0 && view.high[1] > 5.0, "{view:?}");
    let centre = (view.low[0] + view.high[0]) / 2.0;
    assert!((centre - 20.0).abs() < 1.0, "{view:?}");
}

/// A program that trusted the rest area for the node distance would leave gaps, or blur, where a
/// scene gives the area outright.
#[test]
fn the_node_distance_is_measured() {
    let mut nodes = strip(10, 10, |x, y| if x == 0.0 && y == 0.0 { 1.0 } else { 0.0 });
    nodes.rest_area.fill(0.2);
    let view = View::of(&nodes, 0.25, 0.5);
    let seen: Vec<_> = view.nodes_in(&nodes, [-0.1; 2], [0.1; 2], 0.0).collect();
    assert_eq!(seen.len(), 1);
    assert!((seen[0].spacing - 1.0).abs() < 1e-12, "{seen:?}");
}

/// A program that looked along z at every surface would see this wall edge-on, as a line.
#[test]
fn a_wall_is_seen_against_its_normal() {
    let mut nodes = strip(10, 10, |_, _| 0.1);
    for (position, normal) in nodes.rest_position.iter_mut().zip(&mut nodes.normal) {
        *position = Point3::new(3.0, position.x, position.y);
        *normal = Vector3::x();
    }
    let view = View::of(&nodes, 0.25, 1.0);
    let [x, y] = view.project(&Point3::new(3.0, 4.0, 5.0));
    assert!((x.abs() - 4.0).abs() < 1e-12 && (y.abs() - 5.0).abs() < 1e-12, "{x} {y}");
    assert!(view.high[1] - view.low[1] > 20.0);
}

/// A program that drew both sides of a closed surface would paint the far one over the near one.
#[test]
fn the_far_side_is_not_seen() {
    let mut nodes = strip(3, 3, |x, y| if x == 0.0 && y == 0.0 { 1.0 } else { 0.0 });
    nodes.normal[0] = -Vector3::z();
    let view = View::of(&nodes, 0.25, 0.5);
    let seen = view.nodes_in(&nodes, [-100.0; 2], [100.0; 2], 0.0).count();
    assert_eq!(seen, nodes.len() - 1);
}
