//! `view`: pages of runs.

use super::Folder;

/// Runs the scene on a coarse plate with these outputs, into the folder `run`.
fn run(folder: &Folder, outputs: &str) {
    let outputs = format!("outputs={outputs}");
    let pitch = "surfaces.plate.geometry.pitch=0.3 mm";
    let said =
        folder.abrade(&["run", "scene.ron", "--out", "run", "--set", pitch, "--set", &outputs]);
    assert_eq!(said.code, Some(0), "{}", said.err);
}

/// Fails for a page in another place than the one that is told, and for counts of another run.
#[test]
fn view_says_where_its_page_is() {
    let folder = Folder::new("view");
    run(&folder, "[Surface(every: \"1 us\"), Bodies, History(every: \"1 us\")]");
    let said = folder.abrade(&["view", "run"]);
    assert_eq!(said.code, Some(0), "{}", said.err);
    let mut lines = said.out.lines();
    assert_eq!(lines.next(), Some("run/view.html"));
    let told = lines.next().expect("what it holds");
    let html = std::fs::read_to_string(folder.0.join("run/view.html")).unwrap();
    let instants = html.matches("\"poses\"").count() / 2;
    assert!(instants > 2, "{instants}");
    let counts = format!("kB: {instants} instants, 4600 nodes, 1 body");
    assert!(told.ends_with(&counts), "{told}, not {counts}");
    assert!(html.contains("<title>Oblique impact of a ball</title>"));

    let said = folder.abrade(&["view", "run", "--out", "page.html"]);
    assert!(said.out.starts_with("page.html\n"), "{}", said.out);
    assert_eq!(std::fs::read_to_string(folder.0.join("page.html")).unwrap(), html);
}

/// Fails for an empty page, or a message that leaves the reader to guess what to ask for.
#[test]
fn a_run_without_a_surface_is_told_what_to_write() {
    let folder = Folder::new("view of nothing");
    run(&folder, "[Energy]");
    let said = folder.abrade(&["view", "run"]);
    assert_eq!((said.code, said.out.as_str()), (Some(2), ""));
    assert!(said.err.starts_with("error: the run in run wrote no surface: add `Surface(every: "));
    let advised = said.err.split('`').nth(1).expect("what to add");
    run(&folder, &format!("[{advised}]"));
    assert_eq!(folder.abrade(&["view", "run"]).code, Some(0), "{advised}");

    let said = folder.abrade(&["view", "."]);
    assert_eq!(
        said.err,
        "error: . is not the folder of a finished run: it holds no summary.json; `abrade run SCENE` \
         prints the folder it writes to\n"
    );
    assert_eq!(said.code, Some(2));
}

/// Fails for a folder that is not there and is told as one that holds too little, without a word of where its run is.
#[test]
fn a_folder_that_is_not_there_is_told_with_what_is() {
    let folder = Folder::new("view of no folder");
    run(&folder, "[Energy]");
    let here = folder.0.display();
    let said = folder.abrade(&["view", "ru"]);
    let message = format!("error: there is no `ru` in `{here}`; did you mean `run`?\n");
    assert_eq!((said.code, said.err), (Some(2), message));
    folder.write("Ball.ron", super::SCENE);
    assert_eq!(folder.abrade(&["run", "Ball.ron"]).code, Some(0));
    let said = folder.abrade(&["view", "Ball"]);
    let message = format!("error: there is no `Ball` in `{here}`; its run is in `runs/Ball`\n");
    assert_eq!((said.code, said.err), (Some(2), message));
    folder.write("rum.ron", super::SCENE);
    assert_eq!(folder.abrade(&["run", "rum.ron"]).code, Some(0));
    let said = folder.abrade(&["view", "rum"]);
    let message = format!("error: there is no `rum` in `{here}`; its run is in `runs/rum`\n");
    assert_eq!(said.err, message);
}
