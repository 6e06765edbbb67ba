//! The program on every GPU adapter there is.

use super::{Folder, Said, TINY, adapters, fine, program, run};
use serde_json::Value;
use std::path::Path;

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
        assert_eq!(
            (&json["comparisons"][0]["with"], &json["comparisons"][0]["nodes"]),
            (&label.clone().into(), &180.into())
        );
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
    assert!(
        labels.iter().all(|l| said.out.contains(&format!("against {l}")) && verified.contains(&format!("against {l}")))
    );
}

#[test]
fn verify_says_when_nothing_was_compared_with_a_gpu() {
    let folder = Folder::new(TINY);
    folder.generate(&[]);
    let file = folder.text("out/tiny.atlas.safetensors");
    // A driver list that names nothing is a machine without an adapter.
    let alone = |args: &[&str]| -> Said {
        let mut command = program();
        command
            .args(["verify", &file])
            .args(args)
            .env("VK_DRIVER_FILES", folder.at("none"))
            .env("VK_ICD_FILENAMES", folder.at("none"));
        command.env("WGPU_BACKEND", "vulkan").output().unwrap().into()
    };
    let said = alone(&[]);
    assert_eq!(said.code, Some(0), "{}", said.err);
    assert!(said.out.contains("NOT compared with any GPU (GPU: there is no adapter;"), "{}", said.out);
    assert!(alone(&["--json"]).json()["no_gpu"].as_str().is_some_and(|why| why.contains("mesa-vulkan-drivers")));
    let said = alone(&["--require-adapter"]);
    assert_eq!((said.code, &said.out[..]), (Some(2), ""));
    assert!(said.err.contains("there is no adapter") && said.err.contains("apt-get install"), "{}", said.err);

    let json = fine(["verify", &file, "--require-adapter", "--json"]).json();
    assert_eq!(
        (&json["no_gpu"], json["comparisons"].as_array().map(Vec::len)),
        (&Value::Null, Some(1 + adapters::labels().len()))
    );
    assert!(
        fine(["verify", &file, "--backend", "cpu"])
            .out
            .contains("NOT compared with any GPU (only the CPU was asked for)")
    );
    let said = run(["verify", &file, "--backend", "cpu", "--require-adapter"]);
    assert!(
        said.code == Some(2) && said.err.contains("--require-adapter") && said.err.contains("Usage"),
        "{}",
        said.err
    );
}

/// Mesa's layer for displays and the library of Wayland have nothing to say on a machine without a display.
#[test]
fn standard_error_is_silent_on_a_machine_without_a_display() {
    let folder = Folder::new(TINY);
    folder.generate(&[]);
    let file = folder.text("out/tiny.atlas.safetensors");
    let (recipe, out) = (folder.text("recipe.toml"), folder.text("out"));
    for args in [&["verify", &file][..], &["generate", &recipe, "--out", &out], &["adapters"]] {
        let mut command = program();
        for name in ["NODEVICE_SELECT", "MESA_VK_DEVICE_SELECT", "XDG_RUNTIME_DIR", "DISPLAY", "WAYLAND_DISPLAY"] {
            command.env_remove(name);
        }
        let said: Said = command.args(args).output().unwrap().into();
        assert_eq!((said.code, &said.err[..]), (Some(0), ""), "{args:?}");
    }
}

/// EGL, which is asked where Vulkan has nothing, has nothing to say where it has no driver.
#[test]
fn standard_error_is_silent_where_there_is_no_driver() {
    let none = "/no/such/drivers";
    let mut command = program();
    command
        .env("VK_DRIVER_FILES", none)
        .env("VK_ICD_FILENAMES", none)
        .env("LIBGL_DRIVERS_PATH", none)
        .env_remove("EGL_LOG_LEVEL");
    let said: Said = command.arg("adapters").output().unwrap().into();
    assert_eq!((said.code, &said.err[..]), (Some(0), ""));
    assert!(said.out.contains("there is no adapter"), "{}", said.out);
}

/// The workflow of docs/ci.md: what it runs of this program is run here, and it installs what `tests/setup` installs.
#[test]
fn the_workflow_of_the_page_about_ci_works() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = std::fs::read_to_string(root.join("docs/ci.md")).unwrap();
    let workflow = page.split("```yaml\n").nth(1).unwrap().split("```").next().unwrap();
    let steps: Vec<&str> = workflow.lines().filter_map(|line| line.trim().strip_prefix("- run: ")).collect();
    let install = "apt-get install -y --no-install-recommends libvulkan1 mesa-vulkan-drivers";
    assert!(steps.contains(&&format!("sudo {install}")[..]) && steps.contains(&"cargo install --locked --path ."));
    let ours = std::fs::read_to_string(root.join("tests/setup")).unwrap();
    assert!(ours.contains("install libvulkan1 mesa-vulkan-drivers"));

    let folder = Folder::new(TINY);
    std::fs::create_dir(folder.at("atlases")).unwrap();
    std::fs::copy(root.join("atlases/quickstart.toml"), folder.at("atlases/quickstart.toml")).unwrap();
    let commands: Vec<&str> = steps.iter().filter_map(|step| step.strip_prefix("spiral-atlas ")).collect();
    let said = commands.iter().map(|command| {
        let said: Said = program().current_dir(folder.at("")).args(command.split_whitespace()).output().unwrap().into();
        assert_eq!((said.code, &said.err[..]), (Some(0), ""), "{command}");
        said.out
    });
    let said: Vec<String> = said.collect();
    assert_eq!(said.len(), 3);
    assert!(adapters::labels().iter().all(|label| said[2].contains(&format!("against {label}"))), "{}", said[2]);
}
