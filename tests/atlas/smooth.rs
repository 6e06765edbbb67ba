//! Smooth outlines of slices: they lead around the nodes that have a flag, and between nodes through places where the
//! exact verdict changes.

use spiral_atlas::atlas::Atlas;
use spiral_atlas::family;
use spiral_atlas::picture;
use spiral_atlas::plot::{AxisView, Region, Slice};
use std::process::Command;

const RECIPE: &str = r#"
family = "cubic"
[[atlas]]
name = "smooth"
[atlas.axes]
phi0 = { values = [0.7, 0.75] }
phi1 = { values = [1.4] }
kappa0 = { linear = [0.05, 0.75], count = 15 }
kappa1 = { log = [0.4, 40.0], count = 17 }
[[atlas.picture]]
kind = "slice"
x = "kappa0"
y = "kappa1"
at = { phi0 = 0.7 }
[[atlas.picture]]
kind = "union"
x = "kappa0"
y = "kappa1"
"#;

fn slices() -> [Slice; 2] {
    let folder = tempfile::tempdir().unwrap();
    let recipe = folder.path().join("r.toml");
    std::fs::write(&recipe, RECIPE).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_spiral-atlas"));
    let done =
        command.args(["generate", "--backend", "cpu", "--out"]).arg(folder.path()).arg(&recipe).output().unwrap();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let atlas = Atlas::open(folder.path().join("smooth.atlas.safetensors")).unwrap();
    let plans = picture::plans(atlas.about(), atlas.grid()).unwrap();
    [0, 1].map(|i| picture::slice(&atlas, &plans[i]).unwrap())
}

/// A coordinate in the axis's own spacing.
fn even(axis: &AxisView, x: f64) -> f64 {
    if axis.log { x.ln() } else { x }
}

/// Whether a place is inside of an odd number of a region's lines.
fn inside(slice: &Slice, region: &Region, x: f64, y: f64) -> bool {
    let point = |p: &[f64; 2]| [even(&slice.x, p[0]), even(&slice.y, p[1])];
    let (x, y) = (even(&slice.x, x), even(&slice.y, y));
    let sides = region.rings.iter().flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
    let crosses = |(a, b): &(&[f64; 2], &[f64; 2])| {
        let (a, b) = (point(a), point(b));
        (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    };
    sides.filter(crosses).count() % 2 == 1
}

#[test]
fn outlines_lead_around_their_nodes() {
    let [slice, union] = slices();
    let mut around = 0;
    for region in slice.regions.iter().chain(&slice.outlines) {
        for (at, mask) in region.mask.iter().enumerate() {
            let (x, y) = (slice.x.values[at % 15], slice.y.values[at / 15]);
            assert_eq!(inside(&slice, region, x, y), *mask, "{} at {x}, {y}", region.label);
        }
        around += region.rings.iter().map(Vec::len).sum::<usize>();
    }
    assert!(around > 60, "{around}");
    assert!(union.regions.iter().all(|region| region.rings.is_empty()), "a union has no verdicts between its nodes");
}

#[test]
fn outlines_pass_where_the_verdict_changes() {
    let [slice, _] = slices();
    let cubic = family::by_name("cubic").unwrap();
    let holds =
        |bit: usize, x: f64, y: f64| family::verdict(cubic, 0, &[0.7, 1.4, x, y]).unwrap().flags() >> bit & 1 == 1;
    let mut looked = 0;
    for region in slice.regions.iter().chain(&slice.outlines) {
        let bit = cubic.about().flags.iter().position(|flag| flag.label == region.label).unwrap();
        for [x, y] in region.rings.iter().flatten().copied() {
            let on = |axis: &AxisView, value: f64| axis.values.contains(&value);
            // A step on each side: the 256th part of one between nodes.
            let (dx, dy) = (0.05 / 256.0, 100f64.powf(1.0 / 16.0 / 256.0));
            let [before, after] = match (on(&slice.x, x), on(&slice.y, y)) {
                (true, false) if slice.y.border().iter().all(|b| *b != y) => [[x, y / dy], [x, y * dy]],
                (false, true) if slice.x.border().iter().all(|b| *b != x) => [[x - dx, y], [x + dx, y]],
                _ => continue,
            };
            let [before, after] = [before, after].map(|[x, y]| holds(bit, x, y));
            assert!(before != after, "{} does not change at {x}, {y}", region.label);
            looked += 1;
        }
    }
    assert!(looked > 50, "{looked}");
}

#[test]
fn the_border_is_half_a_step_beyond_the_nodes() {
    let view = |values: &[f64], log: bool| AxisView { name: "a".into(), label: "a".into(), values: values.into(), log };
    assert_eq!(view(&[0.0, 1.0, 5.0], false).border(), [-0.5, 7.0]);
    assert_eq!(view(&[1.0, 4.0, 256.0], true).border(), [0.5, 2048.0]);
    assert_eq!(view(&[3.0], false).border(), [1.5, 4.5]);
}
