//! The shipped recipes still give the bytes of `atlases/manifest.toml`, and the committed pictures are theirs.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

fn hash(path: &Path) -> String {
    blake3::hash(&std::fs::read(path).unwrap()).to_hex().to_string()
}

/// Name and hash of every atlas and picture of a folder.
fn hashes(folder: &Path) -> BTreeMap<String, String> {
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let kept = files.filter(|path| path.extension().is_some_and(|e| e == "png" || e == "safetensors"));
    kept.map(|path| (path.file_name().unwrap().to_string_lossy().into_owned(), hash(&path))).collect()
}

#[test]
fn recipes_give_the_bytes_of_the_manifest() {
    let atlases = Path::new(env!("CARGO_MANIFEST_DIR")).join("atlases");
    let made = tempfile::tempdir().unwrap();
    let recipes = std::fs::read_dir(&atlases).unwrap().map(|entry| entry.unwrap().path());
    let is_recipe = |path: &PathBuf| path.extension().is_some_and(|e| e == "toml") && !path.ends_with("manifest.toml");
    // The cells of the shipped recipe take some ten minutes; coarser ones stand in for them.
    let coarse = made.path().join("coarse.toml");
    let full = std::fs::read_to_string(atlases.join("cells.toml")).unwrap();
    let changes = [("\"cells\"\nkind", "\"cells-coarse\"\nkind"), ("= 256", "= 32"), ("32 MiB", "1 MiB")];
    std::fs::write(&coarse, changes.iter().fold(full, |text, (from, to)| text.replacen(from, to, 1))).unwrap();
    for recipe in recipes.filter(is_recipe).filter(|path| !path.ends_with("cells.toml")).chain([coarse]) {
        let run = Command::new(env!("CARGO_BIN_EXE_spiral-atlas"))
            .args(["generate", "--backend", "cpu", "--out"])
            .arg(made.path())
            .arg(recipe)
            .output()
            .unwrap();
        assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    }
    let made = hashes(made.path());
    let fresh: String = made.iter().map(|(name, hash)| format!("\"{name}\" = \"{hash}\"\n")).collect();
    let manifest = std::fs::read_to_string(atlases.join("manifest.toml")).unwrap();
    let manifest: BTreeMap<String, String> = toml::from_str(&manifest).unwrap();
    assert_eq!(manifest.keys().collect::<Vec<_>>(), made.keys().collect::<Vec<_>>(), "a fresh manifest:\n{fresh}");
    let (mut pictures, mut wrong) = (0, Vec::new());
    for (name, hash) in &made {
        if *hash != manifest[name] {
            wrong.push(name);
        }
    }
    for (name, hash) in hashes(&atlases) {
        assert_eq!(manifest.get(&name), Some(&hash), "the committed {name}; a fresh manifest:\n{fresh}");
        pictures += 1;
    }
    assert!(wrong.is_empty() && pictures >= 11, "{wrong:?} differ; a fresh manifest:\n{fresh}");
}
