//! What slices and small multiples show.

use super::*;
use crate::recipe::Recipe;
use std::path::Path;

/// An atlas of `any-spiral` whose outer axes have two and three nodes, and one plan.
fn atlas_and_plan(folder: &Path, picture: &str) -> (crate::atlas::Atlas, PicturePlan) {
    use crate::atlas::{Spec, Writer};
    let axes = "alpha = { values = [-1, 0.5] }\nbeta = { values = [0.25, 0.75, 1.5] }\nk1 = { values = [0, 1] }\nk2 = \
                { values = [1, 2] }";
    let text =
        format!("family = \"any-spiral\"\n[[atlas]]\nname = \"a\"\n[atlas.axes]\n{axes}\n[[atlas.picture]]\n{picture}");
    let recipe = Recipe::parse(&text).unwrap();
    let plan = &recipe.atlases[0];
    let path = folder.join("a.safetensors");
    let spec = Spec { name: "a", family: plan.family, grid: &plan.grid, scalars: &[], recipe: &text };
    let mut writer = Writer::create(&path, &spec).unwrap();
    let job = Job { family: plan.family, grid: &plan.grid, scalars: &[] };
    evaluate(&job, &Backend::Cpu, 1, &AtomicBool::new(false), |chunk| writer.put(&chunk)).unwrap();
    writer.finish().unwrap();
    (crate::atlas::Atlas::open(&path).unwrap(), plan.pictures[0].clone())
}

/// Names and values with the numbers of their panels.
fn texts(captions: &[Caption]) -> Vec<String> {
    let values =
        |c: &Caption| c.values.iter().map(|(value, count)| format!("{value} {count}")).collect::<Vec<_>>().join(", ");
    captions.iter().map(|c| format!("{} {}", c.name, values(c))).collect()
}

/// Two slow and two fast axes: a slow value stands once over its panels, and angles of one axis have one unit.
#[test]
fn values_of_slow_axes_stand_once() {
    let axis = |name: &str, values: &[f64]| Axis::new(name, Spacing::Values(values.to_vec())).unwrap();
    let axes = [
        axis("phi0", &[0.1, 40f64.to_radians()]),
        axis("phi1", &[10f64.to_radians(), 40f64.to_radians()]),
        axis("k1", &[1.0, 2.0, 3.0]),
        axis("k2", &[1.00001, 1.00002]),
    ];
    let chosen: Vec<Chosen> = vec![(0, vec![0, 1]), (1, vec![0, 1]), (2, vec![0, 1, 2])];
    let columns = [
        "φ₀ = 0.1 6, 0.6981 6",
        "φ₁ = 10° 3, 40° 3, 10° 3, 40° 3",
        "k₁ = 1 1, 2 1, 3 1, 1 1, 2 1, 3 1, 1 1, 2 1, 3 1, 1 1, 2 1, 3 1",
    ];
    assert_eq!(texts(&captions(&axes, &chosen, false)), columns);
    assert_eq!(texts(&captions(&axes, &[(3, vec![0, 1])], true)), ["k₂ = 1.00002 1, 1.00001 1"]);
}

#[test]
fn captions_tell_the_nodes_of_their_panels() {
    let folder = tempfile::tempdir().unwrap();
    let (atlas, plan) = atlas_and_plan(folder.path(), "kind = \"multiples\"\nx = \"k1\"\ny = \"k2\"");
    let figure = multiples(&Subject::of(&atlas).unwrap(), &plan).unwrap();
    assert_eq!(texts(&figure.rows), ["α = 0.5 1, −1 1"]);
    assert_eq!(texts(&figure.columns), ["β = 0.25 1, 0.75 1, 1.5 1"]);
    assert_eq!((&figure.title[..], &figure.note[..]), ("a", "6 panels (2 of 2 α, 3 of 3 β), 24 nodes, each proved"));
    let more = "at = { beta = 0.75 }\ntitle = \"Mine\"";
    let (atlas, plan) = atlas_and_plan(folder.path(), &format!("kind = \"multiples\"\nx = \"k1\"\ny = \"k2\"\n{more}"));
    let figure = multiples(&Subject::of(&atlas).unwrap(), &plan).unwrap();
    assert!(figure.rows.is_empty() && figure.shape == [1, 2], "{figure:?}");
    assert_eq!(texts(&figure.columns), ["α = −1 1, 0.5 1"]);
    assert_eq!(figure.title, "Mine");
    let untitled = PicturePlan { look: Look::default(), ..plan };
    assert_eq!(multiples(&Subject::of(&atlas).unwrap(), &untitled).unwrap().title, "a: β = 0.75");
    let (atlas, plan) = atlas_and_plan(
        folder.path(),
        "kind = \"multiples\"\nx = \"alpha\"\ny = \"beta\"\nat = { k1 = 0, k2 = [1, 2] }",
    );
    let one = PicturePlan { at: vec![(2, vec![0]), (3, vec![1])], ..plan };
    assert_eq!(multiples(&Subject::of(&atlas).unwrap(), &one).unwrap().note, "1 panel, 6 nodes, each proved");
}

#[test]
fn the_shown_nodes_are_enough() {
    use super::super::{Part, draw, shown};
    let folder = tempfile::tempdir().unwrap();
    for more in ["kind = \"slice\"\nat = { beta = 0.75, k2 = 2 }", "kind = \"union\"\nat = { beta = [0.25, 1.5] }"] {
        let (atlas, plan) = atlas_and_plan(folder.path(), &format!("x = \"k1\"\ny = \"alpha\"\n{more}"));
        let (outline, nodes) = (crate::atlas::Outline::of_atlas(&atlas).unwrap(), shown(atlas.grid(), &plan));
        let index = |node: &Vec<Chosen>| node.iter().map(|(_, i)| i[0]).collect::<Vec<_>>();
        let picked = combinations(&nodes.iter().cloned().enumerate().collect::<Vec<_>>());
        let flags: Vec<u8> = picked.iter().map(|node| atlas.at(&index(node)).unwrap().flags).collect();
        let part = Part::new(&outline, &nodes, &flags, Default::default()).unwrap();
        assert_eq!(draw(&part, &plan).unwrap().svg(), draw(&atlas, &plan).unwrap().svg());
        let short = Part::new(&outline, &nodes, &flags[1..], Default::default()).err().unwrap().to_string();
        assert!(flags.len() < atlas.flags().len() && short.contains("`flags` has"), "{short}");
    }
}

#[test]
fn combinations_run_through_the_last_axis_first() {
    let nodes = |ways: Vec<Vec<Chosen>>| {
        ways.into_iter().map(|way| way.into_iter().map(|(_, n)| n[0]).collect()).collect::<Vec<Vec<_>>>()
    };
    assert_eq!(nodes(combinations(&[(0, vec![3, 5]), (4, vec![1, 2])])), [[3, 1], [3, 2], [5, 1], [5, 2]]);
    assert_eq!(combinations(&[]), [vec![]]);
}
