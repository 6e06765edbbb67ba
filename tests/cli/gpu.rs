//! The program on every GPU adapter there is.

use super::{Folder, TINY, adapters, fine, run};

#[test]
fn every_adapter_writes_the_file_of_the_cpu() {
    for label in adapters::labels() {
        let (cpu, gpu) = (Folder::new(TINY), Folder::new(TINY));
        cpu.generate(&[]);
        let out = gpu.text("out");
        let said = fine(["generate", &gpu.text("recipe.toml"), "--out", &out, "--adapter", &label, "--check", "full"]);
        assert!(said.out.contains(&format!("by {label}")) && said.out.contains("against the CPU"), "{}", said.out);
        let read = |folder: &Folder| std::fs::read(folder.at("out/tiny.atlas.safetensors")).unwrap();
        assert!(read(&cpu) == read(&gpu));

        let file = cpu.text("out/tiny.atlas.safetensors");
        let json = fine(["verify", &file, "--adapter", &label, "--json"]).json();
        assert_eq!((&json["comparisons"][0]["with"], &json["comparisons"][0]["nodes"]), (&label.clone().into(), &180.into()));
        assert!(json["comparisons"][0]["undecided_f32"].as_u64().is_some_and(|n| n < 90), "{json}");
        let mut bytes = read(&cpu);
        let last = bytes.len() - 1;
        bytes[last] ^= 1;
        std::fs::write(&file, bytes).unwrap();
        let bad = run(["verify", &file, "--adapter", &label, "--json"]);
        assert_eq!((bad.code, &bad.json()["comparisons"][0]["first"][0]["node"]), (Some(1), &179.into()));
    }
}

#[test]
fn verify_takes_all_there_is_and_a_full_check_what_is_left() {
    let labels = adapters::labels();
    let folder = Folder::new(TINY);
    let said = folder.generate(&["--check", "full"]);
    let verified = fine(["verify", &folder.text("out/tiny.atlas.safetensors")]).out;
    assert!(verified.contains("against the CPU"));
    assert!(labels.iter().all(|l| said.out.contains(&format!("against {l}")) && verified.contains(&format!("against {l}"))));
}
