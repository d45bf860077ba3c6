//! A campaign put to a command of the command line: `diagnose`, `identify`.

use std::collections::HashMap;

use stiffarm_cli::host::Host;
use stiffarm_cli::{Catalogues, asked, diagnose};

use crate::arms::Arms;
use crate::sentence::sentence;

/// What a campaign's file is called in answers; the command that reads a file of this name answers the same.
pub const FILE: &str = "<campaign>";

/// What is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Question {
    /// `stiffarm diagnose`.
    Diagnose,
    /// `stiffarm identify`.
    Identify,
}

impl Question {
    /// The subcommand.
    pub fn name(self) -> &'static str {
        match self {
            Question::Diagnose => "diagnose",
            Question::Identify => "identify",
        }
    }

    /// The JSON that the command writes for `robot`, which is a robot and options behind it, and the measurement
    /// file `text`.
    ///
    /// # Errors
    /// A sentence: the robot, an option, or why the campaign has no answer.
    pub fn ask(self, arms: &Arms, robot: &str, text: String) -> Result<String, String> {
        let mut given = robot.split_whitespace();
        let named = arms.named(given.next().unwrap_or_default())?;
        let options = self.checked(given)?;
        let begin: &[&str] = match self {
            Question::Diagnose => &[&named.given],
            Question::Identify => &["identify", &named.given, FILE, "--json", "-", "--quiet"],
        };
        let words: Vec<String> = begin.iter().copied().chain(options).map(str::to_owned).collect();
        let mut files: HashMap<String, Vec<u8>> = named.files();
        files.insert(FILE.to_owned(), text.into_bytes());
        let host = Host::new(words.clone(), files).quiet(true);
        let answered = match self {
            Question::Diagnose => host.run(|| {
                let (robot, settings) = asked(&words)?;
                let all = Catalogues::default();
                diagnose(&robot, &[FILE.into()], &settings, all, &host)?.json()
            }),
            Question::Identify => stiffarm_cli::run(&host).map(|done| {
                let told = host.take().written.into_iter().filter(|(name, _)| name == "-");
                let text = |(_, bytes): (_, Vec<u8>)| String::from_utf8_lossy(&bytes).into_owned();
                done.map(|_| told.map(text).collect())
            }),
        };
        match answered {
            Ok(answer) => answer.map_err(|failure| sentence(&failure)),
            Err(_) => Err("the work was left".to_owned()),
        }
    }

    /// The options, each of which is one that a campaign far from here may be asked with.
    fn checked<'a>(self, words: impl Iterator<Item = &'a str>) -> Result<Vec<&'a str>, String> {
        let words: Vec<&str> = words.collect();
        let options = stiffarm_cli::options_without_files(self.name());
        let mut rest = words.iter();
        while let Some(word) = rest.next() {
            let (name, value) = word.split_once('=').map_or((*word, None), |(n, v)| (n, Some(v)));
            let Some((_, takes)) = options.iter().find(|(option, _)| option == name) else {
                let known: Vec<&str> = options.iter().map(|(option, _)| option.as_str()).collect();
                return Err(format!(
                    "found `{word}` behind the robot, expected an option: {}",
                    known.join(", ")
                ));
            };
            if *takes && value.is_none() && rest.next().is_none() {
                return Err(format!("found {name} without a value, expected one"));
            }
        }
        Ok(words)
    }
}
