//! The layers of ARCHITECTURE.md: no room imports one above it, and no two files import each other, directly or in a
//! circle. The latter holds of the crates for Python, C and browsers, too, and of the Python package.
//!
//! An import is what a `use` line names, or a path that begins with `crate::` or `super::`, followed through re-exports
//! to the file that defines the name. None are a re-export itself, what tests use, and the path by which a file hands
//! on to a module of its own, such as `table::new()`.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Each room of `src/` with the rooms that it may import.
const ROOMS: [(&str, &[&str]); 21] = [
    ("error", &[]),
    ("steps", &[]),
    ("queue", &[]),
    ("files", &["error"]),
    ("plain", &["error"]),
    ("num", &["steps", "error"]),
    ("plot", &["error"]),
    ("grid", &["num", "error"]),
    ("curve", &["num", "steps", "error"]),
    ("family", &["curve", "grid", "num", "steps", "error"]),
    ("eval", &["family", "grid", "num", "error"]),
    ("recipe", &["family", "grid", "num", "files", "plain", "steps", "error"]),
    ("atlas", &["eval", "recipe", "family", "grid", "num", "files", "plain", "error"]),
    ("cells", &["atlas", "recipe", "family", "grid", "files", "error"]),
    ("question", &["family", "num", "queue", "error"]),
    ("transition", &["family", "curve", "num", "steps", "plain", "error"]),
    ("path", &["transition", "family", "curve", "num", "queue", "steps", "plain", "error"]),
    ("tools", &["path", "transition", "curve", "num", "plain", "error"]),
    ("export", &["path", "transition", "curve", "error"]),
    ("picture", &["cells", "atlas", "recipe", "plot", "eval", "family", "grid", "error"]),
    (
        "cli",
        &[
            "export",
            "picture",
            "tools",
            "path",
            "transition",
            "cells",
            "question",
            "atlas",
            "recipe",
            "eval",
            "plot",
            "family",
            "curve",
            "grid",
            "num",
            "files",
            "plain",
            "error",
        ],
    ),
];

/// A source file, read as far as imports go.
struct Source {
    /// Its module, such as `["family", "cubic"]`.
    module: Vec<String>,
    /// Absolute paths of what it imports.
    imports: Vec<Vec<String>>,
    /// What it re-exports: name to absolute path.
    exports: BTreeMap<String, Vec<String>>,
}

/// Every file below a folder whose name has this end.
fn files(folder: &Path, end: &str, all: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files(&path, end, all);
        } else if path.extension().is_some_and(|e| e == end) {
            all.push(path);
        }
    }
}

fn module_of(path: &Path) -> Vec<String> {
    let mut parts: Vec<String> = path.with_extension("").iter().map(|p| p.to_str().unwrap().to_owned()).collect();
    if parts.last().is_some_and(|last| last == "mod" || last == "lib") {
        parts.pop();
    }
    parts
}

/// The paths of a `use` tree: `a::{b, c::d}` is `a::b` and `a::c::d`.
fn leaves(tree: &str) -> Vec<String> {
    let Some(open) = tree.find('{') else { return vec![tree.trim().to_owned()] };
    let (head, body) = (&tree[..open], &tree[open + 1..tree.rfind('}').unwrap()]);
    let (mut all, mut depth, mut part) = (Vec::new(), 0, String::new());
    for c in body.chars().chain([',']) {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                all.extend(leaves(&part).into_iter().filter(|l| !l.is_empty()).map(|l| format!("{}{l}", head.trim())));
                part.clear();
                continue;
            }
            _ => {}
        }
        part.push(c);
    }
    all
}

/// The modules that a file has in files of their own.
fn children(code: &str) -> Vec<&str> {
    let names = code.lines().filter_map(|line| line.trim_end().strip_suffix(';')?.split_once("mod "));
    names.filter(|(before, _)| ["", "pub "].contains(before) || before.ends_with(") ")).map(|(_, name)| name).collect()
}

/// A path seen from a module that has these children, from the root; `None` for those of other crates.
fn absolute(path: &str, module: &[String], children: &[&str], library: bool) -> Option<Vec<String>> {
    let mut here = module.to_vec();
    let mut parts = path.split("::").map(str::trim).peekable();
    match *parts.peek()? {
        "crate" => {
            here.clear();
            parts.next();
        }
        // The command calls the library by its name; other crates that do so import nothing of their own.
        "spiral_atlas" if library => {
            here.clear();
            parts.next();
        }
        "self" => {
            parts.next();
        }
        "super" => {
            while parts.next_if_eq(&"super").is_some() {
                here.pop();
            }
        }
        name if children.contains(&name) => {}
        _ => return None,
    }
    here.extend(parts.map(str::to_owned));
    Some(here)
}

fn read(path: &Path, root: &Path) -> Source {
    let module = module_of(path.strip_prefix(root).unwrap());
    let text = fs::read_to_string(path).unwrap();
    // Tests stand last, or in a file of their own.
    let all_tests = path.ends_with("tests.rs");
    let code = if all_tests { "" } else { text.split("#[cfg(test)]\nmod ").next().unwrap() };
    let code: Vec<&str> = code.lines().filter(|line| !line.trim_start().starts_with("//")).collect();
    let code = code.join("\n");
    let (mut imports, mut exports) = (Vec::new(), BTreeMap::new());
    let children = children(&code);
    let absolute = |path: &str| absolute(path, &module, &children, root == Path::new("src"));
    let mut rest = String::new();
    for statement in code.split_inclusive(';') {
        let line = statement.trim_start().trim_end_matches(';');
        // What stands before it, such as an attribute.
        let start = ["pub use ", "pub(crate) use ", "pub(super) use ", "use "].iter().find_map(|word| {
            line.match_indices(word)
                .map(|(at, _)| at)
                .find(|at| *at == 0 || line[..*at].ends_with('\n'))
                .map(|at| (at, *word))
        });
        let Some((at, word)) = start else {
            rest += statement;
            continue;
        };
        for leaf in leaves(&line[at + word.len()..]) {
            let (path, name) = leaf.split_once(" as ").unwrap_or((&leaf, leaf.rsplit("::").next().unwrap()));
            match absolute(path) {
                Some(path) if word == "use " => imports.push(path),
                // A macro, which a file exports by its own name, leads no further.
                Some(path) if path[..path.len() - 1] == module => {}
                Some(path) => {
                    exports.insert(name.trim().to_owned(), path);
                }
                None => {}
            }
        }
    }
    let between = |c: char| !(c.is_alphanumeric() || c == '_' || c == ':');
    let first = |path: &&str| ["crate::", "super::"].iter().any(|word| path.starts_with(word));
    let paths = rest.split(between).map(|path| path.trim_start_matches(':').trim_end_matches(':')).filter(first);
    imports.extend(paths.filter_map(absolute));
    Source { module, imports, exports }
}

/// The file that defines what a path names: its index.
fn target(sources: &[Source], path: &[String]) -> Option<usize> {
    for length in (0..=path.len()).rev() {
        let Some(i) = sources.iter().position(|s| s.module == path[..length]) else { continue };
        let export = path.get(length).and_then(|name| sources[i].exports.get(name));
        return match export {
            // A macro that its own file re-exports, for others to import.
            Some(export) if export == path => Some(i),
            Some(export) => target(sources, &[export, &path[length + 1..]].concat()),
            None => Some(i),
        };
    }
    None
}

/// What each file of a crate imports of the others.
fn graph(root: &Path) -> (Vec<Source>, Vec<BTreeSet<usize>>) {
    let mut paths = Vec::new();
    files(root, "rs", &mut paths);
    paths.sort();
    let sources: Vec<Source> = paths.iter().map(|p| read(p, root)).collect();
    let edges = (0..sources.len()).map(|i| {
        let targets = sources[i].imports.iter().filter_map(|path| target(&sources, path));
        targets.filter(|t| *t != i && !sources[*t].module.is_empty()).collect()
    });
    let edges = edges.collect();
    (sources, edges)
}

/// The rooms of ARCHITECTURE.md's table of layers, with those that each may import.
fn table() -> BTreeMap<String, Vec<String>> {
    let text = fs::read_to_string("ARCHITECTURE.md").unwrap();
    let (_, after) = text.split_once("| room | what is in it | imports |").unwrap();
    let rows = after.lines().skip(2).take_while(|line| line.starts_with('|'));
    let cells = rows.map(|row| row.trim_matches('|').split(" | ").map(str::trim).collect::<Vec<_>>());
    let names = |cell: &str| cell.split(", ").map(|name| name.trim_matches(['`', '/', ' ']).to_owned()).collect();
    let mut all = BTreeMap::new();
    for row in cells {
        let (rooms, imports): (Vec<String>, Vec<String>) = (names(row[0]), names(row[row.len() - 1]));
        all.extend(rooms.into_iter().map(|room| (room, imports.clone())));
    }
    all
}

/// Every room has its row, which names rooms that it does import, and through these leads to all others that it may.
#[test]
fn the_page_has_the_same_layers() {
    let table = table();
    let helpers = ["error", "files", "plain", "queue", "steps"];
    for (room, allowed) in ROOMS.into_iter().filter(|(room, _)| !helpers.contains(room)) {
        let row = table.get(room).unwrap_or_else(|| panic!("ARCHITECTURE.md has no row of `{room}`"));
        let (mut reached, mut waiting) = (BTreeSet::new(), row.clone());
        while let Some(name) = waiting.pop() {
            if reached.insert(name.clone()) {
                waiting.extend(table.get(&name).into_iter().flatten().cloned());
            }
        }
        for name in row.iter().filter(|name| *name != "all" && *name != room) {
            assert!(allowed.contains(&&name[..]), "ARCHITECTURE.md lets `{room}` import `{name}`; ROOMS does not");
        }
        for name in allowed.iter().filter(|name| !helpers.contains(name) && row[0] != "all") {
            assert!(reached.contains(*name), "ROOMS lets `{room}` import `{name}`; ARCHITECTURE.md does not");
        }
    }
}

#[test]
fn no_import_goes_up() {
    let (sources, edges) = graph(Path::new("src"));
    let mut wrong = Vec::new();
    let mut across = 0;
    for (source, targets) in sources.iter().zip(&edges) {
        let Some(room) = source.module.first().filter(|room| !["main", "noise"].contains(&room.as_str())) else {
            continue;
        };
        let allowed = ROOMS
            .iter()
            .find(|(name, _)| name == room)
            .unwrap_or_else(|| panic!("the room `{room}` is not in the list"));
        for target in targets.iter().map(|t| &sources[*t].module).filter(|t| t[0] != *room) {
            across += 1;
            if !allowed.1.contains(&target[0].as_str()) {
                wrong.push(format!("{} -> {}", source.module.join("::"), target.join("::")));
            }
        }
    }
    assert!(across > 100, "only {across} imports between rooms were seen");
    assert!(wrong.is_empty(), "imports that go up:\n{}", wrong.join("\n"));
}

/// The imports that lie on circles.
fn circles(names: &[String], edges: &[BTreeSet<usize>]) -> Vec<String> {
    let reached = |from: usize| {
        let (mut seen, mut waiting) = (BTreeSet::new(), vec![from]);
        while let Some(i) = waiting.pop() {
            waiting.extend(edges[i].iter().filter(|j| seen.insert(**j)));
        }
        seen
    };
    let back: Vec<BTreeSet<usize>> = (0..names.len()).map(reached).collect();
    let arrows = (0..names.len()).flat_map(|i| edges[i].iter().map(move |j| (i, *j)));
    arrows.filter(|(i, j)| back[*j].contains(i)).map(|(i, j)| format!("{} -> {}", names[i], names[j])).collect()
}

#[test]
fn no_files_import_each_other_in_a_circle() {
    for root in ["src", "crates/capi/src", "crates/explorer/src", "crates/python/src"] {
        let (sources, edges) = graph(Path::new(root));
        let names: Vec<String> = sources.iter().map(|source| source.module.join("::")).collect();
        let all = circles(&names, &edges);
        assert!(all.is_empty(), "circles among the files of {root}:\n{}", all.join("\n"));
    }
}

/// The files of the package that a line of Python imports, in a file of this folder.
fn imported(line: &str, folder: &Path) -> Vec<PathBuf> {
    let Some((from, names)) = line.trim().strip_prefix("from .").and_then(|rest| rest.split_once("import ")) else {
        return Vec::new();
    };
    let module = from.trim().trim_start_matches('.');
    let above = folder.ancestors().nth(from.trim().len() - module.len()).unwrap();
    let place = above.join(module.replace('.', "/"));
    // A name is a module, whose source may be in another language, or else something in one.
    let files = |name: &str| {
        let inner = place.join(name);
        let all = [inner.with_extension("py"), inner.with_extension("pyi"), inner.join("__init__.py")];
        all.into_iter().chain([place.with_extension("py"), place.join("__init__.py")]).find(|file| file.exists())
    };
    names.split(',').filter_map(|name| files(name.split_whitespace().next()?)).collect()
}

#[test]
fn no_modules_of_the_python_package_import_each_other_in_a_circle() {
    let mut paths = Vec::new();
    files(Path::new("crates/python/python"), "py", &mut paths);
    paths.sort();
    let edges = paths.iter().map(|path| {
        let (text, folder) = (fs::read_to_string(path).unwrap(), path.parent().unwrap());
        let targets = text.lines().flat_map(|line| imported(line, folder));
        targets.filter_map(|target| paths.iter().position(|path| *path == target)).collect()
    });
    let edges: Vec<BTreeSet<usize>> = edges.collect();
    let seen: usize = edges.iter().map(BTreeSet::len).sum();
    assert!(seen > 20, "only {seen} imports were seen");
    let names: Vec<String> = paths.iter().map(|path| path.display().to_string()).collect();
    let all = circles(&names, &edges);
    assert!(all.is_empty(), "circles:\n{}", all.join("\n"));
}
