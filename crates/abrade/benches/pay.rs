//! One impact with one optional part of the core, for a count of instructions: `pay.sh` runs it
//! under valgrind for every part and prints the table.
//!
//! `cargo bench -p abrade --bench pay -- SHAPE PART` prints the node evaluations of the impact;
//! without them, the shapes and the parts.

#[path = "impacts/cases.rs"]
#[expect(dead_code, reason = "two of the impacts of the other benches")]
mod cases;

use abrade::{
    Carrier, ElasticLaw, Encounter, FlowLaw, Instant, Lateral, Loads, Observer, Placed, State,
    Until,
};
use nalgebra::{Isometry3, Point3};

use cases::{Case, dodecahedron, foundation, paper, projected, unit};

const SHAPES: [&str; 2] = ["ball", "hull"];
/// The first leaves everything out.
const PARTS: [&str; 10] = [
    "nothing",
    "ledger",
    "friction",
    "lateral",
    "eq5",
    "restitution",
    "hardness",
    "observer",
    "watch",
    "carrier",
];

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| word != "--bench").collect();
    match words.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [shape, part] if SHAPES.contains(&shape) && PARTS.contains(&part) => run(shape, part),
        _ => println!("shapes: {}\nparts: {}", SHAPES.join(" "), PARTS.join(" ")),
    }
}

/// A frictionless impact without any of the parts.
fn plain(shape: &str) -> Case {
    let pressure = FlowLaw::NormalPressure {};
    let mut case = match shape {
        "ball" => paper(shape, foundation(), pressure, 45.0, Some(0.15e-3)),
        _ => {
            let (shape, inertia) = dodecahedron();
            let springs = ElasticLaw::Foundation { stiffness: Some(1e3) };
            unit("hull", shape, inertia, springs, 0.05)
        }
    };
    case.laws.material.friction = 0.0;
    case
}

fn run(shape: &str, part: &str) {
    let mut case = plain(shape);
    match part {
        "ledger" => case.settings.ledger = true,
        "friction" => case.laws.material.friction = 0.3,
        "lateral" => case.laws.flow = projected(),
        "eq5" => case.laws.flow = FlowLaw::CapozzaHanley { lateral: Lateral::Eq5 },
        "restitution" => case.laws.restitution = 0.8,
        _ => {}
    }
    let mut surface = case.plate();
    if part == "hardness" {
        surface.set_hardness_factors(vec![1.0; surface.nodes().len()]).expect("one per node");
    }
    if part == "watch" {
        surface.watch();
    }
    let mut body = case.body.clone();
    let Ok(mut encounter) = Encounter::new(&body, [&surface], case.settings) else {
        return println!("0");
    };
    let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
    if part == "carrier" {
        let state = State::at(Point3::origin());
        placed[0].carrier = Some(Carrier { state, inertia: None, loads: Loads::default() });
    }
    let mut height = Height(0.0);
    let observer: &mut dyn Observer = if part == "observer" { &mut height } else { &mut () };
    let until = Until::FirstExit;
    let done = encounter
        .advance(&mut body, &mut placed, &Loads::default(), 1e9, until, observer)
        .expect("an impact");
    println!("{}", done.node_evaluations);
}

/// Sum of the heights at which the body was seen [m].
struct Height(f64);

impl Observer for Height {
    fn observe(&mut self, instant: &Instant<'_, '_>) {
        self.0 += instant.state.position.z;
    }
}
