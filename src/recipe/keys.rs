//! All keys of a recipe, from which the page docs/recipes.md is made, and from which the reader takes its words for a
//! value of the wrong kind.
//!
//! Tests hold this list to what the reader does: each table has just the keys that the reader knows, in its order; keys
//! without a default are those that it misses; every example is accepted.

use super::levels::LEVELS_RULE;
use super::look::{DPI, MAX_PIXELS, MULTIPLES_SIZE, PANEL_SIZE, RESOLUTIONS, SLICE_SIZE};
use super::panels::{MOST_PANELS, PANELS};
use crate::grid::{MAX_AXES, MAX_COUNT};

/// The kinds of pictures.
pub(super) const KINDS: [&str; 4] = ["slice", "union", "multiples", "compare"];

/// What a line of `[atlas.axes]` takes.
pub(super) const AXIS: &str =
    "one of `{ linear = [first, last], count = n }`, `{ log = [first, last], count = n }`, `{ values = [..] }`";

/// One key.
pub(super) struct Key {
    pub name: &'static str,
    /// What may stand on the right of `=`, as it goes on after "it takes".
    pub value: String,
    /// What holds where the key is left out; `None`: it must be there.
    pub default: Option<String>,
    pub meaning: String,
}

/// The keys of one table of TOML.
pub(super) struct Table {
    pub heading: &'static str,
    /// What the table is.
    pub about: String,
    pub keys: Vec<Key>,
}

fn needed(name: &'static str, value: &str, meaning: &str) -> Key {
    Key { name, value: value.into(), default: None, meaning: meaning.into() }
}

fn optional(name: &'static str, value: &str, default: &str, meaning: &str) -> Key {
    Key { name, value: value.into(), default: Some(default.into()), meaning: meaning.into() }
}

fn size((width, height): (u32, u32)) -> String {
    format!("`[{width}, {height}]`")
}

/// The keys `title`, `size` and `dpi`.
fn look(title: &str, usual: &str, whose: &str) -> [Key; 3] {
    let ([least, most], twice) = (RESOLUTIONS, 2 * DPI);
    let of_size = "two whole numbers of pixels such as `[800, 600]`";
    let meaning = format!(
        "Width and height of {whose} at {DPI} dpi. The picture may have at most {MAX_PIXELS} pixels; one without room \
         for a plot beside its labels is refused before any work, with a size that would do."
    );
    [
        optional("title", "a text in quotation marks", title, &format!("The heading of {whose}.")),
        optional("size", of_size, usual, &meaning),
        optional(
            "dpi",
            &format!("a whole number from {least} to {most}"),
            &format!("`{DPI}`"),
            &format!(
                "Pixels per inch. At {twice} dpi the same picture has twice as many pixels each way. The PNG file \
                 states the number, so that {whose} prints at the same size."
            ),
        ),
    ]
}

/// All tables, outermost first.
pub(super) fn tables() -> Vec<Table> {
    vec![recipe(), atlas(), axis(), picture(), mark()]
}

fn recipe() -> Table {
    let mut keys = vec![
        needed(
            "family",
            "the name of a family in quotation marks",
            "The family of all atlases that have none of their own. See [Families](#families).",
        ),
        optional(
            "fields",
            "a list of names of fields such as `[\"margin\"]`",
            "`[]`",
            "What to store of each node. `flags` and `solutions` are always stored and may be named here. The scalars \
             of the family are stored where they are named.",
        ),
    ];
    let each = format!("{} for each slice", size(PANEL_SIZE));
    keys.extend(look("the recipe's file name", &each, "the picture of slices side by side"));
    keys.push(needed(
        "atlas",
        "a section `[[atlas]]`, in double brackets; at least one",
        "The atlases, each with a file of its own.",
    ));
    let about = "At the top of the file. Where several atlases begin with a slice or a comparison, these are also \
                 drawn side by side, in a picture with the recipe's name; `title`, `size` and `dpi` here are about \
                 that picture.";
    Table { heading: "The recipe", about: about.into(), keys }
}

fn atlas() -> Table {
    let keys = vec![
        needed(
            "name",
            "a text of 1 to 64 small letters, digits and hyphens",
            "The name of the atlas and of its files. No two atlases of a recipe have the same.",
        ),
        optional("family", "the name of a family in quotation marks", "the recipe's", "The family of this atlas."),
        optional(
            "kind",
            "one of `\"nodes\"`, `\"cells\"`",
            "`\"nodes\"`",
            "What the file holds: fields at the nodes of the grid, or certified cells of a box: see [Cells](cells.md).",
        ),
        optional(
            "resolution",
            "a power of two from 2 to 2048",
            "needed for cells",
            "How many of the finest cells there are along each axis. It goes with `kind = \"cells\"` alone.",
        ),
        optional(
            "budget",
            "a size in quotation marks such as `\"32 MiB\"`, in KiB, MiB or GiB",
            "needed for cells",
            "Most bytes of the file. Where it does not suffice for the resolution, cells stay coarser, those of other \
             flags than the family's answer first.",
        ),
        needed(
            "axes",
            "a section `[atlas.axes]`, in single brackets, with a line for each axis",
            "The grid. The names of the axes are those of one chart of the family.",
        ),
        optional(
            "picture",
            "a section `[[atlas.picture]]`, in double brackets, for each picture",
            "no picture",
            "The pictures, drawn in this order.",
        ),
    ];
    Table { heading: "`[[atlas]]`", about: "One atlas: a grid, and the pictures of it.".into(), keys }
}

fn axis() -> Table {
    let count = format!("a whole number from 2 to {MAX_COUNT}, such as `41`");
    let keys = vec![
        optional(
            "linear",
            "two numbers, `[first, last]`, such as `[0, 1.5]`",
            "another spacing",
            "Values in even steps. It goes with `count`.",
        ),
        optional(
            "log",
            "two numbers above 0, `[first, last]`, such as `[1, 100]`",
            "another spacing",
            "Values in even ratios. It goes with `count`.",
        ),
        optional(
            "values",
            "a list of numbers such as `[0.5, 1]`",
            "another spacing",
            "The values themselves, increasing. It goes without `count`. Cells may all lie at a single one.",
        ),
        optional(
            "count",
            &count,
            "needed with `linear` and `log`",
            "How many values there are, both ends included. An axis of cells has none.",
        ),
    ];
    let about = format!(
        "Each line of `[atlas.axes]` is the name of an axis, `=`, and {AXIS}. A grid has up to {MAX_AXES} axes, in the \
         order of the family's chart, however the recipe orders them. An angle may be written as a text: `\"40deg\"`, \
         `\"0.7rad\"`; a plain number is in radians."
    );
    Table { heading: "An axis of `[atlas.axes]`", about, keys }
}

fn picture() -> Table {
    let kinds = format!("one of `\"{}\"`", KINDS.join("\"`, `\""));
    let at = format!(
        "slices: needed for each axis of several values; unions: all nodes; multiples: up to {PANELS} nodes of each \
         axis, evenly"
    );
    let mut keys = vec![
        needed("kind", &kinds, "What the picture shows; see above."),
        optional(
            "with",
            "the name of a family in quotation marks",
            "needed for `compare`",
            "The other family of a comparison, and of no other kind.",
        ),
        needed("x", "the name of an axis in quotation marks", "The axis to the right."),
        needed("y", "the name of another axis in quotation marks", "The axis upwards."),
        optional(
            "at",
            "a table such as `{ phi0 = 0.7 }`, with a number or a list of numbers for each axis",
            &at,
            "Which nodes of the axes that are not drawn. A number stands for the nearest node and must lie within the \
             axis; the numbers of a list must increase. A slice takes one number for each axis.",
        ),
        optional(
            "regions",
            "a list of flags such as `[\"SPIRAL\"]`",
            "the family's nested flags, and all others as outlines",
            "Which flags to fill. Each region is drawn over those before it, so the largest comes first.",
        ),
        optional(
            "outlines",
            "a list of flags such as `[\"SPIRAL\"]`",
            "none, beside `regions`",
            "Which flags to draw as a line with stripes on its inner side, which hides nothing. The line of one that \
             holds all over a plot runs around the plot. It goes with `regions`.",
        ),
        optional(
            "field",
            "the name of a stored scalar in quotation marks",
            "flags are drawn",
            "Which scalar to fill by `levels`, in place of flags.",
        ),
        optional(
            "levels",
            LEVELS_RULE,
            "flags are drawn",
            "Fills where the scalar is at most so much, the least level darkest.",
        ),
        optional(
            "mark",
            "a list of tables such as `[{ kappa0 = 0.4, kappa1 = 4, label = \"mine\" }]`",
            "no mark",
            "Points to point out with a star. They belong on any kind but multiples.",
        ),
    ];
    let usual = format!("{}; multiples: {}", size(SLICE_SIZE), size(MULTIPLES_SIZE));
    keys.extend(look("the atlas's name and the fixed coordinates", &usual, "the picture"));
    let about = format!(
        "A picture shows two axes of the grid. What it does with the others is its kind:\n\n\
         - `slice`: each other axis is fixed at one node.\n\
         - `union`: what is true at any of the chosen nodes of the other axes.\n\
         - `multiples`: one panel for each combination of the chosen nodes of the other axes, at most {MOST_PANELS}. \
         Axes of one chosen node stand in the heading. Of the rest the slower ones make the rows, upwards, and the \
         faster ones the columns.\n\
         - `compare`: a slice that shows where only this family has a spiral, only the family `with`, or both."
    );
    Table { heading: "`[[atlas.picture]]`", about, keys }
}

fn mark() -> Table {
    let keys = vec![
        needed("the name of `x`", "a number", "Where the mark is along the axis to the right, within the axis."),
        needed("the name of `y`", "a number", "Where it is along the axis upwards, within the axis."),
        needed("label", "a text in quotation marks", "A few words beside the star."),
    ];
    let about = "For example `mark = [{ kappa0 = 0.4, kappa1 = 4, label = \"example 1\" }]` on a picture with `x \
                 = \"kappa0\"` and `y = \"kappa1\"`.";
    Table { heading: "A mark", about: about.into(), keys }
}

/// What the value at the end of these keys may be; `None` where it is no value of a recipe.
pub(super) fn takes(path: &[&str]) -> Option<String> {
    let (table, name) = match path {
        ["atlas", "axes", _] => return Some(AXIS.into()),
        ["atlas", "picture", "at", _] => return Some("a number or a list of numbers".into()),
        ["atlas", "picture", "mark", "label"] => (mark(), "label"),
        ["atlas", "picture", "mark", _] => return Some("a number".into()),
        ["atlas", "axes", _, name] => (axis(), *name),
        ["atlas", "picture", name] => (picture(), *name),
        ["atlas", name] => (atlas(), *name),
        [name] => (recipe(), *name),
        _ => return None,
    };
    table.keys.into_iter().find(|key| key.name == name).map(|key| key.value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Error;
    use crate::recipe::Recipe;
    use crate::recipe::reference::EXAMPLES;

    /// Small recipes in which every table stands, with the line after which another key would belong to each.
    fn good() -> Vec<(&'static str, usize)> {
        let recipe = EXAMPLES[0].1;
        let after = |line: &str| recipe.find(line).unwrap() + line.len();
        let heads = ["family = \"cubic\"\n", "name = \"first\"\n", "phi0 = { ", "[[atlas.picture]]\n", "mark = [{ "];
        heads.iter().map(|head| (recipe, after(head))).collect()
    }

    fn complaint(recipe: &str) -> String {
        match Recipe::parse(recipe) {
            Err(Error::Recipe(what)) => what,
            other => panic!("accepted, or another error: {:?}\n{recipe}", other.err()),
        }
    }

    #[test]
    fn the_reader_knows_just_these_keys() {
        for (table, (recipe, at)) in tables().iter().zip(good()) {
            let end = if recipe[..at].ends_with('\n') { "\n" } else { ", " };
            let message = complaint(&format!("{}qqqqqqqqqqqqqqqqqqqq = 1{end}{}", &recipe[..at], &recipe[at..]));
            let known = message.split_once("known are `").unwrap_or_else(|| panic!("{message}")).1;
            let known: Vec<&str> = known.trim_end_matches('`').split("`, `").collect();
            let ours: Vec<&str> = table.keys.iter().map(|key| key.name).collect();
            let ours: Vec<&str> =
                ours.iter().map(|name| *[*name, "kappa0", "kappa1"].get(places(name)).unwrap()).collect();
            assert_eq!(known, ours, "{}", table.heading);
        }
    }

    /// The axes of the marks stand for themselves.
    fn places(name: &str) -> usize {
        ["the name of `x`", "the name of `y`"].iter().position(|n| *n == name).map_or(0, |i| i + 1)
    }

    #[test]
    fn keys_without_a_default_are_missed_and_the_others_are_not() {
        let recipe = EXAMPLES[0].1;
        // Each line of the first picture, and of what is around it, is left out in turn.
        let first = recipe.split("[[atlas.picture]]\nkind = \"multiples\"").next().unwrap();
        let lines: Vec<&str> = first.lines().collect();
        let (mut missed, mut spared) = (Vec::new(), Vec::new());
        for (i, line) in lines.iter().enumerate() {
            let Some((name, _)) = line.split_once(" = ") else { continue };
            let rest: String =
                lines.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, l)| format!("{l}\n")).collect();
            let list = if Recipe::parse(&rest).is_err() { &mut missed } else { &mut spared };
            list.push(name);
        }
        // The four axes are missed because the chart has them, `at` because this slice leaves axes of several values
        // open.
        assert_eq!(missed, ["family", "name", "phi0", "phi1", "kappa0", "kappa1", "kind", "x", "y", "at"]);
        assert_eq!(spared, ["fields", "title", "size", "dpi", "mark", "title", "size", "dpi"]);
        let needed = |table: Table| table.keys.into_iter().filter(|key| key.default.is_none()).map(|key| key.name);
        let needed: Vec<&str> = tables().into_iter().flat_map(needed).collect();
        let expected =
            ["family", "atlas", "name", "axes", "kind", "x", "y", "the name of `x`", "the name of `y`", "label"];
        assert_eq!(needed, expected);
        for part in ["kappa0 = 0.4, ", "kappa1 = 4, ", ", label = \"example 1\""] {
            assert!(complaint(&recipe.replacen(part, "", 1)).contains("the mark lacks"), "{part}");
        }
    }

    /// The complaint about `true`, which no key takes, in place of each value of the examples.
    #[test]
    fn wrong_values_are_answered_in_the_words_of_the_table() {
        let sections = ["", "[[atlas]]", "[atlas.axes]", "[[atlas.picture]]"];
        let mut compared = 0;
        for (_, recipe) in EXAMPLES {
            let mut section = 0;
            for line in recipe.lines() {
                section = sections.iter().position(|s| *s == line).unwrap_or(section);
                let Some((name, _)) = line.split_once(" = ") else { continue };
                let value = match section {
                    2 => AXIS.to_owned(),
                    at => tables().swap_remove(at).keys.into_iter().find(|key| key.name == name).unwrap().value,
                };
                let message = complaint(&recipe.replacen(line, &format!("{name} = true"), 1));
                let what = format!("`{name}` has true, but it takes {value}");
                assert!(message.ends_with(&what), "{line}: {message}");
                compared += 1;
            }
        }
        assert!(compared > 50, "{compared}");
        let within = [
            ("[\"40deg\", \"80deg\"]", "true", "`linear` has true, but it takes two numbers"),
            ("[0.8, 20]", "true", "`log` has true, but it takes two numbers above 0"),
            ("[0.3, 0.7]", "true", "`values` has true, but it takes a list of numbers"),
            ("count = 3", "count = true", "`count` has true, but it takes a whole number"),
            ("phi0 = 0.7,", "phi0 = true,", "`phi0` has true, but it takes a number or a list of numbers"),
            ("kappa0 = 0.4,", "kappa0 = true,", "`kappa0` has true, but it takes a number"),
            ("\"example 1\"", "true", "`label` has true, but it takes a text"),
        ];
        for (from, to, what) in within {
            let message = complaint(&EXAMPLES[0].1.replacen(from, to, 1));
            assert!(message.contains(what), "{from}: {message}");
        }
    }

    #[test]
    fn examples_have_every_key() {
        let all: String = EXAMPLES.iter().map(|(_, recipe)| *recipe).collect();
        for key in tables().iter().flat_map(|table| &table.keys) {
            let used = [
                format!("{} = ", key.name),
                format!("[[{}]]", key.name),
                format!("[atlas.{}]", key.name),
                format!("[[atlas.{}]]", key.name),
            ];
            assert!(key.name.contains(' ') || used.iter().any(|text| all.contains(text)), "{}", key.name);
        }
        for kind in KINDS {
            assert!(all.contains(&format!("kind = \"{kind}\"")), "{kind}");
        }
    }
}
