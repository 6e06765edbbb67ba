//! All keys of a recipe, from which the page docs/recipes.md is made.
//!
//! Tests hold this list to what the reader does: each table has just the keys that the reader knows, in its order; keys without a
//! default are those that it misses; every example is accepted.

use super::levels::LEVELS_RULE;
use super::look::{DPI, LEAST_SIZE, MAX_PIXELS, MULTIPLES_SIZE, PANEL_SIZE, RESOLUTIONS, SLICE_SIZE};
use super::panels::{MOST_PANELS, PANELS};
use crate::family;
use crate::grid::{MAX_AXES, MAX_COUNT};
use std::fmt::Write;

/// The kinds of pictures.
pub(super) const KINDS: [&str; 4] = ["slice", "union", "multiples", "compare"];

/// One key.
pub(super) struct Key {
    pub name: &'static str,
    /// What may stand on the right of `=`.
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
    let ((width, height), [least, most]) = (LEAST_SIZE, RESOLUTIONS);
    let of_size = format!("two whole numbers of pixels, at least `[{width}, {height}]`");
    let meaning = format!("Width and height of {whose} at {DPI} dpi. The picture may have at most {MAX_PIXELS} pixels.");
    [
        optional("title", "text", title, &format!("The heading of {whose}.")),
        optional("size", &of_size, usual, &meaning),
        optional(
            "dpi",
            &format!("whole number, {least} to {most}"),
            &format!("`{DPI}`"),
            &format!(
                "Pixels per inch. At {} dpi the same picture has twice as many pixels each way. \
                 The PNG file tells the number, so that {whose} prints at the same size.",
                2 * DPI
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
        needed("family", "name of a family", "The family of all atlases that have none of their own. See [Families](#families)."),
        optional(
            "fields",
            "list of names of fields",
            "`[]`",
            "What to store of each node. `flags` and `solutions` are always stored and may be named here. The scalars of the \
             family are stored where they are named.",
        ),
    ];
    let each = format!("{} for each slice", size(PANEL_SIZE));
    keys.extend(look("the recipe's file name", &each, "the picture of slices side by side"));
    keys.push(needed("atlas", "`[[atlas]]` tables, at least one", "The atlases, each with a file of its own."));
    let about = "At the top of the file. Where several atlases begin with a slice or a comparison, these are also drawn side by side, \
                 in a picture with the recipe's name; `title`, `size` and `dpi` here are about that picture.";
    Table { heading: "The recipe", about: about.into(), keys }
}

fn atlas() -> Table {
    let keys = vec![
        needed(
            "name",
            "1 to 64 small letters, digits and hyphens",
            "The name of the atlas and of its files. No two atlases of a recipe have the same.",
        ),
        optional("family", "name of a family", "the recipe's", "The family of this atlas."),
        needed("axes", "table of axes", "The grid. The names of the axes are those of one chart of the family."),
        optional("picture", "`[[atlas.picture]]` tables", "no picture", "The pictures, drawn in this order."),
    ];
    Table { heading: "`[[atlas]]`", about: "One atlas: a grid, and the pictures of it.".into(), keys }
}

fn axis() -> Table {
    let count = format!("whole number, 2 to {MAX_COUNT}");
    let keys = vec![
        optional("linear", "`[first, last]`", "another spacing", "Values in even steps. It goes with `count`."),
        optional("log", "`[first, last]`, both above 0", "another spacing", "Values in even ratios. It goes with `count`."),
        optional("values", "list of numbers", "another spacing", "The values themselves, increasing. It goes without `count`."),
        optional("count", &count, "needed with `linear` and `log`", "How many values there are, both ends included."),
    ];
    let about = format!(
        "Each line of `[atlas.axes]` is `name = {{ .. }}` with just one of the three spacings. A grid has up to {MAX_AXES} axes, \
         in the order of the family's chart, however the recipe orders them. An angle may be written as a text: `\"40deg\"`, \
         `\"0.7rad\"`; a plain number is in radians."
    );
    Table { heading: "An axis of `[atlas.axes]`", about, keys }
}

fn picture() -> Table {
    let kinds = format!("`\"{}\"`", KINDS.join("\"`, `\""));
    let at = format!(
        "slices: needed for each axis of several values; unions: all nodes; multiples: up to {PANELS} nodes of each axis, evenly"
    );
    let mut keys = vec![
        needed("kind", &kinds, "What the picture shows; see above."),
        optional("with", "name of a family", "needed for `compare`", "The other family of a comparison, and of no other kind."),
        needed("x", "name of an axis", "The axis to the right."),
        needed("y", "name of another axis", "The axis upwards."),
        optional(
            "at",
            "table: `axis = number`, or a list of numbers",
            &at,
            "Which nodes of the axes that are not drawn. A number stands for the nearest node and must lie within the axis; \
             the numbers of a list must increase. A slice takes one number for each axis.",
        ),
        optional(
            "regions",
            "list of flags",
            "the family's nested flags, and all others as outlines",
            "Which flags to fill. Each region is drawn over those before it, so the largest comes first.",
        ),
        optional(
            "outlines",
            "list of flags",
            "none, beside `regions`",
            "Which flags to draw as a line with stripes on its inner side, which hides nothing. It goes with `regions`.",
        ),
        optional("field", "name of a stored scalar", "flags are drawn", "Which scalar to fill by `levels`, in place of flags."),
        optional("levels", LEVELS_RULE, "flags are drawn", "Fills where the scalar is at most so much, the least level darkest."),
        optional("mark", "list of marks", "no mark", "Points to point out with a star. They belong on any kind but multiples."),
    ];
    let usual = format!("{}; multiples: {}", size(SLICE_SIZE), size(MULTIPLES_SIZE));
    keys.extend(look("the atlas's name and the fixed coordinates", &usual, "the picture"));
    let about = format!(
        "A picture shows two axes of the grid. What it does with the others is its kind:\n\n\
         - `slice`: each other axis is fixed at one node.\n\
         - `union`: what is true at any of the chosen nodes of the other axes.\n\
         - `multiples`: one panel for each combination of the chosen nodes of the other axes, at most {MOST_PANELS}. Axes of one \
           chosen node stand in the heading. Of the rest the slower ones make the rows, upwards, and the faster ones the columns.\n\
         - `compare`: a slice that shows where only this family has a spiral, only the family `with`, or both."
    );
    Table { heading: "`[[atlas.picture]]`", about, keys }
}

fn mark() -> Table {
    let keys = vec![
        needed("the name of `x`", "number", "Where the mark is along the axis to the right, within the axis."),
        needed("the name of `y`", "number", "Where it is along the axis upwards, within the axis."),
        needed("label", "text", "A few words beside the star."),
    ];
    let about = "For example `mark = [{ kappa0 = 0.4, kappa1 = 4, label = \"example 1\" }]` on a picture with `x = \"kappa0\"` and \
                 `y = \"kappa1\"`.";
    Table { heading: "A mark", about: about.into(), keys }
}

/// Two recipes that together have every key.
pub(super) const EXAMPLES: [(&str, &str); 2] = [
    (
        "Two atlases of one family. Each has a slice, so these are also drawn side by side. The first has small multiples over both \
         angles as well, and a slice of a scalar.",
        r#"family = "cubic"
fields = ["flags", "solutions", "margin"]
title = "Two pairs of angles"
size = [1240, 700]
dpi = 96

[[atlas]]
name = "first"
[atlas.axes]
phi0 = { values = [0.3, 0.7] }
phi1 = { linear = ["40deg", "80deg"], count = 3 }
kappa0 = { linear = [0.05, 0.65], count = 25 }
kappa1 = { log = [0.8, 20], count = 21 }

[[atlas.picture]]
kind = "slice"
x = "kappa0"
y = "kappa1"
at = { phi0 = 0.7, phi1 = "80deg" }
mark = [{ kappa0 = 0.4, kappa1 = 4, label = "example 1" }]
title = "Which end curvatures a cubic spiral joins"
size = [800, 600]
dpi = 192

[[atlas.picture]]
kind = "multiples"
x = "kappa0"
y = "kappa1"
at = { phi0 = [0.3, 0.7] }
regions = ["ANY_SPIRAL", "SPIRAL"]
outlines = ["SOLVABLE"]

[[atlas.picture]]
kind = "slice"
x = "kappa0"
y = "kappa1"
at = { phi0 = 0.7, phi1 = "80deg" }
field = "margin"
levels = [0.1, 0.3, 0.5]

[[atlas]]
name = "second"
[atlas.axes]
phi0 = { values = [0.8] }
phi1 = { values = [0.9] }
kappa0 = { linear = [0.5, 0.7], count = 25 }
kappa1 = { log = [0.8, 1.3], count = 21 }
[[atlas.picture]]
kind = "slice"
x = "kappa0"
y = "kappa1"
"#,
    ),
    (
        "Two atlases of different families: a comparison, and a union over an angle.",
        r#"family = "cubic"

[[atlas]]
name = "cubic-or-ph-quintic"
[atlas.axes]
phi0 = { values = [0.7] }
phi1 = { values = [1.4] }
kappa0 = { linear = [0.2, 0.64], count = 30 }
kappa1 = { log = [1, 20], count = 31 }
[[atlas.picture]]
kind = "compare"
with = "ph-quintic"
x = "kappa0"
y = "kappa1"

[[atlas]]
name = "reached-at-any-angle"
family = "reach-cubic"
[atlas.axes]
theta = { linear = ["5deg", "85deg"], count = 17 }
xi = { linear = [0.1, 4], count = 40 }
eta = { linear = [0.1, 3], count = 30 }
[[atlas.picture]]
kind = "union"
x = "xi"
y = "eta"
"#,
    ),
];

/// The reference of recipes in Markdown, with examples: all keys and, of each family, its axes, flags and scalars.
pub fn reference() -> String {
    let mut page = String::from(
        "# Recipes\n\nThis page is made from the code of the reader: a test compares the two, so what stands here is what the program does.\n\n\
         A recipe is a [TOML](https://toml.io) file. It says which atlases to make and which pictures to draw of them:\n\n\
         ```sh\nspiral-atlas generate recipe.toml\n```\n\n\
         A mistake in a recipe is told with its line and column, and the exit status is 2.\n",
    );
    page += "\n## Examples\n";
    for (about, recipe) in EXAMPLES {
        page += &format!("\n{about}\n\n```toml\n{recipe}```\n");
    }
    page += "\n## Keys\n\nKeys with a default may be left out. Other keys than these are refused.\n";
    for table in tables() {
        page += &format!(
            "\n### {}\n{}\n\n| key | value | default | meaning |\n| --- | --- | --- | --- |\n",
            table.heading, table.about
        );
        for key in table.keys {
            let name = if key.name.contains(' ') { key.name.into() } else { format!("`{}`", key.name) };
            page += &format!(
                "| {name} | {} | {} | {} |\n",
                key.value,
                key.default.as_deref().unwrap_or("must be there"),
                key.meaning
            );
        }
    }
    page += "\n## Families\n\nThe axes, flags and scalars that a recipe may name.\n";
    for family in family::all() {
        page += &format!("\n### `{}`\n{}\n\n", family.name(), family.title());
        for chart in family.charts() {
            page += &format!("- axes `{}`: {}\n", chart.axes.join("`, `"), chart.doc);
        }
        let _ = writeln!(page, "- filled unless a picture chooses: `{}`", family.nested().join("`, `"));
        page += "\n| flag | is true where |\n| --- | --- |\n";
        family.flags().iter().for_each(|flag| page += &format!("| `{}` | {} |\n", flag.name, cell(flag.doc)));
        if !family.scalars().is_empty() {
            page += "\n| scalar | is |\n| --- | --- |\n";
            family.scalars().iter().for_each(|scalar| page += &format!("| `{}` | {} |\n", scalar.name, cell(scalar.doc)));
        }
    }
    page
}

/// A text within a table of Markdown.
fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Error;
    use crate::recipe::Recipe;

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
            let ours: Vec<&str> = ours.iter().map(|name| *[*name, "kappa0", "kappa1"].get(places(name)).unwrap()).collect();
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
            let rest: String = lines.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, l)| format!("{l}\n")).collect();
            let list = if Recipe::parse(&rest).is_err() { &mut missed } else { &mut spared };
            list.push(name);
        }
        // The four axes are missed because the chart has them, `at` because this slice leaves axes of several values open.
        assert_eq!(missed, ["family", "name", "phi0", "phi1", "kappa0", "kappa1", "kind", "x", "y", "at"]);
        assert_eq!(spared, ["fields", "title", "size", "dpi", "mark", "title", "size", "dpi"]);
        let needed = |table: Table| table.keys.into_iter().filter(|key| key.default.is_none()).map(|key| key.name);
        let needed: Vec<&str> = tables().into_iter().flat_map(needed).collect();
        let expected = ["family", "atlas", "name", "axes", "kind", "x", "y", "the name of `x`", "the name of `y`", "label"];
        assert_eq!(needed, expected);
        for part in ["kappa0 = 0.4, ", "kappa1 = 4, ", ", label = \"example 1\""] {
            assert!(complaint(&recipe.replacen(part, "", 1)).contains("the mark lacks"), "{part}");
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
