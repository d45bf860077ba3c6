//! What a diagnosis has learnt of the arm, for the map of what that is worth.

use std::path::PathBuf;

use nalgebra::Vector6;
use stiffarm_document::text::counted;
use stiffarm_gap::diagnose::{Expected, Explanation};
use stiffarm_gap::effects::Catalogue;
use stiffarm_gap::{DiagnoseError, diagnose_with};
use stiffarm_kernels::generic::Arm;

use crate::diagnose::Settings;
use crate::host::Host;
use crate::input::data;
use crate::input::source::Source;
use crate::terminal::failure::Failure;
use crate::terminal::progress::Stages;

/// Which measurements, and how they are diagnosed.
#[derive(clap::Args)]
pub struct LearntArgs {
    /// The measurement file (CSV) of `--of shrink`, diagnosed first
    #[arg(long, value_name = "DATA")]
    data: Option<PathBuf>,
    /// Frames known to be unknown, fitted along: base_frame, tool_frame
    #[arg(long, value_name = "a,b", value_delimiter = ',', requires = "data")]
    nuisance: Vec<String>,
    /// Standard deviation of a measured coordinate: 30um [default: from repeats, else estimated]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, requires = "data")]
    noise_position: Option<String>,
}

/// The findings of a diagnosis.
pub struct Learnt {
    explanation: Explanation,
    name: String,
}

impl Learnt {
    /// Diagnoses the measurements if they are `wanted`.
    pub fn new(
        args: &LearntArgs,
        wanted: bool,
        source: &Source,
        arm: &Arm,
        host: &Host,
    ) -> Result<Option<Learnt>, Failure> {
        let path = match (&args.data, wanted) {
            (Some(path), true) => path,
            (None, false) => return Ok(None),
            (None, true) => {
                let help = "name the measurements that are to be diagnosed: --data run.csv";
                return Err(Failure::with_help("--of shrink: found no --data", help));
            }
            (Some(_), false) => return Err(Failure::new("--data is for --of shrink")),
        };
        let settings = Settings {
            nuisance: args.nuisance.clone(),
            noise_position: args.noise_position.clone(),
            ..Settings::default()
        };
        let options = settings.options(source, arm, &[], Catalogue::default(), host)?;
        let data = data::read(path, &data::layout(source)?, host)?;
        data::doubted(arm, &data, &options.nuisances, host);
        let stages = Stages::new(host);
        stages.say(format!("diagnosing {}", path.display()));
        let found = diagnose_with(arm, &data, &options, &|_| {})?;
        drop(stages);
        let findings = found.diagnosis.findings.len();
        let file = path.display().to_string();
        if findings == 0 {
            let help = "`stiffarm diagnose` says what it could and could not have shown";
            return Err(Failure::with_help(format!("{file}: the diagnosis finds no effect"), help));
        }
        let name = path.file_name().map_or(file, |name| name.to_string_lossy().into_owned());
        let name = format!("{} of {name}", counted(findings, "finding"));
        Ok(Some(Learnt { explanation: found.explanation, name }))
    }

    /// The gap before and after at a posture.
    pub fn expected(&self, q: &[f64], wrench: &Vector6<f64>) -> Result<Expected, DiagnoseError> {
        self.explanation.expected(q, wrench)
    }

    /// `2 findings of run.csv`.
    pub fn name(&self) -> String {
        self.name.clone()
    }
}
