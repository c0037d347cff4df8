//! Grains: forms of a size.

use std::f64::consts::PI;
use std::path::Path;

use abrade::{Piece, Polyhedron};
use abrade_scene::scene::{Form, Grain};
use abrade_scene::{GrainSize, MadeGrain};

fn made(form: Form, spheres: Option<u32>) -> MadeGrain {
    let grain = Grain { form, spheres };
    grain.make(GrainSize::Volume(2.0), 3.0, 5, Path::new("")).unwrap_or_else(|e| panic!("{e}"))
}

fn cube() -> Form {
    Form::Polyhedron { kind: Polyhedron::Cube }
}

fn forms() -> Vec<Form> {
    vec![
        Form::Sphere,
        cube(),
        Form::Superquadric { half_axes: [3.0, 2.0, 1.0], exponents: [2.0, 2.0], rings: 12 },
        Form::RoundedCube { radius: 0.2 },
        Form::TruncatedCube { cut: 0.3 },
        Form::Grit { points: 14, elongation: [1.0, 2.0], flatness: [1.0, 2.0] },
    ]
}

/// Fails for a grain whose mass is not that of its volume, or whose inertia is left in another size: a
/// grain twice as large has 32 times as much.
#[test]
fn grains_of_one_size_have_one_mass() {
    for form in forms() {
        for spheres in [None, Some(20)].into_iter().filter(|s| s.is_none() || form != Form::Sphere)
        {
            let grain = made(form.clone(), spheres);
            // The volume that a grain tells follows from the size that was asked for; that of its hull does not.
            if let [Piece::Hull(hull)] = grain.solid.shape.pieces() {
                assert!((hull.volume() / (4.0 * PI / 3.0) - 1.0).abs() < 1e-9, "{form:?}");
            }
            let inertia = grain.solid.inertia;
            assert!((inertia.mass / (3.0 * grain.volume) - 1.0).abs() < 1e-9, "{form:?}");
            let trace = inertia.tensor.trace();
            // No body of this mass has less than the sphere.
            assert!(trace > 3.0 * 0.4 * inertia.mass * (1.0 - 1e-3), "{form:?} {trace}");
            let of = Grain { form: form.clone(), spheres };
            let twice =
                of.make(GrainSize::Feret(2.0 * grain.feret), 3.0, 5, Path::new("")).expect("one");
            assert!((twice.solid.inertia.tensor.trace() / trace / 32.0 - 1.0).abs() < 1e-9);
            assert!((twice.feret / grain.feret - 2.0).abs() < 1e-9);
        }
    }
}

/// Fails for forms that are something else: the inertia of an ellipsoid and of a cube are known.
#[test]
fn forms_are_what_they_are_called() {
    let cube = made(cube(), None).solid.inertia;
    let edge = (4.0 * PI / 3.0).cbrt();
    assert!((cube.tensor[(0, 0)] / (cube.mass * edge * edge / 6.0) - 1.0).abs() < 1e-9);
    let form = |n| Form::Superquadric { half_axes: [3.0, 2.0, 1.0], exponents: [n, n], rings: 24 };
    let ratio = |n| {
        let tensor = made(form(n), None).solid.inertia.tensor;
        tensor[(0, 0)] / tensor[(2, 2)]
    };
    // (b^2 + c^2) / (a^2 + b^2) of an ellipsoid, and of a box.
    for n in [2.0, 80.0] {
        assert!((ratio(n) / (5.0 / 13.0) - 1.0).abs() < 0.02, "{n}: {}", ratio(n));
    }
    // A hull of 80 points of a sphere has 0.85 of its volume; a cube would be 2.79 long.
    let rounded = made(Form::RoundedCube { radius: 0.49 }, None).feret;
    assert!((rounded / 2.0 - 0.85f64.cbrt().recip()).abs() < 0.01, "nearly a sphere: {rounded}");
    let seeds = [1, 2].map(|seed| {
        let grain = Grain { form: forms()[5].clone(), spheres: None };
        grain.make(GrainSize::Volume(2.0), 3.0, seed, Path::new("")).expect("a grain").feret
    });
    assert_ne!(seeds[0], seeds[1]);
}

/// Fails for spheres that stand out of the form, or that do not come nearer to it as there are more.
#[test]
fn more_spheres_come_nearer_to_the_form() {
    let mut last = f64::INFINITY;
    for count in [1, 9, 27, 100, 400] {
        let clump = made(cube(), Some(count));
        let fit = clump.fit.expect("a fit");
        // Half the edge of the cube that the clump stands for, at the clump's size.
        let half = clump
            .solid
            .shape
            .pieces()
            .iter()
            .map(|piece| match piece {
                Piece::Ball(ball) => ball.centre.coords.amax() + ball.radius,
                Piece::Hull(_) => panic!("a clump has no hull"),
            })
            .fold(0.0, f64::max);
        let error = fit.error / half;
        println!(
            "{count} spheres: error {error:.4} of half the edge, tips {:.4}",
            fit.tip_radius / half
        );
        assert!(error < last, "{count}");
        last = error;
        assert!(clump.solid.shape.pieces().len() <= count as usize);
    }
    assert!(last < 0.07, "{last}");
}
