//! Constructed solids against closed forms.

use std::f64::consts::PI;

use abrade::{MeshError, TriangleMesh};
use nalgebra::{Isometry3, Point3, Vector3};

type Build = fn(f64) -> Result<TriangleMesh, MeshError>;

/// Fails for nodes off the surface, a gap or a fold between rings, or a profile cut short: the
/// error of an inscribed surface falls with the square of the pitch. Both circles of a tube lack
/// the same area at the same pitch to that order, so its volume gains two orders.
#[test]
fn volumes_and_areas_converge_with_the_square_of_the_pitch() {
    let solids: [(&str, Build, f64, f64, f64); 4] = [
        ("sphere", |h| TriangleMesh::sphere(0.5, h), PI / 6.0, PI, 2.0),
        ("cylinder", |h| TriangleMesh::cylinder(0.5, 1.5, h), 0.375 * PI, 2.0 * PI, 2.0),
        ("tube", |h| TriangleMesh::tube(0.5, 1.0, 1.5, h), 1.125 * PI, 6.0 * PI, 4.0),
        ("capsule", |h| TriangleMesh::capsule(0.5, 1.5, h), PI / 6.0 + 0.375 * PI, 2.5 * PI, 2.0),
    ];
    for (name, build, volume, area, order) in solids {
        // A whole number of nodes around, doubled.
        let of = |around: f64| build(PI / around).expect(name);
        let [coarse, fine] = [of(24.0), of(96.0)];
        for (what, exact, order, values) in [
            ("volume", volume, order, [coarse.volume(), fine.volume()]),
            ("area", area, 2.0, [coarse.area(), fine.area()]),
        ] {
            let [e, f] = values.map(|value| 1.0 - value / exact);
            let slope = (e / f).log2() / 2.0;
            assert!((slope - order).abs() < 0.1, "{name} {what}: {e:e} {f:e} slope {slope}");
        }
    }
}

/// Fails for vertices placed by chords, by a mesh of single precision, or beside the mirror.
#[test]
fn nodes_lie_on_the_true_surface_and_mirror_in_z() {
    let sphere = TriangleMesh::sphere(0.3, 0.02).expect("a sphere");
    assert!(sphere.vertices().iter().all(|p| (p.coords.norm() - 0.3).abs() < 1e-16));
    let tube = TriangleMesh::tube(0.2, 0.3, 0.1, 0.02).expect("a tube");
    for p in tube.vertices() {
        let r = p.x.hypot(p.y);
        let on = (r - 0.2).abs() < 1e-16 || (r - 0.3).abs() < 1e-16 || p.z.abs() == 0.05;
        assert!(on, "{p}");
    }
    for mesh in [sphere, tube] {
        let mut keys: Vec<[u64; 3]> = mesh.vertices().iter().map(key).collect();
        let mut mirrored: Vec<[u64; 3]> =
            mesh.vertices().iter().map(|p| key(&Point3::new(p.x, p.y, -p.z))).collect();
        keys.sort();
        mirrored.sort();
        assert_eq!(keys, mirrored);
    }
}

/// The bits of a point; both zeros alike.
fn key(p: &Point3<f64>) -> [u64; 3] {
    [p.x, p.y, p.z].map(|x| (x + 0.0).to_bits())
}

/// Fails for rings of a fixed count, and for a pitch taken along the meridian.
#[test]
fn nodes_are_a_pitch_apart() {
    let pitch = 0.02;
    for (name, mesh) in [
        ("sphere", TriangleMesh::sphere(0.3, pitch)),
        ("cylinder", TriangleMesh::cylinder(0.3, 0.5, pitch)),
        ("tube", TriangleMesh::tube(0.3, 0.4, 0.5, pitch)),
        ("capsule", TriangleMesh::capsule(0.3, 0.5, pitch)),
    ] {
        let mesh = mesh.expect(name);
        assert!((mesh.pitch() / pitch - 1.0).abs() < 0.05, "{name} {}", mesh.pitch());
        let longest = mesh.triangles().iter().flat_map(|t| {
            let [a, b, c] = t.map(|i| mesh.vertices()[i as usize]);
            [(b - a).norm(), (c - b).norm(), (a - c).norm()]
        });
        let longest = longest.fold(0.0, f64::max);
        assert!(longest < 1.6 * pitch, "{name} {longest}");
    }
}

/// Fails for faces that do not share their edges, or a spacing that does not divide them.
#[test]
fn a_cuboid_is_exact_and_its_faces_are_grids() {
    let half = Vector3::new(0.3, 0.2, 0.05);
    let mesh = TriangleMesh::cuboid(half, 0.07).expect("a cuboid");
    // 8.6, 5.7 and 1.4 spacings: 9, 6 and 1.
    assert_eq!(mesh.vertices().len(), 2 * (9 * 6 + 6 + 9) + 2);
    assert_eq!(mesh.triangles().len(), 4 * (9 * 6 + 6 + 9));
    assert!((mesh.volume() / 0.024 - 1.0).abs() < 1e-14);
    assert!((mesh.area() / 0.68 - 1.0).abs() < 1e-14);
    assert_eq!(mesh.bounds(), [Point3::from(-half), Point3::from(half)]);
}

/// Fails for walls or a bottom that leave a gap, and for rows taken for columns.
#[test]
fn a_height_field_is_closed_above_its_base() {
    let height = |i: usize, j: usize| 0.3 + 0.1 * ((3 * i + 5 * j) % 4) as f64;
    let heights: Vec<Vec<f64>> = (0..5).map(|j| (0..7).map(|i| height(i, j)).collect()).collect();
    let mesh = TriangleMesh::height_field(&heights, 0.5, 0.25, -0.1).expect("ground");
    assert_eq!(mesh.vertices().len(), 35 + 20 + 1);
    let cell = |i: usize, j: usize| {
        let [a, b, c, d] = [height(i, j), height(i + 1, j), height(i + 1, j + 1), height(i, j + 1)];
        0.125 * ((a + b + c) / 6.0 + (a + c + d) / 6.0 + 0.1)
    };
    let volume: f64 = (0..24).map(|k| cell(k % 6, k / 6)).sum();
    assert!((mesh.volume() / volume - 1.0).abs() < 1e-13);
    let [low, high] = mesh.bounds();
    assert_eq!((low, high), (Point3::new(0.0, 0.0, -0.1), Point3::new(3.0, 1.0, 0.3 + 0.1 * 3.0)));
    let refused = |change: fn(&mut Vec<Vec<f64>>)| {
        let mut heights = heights.clone();
        change(&mut heights);
        let mesh = TriangleMesh::height_field(&heights, 0.5, 0.25, -0.1);
        mesh.expect_err("faulty").to_string()
    };
    assert_eq!(
        refused(|h| h[3].truncate(6)),
        "row 3 of the heights has 6 values: rows must be alike, two by two or more"
    );
    assert_eq!(
        refused(|h| h[2][4] = -0.1),
        "height 4 of row 2 is -0.1 m, it must be finite and above -0.1 m"
    );
}

/// Fails for a bound that is looked at after the vertices are there.
#[test]
fn too_many_vertices_are_refused_before_memory_is_used() {
    let builds = [
        TriangleMesh::sphere(1e6, 1e-9),
        TriangleMesh::cylinder(1e6, 1e6, 1e-9),
        TriangleMesh::tube(1e6, 2e6, 1e300, 1e-300),
        TriangleMesh::capsule(1e-3, 1e9, 1e-9),
        TriangleMesh::cuboid(Vector3::repeat(1e6), 1e-9),
        TriangleMesh::cuboid(Vector3::new(1e300, 1e300, 1e300), 1e-300),
    ];
    for build in builds {
        assert!(matches!(build, Err(MeshError::TooMany { what: "vertices", .. })), "{build:?}");
    }
}

/// Fails for parameters that are not looked at.
#[test]
fn parameters_out_of_range_are_named() {
    let message = |mesh: Result<TriangleMesh, MeshError>| mesh.expect_err("refused").to_string();
    assert_eq!(
        message(TriangleMesh::sphere(f64::NAN, 1.0)),
        "`radius` is NaN, it must be finite and above zero"
    );
    assert_eq!(
        message(TriangleMesh::cuboid(Vector3::new(1.0, 0.0, 1.0), 1.0)),
        "`half_extents` is 0, it must be finite and above zero"
    );
    assert_eq!(
        message(TriangleMesh::tube(2.0, 1.0, 1.0, 0.1)),
        "`inner` is 2, it must be below `outer`, which is 1"
    );
    assert_eq!(
        message(TriangleMesh::sphere(0.5, 0.5)),
        "a pitch of 0.5 m gives 6 nodes around the `radius` of 0.5 m, at least 8 are needed: a \
         pitch of 3.927e-1 m would do"
    );
    assert!(TriangleMesh::sphere(0.5, 0.392).is_ok());
    // Chords of the outer circle would cut through the bore.
    assert!(matches!(TriangleMesh::tube(0.97, 1.0, 1.0, 0.7), Err(MeshError::Crossing { .. })));
}

/// Fails for volumes summed about the origin: far away they lose their digits.
#[test]
fn a_mesh_far_from_the_origin_keeps_its_volume() {
    let mesh = TriangleMesh::cuboid(Vector3::repeat(0.5), 0.25).expect("a cube");
    let far = mesh.moved(&Isometry3::translation(1e6, -2e6, 3e6));
    assert_eq!(far.bounds()[0], Point3::new(1e6 - 0.5, -2e6 - 0.5, 3e6 - 0.5));
    assert!((far.volume() - 1.0).abs() < 1e-14);
    let far = TriangleMesh::new(far.vertices().to_vec(), far.triangles().to_vec());
    assert!(far.is_ok(), "{far:?}");
    let turned = mesh.moved(&Isometry3::rotation(Vector3::new(0.3, 0.2, 0.1)));
    assert!((turned.volume() - 1.0).abs() < 1e-14);
    let turned = TriangleMesh::new(turned.vertices().to_vec(), turned.triangles().to_vec());
    assert!(turned.is_ok(), "{turned:?}");
}
