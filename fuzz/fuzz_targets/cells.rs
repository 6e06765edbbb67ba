//! The reader of files of cells: any bytes give an error, or cells whose every part can be looked up.
#![no_main]

use libfuzzer_sys::fuzz_target;
use spiral_atlas::cells::Cells;

fuzz_target!(|bytes: &[u8]| {
    let Ok(cells) = Cells::from_bytes(bytes) else { return };
    let _ = cells.check_hashes();
    let (grid, axes) = (cells.grid(), cells.grid().axes().len());
    // Nodes all over the grid, which are corners of finest cells.
    for part in 0..64 {
        let node = (u128::from(grid.len() - 1) * part / 63) as u64;
        let known = cells.lookup(&grid.node(node)[..axes]).expect("a node lies in the box");
        assert_eq!(known.inside & known.outside, 0);
    }
});
