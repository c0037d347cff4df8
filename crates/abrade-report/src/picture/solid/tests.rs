//! Pictures of solids, read back.

use abrade::{Material, Surface, SurfaceLaws, TriangleMesh};
use nalgebra::{Point3, Vector3};

use super::*;

/// The surface of a solid that nothing has worn.
pub(crate) fn surface(mesh: &TriangleMesh) -> Surface {
    let material = Material {
        hardness: 1e9,
        shear_ratio: 0.25,
        young: Some(1e11),
        poisson: 0.3,
        friction: 0.3,
    };
    Surface::mesh(mesh, SurfaceLaws::of(material)).expect("a surface")
}

/// Width and pixels of the picture of `mesh`, worn by `depth`.
fn picture(mesh: &TriangleMesh, depth: impl Fn(&Point3<f64>) -> f64) -> (usize, Vec<u8>) {
    let surface = surface(mesh);
    let mut nodes = surface.nodes().clone();
    nodes.depth = nodes.rest_position.iter().map(depth).collect();
    let triangles = surface.triangles();
    let (title, wear_volume) = ("a test", nodes.wear_volume());
    let (nodes, triangles) = (&nodes, &triangles[..]);
    let png = SolidPicture { title, nodes, wear_volume, triangles, marks: &[] };
    let png = png.to_png().expect("drawable");
    let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().expect("a PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    let info = reader.next_frame(&mut pixels).expect("an image");
    (info.width as usize, pixels)
}

/// Pixels of the panels that are coloured: far from grey.
fn coloured(width: usize, pixels: &[u8], columns: std::ops::Range<usize>) -> usize {
    let rows = HEIGHT.0 as usize..HEIGHT.1 as usize;
    let places = rows.flat_map(|row| columns.clone().map(move |column| 3 * (row * width + column)));
    let colour = |&i: &usize| {
        let rgb = &pixels[i..i + 3];
        let (low, high) = (rgb.iter().min(), rgb.iter().max());
        high.zip(low).is_some_and(|(high, low)| high - low > 40)
    };
    places.filter(colour).count()
}

/// Fails for a picture from the far side, for one that lets hidden facets through, and for colours
/// that are lost in the shade.
#[test]
fn the_worn_side_of_a_sphere_is_shown_twice() {
    let sphere = TriangleMesh::sphere(0.02, 0.0008).expect("a sphere");
    let pole = Vector3::new(0.0, 0.6, -0.8) * 0.02;
    let (width, pixels) = picture(&sphere, |p| (1e-4 - 0.02 * (p.coords - pole).norm()).max(0.0));
    let middle = (SIDES.0 + HEIGHT.1 - HEIGHT.0 + GAP / 2.0) as usize;
    let left = coloured(width, &pixels, SIDES.0 as usize..middle);
    let right = coloured(width, &pixels, middle..SIDES.1 as usize);
    // A disc of radius 5 mm on a ball of 20 mm, seen at 29 degrees: 1/16 of 250^2 pi, 0.87 of it.
    let expected = 0.25 * 0.25 * 0.87 * std::f64::consts::PI * 250.0 * 250.0;
    assert!((left as f64 / expected - 1.0).abs() < 0.25, "{left} of {expected}");
    assert!(right > 3 * left, "{left} {right}");
}

/// Fails for a colour scale that begins with zero over zero, or a window around nothing.
#[test]
fn a_solid_without_wear_is_grey() {
    let cube = TriangleMesh::cuboid(Vector3::repeat(0.01), 0.002).expect("a cube");
    let (width, pixels) = picture(&cube, |_| 0.0);
    assert_eq!(coloured(width, &pixels, SIDES.0 as usize..SIDES.1 as usize), 0);
    let dark = pixels.chunks_exact(3).filter(|rgb| rgb[0] < 250).count();
    assert!(dark > 100_000, "{dark}");
    let nodes = &Nodes::default();
    let none = SolidPicture { title: "", nodes, wear_volume: 0.0, triangles: &[], marks: &[] };
    assert!(none.to_png().is_ok());
}

/// Fails for a pipe seen from outside, where its bore is hidden.
#[test]
fn the_worn_bore_of_a_pipe_is_seen() {
    let tube = TriangleMesh::tube(0.02, 0.025, 0.06, 0.001).expect("a tube");
    let worn = |p: &Point3<f64>| (1e-5 - 2e-3 * (p - Point3::new(0.0, 0.02, 0.0)).norm()).max(0.0);
    let (width, pixels) = picture(&tube, worn);
    assert!(coloured(width, &pixels, SIDES.0 as usize..SIDES.1 as usize) > 20_000);
}
