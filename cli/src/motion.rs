//! What `simulate --log`, `withhold --motion` and `poses --for motion` share: how joints are moved and
//! how that is logged. Each of them has a group `moved`, without which none of these options says anything.

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use stiffarm_document::text::counted;
use stiffarm_gap::log::{Log, Names, Signal};
use stiffarm_gap::rng::{Rng, Stream};
use stiffarm_kernels::generic::Arm;
use stiffarm_plant::course::{Course, Fourier, Limits, Sampled};
use stiffarm_plant::motion::{Logged, Recording, Side, Stage};

use crate::host::Host;
use crate::input::source::Source;
use crate::terminal::failure::Failure;

/// How the joints move.
#[derive(clap::Args)]
#[command(next_help_heading = "Of a motion")]
pub struct MotionArgs {
    /// Largest rate of the joints: one, or one for each, rad/s or m/s [default: 1 rad/s, 0.25 m/s]
    #[arg(long, requires = "moved", value_name = "RATE", value_delimiter = ',')]
    max_rate: Vec<f64>,
    /// Largest acceleration: one, or one for each, rad/s² or m/s² [default: 3 rad/s², 0.75 m/s²]
    #[arg(long, requires = "moved", value_name = "ACCELERATION", value_delimiter = ',')]
    max_acceleration: Vec<f64>,
    /// Time of a motion that is drawn or chosen
    #[arg(long, requires = "moved", value_name = "TIME", default_value = "20s", value_parser = seconds)]
    period: f64,
    /// Terms of its Fourier series
    #[arg(long, requires = "moved", value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u8).range(3..=100))]
    harmonics: u8,
}

/// How a motion is logged.
#[derive(clap::Args)]
#[command(next_help_heading = "Of a joint log")]
pub struct RecordArgs {
    /// What is logged
    #[arg(long, requires = "moved", value_enum, default_value_t = RowsArg::Motor)]
    logged: RowsArg,
    /// Motions that are drawn, a run of the log each
    #[arg(long, requires = "moved", value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..=1000))]
    runs: u16,
    /// Samples a second
    #[arg(long, requires = "moved", value_name = "FREQUENCY", default_value = "250Hz", value_parser = hertz)]
    rate: f64,
    /// Step of the encoders at the joints, rad or m
    #[arg(long, requires = "moved", value_name = "STEP", default_value_t = 1e-5)]
    encoder: f64,
    /// Standard deviation of a reading beyond that, rad or m [default: 0; of positions 0.0005]
    #[arg(long, requires = "moved", value_name = "READING")]
    noise_reading: Option<f64>,
    /// Standard deviation of a torque, as a part of its spread
    #[arg(long, requires = "moved", value_name = "PART", default_value = "2%", value_parser = part)]
    noise_torque: f64,
    /// Correlation time of that noise; 0s is white
    #[arg(long, requires = "moved", value_name = "TIME", default_value = "0s", value_parser = seconds)]
    colour: f64,
    /// Standard deviation of the clock
    #[arg(long, requires = "moved", value_name = "TIME", default_value = "0.05ms", value_parser = seconds)]
    jitter: f64,
    /// Part of the samples that is lost
    #[arg(long, requires = "moved", value_name = "PART", default_value = "0.1%", value_parser = part)]
    lost: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum RowsArg {
    /// Torques of the motors, at the joints' side of the gears
    Motor,
    /// Torques behind the gears
    Link,
    /// Currents of the motors
    Current,
    /// Torques that the controller asks of the drives
    Commanded,
    /// Commands, which position servos follow
    Position,
}

fn of_unit(text: &str, units: &[(&str, f64)], what: &str) -> Result<f64, String> {
    let text = text.trim();
    let read = |(unit, factor): &(&str, f64)| {
        Some(factor * text.strip_suffix(unit)?.trim_end().parse::<f64>().ok()?)
    };
    let found = units.iter().find_map(read).filter(|x| *x >= 0.0 && x.is_finite());
    found.ok_or_else(|| format!("expected {what}"))
}

/// A time that is not negative.
pub fn seconds(text: &str) -> Result<f64, String> {
    of_unit(
        text,
        &[("ms", 1e-3), ("min", 60.0), ("s", 1.0)],
        "a time with its unit, as 20s or 0.1ms",
    )
}

fn hertz(text: &str) -> Result<f64, String> {
    let units = [("kHz", 1e3), ("Hz", 1.0), ("", 1.0)];
    let found = of_unit(text, &units, "a frequency, as 250Hz")?;
    if found > 0.0 { Ok(found) } else { Err("expected a frequency above 0".to_owned()) }
}

fn part(text: &str) -> Result<f64, String> {
    let found = of_unit(text, &[("%", 0.01), ("", 1.0)], "a part, as 2% or 0.02")?;
    if found < 1.0 { Ok(found) } else { Err("expected less than 100%".to_owned()) }
}

impl MotionArgs {
    pub fn limits(&self, arm: &Arm) -> Result<Limits, Failure> {
        Ok(Limits::of(arm, &self.max_rate, &self.max_acceleration)?)
    }

    /// Time and terms of a motion.
    pub fn series(&self) -> (f64, usize) {
        (self.period, usize::from(self.harmonics))
    }

    /// The first of these options that is given.
    pub fn given(&self) -> Option<&'static str> {
        let rate = (!self.max_rate.is_empty()).then_some("--max-rate");
        rate.or((!self.max_acceleration.is_empty()).then_some("--max-acceleration"))
    }
}

/// The arm that is moved.
pub fn arm(source: &Source, command: &str) -> Result<Arm, Failure> {
    let Some(known) = source.at_rest_alone().next() else { return source.arm_at_its_base() };
    Err(Failure::with_help(
        format!(
            "{command}: found the effect {} in {}, expected none: it says where an arm at rest stands, and \
             the plant that moves has no law for it",
            known.effect.identifier(),
            source.given
        ),
        "take the `[[effect]]` tables out of a copy of the file",
    ))
}

/// Where the arm is sent, run by run.
pub struct Courses(Vec<Box<dyn Course>>);

impl Courses {
    /// Those of a file, else drawn.
    pub fn of(
        (file, host): (Option<&PathBuf>, &Host),
        source: &Source,
        arm: &Arm,
        (motion, record): (&MotionArgs, &RecordArgs),
        seed: u64,
    ) -> Result<Courses, Failure> {
        if let Some(path) = file {
            return Courses::read(path, source, arm, host);
        }
        let (period, harmonics) = motion.series();
        if period <= 0.0 {
            return Err(Failure::new("--period: found 0 s, expected more"));
        }
        let limits = motion.limits(arm)?;
        let mut rng = Rng::new(seed, Stream::Poses);
        let draw = |_| -> Box<dyn Course> {
            Box::new(Fourier::draw(&limits, period, harmonics, &mut rng))
        };
        Ok(Courses((0..record.runs).map(draw).collect()))
    }

    /// Commands of a file where it has some, else where its joints were.
    fn read(path: &Path, source: &Source, arm: &Arm, host: &Host) -> Result<Courses, Failure> {
        let told = host.read(path)?;
        let motions: Vec<_> = arm.joints.iter().map(|joint| joint.motion).collect();
        let names =
            Names::own(source.robot.joints.iter().map(|j| j.name.clone()).collect()).of_motion();
        let file = path.display().to_string();
        let log = Log::from_bytes(&file, &told, &motions, &names)?;
        let signal = if log.has(Signal::QCmd) { Signal::QCmd } else { Signal::Q };
        let course = |run: &stiffarm_gap::log::Run| -> Result<Box<dyn Course>, Failure> {
            let sampled = Sampled::of(&run.t, &run.signals[&signal]).ok_or_else(|| {
                let count = counted(run.t.len(), "sample");
                Failure::new(format!(
                    "{file}: run {}: found {count}, expected a motion of three steps of 20 ms or more",
                    run.name
                ))
            })?;
            Ok(Box::new(sampled))
        };
        Ok(Courses(log.runs.iter().map(course).collect::<Result<_, _>>()?))
    }

    /// The runs; nothing is held that the robot file does not hold.
    pub fn stages(&self) -> Vec<Stage<'_>> {
        self.0.iter().map(|course| Stage { course: course.as_ref(), payload: None }).collect()
    }
}

impl RecordArgs {
    pub fn logged(&self) -> Logged {
        match self.logged {
            RowsArg::Motor => Logged::Torque(Side::Motor),
            RowsArg::Link => Logged::Torque(Side::Link),
            RowsArg::Current => Logged::Torque(Side::Current),
            RowsArg::Commanded => Logged::Torque(Side::Commanded),
            RowsArg::Position => Logged::Position,
        }
    }

    /// How well.
    pub fn recording(&self) -> Result<Recording, Failure> {
        let usual = if self.logged == RowsArg::Position { 5e-4 } else { 0.0 };
        let reading = self.noise_reading.unwrap_or(usual);
        for (option, found) in [("--encoder", self.encoder), ("--noise-reading", reading)] {
            if !(found >= 0.0 && found.is_finite()) {
                let expected = "expected a number that is not negative";
                return Err(Failure::new(format!("{option}: found {found}, {expected}")));
            }
        }
        Ok(Recording {
            rate: self.rate,
            encoder: self.encoder,
            reading,
            torque: self.noise_torque,
            colour: self.colour,
            jitter: self.jitter,
            lost: self.lost,
            ..Recording::default()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_and_parts_have_units() {
        assert_eq!(seconds("20s"), Ok(20.0));
        assert_eq!(seconds("2 min"), Ok(120.0));
        assert!((seconds("0.05ms").unwrap() - 5e-5).abs() < 1e-18);
        assert_eq!(hertz("1 kHz"), Ok(1000.0));
        assert!((part("2%").unwrap() - 0.02).abs() < 1e-17);
        for wrong in ["20", "-1s", "soon", ""] {
            assert!(seconds(wrong).is_err(), "{wrong}");
        }
        assert!(part("100%").is_err() && hertz("0Hz").is_err());
    }
}
