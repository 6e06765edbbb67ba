//! The words of a file of cells, and how a place is looked up in them.
//!
//! An axis of a single value is that of all cells, and not counted in what follows. There are `T` top cells along each
//! of the `n` axes, first axis slowest; `T` is a power of two, at most the
//! resolution. `top` has two bytes for each: the flags that hold all over it, and those that hold nowhere in it.
//! `roots` has a word for each flag of each top cell: where in `trees` the flag's node is, or 0 where the flag is
//! known or the top cell is not divided.
//!
//! A node divides a cell in two along each axis. Its child `c` has the upper half along the axis i where bit `n-1-i`
//! of c is 1. The first word has, in bit c, whether the flag holds all over child c, and in bit `16 + c`, whether it
//! holds nowhere in it. A child with neither is MIXED. Where the children are not of the finest size, a second word
//! says where the nodes of all MIXED children lie, one after another by c; 0: they are not divided.
//!
//! Word 0 of `trees` is 0 and belongs to nobody. The trees of the first top cell come next, in the order of the
//! flags, then those of the next top cell, and so on. The nodes of a tree stand level by level, each level in the
//! order of the level above. So each place that a word names is known from the words before it, one pass checks them
//! all, and what a lookup reads lies close together.

/// What a cell says of each flag, as two masks: a flag in neither is MIXED.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Known {
    /// Flags that hold at every point of the cell.
    pub inside: u8,
    /// Flags that hold at none.
    pub outside: u8,
}

/// Most axes that are divided: a node has a bit for each child, in half a word.
pub(super) const MOST_AXES: usize = 4;

/// How many top cells there are along each axis: at most 4,096 together.
pub(super) fn top_count(axes: usize, resolution: usize) -> usize {
    resolution.min(1 << (12 / axes))
}

/// The shape of a file: what its words mean depends on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Layout {
    /// How many are divided: those of a single value are not.
    pub axes: usize,
    pub flags: usize,
    /// The resolution is 2 to this.
    pub depth: u32,
    /// Along each axis there are 2 to this top cells.
    pub top: u32,
}

impl Layout {
    /// Words of a node whose children have a size of 2 to the `size` finest cells.
    #[inline]
    pub(super) fn words(size: u32) -> usize {
        if size == 0 { 1 } else { 2 }
    }

    pub(super) fn top_cells(&self) -> usize {
        1 << (self.top as usize * self.axes)
    }

    /// The bits of a node's children.
    pub(super) fn children(&self) -> u32 {
        ((1u64 << (1 << self.axes)) - 1) as u32
    }

    /// The top cell of the finest cell with these indices.
    #[inline]
    pub(super) fn top_of(&self, place: &[u32]) -> usize {
        let shift = self.depth - self.top;
        place.iter().fold(0, |at, i| at << self.top | (i >> shift) as usize)
    }

    /// Numbers within a top cell with room for the bits of the other axes between their own.
    pub(super) fn spread(&self) -> Box<[u32]> {
        let depth = self.depth - self.top;
        let spread = |i: u32| (0..depth).fold(0, |sum, bit| sum | (i >> bit & 1) << (bit as usize * self.axes));
        (0..1 << depth).map(spread).collect()
    }
}

/// The parts of a file.
#[derive(Clone, Copy)]
pub(super) struct Words<'w> {
    pub shape: Layout,
    /// Little-endian words.
    pub roots: &'w [[u8; 4]],
    /// Likewise.
    pub trees: &'w [[u8; 4]],
    pub top: &'w [[u8; 2]],
    /// [`Layout::spread`].
    pub spread: &'w [u32],
}

#[inline]
fn word(words: &[[u8; 4]], at: usize) -> Option<u32> {
    words.get(at).map(|word| u32::from_le_bytes(*word))
}

impl Words<'_> {
    /// What the smallest cell that holds the finest cell with these indices says of the wanted flags. Words that lead
    /// nowhere say MIXED.
    #[inline]
    pub(super) fn find(&self, place: &[u32], wanted: u8) -> Known {
        let at = self.shape.top_of(place);
        let Some([inside, outside]) = self.top.get(at) else { return Known::default() };
        let mut known = Known { inside: inside & wanted, outside: outside & wanted };
        let mut open = wanted & !(inside | outside);
        if open == 0 {
            return known;
        }
        // The way down: the number of the child at each level, the finest in the lowest bits.
        let within = self.spread.len().wrapping_sub(1);
        let way = place
            .iter()
            .fold(0, |way, i| way << 1 | self.spread.get(*i as usize & within).copied().unwrap_or_default());
        while open != 0 {
            let flag = open.trailing_zeros();
            open &= open - 1;
            let root = word(self.roots, at * self.shape.flags + flag as usize);
            match self.descend(root.unwrap_or_default(), way) {
                Some(true) => known.inside |= 1 << flag,
                Some(false) => known.outside |= 1 << flag,
                None => {}
            }
        }
        known
    }

    /// Down a flag's tree.
    #[inline]
    fn descend(&self, root: u32, way: u32) -> Option<bool> {
        let last = (1 << self.shape.axes) - 1;
        let (mut at, mut size) = (root as usize, self.shape.depth - self.shape.top);
        while at != 0 && size > 0 {
            size -= 1;
            let child = way >> (size as usize * self.shape.axes) & last;
            let node = word(self.trees, at)?;
            if (node | node >> 16) >> child & 1 == 1 {
                return Some(node >> child & 1 == 1);
            }
            if size == 0 {
                return None;
            }
            let next = word(self.trees, at + 1)? as usize;
            let before = !(node | node >> 16) & ((1 << child) - 1);
            at = if next == 0 { 0 } else { next + before.count_ones() as usize * Layout::words(size - 1) };
        }
        None
    }

    /// Whether the words are such as the writer writes: one pass.
    ///
    /// # Errors
    /// In words, the first that is not.
    pub(super) fn check(&self) -> Result<(), String> {
        let shape = self.shape;
        let all = ((1u32 << shape.flags) - 1) as u8;
        if word(self.trees, 0) != Some(0) {
            return Err("`trees` does not begin with the word 0".into());
        }
        for (i, known) in self.top.iter().enumerate() {
            if known[0] & known[1] != 0 || (known[0] | known[1]) & !all != 0 {
                return Err(format!(
                    "`top` says of cell {i} both yes and no, or names a flag that there is not: {known:?}"
                ));
            }
        }
        let mut next = 1;
        for (i, root) in self.roots.iter().enumerate() {
            let (cell, flag) = (i / shape.flags, i % shape.flags);
            let mut size = shape.depth - shape.top;
            let known = (self.top[cell][0] | self.top[cell][1]) >> flag & 1 == 1;
            let mut level = next..next;
            match u32::from_le_bytes(*root) as usize {
                0 => continue,
                at if at == next && !known && size > 0 => next += Layout::words(size - 1),
                at => {
                    return Err(format!(
                        "`roots` has {at} for flag {flag} of top cell {cell}, where 0 or {next} may be"
                    ));
                }
            }
            while size > 0 {
                size -= 1;
                level = level.end..next;
                for at in level.clone().step_by(Layout::words(size)) {
                    next += self.check_node(at, size, next)?;
                }
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
        let word = |at: usize| word(self.trees, at).ok_or_else(|| format!("`trees` ends before its word {at}"));
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
            to if to == next && mixed > 0 => Ok(mixed * Layout::words(size - 1)),
            to => Err(format!("word {} of `trees` is {to}, where 0 or {next} may be", at + 1)),
        }
    }
}
