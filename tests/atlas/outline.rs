//! Outlines: an atlas without its fields comes back from its metadata and axes, and parts of a grid have the whole's
//! fields.

use spiral_atlas::atlas::{Atlas, Outline, Spec, Writer};
use spiral_atlas::eval::{Backend, Chunk, Job, evaluate};
use spiral_atlas::family::by_name;
use spiral_atlas::grid::{Axis, Grid, Spacing};
use std::collections::HashMap;
use std::sync::atomic::AtomicBool;

fn grid() -> Grid {
    let axis = |name, spacing| Axis::new(name, spacing).unwrap();
    Grid::new(vec![
        axis("phi0", Spacing::Values(vec![0.3, 0.7, 0.8])),
        axis("phi1", Spacing::Linear { lo: 0.9, hi: 1.5, count: 5 }),
        axis("kappa0", Spacing::Linear { lo: -0.1, hi: 0.6, count: 6 }),
        axis("kappa1", Spacing::Log { lo: 0.5, hi: 200.0, count: 19 }),
    ])
    .unwrap()
}

/// All fields of a grid, as one chunk.
fn fields(grid: &Grid) -> Chunk {
    let mut all = Chunk { start: 0, flags: Vec::new(), solutions: Vec::new(), scalars: vec![Vec::new()] };
    let job = Job { family: by_name("cubic").unwrap(), grid, scalars: &[2] };
    evaluate(&job, &Backend::Cpu, 1, &AtomicBool::new(false), |chunk| {
        all.flags.extend(chunk.flags);
        all.solutions.extend(chunk.solutions);
        all.scalars[0].extend(&chunk.scalars[0]);
        Ok(())
    })
    .unwrap();
    all
}

#[test]
fn an_atlas_comes_back_from_its_outline() {
    let (folder, grid) = (tempfile::tempdir().unwrap(), grid());
    let (path, copy) = (folder.path().join("a"), folder.path().join("b"));
    let spec = Spec { name: "a", family: by_name("cubic").unwrap(), grid: &grid, scalars: &[2], recipe: "# φ0 \"\n" };
    let mut writer = Writer::create(&path, &spec).unwrap();
    writer.put(&fields(&grid)).unwrap();
    writer.finish().unwrap();
    let atlas = Atlas::open(&path).unwrap();
    let told: HashMap<String, String> = Outline::of_atlas(&atlas).unwrap().metadata().unwrap().into_iter().collect();
    let mut whole = atlas.metadata().clone();
    whole.retain(|key, _| !key.starts_with("blake3"));
    assert_eq!(whole, told.clone().into_iter().collect());
    let values = |name: &str| grid.axes().iter().find(|axis| axis.name() == name).map(|axis| axis.values().to_vec());
    let outline = Outline::read("store", told.clone(), values).unwrap();
    let mut writer = outline.create(&copy).unwrap();
    writer.put(&fields(&grid)).unwrap();
    writer.finish().unwrap();
    assert_eq!(std::fs::read(&path).unwrap(), std::fs::read(&copy).unwrap());
    for point in [[0.76, 1.19, 0.11, 7.0], [0.76, 1.19, 0.8, 7.0], [f64::NAN, 1.2, 0.1, 7.0]] {
        assert_eq!(outline.nearest(&point), atlas.nearest(&point).map(|(node, _)| node));
    }
    let complaint = |key: &str, text: &str| {
        let mut told = told.clone();
        told.insert(key.into(), text.into());
        Outline::read("store", told, values).unwrap_err().to_string()
    };
    assert!(complaint("no_value", "0").contains("store: its metadata `no_value`"));
    assert!(complaint("more", "0").contains("`more`"));
    assert!(complaint("kind", "cells").contains("cells"));
    assert!(complaint("axes", "[]").contains("no axes") || complaint("axes", "[]").contains("0 axes"));
    let less =
        Outline::read("store", told.clone(), |name| values(name).filter(|_| name != "phi1")).unwrap_err().to_string();
    assert!(less.contains("no values of the axis `phi1`"), "{less}");
    let moved = Outline::read("store", told.clone(), |name| values(name).map(|v| v.iter().map(|x| x + 1e-9).collect()));
    assert!(moved.unwrap_err().to_string().contains("value 1 of the axis `phi1`"));
}

#[test]
fn a_part_has_the_fields_of_the_whole() {
    let grid = grid();
    let whole = fields(&grid);
    let nodes = [vec![1, 2], vec![0, 3], (0..6).collect(), (4..15).collect::<Vec<_>>()];
    let part = grid.pick(&nodes).unwrap();
    // An axis that is there entirely keeps its spacing.
    assert_eq!(part.axes()[2], grid.axes()[2]);
    let fields = fields(&part);
    for node in 0..part.len() {
        let index: Vec<usize> = part.index(node).iter().zip(&nodes).map(|(i, chosen)| chosen[*i]).collect();
        let (at, node) = (grid.flat(&index).unwrap() as usize, node as usize);
        assert_eq!((fields.flags[node], fields.solutions[node]), (whole.flags[at], whole.solutions[at]));
        assert_eq!(fields.scalars[0][node].to_bits(), whole.scalars[0][at].to_bits());
    }
    assert!(grid.pick(&nodes[1..]).unwrap_err().to_string().contains("3 axes"));
    let beyond = [vec![3], vec![0], vec![0], vec![0]];
    assert!(grid.pick(&beyond).unwrap_err().to_string().contains("axis `phi0` has no node 3"));
}
