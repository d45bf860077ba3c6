//! The C compilers of this machine.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use stiffarm_codegen::emit::{COptions, Precision, Sines, c};
use stiffarm_codegen::robot::Robot;

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

/// How texts are compiled whose values are compared: as a controller's are, where there is time.
pub fn optimised() -> &'static str {
    stiffarm_draws::few_or_many("-O0", "-O2")
}

/// What of CUDA the text uses, for a C compiler.
pub const CUDA: &str = "
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#define __global__ static
#define __device__
static struct { unsigned int x; } threadIdx, blockIdx, blockDim;
static inline void sincos(double x, double *s, double *c) { *s = sin(x); *c = cos(x); }
#define LAUNCH(kernel) \\
    for (blockIdx.x = 0U; blockIdx.x * blockDim.x < COUNT; blockIdx.x++) \\
        for (threadIdx.x = 0U; threadIdx.x < blockDim.x; threadIdx.x++) \\
            kernel
";

/// A test for each compiler from a function that takes its name. With `cc` Rust itself links on Unix, so that
/// it is there; what else is needed is ignored, and run where `--ignored` asks for it.
macro_rules! with_each_compiler {
    ($($name:ident)+) => {$(
        mod $name {
            #[test]
            #[cfg_attr(not(unix), ignore = "needs cc")]
            fn with_cc() {
                super::$name("cc");
            }

            #[test]
            #[ignore = "needs clang"]
            fn needs_clang() {
                super::$name("clang");
            }
        }
    )+};
}
pub(crate) use with_each_compiler;

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

    /// The C of a robot of numbers, as `name.h` and `name.c`.
    pub fn write_c(&self, robot: &Robot, name: &str, (precision, sines): (Precision, Sines)) {
        let options = COptions { name: name.to_owned(), precision, sines };
        let files = c(robot, &options).expect("numbers only");
        self.write(&format!("{name}.h"), &files.header);
        self.write(&format!("{name}.c"), &files.source);
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
    let output = command.output().unwrap_or_else(|error| panic!("{compiler}: {error}"));
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
