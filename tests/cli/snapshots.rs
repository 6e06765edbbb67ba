//! What the program prints, word for word. A change on purpose is taken over with
//! `INSTA_UPDATE=always cargo test --test cli snapshots`; then look at what has changed in the folder of the same name.
//!
//! Only outputs whose digits do not depend on a machine's library of sines stand here.

use super::run;

/// Takes the output of a command line, as a terminal shows it.
fn shown(line: &str) -> String {
    let said = run(line.split_whitespace());
    let code = said.code.unwrap_or_default();
    format!("$ spiral-atlas {line}\n{}{}[exit status {code}]", said.out, said.err)
}

macro_rules! snapshots {
    ($($name:ident: $line:expr;)*) => {
        $(#[test] fn $name() { insta::assert_snapshot!(shown($line)); })*
    };
}

snapshots! {
    help: "--help";
    help_of_curve: "curve --help";
    help_of_involute: "curve involute --help";
    export_alone: "export";
    unknown_command: "curv";
    unknown_option: "curve cubic --form 0,0";
    options_are_missing: "curve trig-quintic --template c --from 0,0";
    an_option_of_another_family: "curve ph-quintic --from 0,0 --to 200,0 --start-direction 0 --end-direction 1 \
                                  --start-curvature 0 \
                                  --end-curvature 1 --turns 0,1";
    no_number: "join --from 0,0,0 --to 1,0,0 --greatest-curvature abc";
    no_count: "generate recipe.toml --threads 0x10";
    no_angle: "curve cubic --start-direction 40%";
    too_flat: "curve involute --from 0,0 --to 200,0 --start-direction -40deg --end-direction 80deg --start-curvature \
               0.004 --end-curvature 0.01 --samples 2 --csv";
    a_missing_path: "path measure missing.json";
    a_datum_outside: "query --phi0 4 --phi1 1.4 --kappa0 0.4 --kappa1 4";
    a_datum_beyond_doubles: "query --family trig-quintic --ratio 1e160 --theta 42deg --m 1 --p 0 --q 0";
    a_missing_recipe: "generate missing.toml";
}
