//! Data for any family, from options or from the columns of a table: an option for each axis that some family has.

use clap::{Arg, ArgMatches, Command, FromArgMatches};
use spiral_atlas::family::{self, Chart, Family};
use spiral_atlas::recipe::parse_coordinate;
use spiral_atlas::{Error, Result};

/// A datum in one of its family's charts.
#[derive(Debug, Clone, PartialEq)]
pub struct Datum {
    /// Index of the chart.
    pub chart: usize,
    /// Coordinates in the order of its axes.
    pub point: Vec<f64>,
}

/// The coordinates given as options.
#[derive(Debug, Clone)]
pub struct Coordinates(Vec<(&'static str, f64)>);

/// The names of all axes of all families.
fn names() -> Vec<&'static str> {
    let mut names: Vec<&str> = Vec::new();
    for axis in family::all().iter().flat_map(|f| f.charts()).flat_map(|c| c.axes) {
        if !names.contains(axis) {
            names.push(axis);
        }
    }
    names
}

/// The families that have an axis.
fn owners(axis: &str) -> String {
    let has = |f: &&&dyn Family| f.charts().iter().any(|c| c.axes.contains(&axis));
    family::all().iter().filter(has).map(|f| f.name()).collect::<Vec<_>>().join(", ")
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
    pub fn datum(&self, family: &dyn Family) -> std::result::Result<Datum, String> {
        let given: Vec<&str> = self.0.iter().map(|(name, _)| *name).collect();
        let chart = chart(family, &given).filter(|chart| chart.1.axes.len() == given.len());
        let Some((chart, Chart { axes, .. })) = chart else {
            let list = |axes: &[&str]| axes.iter().map(|a| format!("--{a}")).collect::<Vec<_>>().join(" ");
            let charts: Vec<String> = family.charts().iter().map(|c| format!("`{}`", list(c.axes))).collect();
            let given = if given.is_empty() { "none".into() } else { format!("`{}`", list(&given)) };
            return Err(format!("a datum of `{}` needs {}; given: {given}", family.name(), charts.join(" or ")));
        };
        let value = |axis: &&str| self.0.iter().find(|(name, _)| name == axis).map(|(_, x)| *x);
        Ok(Datum { chart, point: axes.iter().filter_map(value).collect() })
    }
}

/// The first chart of a family whose axes are all among these.
fn chart(family: &dyn Family, names: &[&str]) -> Option<(usize, &'static Chart)> {
    family.charts().iter().enumerate().find(|(_, chart)| chart.axes.iter().all(|axis| names.contains(axis)))
}

/// Where in the rows of a table the coordinates are.
#[derive(Debug, PartialEq)]
pub struct Header {
    chart: usize,
    axes: &'static [&'static str],
    places: Vec<usize>,
    count: usize,
}

impl Header {
    /// Reads the header line.
    pub fn parse(family: &dyn Family, line: &str) -> std::result::Result<Header, String> {
        let cells: Vec<&str> = cells(line.trim_start_matches('\u{feff}')).collect();
        let Some((chart, Chart { axes, .. })) = chart(family, &cells) else {
            return Err(format!("the header is {:?}; it must have the columns {}", line.trim(), columns(family)));
        };
        let place = |axis: &&str| {
            let mut found = cells.iter().enumerate().filter(|(_, cell)| *cell == axis).map(|(i, _)| i);
            let first = found.next().unwrap_or_default();
            if found.next().is_none() { Ok(first) } else { Err(format!("the header has two columns `{axis}`")) }
        };
        let places = axes.iter().map(place).collect::<std::result::Result<_, _>>()?;
        Ok(Header { chart, axes, places, count: cells.len() })
    }

    /// Reads a row.
    pub fn datum(&self, line: &str) -> std::result::Result<Datum, String> {
        let count = cells(line).count();
        if count != self.count {
            return Err(format!("the row has {count} values; the header has {}", self.count));
        }
        let value = |(axis, place): (&&str, &usize)| parse_coordinate(axis, cells(line).nth(*place).unwrap_or_default());
        let point = self.axes.iter().zip(&self.places).map(value).collect::<Result<_>>().map_err(|e| e.to_string())?;
        Ok(Datum { chart: self.chart, point })
    }
}

/// The columns that a table of a family's data may have.
pub fn columns(family: &dyn Family) -> String {
    family.charts().iter().map(|c| c.axes.join(",")).collect::<Vec<_>>().join(" or ")
}

/// The cells of a line, without blanks and quotation marks around them.
fn cells(line: &str) -> impl Iterator<Item = &str> {
    line.split(',').map(|cell| cell.trim().trim_matches('"').trim())
}

/// The family of a name, for an option.
pub fn parse_family(name: &str) -> Result<&'static dyn Family> {
    family::by_name(name).ok_or_else(|| {
        let known: Vec<&str> = family::all().iter().map(|f| f.name()).collect();
        Error::Domain(format!("unknown family `{name}`; known are `{}`", known.join("`, `")))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use spiral_atlas::family::cubic::Cubic;

    #[test]
    fn headers_say_where_columns_are() {
        let parse = |line| Header::parse(&Cubic, line);
        let plain = parse("phi0,phi1,kappa0,kappa1\r\n").unwrap();
        assert_eq!((plain.chart, &plain.places[..], plain.count), (0, &[0, 1, 2, 3][..], 4));
        let other = parse("\u{feff}\"kappa1\", id ,phi1,\"phi0\",kappa0").unwrap();
        assert_eq!((&other.places[..], other.count), (&[3, 2, 4, 0][..], 5));
        let datum = other.datum("4,\"x\",90deg,0.7 , \"-0.4\"").unwrap();
        assert_eq!(datum.point, [0.7, std::f64::consts::FRAC_PI_2, -0.4, 4.0]);
        assert_eq!(
            parse("phi0,phi1,a,k").unwrap().datum("1,1,0.5,0.25").unwrap(),
            Datum { chart: 1, point: vec![1.0, 1.0, 0.5, 0.25] }
        );
        assert!(parse("phi0,phi1,kappa0,kapa1").unwrap_err().contains("kapa1"));
        assert!(parse("phi0,phi1,kappa0,kappa1,phi0").unwrap_err().contains("two columns"));
        assert!(plain.datum("1,2,3").unwrap_err().contains("3 values"));
        assert!(plain.datum("1,2,3deg,4").unwrap_err().contains("kappa0: \"3deg\""));
    }
}
