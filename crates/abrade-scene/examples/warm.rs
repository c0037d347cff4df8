//! A scene run again and again in one process: what its steps cost once code and memory are warm.
//!
//! cargo run --release -p abrade-scene --example warm -- FOLDER TIMES SCENE [PATH=VALUE]..
//! prints the least time of the steps [s], without what it takes to make the scene.

use std::error::Error;
use std::path::Path;

use abrade_scene::{Precision, Progress, RunOptions};

/// Lets every run come to its end.
struct Silent;

impl Progress for Silent {
    fn advance(&mut self, _: f64, _: Option<f64>) -> bool {
        true
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let given: Vec<String> = std::env::args().skip(1).collect();
    let [folder, times, scene, sets @ ..] = &given[..] else {
        return Err("needs FOLDER TIMES SCENE [PATH=VALUE]..".into());
    };
    let checked = abrade_scene::load(Path::new(scene), sets)?;
    let options = RunOptions { folder: folder.into(), precision: Precision::Double };
    let mut least = f64::INFINITY;
    for _ in 0..times.parse()? {
        let outcome = abrade_scene::run(&checked, &options, &mut Silent)?;
        if let Some(failure) = outcome.failure {
            return Err(failure.into());
        }
        least = least.min(outcome.summary.wall - outcome.summary.setup);
    }
    println!("{least:e}");
    Ok(())
}
