//! Recipes: what they say is understood, and what they say wrongly is named with its place and a way out.

mod reference;

use proptest::prelude::*;
use spiral_atlas::Error;
use spiral_atlas::grid::Spacing;
use spiral_atlas::recipe::{Mark, PictureKind, Recipe, parse_angle};
use std::f64::consts::PI;
use std::path::Path;

const GOOD: &str = r#"family = "cubic"
fields = ["margin", "flags", "f0"]

[[atlas]]
name = "first-1"
[atlas.axes]
kappa1 = { log = [1, 100.0], count = 4 }
phi0 = { linear = ["5deg", 1.2], count = 12 }
phi1 = { values = [0.9, "80deg"] }
kappa0 = { linear = [0.02, 1.0], count = 3 }
[[atlas.picture]]
kind = "slice"
x = "kappa0"
y = "kappa1"
at = { phi0 = 0.7, phi1 = "79deg" }
mark = [{ kappa0 = 0.4, kappa1 = 4, label = "example 1" }]
[[atlas.picture]]
kind = "multiples"
x = "kappa1"
y = "kappa0"
at = { phi1 = [0.9] }

[[atlas]]
name = "second"
[atlas.axes]
phi0 = { values = [0.7] }
phi1 = { values = [1.4] }
a = { values = [0.1, 0.2] }
k = { values = [0.1, 0.2] }
[[atlas.picture]]
kind = "slice"
x = "a"
y = "k"
"#;

fn shipped(name: &str) -> Recipe {
    Recipe::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("atlases").join(name)).unwrap()
}

/// The complaint about the good recipe with one change.
fn complaint(from: &str, to: &str) -> String {
    assert!(GOOD.contains(from), "{from:?} is not in the recipe");
    match Recipe::parse(&GOOD.replacen(from, to, 1)) {
        Err(Error::Recipe(what)) => what,
        Err(other) => panic!("{to}: {other:?}"),
        Ok(_) => panic!("{to} was accepted"),
    }
}

#[test]
fn a_recipe_is_understood() {
    let recipe = Recipe::parse(GOOD).unwrap();
    let [first, second] = &recipe.atlases[..] else { panic!("two atlases") };
    assert_eq!((first.family.about().name, &first.scalars[..], &recipe.text[..]), ("cubic", &[2, 0][..], GOOD));
    assert_eq!((&first.name[..], first.chart.name), ("first-1", "curvature"));
    assert_eq!((&second.name[..], second.chart.name), ("second", "normalised"));
    assert_eq!(first.grid.shape(), [12, 2, 3, 4]);
    let spacings: Vec<_> = first.grid.axes().iter().map(|a| a.spacing().clone()).collect();
    assert_eq!(spacings[0], Spacing::Linear { lo: 5.0 / 180.0 * PI, hi: 1.2, count: 12 });
    assert_eq!(spacings[1], Spacing::Values(vec![0.9, 80.0 / 180.0 * PI]));
    assert_eq!(spacings[3], Spacing::Log { lo: 1.0, hi: 100.0, count: 4 });
    let [slice, multiples] = &first.pictures[..] else { panic!("two pictures") };
    let node = first.grid.axes()[0].nearest(0.7).unwrap();
    assert_eq!((slice.kind, slice.x, slice.y), (PictureKind::Slice, 2, 3));
    assert_eq!(slice.at, [(0, vec![node]), (1, vec![1])]);
    assert_eq!(slice.marks, [Mark { x: 0.4, y: 4.0, label: "example 1".into() }]);
    assert_eq!((multiples.kind, multiples.x, multiples.y), (PictureKind::Multiples, 3, 2));
    assert_eq!(multiples.at, [(0, vec![0, 2, 4, 6, 8, 11]), (1, vec![0])]);
    assert_eq!(second.pictures[0].at, [(0, vec![0]), (1, vec![0])]);
}

#[test]
fn pictures_choose_their_flags_and_unions_take_all_nodes() {
    let union = "kind = \"union\"\nregions = [\"ANY_SPIRAL\", \"SPIRAL\"]\noutlines = [\"SOLVABLE\"]\nx = \"kappa1\"";
    let recipe = Recipe::parse(&GOOD.replacen("kind = \"multiples\"\nx = \"kappa1\"", union, 1)).unwrap();
    let picture = &recipe.atlases[0].pictures[1];
    assert_eq!(
        (picture.kind, &picture.regions[..], &picture.outlines[..]),
        (PictureKind::Union, &[4, 3][..], &[0][..])
    );
    assert_eq!(picture.at, [(0, (0..12).collect()), (1, vec![0])]);
    assert!(
        complaint("kind = \"multiples\"", "kind = \"union\"\nregions = [\"SPIRALS\"]")
            .contains("did you mean `SPIRAL`?")
    );
    assert!(
        complaint("kind = \"multiples\"", "kind = \"union\"\noutlines = [\"SPIRAL\"]")
            .contains("`outlines` go with `regions`")
    );
}

#[test]
fn levels_are_of_a_stored_scalar() {
    let with = |more: &str| format!("kind = \"multiples\"\n{more}");
    let recipe =
        Recipe::parse(&GOOD.replacen("kind = \"multiples\"", &with("field = \"f0\"\nlevels = [0.5, 1]"), 1)).unwrap();
    let levels = recipe.atlases[0].pictures[1].levels.as_ref().unwrap();
    assert_eq!((levels.field, &levels.values[..]), ("f0", &[0.5, 1.0][..]));
    assert!(complaint("kind = \"multiples\"", &with("field = \"f1\"\nlevels = [1]")).contains("did you mean `f0`?"));
    assert!(complaint("kind = \"multiples\"", &with("field = \"f0\"")).contains("`field` goes with `levels`"));
    assert!(complaint("kind = \"multiples\"", &with("levels = [1]")).contains("`levels` go with `field`"));
    assert!(
        complaint("kind = \"multiples\"", &with("field = \"f0\"\nlevels = [1, 1]"))
            .contains("must be finite and increase")
    );
    assert!(
        complaint("kind = \"multiples\"", "kind = \"union\"\nfield = \"f0\"\nlevels = [1]")
            .contains("a slice or multiples")
    );
}

#[test]
fn an_atlas_may_have_its_own_family() {
    let own = GOOD.replacen("name = \"second\"", "name = \"second\"\nfamily = \"any-spiral\"", 1);
    match Recipe::parse(&own) {
        // Axes a and k are the cubic's, and so is the field f0.
        Err(Error::Recipe(what)) => assert!(what.contains("unknown field `margin`"), "{what}"),
        other => panic!("{:?}", other.is_ok()),
    }
    let recipe = Recipe::parse(
        "family = \"cubic\"\n[[atlas]]\nname = \"a\"\nfamily = \
                                \"reach-ph\"\n[atlas.axes]\ntheta = { values = [1] }\nxi = { values = [1] }\neta = { \
                                values = [1] }",
    )
    .unwrap();
    assert_eq!(recipe.atlases[0].family.about().name, "reach-ph");
}

#[test]
fn comparisons_need_another_family_with_spirals() {
    let change = |with: &str| format!("kind = \"compare\"{with}");
    assert!(complaint("kind = \"slice\"", &change("")).contains("lacks `with`"));
    assert!(complaint("kind = \"slice\"", &change("\nwith = \"cubical\"")).contains("did you mean `cubic`?"));
    assert!(complaint("kind = \"slice\"", &change("\nwith = \"reach-ph\"")).contains("cannot be compared"));
    assert!(complaint("kind = \"slice\"", "kind = \"slice\"\nwith = \"cubic\"").contains("`with` belongs"));
    let recipe = Recipe::parse(&GOOD.replacen("kind = \"slice\"", &change("\nwith = \"cubic\""), 1)).unwrap();
    assert_eq!(recipe.atlases[0].pictures[0].kind, PictureKind::Compare { with: "cubic" });
}

#[test]
fn shipped_regions_of_end_points() {
    for (name, kind) in [("reach.toml", "reach-cubic"), ("reach-ph.toml", "reach-ph")] {
        let recipe = shipped(name);
        assert!(recipe.atlases.iter().all(|a| a.family.about().name == kind));
        let kinds: Vec<PictureKind> = recipe.atlases.iter().map(|a| a.pictures[0].kind).collect();
        assert_eq!(kinds, [PictureKind::Slice, PictureKind::Slice, PictureKind::Union]);
        assert!(recipe.atlases.iter().all(|a| a.pictures[0].regions.len() == 3 && a.family.table(&a.grid).is_ok()));
    }
}

#[test]
fn line_ends_do_not_matter() {
    let recipe = Recipe::parse(&GOOD.replace('\n', "\r\n")).unwrap();
    assert_eq!(recipe.text, GOOD);
}

#[test]
fn fields_are_optional() {
    let recipe = Recipe::parse(&GOOD.replacen("fields = [\"margin\", \"flags\", \"f0\"]", "", 1)).unwrap();
    assert!(recipe.atlases[0].scalars.is_empty());
}

#[test]
fn mistakes_are_named() {
    let cases = [
        ("family =", "famly =", "line 1, column 1: unknown key `famly`; did you mean `family`?"),
        ("\"cubic\"", "\"cubit\"", "line 1, column 10: unknown family `cubit`; did you mean `cubic`?"),
        ("\"cubic\"", "3", "line 1, column 10: `family` has 3, but"),
        ("\"cubic\"", "\"cubic", "line 1"),
        ("\"f0\"", "\"f3\"", "line 2, column 30: unknown field `f3`; did you mean `f0`?"),
        ("\"f0\"", "\"margin\"", "the field `margin` is given twice"),
        ("[[atlas.picture]]", "[[atlas.pictures]]", "unknown key `pictures`; did you mean `picture`?"),
        ("name =", "nome =", "line 5, column 1: unknown key `nome`; did you mean `name`?"),
        ("\"first-1\"", "\"First\"", "small letters"),
        ("\"first-1\"", "\"../first\"", "small letters"),
        ("\"first-1\"", "\"\"", "small letters"),
        ("\"first-1\"", "\"second\"", "two atlases are named `second`"),
        ("kappa0 = { linear", "kapa0 = { linear", "line 10, column 1: unknown axis `kapa0`; did you mean `kappa0`?"),
        ("kappa0 = { linear", "zzzzzz = { linear", "known are `a`, `k`, `kappa0`"),
        (
            "kappa0 = { linear",
            "a = { linear",
            "`cubic` takes phi0, phi1, kappa0, kappa1 (curvature) or phi0, phi1, a, k",
        ),
        ("kappa0 = { linear", "kappa1 = { linear", "is given twice"),
        ("kappa0 = { linear", "kappa0 = { liner", "unknown key `liner`; did you mean `linear`?"),
        ("[0.02, 1.0], count = 3", "[0.02, 1.0]", "axis `kappa0` takes one of"),
        ("[0.02, 1.0], count = 3", "[0.02, 1.0, 3.0], count = 3", "axis `kappa0` takes one of"),
        ("[0.02, 1.0], count = 3", "[0.02, \"1deg\"], count = 3", "`kappa0` is no angle"),
        ("[0.02, 1.0], count = 3", "[0.02, true], count = 3", "`linear` has [0.02, true], but it takes two numbers"),
        ("[0.02, 1.0], count = 3", "[0.02, inf], count = 3", "must be finite"),
        ("[0.02, 1.0], count = 3", "[1.0, 0.02], count = 3", "line 10, column 10: axis `kappa0` runs from 1 to 0.02"),
        ("[0.02, 1.0], count = 3", "[0.02, 1.0], count = -3", "line 10"),
        ("[0.02, 1.0], count = 3", "[0.02, 1.0], count = 99999999999", "it must be 2 to"),
        ("log = [1,", "log = [0,", "must start above 0"),
        ("\"5deg\"", "\"5degrees\"", "\"5degrees\" is no angle"),
        ("[0.9, \"80deg\"]", "[]", "has 0 values"),
        ("\"slice\"", "\"slize\"", "unknown picture kind `slize`; did you mean `slice`?"),
        ("x = \"kappa0\"", "x = \"kapa0\"", "unknown axis `kapa0`; did you mean `kappa0`?"),
        ("x = \"kappa0\"", "x = \"kappa1\"", "both `kappa1`"),
        ("phi0 = 0.7, ", "", "the slice leaves `phi0` open"),
        ("phi0 = 0.7, ", "phi0 = 7, ", "phi0 = 7 lies outside the axis"),
        ("phi0 = 0.7, ", "phi0 = [0.7], ", "a slice takes one value of `phi0`"),
        ("phi0 = 0.7, ", "phi0 = 0.7, kappa0 = 1, ", "`kappa0` is drawn"),
        ("phi0 = 0.7, ", "phi = 0.7, ", "unknown axis `phi`; did you mean `phi0`?"),
        ("phi1 = [0.9]", "phi1 = [0.9, 0.91]", "must increase"),
        ("phi1 = [0.9]", "phi1 = []", "empty list"),
        ("at = { phi1 = [0.9] }", "mark = [{ kappa0 = 0.4 }]", "marks belong on a slice"),
        ("kappa0 = 0.4,", "kappa0 = 4,", "kappa0 = 4 lies outside the picture"),
        ("kappa0 = 0.4,", "kappa0 = nan,", "lies outside the picture"),
        ("kappa0 = 0.4,", "kapa0 = 0.4,", "unknown key `kapa0`; did you mean `kappa0`?"),
        ("kappa0 = 0.4,", "", "the mark lacks `kappa0`"),
        ("\"example 1\"", "1", "the label of a mark is a text"),
    ];
    for (from, to, what) in cases {
        let message = complaint(from, to);
        assert!(message.starts_with("line ") && message.contains(what), "{to}: {message}");
    }
    let Err(Error::Recipe(message)) = Recipe::parse("family = \"cubic\"\natlas = []") else {
        panic!("no atlas was accepted")
    };
    assert_eq!(message, "line 2, column 9: there is no atlas; add an `[[atlas]]`");
}

#[test]
fn errors_of_a_file_name_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    assert!(matches!(Recipe::read(&path), Err(Error::Io { .. })));
    std::fs::write(&path, "family = 1").unwrap();
    let Err(Error::Recipe(what)) = Recipe::read(&path) else { panic!("was accepted") };
    assert!(what.contains("mine.toml: line 1, column 10"), "{what}");
}

#[test]
fn wrong_values_are_told_in_words_of_the_recipe() {
    let cases = [
        ("family = \"cubic\"", "family = 1", "`family` has 1, but it takes the name of a family in quotation marks"),
        ("family = \"cubic\"\n", "", "the recipe lacks the key `family`"),
        ("fields = [\"margin\"", "fields = [1", "`fields` has 1, but it takes a list of names of fields such as"),
        ("name = \"first-1\"\n", "", "this `[[atlas]]` lacks the key `name`"),
        ("phi0 = { linear", "phi0 = 3 # {", "`phi0` has 3, but it takes one of `{ linear"),
        ("phi0 = { linear", "phi0 = {} # {", "axis `phi0` takes one of `{ linear"),
        ("count = 12", "count = \"many\"", "`count` has \"many\", but it takes a whole number from 2 to"),
        ("count = 12", "count = -1", "`count` has -1, but"),
        ("count = 12", "count = 2.5", "`count` has 2.5, but"),
        ("count = 12", "count = 99999999999", "count 99999999999; it must be 2 to 16777216"),
        ("[\"5deg\", 1.2]", "\"5deg\"", "`linear` has \"5deg\", but it takes two numbers"),
        ("[\"5deg\", 1.2]", "[nan, 1.2]", "runs from NaN"),
        ("[\"5deg\", 1.2]", "[\"5dg\", 1.2]", "`phi0`: \"5dg\" is no angle"),
        ("values = [0.9, \"80deg\"]", "values = []", "axis `phi1` has 0 values"),
        ("kind = \"slice\"\n", "", "this `[[atlas.picture]]` lacks the key `kind`"),
        ("x = \"kappa0\"", "x = 1", "`x` has 1, but it takes the name of an axis in quotation marks"),
        ("phi0 = 0.7", "phi0 = true", "`phi0` has true, but it takes a number or a list of numbers"),
        ("mark = [{", "mark = 1 # [{", "`mark` has 1, but it takes a list of tables"),
        ("kind = \"slice\"", "kind = \"slice\"\nkind = \"slice\"", "`kind` is given twice"),
        ("[[atlas]]", "[[atlas]", "this is not TOML"),
    ];
    for (from, to, part) in cases {
        let what = complaint(from, to);
        assert!(what.contains(part), "{to}: {what}");
        assert!(
            !["invalid type", "struct", "usize", "sequence"].iter().any(|word| what.contains(word)),
            "{to}: {what}"
        );
    }
}

#[test]
fn angles() {
    let close = |text: &str, x: f64| assert_eq!(parse_angle(text).unwrap(), x, "{text}");
    close("180deg", PI);
    close(" -90 deg ", -PI / 2.0);
    close("180°", PI);
    close("-90 °", -PI / 2.0);
    close("0.7", 0.7);
    close("7e-1rad", 0.7);
    for bad in ["", "deg", "rad", "1grad", "1 deg rad", "inf", "NaN", "1e400", "infdeg", "0x1", "°", "1°°", "1°rad"]
    {
        assert!(matches!(parse_angle(bad), Err(Error::Domain(_))), "{bad}");
    }
}

#[test]
fn shipped_recipes_are_what_they_promise() {
    let quickstart = shipped("quickstart.toml");
    let [atlas] = &quickstart.atlases[..] else { panic!("one atlas") };
    let mut counts = atlas.grid.shape();
    assert!(counts.iter().all(|n| (35..=45).contains(n)));
    counts.sort_unstable();
    counts.dedup();
    assert_eq!(counts.len(), 4);
    for (axis, x) in atlas.grid.axes().iter().zip([0.7, 1.4, 0.4, 4.0]) {
        let node = axis.values()[axis.nearest(x).unwrap()];
        assert!((node - x).abs() < 1e-12, "{} = {x} is no node, but {node}", axis.name());
    }
    assert_eq!(atlas.pictures.len(), 2);

    let fig2 = shipped("habib-sakai-fig2.toml");
    let cases = [(0.7, 1.4, 0.4, 4.0), (0.1, 1.5, 0.035, 100.0), (0.8, 0.9, 0.6, 0.874)];
    assert_eq!(fig2.atlases.len(), cases.len());
    for (atlas, (phi0, phi1, kappa0, kappa1)) in fig2.atlases.iter().zip(cases) {
        let [axis0, axis1, x, y] = atlas.grid.axes() else { panic!("four axes") };
        assert_eq!((axis0.values(), axis1.values()), (&[phi0][..], &[phi1][..]));
        let mark = &atlas.pictures[0].marks[0];
        assert_eq!((mark.x, mark.y), (kappa0, kappa1));
        // The outer bound (formulas of `least_end_curvature`) enters at the left and leaves at the top.
        assert!(x.values()[x.values().len() - 1] > f64::sin(phi0));
        let bound = f64::sin(phi1) + f64::sin((phi1 - phi0) / 2.0).powi(2) / (f64::sin(phi0) - x.values()[0]);
        assert!(y.values()[0] < bound && bound < y.values()[y.values().len() - 1]);
    }

    let overview = shipped("overview.toml");
    let charts: Vec<&str> = overview.atlases.iter().map(|a| a.chart.name).collect();
    assert_eq!(charts, ["curvature", "normalised"]);
    assert!(overview.atlases.iter().all(|a| a.pictures.iter().all(|p| p.kind == PictureKind::Multiples)));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    /// Words, brackets and numbers exchanged or dropped: an error with a place, or a recipe, but no panic.
    #[test]
    fn mutated_recipes_never_panic(
        edits in prop::collection::vec((any::<prop::sample::Index>(), 0..3usize, piece()), 1..4),
    ) {
        let mut text: Vec<char> = GOOD.chars().collect();
        for (place, drop, piece) in edits {
            let at = place.index(text.len());
            let end = (at + drop).min(text.len());
            text.splice(at..end, piece.chars());
        }
        match Recipe::parse(&text.into_iter().collect::<String>()) {
            Ok(recipe) => prop_assert!(!recipe.atlases.is_empty()),
            Err(Error::Recipe(what)) => prop_assert!(what.starts_with("line "), "{}", what),
            Err(other) => prop_assert!(false, "{other:?}"),
        }
    }
}

fn piece() -> impl Strategy<Value = &'static str> {
    prop::sample::select(vec![
        "",
        "",
        "=",
        "[",
        "]",
        "{",
        "}",
        "\"",
        "\n",
        ",",
        "\u{0}",
        "φ",
        "-",
        "1e308",
        "nan",
        "0",
        "phi0",
        "at = ",
        "[[atlas]]",
        "#",
        "\"x\"",
        ".",
    ])
}
