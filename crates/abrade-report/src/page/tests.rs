//! The page as text.

use std::collections::BTreeMap;

use super::*;
use crate::summary::{ErrorEstimate, ResolverCounts};

fn summary() -> Summary {
    let surface = SurfaceSummary { wear_volume: 1.5e-12, max_depth: 0.0125, ..Default::default() };
    Summary {
        scene: "<script>alert(1)</script>".into(),
        abrade: "0.1.0".into(),
        complete: false,
        precision: "f64".into(),
        resolver: ResolverCounts::default(),
        resolver_reasons: BTreeMap::new(),
        wall: 0.25,
        setup: 0.01,
        simulated: 1.2e-5,
        steps: 60,
        node_evaluations: 5012,
        surfaces: BTreeMap::from([("plate".into(), surface)]),
        bodies: BTreeMap::new(),
        energy: None,
        erosion: None,
        error_estimate: ErrorEstimate::default(),
        warnings: vec!["only 3 nodes <touched>".into()],
        stop: Some("interrupted".into()),
        laws: None,
    }
}

/// A program that pasted texts as they are would run a scene's name as a script, and one that
/// forgot the warnings or the end would report a broken run as a good one.
#[test]
fn texts_are_escaped_and_the_end_is_told() {
    let page = to_html(&summary(), None);
    assert!(!page.contains("<script"), "{page}");
    assert!(page.contains("&lt;script&gt;"));
    assert!(page.contains("only 3 nodes &lt;touched&gt;"));
    assert!(page.contains("broken off: interrupted"));
}

/// A program that linked the picture would show a hole once the page is moved.
#[test]
fn the_picture_is_inside() {
    let page = to_html(&summary(), Some(b"\x89PNG"));
    assert!(page.contains("src=\"data:image/png;base64,iVBORw==\""));
    assert!(!page.contains("http"), "nothing is fetched");
}

/// A program that printed `{}` would show 0.0000000000015, and one that cut trailing zeros of
/// whole numbers would show 5 for 5000.
#[test]
fn numbers_are_short_and_exact() {
    assert_eq!(number(1.5e-12), "1.5&nbsp;×&nbsp;10<sup>−12</sup>");
    assert_eq!(number(50_000.0), "50000");
    assert_eq!(number(-0.0125), "−0.0125");
    assert_eq!(number(0.0), "0");
    assert!(to_html(&summary(), None).contains("<td>0.0125&nbsp;m</td>"));
}
