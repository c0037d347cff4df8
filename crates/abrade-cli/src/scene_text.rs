//! What a scene holds and how large it is: in rows, or in a line.

use abrade::{ElasticLaw, FlowLaw, Lateral, Removal};
use abrade_report::quantity_text::{count, digits, length, memory, time};
use abrade_scene::scene::{
    Motion, Rotation, SceneBody, SceneShape, SceneSurface, Stop, SurfaceMotion,
};
use abrade_scene::{Checked, Solid, SurfaceSize};

/// What stands in a row per surface, body and stream.
pub(crate) fn rows(checked: &Checked) -> String {
    let (scene, size) = (&checked.scene, checked.size());
    let mut rows = vec![row("scene", scene.name.clone())];
    let is_copy = |name: &String| checked.copied.values().any(|names| names.contains(name));
    for (name, surface) in scene.surfaces.iter().filter(|(name, _)| !is_copy(name)) {
        if let Some(size) = size.surfaces.get(name) {
            rows.push(row(
                "surface",
                format!("{name}: {}", surface_text(surface, size, checked.stiffness(name))),
            ));
        }
    }
    for (name, names) in &checked.copied {
        let Some(first) = names.first() else { continue };
        if let Some((surface, size)) = scene.surfaces.get(first).zip(size.surfaces.get(first)) {
            let each = surface_text(surface, size, checked.stiffness(first));
            rows.push(row(
                "surface",
                format!("{name}: {}, each {each}", count(names.len(), "copy", "copies")),
            ));
        }
    }
    let of_stream = |name: &String| checked.is_streamed(name);
    for (name, body) in scene.bodies.iter().filter(|(name, _)| !of_stream(name)) {
        if let Some(solid) = checked.solids.get(name) {
            rows.push(row("body", format!("{name}: {}", body_text(body, solid))));
        }
    }
    for (name, stream) in &scene.streams {
        let first = checked.streamed.get(name).and_then(|names| names.first());
        let first = first.and_then(|first| scene.bodies.get(first).zip(checked.solids.get(first)));
        if let Some((body, solid)) = first {
            let names = checked.streamed.get(name);
            let last = names.and_then(|names| checked.due.get(names.last()?)).copied();
            let (count, last) = (stream.count, time(last.unwrap_or(0.0)));
            let first = body_text(body, solid);
            rows.push(row(
                "stream",
                format!("{name}: {count} within {last}, the first one {first}"),
            ));
        }
    }
    let run = &scene.run;
    let stop = stop_text(&run.stop);
    let accuracy = digits(run.accuracy);
    rows.push(row("run", format!("until {stop}, {:?}, accuracy {accuracy}", run.resolve)));
    rows.push(row("memory", format!("{} for the nodes", memory(size.memory))));
    rows.push(row("time", duration(size.seconds).to_owned()));
    rows.extend(checked.notes.iter().map(|note| row("note", note.clone())));
    rows.concat()
}

/// The whole of it in a line.
pub(crate) fn line(checked: &Checked) -> String {
    let (scene, size) = (&checked.scene, checked.size());
    let nodes: f64 = size.surfaces.values().map(|surface| surface.nodes).sum();
    let mut parts = vec![
        count(scene.surfaces.len(), "surface", "surfaces"),
        count(nodes, "node", "nodes"),
        count(scene.bodies.len(), "body", "bodies"),
        duration(size.seconds).to_owned(),
    ];
    if !checked.notes.is_empty() {
        parts.push(count(checked.notes.len(), "note", "notes"));
    }
    format!("scene, {}", parts.join(", "))
}

/// What a row tells, below its name.
pub(crate) fn row(name: &str, text: String) -> String {
    format!("{name:<8} {text}\n")
}

fn surface_text(surface: &SceneSurface, size: &SurfaceSize, k_w: Option<[f64; 2]>) -> String {
    let flow = match surface.flow {
        FlowLaw::CapozzaHanley { lateral: Lateral::Projected } => "CapozzaHanley(Projected)",
        FlowLaw::CapozzaHanley { lateral: Lateral::Eq5 } => "CapozzaHanley(Eq5)",
        FlowLaw::NormalPressure {} => "NormalPressure",
    };
    let elastic = match surface.elastic {
        ElasticLaw::Foundation { .. } => format!("Foundation{}", stiffness_text(k_w)),
        ElasticLaw::HertzNodes { convention, .. } => format!("HertzNodes({convention:?})"),
        ElasticLaw::Rigid => "Rigid".to_owned(),
    };
    let removal = match surface.removal {
        Removal::All => "all displaced is debris",
        Removal::Fraction { .. } => "a fraction is debris",
        Removal::AttackAngle { .. } => "debris by attack angle",
    };
    let layout = match size.columns_rows {
        Some([columns, rows]) => format!("{columns} x {rows}, {} apart", length(size.pitch)),
        None => format!("closed, about {} apart", length(size.pitch)),
    };
    let motion = match &surface.motion {
        SurfaceMotion::Fixed => String::new(),
        SurfaceMotion::Kinematic { velocity, spin } => {
            let (speed, spin) = (digits(norm(velocity)), digits(norm(spin)));
            format!("; led at {speed} m/s and {spin} rad/s")
        }
        SurfaceMotion::Reciprocating { amplitude, frequency, .. } => {
            let (stroke, frequency) = (length(2.0 * norm(amplitude)), digits(*frequency));
            format!("; led to and fro over {stroke} at {frequency} Hz")
        }
        SurfaceMotion::Rocking { angle, frequency, .. } => {
            let (angle, frequency) = (digits(2.0 * angle.abs().to_degrees()), digits(*frequency));
            format!("; led to and fro through {angle} deg at {frequency} Hz")
        }
        SurfaceMotion::Path { points, file, repeat, .. } => {
            let again = if *repeat { ", again and again" } else { "" };
            let through = match file {
                Some(file) => format!("the points of `{file}`"),
                None => count(points.len(), "point", "points"),
            };
            format!("; led through {through}{again}")
        }
        SurfaceMotion::Free { density, velocity, .. } => {
            format!("; free at {} m/s, {} kg/m3", digits(norm(velocity)), digits(*density))
        }
    };
    let (nodes, material) = (size.nodes, &surface.material);
    let nodes = count(nodes, "node", "nodes");
    format!("{nodes} ({layout}); {flow}, {elastic}, {removal}; {material}{motion}")
}

/// What bodies find on a surface of `Foundation`, from the softest to the stiffest.
fn stiffness_text(k_w: Option<[f64; 2]>) -> String {
    let Some(range) = k_w else { return String::new() };
    match range.map(digits) {
        [least, largest] if least == largest => format!(" of k_w {least} Pa/m"),
        [least, largest] => format!(" of k_w {least} to {largest} Pa/m"),
    }
}

/// About how long a run takes that was estimated at `seconds` [s]: no more than an order of
/// magnitude is known.
fn duration(seconds: f64) -> &'static str {
    match seconds {
        s if s < 0.3 => "a second or less",
        s if s < 20.0 => "seconds",
        s if s < 1200.0 => "minutes",
        _ => "an hour or longer",
    }
}

fn norm(v: &[f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn body_text(body: &SceneBody, solid: &Solid) -> String {
    let shape = match &body.shape {
        SceneShape::Ball { .. } => "ball".to_owned(),
        SceneShape::Cuboid { .. } => "cuboid".to_owned(),
        SceneShape::Polyhedron { kind, .. } => format!("{kind:?}").to_lowercase(),
        SceneShape::ConvexHull { .. } => "convex hull".to_owned(),
        SceneShape::Grain { spheres: None, .. } => "grain".to_owned(),
        SceneShape::Grain { .. } => format!("grain of {}", spheres(solid)),
        SceneShape::Clump { .. } => format!("clump of {}", spheres(solid)),
    };
    let reach = length(solid.shape.bounding_radius());
    let turned = match body.rotation {
        Rotation::Random { seed } => format!(", turned at random (seed {seed})"),
        _ => String::new(),
    };
    let motion = match &body.motion {
        Motion::Impact { speed, angle, .. } => {
            format!("impact at {} m/s, {} deg", digits(*speed), digits(angle.to_degrees()))
        }
        Motion::Fixed => return format!("{shape}, reach {reach}{turned}; fixed"),
        Motion::Free { velocity, .. } => format!("free at {} m/s", digits(norm(velocity))),
        Motion::Drive { indent_to, distance, .. } => {
            format!("driven to {} N over {}", digits(*indent_to), length(*distance))
        }
    };
    let mass = digits(solid.inertia.mass);
    format!("{shape}, {mass} kg, reach {reach}{turned}; {motion}")
}

fn spheres(solid: &Solid) -> String {
    count(solid.shape.pieces().len(), "sphere", "spheres")
}

fn stop_text(stop: &Stop) -> String {
    match stop {
        Stop::AllRebounded => "every body has left or rests, or has slid its distance".into(),
        Stop::FirstExit => "the first exit".into(),
        Stop::Time { limit } => time(*limit),
        Stop::Distance => "the distance is slid".into(),
        Stop::Impacts { count: impacts } => count(*impacts, "impact", "impacts"),
    }
}
