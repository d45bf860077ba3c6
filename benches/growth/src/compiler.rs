//! The compiler on a generated text: how long it takes, and how fast what it makes is.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::Instant;

/// A program that has every output of a text for f64, and times two.
const PROGRAM: &str = include_str!("timed.rs");

/// What a text takes and gives.
pub struct Compiled {
    /// Seconds until it is checked.
    pub checked: f64,
    /// Seconds until it is compiled without optimisation.
    pub unoptimised: f64,
    /// Seconds until it is compiled with optimisation.
    pub optimised: f64,
    /// Nanoseconds of a Jacobian.
    pub jacobian: f64,
    /// Nanoseconds of a first-order deflection.
    pub deflection: f64,
}

/// The compiler, and the kernels crate compiled for it.
pub struct Compiler {
    directory: PathBuf,
    /// The compiled kernels crate.
    kernels: PathBuf,
}

impl Compiler {
    /// Compiles the kernels crate, in a directory beside what this bench is compiled into.
    ///
    /// # Errors
    /// The crate does not compile.
    pub fn new() -> Result<Self, Box<dyn Error>> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize()?;
        let binary = std::env::current_exe()?;
        let beside = binary.parent().ok_or("the bench stands in no directory")?;
        let directory = beside.join("growth_of_joints");
        std::fs::create_dir_all(directory.join("src"))?;
        let manifest = format!(
            "[package]\nname = \"growth_of_joints\"\nversion = \"0.0.0\"\nedition = \"2024\"\n\
             [workspace]\n[dependencies]\nstiffarm-kernels = {{ path = {:?} }}\n",
            root.join("kernels")
        );
        std::fs::write(directory.join("Cargo.toml"), manifest)?;
        std::fs::copy(root.join("Cargo.lock"), directory.join("Cargo.lock"))?;
        std::fs::write(directory.join("src/lib.rs"), "")?;
        let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
        let target = directory.join("target");
        let mut build = Command::new(cargo);
        build.args(["build", "--release", "--target-dir"]).arg(&target).current_dir(&directory);
        finished(build.env_remove("RUSTFLAGS").output()?)?;
        let is_it = |path: &PathBuf| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            name.starts_with("libstiffarm_kernels") && name.ends_with(".rlib")
        };
        let all = std::fs::read_dir(target.join("release/deps"))?;
        let mut found: Vec<PathBuf> = all.flatten().map(|e| e.path()).filter(is_it).collect();
        // Of several compilations the last one is the one just made.
        found.sort_by_key(|path| path.metadata().and_then(|m| m.modified()).ok());
        let kernels = found.pop().ok_or("the kernels crate was compiled to nothing")?;
        Ok(Self { directory, kernels })
    }

    /// Compiles a text in three ways and runs it.
    ///
    /// # Errors
    /// It does not compile or does not run.
    pub fn compile(&self, text: &str) -> Result<Compiled, Box<dyn Error>> {
        std::fs::write(self.directory.join("arm.rs"), text)?;
        std::fs::write(self.directory.join("timed.rs"), PROGRAM)?;
        let checked = self.rustc(&["--emit=metadata"])?;
        let unoptimised = self.rustc(&["-Copt-level=0"])?;
        let optimised = self.rustc(&["-Copt-level=3"])?;
        let told = finished(Command::new(self.directory.join("timed")).output()?)?;
        let numbers: Vec<f64> =
            told.split_whitespace().map(str::parse).collect::<Result<_, _>>()?;
        let [jacobian, deflection] = numbers[..] else {
            return Err("found another number of times, expected 2".into());
        };
        Ok(Compiled { checked, unoptimised, optimised, jacobian, deflection })
    }

    /// Seconds of the compiler.
    fn rustc(&self, options: &[&str]) -> Result<f64, Box<dyn Error>> {
        let rustc = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".to_owned());
        let dependencies = self.kernels.with_file_name("");
        let mut compile = Command::new(rustc);
        compile.args(["--edition=2024", "--crate-type=bin", "timed.rs", "-o", "timed"]);
        compile.args(options).current_dir(&self.directory);
        compile.arg("--extern").arg(format!("stiffarm_kernels={}", self.kernels.display()));
        compile.arg("-L").arg(format!("dependency={}", dependencies.display()));
        let begin = Instant::now();
        finished(compile.output()?)?;
        Ok(begin.elapsed().as_secs_f64())
    }
}

/// What a program said, if it ended well.
fn finished(output: Output) -> Result<String, Box<dyn Error>> {
    if output.status.success() {
        return Ok(String::from_utf8(output.stdout)?);
    }
    Err(String::from_utf8_lossy(&output.stderr).into_owned().into())
}
