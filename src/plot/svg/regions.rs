//! Regions of a slice as areas between lines.

use super::lines::path;
use super::page::{Page, color, number};
use crate::plot::geometry::Point;
use crate::plot::hatch::{Hatch, Outline};
use crate::plot::palette::WHITE;
use crate::plot::regions::Regions;
use std::io;

/// Areas over each other, then hatched outlines.
pub(super) fn write(page: &mut Page, regions: &Regions) -> io::Result<()> {
    let plot = page.clip(regions.rect)?;
    page.around("g", &[("clip-path", &plot)], |page| {
        fills(page, regions)?;
        for (area, outline, inset) in regions.styled() {
            let rings = match inset {
                None => beyond(regions.rings(area), regions),
                Some(inset) => {
                    let rect = regions.rect.grown(-inset);
                    vec![[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| rect.at(x, y)).to_vec()]
                }
            };
            outlined(page, &rings, regions.hatch, outline)?;
        }
        Ok(())
    })
}

/// Rings with what lies on the border of the plot moved out of it: no line runs along there.
fn beyond(mut rings: Vec<Vec<Point>>, regions: &Regions) -> Vec<Vec<Point>> {
    let (rect, far) = (regions.rect, regions.rect.grown(2 * regions.hatch.band));
    let moved = |x: f64, sides: [i32; 4]| match sides.map(f64::from) {
        [low, _, far, _] if x <= low => far,
        [_, high, _, far] if x >= high => far,
        _ => x,
    };
    for [x, y] in rings.iter_mut().flatten() {
        *x = moved(*x, [rect.left, rect.right, far.left, far.right]);
        *y = moved(*y, [rect.top, rect.bottom, far.top, far.bottom]);
    }
    rings
}

/// Each area over those before it. Where a later one contrasts too little, an edge lies on the earlier.
fn fills(page: &mut Page, regions: &Regions) -> io::Result<()> {
    let (colors, edges) = (regions.colors(), regions.edges());
    let mut names = Vec::new();
    for area in &regions.fills {
        names.push(shared(page, &path(&regions.rings(area), true))?);
    }
    // Half of a line lies under the later area.
    let width = number(2.0 * f64::from(regions.edge));
    for (here, mine) in edges.iter().enumerate() {
        let fill = color(colors[here]);
        let mut clip = None;
        if let Some(link) = here.checked_sub(1).map(|under| &names[under]) {
            page.element("use", &[("xlink:href", link), ("fill", &fill), ("fill-rule", "evenodd")])?;
            clip = Some(cut_off(page, link)?);
        }
        // The last of several at one place counts: where it needs no edge, it takes away those before.
        let mut drawn = false;
        for (later, edge) in mine.iter().enumerate().skip(here + 1) {
            drawn |= edge.is_some();
            if drawn {
                let stroke = edge.map_or(fill.clone(), color);
                let mut all = vec![("xlink:href", &names[later - 1][..]), ("fill", "none"), ("stroke", &stroke)];
                all.push(("stroke-width", &width));
                all.extend(clip.iter().map(|clip| ("clip-path", &clip[..])));
                page.element("use", &all)?;
            }
        }
    }
    Ok(())
}

/// A path to be used several times: what to refer to it by.
fn shared(page: &mut Page, data: &str) -> io::Result<String> {
    let name = page.name();
    page.around("defs", &[], |page| page.element("path", &[("id", &name), ("d", data), ("clip-rule", "evenodd")]))?;
    Ok(format!("#{name}"))
}

/// What cuts off at such a path.
fn cut_off(page: &mut Page, link: &str) -> io::Result<String> {
    let name = page.name();
    page.around("clipPath", &[("id", &name)], |page| page.element("use", &[("xlink:href", link)]))?;
    Ok(format!("url(#{name})"))
}

/// A line along the inside of rings and stripes further in, in a white casing.
fn outlined(page: &mut Page, rings: &[Vec<Point>], hatch: Hatch, outline: Outline) -> io::Result<()> {
    let data = path(rings, true);
    if data.is_empty() {
        return Ok(());
    }
    let stripes = pattern(page, hatch, outline)?;
    let (link, white) = (shared(page, &data)?, color(WHITE));
    let clip = cut_off(page, &link)?;
    let stroke = |page: &mut Page, paint: &str, reach: i32| {
        let width = number(2.0 * f64::from(reach));
        page.element("use", &[("xlink:href", &link), ("fill", "none"), ("stroke", paint), ("stroke-width", &width)])
    };
    stroke(page, &white, hatch.rim)?;
    page.around("g", &[("clip-path", &clip)], |page| {
        stroke(page, &stripes, hatch.band)?;
        stroke(page, &white, hatch.line + hatch.rim)?;
        stroke(page, &color(outline.color), hatch.line)
    })
}

/// Stripes in their casing, to fill or to draw with.
pub(super) fn pattern(page: &mut Page, hatch: Hatch, outline: Outline) -> io::Result<String> {
    let name = page.name();
    // Across the stripes. The first lies at the upper end of the tile, and so at the lower end, too.
    let tile = hatch.period / std::f64::consts::SQRT_2;
    let (side, turn) = (number(tile), if outline.rising { "rotate(-45)" } else { "rotate(45)" });
    let attributes = [
        ("id", &name[..]),
        ("width", &side),
        ("height", &side),
        ("patternUnits", "userSpaceOnUse"),
        ("patternTransform", turn),
    ];
    page.around("pattern", &attributes, |page| {
        for (half, paint) in [(hatch.half + hatch.casing, WHITE), (hatch.half, outline.color)] {
            for top in [0.0, tile - half] {
                let (y, height, fill) = (number(top), number(half), color(paint));
                page.element("rect", &[("y", &y), ("width", &side), ("height", &height), ("fill", &fill)])?;
            }
        }
        Ok(())
    })?;
    Ok(format!("url(#{name})"))
}
