//! Whole pictures, read back.

use nalgebra::Vector3;

use super::*;

/// A square grid of 41 by 41 nodes, 0.1 mm apart about the origin.
fn plate(depth: impl Fn(f64, f64) -> f64) -> Nodes {
    let mut nodes = Nodes::default();
    for i in 0..41 * 41 {
        let (x, y) = (f64::from(i % 41 - 20) * 1e-4, f64::from(i / 41 - 20) * 1e-4);
        nodes.rest_position.push(Point3::new(x, y, 0.0));
        nodes.normal.push(Vector3::z());
        nodes.rest_area.push(1e-8);
        nodes.depth.push(depth(x, y));
    }
    nodes
}

struct Image {
    width: usize,
    pixels: Vec<u8>,
}

impl Image {
    fn of(nodes: &Nodes) -> Self {
        let picture = Picture {
            title: "a test & a <name>",
            nodes,
            wear_volume: nodes.wear_volume(),
            marks: &[],
        };
        let png = picture.to_png().expect("drawable");
        let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().expect("a PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
        let info = reader.next_frame(&mut pixels).expect("an image");
        Self { width: info.width as usize, pixels }
    }

    fn at(&self, x: f64, y: f64) -> colour::Rgb {
        let i = 3 * (y as usize * self.width + x as usize);
        [self.pixels[i], self.pixels[i + 1], self.pixels[i + 2]]
    }

    /// Pixels of this colour.
    fn count(&self, colour: colour::Rgb) -> usize {
        self.pixels.chunks_exact(3).filter(|pixel| **pixel == colour).count()
    }
}

/// A program that turned the plan upside down, mirrored it, or lost the colours would fail: the
/// worn half is the one at larger y and the deep end the one at larger x.
#[test]
fn the_plan_lies_as_its_axes_say() {
    let nodes = plate(|x, y| if y > 0.0 { 1e-5 * (x + 2.1e-3) } else { 0.0 });
    let image = Image::of(&nodes);
    let middle = (SIDES.0 + SIDES.1) / 2.0;
    let upper = PLAN_TOP + 100.0;
    let [left, right] = [image.at(middle - 100.0, upper), image.at(middle + 100.0, upper)];
    let light = |rgb: colour::Rgb| rgb.iter().map(|v| u32::from(*v)).sum::<u32>();
    assert!(light(left) > light(right) + 30, "{left:?} {right:?}");
    assert_eq!(image.at(middle, PLAN_TOP + 620.0), colour::UNTOUCHED);
}

/// A program that divided by the largest depth or by an empty region's size would fail, hang or
/// paint the plate in the colour of its own maximum.
#[test]
fn a_plate_without_wear_is_grey_and_says_so() {
    let image = Image::of(&plate(|_, _| 0.0));
    assert!(image.count(colour::UNTOUCHED) > 200_000);
    assert_eq!(image.count(colour::of_share(1.0)), 0);
    assert!(image.count(colour::SOFT) > 100, "the words \"no wear\"");
}

/// A program that made the window from the worn node alone would have no size to draw at.
#[test]
fn one_worn_node_and_no_node_at_all_are_drawn() {
    let image = Image::of(&plate(|x, y| if x == 0.0 && y == 0.0 { 1e-9 } else { 0.0 }));
    // The pixel beside the very middle is 98 % deep.
    let middle = image.at((SIDES.0 + SIDES.1) / 2.0, PLAN_TOP + 360.0);
    let near = (0..3).all(|i| middle[i].abs_diff(colour::of_share(1.0)[i]) < 8);
    assert!(near, "{middle:?}");
    let lone = Nodes {
        rest_position: vec![Point3::origin()],
        normal: vec![Vector3::z()],
        rest_area: vec![1e-8],
        depth: vec![1e-6],
    };
    assert!(Image::of(&lone).count(colour::of_share(1.0)) > 0);
    assert_eq!(Image::of(&Nodes::default()).width, WIDTH);
}

/// A program that let a long title run would cut it at the picture's edge in silence.
#[test]
fn a_long_title_ends_in_dots() {
    let canvas = Canvas::new(10, 10).expect("fonts");
    let line = canvas.fitted(&"long ".repeat(100), Text::default(), 300.0);
    assert!(line.ends_with('…') && line.len() < 60, "{line}");
    assert_eq!(canvas.fitted("short", Text::default(), 300.0), "short");
}
