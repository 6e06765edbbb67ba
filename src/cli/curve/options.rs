//! Which options each family needs and which it takes.
//!
//! One command answers for all families, so that `--family` can be changed or left out without learning other words.
//! Conditions of clap's own cannot say what a family needs: they do not see a default value, and none forbids an option
//! for a value of another. So the options that were given are taken from clap, and each family names those it knows.

use super::super::{given, refuse_by};
use super::{Args, Family, reach, trig};
use clap::ArgMatches;
use clap::parser::ValueSource;
use spiral_atlas::family::trig_quintic::{Scaling, Shape};
use spiral_atlas::transition::segment::{Base, Target};
use spiral_atlas::transition::templates::{Segment, Template};
use spiral_atlas::transition::{Ends, Turn};

/// What all families between two ends need.
const ENDS: [&str; 6] = ["from", "to", "start-direction", "end-direction", "start-curvature", "end-curvature"];
/// How a segment is chosen.
const SHAPE: [&str; 3] = ["to", "m", "q"];
/// What every family takes.
const ALL: [&str; 7] = ["family", "points", "longest", "samples", "csv", "figure", "json"];

/// The options that were given, by name, without those of [`ALL`].
#[derive(Debug)]
pub(super) struct Given(Vec<String>);

impl clap::FromArgMatches for Given {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Given, clap::Error> {
        let typed = matches.ids().filter(|id| matches.value_source(id.as_str()) == Some(ValueSource::CommandLine));
        let names = typed.map(|id| id.as_str().replace('_', "-"));
        Ok(Given(names.collect()))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Given::from_arg_matches(matches)?;
        Ok(())
    }
}

/// It has no option of its own.
impl clap::Args for Given {
    fn augment_args(command: clap::Command) -> clap::Command {
        command
    }

    fn augment_args_for_update(command: clap::Command) -> clap::Command {
        command
    }
}

impl Args {
    /// Ends the program unless all of `needed` are given and nothing but them and `allowed`.
    pub(crate) fn check(&self, needed: &[&str], allowed: &[&str]) {
        let given = |name: &str| self.given.0.iter().any(|given| given == name);
        let list = |names: Vec<&str>| names.iter().map(|n| format!("`--{n}`")).collect::<Vec<_>>().join(", ");
        let missing: Vec<&str> = needed.iter().copied().filter(|name| !given(name)).collect();
        if !missing.is_empty() {
            self.refuse(&format!("`{}` needs {} too", self.asked(), list(missing)), needed, allowed);
        }
        let known = |name: &str| needed.contains(&name) || allowed.contains(&name) || ALL.contains(&name);
        let surplus: Vec<&str> = self.given.0.iter().map(String::as_str).filter(|name| !known(name)).collect();
        if !surplus.is_empty() {
            self.refuse(&format!("{} means nothing to `{}`", list(surplus), self.asked()), needed, allowed);
        }
    }

    /// The option that says which others are needed.
    fn asked(&self) -> String {
        match &self.template {
            _ if self.points.is_some() => "--points".into(),
            Some(name) if self.family == Family::TrigQuintic => format!("--template {name}"),
            _ => format!("--family {}", self.family.name()),
        }
    }

    /// Ends the program, with the options of this family as the usage.
    fn refuse(&self, what: &str, needed: &[&str], allowed: &[&str]) -> ! {
        let command = given();
        let typed = |name: &str| {
            let known = command.get_arguments().find(|arg| arg.get_long() == Some(name));
            known.map_or_else(|| format!("--{name}"), |arg| arg.to_string())
        };
        let mut usage = format!("spiral-atlas curve --family {}", self.family.name());
        usage.extend(self.points.iter().map(|_| format!(" {}", typed("points"))));
        usage.extend(needed.iter().map(|name| match &self.template {
            Some(template) if *name == "template" => format!(" --template {template}"),
            _ => format!(" {}", typed(name)),
        }));
        usage.extend(allowed.iter().map(|name| format!(" [{}]", typed(name))));
        refuse_by(command.override_usage(usage + " [OPTIONS]"), what)
    }

    /// The two ends, of a family that knows also the options `more`.
    pub(crate) fn ends(&self, more: &[&str]) -> Ends {
        self.check(&ENDS, more);
        Ends {
            start: self.from.unwrap_or_default(),
            end: self.to.unwrap_or_default(),
            start_direction: self.start_direction.unwrap_or_default(),
            end_direction: self.end_direction.unwrap_or_default(),
            start_curvature: self.start_curvature.unwrap_or_default(),
            end_curvature: self.end_curvature.unwrap_or_default(),
        }
    }

    /// The segment to add.
    pub(crate) fn segment(&self) -> reach::Request {
        let needed = ["from", "start-direction", "base", "turn", "radius", "angle"];
        let target = match (self.to, self.m, self.q) {
            (Some(point), None, None) => Target::Point(point),
            (None, Some(m), Some(q)) => Target::Shape { m, q },
            _ => self.refuse("a segment needs its end point `--to` or its shape `--m` and `--q`", &needed, &SHAPE),
        };
        self.check(&needed, &SHAPE);
        reach::Request {
            base: if self.base.as_deref() == Some("circle") { Base::Circle } else { Base::Line },
            start: self.from.unwrap_or_default(),
            direction: self.start_direction.unwrap_or_default(),
            turn: if self.turn.as_deref() == Some("right") { Turn::Right } else { Turn::Left },
            radius: self.radius.unwrap_or_default(),
            theta: self.angle.unwrap_or_default(),
            target,
        }
    }

    /// The template and where it lies.
    pub(crate) fn template(&self) -> trig::Request {
        let name = self.template.as_deref().unwrap_or_default();
        let mut needed = vec!["template", "from", "start-direction", "turn", "radius", "angle", "m"];
        let mut allowed = vec!["ratio", "p", "q", "as-printed"];
        match name {
            "circle-in-circle" => needed.push("outer"),
            "line-circle" => {}
            _ => allowed.push("second"),
        }
        self.check(&needed, &allowed);
        let (m, radius) = (self.m.unwrap_or_default(), self.radius.unwrap_or_default());
        let ratio = self.ratio.unwrap_or(if self.as_printed { 0.5 * (6.0 + m) } else { 6.0 });
        let shape = Shape {
            ratio,
            theta: self.angle.unwrap_or_default(),
            m,
            p: self.p.unwrap_or_default(),
            q: self.q.unwrap_or_default(),
        };
        let first = Segment { shape, radius };
        let second = self.second.map_or(first, |[theta, radius, ratio, m, p, q]| Segment {
            shape: Shape { ratio, theta, m, p, q },
            radius,
        });
        trig::Request {
            template: match name {
                "line-circle" => Template::LineCircle(first),
                "line-line" => Template::LineLine { first, second },
                "s" => Template::S { first, second },
                "c" => Template::C { first, second },
                _ => Template::CircleInCircle { inner: first, outer: self.outer.unwrap_or_default() },
            },
            at: self.from.unwrap_or_default(),
            direction: self.start_direction.unwrap_or_default(),
            turn: if self.turn.as_deref() == Some("right") { Turn::Right } else { Turn::Left },
            scaling: if self.as_printed { Scaling::AsPrinted } else { Scaling::Corrected },
        }
    }
}
