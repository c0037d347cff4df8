//! No text of a scene makes the program panic, and every mark lies in its source.

use std::path::PathBuf;

use abrade_scene::load_text;
use proptest::prelude::*;

use super::SCENE;

/// Loads, sizes, prints; the outcome is free.
fn load(text: &str, sets: &[String]) {
    match load_text("scene.ron", text.to_owned(), PathBuf::from("/nowhere"), sets) {
        Ok(checked) => {
            let _ = checked.size();
        }
        Err(error) => {
            assert!(!error.problems.is_empty());
            let _ = error.to_string();
            for mark in error.problems.iter().flat_map(|problem| &problem.marks) {
                let source = &error.sources[mark.source];
                let _ = (&source.text[mark.range.clone()], source.line_column(mark.range.start));
            }
        }
    }
}

fn number() -> impl Strategy<Value = String> {
    prop_oneof![
        any::<f64>().prop_map(|x| format!("{x:?}")),
        (-400i32..400).prop_map(|exponent| format!("1e{exponent}")),
        prop::sample::select(vec!["0", "-0.0", "NaN", "inf", "1", "-1", "1e-3", "1e308", "5e-324"])
            .prop_map(str::to_owned),
    ]
}

fn path() -> impl Strategy<Value = String> {
    let paths = abrade_scene::fields().into_iter().map(|field| field.path);
    let settable = paths.filter(|path| !path.contains('=')).map(|path| {
        let names = [("materials", "plate"), ("surfaces", "plate"), ("bodies", "ball")];
        let named = names.iter().find(|(kind, _)| path.starts_with(kind));
        path.replace("<name>", named.map_or("x", |(_, name)| name)).replace("<i>", "0")
    });
    prop::sample::select(settable.collect::<Vec<_>>())
}

fn value() -> impl Strategy<Value = String> {
    prop_oneof![
        4 => number(),
        1 => (number(), prop::sample::select(vec!["m", "mm", "deg", "GPa", "m/s", "kN", "?"]))
            .prop_map(|(number, unit)| format!("\"{number} {unit}\"")),
        2 => prop::collection::vec(number(), 2..5).prop_map(|row| format!("({})", row.join(","))),
        1 => prop::sample::select(vec![
            "Eq5", "Rigid", "Foundation()", "FirstExit", "[]", "{}", "()", "\"\"", "true",
            "Distance", "Ball()", "None", "Random(seed: 1)", "Picture", "\"plate\"",
        ]).prop_map(str::to_owned),
    ]
}

fn shape() -> impl Strategy<Value = String> {
    let row = |n| prop::collection::vec(number(), n).prop_map(|row| format!("({})", row.join(",")));
    prop_oneof![
        row(3).prop_map(|size| format!("Cuboid(size: {size})")),
        number().prop_map(|radius| format!("Ball(radius: {radius})")),
        number().prop_map(|edge| format!("Polyhedron(kind: Icosahedron, edge: {edge})")),
        prop::collection::vec(row(3), 0..8)
            .prop_map(|points| format!("ConvexHull(points: [{}])", points.join(","))),
        prop::collection::vec(row(4), 0..4)
            .prop_map(|spheres| format!("Clump(spheres: [{}])", spheres.join(","))),
    ]
}

/// Sizes that make few nodes or far too many.
fn size() -> impl Strategy<Value = &'static str> {
    prop::sample::select(vec![
        "0", "-0.0", "NaN", "inf", "-1", "1", "2", "0.3", "1e-9", "1e308", "5e-324", "1e-160",
    ])
}

fn solid() -> impl Strategy<Value = String> {
    let made = |words: [&'static str; 4]| {
        prop::array::uniform4(size()).prop_map(move |sizes| {
            let fields = words.iter().zip(sizes).filter(|(word, _)| !word.is_empty());
            fields.map(|(word, size)| format!("{word}: {size}")).collect::<Vec<_>>().join(", ")
        })
    };
    prop_oneof![
        made(["radius", "pitch", "", ""]).prop_map(|fields| format!("Sphere({fields})")),
        made(["radius", "length", "pitch", ""]).prop_map(|fields| format!("Cylinder({fields})")),
        made(["inner", "outer", "length", "pitch"]).prop_map(|fields| format!("Tube({fields})")),
        made(["radius", "length", "pitch", ""]).prop_map(|fields| format!("Capsule({fields})")),
        prop::array::uniform6(size()).prop_map(|[inner, outer, radius, angle, straight, pitch]| {
            format!(
                "Bend(inner: {inner}, outer: {outer}, radius: {radius}, angle: {angle}, \
                 straight: {straight}, pitch: {pitch})"
            )
        }),
        prop::array::uniform4(size()).prop_map(|[x, y, z, pitch]| {
            format!("Cuboid(half_extents: ({x}, {y}, {z}), pitch: {pitch})")
        }),
    ]
}

proptest! {
    #[test]
    fn any_sizes_of_a_solid(solid in solid()) {
        load(SCENE, &[format!("surfaces.plate.geometry={solid}")]);
    }

    #[test]
    fn any_stream(count in 0u32..9, [every, x, y, z, spread] in prop::array::uniform5(size())) {
        let motion = format!("Free(velocity: ({x}, {y}, {z}))");
        load(SCENE, &[format!(
            "streams={{\"s\": (shape: Ball(radius: 1e-3), density: 1.0, count: {count}, every: {every}, \
             position: OnSurface(surface: \"plate\"), motion: {motion}, spread: {spread})}}"
        )]);
    }

    #[test]
    fn any_value_in_any_place(sets in prop::collection::vec((path(), value()), 1..4)) {
        let sets: Vec<_> = sets.iter().map(|(path, value)| format!("{path}={value}")).collect();
        load(SCENE, &sets);
    }

    #[test]
    fn any_numbers_in_a_shape(shape in shape()) {
        load(SCENE, &[format!("bodies.ball.shape={shape}")]);
    }

    #[test]
    fn any_damage_to_the_text(at in 0..SCENE.len(), length in 0usize..40, glyphs in r#"[(){}\[\]:,"'/*a-z0-9.µ ]{0,6}"#) {
        let mut text = SCENE.to_owned();
        text.replace_range(at..(at + length).min(SCENE.len()), &glyphs);
        load(&text, &["bodies.ball.motion.speed=30 m/s".to_owned()]);
    }

    #[test]
    fn any_argument(argument in r#"([a-z.="()0-9µ\[]|bodies|ball|motion|speed){0,12}"#) {
        load(SCENE, &[argument]);
    }

    #[test]
    fn any_text(text in any::<String>()) {
        load(&text, &[]);
    }
}
