//! Python bindings of Spiral Atlas: `import spiral_atlas`. The Python side of the package is in `python/spiral_atlas/`.

mod atlas;
mod cells;
mod curve;
mod error;
mod family;
mod generate;
mod given;
mod join;
mod legend;
mod outline;
mod path;
mod picture;
mod question;
mod writer;

use pyo3::prelude::*;

/// Proved atlases of spiral regions. What is documented here is public as `spiral_atlas`.
#[pymodule]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("NO_VALUE", spiral_atlas::family::NO_VALUE)?;
    error::add(module)?;
    module.add_class::<atlas::Atlas>()?;
    module.add_class::<cells::Cells>()?;
    module.add_class::<curve::Curve>()?;
    module.add_class::<curve::Fit>()?;
    module.add_class::<join::Join>()?;
    module.add_class::<outline::Outline>()?;
    module.add_class::<picture::Picture>()?;
    module.add_class::<writer::Writer>()?;
    module.add_function(wrap_pyfunction!(writer::blake3, module)?)?;
    module.add_function(wrap_pyfunction!(atlas::open, module)?)?;
    module.add_function(wrap_pyfunction!(cells::open_cells, module)?)?;
    module.add_function(wrap_pyfunction!(curve::fit, module)?)?;
    module.add_function(wrap_pyfunction!(join::join, module)?)?;
    module.add_function(wrap_pyfunction!(path::path, module)?)?;
    module.add_function(wrap_pyfunction!(family::families, module)?)?;
    module.add_function(wrap_pyfunction!(family::solve, module)?)?;
    module.add_function(wrap_pyfunction!(family::solve_batch, module)?)?;
    module.add_function(wrap_pyfunction!(question::ranges, module)?)?;
    module.add_function(wrap_pyfunction!(question::nearest, module)?)?;
    module.add_function(wrap_pyfunction!(question::boundary, module)?)?;
    module.add_function(wrap_pyfunction!(generate::generate, module)?)
}
