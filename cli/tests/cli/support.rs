//! Running the binary.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use nalgebra::{Vector3, Vector6};
use serde_json::Value;
use stiffarm_codegen::robot::Robot;
use stiffarm_gap::simulate::equilibrium;
use stiffarm_kernels::generic::Arm;
use tempfile::TempDir;

/// How a run ended.
#[derive(Debug)]
pub struct Run {
    pub status: i32,
    pub out: String,
    pub err: String,
}

impl Run {
    /// The standard output of a run that must have gone well and said nothing else.
    #[track_caller]
    pub fn good(self) -> String {
        assert_eq!((self.status, self.err.as_str()), (0, ""), "{}", self.out);
        self.out
    }

    /// The JSON that a run printed which must have gone well.
    #[track_caller]
    pub fn json(self) -> Value {
        json(&self.good())
    }

    /// A run that must have ended so.
    #[track_caller]
    pub fn ended(self, status: i32) -> Run {
        assert_eq!(self.status, status, "{}", self.err);
        self
    }

    /// The standard error of a run that must have refused its work and printed nothing.
    #[track_caller]
    pub fn refused(self) -> String {
        assert_eq!((self.status, self.out.as_str()), (2, ""), "{}", self.err);
        assert!(!self.err.contains("panicked"), "{}", self.err);
        self.err
    }
}

/// The repository's folder: robots, documents and data lie there.
pub const REPOSITORY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

/// Real data that are no part of this repository: in the directory that `STIFFARM_DATA` names, or in `shared/data`
/// beside the checkout.
pub fn data(name: &str) -> String {
    let beside = || format!("{REPOSITORY}/../shared/data");
    let directory = std::env::var("STIFFARM_DATA").unwrap_or_else(|_| beside());
    let path = format!("{directory}/{name}");
    assert!(Path::new(&path).exists(), "{path} is not there: set STIFFARM_DATA");
    path
}

/// The binary, in the repository's folder, without a terminal.
pub fn command<S: AsRef<OsStr>>(arguments: &[S]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_stiffarm"));
    command.args(arguments).current_dir(REPOSITORY).stdin(Stdio::null());
    for variable in ["NO_COLOR", "CLICOLOR", "CLICOLOR_FORCE"] {
        command.env_remove(variable);
    }
    command
}

/// Runs it to its end.
pub fn stiffarm<S: AsRef<OsStr>>(arguments: &[S]) -> Run {
    let output = command(arguments).output().expect("the binary runs");
    let text = |bytes| String::from_utf8(bytes).expect("the output is text");
    Run {
        status: output.status.code().expect("no signal"),
        out: text(output.stdout),
        err: text(output.stderr),
    }
}

/// The same with the words of a line.
pub fn run(line: &str) -> Run {
    stiffarm(&words(line))
}

/// A folder of one test, removed with it.
pub struct Folder(TempDir);

impl Folder {
    pub fn new() -> Folder {
        Folder(TempDir::new().expect("a folder for the test"))
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// The same as an argument.
    pub fn name(&self, name: &str) -> String {
        text(&self.path(name))
    }

    /// Writes a file and returns its path.
    pub fn file(&self, name: &str, content: impl AsRef<[u8]>) -> String {
        let path = self.path(name);
        std::fs::write(&path, content).expect("the folder can be written to");
        text(&path)
    }

    /// The names in it, sorted.
    pub fn names(&self) -> Vec<String> {
        names(self.0.path())
    }
}

/// The names in a folder, sorted.
pub fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("the folder is there");
    let name = |e: std::io::Result<std::fs::DirEntry>| {
        e.expect("an entry").file_name().to_string_lossy().into_owned()
    };
    let mut names: Vec<String> = entries.map(name).collect();
    names.sort();
    names
}

/// Every one of these parts must stand in a text.
#[track_caller]
pub fn has(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "no `{part}` in\n{text}");
    }
}

/// A path as an argument.
pub fn text(path: &Path) -> String {
    path.to_str().expect("a path in UTF-8").to_owned()
}

/// A text as JSON.
#[track_caller]
pub fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

/// A number of JSON.
#[track_caller]
pub fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("no number: {value}"))
}

/// A list of JSON.
#[track_caller]
pub fn list(value: &Value) -> &[Value] {
    value.as_array().unwrap_or_else(|| panic!("no list: {value}"))
}

/// Its numbers.
#[track_caller]
pub fn numbers(value: &Value) -> Vec<f64> {
    list(value).iter().map(number).collect()
}

/// Words as a shell has them: what stands in single quotes is one.
pub fn words(line: &str) -> Vec<String> {
    let parts = line.split('\'').enumerate();
    let words = parts.flat_map(|(k, part)| match k % 2 {
        0 => part.split_whitespace().collect(),
        _ => vec![part],
    });
    words.map(str::to_owned).collect()
}

/// An output with its lines joined.
pub fn flat(out: &str) -> String {
    out.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The text of a file: of this repository, where its path is relative.
#[track_caller]
pub fn read(path: &str) -> String {
    let read = std::fs::read_to_string(Path::new(REPOSITORY).join(path));
    read.unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// The robot of a robot file of this repository.
pub fn arm(id: &str) -> stiffarm_kernels::generic::Arm {
    arm_of(&read(&format!("robots/arms/{id}.toml")))
}

/// The arm of a robot file.
#[track_caller]
pub fn arm_of(text: &str) -> Arm {
    let (robot, _) = Robot::from_toml(text, "arm.toml").expect("it is right");
    stiffarm_gap::robot::arm(&robot).expect("it has numbers for everything")
}

/// Where the tool of an arm at rest stands under a load, m.
#[track_caller]
pub fn stands(arm: &Arm, q: &[f64], load: &Vector6<f64>) -> Vector3<f64> {
    equilibrium(arm, q, load).expect("stable").tool.translation.vector
}

/// How far a load moves it, m.
#[track_caller]
pub fn moved(arm: &Arm, q: &[f64], load: &Vector6<f64>) -> Vector3<f64> {
    stands(arm, q, load) - stands(arm, q, &Vector6::zeros())
}

/// A table as a command writes it: cells by the names of their columns.
pub struct Table<'t> {
    /// The remarks above it.
    pub remarks: Vec<&'t str>,
    pub names: Vec<&'t str>,
    pub rows: Vec<Vec<&'t str>>,
}

impl<'t> Table<'t> {
    pub fn of(csv: &'t str) -> Table<'t> {
        let (remarks, lines): (Vec<_>, Vec<_>) = csv.lines().partition(|l| l.starts_with('#'));
        let mut cells = lines.into_iter().map(|line| line.split(',').collect());
        Table { remarks, names: cells.next().expect("a header"), rows: cells.collect() }
    }

    /// The cells below a name; none where the table has not got it.
    pub fn get(&self, name: &str) -> Option<Vec<&'t str>> {
        let at = self.names.iter().position(|own| *own == name)?;
        Some(self.rows.iter().map(|row| row[at]).collect())
    }

    #[track_caller]
    pub fn column(&self, name: &str) -> Vec<&'t str> {
        self.get(name).unwrap_or_else(|| panic!("no {name}: {:?}", self.names))
    }

    /// NaN where a cell is empty.
    #[track_caller]
    pub fn numbers(&self, name: &str) -> Vec<f64> {
        self.column(name).iter().map(|cell| cell.parse().unwrap_or(f64::NAN)).collect()
    }

    /// All rows as numbers.
    pub fn all(&self) -> Vec<Vec<f64>> {
        let number = |cell: &&str| cell.parse().unwrap_or(f64::NAN);
        self.rows.iter().map(|row| row.iter().map(number).collect()).collect()
    }

    /// A plan of a KUKA's displacements or positions with its last three cells filled in, mm, by what `read` has of
    /// the joint values and the force in each row.
    pub fn filled(&self, read: impl Fn(usize, &[f64], &Vector6<f64>) -> [String; 3]) -> String {
        let q: Vec<_> = (1..=6).map(|j| self.numbers(&format!("q{j}[deg]"))).collect();
        let force = ["fx[N]", "fy[N]", "fz[N]"].map(|name| self.get(name));
        let mut text = self.names.join(",") + "\n";
        for (k, row) in self.rows.iter().enumerate() {
            let q: Vec<f64> = q.iter().map(|of| of[k].to_radians()).collect();
            let force = force.each_ref().map(|of| of.as_ref().and_then(|of| of[k].parse().ok()));
            let [x, y, z] = force.map(|of| of.unwrap_or(0.0));
            let read = read(k, &q, &Vector6::new(x, y, z, 0.0, 0.0, 0.0));
            text += &format!("{},{}\n", row[..row.len() - 3].join(","), read.join(","));
        }
        text
    }
}
