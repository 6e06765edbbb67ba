//! What pictures show, as the plain data that [`crate::plot`] draws: slices and small multiples of a grid.

use super::outlines;
use super::source::Subject;
use super::words::{angles, grouped, short};
use crate::error::{Error, Result};
use crate::eval::{Backend, Job, evaluate};
use crate::family::{self, Family, Flag};
use crate::grid::{Axis, Grid, Spacing};
use crate::plot::{self, AxisView, Caption, Mark, Multiples, Region, Sheet, Slice};
use crate::recipe::{Levels, Look, PictureKind, PicturePlan, is_angle};
use std::sync::atomic::AtomicBool;

/// The sheet for a look, of a usual size at the usual resolution.
pub(super) fn sheet(look: &Look, usual: (u32, u32)) -> Sheet {
    Sheet { size: look.pixels(usual), dpi: look.dpi }
}

/// The last two axes, at the middle of the others.
pub(super) fn middle_slice(grid: &Grid) -> Result<PicturePlan> {
    let counts = grid.shape();
    // Axes of several values, if there are two.
    let wide: Vec<usize> = (0..counts.len()).filter(|axis| counts[*axis] > 1).collect();
    let all: Vec<usize> = (0..counts.len()).collect();
    let [.., x, y] = if wide.len() > 1 { &wide } else { &all }[..] else {
        return Err(Error::invalid("an atlas of one axis has no slices; pictures need two axes"));
    };
    let others = all.iter().filter(|axis| ![x, y].contains(axis));
    let at = others.map(|axis| (*axis, vec![counts[*axis] / 2])).collect();
    Ok(PicturePlan {
        kind: PictureKind::Slice,
        x,
        y,
        at,
        regions: Vec::new(),
        outlines: Vec::new(),
        levels: None,
        marks: Vec::new(),
        look: Look::default(),
    })
}

/// The slice of a plan: the chosen node of each axis that is not drawn or, of a union, all chosen ones together.
///
/// # Errors
/// [`Error::Domain`] for a family that this program does not have.
pub(super) fn slice(subject: &Subject, plan: &PicturePlan) -> Result<Slice> {
    let axes = subject.grid.axes();
    let place = |(axis, nodes): &(usize, Vec<usize>)| match nodes[..] {
        [node] => place(&axes[*axis], node),
        [first, .., last] => {
            let (axis, count) = (&axes[*axis], nodes.len());
            let [first, last] = [first, last].map(|node| axis.values()[node]);
            let ends = values(axis, &[first, last]);
            format!("any of {count} {} from {} to {}", plot::symbol(axis.name()), ends[0], ends[1])
        }
        [] => String::new(),
    };
    let places: Vec<String> = plan.at.iter().map(place).collect();
    let title = format!("{}: {}", subject.name, places.join(", "));
    let mut slice = panel(subject, plan, &plan.at)?;
    if let PictureKind::Compare { with } = plan.kind {
        slice.regions = compared(subject, plan, with)?;
        slice.outlines = Vec::new();
    }
    slice.title = heading(plan, &title);
    let (x, y) = (slice.x.values.len() as u64, slice.y.values.len() as u64);
    slice.note = format!("{} × {} = {} nodes, each proved", grouped(x), grouped(y), grouped(x * y));
    slice.marks = plan.marks.iter().map(|m| Mark { x: m.x, y: m.y, label: m.label.clone() }).collect();
    Ok(slice)
}

/// The heading that the recipe chooses, or else this one, which may end with a colon.
pub(super) fn heading(plan: &PicturePlan, usual: &str) -> String {
    plan.look.title.as_deref().unwrap_or(usual.trim_end_matches([':', ' '])).to_owned()
}

/// Panels over the other axes. Those of one node are named in the heading; of the rest the slower ones make the rows,
/// upwards, and the faster ones the columns.
pub(super) fn multiples(subject: &Subject, plan: &PicturePlan) -> Result<Multiples> {
    let axes = subject.grid.axes();
    let (fixed, open): (Vec<_>, Vec<_>) = plan.at.iter().cloned().partition(|(_, nodes)| nodes.len() == 1);
    // As many slow axes make the rows as leave the grid of panels least long.
    let count = |of: &[Chosen]| of.iter().map(|(_, nodes)| nodes.len()).product::<usize>();
    let split = (0..open.len()).min_by_key(|split| count(&open[..*split]).max(count(&open[*split..]))).unwrap_or(0);
    let rows: Vec<Vec<Chosen>> = combinations(&open[..split]).into_iter().rev().collect();
    let columns = combinations(&open[split..]);
    let mut panels = Vec::new();
    for row in &rows {
        for column in &columns {
            panels.push(panel(subject, plan, &[&fixed[..], row, column].concat())?);
        }
    }
    let at: Vec<String> = fixed.iter().map(|(axis, nodes)| place(&axes[*axis], nodes[0])).collect();
    let title = format!("{}: {}", subject.name, at.join(", "));
    let nodes = panels.iter().map(|p| p.x.values.len() * p.y.values.len()).sum::<usize>();
    let of = open.iter().map(|(axis, nodes)| {
        format!("{} of {} {}", nodes.len(), axes[*axis].values().len(), plot::symbol(axes[*axis].name()))
    });
    let of = of.collect::<Vec<_>>().join(", ");
    let of = if of.is_empty() { "1 panel".to_owned() } else { format!("{} panels ({of})", panels.len()) };
    Ok(Multiples {
        title: heading(plan, &title),
        note: format!("{of}, {} nodes, each proved", grouped(nodes as u64)),
        shape: [rows.len(), columns.len()],
        columns: captions(axes, &open[split..], false),
        // The fastest axis is nearest to the panels.
        rows: captions(axes, &open[..split], true).into_iter().rev().collect(),
        panels,
    })
}

/// A line of captions for each axis: its values, each as often as a slower axis has values, over as many panels as
/// faster axes have. Those of rows run backwards, since the first row is the topmost.
fn captions(axes: &[Axis], chosen: &[Chosen], backwards: bool) -> Vec<Caption> {
    let count = |of: &[Chosen]| of.iter().map(|(_, nodes)| nodes.len()).product::<usize>();
    let caption = |(i, (axis, nodes)): (usize, &Chosen)| {
        let axis = &axes[*axis];
        let of = nodes.iter().map(|node| axis.values()[*node]).collect::<Vec<_>>();
        let mut texts = values(axis, &of);
        if backwards {
            texts.reverse();
        }
        let (slower, faster) = (count(&chosen[..i]), count(&chosen[i + 1..]));
        let values = texts.iter().cycle().take(slower * texts.len()).map(|value| (value.clone(), faster)).collect();
        Caption { name: format!("{} =", plot::symbol(axis.name())), values }
    };
    chosen.iter().enumerate().map(caption).collect()
}

/// An axis that is not drawn, and the nodes chosen of it.
type Chosen = (usize, Vec<usize>);

/// All ways to take one node of each axis, the last axis fastest; one empty way for no axes.
fn combinations(axes: &[Chosen]) -> Vec<Vec<Chosen>> {
    axes.iter().fold(vec![vec![]], |all, (axis, nodes)| {
        let longer =
            |way: Vec<Chosen>| nodes.iter().map(move |node| [way.clone(), vec![(*axis, vec![*node])]].concat());
        all.into_iter().flat_map(longer).collect()
    })
}

/// The flags on a plane of the atlas through nodes of the other axes, x fastest; where there are several, what is true
/// at any of them.
fn plane(subject: &Subject, plan: &PicturePlan, at: &[(usize, Vec<usize>)]) -> Result<Vec<u8>> {
    let Some(atlas) = subject.atlas else { return Ok(Vec::new()) };
    let axes = subject.grid.axes();
    let [x, y] = [plan.x, plan.y].map(|axis| axes[axis].values().len());
    let mut plane = vec![0; x * y];
    for combination in 0..at.iter().map(|(_, nodes)| nodes.len()).product() {
        let mut index = vec![0; axes.len()];
        let mut rest: usize = combination;
        for (axis, nodes) in at {
            index[*axis] = nodes[rest % nodes.len()];
            rest /= nodes.len();
        }
        for (place, byte) in plane.iter_mut().enumerate() {
            (index[plan.x], index[plan.y]) = (place % x, place / x);
            *byte |=
                atlas.flags(&index).ok_or_else(|| Error::invalid(format!("the node {index:?} is not in the atlas")))?;
        }
    }
    Ok(plane)
}

/// The regions of a plan on such a plane.
fn panel(subject: &Subject, plan: &PicturePlan, at: &[(usize, Vec<usize>)]) -> Result<Slice> {
    let family = subject.family;
    let (axes, flags, plane) = (subject.grid.axes(), family.about().flags, plane(subject, plan, at)?);
    let (x, y) = (&axes[plan.x], &axes[plan.y]);
    let region = |(bit, flag): (usize, &Flag)| {
        (bit, Region::of_nodes(flag.label, plane.iter().map(|byte| byte >> bit & 1 == 1).collect()))
    };
    let place = |name: &&str| flags.iter().enumerate().find(|(_, f)| f.name == *name);
    let nested = family.about().nested;
    let chosen = |places: &[usize]| places.iter().map(|i| region((*i, &flags[*i]))).collect::<Vec<_>>();
    let (x, y) = (view(x), view(y));
    let (regions, outlines) = if let Some(levels) = &plan.levels {
        (at_most(subject, plan, levels, at)?, Vec::new())
    } else {
        let (mut regions, mut outlines): (Vec<_>, Vec<_>) = if plan.regions.is_empty() {
            let others = flags.iter().enumerate().filter(|(_, f)| !nested.contains(&f.name));
            (nested.iter().filter_map(place).map(region).collect(), others.map(region).collect())
        } else {
            (chosen(&plan.regions), chosen(&plan.outlines))
        };
        // A union, or a plane of which nothing is known yet, has no verdicts between its nodes.
        if subject.atlas.is_some() && at.iter().all(|(_, nodes)| nodes.len() == 1) {
            let bits: Vec<_> = regions.iter().chain(&outlines).map(|(bit, region)| (*bit, &region.mask[..])).collect();
            let rings = outlines::rings(subject, plan, [&x, &y], at, &bits);
            let all = regions.iter_mut().chain(&mut outlines);
            all.zip(rings).for_each(|((_, region), rings)| region.rings = rings);
        }
        let alone = |all: Vec<(usize, Region)>| all.into_iter().map(|(_, region)| region).collect();
        (alone(regions), alone(outlines))
    };
    Ok(Slice { title: String::new(), x, y, regions, outlines, marks: Vec::new(), note: String::new(), counted: "node" })
}

/// Where a scalar is at most each level, on the plane through one node of each other axis: the largest first.
fn at_most(subject: &Subject, plan: &PicturePlan, levels: &Levels, at: &[(usize, Vec<usize>)]) -> Result<Vec<Region>> {
    let axes = subject.grid.axes();
    let [x, y] = [plan.x, plan.y].map(|axis| axes[axis].values().len());
    let mut index = vec![0; axes.len()];
    for (axis, nodes) in at {
        index[*axis] = nodes.first().copied().unwrap_or_default();
    }
    let nodes = subject.atlas.iter().flat_map(|atlas| (0..x * y).map(move |place| (atlas, place)));
    let values = nodes.map(|(atlas, place)| {
        (index[plan.x], index[plan.y]) = (place % x, place / x);
        let value = atlas.scalar(levels.field, &index);
        let value = value.ok_or_else(|| Error::invalid(format!("the atlas has no scalar `{}`", levels.field)))?;
        Ok(Some(value).filter(|value| *value != family::NO_VALUE))
    });
    let values: Vec<Option<f32>> = values.collect::<Result<_>>()?;
    let region = |level: &f64| {
        let mask = values.iter().map(|value| value.is_some_and(|value| f64::from(value) <= *level));
        Region::of_nodes(format!("{} ≤ {level}", levels.field), mask.collect())
    };
    Ok(levels.values.iter().rev().map(region).collect())
}

/// Where any spiral exists, where only this family has one, only the other, and both; the other is evaluated here.
fn compared(subject: &Subject, plan: &PicturePlan, with: &str) -> Result<Vec<Region>> {
    let (own, other) = (subject.family, family::by_name(with)?);
    let bit = |family: &dyn Family, name: &str| family.about().bit(name).unwrap_or_default();
    let (ours, theirs) = (plane(subject, plan, &plan.at)?, evaluated(other, subject, plan)?);
    let (a, b) = (bit(own, "SPIRAL"), bit(other, "SPIRAL"));
    let region = |label: String, holds: &dyn Fn(bool, bool) -> bool| {
        let mask = ours.iter().zip(&theirs).map(|(x, y)| holds(x >> a & 1 == 1, y >> b & 1 == 1)).collect();
        Region::of_nodes(label, mask)
    };
    let outer = own.about().nested.first().map_or(a, |name| bit(own, name));
    let outer_mask = ours.iter().map(|byte| byte >> outer & 1 == 1).collect();
    Ok(vec![
        Region::of_nodes(own.about().flags[outer].label, outer_mask),
        region(format!("{} only", own.about().name), &|a, b| a && !b),
        region(format!("{with} only"), &|a, b| b && !a),
        region("both".into(), &|a, b| a && b),
    ])
}

/// The flags of another family at the nodes of a slice, x fastest.
fn evaluated(family: &'static dyn Family, subject: &Subject, plan: &PicturePlan) -> Result<Vec<u8>> {
    if subject.atlas.is_none() {
        return Ok(Vec::new());
    }
    // The same axes, those that are not drawn at their one node.
    let mut axes = subject.grid.axes().to_vec();
    for (axis, nodes) in &plan.at {
        let values = nodes.iter().map(|node| axes[*axis].values()[*node]).collect();
        axes[*axis] = Axis::new(axes[*axis].name(), Spacing::Values(values))?;
    }
    let grid = Grid::new(axes)?;
    let mut flags: Vec<u8> = Vec::new();
    let job = Job { family, grid: &grid, scalars: &[] };
    evaluate(&job, &Backend::Cpu, 1, &AtomicBool::new(false), |chunk| {
        flags.extend_from_slice(&chunk.flags);
        Ok(())
    })?;
    let [x, y] = [plan.x, plan.y].map(|axis| grid.axes()[axis].values().len());
    let at = |(i, j): (usize, usize)| if plan.x < plan.y { i * y + j } else { j * x + i };
    Ok((0..x * y).map(|place| flags[at((place % x, place / x))]).collect())
}

pub(super) fn view(axis: &Axis) -> AxisView {
    let log = matches!(axis.spacing(), Spacing::Log { .. });
    AxisView { name: axis.name().into(), label: plot::symbol(axis.name()), values: axis.values().to_vec(), log }
}

/// `φ₀ = 0.7`, with as many digits as a reader wants.
pub(super) fn place(axis: &Axis, node: usize) -> String {
    format!("{} = {}", plot::symbol(axis.name()), value(axis, node))
}

fn value(axis: &Axis, node: usize) -> String {
    values(axis, &axis.values()[node..=node]).concat()
}

/// Values of an axis, all in one unit, with as many digits as a reader wants, or as tell them apart.
fn values(axis: &Axis, of: &[f64]) -> Vec<String> {
    let texts = if is_angle(axis.name()) { angles(of) } else { of.iter().map(|x| short(*x)).collect::<Vec<_>>() };
    let alike = (1..texts.len()).any(|i| texts[i] == texts[i - 1]);
    if alike { of.iter().map(|x| x.to_string().replace('-', "−")).collect() } else { texts }
}

#[cfg(test)]
mod tests;
