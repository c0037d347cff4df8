//! Flow against one point of the material, whose flow rule is integrated with small steps.

use abrade_adhesive::{HardeningSlope, Solid};

use crate::lattice::{assert_near, led_stress, pressed};

fn flows(slope: HardeningSlope) -> Solid {
    Solid { shear_strength: 1e15, slope, ..Solid::default() }
}

/// Fails for a return without sigma_zz, or one that pairs do not follow.
#[test]
fn a_pressed_block_hardens_as_a_point_of_the_material() {
    for (slope, [syy, szz, strain, exx]) in [
        (HardeningSlope::Tangent, [-6.169e6, -2.487e6, 0.00496, 0.006537]),
        (HardeningSlope::Plastic, [-4.819e6, f64::NAN, 0.006372, 0.007241]),
    ] {
        let (stress, [xx, yy], plastic) = pressed(&flows(slope), -20.0, 0.01, 0.65);
        // The rows in between are as strained as the whole.
        assert_near(yy, -0.01, 0.01);
        assert_near(stress[1], syy, 0.02);
        if szz.is_finite() {
            assert_near(stress[3], szz, 0.02);
        }
        assert_near(plastic, strain, 0.02);
        assert_near(xx, exx, 0.02);
    }
}

/// Fails for an equivalent stress of another criterion than von Mises'.
#[test]
fn shear_flows_at_the_yield_stress_over_root_three() {
    let stress = led_stress(&flows(HardeningSlope::Tangent), [[0.0, 0.01], [0.01, 0.0]], 2000);
    assert_near(stress[2], 3.660e6, 0.01);
}
