use super::Recipe;
use crate::steps::counted;

/// A grid that is too large is refused before any value of its axes is made.
#[test]
fn a_grid_that_is_too_large_has_no_axes() {
    let recipe = |counts: [usize; 2]| {
        let axes = counts.map(|count| format!("{{ log = [1, 2], count = {count} }}"));
        format!(
            "family = \"cubic\"\n[[atlas]]\nname = \"a\"\naxes.phi0 = {{ values = [0.7] }}\n\
             axes.phi1 = {{ values = [1.4] }}\naxes.kappa0 = {}\naxes.kappa1 = {}\n",
            axes[0], axes[1]
        )
    };
    for (counts, what) in [
        ([1 << 24, 1 << 24], "the grid has more than 17592186044416 nodes; split it"),
        ([1 << 24, 1 << 25], "axis `kappa1` has count 33554432; it must be 2 to 16777216"),
        ([1 << 24, 1], "axis `kappa1` has count 1; it must be 2 to"),
    ] {
        let (steps, read) = counted(|| Recipe::parse(&recipe(counts)).map(|_| ()));
        let told = read.unwrap_err().to_string();
        assert!(steps == 0 && told.contains(what), "{steps} values: {told}");
    }
    let (steps, read) = counted(|| Recipe::parse(&recipe([40, 3])).map(|recipe| recipe.atlases[0].grid.len()));
    assert_eq!((steps, read.unwrap()), (43, 120));
}
