//! A soft material in units of its hardness, which several tests share.

use abrade::Material;

pub fn soft() -> Material {
    Material { hardness: 1.0, shear_ratio: 0.25, young: Some(100.0), poisson: 0.3, friction: 0.3 }
}
