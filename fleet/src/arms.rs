//! Robots by name: those of the collection, and the files of one folder.

use std::collections::HashMap;
use std::hash::{Hash, Hasher};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use stiffarm_cli::host::Host;
use stiffarm_cli::{Axes, Failure, RobotArgs, Source};

use crate::arm::Arm;
use crate::sentence::sentence;

/// The robots that a process knows.
#[derive(Debug, Default)]
pub struct Arms {
    folder: Option<PathBuf>,
    read: Mutex<HashMap<String, Arc<Arm>>>,
}

/// A robot's name as the command line has it, and the text of its file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Named {
    /// The id of a robot of the collection, or the name of a file.
    pub given: String,
    /// `None` of the collection.
    pub text: Option<String>,
}

impl Arms {
    /// The collection, and the robot files in `folder`.
    pub fn new(folder: Option<PathBuf>) -> Arms {
        Arms { folder, read: Mutex::default() }
    }

    /// The robot of that name.
    ///
    /// # Errors
    /// A sentence: there is none, or its file cannot be read.
    pub fn named(&self, name: &str) -> Result<Named, String> {
        if stiffarm_robots::toml(name).is_some() {
            return Ok(Named { given: name.to_owned(), text: None });
        }
        let plain = |c: char| c.is_alphanumeric() || "-_. ".contains(c);
        if name.is_empty() || name.starts_with('.') || !name.chars().all(plain) {
            return Err(format!(
                "found the robot `{name}`, expected the id of a built-in robot or the name of a file in --robots: \
                 letters, digits, `-`, `_` and `.`"
            ));
        }
        let Some(folder) = &self.folder else {
            return Err(format!(
                "found no robot `{name}`, expected the id of a built-in robot; --robots DIR names a folder of robot \
                 files to every part of a cluster"
            ));
        };
        let given = if name.ends_with(".toml") { name.to_owned() } else { format!("{name}.toml") };
        let path = folder.join(&given);
        match std::fs::read_to_string(&path) {
            Ok(text) => Ok(Named { given, text: Some(text) }),
            Err(error) => Err(format!(
                "cannot read the robot {}: {error}; every executor needs the file in its --robots folder",
                path.display()
            )),
        }
    }

    /// The same, ready to compute. A file that has changed is read again.
    ///
    /// # Errors
    /// A sentence: as above, or the file's mistakes.
    pub fn arm(&self, name: &str) -> Result<Arc<Arm>, String> {
        let named = self.named(name)?;
        let mut read = self.read.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(arm) = read.get(name).filter(|arm| arm.text == named.text) {
            return Ok(Arc::clone(arm));
        }
        let arm = Arc::new(load(named)?);
        read.insert(name.to_owned(), Arc::clone(&arm));
        Ok(arm)
    }

    /// The joints of `over` over their limits, and where the robot's others stand, as `stiffarm map` has them.
    ///
    /// # Errors
    /// A sentence: the robot, or its joints.
    pub fn axes(&self, name: &str, over: &str, at: &str, steps: usize) -> Result<Axes, String> {
        with(&self.named(name)?, |source| Axes::new(source, &source.arm()?, over, at, steps))
    }
}

fn load(named: Named) -> Result<Arm, String> {
    let (robot, table) = with(&named, |source| Ok((source.for_kernels()?, source.arm()?)))?;
    Ok(Arm::new(robot, table, named))
}

/// What is made of a robot as the command line reads it.
fn with<T>(named: &Named, make: impl FnOnce(&Source) -> Result<T, Failure>) -> Result<T, String> {
    let host = Host::new(Vec::new(), named.files());
    let made = host.run(|| make(&RobotArgs::named(&named.given).load(&host.quiet(true))?));
    match made {
        Ok(made) => made.map_err(|failure| sentence(&failure)),
        Err(_) => Err(format!("reading the robot {} was left", named.given)),
    }
}

impl Named {
    /// The files that a command finds, by their names.
    pub fn files(&self) -> HashMap<String, Vec<u8>> {
        let file = |text: &String| (self.given.clone(), text.clone().into_bytes());
        self.text.iter().map(file).collect()
    }
}

// Of two functions of the engine, which it compares, one is the other if it knows the same robots.
impl PartialEq for Arms {
    fn eq(&self, other: &Arms) -> bool {
        self.folder == other.folder
    }
}

impl Eq for Arms {}

impl Hash for Arms {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.folder.hash(state);
    }
}
