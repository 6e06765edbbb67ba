//! Formulas written as in the papers, for every [`Number`]: `formula!(2.0 * p * (u + v) - q)`.
//!
//! Operators on references would need a bound on references in every generic function. Here each letter of a formula
//! becomes a [`Term`], which has the operators for every type of number. The operations and their order are those that
//! the text shows, so an error bound may count them (`c - x` is computed as `-x + c`; the negation is exact).

use super::Number;
use std::ops::{Add, Mul, Neg, Sub};

/// A letter of a formula.
#[derive(Debug, Clone, Copy)]
pub struct Term<'n, N>(pub &'n N);

/// Makes every number usable as a letter.
pub(crate) trait Letter: Number {
    /// This number as a letter.
    #[inline(always)]
    fn term(&self) -> Term<'_, Self> {
        Term(self)
    }
}

impl<N: Number> Letter for N {}

/// The value of a part of a formula.
#[derive(Debug, Clone, Copy)]
pub struct Part<N>(pub N);

/// The value of an expression of `+ - *` and parentheses. Its letters may be variables, fields, elements and calls
/// that are numbers or references to them. Literals are constants, and so are f64 expressions in braces:
/// `x * { 2.0 * c }`.
macro_rules! formula {
    // An operand is expected: a sign, parentheses, a constant, or a letter.
    (@operand [$($done:tt)*] - $($rest:tt)+) => { formula!(@operand [$($done)* -] $($rest)+) };
    (@operand [$($done:tt)*] ($($inner:tt)+) $($rest:tt)*) => {
        formula!(@operator [$($done)* (formula!(@operand [] $($inner)+))] $($rest)*)
    };
    (@operand [$($done:tt)*] {$constant:expr} $($rest:tt)*) => {
        formula!(@operator [$($done)* ($constant)] $($rest)*)
    };
    (@operand [$($done:tt)*] $constant:literal $($rest:tt)*) => { formula!(@operator [$($done)* $constant] $($rest)*) };
    (@operand [$($done:tt)*] $name:ident $($rest:tt)*) => { formula!(@letter [$($done)*] [$name] $($rest)*) };
    // What belongs to a letter: its field, its element, its arguments.
    (@letter [$($done:tt)*] [$($letter:tt)+] . $field:tt $($rest:tt)*) => {
        formula!(@letter [$($done)*] [$($letter)+ . $field] $($rest)*)
    };
    (@letter [$($done:tt)*] [$($letter:tt)+] :: $name:tt $($rest:tt)*) => {
        formula!(@letter [$($done)*] [$($letter)+ :: $name] $($rest)*)
    };
    (@letter [$($done:tt)*] [$($letter:tt)+] [$($index:tt)+] $($rest:tt)*) => {
        formula!(@letter [$($done)*] [$($letter)+ [$($index)+]] $($rest)*)
    };
    (@letter [$($done:tt)*] [$($letter:tt)+] ($($arguments:tt)*) $($rest:tt)*) => {
        formula!(@letter [$($done)*] [$($letter)+ ($($arguments)*)] $($rest)*)
    };
    (@letter [$($done:tt)*] [$($letter:tt)+] $($rest:tt)*) => {
        formula!(@operator [$($done)* $($letter)+.term()] $($rest)*)
    };
    // An operator is expected, or the end.
    (@operator [$($done:tt)*] + $($rest:tt)+) => { formula!(@operand [$($done)* +] $($rest)+) };
    (@operator [$($done:tt)*] - $($rest:tt)+) => { formula!(@operand [$($done)* -] $($rest)+) };
    (@operator [$($done:tt)*] * $($rest:tt)+) => { formula!(@operand [$($done)* *] $($rest)+) };
    (@operator [$($done:tt)*]) => { $($done)* };
    (@ $($unknown:tt)*) => { compile_error!("a formula has + - *, parentheses, letters and constants") };
    ($($formula:tt)+) => {{
        use $crate::num::Letter as _;
        (formula!(@operand [] $($formula)+)).0
    }};
}
pub(crate) use formula;

/// One operator between terms, parts and constants c.
macro_rules! operator {
    ($trait:ident $op:ident, $x:ident, $c:ident, $with:expr, $before:expr) => {
        operator!(@numbers $trait $op, Term<'_, N>, Term<'_, N>);
        operator!(@numbers $trait $op, Term<'_, N>, Part<N>);
        operator!(@numbers $trait $op, Part<N>, Term<'_, N>);
        operator!(@numbers $trait $op, Part<N>, Part<N>);
        operator!(@constants $trait $op, Term<'_, N>, $x, $c, $with, $before);
        operator!(@constants $trait $op, Part<N>, $x, $c, $with, $before);
    };
    (@numbers $trait:ident $op:ident, $one:ty, $other:ty) => {
        impl<N: Number> $trait<$other> for $one {
            type Output = Part<N>;
            #[inline(always)]
            fn $op(self, other: $other) -> Part<N> {
                Part(Number::$op(self.number(), other.number()))
            }
        }
    };
    // No closures: the compiler does not always inline them where lanes are computed.
    (@constants $trait:ident $op:ident, $one:ty, $x:ident, $c:ident, $with:expr, $before:expr) => {
        impl<N: Number> $trait<f64> for $one {
            type Output = Part<N>;
            #[inline(always)]
            fn $op(self, $c: f64) -> Part<N> {
                let $x = self.number();
                Part($with)
            }
        }
        impl<N: Number> $trait<$one> for f64 {
            type Output = Part<N>;
            #[inline(always)]
            fn $op(self, other: $one) -> Part<N> {
                let ($x, $c) = (other.number(), self);
                Part($before)
            }
        }
    };
}

operator!(Add add, x, c, x.plus(c), x.plus(c));
operator!(Sub sub, x, c, x.plus(-c), x.times(-1.0).plus(c));
operator!(Mul mul, x, c, x.times(c), x.times(c));

impl<N> Term<'_, N> {
    #[inline(always)]
    fn number(&self) -> &N {
        self.0
    }
}

impl<N> Part<N> {
    #[inline(always)]
    fn number(&self) -> &N {
        &self.0
    }
}

impl<N: Number> Neg for Term<'_, N> {
    type Output = Part<N>;
    #[inline(always)]
    fn neg(self) -> Part<N> {
        Part(self.number().times(-1.0))
    }
}

impl<N: Number> Neg for Part<N> {
    type Output = Part<N>;
    #[inline(always)]
    fn neg(self) -> Part<N> {
        Part(self.number().times(-1.0))
    }
}

#[cfg(test)]
mod tests {
    use crate::num::{Interval, Number};

    /// Letters of every kind, precedence, constants on either side.
    #[test]
    fn a_formula_is_its_operations_in_order() {
        struct Pair {
            first: f64,
            rest: [f64; 2],
        }
        let double = |x: &f64| 2.0 * x;
        let (p, q, c) = (0.1, &0.7, 3.0);
        let pair = Pair { first: 0.3, rest: [0.9, 1.7] };
        assert_eq!(formula!(p * q + pair.first), p * q + pair.first);
        assert_eq!(formula!(2.0 * p * (q - pair.rest[1]) - -p), 2.0 * p * (q - pair.rest[1]) - -p);
        assert_eq!(formula!(1.0 - p * { c } + double(q)), 1.0 - p * c + double(q));
        assert_eq!(formula!(-(p - q) * pair.first.abs() - 4.0), -(p - q) * pair.first.abs() - 4.0);
        assert_eq!(formula!(p - q - pair.first), p - q - pair.first);
        let (x, y) = (Interval::new(p, 100), Interval::new(*q, 100));
        let formula = formula!(2.0 * x * y - (1.0 - x) * x + 0.5);
        let calls = x.times(2.0).mul(&y).sub(&x.times(-1.0).plus(1.0).mul(&x)).plus(0.5);
        assert_eq!(
            (formula.lower().to_f64(), formula.upper().to_f64()),
            (calls.lower().to_f64(), calls.upper().to_f64())
        );
    }
}
