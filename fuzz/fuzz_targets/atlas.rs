//! The reader of atlas files: any bytes give an error, or an atlas whose every part can be looked at.
#![no_main]

use libfuzzer_sys::fuzz_target;
use spiral_atlas::atlas::Atlas;

fuzz_target!(|bytes: &[u8]| {
    let Ok(atlas) = Atlas::from_bytes(bytes) else { return };
    let _ = atlas.check_hashes();
    let (grid, axes) = (atlas.grid(), atlas.grid().axes().len());
    let last = grid.len() - 1;
    let found = atlas.nearest(&grid.node(last)[..axes]).expect("a node is nearest to itself");
    assert_eq!((found.0, Some(found.1)), (last, atlas.at(&grid.index(last)[..axes])));
    for name in atlas.scalar_names() {
        assert_eq!(atlas.scalar(name).map(<[f32]>::len), Some(atlas.flags().len()));
    }
});
