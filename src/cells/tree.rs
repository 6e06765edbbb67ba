//! The words of a file of cells, and how a place is looked up in them.
//!
//! There are `T` top cells along each of the `n` axes, first axis slowest; `T` is a power of two, at most the resolution. `top` has two bytes for each: the
//! flags that hold all over it, and those that hold nowhere in it. `roots` has a word for each flag of each top cell: where in `trees` the flag's node
//! is, or 0 where the flag is known or the top cell is not divided.
//!
//! A node divides a cell in two along each axis. Its child `c` has the upper half along the axis i where bit `n-1-i` of c is 1. The first word has, in bit c, whether
//! the flag holds all over child c, and in bit `16 + c`, whether it holds nowhere in it. A child with neither is MIXED. Where the children are not
//! of the finest size, a second word says where the nodes of all MIXED children lie, one after another by c; 0: they are not divided.
//!
//! Word 0 of `trees` is 0 and belongs to nobody. The nodes of flag 0 come next, then those of flag 1, and so on; those of a flag level by level, each level in the
//! order of the level above. So each place that a word names is known from the words before it, and one pass checks them all.

/// What a cell says of each flag, as two masks: a flag in neither is MIXED.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Known {
    /// Flags that hold at every point of the cell.
    pub inside: u8,
    /// Flags that hold at none.
    pub outside: u8,
}

/// Most axes: a node has a bit for each child, in half a word.
pub(super) const MOST_AXES: usize = crate::family::MOST_SIDES;

/// How many top cells there are along each axis: at most 65,536 together.
pub(super) fn top_count(axes: usize, resolution: usize) -> usize {
    resolution.min(1 << (16 / axes))
}

/// The shape of a file: what its words mean depends on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Shape {
    pub axes: usize,
    pub flags: usize,
    /// The resolution is 2 to this.
    pub depth: u32,
    /// Along each axis there are 2 to this top cells.
    pub top: u32,
}

impl Shape {
    /// Words of a node whose children have a size of 2 to the `size` finest cells.
    #[inline]
    pub fn words(size: u32) -> usize {
        if size == 0 { 1 } else { 2 }
    }

    pub fn top_cells(&self) -> usize {
        1 << (self.top as usize * self.axes)
    }

    /// The bits of a node's children.
    pub fn children(&self) -> u32 {
        ((1u64 << (1 << self.axes)) - 1) as u32
    }

    /// The top cell of the finest cell with these indices.
    #[inline]
    pub fn top_of(&self, place: &[u32]) -> usize {
        let shift = self.depth - self.top;
        place.iter().fold(0, |at, i| at << self.top | (i >> shift) as usize)
    }
}

/// The parts of a file.
#[derive(Clone, Copy)]
pub(super) struct Words<'w> {
    pub shape: Shape,
    pub roots: &'w [u32],
    pub trees: &'w [u32],
    pub top: &'w [u8],
}

impl Words<'_> {
    /// What the smallest cell that holds the finest cell with these indices says of the wanted flags. Words that lead nowhere say MIXED.
    #[inline]
    pub fn find(&self, place: &[u32], wanted: u8) -> Known {
        let at = self.shape.top_of(place);
        let (Some(inside), Some(outside)) = (self.top.get(2 * at), self.top.get(2 * at + 1)) else { return Known::default() };
        let mut known = Known { inside: inside & wanted, outside: outside & wanted };
        let mut open = wanted & !(inside | outside);
        while open != 0 {
            let flag = open.trailing_zeros();
            open &= open - 1;
            let root = self.roots.get(at * self.shape.flags + flag as usize);
            match self.descend(root.map_or(0, |root| *root), place) {
                Some(true) => known.inside |= 1 << flag,
                Some(false) => known.outside |= 1 << flag,
                None => {}
            }
        }
        known
    }

    /// Down a flag's tree.
    #[inline]
    fn descend(&self, root: u32, place: &[u32]) -> Option<bool> {
        let (mut at, mut size) = (root as usize, self.shape.depth - self.shape.top);
        while at != 0 && size > 0 {
            size -= 1;
            let child = place.iter().fold(0, |child, i| child << 1 | (i >> size & 1));
            let word = *self.trees.get(at)?;
            if word >> child & 1 == 1 {
                return Some(true);
            }
            if word >> (16 + child) & 1 == 1 {
                return Some(false);
            }
            if size == 0 {
                return None;
            }
            let next = *self.trees.get(at + 1)? as usize;
            let before = !(word | word >> 16) & ((1 << child) - 1);
            at = if next == 0 { 0 } else { next + before.count_ones() as usize * Shape::words(size - 1) };
        }
        None
    }

    /// Whether the words are such as the writer writes: one pass.
    ///
    /// # Errors
    /// In words, the first that is not.
    pub fn check(&self) -> Result<(), String> {
        let shape = self.shape;
        let all = ((1u32 << shape.flags) - 1) as u8;
        if self.trees.first() != Some(&0) {
            return Err("`trees` does not begin with the word 0".into());
        }
        for (i, known) in self.top.as_chunks::<2>().0.iter().enumerate() {
            if known[0] & known[1] != 0 || (known[0] | known[1]) & !all != 0 {
                return Err(format!("`top` says of cell {i} both yes and no, or names a flag that there is not: {known:?}"));
            }
        }
        let mut next = 1;
        for flag in 0..shape.flags {
            let mut size = shape.depth - shape.top;
            let mut level = next..next;
            for (i, root) in self.roots.iter().skip(flag).step_by(shape.flags).enumerate() {
                let known = (self.top[2 * i] | self.top[2 * i + 1]) >> flag & 1 == 1;
                match *root as usize {
                    0 => continue,
                    at if at == next && !known && size > 0 => next += Shape::words(size - 1),
                    at => return Err(format!("`roots` has {at} for flag {flag} of top cell {i}, where 0 or {next} may be")),
                }
            }
            while size > 0 {
                size -= 1;
                level = level.end..next;
                for at in level.clone().step_by(Shape::words(size)) {
                    next += self.check_node(at, size, next)?;
                }
            }
            if next != level.end {
                return Err(format!("`trees` of flag {flag} go on below the finest cells"));
            }
        }
        if next == self.trees.len() {
            Ok(())
        } else {
            Err(format!("`trees` has {} words, {next} of which are used", self.trees.len()))
        }
    }

    /// The words that the children of a node take, when they begin at `next`.
    fn check_node(&self, at: usize, size: u32, next: usize) -> Result<usize, String> {
        let word = |at: usize| self.trees.get(at).copied().ok_or_else(|| format!("`trees` ends before its word {at}"));
        let node = word(at)?;
        let (yes, no) = (node & 0xffff, node >> 16);
        if yes & no != 0 || (yes | no) & !self.shape.children() != 0 {
            return Err(format!("word {at} of `trees` is {node:#010x}: a child is both, or there is no such child"));
        }
        if size == 0 {
            return Ok(0);
        }
        let mixed = (self.shape.children() & !(yes | no)).count_ones() as usize;
        match word(at + 1)? as usize {
            0 => Ok(0),
            to if to == next && mixed > 0 => Ok(mixed * Shape::words(size - 1)),
            to => Err(format!("word {} of `trees` is {to}, where 0 or {next} may be", at + 1)),
        }
    }
}
