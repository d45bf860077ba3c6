//! The C compilers of this machine.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Every warning is an error.
const STRICT: [&str; 9] = [
    "-std=c99",
    "-ffp-contract=off",
    "-Wall",
    "-Wextra",
    "-pedantic",
    "-Wconversion",
    "-Wdouble-promotion",
    "-Wshadow",
    "-Werror",
];

/// The compilers that there are; says which are not.
pub fn compilers() -> Vec<&'static str> {
    let there = |name: &&str| {
        let run = Command::new(name).arg("--version").stdout(Stdio::null()).status();
        let found = run.is_ok_and(|status| status.success());
        if !found {
            eprintln!("skipped: no {name} on the path to compile the generated C with");
        }
        found
    };
    ["gcc", "clang"].into_iter().filter(there).collect()
}

/// A folder that is gone when it is dropped.
pub struct Folder(PathBuf);

impl Folder {
    pub fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("stiffarm-c-{}-{name}", std::process::id()));
        std::fs::create_dir_all(&path).expect("a folder");
        Folder(path)
    }

    pub fn path(&self) -> &Path {
        &self.0
    }

    pub fn write(&self, name: &str, text: &str) {
        std::fs::write(self.0.join(name), text).expect("written");
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // What is left behind in the folder for temporary files harms nobody.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Compiles inside a folder.
///
/// # Errors
/// What the compiler says.
pub fn tried(compiler: &str, folder: &Folder, arguments: &[&str]) -> Result<(), String> {
    let mut command = Command::new(compiler);
    command.args(STRICT).args(arguments).current_dir(folder.path());
    let output = command.output().expect("the compiler starts");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    if output.status.success() { Ok(()) } else { Err(said) }
}

/// Compiles inside a folder; panics with what the compiler says.
pub fn compile(compiler: &str, folder: &Folder, arguments: &[&str]) {
    if let Err(said) = tried(compiler, folder, arguments) {
        panic!("{compiler} {}:\n{said}", arguments.join(" "));
    }
}

/// Runs a program of the folder with this input and gives what it prints.
pub fn run(folder: &Folder, program: &str, input: &str) -> String {
    spoken(Command::new(folder.path().join(program)), input)
}

/// What a program prints to this input.
pub fn spoken(mut program: Command, input: &str) -> String {
    let mut child =
        program.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("the program starts");
    let mut stdin = child.stdin.take().expect("piped");
    let input = input.to_owned();
    let writer = std::thread::spawn(move || stdin.write_all(input.as_bytes()));
    let output = child.wait_with_output().expect("the program ends");
    writer.join().expect("no panic").expect("all of the input is read");
    assert!(output.status.success(), "{program:?} ended with {}", output.status);
    String::from_utf8(output.stdout).expect("UTF-8")
}
