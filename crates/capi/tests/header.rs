//! The committed header says what the code says.

use std::path::Path;

#[test]
fn the_header_is_fresh() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_file(root.join("cbindgen.toml")).expect("cbindgen.toml");
    let mut fresh = Vec::new();
    cbindgen::Builder::new().with_crate(root).with_config(config).generate().expect("a header").write(&mut fresh);
    let path = root.join("include/spiral_atlas.h");
    if std::env::var_os("SPIRAL_ATLAS_UPDATE").is_some() {
        std::fs::write(&path, &fresh).expect("writable");
    }
    let committed = std::fs::read(&path).unwrap_or_default();
    assert!(
        committed == fresh,
        "include/spiral_atlas.h is old: SPIRAL_ATLAS_UPDATE=1 cargo test -p spiral-atlas-capi renews it"
    );
}
