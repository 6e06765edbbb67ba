//! Every shader that can be assembled is valid, which needs no GPU; and errors name the fragments' own lines.

use spiral_atlas::eval::gpu::{assemble, validate};
use spiral_atlas::family::{self, Shader};
use spiral_atlas::grid::{Axis, Grid, Spacing};

const GOOD: &str =
    "fn evaluate(index: vec4<u32>) -> u32 {\n    return index.x + u32(inputs[params.offsets.y]) + SALT;\n}\n";

fn shader(fragments: &[(&'static str, &'static str)]) -> Shader {
    Shader { constants: "const SALT: u32 = 7u;".into(), fragments: fragments.to_vec() }
}

/// The message of the error that a shader must have.
fn message(fragments: &[(&'static str, &'static str)]) -> String {
    validate(&assemble(&shader(fragments))).expect_err("this shader is wrong").to_string()
}

#[test]
fn the_frame_is_valid_and_every_part_is_there() {
    let assembled = assemble(&shader(&[("lib/empty.wgsl", ""), ("good.wgsl", GOOD)]));
    validate(&assembled).unwrap();
    for part in [GOOD, "const SALT: u32 = 7u;\n", "fn main("] {
        assert_eq!(assembled.source.matches(part).count(), 1, "{part}");
    }
}

#[test]
fn every_family_is_valid_in_every_chart() {
    let mut seen = 0;
    for family in family::all() {
        for chart in family.about().charts {
            // A length in chords is above 1.
            let from = |name: &str| if name == "S" { 1.0 } else { 0.0 };
            let axis = |name: &&'static str| {
                Axis::new(name, Spacing::Values(vec![0.25 + from(name), 0.5 + from(name)])).unwrap()
            };
            let grid = Grid::new(chart.axes.iter().map(axis).collect()).unwrap();
            let table = family.table(&grid).unwrap();
            validate(&assemble(&table.shader()))
                .unwrap_or_else(|e| panic!("{}, {}: {e}", family.about().name, chart.name));
            seen += 1;
        }
    }
    assert!(seen > 0);
}

#[test]
fn a_syntax_error_is_told_at_its_own_line() {
    let text =
        message(&[("good.wgsl", GOOD), ("lib/bad.wgsl", "// Grün: two bytes a letter.\n\nfn f() {\n  let x = ;\n}")]);
    assert!(text.contains("lib/bad.wgsl:4:11: "), "{text}");
    assert!(text.contains("    let x = ;"), "{text}");
    assert!(!text.contains("good.wgsl"), "{text}");
}

#[test]
fn an_error_on_a_fragments_first_byte_is_not_told_of_the_one_before() {
    assert!(message(&[("good.wgsl", GOOD), ("bad.wgsl", "? fn")]).contains("bad.wgsl:1:1: "));
    assert!(message(&[("bad.wgsl", "? fn"), ("good.wgsl", GOOD)]).contains("bad.wgsl:1:1: "));
}

#[test]
fn unknown_names_types_and_missing_functions_are_told() {
    let text = message(&[("bad.wgsl", "fn evaluate(index: vec4<u32>) -> u32 {\n    return SALTY;\n}\n")]);
    assert!(text.contains("bad.wgsl:2:12: ") && text.contains("SALTY"), "{text}");
    // A wrong return type passes the parser; the validator names the function.
    let text = message(&[
        ("good.wgsl", GOOD),
        ("bad.wgsl", "\n\nfn g() -> u32 {\n    var x: f32;\n    x = 1.0;\n    return x;\n}\n"),
    ]);
    assert!(text.contains("bad.wgsl:3:1: "), "{text}");
    let text = message(&[("empty.wgsl", "")]);
    assert!(text.contains("lib/main.wgsl:") && text.contains("evaluate"), "{text}");
}

#[test]
fn generated_constants_have_a_name_too() {
    let bad =
        Shader { constants: "const SALT: u32 = 1u;\nconst B: u32 = -1;".into(), fragments: vec![("good.wgsl", GOOD)] };
    let text = validate(&assemble(&bad)).unwrap_err().to_string();
    assert!(text.contains("constants (generated):2:"), "{text}");
}

#[test]
fn a_name_defined_twice_is_told_at_both_places() {
    let text = message(&[("one.wgsl", GOOD), ("two.wgsl", "\n\nfn evaluate(index: vec4<u32>) -> u32 { return 1u; }")]);
    assert!(text.contains("one.wgsl:1:4: ") && text.contains("two.wgsl:3:4: "), "{text}");
}
