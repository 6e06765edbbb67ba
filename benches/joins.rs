//! Joins of 10,000 random pairs of states within ten least radii: each pair with its length and time as a row of CSV,
//! and a summary on standard error. The argument is the family, cubic unless given.
//!
//!     cargo bench --bench joins -- clothoid > joins.csv
//!
//! `peers/cc_dubins.cpp` reads the rows and compares.

mod random;

use random::Random;
use serde_json::from_value;
use spiral_atlas::transition::join::{Family, Request, State, join};
use std::f64::consts::PI;
use std::time::Instant;

const PAIRS: usize = 10_000;

fn state(random: &mut Random) -> State {
    let mut between = |low: f64, high: f64| low + (high - low) * random.unit();
    let point = [0, 1].map(|_| between(-5.0, 5.0));
    State { point, direction: between(-PI, PI), curvature: between(-1.0, 1.0) }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Cargo adds `--bench`.
    let name = std::env::args().skip(1).find(|a| !a.starts_with("--")).unwrap_or_else(|| "cubic".into());
    let family: Family = from_value(name.clone().into())?;
    println!("x0,y0,direction0,curvature0,x1,y1,direction1,curvature1,length,pieces,greatest_rate,seconds");
    let mut random = Random(1);
    let mut times = Vec::new();
    for _ in 0..PAIRS {
        let pair = [state(&mut random), state(&mut random)];
        for State { point: [x, y], direction, curvature } in pair {
            print!("{x:?},{y:?},{direction:?},{curvature:?},");
        }
        let request = Request { family, ..Request::new(pair[0], pair[1], 1.0) };
        let (mut seconds, mut found) = (f64::INFINITY, None);
        for _ in 0..3 {
            let start = Instant::now();
            found = join(&request)?.ok();
            seconds = seconds.min(start.elapsed().as_secs_f64());
        }
        match found {
            Some(join) => {
                let m = &join.measures;
                println!("{:?},{},{:?},{seconds:.3e}", m.length, join.pieces.len(), m.greatest_rate());
                times.push(seconds * 1e6);
            }
            None => println!(",,,{seconds:.3e}"),
        }
    }
    times.sort_by(f64::total_cmp);
    let at = |share: f64| times[(share * (times.len() - 1) as f64) as usize];
    let joined = times.len();
    eprintln!("{name}: {joined} of {PAIRS} joined; median {:.1} µs, 99 % {:.1} µs", at(0.5), at(0.99));
    Ok(())
}
