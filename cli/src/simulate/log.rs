//! The joint log of an arm that moves.

use stiffarm_document::text::{counted, short};
use stiffarm_plant::motion::{Logged, MotionTruth, MovingPlant, csv, known};

use super::Args;
use crate::Verdict;
use crate::host::Host;
use crate::input::source::Source;
use crate::motion::{self, Courses};
use crate::terminal::failure::Failure;
use crate::terminal::output::Target;

/// Moves the arm and writes what it logs.
pub(super) fn run(
    args: &Args,
    source: &Source,
    target: &Target,
    host: &Host,
) -> Result<Verdict, Failure> {
    let arm = motion::arm(source, "simulate --log")?;
    let seed = args.experiment.seed;
    let how = (&args.motion, &args.record);
    let courses = Courses::of((args.data.as_ref(), host), source, &arm, how, seed)?;
    let stages = courses.stages();
    let truths = args.effects.iter().map(|text| MotionTruth::parse(text, &arm, stages.len()));
    let truths: Vec<MotionTruth> = truths.collect::<Result<_, _>>()?;
    let (logged, recording) = (args.record.logged(), args.record.recording()?);
    let known = known(&source.motion, &arm, stages.len(), logged)?;
    let plant = MovingPlant::new(&arm, &[&known[..], &truths].concat(), logged, recording);
    let runs = plant.record(&stages, seed)?;
    let what = match &args.data {
        Some(path) => format!("along the commands of {}", path.display()),
        None => "along motions that were drawn".to_owned(),
    };
    let noise = match logged {
        Logged::Torque(_) => {
            format!("torques to {} % of their spread", short(100.0 * recording.torque))
        }
        Logged::Position => format!("joint values to {}", short(recording.reading)),
    };
    let mut comments = vec![
        format!("{}, simulated: {}, {what}", arm.name, counted(runs.len(), "run")),
        format!("{noise}, encoders to {}; seed {seed}", short(recording.encoder)),
    ];
    comments.extend(args.told(&truths));
    host.write(target, &csv(&arm, logged, &runs, &comments))?;
    Ok(Verdict::Good)
}
