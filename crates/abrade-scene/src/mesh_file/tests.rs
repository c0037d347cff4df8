//! Files from bytes: formats, shared corners, damage.

use proptest::prelude::*;

use super::*;

const CORNER: &str = "solid corner\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n\
    vertex 1 0 0\nvertex -0.0 1 0\nendloop\nendfacet\nfacet normal 0 0 1\nouter loop\n\
    vertex 0 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\nendsolid corner\n";

const QUAD: &str = "mtllib none.mtl\no a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\n\
    f 1//1 2//1 3//1 4//1\no b\nv 0.5 0.5 1\nusemtl red\nf -1 2/3 1\n";

/// The two facets of [`CORNER`] as a binary file whose head begins with `head`.
fn binary(head: &[u8]) -> Vec<u8> {
    let mut bytes = head.to_vec();
    bytes.resize(80, 0);
    bytes.extend(2_u32.to_le_bytes());
    let facets: [[f32; 12]; 2] = [
        [0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1., 0.],
        [0., 0., 1., 0., 0., 0., 0., 1., 0., 0., 0., 1.],
    ];
    for facet in facets {
        bytes.extend(facet.into_iter().flat_map(f32::to_le_bytes));
        bytes.extend([0, 0]);
    }
    bytes
}

/// Fails for a reader that takes a binary file for a text because of its first word, or that keeps
/// a corner once per facet.
#[test]
fn text_and_binary_stl_are_the_same_mesh() {
    let text = stl(CORNER.into(), 2.0).expect("a text");
    assert_eq!(text.triangles, [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(text.vertices[1], Point3::new(2.0, 0.0, 0.0));
    for head in [&b"solid made by a program"[..], b"binary"] {
        assert_eq!(stl(binary(head), 2.0).as_ref(), Ok(&text));
    }
}

/// Fails for a reader of triangles alone, without relative indices, or of the first object alone.
#[test]
fn obj_polygons_and_objects_are_one_mesh() {
    let mesh = obj(QUAD.as_bytes(), 1e-3).expect("an OBJ file");
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3], [4, 1, 0]]);
    assert_eq!(mesh.vertices[4], Point3::new(0.5e-3, 0.5e-3, 1e-3));
}

#[test]
fn what_is_no_mesh_file_says_so() {
    let short = &binary(b"x")[..150];
    for bytes in [b"# no mesh\n".to_vec(), Vec::new(), short.to_vec()] {
        let reason = stl(bytes, 1.0).expect_err("not an STL file");
        assert_eq!(reason, "it is neither a text nor a binary STL file");
    }
    assert!(obj(b"v 1 2\n", 1.0).is_err());
    assert!(obj(b"v 0 0 0\nf 1 2 3\n", 1.0).is_err());
}

proptest! {
    #[test]
    fn no_stl_text_makes_it_panic(at in 0..CORNER.len(), glyphs in r"[0-9a-z. \n+-]{0,9}", cut in 0usize..30) {
        let mut text = CORNER.to_owned();
        text.replace_range(at..(at + cut).min(CORNER.len()), &glyphs);
        let _ = stl(text.into(), 1e300);
    }

    #[test]
    fn no_obj_text_makes_it_panic(at in 0..QUAD.len(), glyphs in r"[0-9a-z./ \n+-]{0,9}", cut in 0usize..30) {
        let mut text = QUAD.to_owned();
        text.replace_range(at..(at + cut).min(QUAD.len()), &glyphs);
        let _ = obj(text.as_bytes(), 1e300);
    }

    #[test]
    fn no_bytes_make_it_panic(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        let _ = (stl(bytes.clone(), 1.0), obj(&bytes, 1.0));
    }
}
