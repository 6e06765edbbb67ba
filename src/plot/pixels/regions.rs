//! Regions of a slice as pixels.

use super::sheet::Pixels;
use crate::plot::geometry::Point;
use crate::plot::hatch::{Hatch, Outline};
use crate::plot::palette::WHITE;
use crate::plot::regions::{Area, Regions};

/// Smooth lines are drawn on pixels so many times as small, and averaged.
const FINER: i32 = 3;
/// Most of these small pixels of a picture.
const MOST_FINE: i64 = 1 << 25;

/// Draws regions.
pub(super) fn paint(sheet: &mut Pixels, regions: &Regions) {
    let (width, height) = (regions.rect.width(), regions.rect.height());
    let fits = |times: &i32| i64::from(width) * i64::from(height) * i64::from(times * times) <= MOST_FINE;
    let times = if regions.smooth() { (1..=FINER).rev().find(fits).unwrap_or(1) } else { 1 };
    let mut block = Block::new(regions, times);
    block.fill();
    for (area, outline, inset) in regions.styled() {
        block.outline(area, outline, inset.map(|inset| inset * times));
    }
    sheet.reduce(&block.pixels, times, (regions.rect.left, regions.rect.top));
}

/// The rectangle of the regions, in pixels of its own.
struct Block<'r> {
    regions: &'r Regions,
    pixels: Pixels,
    width: i32,
    height: i32,
    /// How many times as small as those of the sheet its pixels are.
    times: i32,
    hatch: Hatch,
    /// Node of each pixel column, left to right.
    columns: Vec<usize>,
    /// First node of the grid row of each pixel row, top to bottom.
    rows: Vec<usize>,
}

impl Block<'_> {
    fn new(regions: &Regions, times: i32) -> Block<'_> {
        let (width, height) = (regions.rect.width() * times, regions.rect.height() * times);
        let columns = regions.x.of_pixels(width as usize);
        let count = regions.x.borders().len() - 1;
        let rows = regions.y.of_pixels(height as usize).into_iter().rev().map(|j| j * count).collect();
        let pixels = Pixels::new((width as u32, height as u32));
        Block { regions, pixels, width, height, times, hatch: regions.hatch.scaled(times), columns, rows }
    }

    /// The pixels whose centre is in an area.
    fn inside(&self, area: &Area) -> Vec<bool> {
        if area.rings.is_empty() {
            return self.rows.iter().flat_map(|j| self.columns.iter().map(move |i| area.mask[j + i])).collect();
        }
        let mut inside = Vec::with_capacity(self.columns.len() * self.rows.len());
        for crossings in self.crossings(&area.rings) {
            let mut crossings = crossings.into_iter().peekable();
            let mut here = false;
            for x in 0..self.width {
                let centre = f64::from(x) + 0.5;
                while crossings.next_if(|at| *at <= centre).is_some() {
                    here = !here;
                }
                inside.push(here);
            }
        }
        inside
    }

    /// Where rings cross the middle of each row of pixels, from left to right.
    fn crossings(&self, rings: &[Vec<Point>]) -> Vec<Vec<f64>> {
        let mut rows = vec![Vec::new(); self.height as usize];
        let place = |p: &Point| [p[0] * f64::from(self.width), (1.0 - p[1]) * f64::from(self.height)];
        for (a, b) in rings.iter().flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1))) {
            let (a, b) = (place(a), place(b));
            let (top, bottom) = if a[1] < b[1] { (a, b) } else { (b, a) };
            // Rows whose middle is from `top` on and before `bottom`.
            let first = |y: f64| (y - 0.5).ceil().clamp(0.0, f64::from(self.height)) as usize;
            for (row, y) in rows[first(top[1])..first(bottom[1])].iter_mut().zip(first(top[1])..) {
                let share = (y as f64 + 0.5 - top[1]) / (bottom[1] - top[1]);
                row.push(top[0] + share * (bottom[0] - top[0]));
            }
        }
        rows.iter_mut().for_each(|row| row.sort_by(f64::total_cmp));
        rows
    }

    /// Fills each pixel with the last region that holds it. Where two fills of too little contrast meet, the pixels of
    /// the earlier one have the colour of an edge: the later region keeps all of its own.
    fn fill(&mut self) {
        let mut fills = vec![0; self.columns.len() * self.rows.len()];
        for (area, region) in self.regions.fills.iter().zip(1..) {
            fills.iter_mut().zip(self.inside(area)).filter(|(_, inside)| *inside).for_each(|(fill, _)| *fill = region);
        }
        let (colors, edges) = (self.regions.colors(), self.regions.edges());
        let reach = (self.regions.edge * self.times) as usize;
        // The last of the later regions that lie within reach to the four sides.
        let mut later = fills.clone();
        let (width, height) = (self.width as usize, self.height as usize);
        let rows = (0..height).map(|y| (y * width, 1, width));
        for (start, step, count) in rows.chain((0..width).map(|x| (x, width, height))) {
            for k in 1..count {
                let at = |k: usize| start + k * step;
                let (a, b) = (fills[at(k - 1)], fills[at(k)]);
                let near = if a < b { k.saturating_sub(reach)..k } else { k..(k + reach).min(count) };
                for i in near.filter(|_| a != b) {
                    later[at(i)] = later[at(i)].max(a.max(b));
                }
            }
        }
        for (at, (here, later)) in fills.iter().zip(later).enumerate() {
            let color = edges[*here][later].filter(|_| later > *here).unwrap_or(colors[*here]);
            self.pixels.blend((at % width) as i32, (at / width) as i32, color, 1.0);
        }
    }

    /// A line along the inside of an area's boundary and stripes further in, all in a white casing that parts them
    /// from every fill. The boundary of an area that is the whole plot is the plot's, so many pixels further in.
    fn outline(&mut self, area: &Area, outline: Outline, whole: Option<i32>) {
        let Hatch { line, rim, band, .. } = self.hatch;
        let (columns, width, height) = (self.columns.len(), self.width, self.height);
        let inside = self.inside(area);
        let within = |at: usize, inset: i32| {
            let (x, y) = ((at % columns) as i32, (at / columns) as i32);
            let depth = x.min(y).min(width - 1 - x).min(height - 1 - y) - inset;
            (depth >= 0, if depth >= 0 { depth + 1 } else { -depth } * STEP)
        };
        let all: Vec<(bool, i32)> = match whole {
            Some(inset) => (0..inside.len()).map(|at| within(at, inset)).collect(),
            None => inside.iter().copied().zip(depths(&inside, columns)).collect(),
        };
        let corner = [self.regions.rect.left, self.regions.rect.top].map(|c| c * self.times);
        for (at, (here, depth)) in all.iter().enumerate() {
            let depth = *depth;
            let (x, y) = ((at % columns) as i32, (at / columns) as i32);
            if *here && depth <= line * STEP {
                self.pixels.blend(x, y, outline.color, 1.0);
            } else if depth <= if *here { line + rim } else { rim } * STEP {
                self.pixels.blend(x, y, WHITE, 1.0);
            } else if *here && depth <= (band + rim) * STEP {
                let place = (corner[0] + x, corner[1] + y);
                self.pixels.stripe((x, y), place, self.hatch, outline, depth <= band * STEP);
            }
        }
    }
}

/// A pixel's side in the unit of [`depths`].
const STEP: i32 = 5;

/// How far each pixel of a mask is from the nearest one that is not as it is, in fifths of a pixel, by steps of 1 to
/// the sides and 1.4 across corners: one sweep down and one up (Borgefors 1986). Neighbours differ by one step at most.
fn depths(inside: &[bool], columns: usize) -> Vec<i32> {
    // Those that come before in the order of pixels; the others are opposite to them.
    const BEFORE: [(i32, i32, i32); 4] = [(-1, 0, STEP), (0, -1, STEP), (-1, -1, 7), (1, -1, 7)];
    let (width, height) = (columns as i32, (inside.len() / columns) as i32);
    let mut depths = vec![i32::MAX / 2; inside.len()];
    for (at, sign) in (0..inside.len()).map(|at| (at, 1)).chain((0..inside.len()).rev().map(|at| (at, -1))) {
        let (x, y) = ((at % columns) as i32, (at / columns) as i32);
        for (dx, dy, step) in BEFORE {
            let (x, y) = (x + sign * dx, y + sign * dy);
            if (0..width).contains(&x) && (0..height).contains(&y) {
                let other = y as usize * columns + x as usize;
                let through = if inside[other] == inside[at] { depths[other] + step } else { step };
                depths[at] = depths[at].min(through);
            }
        }
    }
    depths
}
