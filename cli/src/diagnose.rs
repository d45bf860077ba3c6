//! `stiffarm diagnose`: the error between model and measurement, and which effects explain it.

mod accepted;
mod campaign;
mod compared;
mod corrected;
mod log;
mod predicted;
mod provenance;
mod settings;
mod together;

use std::path::PathBuf;

use stiffarm_codegen::robot::Robot;
use stiffarm_document::text::{counted, words};
use stiffarm_document::{Document, Embedded, TOP};
use stiffarm_gap::Options;
use stiffarm_gap::diagnose::{Prior, Stage};
use stiffarm_gap::effects::Catalogue;
use stiffarm_gap::log::effects::Catalogue as LogCatalogue;
use stiffarm_gap::measurement::Dimension;
use stiffarm_gap::spring::Spring;
use stiffarm_kernels::generic::Arm;

pub use campaign::Campaign;
use corrected::exported;
pub use corrected::{Format, commented};
pub use log::{Motion, Part, names, parts, read};
pub use predicted::{Predicted, PredictedLog};
pub use settings::{IN_MOTION, Settings};
pub use together::Together;

use super::Verdict;
use crate::host::Host;
use crate::input::quantity;
use crate::input::source::{RobotArgs, Source};
use crate::terminal::failure::Failure;
use crate::terminal::output::Target;

const EXAMPLES: &str = "\
Examples:
  stiffarm diagnose arm.toml run1.csv
  stiffarm diagnose arm.toml run1.csv --nuisance base_frame,tool_frame --noise-position 30um
  stiffarm diagnose arm.toml run1.csv --write-robot better.toml --check run2.csv --json run1.json
  stiffarm diagnose arm.toml run2.csv --compare run1.json --accept 0.2mm --report run2.html
  stiffarm diagnose arm.toml log.csv --torque-side motor
  stiffarm diagnose arm.toml run1.csv log.csv --write-robot better.toml
  stiffarm diagnose lin_planar robots/data/lin1991_table3.csv --rival ycd --rival ytd

DATA has a header row of columns `name` or `name[unit]`: joint values q1 … qn; the wrench fx fy fz mx my
mz, or a payload by name; the measurement, x y z [rx ry rz] or dx dy dz [drx dry drz] or a distance
[from_x from_y from_z]; optionally pose, session, marker, s1 … sn, temperature, time, the instrument's
standard deviations sigma (of all positions) or sigma_x …, and your own simulator's sim_x … or sim_dx ….

A joint log has t, q1 … qn, and tau1 … (N·m), i1 … (A) or q_cmd1 …; see docs/logs.md. If both are given,
the joints' compliances are estimated from both.";

/// Why the real arm is not where the model says, at rest or in motion
///
/// Compares the robot file with measurements, or with a log of joint values and torques, currents or
/// commands. Reports which unmodelled effects cause the error, and how far it is reduced with them on
/// held-out poses or time.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    robot: RobotArgs,
    /// Measurement files (CSV) of one arm, or a joint log of one or several files, or both
    #[arg(required = true)]
    data: Vec<PathBuf>,
    #[command(flatten)]
    settings: Settings,
    /// Write the robot file with the findings
    #[arg(long, value_name = "OUT.toml")]
    write_robot: Option<Target>,
    /// Write the arm with the findings as a URDF; a note names what a URDF cannot hold
    #[arg(long, value_name = "OUT.urdf")]
    write_urdf: Option<Target>,
    /// Write the arm with the findings as an MJCF model for MuJoCo, with the joints' springs
    #[arg(long, value_name = "OUT.xml")]
    write_mjcf: Option<Target>,
    /// Write the diagnosis as JSON (`-`: to standard output, in place of the screen)
    #[arg(long, value_name = "OUT")]
    json: Option<Target>,
    /// Write the diagnosis as one self-contained page
    #[arg(long, value_name = "OUT.html")]
    report: Option<Target>,
    /// Print the evidence of so many findings, the largest first; of the others their numbers
    #[arg(long, value_name = "N", default_value_t = TOP, hide_default_value = true)]
    top: usize,
    /// Write a certificate of measurements: one sheet of A4 as PDF, legible in black and white
    #[arg(long, value_name = "OUT.pdf")]
    certificate: Option<Target>,
    /// Print every finding, parameter and reason, however small
    #[arg(long, conflicts_with = "top")]
    all: bool,
}

/// The effects that are tried: those that stiffarm knows, and one's own.
#[derive(Clone, Debug, Default)]
pub struct Catalogues {
    /// Of measurements.
    pub at_rest: Catalogue,
    /// Of joint logs.
    pub in_motion: LogCatalogue,
}

/// What a diagnosis found, of whatever data.
pub trait Found: Send + Sync {
    /// What was measured at rest; `None` of a log alone.
    fn campaign(&self) -> Option<&Campaign> {
        None
    }

    /// What was logged in motion; `None` of measurements alone.
    fn motion(&self) -> Option<&Motion> {
        None
    }

    /// The diagnosis in JSON.
    ///
    /// # Errors
    /// [`Failure`] if it cannot be written so.
    fn json(&self) -> Result<String, Failure>;

    /// The diagnosis as a document; of a page with everything that only a page has, and what the page embeds.
    ///
    /// # Errors
    /// [`Failure`] if what the page embeds cannot be made.
    fn document(&self, is_page: bool) -> Result<(Document, Embedded), Failure>;

    /// The robot with all that was found, and what its file says at its top.
    ///
    /// # Errors
    /// [`Failure`]: a log of currents, which tell no newton-metres.
    fn robot(&self) -> Result<(Vec<String>, Robot), Failure>;

    /// The diagnosis as it stands on a screen, with the evidence of the first `top` findings; of [`usize::MAX`] all of
    /// it.
    ///
    /// # Errors
    /// As [`Found::document`].
    fn text(&self, top: usize) -> Result<String, Failure> {
        Ok(self.document(false)?.0.text(top))
    }

    /// The page in HTML.
    ///
    /// # Errors
    /// [`Failure`] if it cannot be made.
    fn page(&self) -> Result<String, Failure> {
        let (document, embedded) = self.document(true)?;
        Ok(document.html(&embedded)?)
    }

    /// What a certificate says.
    ///
    /// # Errors
    /// [`Failure`]: a log alone, which has no poses.
    fn certificate(&self) -> Result<Document, Failure> {
        match self.campaign() {
            Some(found) => found.certified(),
            None => Err(Failure::with_help(
                "--certificate: found a joint log, expected measurements of poses",
                "diagnose measurements, alone or with the log",
            )),
        }
    }

    /// The robot file with all that was found.
    ///
    /// # Errors
    /// As [`Found::robot`].
    fn corrected(&self) -> Result<String, Failure> {
        let (lines, robot) = self.robot()?;
        Ok(commented(lines, &robot))
    }

    /// The same arm as other programs read it, and a sentence on what they have no place for.
    ///
    /// # Errors
    /// [`Failure`]: as above, or the table has cells that are no numbers.
    fn exported(&self, format: Format) -> Result<(String, Option<String>), Failure> {
        exported(&self.robot()?.1, format)
    }

    /// What has to be known of any file of the corrected arm, a sentence each.
    fn caveats(&self) -> Vec<String> {
        let at_rest = self.campaign().map(|found| found.corrections().caveats());
        let in_motion = self.motion().map(Motion::caveats);
        at_rest.into_iter().chain(in_motion).flatten().collect()
    }
}

pub fn run(args: &Args, host: &Host) -> Result<Verdict, Failure> {
    let found = diagnose(&args.robot, &args.data, &args.settings, Catalogues::default(), host)?;
    host.put(&args.json, || found.json())?;
    args.write_arm(&*found, host)?;
    host.put(&args.report, || found.page())?;
    if let Some(target) = &args.certificate {
        let bytes = found.certificate()?.pdf();
        host.stream(target, &mut |to| to.write_all(&bytes).map(|()| true))?;
    }
    let [robot, urdf, mjcf] = args.arms();
    if host.shows(&[&args.json, &args.report, &args.certificate, robot, urdf, mjcf]) {
        host.print(&found.text(if args.all { usize::MAX } else { args.top })?)?;
    }
    Ok(match found.campaign() {
        Some(found) if found.is_unexplained() => Verdict::Unexplained,
        Some(found) if !found.is_accepted() => Verdict::Failed,
        _ => Verdict::Good,
    })
}

/// Diagnoses the files `data` of a robot as it is chosen, with the effects of `catalogues`.
///
/// # Errors
/// [`Failure`]: the robot, the data or the settings; effects of one's own that are not asked of such data.
pub fn diagnose(
    robot: &RobotArgs,
    data: &[PathBuf],
    settings: &Settings,
    catalogues: Catalogues,
    host: &Host,
) -> Result<Box<dyn Found>, Failure> {
    let source = robot.load(host)?;
    let Catalogues { at_rest, in_motion } = catalogues;
    match log::files(data, settings, host)? {
        log::Files::Log(parts) => {
            unasked(at_rest.identifiers(), Catalogue::default().identifiers(), "measurements")?;
            if let Some(option) = settings.first_of(false) {
                let log = data[0].display();
                let message =
                    format!("{option} is for measurement files, and {log} is a joint log");
                return Err(Failure::new(message));
            }
            Ok(Box::new(Motion::new(settings, source, parts, in_motion, host)?))
        }
        log::Files::Measurements(files) => {
            unasked(in_motion.identifiers(), LogCatalogue::default().identifiers(), "joint logs")?;
            Ok(Box::new(Campaign::new(settings, source, files, &[], at_rest, host)?))
        }
        log::Files::Both(files, parts) => {
            let catalogues = Catalogues { at_rest, in_motion };
            let both = settings.both(&catalogues, host)?;
            Ok(Box::new(Together::new(&both, source, files, parts, catalogues, host)?))
        }
    }
}

/// Refuses an effect of one's own that such data is not asked for.
fn unasked(given: Vec<&str>, known: Vec<&str>, of: &str) -> Result<(), Failure> {
    let own = given.into_iter().find(|name| !known.contains(name));
    own.map_or(Ok(()), |own| {
        Err(Failure::new(format!("found the effect `{own}`, which is of {of}, and none are given")))
    })
}

fn in_words(stage: Stage) -> String {
    match stage {
        Stage::Align => "simulating the rows and fitting the unknown frames".to_owned(),
        Stage::Search(found) => format!("looking for effects, {found} found"),
        Stage::Try(found, effect, place) => {
            format!("looking for effects, {found} found: fitting {} at {place}", words(effect))
        }
        Stage::Judge(found) => format!("judging {} and their rivals", counted(found, "finding")),
    }
}

/// The built-in robots: a file may be that of another one.
fn family() -> Vec<Robot> {
    let read = |arm: &stiffarm_robots::Arm| Robot::from_toml(arm.toml, arm.id).ok();
    stiffarm_robots::ARMS.iter().filter_map(read).map(|(robot, _)| robot).collect()
}

impl Args {
    /// Where the corrected arm goes.
    fn arms(&self) -> [&Option<Target>; 3] {
        [&self.write_robot, &self.write_urdf, &self.write_mjcf]
    }

    fn write_arm(&self, found: &dyn Found, host: &Host) -> Result<(), Failure> {
        host.put(&self.write_robot, || found.corrected())?;
        for (target, format) in [(&self.write_urdf, Format::Urdf), (&self.write_mjcf, Format::Mjcf)]
        {
            if let Some(target) = target {
                let (text, lost) = found.exported(format)?;
                host.write(target, &text)?;
                lost.iter().for_each(|lost| host.note(lost));
            }
        }
        if self.arms().iter().any(|target| target.is_some()) {
            found.caveats().iter().for_each(|caveat| host.note(caveat));
        }
        Ok(())
    }
}

impl Settings {
    /// What the diagnosis of measurements is asked for.
    ///
    /// # Errors
    /// [`Failure`] names the option whose value cannot be used.
    pub fn options(
        &self,
        source: &Source,
        arm: &Arm,
        springs: &[Spring],
        catalogue: Catalogue,
        host: &Host,
    ) -> Result<Options, Failure> {
        let noise = |option, text: &Option<String>, dimension| {
            text.as_ref().map(|t| quantity::with_unit(option, t, dimension)).transpose()
        };
        let tolerance = self.tolerance.as_ref().map(|text| {
            let (length, angle) = text.split_once(',').ok_or_else(|| {
                let help = "write both, as --tolerance 0.3mm,0.5mrad";
                Failure::with_help(format!("--tolerance: found `{text}`, expected two"), help)
            })?;
            let one = |text, dimension| quantity::with_unit("--tolerance", text, dimension);
            Ok::<_, Failure>([one(length, Dimension::Length)?, one(angle, Dimension::Angle)?])
        });
        let mut options = Options {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            folds: self.folds,
            seed: self.seed,
            keep_all: self.keep_all,
            nested: self.nested,
            noise_position: noise("--noise-position", &self.noise_position, Dimension::Length)?,
            noise_rotation: noise("--noise-rotation", &self.noise_rotation, Dimension::Angle)?,
            effects: self.effects.clone(),
            tolerance: tolerance.transpose()?,
            rivals: self.rivals.clone(),
            known: source.known.clone(),
            family: family(),
            springs: springs.to_vec(),
            stop: host.stop(),
            catalogue,
            ..Options::default()
        };
        options.fit_along(&self.nuisance)?;
        let read = |text: &String| Prior::parse(text, arm, &options.catalogue);
        options.priors = self.usual.iter().map(read).collect::<Result<_, _>>()?;
        Ok(options)
    }
}
