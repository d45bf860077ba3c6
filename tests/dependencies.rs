//! What a plain dependant compiles: `stiffarm = "…"` is the macro and the kernels, nothing else.

use std::process::Command;

/// Packages from the registry: what the macro needs to read a table and a robot file, libm for the
/// kernels.
const MOST: usize = 20;

#[test]
fn a_plain_dependant_compiles_few_packages() {
    let arguments = ["tree", "--package", "stiffarm", "--edges", "normal", "--prefix", "none"];
    let output = Command::new(env!("CARGO"))
        .args(arguments)
        .args(["--no-dedupe", "--locked", "--offline", "--format", "{p}"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let tree = String::from_utf8(output.stdout).expect("UTF-8");
    let others = tree.lines().filter(|package| !package.starts_with("stiffarm"));
    let mut packages: Vec<&str> = others.collect();
    packages.sort_unstable();
    packages.dedup();
    assert!(tree.starts_with("stiffarm v") && packages.iter().any(|p| p.starts_with("libm v")));
    assert!(packages.len() <= MOST, "{} packages:\n{}", packages.len(), packages.join("\n"));
}
