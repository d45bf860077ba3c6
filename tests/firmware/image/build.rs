//! Where the linker finds the image's memory, and C objects if there are any.

use std::path::Path;
use std::{env, fs};

/// mps2-an386 and mps2-an500: 4 MB of memory each for code and data.
const MEMORY: &str = "MEMORY
{
  FLASH : ORIGIN = 0x00000000, LENGTH = 4M
  RAM : ORIGIN = 0x20000000, LENGTH = 4M
}
";

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-env-changed=STIFFARM_C_OBJECTS");
    if env::var("CARGO_CFG_TARGET_OS").as_deref() != Ok("none") {
        return;
    }
    let out = env::var("OUT_DIR").expect("cargo sets OUT_DIR");
    fs::write(Path::new(&out).join("memory.x"), MEMORY).expect("OUT_DIR can be written to");
    println!("cargo::rustc-link-search={out}");
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    if let Ok(objects) = env::var("STIFFARM_C_OBJECTS") {
        for object in objects.split_whitespace() {
            println!("cargo::rerun-if-changed={object}");
            println!("cargo::rustc-link-arg-bins={object}");
        }
    }
}
