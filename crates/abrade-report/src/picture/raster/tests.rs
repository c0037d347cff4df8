//! Fields between nodes.

use super::*;

/// A close-packed lattice with a depth of `depth(x, y)`.
fn lattice(spacing: f64, depth: impl Fn(f64, f64) -> f64) -> Vec<Seen> {
    let column = |i: i32| (-20..=20).map(move |j| (i, j));
    let nodes = (-20..=20).flat_map(column).map(|(i, j)| {
        let shift = if i % 2 == 0 { 0.0 } else { 0.5 };
        let at = [f64::from(i) * 0.75_f64.sqrt() * spacing, (f64::from(j) + shift) * spacing];
        Seen { at, depth: depth(at[0], at[1]), spacing }
    });
    nodes.collect()
}

fn tilted(x: f64, y: f64) -> f64 {
    30.0 + x - 2.0 * y
}

/// A program that blurs would miss the depth of a lone deep node; one that only paints the
/// nearest point would leave gaps.
#[test]
fn the_field_meets_every_node_and_has_no_holes() {
    let mut nodes = lattice(1.0, tilted);
    let middle = nodes.iter_mut().find(|n| n.at == [0.0, 0.0]).expect("a node at the origin");
    middle.depth = 50.0;
    let grid = Grid { origin: [-5.0, 5.0], step: [0.1, -0.1], size: [101, 101] };
    let field = grid.spread(nodes.into_iter());
    assert!(field.iter().all(|depth| depth.is_finite()));
    assert!((field[50 * 101 + 50] - 50.0).abs() < 1e-3, "{}", field[50 * 101 + 50]);
    // A neighbour one pitch up keeps its own depth, 30 - 2.
    assert!((field[40 * 101 + 50] - 28.0).abs() < 1e-3, "{}", field[40 * 101 + 50]);
}

/// A program that swapped axes or signs would tilt the plane the wrong way, one without slopes
/// would step from node to node; the tolerance is that of single precision.
#[test]
fn a_tilted_plane_stays_a_tilted_plane() {
    let grid = Grid { origin: [-5.0, 5.0], step: [0.2, -0.1], size: [51, 101] };
    let field = grid.spread(lattice(1.0, tilted).into_iter());
    for row in 0..101 {
        for column in 0..51 {
            let exact = tilted(grid.at(0, column), grid.at(1, row));
            let found = f64::from(field[row * 51 + column]);
            assert!((found - exact).abs() < 1e-4, "{found} for {exact}");
        }
    }
}

/// A program that extends each node's slope all the way would show a bowl deeper between nodes
/// than it is, one without slopes shallower: both by a quarter of a node distance's worth here,
/// 0.25. The tolerance is a tenth of that.
#[test]
fn a_bowl_is_as_deep_between_nodes_as_it_is() {
    let bowl = |x: f64, y: f64| 400.0 - x * x - 0.5 * y * y;
    let grid = Grid { origin: [-5.0, 5.0], step: [0.2, -0.1], size: [51, 101] };
    let field = grid.spread(lattice(1.0, bowl).into_iter());
    for row in 0..101 {
        for column in 0..51 {
            let exact = bowl(grid.at(0, column), grid.at(1, row));
            let found = f64::from(field[row * 51 + column]);
            assert!((found - exact).abs() < 0.025, "{found} for {exact}");
        }
    }
}

/// A program that coloured every point with a trace of a worn node's weight would draw a lone
/// worn node with four times the area it stands for.
#[test]
fn a_worn_node_colours_about_its_own_area() {
    let nodes = lattice(1.0, |x, y| if x == 0.0 && y == 0.0 { 1.0 } else { 0.0 });
    let grid = Grid { origin: [-5.0, 5.0], step: [0.02, -0.02], size: [501, 501] };
    let field = grid.spread(nodes.into_iter());
    let area = field.iter().filter(|depth| **depth > 0.0).count() as f64 * 0.02 * 0.02;
    let share = area / 0.75_f64.sqrt();
    assert!((0.8..1.2).contains(&share), "{share}");
}

/// A program that clamped instead of clipping would paint distant nodes on the rim.
#[test]
fn nodes_out_of_reach_leave_no_trace() {
    let grid = Grid { origin: [0.0, 0.0], step: [1.0, 1.0], size: [4, 4] };
    let far = Seen { at: [-50.0, 2.0], depth: 1.0, spacing: 1.0 };
    assert!(grid.spread([far].into_iter()).iter().all(|depth| depth.is_nan()));
}
