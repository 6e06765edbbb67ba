//! Any spiral: the verdicts against an oracle, the curves against reference data and their own promises.

mod cross;
mod curves;
mod figures;
mod judge;
mod region;
mod scalars;
mod verdicts;

use crate::oracle::{iv, random};

pub(crate) use judge::judge;

pub(crate) use random::Random;
use spiral_atlas::family::{Code, by_name};
use spiral_atlas::grid::{Axis, Grid, Spacing};

/// alpha, beta, k1, k2.
pub(crate) type Datum = [f64; 4];

/// One node in the chord's chart.
pub(crate) fn grid_of(datum: Datum) -> Grid {
    let axis = |(name, x): (&str, f64)| Axis::new(name, Spacing::Values(vec![x])).expect("a finite value");
    Grid::new(["alpha", "beta", "k1", "k2"].into_iter().zip(datum).map(axis).collect()).expect("four axes")
}

/// What the f64 step and the interval step say.
pub(crate) fn codes_of(datum: Datum) -> (Code, Code) {
    let grid = grid_of(datum);
    let table = by_name("any-spiral").expect("the family").table(&grid).expect("in the domain");
    let mut fast = [Code(0x5aa5)];
    table.filter(0, &mut fast);
    (fast[0], table.exact(0).expect("decided").0)
}

impl Random {
    /// Of either sign, ten to a uniform exponent.
    pub(crate) fn signed_decades(&mut self, lo: f64, hi: f64) -> f64 {
        let sign = if self.below(2) == 0 { 1.0 } else { -1.0 };
        sign * 10f64.powf(self.uniform(lo, hi))
    }

    /// A datum for which spirals are common: k1 and k2 on the sides of the bound that ω asks for.
    pub(crate) fn likely(&mut self) -> Datum {
        use std::f64::consts::PI;
        let (alpha, beta) = (self.uniform(-PI, PI), self.uniform(-PI, PI));
        let side = if alpha + beta > 0.0 { 1.0 } else { -1.0 };
        let need = (0.5 * (alpha + beta)).sin().powi(2);
        let room0 = 10f64.powf(self.uniform(-1.5, 1.5));
        let room1 = need / room0 * (1.0 + 10f64.powf(self.uniform(-4.0, 2.0)));
        [alpha, beta, -side * room0 - alpha.sin(), side * room1 + beta.sin()]
    }
}

/// The shipped recipe is accepted, its axes lie in the domain, and its pictures show something.
#[cfg(feature = "cli")]
#[test]
fn the_recipe_is_in_the_domain() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("atlases/any-spiral.toml");
    let recipe = spiral_atlas::recipe::Recipe::read(path).unwrap();
    assert_eq!(recipe.atlases.len(), 3);
    for atlas in &recipe.atlases {
        assert_eq!((atlas.family.about().name, &atlas.scalars[..]), ("any-spiral", &[0, 2][..]));
        let table = atlas.family.table(&atlas.grid).unwrap();
        let mut codes = vec![Code::UNDECIDED; atlas.grid.len() as usize];
        table.filter(0, &mut codes);
        let exist = codes.iter().filter(|c| **c != Code::UNDECIDED && c.flags() & 1 != 0).count();
        assert!(exist * 8 > codes.len() && exist < codes.len(), "{}: {exist} of {}", atlas.name, codes.len());
    }
    let mark = &recipe.atlases[1].pictures[0].marks[0];
    assert!(codes_of([-2.0 * std::f64::consts::PI / 3.0, std::f64::consts::PI, mark.x, mark.y]).1.flags() & 1 != 0);
}
