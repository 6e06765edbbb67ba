//! The page docs/recipes.md: examples, all keys, and what each family has.

use super::keys::tables;
use crate::family;
use std::fmt::Write;

/// Recipes that together have every key.
pub(super) const EXAMPLES: [(&str, &str); 3] = [
    (
        "Two atlases of one family. Each has a slice, so these are also drawn side by side. The first has small \
         multiples over both angles as well, and a slice of a scalar.",
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
    (
        "Certified cells of a box.",
        r#"family = "cubic"

[[atlas]]
name = "coarse-cells"
kind = "cells"
resolution = 32
budget = "2 MiB"
[atlas.axes]
phi0 = { linear = [0.05, 1.5] }
phi1 = { linear = [0.06, 1.55] }
kappa0 = { linear = [0.01, 1] }
kappa1 = { log = [0.1, 100] }
[[atlas.picture]]
kind = "slice"
x = "kappa0"
y = "kappa1"
at = { phi0 = 0.7, phi1 = 1.4 }
regions = ["SPIRAL"]
"#,
    ),
];

/// The reference of recipes in Markdown, with examples: all keys and, of each family, its axes, flags and scalars.
pub fn reference() -> String {
    let mut page = String::from(
        "# Recipes\n\nThis page is made from the code of the reader: a test compares the two, so what stands here is \
         what the program does.\n\n\
         A recipe is a [TOML](https://toml.io) file. It says which atlases to make and which pictures to draw of \
         them:\n\n\
         ```sh\nspiral-atlas generate recipe.toml\n```\n\n\
         A mistake in a recipe is reported with its line and column, and the exit status is 2.\n",
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
        page += &format!("\n### `{}`\n{}\n\n", family.about().name, family.about().title);
        for chart in family.about().charts {
            page += &format!("- axes `{}`: {}\n", chart.axes.join("`, `"), chart.doc);
        }
        let _ = writeln!(page, "- filled unless a picture chooses: `{}`", family.about().nested.join("`, `"));
        page += "\n| flag | is true where |\n| --- | --- |\n";
        family.about().flags.iter().for_each(|flag| page += &format!("| `{}` | {} |\n", flag.name, cell(flag.doc)));
        if !family.about().scalars.is_empty() {
            page += "\n| scalar | is |\n| --- | --- |\n";
            family
                .about()
                .scalars
                .iter()
                .for_each(|scalar| page += &format!("| `{}` | {} |\n", scalar.name, cell(scalar.doc)));
        }
    }
    wrapped(&page)
}

/// Lines of prose end by column 120. Rows of tables and blocks of code stay as they are.
fn wrapped(page: &str) -> String {
    let (mut text, mut code) = (String::new(), false);
    for line in page.lines() {
        code ^= line.starts_with("```");
        let indent = if line.starts_with("- ") { "  " } else { "" };
        let mut width = 0;
        for word in line.split(' ') {
            let longer = width + 1 + word.chars().count();
            if width > 0 && longer > 120 && !code && !line.starts_with('|') {
                text += "\n";
                text += indent;
                width = indent.len() + word.chars().count();
            } else {
                text += if width > 0 { " " } else { "" };
                width = if width > 0 { longer } else { longer - 1 };
            }
            text += word;
        }
        text += "\n";
    }
    text
}

/// A text within a table of Markdown.
fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}
