//! What may be chosen about a diagnosis, declared once: options of the command line and, by the names of the fields, keys
//! of JSON for other programs.

use std::path::PathBuf;

use clap::builder::Arg;
use clap::{ArgGroup, Args as _, Command, ValueEnum};
use serde::{Deserialize, Deserializer, Serialize};
use serde_json::Value;
use stiffarm_gap::log::{Domain, TorqueSide};

use crate::terminal::failure::Failure;

/// The group of the options that speak of measurement files alone.
pub const AT_REST: &str = "measurements";

/// The heading of the options that speak of joint logs alone.
pub const IN_MOTION: &str = "For joint logs";

/// What may be chosen about a diagnosis.
///
/// A quantity is a text with its unit, `30um`; from JSON also a number, in m, rad or Hz.
#[derive(Clone, Debug, Default, PartialEq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[command(group = ArgGroup::new(AT_REST).multiple(true))]
pub struct Settings {
    /// Known constants of the bench (TOML): points and their distances, planes, centres. What it does not
    /// give is co-estimated
    #[arg(long, value_name = "BENCH.toml")]
    pub bench: Option<PathBuf>,
    /// Nuisance parameters, co-estimated and never a finding: base_frame, tool_frame, geometry (zeros,
    /// lengths and twists, within --tolerance)
    #[arg(long, value_name = "a,b", value_delimiter = ',', group = AT_REST)]
    pub nuisance: Vec<String>,
    /// Manufacturing tolerance of lengths and angles, standard deviations [default: 0.3mm,0.5mrad]
    #[arg(long, value_name = "LENGTH,ANGLE", allow_hyphen_values = true, group = AT_REST)]
    #[serde(deserialize_with = "both")]
    pub tolerance: Option<String>,
    /// Prior scale of an effect's parameters: joint_compliance=2e-6, link_compliance:bending=1e-6; may be
    /// repeated
    #[arg(long, value_name = "EFFECT[:NUMBER]=SIZE")]
    pub usual: Vec<String>,
    /// Standard deviation of a measured coordinate: 30um [default: from repeats, else from the residuals]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, group = AT_REST)]
    #[serde(deserialize_with = "length")]
    pub noise_position: Option<String>,
    /// Standard deviation of a measured rotation: 0.02deg [default: from repeats, else from the residuals]
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true, group = AT_REST)]
    #[serde(deserialize_with = "angle")]
    pub noise_rotation: Option<String>,
    /// Keep outliers: fit and count rows that do not fit
    #[arg(long, group = AT_REST)]
    pub keep_all: bool,
    /// Try only these effects
    #[arg(long, value_name = "a,b,c", value_delimiter = ',')]
    pub effects: Option<Vec<String>>,
    /// Number of folds [default: one per pose up to 30 poses, else 10]
    #[arg(long, value_name = "K", group = AT_REST)]
    pub folds: Option<usize>,
    /// Nested cross-validation: repeat the search without each fold, and report the error on it
    #[arg(long)]
    pub nested: bool,
    /// Seed of folds, permutations and intervals; the same seed gives the same bytes
    #[arg(long, default_value_t = 0)]
    pub seed: u64,
    /// Compare with another model's predictions: the columns PREFIX_x … or PREFIX_dx …
    #[arg(long = "rival", value_name = "PREFIX", group = AT_REST)]
    pub rivals: Vec<String>,
    /// Predict another file of the same arm with the findings
    #[arg(long, value_name = "OTHER.csv")]
    pub check: Option<PathBuf>,
    /// Compare with an earlier diagnosis of the arm (JSON): what was added, removed and changed
    #[arg(long, value_name = "LAST.json", group = AT_REST)]
    pub compare: Option<PathBuf>,
    /// Tolerance for the position error of the corrected arm in 95 % of the rows, held out or of --check;
    /// exit status 1 if the error is larger
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, group = AT_REST)]
    #[serde(deserialize_with = "length")]
    pub accept: Option<String>,
    /// Where its torques are measured: motor (joint side of the gear), link (a sensor behind it),
    /// current, commanded [default: as the log says]
    #[arg(long, value_name = "SIDE", value_parser = side, help_heading = IN_MOTION)]
    pub torque_side: Option<TorqueSide>,
    /// Which rows, where a log has both [default: torque]
    #[arg(long, value_name = "ROWS", help_heading = IN_MOTION)]
    pub rows: Option<Rows>,
    /// Cut-off frequency of the low-pass: 50Hz [default: where the joint values exceed their noise]
    #[arg(long, value_name = "FREQUENCY", value_parser = hertz, help_heading = IN_MOTION)]
    #[serde(deserialize_with = "frequency")]
    pub band: Option<f64>,
    /// Speed, rad/s or m/s, below which a joint's torque is not used [default: 0.5 % of its largest]
    #[arg(long, value_name = "SPEED", help_heading = IN_MOTION)]
    pub standstill: Option<f64>,
    /// Take the robot file's masses and inertias as known; a difference is a finding [default: they are
    /// co-estimated]
    #[arg(long, help_heading = IN_MOTION)]
    pub known_masses: bool,
    /// Names of the columns: ros, rtde, libfranka, lerobot, sage, pace, or a map (TOML)
    #[arg(long, value_name = "MAP", help_heading = IN_MOTION)]
    pub map: Option<String>,
    /// Topic of a bag with the arm's joints, if several have any
    #[arg(long, value_name = "TOPIC", help_heading = IN_MOTION)]
    pub topic: Option<String>,
}

/// Which rows.
#[derive(Clone, Copy, Debug, PartialEq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rows {
    /// Joint torques or currents
    Torque,
    /// Position errors: joint values minus commands
    Position,
}

impl From<Rows> for Domain {
    fn from(rows: Rows) -> Domain {
        match rows {
            Rows::Torque => Domain::Torque,
            Rows::Position => Domain::Position,
        }
    }
}

impl Settings {
    /// Those of a JSON object, in which any key may be missing.
    ///
    /// # Errors
    /// [`Failure`] names a key that there is not, or what its value should be.
    pub fn from_json(text: &str) -> Result<Settings, Failure> {
        serde_json::from_str(text).map_err(|error| Failure::new(format!("settings: {error}")))
    }

    /// The options of the command line, in order; the id of each is its key.
    pub fn arguments() -> Vec<Arg> {
        Settings::augment_args(Command::new("diagnose")).get_arguments().cloned().collect()
    }

    /// What an option is where nothing is chosen, in JSON.
    pub fn usual(option: &Arg) -> String {
        let usual = serde_json::to_value(Settings::default()).unwrap_or_default();
        usual[option.get_id().as_str()].to_string()
    }

    /// Those that speak of measurement files alone.
    fn of_measurements() -> Vec<String> {
        let mut all = Settings::augment_args(Command::new("diagnose"));
        all.build();
        let group = all.get_groups().find(|group| group.get_id() == AT_REST);
        group.into_iter().flat_map(ArgGroup::get_args).map(|id| id.as_str().to_owned()).collect()
    }

    /// What is not as it is where nothing is chosen.
    fn chosen(&self) -> Vec<(Arg, Value)> {
        let value = |settings: &Settings| serde_json::to_value(settings).unwrap_or_default();
        let (own, usual) = (value(self), value(&Settings::default()));
        let chosen = |option: Arg| {
            let id = option.get_id().as_str();
            let value = own[id].clone();
            (value != usual[id]).then_some((option, value))
        };
        Settings::arguments().into_iter().filter_map(chosen).collect()
    }

    /// The first option that is given and speaks of joint logs alone, or of measurement files alone.
    pub fn first_of(&self, in_motion: bool) -> Option<String> {
        let at_rest = Settings::of_measurements();
        let is_meant = |option: &Arg| match in_motion {
            true => option.get_help_heading() == Some(IN_MOTION),
            false => at_rest.iter().any(|id| option.get_id() == id.as_str()),
        };
        self.chosen().iter().map(|(option, _)| option).find(|o| is_meant(o)).map(long)
    }

    /// The same without what speaks of measurement files alone.
    #[must_use]
    pub fn in_motion(&self) -> Settings {
        let mut value = serde_json::to_value(self).unwrap_or_default();
        if let Some(fields) = value.as_object_mut() {
            Settings::of_measurements().iter().for_each(|id| drop(fields.remove(id)));
        }
        serde_json::from_value(value).unwrap_or_default()
    }

    /// The words of the command line that choose the same.
    pub fn words(&self) -> Vec<String> {
        let text = |value: &Value| value.as_str().map_or_else(|| value.to_string(), str::to_owned);
        let each = self.chosen().into_iter().flat_map(|(option, value)| {
            let name = long(&option);
            match &value {
                Value::Bool(_) => vec![name],
                Value::Array(all) if option.get_value_delimiter().is_some() => {
                    vec![format!("{name}={}", all.iter().map(text).collect::<Vec<_>>().join(","))]
                }
                Value::Array(all) => {
                    all.iter().map(|one| format!("{name}={}", text(one))).collect()
                }
                one => vec![format!("{name}={}", text(one))],
            }
        });
        each.collect()
    }
}

/// `--noise-position`.
fn long(option: &Arg) -> String {
    format!("--{}", option.get_long().unwrap_or_default())
}

fn side(word: &str) -> Result<TorqueSide, String> {
    let known: Vec<&str> = TorqueSide::ALL.iter().map(|(name, _)| *name).collect();
    TorqueSide::named(word).ok_or_else(|| format!("expected one of {}", known.join(", ")))
}

fn hertz(text: &str) -> Result<f64, String> {
    let number = text.trim().strip_suffix("Hz").unwrap_or(text).trim();
    number.parse().map_err(|_| "expected a frequency, as 50Hz".to_owned())
}

/// A quantity of JSON.
#[derive(Deserialize)]
#[serde(untagged)]
enum Given {
    Number(f64),
    Text(String),
}

impl Given {
    fn text(self, unit: &str) -> String {
        match self {
            Given::Number(number) => format!("{number:?}{unit}"),
            Given::Text(text) => text,
        }
    }
}

fn length<'de, D: Deserializer<'de>>(from: D) -> Result<Option<String>, D::Error> {
    Ok(Option::<Given>::deserialize(from)?.map(|given| given.text("m")))
}

fn angle<'de, D: Deserializer<'de>>(from: D) -> Result<Option<String>, D::Error> {
    Ok(Option::<Given>::deserialize(from)?.map(|given| given.text("rad")))
}

fn frequency<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f64>, D::Error> {
    let given = Option::<Given>::deserialize(from)?.map(|given| hertz(&given.text("Hz")));
    given.transpose().map_err(serde::de::Error::custom)
}

/// A length and an angle: one text, or a list.
fn both<'de, D: Deserializer<'de>>(from: D) -> Result<Option<String>, D::Error> {
    #[derive(Deserialize)]
    #[serde(untagged)]
    enum Both {
        Text(String),
        List(Given, Given),
    }
    Ok(Option::<Both>::deserialize(from)?.map(|both| match both {
        Both::Text(text) => text,
        Both::List(length, angle) => format!("{},{}", length.text("m"), angle.text("rad")),
    }))
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    use super::*;

    /// What is read of JSON is what the words of the command line choose, and the words lead back.
    #[test]
    fn one_choice_in_two_notations() {
        let json = r#"{"nuisance": ["base_frame", "tool_frame"], "tolerance": [3e-4, "1mrad"],
            "usual": ["a=1", "b=2"], "noise_position": 3e-5, "noise_rotation": "1deg",
            "keep_all": true, "effects": ["a", "b"], "folds": 3, "seed": 9, "rivals": ["x", "y"],
            "accept": 1e-3, "torque_side": "motor", "rows": "position", "band": "50 Hz"}"#;
        let settings = Settings::from_json(json).unwrap();
        assert_eq!(settings.tolerance.as_deref(), Some("0.0003m,1mrad"));
        assert_eq!(settings.noise_position.as_deref(), Some("3e-5m"));
        let words = [vec!["ur5".to_owned()], settings.words()].concat();
        assert_eq!(crate::asked(&words).unwrap().1, settings, "{words:?}");
        assert_eq!(settings.first_of(true).as_deref(), Some("--torque-side"));
        assert_eq!(settings.first_of(false).as_deref(), Some("--nuisance"));
        assert_eq!(settings.in_motion().first_of(false), None);
        assert_eq!(settings.in_motion().effects, settings.effects);
        assert!(Settings::from_json(r#"{"nothing": 1}"#).is_err());
        crate::Cli::command().debug_assert();
    }

    #[test]
    fn what_is_asked_of_another_machine_names_no_file() {
        let of = |command| crate::options_without_files(command).into_iter();
        let names: Vec<String> =
            of("diagnose").chain(of("identify")).map(|(name, _)| name).collect();
        assert!(
            ["--set", "--nuisance", "--seed", "--links"]
                .iter()
                .all(|one| names.iter().any(|name| name == one))
        );
        let files =
            ["--bench", "--check", "--compare", "--map", "--json", "--report", "--write-robot"];
        assert!(!names.iter().any(|name| files.contains(&name.as_str())), "{names:?}");
    }
}
