//! `stiffarm compensate --program`: a controller's program with its points corrected.

use std::path::{Path, PathBuf};

use nalgebra::{Isometry3, Vector6};
use stiffarm_codegen::derive::Given;
use stiffarm_compensate::points::{Before, Controlled, Moved, Placed, Unmoved};
use stiffarm_compensate::program::{Change, Fault, File, Language, Left, Point, Program, edited};
use stiffarm_compensate::reach::{Search, rigid};
use stiffarm_document::text::{counted, words};
use stiffarm_gap::measurement::Dimension;
use stiffarm_gap::whole::{Situation, Whole};

use super::Verdict;
use super::places::places;
use super::report::{Outcome, moves, screen};
use crate::host::Host;
use crate::input::branches::{Branches, WITHIN};
use crate::input::quantity;
use crate::input::source::{RobotArgs, Source};
use crate::terminal::failure::{Failure, Remark};
use crate::terminal::output::Target;
use crate::terminal::progress::Progress;

/// A program, and what it does not say itself.
#[derive(clap::Args)]
pub struct ProgramArgs {
    /// A program whose points are corrected; once for each of its files
    #[arg(long, value_name = "FILE", requires = "nominal", conflicts_with = "targets")]
    program: Vec<PathBuf>,
    /// The robot as its controller computes it: a robot file, or the id of a built-in robot
    #[arg(long, value_name = "ROBOT", requires = "program")]
    nominal: Option<String>,
    /// Where a base, work object or user frame stands in the robot's base, as the program's language writes
    /// a pose: `--frame 2=500,0,200,0,0,0`; `default` is what a program does not say
    #[arg(long, value_name = "NAME=POSE", allow_hyphen_values = true, requires = "program")]
    frame: Vec<String>,
    /// Where a tool stands on the flange (the last frame of the table): `--tool 1=0,0,150,0,0,0`, or
    /// `--tool 1=robot` for the [tool] of the robot files, which `default` is
    #[arg(long, value_name = "NAME=POSE", allow_hyphen_values = true, requires = "program")]
    tool: Vec<String>,
    /// Joint values before the first point: its branch, and from which side the joints come
    #[arg(long, value_name = "q1,q2,…", allow_hyphen_values = true, requires = "program")]
    home: Option<String>,
    /// Points that are to stay as they are, by their names, separated by commas
    #[arg(long, value_name = "NAMES", value_delimiter = ',', requires = "program")]
    leave: Vec<String>,
    /// Write what became of each point
    #[arg(long, value_name = "CSV", requires = "program")]
    moves: Option<Target>,
}

impl ProgramArgs {
    /// Reads, corrects and writes the program.
    pub(super) fn run(
        &self,
        source: Source,
        (load, search): (Vector6<f64>, Search),
        out: &Target,
        host: &Host,
    ) -> Result<Verdict, Failure> {
        let named = RobotArgs::named(self.nominal.as_deref().unwrap_or_default());
        let nominal = named.load(host)?.at_its_base();
        let source = source.at_its_base();
        let arm = source.arm()?;
        let of_controller = rigid(&nominal.arm()?);
        let real = Whole { arm: &arm, known: &source.known };
        let of_nominal = Whole { arm: &of_controller, known: &nominal.known };
        if arm.dof() != of_controller.dof() {
            let (has, other) = (of_controller.dof(), arm.dof());
            let message = format!(
                "--nominal: found {has} joints, expected {other}: those of {}",
                source.given
            );
            return Err(Failure::new(message));
        }
        let joints: Vec<Dimension> = source.readings();
        let home = self.home.as_ref().map(|text| {
            quantity::list("--home", text, &joints, "give a value for each joint of the robot")
        });
        let home = home.transpose()?;
        self.decided(&source, (&real, &load), home.is_some())?;
        nominal.refuse_undecided("compensate --nominal", &of_nominal, &Situation::under(load))?;
        let mut program = self.read(arm.dof(), host)?;
        self.set_aside(&mut program)?;
        let places = places(&program, (&self.frame, &self.tool), host)?;
        let inverse = Branches::of(&nominal).filter(|arm| arm.form.given.is_none());
        let branches = |pose: &Isometry3<f64>| -> Vec<Vec<f64>> {
            let Some(arm) = &inverse else { return Vec::new() };
            let all = arm.at(pose, &[], (None, &Given::default())).into_iter();
            let reached = all.filter(|b| b.within && b.distance <= WITHIN && b.tilt <= WITHIN);
            reached.map(|branch| branch.q).collect()
        };
        let search = Search { starts: 0, ..search };
        let with = Controlled { nominal: of_nominal, real, inverse: &branches, load, search };
        let progress = Progress::new(&source.given, program.points.len(), host);
        let mut before = Before { q: home, sides: vec![0; arm.dof()] };
        let mut outcomes = Vec::new();
        for (point, (frame, tool)) in program.points.iter().zip(places) {
            let placed = Placed { point, frame, tool };
            let text = &program.files[point.file].text;
            let moved = with.moved(&placed, program.language, text, &mut before);
            if let Err(unmoved @ Unmoved::Undetermined(_)) = &moved {
                let help = "give the joint values before it: --home q1,q2,…";
                let message = format!("{}: {unmoved}", point.name);
                let file = &program.files[point.file];
                return Err(Failure::File(vec![remark(file, &point.span, &message, help)]));
            }
            outcomes.push(Outcome { point, moved });
            progress.add(1);
        }
        drop(progress);
        self.write(&program, &outcomes, out, host)?;
        host.put(&self.moves, || Ok(moves(&source, &program, &outcomes)))?;
        let shown = *out != Target::Stdout && self.moves != Some(Target::Stdout);
        if shown && !host.is_quiet() {
            host.print(&screen(&source, &program, &outcomes))?;
        }
        let missed = outcomes.iter().filter(|outcome| outcome.moved.is_err()).count();
        match missed {
            0 => Ok(Verdict::Good),
            _ => {
                let all = counted(outcomes.len(), "point");
                host.note(&format!("{missed} of {all} cannot be corrected and stay as they are"));
                Ok(Verdict::Failed)
            }
        }
    }

    /// Refuses effects that nothing decides.
    fn decided(
        &self,
        source: &Source,
        (real, load): (&Whole<'_>, &Vector6<f64>),
        has_home: bool,
    ) -> Result<(), Failure> {
        let n = real.arm.dof();
        let known = Situation {
            direction: Some(vec![0; n]),
            before: Some(vec![0.0; n]),
            ..Situation::under(*load)
        };
        source.refuse_undecided("compensate --program", real, &known)?;
        match real.undecided(&Situation::under(*load)) {
            Some((effect, unknown)) if !has_home => {
                let (name, place) = (words(effect.effect.identifier()), effect.spot.place);
                Err(Failure::with_help(
                    format!(
                        "the {name} at {place} depends on {unknown}, and nothing is known of where the program begins"
                    ),
                    "give the joint values before its first point: --home q1,q2,…",
                ))
            }
            _ => Ok(()),
        }
    }

    fn read(&self, joints: usize, host: &Host) -> Result<Program, Failure> {
        let mut files = Vec::new();
        let mut language = None;
        for path in &self.program {
            let name = path.display().to_string();
            let of = Language::of(&name).ok_or_else(|| {
                Failure::with_help(
                    format!("--program: found {name}, expected a program"),
                    "a program ends with .src or .dat (KRL), .mod (RAPID), .ls (FANUC), .script (URScript) or .csv",
                )
            })?;
            if *language.get_or_insert(of) != of {
                let first = self.program[0].display();
                let message = format!("--program: {first} and {name} are of two languages");
                return Err(Failure::with_help(message, "correct one program at a time"));
            }
            files.push(File { name, text: host.read(path)? });
        }
        let language = language.unwrap_or(Language::Table);
        if language != Language::Table && joints != 6 {
            let message = format!("--program: found a robot of {joints} joints, expected 6");
            return Err(Failure::with_help(
                message,
                "other robots' points stand in a table (.csv)",
            ));
        }
        let kept = files.clone();
        Program::read(files, language, joints).map_err(|Fault { file, span, message, help }| {
            Failure::File(vec![remark(&kept[file], &span, &message, &help)])
        })
    }

    /// Takes the points out that are to be left.
    fn set_aside(&self, program: &mut Program) -> Result<(), Failure> {
        let is = |name: &String, point: &Point| name.trim().eq_ignore_ascii_case(&point.name);
        for name in &self.leave {
            if !program.points.iter().any(|point| is(name, point)) {
                return Err(Failure::new(format!(
                    "--leave: the program has no point `{}`",
                    name.trim()
                )));
            }
        }
        let asked = |point: &Point| self.leave.iter().any(|name| is(name, point));
        let aside = program.points.iter().filter(|point| asked(point));
        let mut left: Vec<Left> = aside.map(|p| p.leave("as --leave asks".to_owned())).collect();
        program.points.retain(|point| !asked(point));
        program.left.append(&mut left);
        program.left.sort_by_key(|left| (left.file, left.span.start));
        Ok(())
    }

    fn write(
        &self,
        program: &Program,
        outcomes: &[Outcome<'_>],
        out: &Target,
        host: &Host,
    ) -> Result<(), Failure> {
        let changes = |file: usize| -> Vec<Change> {
            let of = outcomes.iter().filter(|outcome| outcome.point.file == file);
            let moved = of.filter_map(|outcome| outcome.moved.as_ref().ok());
            moved.flat_map(|moved: &Moved| moved.changes.clone()).collect()
        };
        let several = program.files.len() > 1;
        for (k, file) in program.files.iter().enumerate() {
            let target = match out {
                Target::Stdout if several => {
                    let message = "--out: found `-`, expected a folder for several files";
                    return Err(Failure::new(message));
                }
                Target::File(folder) if several => {
                    if !host.owns(folder) {
                        let made = std::fs::create_dir_all(folder);
                        made.map_err(|error| Failure::io("write", folder, &error))?;
                    }
                    let name = Path::new(&file.name).file_name().unwrap_or_default();
                    Target::File(apart(&folder.join(name), Path::new(&file.name))?)
                }
                one => one.clone(),
            };
            let text = edited(&file.text, changes(k));
            host.stream(&target, &mut |to| to.write_all(&text).map(|()| true))?;
        }
        Ok(())
    }
}

/// Where a file of a folder is written, which is not where it was read.
fn apart(to: &Path, from: &Path) -> Result<PathBuf, Failure> {
    let there = std::fs::canonicalize(to).ok();
    match there.is_some() && there == std::fs::canonicalize(from).ok() {
        true => {
            let message = format!("--out would write over --program: {}", to.display());
            Err(Failure::with_help(message, "name another folder"))
        }
        false => Ok(to.to_owned()),
    }
}

/// At its place in a text; of a file that is no UTF-8 line and column are told in words.
pub(super) fn remark(
    file: &File,
    span: &std::ops::Range<usize>,
    message: &str,
    help: &str,
) -> Remark {
    let File { name, text } = file;
    let shown = std::str::from_utf8(text).ok().filter(|text| span.start < text.len());
    let (message, span) = match shown {
        Some(_) => (message.to_owned(), Some(span.clone())),
        None => {
            let (line, column) = file.line_and_column(span.start);
            (format!("line {line}, column {column}: {message}"), None)
        }
    };
    Remark::error(message, Some(help.to_owned()), name, shown.unwrap_or_default(), span)
}
