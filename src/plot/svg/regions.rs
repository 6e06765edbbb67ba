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
                None => regions.rings(area),
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

/// Each area, under it the paper. Where a later one covers it and contrasts too little, an edge lies on the earlier.
fn fills(page: &mut Page, regions: &Regions) -> io::Result<()> {
    let (colors, edges) = (regions.colors(), regions.edges());
    let paths: Vec<String> = regions.fills.iter().map(|area| path(&regions.rings(area), true)).collect();
    let mut names = Vec::new();
    for data in &paths {
        let name = page.name();
        page.around("defs", &[], |page| page.element("path", &[("id", &name), ("d", data), ("clip-rule", "evenodd")]))?;
        names.push(name);
    }
    // Half of a line lies under the later area.
    let width = number(2.0 * f64::from(regions.edge));
    for (here, mine) in edges.iter().enumerate() {
        let mut attributes = Vec::new();
        let clip = page.name();
        if let Some(under) = here.checked_sub(1) {
            let (name, fill) = (format!("#{}", names[under]), color(colors[here]));
            page.element("use", &[("href", &name), ("fill", &fill), ("fill-rule", "evenodd")])?;
            page.around("clipPath", &[("id", &clip)], |page| page.element("use", &[("href", &name)]))?;
            attributes.push(format!("url(#{clip})"));
        }
        for (later, edge) in mine.iter().enumerate().skip(here + 1) {
            let Some(edge) = edge else { continue };
            let (name, stroke) = (format!("#{}", names[later - 1]), color(*edge));
            let mut all = vec![("href", &name[..]), ("fill", "none"), ("stroke", &stroke), ("stroke-width", &width)];
            all.extend(attributes.iter().map(|clip| ("clip-path", &clip[..])));
            page.element("use", &all)?;
        }
    }
    Ok(())
}

/// A line along the inside of rings and stripes further in, in a white casing.
fn outlined(page: &mut Page, rings: &[Vec<Point>], hatch: Hatch, outline: Outline) -> io::Result<()> {
    let data = path(rings, true);
    if data.is_empty() {
        return Ok(());
    }
    let stripes = pattern(page, hatch, outline)?;
    let (name, clip) = (page.name(), page.name());
    let (link, white) = (format!("#{name}"), color(WHITE));
    page.around("defs", &[], |page| page.element("path", &[("id", &name), ("d", &data), ("clip-rule", "evenodd")]))?;
    page.around("clipPath", &[("id", &clip)], |page| page.element("use", &[("href", &link)]))?;
    let stroke = |page: &mut Page, paint: &str, reach: i32| {
        let width = number(2.0 * f64::from(reach));
        page.element("use", &[("href", &link), ("fill", "none"), ("stroke", paint), ("stroke-width", &width)])
    };
    stroke(page, &white, hatch.rim)?;
    page.around("g", &[("clip-path", &format!("url(#{clip})"))], |page| {
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
