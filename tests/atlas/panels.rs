//! What a picture shows against what the atlas holds: every node of every panel has the colour of its flags, read from
//! the atlas at the panel's own place. Nothing of the code that draws is used but the list of colours.

use spiral_atlas::atlas::Atlas;
use spiral_atlas::plot::region_colors;
use std::path::Path;
use std::process::Command;

const WHITE: [u8; 3] = [255, 255, 255];
const FRAME: [u8; 3] = [34, 34, 34];

/// `trig-quintic` on `p` and `q` of unlike counts, with so many values of the three axes that are not drawn.
fn recipe(outer: [usize; 3], picture: &str) -> String {
    let axis = |name: &str, lo: f64, hi: f64, alone: f64, count: usize| match count {
        1 => format!("{name} = {{ values = [{alone}] }}\n"),
        _ => format!("{name} = {{ linear = [{lo}, {hi}], count = {count} }}\n"),
    };
    let [ratio, theta, m] = outer;
    let axes =
        axis("ratio", 3.0, 6.0, 6.0, ratio) + &axis("theta", 0.3, 1.3, 0.9, theta) + &axis("m", 0.4, 2.0, 0.6, m);
    format!(
        "family = \"trig-quintic\"\n[[atlas]]\nname = \"panels\"\n[atlas.axes]\n{axes}p = {{ linear = [-3.9, 1], count \
         = 5 }}\n\
         q = {{ linear = [-1.5, 1], count = 7 }}\n[[atlas.picture]]\nregions = [\"END_RISES\", \"SPIRAL\"]\n{picture}"
    )
}

/// The atlas and the picture of a recipe.
fn made(recipe: &str, folder: &Path) -> (Atlas, image::RgbImage) {
    let path = folder.join("panels.toml");
    std::fs::write(&path, recipe).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_spiral-atlas"));
    let done = command.args(["generate", "--backend", "cpu", "--out"]).arg(folder).arg(&path).output().unwrap();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let picture = image::open(folder.join("panels.png")).unwrap().to_rgb8();
    (Atlas::open(folder.join("panels.atlas.safetensors")).unwrap(), picture)
}

/// The insides of all frames at least 40 pixels wide and high, in reading order: left, top, right, bottom; the last two
/// are beyond.
fn frames(picture: &image::RgbImage) -> Vec<[u32; 4]> {
    let (width, height) = picture.dimensions();
    let ink = |x: u32, y: u32| x < width && y < height && picture.get_pixel(x, y).0 == FRAME;
    let mut found = Vec::new();
    for y in 0..height {
        for x in 0..width {
            // The corner at the top left: lines go on from it to the right and down, and ticks alone to the left and
            // up.
            let run = |dx: u32, dy: u32| (0..).take_while(|i| ink(x + i * dx, y + i * dy)).count() as u32;
            if !ink(x, y) || ink(x + 1, y + 1) || (y > 0 && ink(x, y - 1)) {
                continue;
            }
            let (wide, high) = (run(1, 0), run(0, 1));
            let closed = |wide: u32, high: u32| {
                (0..wide).all(|i| ink(x + i, y + high - 1)) && (0..high).all(|i| ink(x + wide - 1, y + i))
            };
            // Ticks below go on from the corners.
            if let Some(high) = (40..=high).rev().find(|high| wide >= 40 && closed(wide, *high)) {
                found.push([x + 1, y + 1, x + wide - 1, y + high - 1]);
            }
        }
    }
    found
}

/// Compares all panels, whose nodes of the outer axes are these in reading order, and gives the number of nodes that
/// differ.
fn wrong(atlas: &Atlas, picture: &image::RgbImage, outer: &[[usize; 3]]) -> usize {
    let colors = region_colors(2);
    let panels = frames(picture);
    assert_eq!(panels.len(), outer.len(), "{panels:?}");
    let [p, q] = [5, 7];
    let mut wrong = 0;
    for ([left, top, right, bottom], fixed) in panels.into_iter().zip(outer) {
        for i in 0..p {
            for j in 0..q {
                let index = [fixed[0], fixed[1], fixed[2], i, j];
                let flags = atlas.at(&index).unwrap().flags;
                let bit = |name: &str| {
                    let family = spiral_atlas::family::by_name("trig-quintic").unwrap();
                    flags >> family.about().flags.iter().position(|f| f.name == name).unwrap() & 1 == 1
                };
                let expected = if bit("SPIRAL") {
                    colors[1]
                } else if bit("END_RISES") {
                    colors[0]
                } else {
                    WHITE
                };
                // The middle of the node's cell: `p` to the right, `q` upwards, in even steps.
                let x = left + ((right - left) * (2 * i as u32 + 1)) / (2 * p as u32);
                let y = bottom - ((bottom - top) * (2 * j as u32 + 1)) / (2 * q as u32) - 1;
                // An outline that passes beside the node may share its pixel.
                let around = (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| (x, y)));
                wrong += usize::from(around.into_iter().all(|(x, y)| picture.get_pixel(x, y).0 != expected));
            }
        }
    }
    wrong
}

/// How many of the outer places have a pattern of their own: a picture of one node everywhere could not pass.
fn patterns(atlas: &Atlas, outer: &[[usize; 3]]) -> usize {
    let pattern = |at: &[usize; 3]| {
        let nodes = (0..35).map(|k| [at[0], at[1], at[2], k % 5, k / 5]);
        nodes.map(|index| atlas.at(&index).unwrap().flags).collect::<Vec<u8>>()
    };
    let mut all: Vec<_> = outer.iter().map(pattern).collect();
    all.sort();
    all.dedup();
    all.len()
}

#[test]
fn every_panel_shows_its_own_nodes() {
    let axes = "x = \"p\"\ny = \"q\"\n";
    let multiples = format!("kind = \"multiples\"\n{axes}");
    type Outer = Vec<[usize; 3]>;
    // Rows upwards over the slower axes, columns over the faster ones.
    let cases: [(&str, [usize; 3], String, Outer); 7] = [
        ("one axis", [1, 4, 1], multiples.clone(), (0..4).map(|i| [0, i, 0]).collect()),
        ("two axes", [1, 3, 4], multiples.clone(), (0..3).rev().flat_map(|i| (0..4).map(move |k| [0, i, k])).collect()),
        (
            "the first and the last",
            [3, 1, 2],
            multiples.clone(),
            (0..3).rev().flat_map(|i| (0..2).map(move |k| [i, 0, k])).collect(),
        ),
        (
            "three axes, two of them in the columns",
            [4, 3, 2],
            multiples.clone(),
            (0..4).rev().flat_map(|i| (0..3).flat_map(move |j| (0..2).map(move |k| [i, j, k]))).collect(),
        ),
        (
            "three axes, two of them in the rows",
            [2, 3, 5],
            multiples.clone(),
            (0..2).rev().flat_map(|i| (0..3).rev().flat_map(move |j| (0..5).map(move |k| [i, j, k]))).collect(),
        ),
        (
            "three axes, some nodes of each",
            [3, 4, 5],
            format!("{multiples}at = {{ ratio = [4.5, 6], theta = [0.3, 1.3], m = [0.8, 1.6, 2] }}\n"),
            [2, 1]
                .into_iter()
                .flat_map(|i| [3, 0].into_iter().flat_map(move |j| [1, 3, 4].into_iter().map(move |k| [i, j, k])))
                .collect(),
        ),
        (
            "a slice",
            [3, 4, 5],
            format!("kind = \"slice\"\n{axes}at = {{ ratio = 4.5, theta = 1.3, m = 0.8 }}\n"),
            vec![[1, 3, 1]],
        ),
    ];
    for (what, counts, picture, outer) in cases {
        let folder = tempfile::tempdir().unwrap();
        let (atlas, picture) = made(&recipe(counts, &picture), folder.path());
        // A region may touch a node alone: between nodes its outline is thinner than a pixel.
        let thin = wrong(&atlas, &picture, &outer);
        assert!(thin * 300 <= 35 * outer.len(), "{what}: {thin}");
        if outer.len() > 1 {
            assert!(
                patterns(&atlas, &outer) * 3 > outer.len(),
                "{what}: only {} patterns in {} panels",
                patterns(&atlas, &outer),
                outer.len()
            );
            // The comparison sees two panels exchanged that are not alike, and the first node everywhere.
            let turned: Outer = outer.iter().rev().copied().collect();
            assert!(wrong(&atlas, &picture, &turned) > thin, "{what}");
            assert!(wrong(&atlas, &picture, &vec![outer[0]; outer.len()]) > thin, "{what}");
        }
    }
}
