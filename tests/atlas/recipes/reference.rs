//! How pictures look, how many panels they may have, and the page that lists all keys.

use super::{GOOD, complaint};
use spiral_atlas::Error;
use spiral_atlas::recipe::{Look, Recipe, reference};
use std::path::Path;
use std::process::Command;

#[test]
fn looks_are_read_or_refused() {
    let with = |more: &str| GOOD.replacen("kind = \"slice\"", &format!("kind = \"slice\"\n{more}"), 1);
    let recipe = Recipe::parse(&with("title = \"Mine\"\nsize = [800, 600]\ndpi = 192")).unwrap();
    let look = &recipe.atlases[0].pictures[0].look;
    assert_eq!((look.title.as_deref(), look.size, look.dpi), (Some("Mine"), Some((800, 600)), 192));
    assert_eq!(look.pixels((1, 1)), (1600, 1200));
    assert_eq!(recipe.look, Look::default());
    let all = Recipe::parse(&format!("title = \"All\"\nsize = [900, 400]\ndpi = 48\n{GOOD}")).unwrap();
    assert_eq!((all.look.title.as_deref(), all.look.pixels((1, 1))), (Some("All"), (450, 200)));
    let cases = [
        ("size = [800]", "`size` has 1 numbers; it is a list of two"),
        ("size = [800, 600, 2]", "`size` has 3 numbers"),
        ("size = [800, 0]", "`size` is 800 x 0 pixels; both must be above 0"),
        ("size = [100000, 100000]", "100000 x 100000 pixels; the product must be at most 33554432"),
        ("size = [800, -600]", "`size` has [800, -600], but it takes two whole numbers of pixels such as `[800, 600]`"),
        ("size = [800, 600.5]", "`size` has [800, 600.5], but it takes two whole numbers of pixels"),
        ("dpi = 0", "`dpi` is 0; it must be 24 to 2400"),
        ("dpi = 2401", "`dpi` is 2401; it must be 24 to 2400"),
        ("dpi = 2400", "25000 x 21500 pixels; the product must be at most 33554432, so take a smaller `size` or `dpi`"),
        ("dpi = \"96\"", "`dpi` has \"96\", but it takes a whole number from 24 to 2400"),
    ];
    for (line, what) in cases {
        let message = complaint("kind = \"slice\"", &format!("kind = \"slice\"\n{line}"));
        assert!(message.starts_with("line 13, column ") && message.contains(what), "{line}: {message}");
        assert!(Recipe::parse(&format!("{line}\n{GOOD}")).is_err(), "{line}");
    }
}

#[test]
fn too_many_panels_are_refused() {
    let recipe = |counts: [usize; 3], at: &str| {
        let [ratio, theta, m] = counts.map(|count| {
            if count == 1 { "values = [1]".into() } else { format!("linear = [0.5, 1.4], count = {count}") }
        });
        let axes = format!(
            "ratio = {{ {ratio} }}\ntheta = {{ {theta} }}\nm = {{ {m} }}\np = {{ values = [0, 1] }}\nq = {{ values = \
             [0, 1] }}"
        );
        Recipe::parse(&format!(
            "family = \"trig-quintic\"\n[[atlas]]\nname = \"a\"\n[atlas.axes]\n{axes}\n[[atlas.picture]]\nkind = \
             \"multiples\"\nx = \"p\"\ny = \"q\"\n{at}"
        ))
    };
    // Six of each axis unless chosen: 4 x 6 x 6 panels fit, 5 x 6 x 6 do not.
    assert_eq!(
        recipe([4, 6, 99], "").unwrap().atlases[0].pictures[0].at.iter().map(|(_, n)| n.len()).collect::<Vec<_>>(),
        [4, 6, 6]
    );
    let Err(Error::Recipe(message)) = recipe([5, 6, 99], "") else { panic!("180 panels") };
    let what = "line 11, column 8: the picture would have 180 panels: 5 of `ratio`, 6 of `theta`, 6 of `m`; it has \
                room for 144. Choose fewer nodes";
    assert!(message.starts_with(what), "{message}");
    assert!(recipe([5, 6, 99], "at = { theta = [0.5, 1] }").is_ok());
}

#[test]
fn the_reference_is_what_the_code_says() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/recipes.md");
    let fresh = Path::new(env!("CARGO_TARGET_TMPDIR")).join("recipes.md");
    std::fs::write(&fresh, reference()).unwrap();
    let page = std::fs::read_to_string(path).unwrap_or_default();
    assert!(page == reference(), "docs/recipes.md is not up to date; a fresh one is {}", fresh.display());
}

#[test]
fn the_examples_of_the_reference_run() {
    let folder = tempfile::tempdir().unwrap();
    let page = reference();
    let mut pictures = Vec::new();
    for (i, block) in page.split("```toml\n").skip(1).map(|rest| rest.split("```").next().unwrap()).enumerate() {
        let recipe = folder.path().join(format!("example-{i}.toml"));
        std::fs::write(&recipe, block).unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_spiral-atlas"));
        let done =
            command.args(["generate", "--backend", "cpu", "--out"]).arg(folder.path()).arg(&recipe).output().unwrap();
        assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    }
    for entry in std::fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().path()) {
        if entry.extension().is_some_and(|e| e == "png") {
            let png = std::fs::read(&entry).unwrap();
            let at = png.windows(4).position(|chunk| chunk == b"pHYs").unwrap() + 4;
            let number = |from: usize| u32::from_be_bytes(png[from..from + 4].try_into().unwrap());
            // Width and height in pixels, pixels per metre both ways, and that the unit is the metre.
            let name = entry.file_stem().unwrap().to_string_lossy().into_owned();
            pictures.push((name, number(16), number(20), number(at), number(at + 4), png[at + 8]));
        }
    }
    pictures.sort();
    let expected = [
        ("coarse-cells", 1000, 860, 3780),
        ("cubic-or-ph-quintic", 1000, 860, 3780),
        ("example-0", 1240, 700, 3780),
        ("first-1", 1600, 1200, 7559),
        ("first-2", 1500, 1350, 3780),
        ("first-3", 1000, 860, 3780),
        ("reached-at-any-angle", 1000, 860, 3780),
        ("second", 1000, 860, 3780),
    ];
    assert_eq!(pictures, expected.map(|(name, w, h, density)| (name.to_owned(), w, h, density, density, 1)));
}
