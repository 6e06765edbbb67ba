//! The program `spiral-atlas`.

mod cli;

fn main() -> std::process::ExitCode {
    // SAFETY: another thread that reads the environment meanwhile would make this unsound. It is done first of all, and
    // the program has no other thread yet.
    unsafe { leave_the_display_alone() };
    cli::main()
}

/// Keeps Mesa's libraries silent about displays and drivers that this program does without, unless the user gave them a
/// wish.
///
/// The Vulkan layer that sorts devices by the display they are connected to asks the Wayland library for a display, and
/// that library complains on standard error, once for each try, wherever there is none: on servers, in containers, in
/// CI. This program never draws on a display, and chooses its adapter itself. EGL, which is asked for adapters where
/// Vulkan has none, warns of each driver that it does not find; that there is no adapter, this program reports. No
/// adapter is lost by either.
///
/// A library must not change the environment of its program, so this is done here and not where adapters are listed.
///
/// # Safety
/// No other thread may read the environment meanwhile.
unsafe fn leave_the_display_alone() {
    let given = |name: &&str| std::env::var_os(name).is_some();
    let silent: [(&[&str], &str); 2] =
        [(&["NODEVICE_SELECT", "MESA_VK_DEVICE_SELECT"], "1"), (&["EGL_LOG_LEVEL"], "fatal")];
    for (names, value) in silent {
        if !names.iter().any(given) {
            // SAFETY: as the caller promises.
            unsafe { std::env::set_var(names[0], value) };
        }
    }
}
