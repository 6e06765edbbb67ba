//! The atlas file: what is written comes back, and whatever else a file may hold is refused.

use proptest::prelude::*;
use spiral_atlas::atlas::{Atlas, Entry, Spec, Writer, Written};
use spiral_atlas::eval::Chunk;
use spiral_atlas::family::{self, NO_VALUE};
use spiral_atlas::grid::{Axis, Grid, Spacing};
use spiral_atlas::{Error, Result};
use std::path::Path;

const RECIPE: &str = "family = \"cubic\"\n# \"quotes\", \\ and φ0 survive\n";

const LOG: Spacing = Spacing::Log { lo: 0.5, hi: 200.0, count: 7 };
/// Quicker to compute, for tests that open thousands of files.
const PLAIN: Spacing = Spacing::Linear { lo: 0.5, hi: 200.0, count: 7 };

/// Four axes of different counts and, with [`LOG`], all spacings.
fn grid(kappa1: Spacing) -> Grid {
    let axis = |name, spacing| Axis::new(name, spacing).unwrap();
    Grid::new(vec![
        axis("phi0", Spacing::Values(vec![0.1, 0.7, 0.8])),
        axis("phi1", Spacing::Linear { lo: 0.9, hi: 1.5, count: 5 }),
        axis("kappa0", Spacing::Linear { lo: -0.1, hi: 0.6, count: 4 }),
        axis("kappa1", kappa1),
    ])
    .unwrap()
}

fn spec(grid: &Grid) -> Spec<'_> {
    Spec { name: "sample", family: family::by_name("cubic").unwrap(), grid, scalars: &[2, 0], recipe: RECIPE }
}

/// Fields that differ from node to node and from each other.
fn chunk(start: u64, len: u64) -> Chunk {
    let of = |f: fn(u64) -> f32| (start..start + len).map(f).collect();
    Chunk {
        start,
        flags: (start..start + len).map(|i| (i % 32) as u8).collect(),
        solutions: (start..start + len).map(|i| (i * 7 % 16) as u8).collect(),
        scalars: vec![of(|i| i as f32 / 8.0), of(|i| if i % 3 == 0 { NO_VALUE } else { 1.0 / (i as f32) })],
    }
}

fn write(path: &Path, kappa1: Spacing, cuts: &[u64]) -> Result<Written> {
    let grid = grid(kappa1);
    let mut writer = Writer::create(path, &spec(&grid))?;
    let mut start = 0;
    for end in cuts.iter().copied().chain([grid.len()]) {
        writer.put(&chunk(start, end - start))?;
        start = end;
    }
    writer.finish()
}

fn sample(kappa1: Spacing) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sample.safetensors");
    write(&path, kappa1, &[]).unwrap();
    std::fs::read(path).unwrap()
}

fn header_len(file: &[u8]) -> usize {
    u64::from_le_bytes(file[..8].try_into().unwrap()) as usize + 8
}

/// The complaint about a file; panics when there is none.
fn complaint(bytes: &[u8]) -> String {
    match Atlas::from_bytes(bytes) {
        Err(Error::Atlas { what, .. }) => what,
        other => panic!("expected a refusal, got {other:?}"),
    }
}

/// The sample with one piece of its header replaced, the length and padding put right.
fn with_header(from: &str, to: &str) -> Vec<u8> {
    let file = sample(PLAIN);
    let (head, body) = file.split_at(header_len(&file));
    let text = std::str::from_utf8(&head[8..]).unwrap();
    assert!(text.contains(from), "{from:?} is not in the header");
    let mut text = text.replacen(from, to, 1).trim_end().to_owned().into_bytes();
    text.resize(text.len().next_multiple_of(8), b' ');
    [&(text.len() as u64).to_le_bytes()[..], &text, body].concat()
}

#[test]
fn what_is_written_comes_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sample.safetensors");
    let written = write(&path, LOG, &[1, 18, 18, 400]).unwrap();
    let (grid, atlas) = (grid(LOG), Atlas::open(&path).unwrap());
    assert_eq!(grid.len(), 420);
    atlas.check_hashes().unwrap();
    assert_eq!(atlas.grid(), &grid);
    let all = chunk(0, grid.len());
    assert_eq!((atlas.flags(), atlas.solutions()), (&all.flags[..], &all.solutions[..]));
    assert_eq!(atlas.scalar_names().collect::<Vec<_>>(), ["margin", "f0"]);
    assert_eq!(atlas.scalar("margin"), Some(&all.scalars[0][..]));
    assert_eq!(atlas.scalar("f0"), Some(&all.scalars[1][..]));
    assert_eq!((atlas.scalar("f1"), atlas.scalar("flags"), atlas.scalar("phi0")), (None, None, None));
    assert_eq!((atlas.family_name(), atlas.chart_name(), atlas.recipe_text()), ("cubic", "curvature", RECIPE));
    let flags = ["SOLVABLE", "THEOREM31", "THEOREM31_ANY", "SPIRAL", "ANY_SPIRAL"];
    assert_eq!(atlas.flag_names().collect::<Vec<_>>(), flags);
    assert_eq!(atlas.counts()[1].of(0b1101), 3);
    assert_eq!(atlas.about().name, "sample");
    assert_eq!(atlas.metadata()["no_value"].parse(), Ok(NO_VALUE));
    let hashes: Vec<_> = atlas.hashes().map(|(name, hash)| (name.to_owned(), hash)).collect();
    assert_eq!((written.hashes, written.id), (hashes, atlas.id()));
    assert_eq!(written.bytes, std::fs::metadata(&path).unwrap().len());
}

#[test]
fn lookups_find_every_node() {
    let (grid, atlas) = (grid(LOG), Atlas::from_bytes(&sample(LOG)).unwrap());
    for flat in 0..grid.len() {
        let entry = Entry { flags: (flat % 32) as u8, solutions: (flat * 7 % 16) as u8 };
        assert_eq!(atlas.at(&grid.index(flat)[..4]), Some(entry));
        assert_eq!(atlas.nearest(&grid.node(flat)[..4]), Some((flat, entry)));
    }
    assert_eq!(atlas.nearest(&[0.41, 0.9, -0.1, 0.5]).map(|n| n.0), grid.flat(&[1, 0, 0, 0]));
    assert_eq!((atlas.at(&[3, 0, 0, 0]), atlas.at(&[0, 0, 0])), (None, None));
    for outside in [[-0.21, 0.9, 0.0, 1.0], [0.1, 1.6, 0.0, 1.0], [0.1, 0.9, f64::NAN, 1.0], [0.1, 0.9, 0.0, 1e9]] {
        assert_eq!(atlas.nearest(&outside), None, "{outside:?}");
    }
    assert_eq!(atlas.nearest(&[0.1, 0.9, 0.0]), None);
}

#[test]
fn bytes_do_not_depend_on_chunks_and_tensors_are_aligned() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sample.safetensors");
    write(&path, LOG, &[3, 77, 300]).unwrap();
    let file = std::fs::read(&path).unwrap();
    assert!(file == sample(LOG), "chunks show in the file");
    assert_eq!(header_len(&file) % 8, 0);
    let tensors = safetensors::SafeTensors::deserialize(&file).unwrap();
    assert_eq!(tensors.len(), 8);
    for (name, view) in tensors.iter() {
        let offset = view.data().as_ptr().addr() - file.as_ptr().addr();
        assert_eq!(offset * 8 % view.dtype().bitsize(), 0, "`{name}` at {offset}");
    }
    assert_eq!(tensors.tensor("flags").unwrap().shape(), [3, 5, 4, 7]);
}

/// A file written once and kept: version 1 stays readable, whatever the generator's version. It seeds the fuzzer, too.
#[test]
fn a_kept_file_is_still_read() {
    let atlas = Atlas::open(Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/seeds/atlas/tiny.safetensors")).unwrap();
    atlas.check_hashes().unwrap();
    assert_eq!(atlas.id().to_hex().as_str(), "018b6b648f485d1bea5a1f65774cfeb7d7bcd90b497ea0791e6356bd3828cd29");
    assert_eq!(atlas.nearest(&[0.7, 1.31, 0.4, 1.9]), Some((10, Entry { flags: 10, solutions: 5 })));
    assert_eq!(atlas.scalar("margin").map(|m| m[10]), Some(10.0 / 32.0));
}

#[test]
fn the_writer_refuses_what_does_not_fit() {
    let folder = tempfile::tempdir().unwrap();
    let (grid, path) = (grid(LOG), folder.path().join("sample.safetensors"));
    let refuse = |what: &str, change: &dyn Fn(&mut Chunk)| {
        let mut writer = Writer::create(&path, &spec(&grid)).unwrap();
        writer.put(&chunk(0, 10)).unwrap();
        let mut next = chunk(10, 10);
        change(&mut next);
        let message = writer.put(&next).unwrap_err().to_string();
        assert!(message.contains(what), "{message}");
    };
    refuse("node 10 comes next", &|c| c.start = 11);
    refuse("node 10 comes next", &|c| c.start = 0);
    refuse("410 are left", &|c| *c = chunk(10, 411));
    refuse("differ in length", &|c| c.solutions.truncate(9));
    refuse("differ in length", &|c| c.scalars[1].truncate(9));
    refuse("1 scalars", &|c| c.scalars.truncate(1));
    refuse("`flags` entry 3 is 0x20", &|c| c.flags[3] = 0x20);
    refuse("`solutions` entry 0 is 0x10", &|c| c.solutions[0] = 0x10);
    refuse("`f0` entry 9 is NaN", &|c| c.scalars[1][9] = f32::NAN);
    let mut writer = Writer::create(&path, &spec(&grid)).unwrap();
    writer.put(&chunk(0, 10)).unwrap();
    assert!(writer.finish().unwrap_err().to_string().contains("10 of 420 nodes"));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "something was left behind");

    let refuse = |what: &str, spec: Spec| {
        let message = Writer::create(&path, &spec).unwrap_err().to_string();
        assert!(message.contains(what), "{message}");
    };
    refuse("two scalars are named `f0`", Spec { scalars: &[0, 0], ..spec(&grid) });
    refuse("no number 3", Spec { scalars: &[3], ..spec(&grid) });
    refuse("\"../a\"", Spec { name: "../a", ..spec(&grid) });
    refuse("shorten the recipe", Spec { recipe: &"#".repeat(1 << 20), ..spec(&grid) });
    let other = Grid::new(vec![grid.axes()[1].clone(), grid.axes()[0].clone()]).unwrap();
    refuse("no chart of `cubic`", Spec { grid: &other, ..spec(&grid) });
}

#[test]
fn an_unfinished_atlas_leaves_the_earlier_one() {
    let folder = tempfile::tempdir().unwrap();
    let (grid, path) = (grid(LOG), folder.path().join("sample.safetensors"));
    std::fs::write(&path, "earlier").unwrap();
    let mut writer = Writer::create(&path, &spec(&grid)).unwrap();
    writer.put(&chunk(0, 10)).unwrap();
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
    drop(writer);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    assert_eq!(std::fs::read(&path).unwrap(), b"earlier");
    write(&path, LOG, &[]).unwrap();
    assert!(Atlas::open(&path).is_ok());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn refusals_of_the_system_name_the_target() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("missing/sample.safetensors");
    let occupied = folder.path().join("occupied");
    std::fs::create_dir(&occupied).unwrap();
    std::fs::write(occupied.join("file"), "").unwrap();
    for path in [&missing, &occupied] {
        let error = write(path, LOG, &[]).unwrap_err();
        assert!(matches!(&error, Error::Io { path: named, .. } if named == path), "{error:?}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    assert!(matches!(Atlas::open(&missing), Err(Error::Io { .. })));
    assert!(matches!(Atlas::open(&occupied), Err(Error::Atlas { .. })));
    assert!(matches!(Atlas::open(occupied.join("file")), Err(Error::Atlas { .. })));
}

#[test]
fn every_truncation_is_refused() {
    let file = sample(PLAIN);
    for len in 0..file.len() {
        complaint(&file[..len]);
    }
    complaint(&[&file[..], &[0]].concat());
    assert!(Atlas::from_bytes(&file).is_ok());
}

#[test]
fn every_damaged_header_byte_is_refused() {
    let mut file = sample(PLAIN);
    for i in 0..header_len(&file) {
        for flip in [1, 0x20, 0x80] {
            file[i] ^= flip;
            complaint(&file);
            file[i] ^= flip;
        }
    }
    assert!(Atlas::from_bytes(&file).is_ok());
}

#[test]
fn every_damaged_tensor_byte_is_caught() {
    let mut file = sample(PLAIN);
    let body = header_len(&file);
    let mut caught = [0, 0];
    for i in body..file.len() {
        file[i] ^= 1;
        match Atlas::from_bytes(&file) {
            Err(_) => caught[0] += 1,
            Ok(atlas) => {
                assert!(matches!(atlas.check_hashes(), Err(Error::Atlas { .. })), "byte {i}");
                caught[1] += 1;
            }
        }
        file[i] ^= 1;
    }
    // Opening sees damage to an axis that has a rule; explicit values and fields need the hashes.
    assert_eq!(caught[0] + caught[1], file.len() - body);
    assert!(caught[0] >= 8 * (5 + 4 + 7) && caught[1] >= 420 * 10, "{caught:?}");
}

#[test]
fn hostile_headers_are_refused() {
    let cases = [
        ("\"format_version\":\"1\"", "\"format_version\":\"2\"", "format version is \"2\""),
        ("\"format_version\":\"1\"", "\"format_version\":\"01\"", "format version"),
        ("\"format\":\"spiral-atlas\"", "\"format\":\"pt\"", "its format"),
        ("\"format\":", "\"formal\":", "lacks `format`"),
        ("\"dtype\":\"U8\"", "\"dtype\":\"I8\"", "tensor `flags` is I8"),
        ("\"dtype\":\"U8\"", "\"dtype\":\"U128\"", "its header is no safetensors header: "),
        ("\"dtype\":\"F32\"", "\"dtype\":\"U32\"", "tensor `margin` is U32"),
        ("[3,5,4,7]", "[3,5,7,4]", "tensor `margin`"),
        ("[3,5,4,7]", "[3,5,4294967296,4294967296]", "overflow"),
        ("[3,5,4,7]", "[3,5,4,70]", "its header is no safetensors header: "),
        ("[24,64]", "[0,40]", "its header is no safetensors header: "),
        ("[24,64]", "[32,72]", "its header is no safetensors header: "),
        ("{\"dtype\":\"F64\",\"shape\":[3]", "{\"dtype\":\"F64\",\"shape\":[3,1]", "one row"),
        ("{\"dtype\":\"F64\",\"shape\":[3]", "{\"dtype\":\"I64\",\"shape\":[3]", "I64"),
        ("\"phi1\":{", "\"phi0\":{", ""),
        ("{\\\"name\\\":\\\"kappa0\\\"", "{\\\"name\\\":\\\"phi1\\\"", "is given twice"),
        ("{\\\"name\\\":\\\"phi1\\\"", "{\\\"name\\\":\\\"psi\\\"", "no tensor for the axis `psi`"),
        ("{\\\"name\\\":\\\"phi1\\\"", "{\\\"name\\\":\\\"flags\\\"", "the axis `flags` is U8"),
        ("\\\"linear\\\"", "\\\"log\\\"", "of its Log spacing"),
        (
            "\\\"linear\\\"",
            "\\\"cubic\\\"",
            "its metadata `axes` cannot be read: it must be one of `linear`, `log`, `values`; it is `cubic`",
        ),
        ("{\\\"name\\\":\\\"f0\\\"", "{\\\"name\\\":\\\"margin\\\"", "two scalars are named `margin`"),
        ("{\\\"name\\\":\\\"f0\\\"", "{\\\"name\\\":\\\"phi0\\\"", "two tensors are named `phi0`"),
        ("{\\\"name\\\":\\\"f0\\\"", "{\\\"name\\\":\\\"f 0\\\"", "\"f 0\""),
        ("\\\"shift\\\":2", "\\\"shift\\\":1", "its own bits"),
        ("\\\"shift\\\":2", "\\\"shift\\\":4000000000", "its own bits"),
        ("\\\"bits\\\":2", "\\\"bits\\\":9", "its own bits"),
        ("\"name\":\"sample\"", "\"name\":\"sam/ple\"", "atlas name"),
        ("\"no_value\":\"-", "\"no_value\":\"+", "not spelt"),
        ("\"recipe\":", "\"extra\":\"\",\"recipe\":", "not spelt"),
        ("\"blake3.f0\":\"", "\"blake3.f0\":\"g", "hash of `f0`"),
        ("\"blake3.f0\":\"", "\"blake3.g0\":\"", "no hash of `f0`"),
        ("{\"__metadata__\"", " {\"__metadata__\"", "not spelt"),
        (
            "{\"dtype\":\"F64\",\"shape\":[3]",
            "3,\"x\":{\"dtype\":\"F64\",\"shape\":[3]",
            "its header is no safetensors header: it must be",
        ),
    ];
    for (from, to, what) in cases {
        let message = complaint(&with_header(from, to));
        assert!(message.contains(what), "{to}: {message}");
        assert!(
            !["expected", "invalid type", "struct", "variant"].iter().any(|word| message.contains(word)),
            "{to}: {message}"
        );
    }
    assert!(Atlas::from_bytes(&with_header("sample", "sample")).is_ok(), "the tests' own editing breaks the file");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    /// Bytes changed, cut out or put in, anywhere: an error, or an atlas whose every part can be looked at.
    #[test]
    fn mutated_files_never_panic(
        edits in prop::collection::vec((any::<prop::sample::Index>(), 0..3, any::<u8>()), 1..4),
    ) {
        let mut file = sample_once().to_vec();
        for (place, kind, byte) in edits {
            let at = place.index(file.len());
            match kind {
                0 => file[at] = byte,
                1 => file.insert(at, byte),
                _ => drop(file.remove(at)),
            }
        }
        look_at_everything(&file);
    }

    #[test]
    fn random_bytes_are_refused(body in prop::collection::vec(any::<u8>(), 0..200), header in 0u64..200) {
        complaint(&body);
        complaint(&[&header.to_le_bytes()[..], &body].concat());
    }

    /// Well-formed safetensors headers with wild numbers.
    #[test]
    fn wild_offsets_are_refused(
        shape in prop::collection::vec(wild(), 0..5), start in wild(), end in wild(), more in 0usize..9,
    ) {
        let tensor =
            |i: usize| format!(r#""t{i}":{{"dtype":"F64","shape":{shape:?},"data_offsets":[{start},{end}]}}"#);
        let list: Vec<String> = (0..=more).map(tensor).collect();
        let mut text = format!("{{{}}}", list.join(",")).into_bytes();
        text.resize(text.len().next_multiple_of(8), b' ');
        complaint(&[&(text.len() as u64).to_le_bytes()[..], &text, &[0; 16]].concat());
    }
}

fn wild() -> impl Strategy<Value = u64> {
    prop_oneof![0u64..20, any::<u64>(), Just(1 << 61), Just(u64::MAX), Just(u64::MAX - 7)]
}

fn sample_once() -> &'static [u8] {
    static SAMPLE: std::sync::OnceLock<Vec<u8>> = std::sync::OnceLock::new();
    SAMPLE.get_or_init(|| sample(PLAIN))
}

/// What the fuzz target does, too.
fn look_at_everything(bytes: &[u8]) {
    if let Ok(atlas) = Atlas::from_bytes(bytes) {
        let _ = atlas.check_hashes();
        let last = atlas.grid().len() - 1;
        let node = atlas.grid().node(last);
        let found = atlas.nearest(&node[..atlas.grid().axes().len()]).expect("a node is nearest to itself");
        assert_eq!(found.0, last);
        assert!(atlas.scalar_names().all(|name| atlas.scalar(name).is_some_and(|s| s.len() as u64 == last + 1)));
    }
}

/// Tensors of the largest size that counts its bits in 64 end just below 2^64 together: the end that they announce,
/// plus the header, must not wrap around to the file's true length.
#[test]
fn offsets_that_wrap_around_are_refused() {
    let size = (1u64 << 61) - 8;
    let tensor = |i: u64, end: u64| {
        let (start, count) = (i * size, (end - i * size) / 8);
        format!("\"t{i}\":{{\"dtype\":\"F64\",\"shape\":[{count}],\"data_offsets\":[{start},{end}]}}")
    };
    let list: Vec<String> = (0..9).map(|i| tensor(i, if i < 8 { (i + 1) * size } else { u64::MAX - 7 })).collect();
    let mut text = format!("{{{}}}", list.join(",")).into_bytes();
    text.resize(text.len().next_multiple_of(8), b' ');
    let message = complaint(&[&(text.len() as u64).to_le_bytes()[..], &text].concat());
    assert!(message.contains("are announced"), "{message}");
}
