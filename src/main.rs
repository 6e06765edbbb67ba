//! The program `spiral-atlas`.

mod cli;

fn main() -> std::process::ExitCode {
    leave_the_display_alone();
    cli::main()
}

/// Turns off Mesa's Vulkan layer that sorts devices by the display they are connected to, unless the user gave it a wish.
///
/// This program never draws on a display, and chooses its adapter itself. The layer asks the Wayland library for a display all the same,
/// and that library complains on standard error, once for each try, wherever there is none: on servers, in containers, in CI.
/// A library must not change the environment of its program, so this is done here and not where adapters are listed.
fn leave_the_display_alone() {
    if ["NODEVICE_SELECT", "MESA_VK_DEVICE_SELECT"].iter().all(|name| std::env::var_os(name).is_none()) {
        // SAFETY: another thread that reads the environment meanwhile would make this unsound. `main` calls this first of all,
        // and the program has no other thread yet.
        unsafe { std::env::set_var("NODEVICE_SELECT", "1") };
    }
}
