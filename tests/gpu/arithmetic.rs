//! What the proofs of the f32 step assume of a GPU's arithmetic, tried on every adapter there is: each + - * has a
//! relative error of at most 2^-24, or an absolute one of at most 2^-126 (denormals may flush), fused or not.
//! What proofs may not assume (no folding, no fusing, denormals kept, exact division) is printed: `-- --nocapture`.

use crate::adapters::labels;
use spiral_atlas::eval::gpu::{Engine, Settings};
use spiral_atlas::family::{Kernel, Shader, ShaderInputs};
use spiral_atlas::grid::{Axis, Grid, Spacing};
use std::sync::atomic::AtomicBool;

/// Three operands, and the bits that the CPU gets for what the shader computes of them.
const WORDS: usize = 13;

const SHADER: &str = "
fn bits(x: f32) -> u32 {
    return bitcast<u32>(x);
}

fn word(at: u32) -> u32 {
    return bitcast<u32>(inputs[at]);
}

// Zero of either sign.
fn zero(x: f32) -> bool {
    return (bits(x) & 0x7fffffffu) == 0u;
}

fn evaluate(index: vec4<u32>) -> u32 {
    let at = (index.x - params.offsets.x) * WORDS;
    let a = inputs[at];
    let b = inputs[at + 1u];
    let c = inputs[at + 2u];
    var code = 0u;
    if bits(a + b) == word(at + 3u) { code |= 1u; }
    if bits(a - b) == word(at + 4u) { code |= 2u; }
    if bits(a * b) == word(at + 5u) { code |= 4u; }
    if zero(a * b) { code |= 8u; }
    if bits((a + b) - a) == word(at + 6u) { code |= 16u; }
    if bits((a + b) - a) == bits(b) { code |= 32u; }
    if bits(a * b + c) == word(at + 7u) { code |= 64u; }
    if bits(a * b + c) == word(at + 8u) { code |= 128u; }
    if bits(fma(a, b, c)) == word(at + 8u) { code |= 256u; }
    if bits(a / b) == word(at + 9u) { code |= 512u; }
    if bits(sqrt(abs(a))) == word(at + 10u) { code |= 1024u; }
    if bits((a + b) + c) == word(at + 11u) { code |= 2048u; }
    if bits(a + (b + c)) == word(at + 12u) { code |= 4096u; }
    return code;
}
";

const ADD: u16 = 1;
const SUB: u16 = 2;
const MUL: u16 = 4;
const MUL_ZERO: u16 = 8;
const UNFOLDED: u16 = 16;
const FOLDED: u16 = 32;
const UNFUSED: u16 = 64;
const FUSED: u16 = 128;
const FMA: u16 = 256;
const DIV: u16 = 512;
const SQRT: u16 = 1024;
const LEFT: u16 = 2048;
const RIGHT: u16 = 4096;

/// Operands with the CPU's answers.
#[derive(Clone, Copy)]
struct Case {
    operands: [f32; 3],
    words: [f32; WORDS],
}

impl Case {
    fn new(a: f32, b: f32, c: f32) -> Case {
        let answers = [
            a + b,
            a - b,
            a * b,
            (a + b) - a,
            a * b + c,
            a.mul_add(b, c),
            a / b,
            a.abs().sqrt(),
            (a + b) + c,
            a + (b + c),
        ];
        let mut words = [0.0; WORDS];
        words[..3].copy_from_slice(&[a, b, c]);
        words[3..].copy_from_slice(&answers);
        Case { operands: [a, b, c], words }
    }
}

struct Probe<'a>(&'a [Case]);

impl Kernel for Probe<'_> {
    fn shader(&self) -> Shader {
        Shader { constants: format!("const WORDS: u32 = {WORDS}u;"), fragments: vec![("arithmetic.wgsl", SHADER)] }
    }
    fn inputs(&self, start: u64, len: u64) -> ShaderInputs {
        let cases = &self.0[start as usize..(start + len) as usize];
        ShaderInputs { words: cases.iter().flat_map(|c| c.words).collect(), offsets: [start as u32, 0, 0, 0] }
    }
}

/// The answers of an adapter, a code for each case.
fn answers(label: &str, cases: &[Case]) -> Vec<u16> {
    let axis = Axis::new("case", Spacing::Linear { lo: 0.0, hi: 1.0, count: cases.len() }).unwrap();
    let grid = Grid::new(vec![axis]).unwrap();
    let table = Probe(cases);
    let mut engine = Engine::new(Some(label), &table, &grid, &Settings::default()).unwrap();
    let mut codes = Vec::new();
    engine
        .run(0..grid.len(), &AtomicBool::new(false), |_, chunk| {
            codes.extend(chunk.iter().map(|c| c.0));
            Ok(())
        })
        .unwrap();
    assert_eq!(codes.len(), cases.len());
    codes
}

/// Deterministic random bits (xorshift64*).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545f4914f6cdd1d)
    }

    /// Random sign and mantissa, exponent in a range.
    fn float(&mut self, lo: i32, hi: i32) -> f32 {
        let bits = self.bits();
        let exponent = lo + ((bits >> 32) % (hi - lo + 1) as u64) as i32;
        f32::from_bits((bits as u32 & 0x807f_ffff) | ((exponent + 127) as u32) << 23)
    }
}

/// Operands whose sums, differences and products stay normal: near each other, or far apart.
fn normal_cases(count: usize) -> Vec<Case> {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let case = |i: usize| {
        let reach = [1, 3, 12, 26, 60][i % 5];
        let (a, b) = (random.float(-reach, reach), random.float(-reach, reach));
        // The fused and the unfused a b + c differ wherever the product is not exact.
        Case::new(a, b, -(a * b))
    };
    (0..count).map(case).collect()
}

/// Cases whose answer in one bit is not the CPU's.
fn wrong(codes: &[u16], bit: u16) -> usize {
    assert!(!codes.is_empty(), "nothing was compared");
    codes.iter().filter(|code| *code & bit == 0).count()
}

#[test]
fn plus_minus_times_are_correctly_rounded_in_the_normal_range() {
    let cases = normal_cases(2_000_000);
    for label in labels() {
        let codes = answers(&label, &cases);
        for (name, bit) in [("+", ADD), ("-", SUB), ("*", MUL)] {
            assert_eq!(wrong(&codes, bit), 0, "{label}: a {name} b");
        }
        let telling: Vec<u16> =
            cases.iter().zip(&codes).filter(|(c, _)| c.words[7] != c.words[8]).map(|(_, code)| *code).collect();
        assert!(telling.len() > cases.len() / 2);
        // Either is within the bounds; a third answer would not be.
        assert_eq!(wrong(&telling, UNFUSED | FUSED), 0, "{label}: a b + c");
        assert_eq!(wrong(&codes, UNFOLDED | FOLDED), 0, "{label}: (a + b) - a");
        let share = |codes: &[u16], bit| 100.0 * (1.0 - wrong(codes, bit) as f64 / codes.len() as f64);
        println!("{label}, {} cases:", codes.len());
        println!("  (a+b)-a: folded to b {:.2} %, as written {:.2} %", share(&codes, FOLDED), share(&codes, UNFOLDED));
        println!(
            "  a*b+c: fused {:.2} %, unfused {:.2} %; fma() fused {:.2} %",
            share(&telling, FUSED),
            share(&telling, UNFUSED),
            share(&telling, FMA)
        );
        println!("  (a+b)+c as written {:.2} %, a+(b+c) as written {:.2} %", share(&codes, LEFT), share(&codes, RIGHT));
        println!("  a/b correctly rounded {:.2} %, sqrt {:.2} %", share(&codes, DIV), share(&codes, SQRT));
    }
}

#[test]
fn denormals_are_kept_or_flushed_to_zero() {
    let mut random = Random(1);
    // Products below 2^-126, of normal operands.
    let products: Vec<Case> = (0..100_000)
        .map(|_| (random.float(-70, -62), random.float(-78, -65)))
        .filter(|(a, b)| (a * b).is_subnormal())
        .map(|(a, b)| Case::new(a, b, 1.0))
        .collect();
    // Denormal operands, scaled up: a flushed operand gives zero.
    let operands: Vec<Case> = (1..100_000u32).map(|i| Case::new(f32::from_bits(i * 83), 2f32.powi(60), 1.0)).collect();
    assert!(products.len() > 50_000 && operands.iter().all(|c| c.operands[0].is_subnormal()));
    for label in labels() {
        for (name, cases) in [("results", &products), ("operands", &operands)] {
            let codes = answers(&label, cases);
            assert_eq!(wrong(&codes, MUL | MUL_ZERO), 0, "{label}: a * b");
            let kept = codes.len() - wrong(&codes, MUL);
            println!("{label}: denormal {name} kept in {kept} of {} cases", codes.len());
        }
    }
}

/// The comparisons can fail: one wrong bit in one expected word is one report.
#[test]
fn a_wrong_expectation_is_reported_once() {
    let mut cases = normal_cases(10_000);
    for (word, bit) in [(3, ADD), (4, SUB), (5, MUL)] {
        let right = cases[777].words[word];
        cases[777].words[word] = f32::from_bits(right.to_bits() ^ 1);
        let codes = answers(&labels()[0], &cases);
        assert_eq!(wrong(&codes, bit), 1);
        assert_eq!(codes[777] & bit, 0);
        cases[777].words[word] = right;
    }
}
