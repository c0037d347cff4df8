//! The walker finds what RON reads, and never fails on what is not RON.

use proptest::prelude::*;

use super::*;

const SCENE: &str = r##"#![enable(implicit_some)]
( // a comment with ( and "
    name: "a \" quote", /* nested /* comment */ */
    bodies: {
        "ball": (shape: Ball(radius: "3 mm"), at: ("1 mm", 2.0), flow: CapozzaHanley()),
        r#"cube"#: (motion: Some(Free(velocity: (1, -2.5e-3, .5)))),
    },
    outputs: [Picture, History(every: "1 us"),],
)"##;

fn at(path: &str) -> Option<&'static str> {
    let tree = parse(SCENE).unwrap();
    let path = ScenePath::parse(path).unwrap();
    let found = tree.find(SCENE, &path.0);
    (found.depth == path.0.len()).then(|| &SCENE[found.node.span.clone()])
}

#[test]
fn a_path_leads_through_structs_maps_variants_lists_and_tuples() {
    assert_eq!(at("name"), Some(r#""a \" quote""#));
    assert_eq!(at("bodies.ball.shape.radius"), Some("\"3 mm\""));
    assert_eq!(at("bodies.ball.at.1"), Some("2.0"));
    assert_eq!(at("bodies.ball.flow"), Some("CapozzaHanley()"));
    assert_eq!(at("bodies.\"cube\".motion.velocity.1"), Some("-2.5e-3"));
    assert_eq!(at("outputs.1.every"), Some("\"1 us\""));
    assert_eq!(at("outputs.2"), None);
    assert_eq!(at("bodies.ball.flow.lateral"), None);
}

#[test]
fn a_text_that_is_no_value_is_refused_at_its_place() {
    let trouble = |text| parse(text).map_err(|trouble| (trouble.at, trouble.expected)).err();
    assert_eq!(trouble("(a: 45 deg)"), Some((7, "`,` or `)`")));
    assert_eq!(trouble("(a: \"x)"), Some((7, "a closing quote")));
    assert_eq!(trouble("(a: )"), Some((4, "a value")));
    assert_eq!(trouble("1 2"), Some((2, "the end of the text")));
    assert_eq!(trouble(&"[".repeat(1000)), Some((128, "values nested less deeply")));
}

fn check_spans(text: &str, node: &Node) {
    let _ = (&text[node.span.clone()], &text[node.head(text)]);
    for entry in node.entries() {
        let _ = name_of(text, &entry.key);
    }
    for child in node.children() {
        assert!(node.span.start <= child.span.start && child.span.end <= node.span.end);
        check_spans(text, child);
    }
}

proptest! {
    #[test]
    fn no_text_makes_it_panic(text in r#"([(){}\[\]:,."'/*#!\\rb µ-]|[a-z]{1,3}|[0-9]){0,60}"#) {
        if let Ok(tree) = parse(&text) {
            check_spans(&text, &tree);
        }
    }

    #[test]
    fn no_damage_to_a_scene_makes_it_panic(at in 0..SCENE.len(), glyph in any::<char>()) {
        if SCENE.is_char_boundary(at) {
            let mut text = SCENE.to_owned();
            text.insert(at, glyph);
            if let Ok(tree) = parse(&text) {
                check_spans(&text, &tree);
            }
        }
    }

    #[test]
    fn whatever_ron_reads_has_a_tree(text in r#"([(){}\[\]:,]|"[a-z]?"|[a-z]{1,2}|[0-9.]){0,12}"#) {
        if ron::from_str::<ron::Value>(&text).is_ok() {
            prop_assert!(parse(&text).is_ok(), "{text}");
        }
    }
}
