//! What lies in a results folder before a command writes into it.

use super::Folder;

/// Fails for a run that replaces another one in silence, and for one that is taken for none of abrade's.
#[test]
fn a_run_that_replaces_another_one_says_so() {
    let folder = Folder::new("earlier");
    let place = "runs/a scene";
    folder.write("a scene.ron", super::SCENE);
    let set = ["--set", "outputs=[History(every: \"1 us\")]"];
    let run = || folder.abrade(&[&["run", "a scene.ron"], &set[..]].concat());
    let first = run();
    assert_eq!((first.code, first.err.as_str()), (Some(0), ""));
    let again = run();
    assert_eq!(again.code, Some(0));
    let (begin, end) = ("note: replaces the run `Oblique impact of a ball` of ", " ago in ");
    assert!(again.err.starts_with(begin), "{}", again.err);
    assert!(
        again.err.ends_with(&format!("{end}\"{place}\"; --out DIR keeps both\n")),
        "{}",
        again.err
    );
    assert!(again.out.ends_with(&format!(" in \"{place}\"\n")), "{}", again.out);
    // What a run leaves that was killed while it wrote its last files is no reason to ask.
    std::fs::remove_file(folder.0.join(place).join("summary.json")).unwrap();
    let history = folder.0.join(place).join("history.csv");
    std::fs::copy(&history, history.with_extension("csv.1-2-0.partial")).unwrap();
    let after_kill = run();
    assert_eq!((after_kill.code, after_kill.err.as_str()), (Some(0), ""));
}

/// Fails for a scene that takes the folder of another one whose file is called alike.
#[test]
fn two_scenes_of_one_file_name_keep_both_runs() {
    let folder = Folder::new("alike");
    std::fs::create_dir(folder.0.join("other")).unwrap();
    folder.write("other/scene.ron", &super::SCENE.replace("Oblique impact of a ball", "Another"));
    let none = ["--set", "outputs=[]"];
    let run = |more: &[&str]| folder.abrade(&[&["run"], more, &none].concat());
    assert_eq!(run(&["scene.ron"]).code, Some(0));
    let other = run(&["other/scene.ron"]);
    let said = "the output folder `runs/scene` holds the run `Oblique impact of a ball`: name another \
                one with --out, or empty it";
    assert_eq!(other.code, Some(2), "{}", other.err);
    assert!(other.err.contains(said), "{}", other.err);
    assert_eq!(run(&["other/scene.ron", "--out", "runs/scene"]).code, Some(0));
}

/// Fails for a run that leaves files of the one in whose place it is, which would be shown with its numbers, and
/// for one that takes files that are not abrade's.
#[test]
fn nothing_of_the_run_before_is_left_and_all_else_is() {
    let folder = Folder::new("replaced");
    let run = |outputs: &str| {
        let set = format!("outputs={outputs}");
        let said = folder.abrade(&["run", "scene.ron", "--out", "out", "--set", &set]);
        assert_eq!(said.code, Some(0), "{}", said.err);
        let entries = std::fs::read_dir(folder.0.join("out")).unwrap();
        let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let mut names: Vec<String> = names.filter(|name| !name.starts_with('.')).collect();
        names.sort();
        names
    };
    let all = run("[Surface(at: End), Picture, Mesh(format: Obj), Report]");
    let written = [
        "report.html",
        "summary.json",
        "surface.obj",
        "surface.png",
        "surface.pvd",
        "surface_0000.vtp",
    ];
    assert_eq!(all, written);
    folder.write("out/notes.txt", "mine");
    folder.write("out/surface_cut.png", "mine");
    assert_eq!(run("[]"), ["notes.txt", "summary.json", "surface_cut.png"]);
}

/// Fails for a command that writes over files that are not abrade's, or that of another command.
#[test]
fn a_folder_of_something_else_is_left_alone() {
    let folder = Folder::new("foreign");
    folder.write("study.ron", crate::studies::EROSION);
    folder.write("map.ron", crate::adhesive::MAP);
    let mine = folder.0.join("mine");
    std::fs::create_dir(&mine).unwrap();
    std::fs::write(mine.join("summary.json"), "{\"scene\": \"a theatre\"}").unwrap();
    std::fs::write(mine.join("report.html"), "<p>a report").unwrap();
    std::fs::write(mine.join("study.csv"), "a,b\n").unwrap();
    std::fs::write(mine.join("map.png"), "a street").unwrap();
    std::fs::create_dir(mine.join("cases")).unwrap();
    std::fs::write(mine.join("cases/1.txt"), "a lawsuit").unwrap();
    let held_by = || {
        let places = [mine.clone(), mine.join("cases")];
        places.map(|place| std::fs::read_dir(place).unwrap().count())
    };
    let before = held_by();
    for (arguments, held) in [
        (&["run", "scene.ron"][..], "files that are no run's of abrade"),
        (&["study", "erosion", "study.ron"], "report.html of something else"),
        (&["sweep", "study.ron", "--merge", "mine"], "report.html of something else"),
        (&["study", "convergence", "scene.ron"], "study.csv of something else"),
        (&["adhesive", "map", "map.ron"], "map.png of something else"),
    ] {
        // `--merge` takes all that follows it.
        let (command, rest) = arguments.split_at(2);
        let said = folder.abrade(&[command, &["--out", "mine"], rest].concat());
        assert_eq!(said.code, Some(2), "{arguments:?}: {}", said.err);
        let told = format!(
            "error: the output folder `mine` holds {held}: name another one with --out, or empty it\n"
        );
        assert_eq!(said.err, told, "{arguments:?}");
        assert_eq!(held_by(), before, "{arguments:?}");
    }
}

/// Fails for a study that puts its files among those of a run, and for a run that does so among those of a study.
#[test]
fn a_study_and_a_run_do_not_share_a_folder() {
    let folder = Folder::new("shared");
    folder.write("study.ron", crate::studies::EROSION);
    folder.write("map.ron", crate::adhesive::MAP);
    let into =
        |out: &str, arguments: &[&str]| folder.abrade(&[arguments, &["--out", out]].concat());
    let run = ["run", "scene.ron", "--set", "outputs=[]"];
    let study = ["study", "erosion", "study.ron"];
    assert_eq!(into("a", &run).code, Some(0));
    assert_eq!(into("b", &study).code, Some(0));
    let convergence = ["study", "convergence", "scene.ron"];
    for arguments in [&study[..], &convergence, &["adhesive", "map", "map.ron"]] {
        let said = into("a", arguments);
        let told = "error: the output folder `a` holds the run `Oblique impact of a ball`: name another one \
                    with --out, or empty it\n";
        assert_eq!((said.code, said.err.as_str()), (Some(2), told), "{arguments:?}");
    }
    let said = into("b", &run);
    assert_eq!(said.code, Some(2));
    assert!(said.err.contains("holds files that are no run's of abrade"), "{}", said.err);
    // A run that was broken off has no summary.
    std::fs::remove_file(folder.0.join("a/summary.json")).unwrap();
    let said = into("a", &study);
    assert_eq!(said.code, Some(2));
    assert!(said.err.contains("holds a run that was broken off"), "{}", said.err);
}

/// Fails for a run that ends where nobody reads what it tells beside its results.
#[test]
fn work_goes_on_where_nobody_reads_the_error_stream() {
    use std::process::{Command, Stdio};

    let folder = Folder::new("unread_stream");
    assert_eq!(folder.abrade(&["run", "scene.ron"]).code, Some(0));
    let mut run = Command::new(env!("CARGO_BIN_EXE_abrade"));
    run.current_dir(&folder.0).args(["run", "scene.ron"]);
    let mut run = run.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    drop(run.stderr.take());
    assert_eq!(run.wait().unwrap().code(), Some(0));
}
