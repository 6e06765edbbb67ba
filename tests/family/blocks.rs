//! Dense grids by blocks: a family that proves whole blocks says of every node what it says of the node alone.

use crate::oracle::random::Random;
use spiral_atlas::family::cubic::Cubic;
use spiral_atlas::family::{Code, Family, Table};
use spiral_atlas::grid::{Axis, Grid, Spacing};
use std::f64::consts::PI;

/// Codes in pieces of these lengths, over and over.
fn codes(table: &dyn Table, grid: &Grid, pieces: &[usize]) -> Vec<Code> {
    let mut codes = vec![Code::UNDECIDED; grid.len() as usize];
    let mut at = 0;
    for piece in pieces.iter().cycle() {
        let to = (at + piece).min(codes.len());
        table.filter(at as u64, &mut codes[at..to]);
        at = to;
        if at == codes.len() {
            break;
        }
    }
    codes
}

/// Compares all nodes of a grid, made by blocks in several pieces, with those made in pieces too short for blocks. What
/// blocks alone decide, or nodes alone, intervals confirm.
fn agree(family: &dyn Family, grid: &Grid) {
    let table = family.table(grid).unwrap();
    let row = *grid.shape().last().unwrap();
    let alone = codes(&*table, grid, &[row]);
    let plane = row * grid.shape()[grid.shape().len() - 2];
    for pieces in [&[alone.len()][..], &[plane + 3 * row, 11 * row + 5, 1, 9 * row], &[20 * row - 1, 40 * row + 2]] {
        let by_blocks = codes(&*table, grid, pieces);
        for (node, (one, other)) in alone.iter().zip(&by_blocks).enumerate().filter(|(_, (one, other))| one != other) {
            let known = if *other == Code::UNDECIDED { one } else { other };
            let open = [one, other].contains(&&Code::UNDECIDED);
            assert!(
                open && table.exact(node as u64).unwrap().0 == *known,
                "{}: alone {one:?}, by blocks {other:?}",
                grid.describe(node as u64)
            );
        }
    }
}

fn grid(axes: [(&str, Vec<f64>); 4]) -> Grid {
    Grid::new(axes.map(|(name, values)| Axis::new(name, Spacing::Values(values)).unwrap()).to_vec()).unwrap()
}

/// So many values anywhere between two, and some that must be there.
fn values(r: &mut Random, [low, high]: [f64; 2], count: usize, with: &[f64]) -> Vec<f64> {
    let mut all: Vec<f64> = (0..count).map(|_| r.uniform(low, high)).chain(with.iter().copied()).collect();
    all.sort_by(f64::total_cmp);
    all.dedup();
    all
}

/// With equal angles, beyond π/2 and up to φ0 + φ1 = π, curvatures of 0 and below, and tiny and huge ones.
#[test]
fn cubic_blocks_are_their_nodes() {
    let mut r = Random(3);
    for round in 0..40 {
        let size = 10f64.powf(-r.uniform(0.0, 3.0));
        let low = [r.uniform(0.01, 0.9), 0.1 * 300f64.powf(r.uniform(0.0, 1.0))];
        let kappa0 = match round % 4 {
            0 => values(&mut r, [-0.1, 0.2], 50, &[0.0, -5e-324, 5e-324, 1e-300]),
            _ => values(&mut r, [low[0], low[0] + size * (1.0 - low[0])], 60, &[]),
        };
        let kappa1 = match round % 5 {
            0 => values(&mut r, [-1.0, 3.0], 70, &[0.0, 1e-200, 1e200, 1e308, -1e308]),
            _ => values(&mut r, [low[1], low[1] * (1.0 + 9.0 * size)], 90, &[]),
        };
        let phi0 = values(&mut r, [0.05, 1.5], 3, &[0.7, 1e-12]);
        let phi1 = match round % 3 {
            0 => vec![0.7, PI - phi0[phi0.len() - 1] - 1e-9],
            1 => vec![0.7f64.next_up(), 1.2],
            _ => values(&mut r, [0.3, 1.6], 3, &[]),
        };
        agree(&Cubic, &grid([("phi0", phi0), ("phi1", phi1), ("kappa0", kappa0), ("kappa1", kappa1)]));
    }
}

/// In the chart (a, k) nodes lie on the curves where the number of roots changes: at the cusp, on both branches of
/// double roots, and one double beside 1/3.
#[test]
fn normalised_blocks_are_their_nodes() {
    let mut r = Random(4);
    for round in 0..30 {
        let scale = 10f64.powf(-r.uniform(0.0, 4.0));
        let middle = r.uniform(0.25, 0.34);
        let third = 1.0 / 3.0f64;
        let exact = [0.25, third, third.next_up(), third.next_down(), middle];
        // Double roots: x = 1, 2, 3/2 and their mirror images.
        let curve = [1.0, 2.0, 1.5, 2.5].map(|x: f64| [1.0 / (x * (4.0 - x)), (4.0 - x).powi(2) / (16.0 * (3.0 - x))]);
        let with: Vec<f64> = exact.into_iter().chain(curve.into_iter().flatten()).collect();
        let side = [(middle - 0.2 * scale).max(1e-3), middle + scale];
        let far = if round % 3 == 0 { [1e-3, 20.0] } else { side };
        let (a, k) = (values(&mut r, side, 70, &with), values(&mut r, far, 70, &with));
        let phi = [values(&mut r, [0.05, 1.0], 2, &[0.5]), values(&mut r, [0.3, 1.8], 3, &[0.5])];
        let [phi0, phi1] = phi;
        let (a, k) = if round % 2 == 0 { (a, k) } else { (k, a) };
        agree(&Cubic, &grid([("phi0", phi0), ("phi1", phi1), ("a", a), ("k", k)]));
    }
}
