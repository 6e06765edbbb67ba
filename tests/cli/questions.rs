//! `query` with `--ranges`, `--nearest` and `--boundary`: what is asked wrongly is refused, never passed over.

use super::{Folder, fine, run};

const DATUM: [&str; 7] = ["query", "--phi0", "40deg", "--phi1", "80deg", "--kappa0", "0.4"];

#[test]
fn what_belongs_to_a_question_needs_one() {
    for (more, what) in [
        (&["--kappa1", "4", "--property", "SOLVABLE"][..], "--ranges <NAME>|--nearest|--boundary <NAME,NAME>"),
        (&["--kappa1", "4", "--within", "0,9"], "--ranges <NAME>|--boundary <NAME,NAME>"),
        (&["--kappa1", "4", "--nearest", "--within", "0,9"], "--ranges <NAME>|--boundary <NAME,NAME>"),
        (&["--kappa1", "4", "--weights", "1,1,1,1"], "--nearest"),
        (&["--kappa1", "4", "--cells", "8"], "--boundary"),
        (&["--ranges", "kappa1", "--nearest"], "cannot be used with"),
        (&["--ranges", "kappa1", "--within", "0,9", "--within", "0,9"], "--within is given more than once for"),
        (&["--ranges", "kappa1"], "give --within FROM,TO for kappa1"),
        (&["--ranges", "kappa2", "--within", "0,9"], "`cubic` has no coordinate \"kappa2\""),
    ] {
        let said = run(DATUM.iter().chain(more));
        assert!(said.code == Some(2) && said.err.contains(what) && said.out.is_empty(), "{more:?}: {}", said.err);
    }
    let weights = |weights| run(DATUM.iter().chain(&["--kappa1", "99", "--nearest", "--weights", weights]));
    for (given, what) in [
        ("1,1", "the number of weights is 2; it must be 4 (one for each of phi0, phi1, kappa0, kappa1)"),
        ("-1,1,1,1", "the weight of phi0 is -1; it must be 1e-50 to 1e50"),
        ("1,x,1,1", "\"x\" is no number"),
    ] {
        let said = weights(given);
        assert!(said.code == Some(2) && said.err.contains(what), "{given}: {}", said.err);
    }
    let boundary = |names: &str| run(["query", "--phi0", "40deg", "--phi1", "80deg", "--boundary", names]);
    for names in ["kappa0,kappa0", "kappa0", "kappa0,kappa1,phi0"] {
        let said = boundary(names);
        let what = format!("--boundary is \"{names}\"; it takes the names of two different coordinates");
        assert!(said.code == Some(2) && said.err.contains(&what), "{names}: {}", said.err);
    }
    let said = run(["query", "--points", "none.csv", "--nearest"]);
    assert!(said.code == Some(2) && said.err.contains("cannot be used with"), "{}", said.err);
}

#[test]
fn questions_are_answered() {
    let found = fine(DATUM.iter().chain(&["--ranges", "kappa1", "--within", "0,100"]));
    assert!(found.out.starts_with("SPIRAL holds for kappa1 from 2.42"), "{}", found.out);
    let none = run(DATUM.iter().chain(&["--ranges", "kappa1", "--within", "0,1", "--property", "spiral"]));
    assert!(none.code == Some(1) && none.out.contains("holds for no kappa1 there"), "{}", none.out);
    let plane = ["query", "--phi0", "40deg", "--phi1", "80deg", "--boundary", "kappa0,kappa1"];
    let plane = plane.iter().chain(&["--within", "0,0.8", "--within", "0,20", "--cells", "16"]);
    assert!(fine(plane.clone()).out.contains("open beside the outlines"));
    let folder = Folder::new("");
    let figure = folder.text("outline.svg");
    fine(plane.clone().chain(&["--figure", &figure[..]]));
    let drawn = std::fs::read_to_string(figure).unwrap();
    assert!(drawn.contains(">SPIRAL: φ₀ = 0.698132, φ₁ = 1.396263<"), "{drawn:.600}");
    let wrong = run(plane.chain(&["--figure", "outline.pdf"]));
    assert!(wrong.code == Some(2) && wrong.err.contains(".png or .svg"), "{}", wrong.err);
}

/// An end of `--within` is none of the property.
#[test]
fn ends_of_the_search_are_told_apart() {
    let asked = |within: &str, more: &[&str]| {
        let question = ["--ranges", "kappa1", "--within", within];
        fine(DATUM.iter().chain(&question).chain(more))
    };
    let json = |within: &str| asked(within, &["--json"]).json()["ranges"][0]["cut"].clone();
    assert_eq!(json("0,100"), serde_json::json!([false, false]));
    assert_eq!(json("3,100"), serde_json::json!([true, false]));
    assert_eq!(json("3,10"), serde_json::json!([true, true]));
    let cut = asked("3,100", &[]).out;
    assert!(cut.starts_with("SPIRAL holds for kappa1 from 3.0 (end of the searched range) to 15.6"), "{cut}");
    assert!(cut.contains("proved all over 3.0 to 15.6") && cut.contains(", and to fail beyond 15.6"), "{cut}");
    let all = asked("3,10", &[]).out;
    assert!(all.contains("to 10.0 (end of the searched range)\n") && !all.contains("fail"), "{all}");
    // Where the search ends just where the property does, that is its own end.
    let low = asked("0,100", &["--json"]).json()["ranges"][0]["ends"][0].to_string();
    assert_eq!(json(&format!("{low},10")), serde_json::json!([false, true]));
}

/// Where a range ends at what is not decided, nothing is said to fail there: only the number of solutions changes.
#[test]
fn what_is_open_is_not_said_to_fail() {
    let ph = ["query", "--family", "ph-quintic", "--phi0", "40deg", "--phi1", "80deg", "--kappa0", "0.4"];
    let ph = ph.iter().chain(&["--property", "SOLVABLE"]);
    let found = fine(ph.clone().chain(&["--ranges", "kappa1", "--within", "2.7,2.8"]));
    assert!(found.out.contains("not decided for kappa1 from 2.72304831"), "{}", found.out);
    assert!(!found.out.contains("fail beyond 2.72304831") && !found.out.contains("and 2.72304831"), "{}", found.out);
    // All of it open: not a yes.
    let none = run(ph.chain(&["--ranges", "kappa1", "--within", "2.72304831882575,2.72304831883338"]));
    assert!(none.code == Some(1) && none.out.starts_with("not decided for kappa1"), "{}", none.out);
}
