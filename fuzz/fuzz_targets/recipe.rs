//! The reader of recipes: any text gives an error, or a recipe whose every index points somewhere.
#![no_main]

use libfuzzer_sys::fuzz_target;
use spiral_atlas::recipe::Recipe;

fuzz_target!(|text: &str| {
    let Ok(recipe) = Recipe::parse(text) else { return };
    assert!(!recipe.atlases.is_empty());
    for atlas in &recipe.atlases {
        assert!(atlas.scalars.iter().all(|i| *i < atlas.family.about().scalars.len()));
        let shape = atlas.grid.shape();
        for picture in &atlas.pictures {
            assert!(picture.x != picture.y && picture.x < shape.len() && picture.y < shape.len());
            assert!(picture.at.iter().all(|(axis, nodes)| nodes.iter().all(|node| *node < shape[*axis])));
        }
    }
});
