//! The macro's input, right and wrong: what `stiffarm::robot!` accepts, and what it says otherwise.
//!
//! Each file of `wrong/` is a table with mistakes and code that uses its module. The `.stderr` beside
//! it is all that the compiler says: one error per mistake, at its cell, and none about the code. In `missing/`
//! the tables are right, and the code asks for what they do not have. Every sentence about a mistake is in
//! `tests/text/mistakes.rs`; here is a case of each kind, for what the compiler makes of it.
//! `TRYBUILD=overwrite cargo test -p stiffarm-tables -- --ignored` writes these files; read them as a user would.

use std::path::Path;
use std::{fs, io};

mod right;

/// Robot files are looked for beside the Cargo.toml of the package that invokes the macro: for a wrong
/// table that is the one that trybuild writes.
fn provide_files() -> io::Result<()> {
    let package =
        Path::new(env!("CARGO_TARGET_TMPDIR")).with_file_name("tests/trybuild/stiffarm-tables");
    fs::create_dir_all(package.join("files"))?;
    for file in fs::read_dir("files")? {
        let file = file?;
        fs::copy(file.path(), package.join("files").join(file.file_name()))?;
    }
    Ok(())
}

#[test]
#[ignore = "needs time: compiles the macro once more"]
fn needs_time_wrong_tables_are_explained() {
    provide_files().expect("robot files can be copied");
    let cases = trybuild::TestCases::new();
    cases.compile_fail("wrong/*.rs");
    cases.compile_fail("missing/*.rs");
}

/// The reviewed outputs hold no errors of the compiler's own: those have codes, or are warnings.
#[test]
fn nothing_cascades() {
    let wrong = Path::new("wrong").read_dir().expect("the folder is here");
    let paths = wrong.flatten().map(|file| file.path());
    let outputs: Vec<_> =
        paths.filter(|path| path.extension() == Some("stderr".as_ref())).collect();
    // Each is a compilation: what differs in its words alone is a case of the golden table.
    assert!((20..=24).contains(&outputs.len()), "{} wrong tables", outputs.len());
    for path in outputs {
        let text = fs::read_to_string(&path).expect("a text");
        let sound = |line: &str| !line.starts_with("error[") && !line.starts_with("warning");
        assert!(text.lines().all(sound), "{}:\n{text}", path.display());
    }
}
