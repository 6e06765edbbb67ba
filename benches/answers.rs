//! How long single answers take, family by family, as a table: median and 99th percentile in microseconds, on one
//! thread.
//!
//! The data are random over the family's usual domain, and as many hard ones lie on a border between two codes, found
//! by halving the way between two random data. The line `dense` is the f64 step over a dense grid of the usual domain,
//! in million nodes a second, and how many nodes it leaves to intervals. A low rate there shows vector operations that
//! became calls. Arguments choose families by a part of their names.
//!
//! Where the environment variable `SPIRAL_ATLAS_DENSE` names a folder, each family's grid, codes and rates are left
//! there, for `peers/families_jax.py`.

use spiral_atlas::Result;
use spiral_atlas::family::{Code, Family, Table, all, verdict};
use spiral_atlas::grid::{Axis, Grid, Spacing};
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::time::Instant;

type Outcome<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// Random data of each family.
const USUAL: usize = 1500;
/// Data on a border.
const HARD: usize = 300;
/// Halvings towards a border: 2^-24 of the way are left.
const HALVINGS: u32 = 24;

fn main() -> Outcome<()> {
    let folder = std::env::var_os("SPIRAL_ATLAS_DENSE").map(PathBuf::from);
    let wanted: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    println!("{:16} {:6} {:>10} {:>10} {:>10} {:>10}   microseconds", "", "", "answer", "99 %", "verdict", "99 %");
    for family in all().iter().copied() {
        if !wanted.is_empty() && !wanted.iter().any(|word| family.about().name.contains(word.as_str())) {
            continue;
        }
        let (rate, left) = dense(family, folder.as_deref())?;
        println!("{:16} dense {rate:59.3} million nodes a second, {left} left", family.about().name);
        let mut noise = Noise(7);
        let usual: Vec<Vec<f64>> = (0..USUAL).map(|_| datum(family.about().name, &mut noise)).collect();
        let mut hard = vec![];
        while hard.len() < HARD {
            let ends = [datum(family.about().name, &mut noise), datum(family.about().name, &mut noise)];
            hard.extend(border(family, ends)?);
        }
        for (name, data) in [("usual", usual), ("hard", hard)] {
            let answer = times(&data, |point| family.answer(0, point).map(|_| ()))?;
            let verdict = times(&data, |point| verdict(family, 0, point).map(|_| ()))?;
            let [a, b, c, d] = [answer.0, answer.1, verdict.0, verdict.1];
            println!("{:16} {name:6} {a:10.2} {b:10.2} {c:10.2} {d:10.2}", family.about().name);
        }
    }
    Ok(())
}

/// Median and 99th percentile of the times of all data, each the best of three rounds.
fn times(data: &[Vec<f64>], work: impl Fn(&[f64]) -> Result<()>) -> Result<(f64, f64)> {
    let mut best = vec![f64::INFINITY; data.len()];
    // Rounds over all data, not each datum thrice: what a datum leaves in caches must not help it.
    for _ in 0..3 {
        for (best, point) in best.iter_mut().zip(data) {
            let start = Instant::now();
            black_box(work(black_box(point)))?;
            *best = best.min(start.elapsed().as_secs_f64() * 1e6);
        }
    }
    best.sort_by(f64::total_cmp);
    Ok((best[best.len() / 2], best[best.len() * 99 / 100]))
}

/// Nodes a microsecond of the f64 step, the best of three rounds, and how many it leaves undecided.
fn dense(family: &dyn Family, folder: Option<&Path>) -> Outcome<(f64, usize)> {
    // Some 30,000 nodes, many along the last axis.
    let names = family.about().charts[0].axes;
    let counts: &[usize] = match names.len() {
        3 => &[12, 48, 52],
        4 => &[9, 8, 20, 21],
        _ => &[5, 6, 5, 14, 15],
    };
    let mut noise = Noise(3);
    let data: Vec<Vec<f64>> = (0..4000).map(|_| datum(family.about().name, &mut noise)).collect();
    let axis = |(i, (name, count)): (usize, (&&str, &usize))| {
        let all = data.iter().map(|point| point[i]);
        let (lo, hi) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), x| (x.min(lo), x.max(hi)));
        Axis::new(name, Spacing::Linear { lo, hi, count: *count })
    };
    let grid = Grid::new(names.iter().zip(counts).enumerate().map(axis).collect::<Result<_>>()?)?;
    let table = family.table(&grid)?;
    let mut codes = vec![Code::UNDECIDED; grid.len() as usize];
    let mut best = f64::INFINITY;
    for _ in 0..3 {
        let start = Instant::now();
        table.filter(0, black_box(&mut codes));
        best = best.min(start.elapsed().as_secs_f64() * 1e6);
    }
    let (rate, left) = (codes.len() as f64 / best, codes.iter().filter(|code| **code == Code::UNDECIDED).count());
    if let Some(folder) = folder {
        leave(folder, family, &grid, &*table, &mut codes, rate)?;
    }
    Ok((rate, left))
}

/// Leaves a grid, the flags of its nodes and the rates in a folder: `NAME.json` and, a byte a node, `NAME.flags`.
fn leave(
    folder: &Path,
    family: &dyn Family,
    grid: &Grid,
    table: &dyn Table,
    codes: &mut [Code],
    rate: f64,
) -> Outcome<()> {
    for (node, code) in codes.iter_mut().enumerate().filter(|(_, code)| **code == Code::UNDECIDED) {
        *code = table.exact(node as u64)?.0;
    }
    // Each core goes through the whole grid, as often as some hundredths of a second hold.
    let cores = std::thread::available_parallelism()?.get();
    let rounds = (2e4 * rate / codes.len() as f64).ceil() as usize;
    let mut all = 0f64;
    for _ in 0..3 {
        let start = Instant::now();
        std::thread::scope(|scope| {
            for _ in 0..cores {
                let mut own = codes.to_vec();
                scope.spawn(move || (0..rounds).for_each(|_| table.filter(0, black_box(&mut own))));
            }
        });
        all = all.max((cores * rounds * codes.len()) as f64 / (start.elapsed().as_secs_f64() * 1e6));
    }
    let about = family.about();
    let axes: Vec<&[f64]> = grid.axes().iter().map(Axis::values).collect();
    let flags: Vec<&str> = about.flags.iter().map(|flag| flag.name).collect();
    let told = serde_json::json!({
        "family": about.name, "names": about.charts[0].axes, "values": axes, "flags": flags,
        "rate": rate, "cores": cores, "rate_of_all": all,
    });
    std::fs::write(folder.join(format!("{}.json", about.name)), told.to_string())?;
    let bytes: Vec<u8> = codes.iter().map(|code| code.flags()).collect();
    Ok(std::fs::write(folder.join(format!("{}.flags", about.name)), bytes)?)
}

/// Both sides of a border between two data, where their codes differ.
fn border(family: &dyn Family, [mut from, mut to]: [Vec<f64>; 2]) -> Result<Vec<Vec<f64>>> {
    let first = verdict(family, 0, &from)?;
    if verdict(family, 0, &to)? == first {
        return Ok(vec![]);
    }
    for _ in 0..HALVINGS {
        let middle: Vec<f64> = from.iter().zip(&to).map(|(a, b)| 0.5 * (a + b)).collect();
        if verdict(family, 0, &middle)? == first { from = middle } else { to = middle }
    }
    Ok(vec![from, to])
}

/// A random datum of a family's first chart.
fn datum(family: &str, noise: &mut Noise) -> Vec<f64> {
    match family {
        "cubic" | "ph-quintic" => {
            let phi0 = noise.between(0.1, 1.2);
            vec![phi0, noise.between(phi0, 1.6), noise.log(0.02, 1.0), noise.log(0.8, 80.0)]
        }
        "any-spiral" => {
            let angle = |noise: &mut Noise| noise.between(-3.0, 3.0);
            vec![angle(noise), angle(noise), noise.between(-4.0, 4.0), noise.between(-4.0, 4.0)]
        }
        "reach-cubic" | "reach-ph" => {
            vec![noise.between(0.05, 1.5), noise.between(0.02, 4.0), noise.between(0.02, 4.0)]
        }
        "trig-quintic" => {
            let shape = |noise: &mut Noise| noise.between(-3.9, 1.0);
            vec![noise.between(2.5, 9.0), noise.between(0.1, 1.4), noise.log(0.2, 6.0), shape(noise), shape(noise)]
        }
        "ph-equal-length" => {
            vec![noise.between(-3.0, 3.0), noise.between(-3.0, 3.0), noise.log(1.02, 4.0)]
        }
        _ => vec![noise.between(-3.0, 3.0), noise.between(-3.0, 3.0), noise.log(0.3, 8.0), noise.log(0.3, 8.0)],
    }
}

/// Numbers that are the same in every run (splitmix64).
struct Noise(u64);

impl Noise {
    /// In [0, 1).
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + self.unit() * (high - low)
    }
    fn log(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }
}
