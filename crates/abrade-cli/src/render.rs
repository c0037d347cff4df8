//! Problems of a scene as text: message, file, line and column, the marked lines, what to do.

use abrade_report::quantity_text::count;
use abrade_scene::{Problem, SceneError, Source};
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

/// Every problem, and how many there are.
pub(crate) fn scene_error(error: &SceneError, colour: bool) -> String {
    let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
    let mut text = String::new();
    for problem in &error.problems {
        text += &match problem.marks.is_empty() {
            true => format!("error: {}\n --> {}", problem.message, error.path),
            false => renderer.render(&[group(problem, &error.sources)]),
        };
        text += "\n\n";
    }
    let problems = count(error.problems.len(), "problem", "problems");
    text + &format!("{}: {problems}, nothing was run\n", error.path)
}

fn group<'a>(problem: &'a Problem, sources: &'a [Source]) -> Group<'a> {
    let mut group = Group::with_title(Level::ERROR.primary_title(problem.message.as_str()));
    let mut shown: Vec<usize> = Vec::new();
    for mark in &problem.marks {
        if shown.contains(&mark.source) {
            continue;
        }
        shown.push(mark.source);
        let source = &sources[mark.source];
        let marks = problem.marks.iter().enumerate().filter(|(_, m)| m.source == mark.source);
        let annotations = marks.map(|(i, m)| {
            let kind = match i {
                0 => AnnotationKind::Primary,
                _ => AnnotationKind::Context,
            };
            let annotation = kind.span(m.range.clone());
            match m.label.is_empty() {
                true => annotation,
                false => annotation.label(m.label.as_str()),
            }
        });
        let snippet = Snippet::source(source.text.as_str())
            .line_start(source.first_line)
            .path(source.name.as_str())
            .annotations(annotations);
        group = group.element(snippet);
    }
    match &problem.help {
        Some(help) => group.element(Level::HELP.message(help.as_str())),
        None => group,
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const SCENE: &str =
        "(version: 1, name: \"µ\",\n materials: {},\n surfaces: {},\n bodies: {},\n)";

    proptest! {
        #[test]
        fn any_problem_can_be_shown(
            at in 0..SCENE.len(),
            length in 0usize..9,
            glyphs in "[(){}:,\"µa1 \n\t]{0,4}",
            set in "([a-z.=(µ]|name){0,6}",
        ) {
            let (start, end) = (SCENE.floor_char_boundary(at), SCENE.floor_char_boundary(at + length));
            let mut text = SCENE.to_owned();
            text.replace_range(start..end, &glyphs);
            for sets in [vec![], vec![set]] {
                if let Err(error) = abrade_scene::load_text("s", text.clone(), "".into(), &sets) {
                    prop_assert!(scene_error(&error, false).contains("error: "));
                }
            }
        }
    }
}
