//! One collision of two asperities (Dimaki et al. 2020, Figs. 3-6): what became of them.
//!
//! cargo run --release -p abrade-adhesive --example collide -- 1.7 0.0 1.2
//! takes the ratio of strengths a, sigma_0 / sigma_j, and the gap at the start in diameters.

use abrade_adhesive::{AdhesiveError, Asperities, Collision, Solid};

fn main() -> Result<(), AdhesiveError> {
    let given: Vec<f64> = std::env::args().skip(1).filter_map(|text| text.parse().ok()).collect();
    let number = |at: usize, default: f64| given.get(at).copied().unwrap_or(default);
    let solid = Solid {
        strength_ratio: number(0, 1.0),
        adhesion: number(1, 0.4) * Solid::default().shear_strength,
        ..Solid::default()
    };
    let asperities = Asperities { gap: number(2, 1.2), ..Asperities::default() };
    let mut collision = Collision::new(&solid, &asperities)?;
    while collision.share() < 1.0 {
        collision.step()?;
    }
    let figures = collision.figures();
    println!("{}: {figures:?}", figures.mode().name());
    println!("mean load {:?} N/m, {:?}", collision.mean_load(), collision.simulation().ledger());
    Ok(())
}
