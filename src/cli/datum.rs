//! Data for any family, from options or from the columns of a table: an option for each axis that some family has.

use clap::{Arg, ArgMatches, Command, FromArgMatches};
use spiral_atlas::Result;
use spiral_atlas::family::{self, Chart, Family};
use spiral_atlas::recipe::parse_coordinate;

/// A datum in one of its family's charts.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Datum {
    /// Index of the chart.
    pub chart: usize,
    /// Coordinates in the order of its axes.
    pub point: Vec<f64>,
}

/// The coordinates given as options.
#[derive(Debug, Clone)]
pub(super) struct Coordinates(Vec<(&'static str, f64)>);

/// The names of all axes of all families.
fn names() -> Vec<&'static str> {
    let mut names: Vec<&str> = Vec::new();
    for axis in family::all().iter().flat_map(|f| f.about().charts).flat_map(|c| c.axes) {
        if !names.contains(axis) {
            names.push(axis);
        }
    }
    names
}

/// The families that have an axis.
fn owners(axis: &str) -> String {
    let has = |f: &&&dyn Family| f.about().charts.iter().any(|c| c.axes.contains(&axis));
    family::all().iter().filter(has).map(|f| f.about().name).collect::<Vec<_>>().join(", ")
}

impl clap::Args for Coordinates {
    fn augment_args(command: Command) -> Command {
        names().into_iter().fold(command, |command, name| {
            let arg = Arg::new(name)
                .long(name)
                .value_name(if spiral_atlas::recipe::is_angle(name) { "ANGLE" } else { "NUMBER" })
                .value_parser(move |text: &str| parse_coordinate(name, text))
                .allow_hyphen_values(true)
                .conflicts_with("points")
                .help_heading("The datum")
                .help(format!("Coordinate {name} of {}", owners(name)));
            command.arg(arg)
        })
    }

    fn augment_args_for_update(command: Command) -> Command {
        Coordinates::augment_args(command)
    }
}

impl FromArgMatches for Coordinates {
    fn from_arg_matches(matches: &ArgMatches) -> std::result::Result<Coordinates, clap::Error> {
        Ok(Coordinates(names().into_iter().filter_map(|name| Some((name, *matches.get_one(name)?))).collect()))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> std::result::Result<(), clap::Error> {
        *self = Coordinates::from_arg_matches(matches)?;
        Ok(())
    }
}

impl Coordinates {
    /// The datum of a family, or what is missing or too much.
    pub(super) fn datum(&self, family: &dyn Family) -> std::result::Result<Datum, String> {
        let given: Vec<&str> = self.0.iter().map(|(name, _)| *name).collect();
        let chart = chart(family, &given).filter(|chart| chart.1.axes.len() == given.len());
        let Some((chart, Chart { axes, .. })) = chart else {
            let list = |axes: &[&str]| axes.iter().map(|a| format!("--{a}")).collect::<Vec<_>>().join(" ");
            let charts: Vec<String> = family.about().charts.iter().map(|c| format!("`{}`", list(c.axes))).collect();
            let given = if given.is_empty() { "none".into() } else { format!("`{}`", list(&given)) };
            return Err(format!("a datum of `{}` needs {}; given: {given}", family.about().name, charts.join(" or ")));
        };
        let value = |axis: &&str| self.0.iter().find(|(name, _)| name == axis).map(|(_, x)| *x);
        Ok(Datum { chart, point: axes.iter().filter_map(value).collect() })
    }
}

impl Coordinates {
    /// A chart of a family and its coordinates, where some of them, which are 0 here, must not be given.
    pub(super) fn but(
        &self,
        family: &dyn Family,
        free: &[&str],
    ) -> std::result::Result<(&'static [&'static str], Vec<f64>), String> {
        if let Some(name) = free.iter().find(|name| self.0.iter().any(|(given, _)| given == *name)) {
            return Err(format!("--{name} is given, but it is what varies; leave it out"));
        }
        if let Some(name) = free.iter().find(|name| !family.about().charts.iter().any(|c| c.axes.contains(name))) {
            let known: Vec<String> = family.about().charts.iter().map(|c| c.axes.join(", ")).collect();
            return Err(format!(
                "`{}` has no coordinate {name:?}; it has {}",
                family.about().name,
                known.join(", or ")
            ));
        }
        let chart =
            family.about().charts.iter().find(|c| c.axes.iter().filter(|a| free.contains(a)).count() == free.len());
        let mut all = self.clone();
        let axes = chart.iter().flat_map(|c| c.axes.iter());
        all.0.extend(axes.filter(|axis| free.contains(axis)).map(|axis| (*axis, 0.0)));
        let datum = all.datum(family)?;
        Ok((family.about().charts[datum.chart].axes, datum.point))
    }
}

/// The first chart of a family whose axes are all among these.
fn chart(family: &dyn Family, names: &[&str]) -> Option<(usize, &'static Chart)> {
    family.about().charts.iter().enumerate().find(|(_, chart)| chart.axes.iter().all(|axis| names.contains(axis)))
}

/// A datum from the cells of a row, in the order of the chart's axes.
pub(super) fn from_cells(family: &dyn Family, chart: usize, cells: &[&str]) -> Result<Datum> {
    let axes = family.about().charts[chart].axes;
    let point = axes.iter().zip(cells).map(|(axis, cell)| parse_coordinate(axis, cell)).collect::<Result<_>>()?;
    Ok(Datum { chart, point })
}
