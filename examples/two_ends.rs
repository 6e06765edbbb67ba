//! A transition curve between two ends in the plane, of three families: `cargo run --release --example two_ends`.

use spiral_atlas::Result;
use spiral_atlas::transition::{Ends, InvoluteBetween, Piece, ph_spiral, spiral, stations};

fn main() -> Result<()> {
    let ends = Ends {
        start: [0.0, 0.0],
        end: [200.0, 0.0],
        start_direction: -40f64.to_radians(),
        end_direction: 80f64.to_radians(),
        start_curvature: 0.004,
        end_curvature: 0.04,
    };
    // Each answer is the curve or, in words, why there is none.
    println!("{}\n\n{}\n", spiral(&ends)?, ph_spiral(&ends)?);

    // The involute's image exists wherever a spiral of any kind does. Here are points on it, at equal lengths.
    let curve = Piece::Involute(InvoluteBetween::new(&ends, [0, 0])?);
    for station in stations(&[curve], 5)? {
        println!("{station:?}");
    }

    let flat = Ends { end_curvature: 0.01, ..ends };
    println!("\n{}", spiral(&flat)?);
    Ok(())
}
