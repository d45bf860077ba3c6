//! The tools: those of a prefix of Debian packages, or those on the path with a target of rustup.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::{env, fs};

use crate::Failure;
use crate::board::Board;

/// The target of the images.
pub const TARGET: &str = "thumbv7em-none-eabihf";

/// Instructions take 2^10 ns of the emulator's time each.
pub const SHIFT: u32 = 10;

/// What the images are built and run with.
pub struct Tools {
    /// The folder that Debian packages were unpacked into; without one, what is on the path.
    prefix: Option<PathBuf>,
    /// The firmware's workspace.
    pub workspace: PathBuf,
    /// Where the host's compiler builds, as the main workspace does.
    pub shared: PathBuf,
    /// Where the images are built.
    pub target: PathBuf,
}

impl Tools {
    /// The tools of `prefix`, or those on the path.
    pub fn new(prefix: Option<PathBuf>) -> Result<Self, Failure> {
        let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let workspace = fs::canonicalize(&workspace)
            .map_err(|e| format!("{}: {e}: run it from where it was built", workspace.display()))?;
        let shared = match env::var_os("CARGO_TARGET_DIR") {
            Some(folder) => env::current_dir().map_err(|e| e.to_string())?.join(folder),
            None => workspace.join("../../target"),
        };
        let prefix = match prefix {
            Some(folder) if !folder.join("complete").exists() => {
                let folder = folder.display();
                return Err(format!("{folder} is not complete: tests/firmware/fetch {folder}"));
            }
            Some(folder) => Some(fs::canonicalize(&folder).map_err(|e| e.to_string())?),
            None => None,
        };
        let target = shared.join("firmware");
        fs::create_dir_all(&target).map_err(|e| format!("{}: {e}", target.display()))?;
        Ok(Tools { prefix, workspace, shared, target })
    }

    /// A program of the prefix, or on the path.
    pub fn command(&self, program: &str) -> Command {
        let Some(prefix) = &self.prefix else { return Command::new(program) };
        let mut command = Command::new(prefix.join("usr/bin").join(program));
        command.env("LD_LIBRARY_PATH", libraries(prefix));
        command
    }

    /// Cargo, for a board: `cargo build` of the image with everything but what to build.
    fn cargo(&self, board: Board) -> Command {
        let mut command = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
        let mut flags = board.rustflags.to_string();
        command.current_dir(&self.workspace).args(["build", "--release", "--target", TARGET]);
        command.args(["--package", "stiffarm-firmware-image", "--target-dir"]).arg(&self.target);
        if let Some(prefix) = &self.prefix {
            let bin = prefix.join("usr/bin");
            flags.push_str(" -C linker-flavor=ld");
            command
                .args(["-Z", "build-std=core"])
                .env("RUSTC_BOOTSTRAP", "1")
                .env("RUSTC", bin.join("rustc"))
                .env("LD_LIBRARY_PATH", libraries(prefix))
                .env("CARGO_TARGET_THUMBV7EM_NONE_EABIHF_LINKER", bin.join("arm-none-eabi-ld"));
        }
        command.env("CARGO_TARGET_THUMBV7EM_NONE_EABIHF_RUSTFLAGS", flags);
        // What a test runner or a caller wants of the host's code is not for the image.
        command.env_remove("RUSTFLAGS").env_remove("CARGO_ENCODED_RUSTFLAGS");
        command.env_remove("CARGO_TARGET_DIR");
        command
    }

    /// Builds an image for a board and keeps it as `name`.
    pub fn build(
        &self,
        board: Board,
        bin: &str,
        features: &[&str],
        objects: &[PathBuf],
        name: &str,
    ) -> Result<PathBuf, Failure> {
        let features = [board.features, features].concat().join(",");
        let mut cargo = self.cargo(board);
        cargo.args(["--bin", bin, "--features", &features]);
        if !objects.is_empty() {
            let paths: Vec<String> = objects.iter().map(|o| o.display().to_string()).collect();
            cargo.env("STIFFARM_C_OBJECTS", paths.join(" "));
        }
        succeed(cargo)?;
        // The other board's image of this name lies in the same place.
        let built = self.target.join(TARGET).join("release").join(bin);
        let kept = self.target.join(format!("{name}-{}.elf", board.key));
        fs::copy(&built, &kept).map_err(|e| format!("{}: {e}", built.display()))?;
        Ok(kept)
    }

    /// Runs an image and gives what it sends.
    ///
    /// # Errors
    /// If the emulator does not start, or the image does not end well within two minutes.
    pub fn emulate(&self, board: Board, image: &Path) -> Result<Vec<u8>, Failure> {
        let mut qemu = Command::new("timeout");
        let emulator = self.command("qemu-system-arm");
        qemu.arg("120").arg(emulator.get_program());
        qemu.envs(emulator.get_envs().filter_map(|(key, value)| Some((key, value?))));
        qemu.args(["-M", board.machine, "-display", "none", "-monitor", "none"]);
        qemu.args(["-serial", "none", "-semihosting-config", "enable=on,target=native"]);
        qemu.args(["-icount", &format!("shift={SHIFT}"), "-kernel"]).arg(image);
        Ok(succeed(qemu)?.stdout)
    }

    /// First line of what a program says of its version.
    pub fn version(&self, program: &str) -> Result<String, Failure> {
        let mut command = self.command(program);
        command.arg("--version");
        let said = String::from_utf8_lossy(&succeed(command)?.stdout).into_owned();
        Ok(said.lines().next().unwrap_or(program).to_owned())
    }
}

/// The prefix's folders of shared libraries.
fn libraries(prefix: &Path) -> String {
    let folders = ["usr/lib/x86_64-linux-gnu", "lib/x86_64-linux-gnu"];
    folders.map(|folder| prefix.join(folder).display().to_string()).join(":")
}

/// Runs a command to its end.
pub fn succeed(mut command: Command) -> Result<Output, Failure> {
    let output = command.stdin(Stdio::null()).output().map_err(|e| {
        format!("{}: {e}: is it installed?", command.get_program().to_string_lossy())
    })?;
    if output.status.success() {
        return Ok(output);
    }
    let said = String::from_utf8_lossy(&output.stderr);
    Err(format!("{command:?} ended with {}:\n{said}", output.status))
}

/// That something failed as it has to: `reasons` are what it may say.
pub fn refused<T>(done: Result<T, Failure>, reasons: &[&str]) -> Result<(), Failure> {
    match done {
        Err(said) if reasons.iter().any(|reason| said.contains(reason)) => Ok(()),
        Err(said) => Err(format!("failed, but not for {}: {said}", reasons.join(" or "))),
        Ok(_) => Err(format!("did not fail for {}", reasons.join(" or "))),
    }
}
