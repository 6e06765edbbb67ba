//! A path around a wall with proved clearance and curvature: `cargo run --release --example drive`.

use spiral_atlas::Result;
use spiral_atlas::path::{Course, Scene, plan};
use spiral_atlas::transition::Piece;

fn main() -> Result<()> {
    let wall = vec![[4.0, -9.0], [5.0, -9.0], [5.0, 2.0], [4.0, 2.0]];
    let scene =
        Scene { start: [0.0, 0.0], goal: [10.0, 0.0], obstacles: vec![wall], clearance: 0.5, greatest_curvature: 1.0 };
    let path = plan(&scene)?;
    println!("{:?}", path.proof);

    let course = Course::new(path.spans.into_iter().map(Piece::PhQuintic).collect())?;
    println!("length {}, greatest curvature {}", course.length(), course.greatest_curvature());
    for station in course.stations(11)? {
        println!("{station:?}");
    }
    Ok(())
}
