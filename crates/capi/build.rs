//! The shared library's own name, which programs that link to it look for: that of its first version that breaks no
//! binary.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var("CARGO_CFG_TARGET_OS").is_ok_and(|os| os == "linux") {
        println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,libspiral_atlas_c.so.0");
    }
}
