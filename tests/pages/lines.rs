//! Lines of code and prose end by column 120.

use std::path::{Path, PathBuf};

const WIDTH: usize = 120;
const KINDS: [&str; 12] = ["c", "cpp", "css", "h", "hpp", "html", "js", "md", "py", "rs", "toml", "wgsl"];
/// Folders of files that are made, not written.
const MADE: [&str; 3] = ["target", "node_modules", "venv"];

/// The numbers of the lines that are too long.
///
/// Left out: rows of Markdown's tables, which cannot be broken, and lines without a blank, such as addresses.
fn too_long(text: &str, markdown: bool) -> Vec<usize> {
    let free = |line: &str| markdown && line.trim_start().starts_with('|') || !line.trim().contains(' ');
    let long = |line: &str| line.chars().count() > WIDTH && !free(line);
    text.lines().enumerate().filter(|(_, line)| long(line)).map(|(i, _)| i + 1).collect()
}

/// The written files of a folder and those within it.
fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap()) {
        let (path, name) = (entry.path(), entry.file_name().into_string().unwrap());
        if entry.file_type().unwrap().is_dir() {
            if !name.starts_with('.') && !MADE.contains(&&name[..]) {
                files(&path, found);
            }
        } else if path.extension().is_some_and(|kind| KINDS.iter().any(|known| kind == *known)) {
            found.push(path);
        }
    }
}

#[test]
fn lines_end_by_column_120() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found = Vec::new();
    files(root, &mut found);
    // The text of a shipped recipe is in its atlas, whose bytes are kept.
    found.retain(|path| path.parent() != Some(&root.join("atlases")) || path.ends_with("manifest.toml"));
    assert!(found.len() > 500, "{}", found.len());
    let mut long = Vec::new();
    for path in found {
        let text = std::fs::read_to_string(&path).unwrap();
        let place = path.strip_prefix(root).unwrap().display();
        let lines = too_long(&text, path.extension().is_some_and(|kind| kind == "md"));
        long.extend(lines.iter().map(|line| format!("{place}:{line}")));
    }
    assert!(long.is_empty(), "lines of more than {WIDTH} characters:\n{}", long.join("\n"));
}

#[test]
fn what_is_too_long_is_found() {
    let words = "κ ".repeat(61);
    let text = format!("{}\n{words}\n| {words}|\n{}\n", &words[..3 * 60], "https://example.org/".repeat(9));
    assert_eq!(too_long(&text, true), [2]);
    assert_eq!(too_long(&text, false), [2, 3]);
}
