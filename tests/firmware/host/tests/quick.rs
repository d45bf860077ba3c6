//! The quick form: no emulator, the machine's own compiler, the host's own instructions.
//!
//! The kernels and the loop become a library without std, which is linked against nothing but the
//! four functions that any target has (memory is copied, set, moved and compared). What can panic
//! reaches a function that is nowhere defined, and what allocates finds no allocator: neither
//! links.

use std::env;
use std::path::PathBuf;
use std::process::Command;

use stiffarm_firmware_arms::Real;
use stiffarm_firmware_host::Failure;
use stiffarm_firmware_host::bits::Results;
use stiffarm_firmware_host::tools::{Tools, refused, succeed};

/// What the linker takes as given: the sink of the results, and what the target's runtime always
/// has.
const GIVEN: [&str; 6] = ["stiffarm_sink", "memcpy", "memmove", "memset", "memcmp", "bcmp"];

/// One test, since the library has one place: it links, in f32 and f64; with one indexed access it
/// does not, and with an allocation it does not.
#[test]
fn no_panic_can_be_reached_and_nothing_allocates() {
    let tools = Tools::new(None).expect("the folders are there");
    link(&tools, &[]).expect("the kernels and the loop link");
    refused(link(&tools, &["control-panic"]), &["a_panic_can_be_reached"]).expect("a panic");
    refused(link(&tools, &["control-alloc"]), &["no global memory allocator"]).expect("alloc");
}

/// What an image is compared with: whole, equal to itself, and not to one with a bit turned over.
fn comparable<S: Real>() {
    let results = Results::<S>::of_the_host();
    results.are_whole(true).expect("every kernel, every period, refusals of both kinds");
    assert_eq!(results.difference(&results), None);
    assert!(results.tampered().difference(&results).is_some());
    assert!(results.count() > 3_000_000);
}

#[test]
fn a_bit_that_is_turned_over_is_found() {
    comparable::<f32>();
    comparable::<f64>();
}

/// Builds the library and links it into a program that is not to be run.
fn link(tools: &Tools, features: &[&str]) -> Result<PathBuf, Failure> {
    let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.current_dir(&tools.workspace).args(["rustc", "--target-dir"]).arg(&tools.shared);
    cargo.args(["--package", "stiffarm-firmware-probe", "--features", &features.join(",")]);
    // A library without std has nowhere to unwind to.
    cargo.args(["--", "-C", "panic=abort"]);
    succeed(cargo)?;
    let program = tools.target.join("probe");
    let mut linker = Command::new("cc");
    linker.args(["-nostdlib", "-no-pie", "-Wl,--gc-sections", "-Wl,-e,stiffarm_probe"]);
    linker.arg("-Wl,-u,stiffarm_probe");
    linker.args(GIVEN.map(|name| format!("-Wl,--defsym={name}=0")));
    linker.arg(tools.shared.join("debug/libstiffarm_firmware_probe.a")).arg("-o").arg(&program);
    succeed(linker)?;
    Ok(program)
}
