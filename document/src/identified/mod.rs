//! The document of an identification: what the springs are, and how far they reduce the error.

mod words;

use serde_json::Value;
use stiffarm_gap::Measurements;
use stiffarm_gap::gap::Statistics;
use stiffarm_gap::identify::measured::{Answer, Parameter, Question, Unknown};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use words::{Said, advice, said, sentence};

use crate::figure::{
    Drawing, EXPERIMENT, Experiment, Multiple, Shaped, Step, arm, corrected, curve, forest,
    residuals, shares,
};
use crate::report::{Errors, Method, Report};
use crate::text::{counted, short};
use crate::words::{capital, noise_from, percent};
use crate::{Block, Cell, Document, Embedded, PageError, Row, Table, Unit, Units};

/// How every identification is made.
const METHOD: &str = "\
Every row is compared with the robot file’s arm at static equilibrium under the row’s load and the links’ weight, with \
the loaded geometry. The compliances are estimated by the Gauss-Newton method, weighted by the noise; one that has no \
effect on the rows, or whose effect is a combination of others, is held at the file’s value. Intervals are those of \
least squares with Student’s t. The error after is on held-out poses.";

/// What is said below the fitted curves.
const CURVES: &str = "The line is the correction of the joint; a point is the same plus the row’s residual as a motion \
                      of that joint. Points along the line show that the joint is a spring. The torque is that of the \
                      robot file’s model.";

/// What the document is made of.
pub struct Identified<'a> {
    /// The robot's name.
    pub robot: &'a str,
    /// What was given for it.
    pub given: &'a str,
    /// It.
    pub arm: &'a Arm,
    /// From what it was identified.
    pub data: &'a Measurements,
    /// How it was asked for.
    pub question: &'a Question,
    /// What was found.
    pub answer: &'a Answer,
}

impl Identified<'_> {
    /// The document; the pictures of a page are worked out for one alone.
    pub fn document(&self, is_page: bool) -> Document {
        let (data, answer) = (self.data, self.answer);
        let facts = format!(
            "{}: {} of {} at {}, held out in {}",
            data.file,
            counted(data.rows.len(), "measurement"),
            data.kind.measured().join(" "),
            counted(data.poses, "pose"),
            counted(answer.gap.folds, "fold")
        );
        let advice = advice(answer);
        let said = said(self.arm, answer);
        let most = advice.len();
        let report = Report {
            robot: self.robot.to_owned(),
            about: "what its springs are",
            facts,
            sentence: sentence(self.arm, answer, self.main(), self.error()),
            first: [self.springs(&said)].into_iter().chain(links(answer, &said)).collect(),
            error: self.errors(),
            rest: Block::notes("To measure", advice, most).into_iter().collect(),
            page: is_page.then(|| {
                (self.details(), Method { text: METHOD, facts: self.settings(), lists: &[] })
            }),
        };
        report.document()
    }

    /// What its page embeds; `whole` is the result as it is written.
    pub fn embedded(&self, whole: &Value) -> Result<Embedded, PageError> {
        let mut experiment = self.experiment();
        experiment.shares = shares(&experiment, self.answer);
        let curves: Vec<Shaped<'_>> = corrected(self.answer).map(curve).collect();
        Embedded::new(Drawing::of(experiment, &curves), whole, EXPERIMENT)
    }

    fn units(&self) -> Units {
        Units::of(self.data)
    }

    /// The unit of what is judged.
    fn main(&self) -> Unit<'static> {
        let gap = &self.answer.gap;
        self.units().main([self.judged(&gap.before), self.judged(&gap.held_out)])
    }

    fn judged(&self, s: &Statistics) -> f64 {
        self.units().judged(s)
    }

    fn error(&self) -> &'static str {
        self.units().error()
    }

    fn experiment(&self) -> Experiment<'_> {
        let (gap, units) = (&self.answer.gap, self.units());
        let [before, after] = &gap.rows;
        Experiment {
            data: self.data,
            arm: self.arm,
            placed: self.arm,
            mounts: Vec::new(),
            markers: Vec::new(),
            gaps: [before, after],
            shares: Vec::new(),
            length: units.length([gap.before.position_rms, gap.held_out.position_rms]),
            angle: units.angle([gap.before.rotation_rms, gap.held_out.rotation_rms]),
        }
    }

    /// Joints and base: stiffnesses.
    fn springs(&self, said: &[Said]) -> Block {
        let mut table = Table::new(["", "found", "95 %", "robot file", ""]);
        let all = self.answer.parameters.iter().zip(said);
        let springs = all.filter(|(p, _)| !matches!(p.unknown, Unknown::Link(_)));
        let row = |(_, said): (&Parameter, &Said)| -> Row {
            let cells = [&said.place, &said.found, &said.interval, &said.file, &said.verdict];
            cells.map(|text| Cell::Text(text.clone())).to_vec()
        };
        table.rows = springs.map(row).collect();
        let mut page = vec![Block::Csv("parameters")];
        let multiples = self.multiples(said);
        if !multiples.is_empty() {
            let caption = "Points are the estimates, lines their 95 % intervals; to the right of 1 the joint is more \
                           compliant than in the robot file.";
            page.insert(0, Block::Figure(Box::new(forest(&multiples)), caption.to_owned()));
        }
        Block::section("Stiffness", vec![Block::Table(table), Block::Page(page)])
    }

    fn multiples(&self, said: &[Said]) -> Vec<Multiple> {
        let parameters = self.answer.parameters.iter().zip(said);
        let multiple = |(p, said): (&Parameter, &Said)| {
            let interval = p.interval().filter(|_| p.usable() && p.file > 0.0);
            interval.map(|interval| Multiple {
                label: said.place.clone(),
                value: p.value / p.file,
                interval: interval.map(|end| (end / p.file).max(f64::MIN_POSITIVE)),
                text: format!("{} ×", short(p.value / p.file)),
            })
        };
        parameters.filter_map(multiple).collect()
    }

    fn errors(&self) -> Errors {
        let (gap, noise, units) = (&self.answer.gap, &self.answer.noise, self.units());
        let (length, angle) = {
            let drawn = self.experiment();
            (drawn.length, drawn.angle)
        };
        let rotation = noise.rotation.is_some();
        let mut heads = vec![String::new()];
        if units.positions {
            heads.extend([format!("rms {}", length.name), format!("max {}", length.name)]);
        }
        heads.extend(rotation.then(|| format!("rotation rms {}", angle.name)));
        let whole = self.judged(&gap.before);
        let row = |name: &str, s: &Statistics| -> Row {
            let mut cells: Row = vec![name.into()];
            if units.positions {
                let sizes = [s.position_rms, s.position_max];
                cells.extend(sizes.map(|x| Cell::number(length.number(x))));
            }
            cells.extend(rotation.then(|| Cell::number(angle.number(s.rotation_rms))));
            let part = if whole > 0.0 { self.judged(s) / whole } else { 0.0 };
            cells.push(Cell::Bar(part));
            cells
        };
        let mut last: Row =
            vec![format!("noise of one component, {}", noise_from(noise.from)).into()];
        if let Some(sd) = noise.position {
            last.extend([Cell::number(length.number(sd)), Cell::number("")]);
        }
        last.extend(noise.rotation.map(|sd| Cell::number(angle.number(sd))));
        let rows = vec![
            row("robot file as it is", &gap.before),
            row("with the identified springs, held out", &gap.held_out),
            last,
        ];
        let table = Table { heads, rows, caption: String::new() };
        Errors {
            heading: capital(self.error()),
            table,
            steps: self.steps(),
            unit: self.main(),
            caption: "After: on held-out poses.",
        }
    }

    fn steps(&self) -> Vec<Step> {
        let (gap, noise, unit) = (&self.answer.gap, &self.answer.noise, self.main());
        let (before, after) = (self.judged(&gap.before), self.judged(&gap.held_out));
        let less = if before > 0.0 { 1.0 - after / before } else { 0.0 };
        let positions = self.units().positions;
        let first = if positions { 0 } else { 3 };
        let measured = self.data.kind.components()[first..first + 3].iter().filter(|m| **m).count();
        let one = if positions { noise.position } else { noise.rotation };
        let floor = one.unwrap_or(0.0) * (measured as f64).sqrt();
        let removed = format!("{} less", percent(less));
        vec![
            Step::of("robot file as it is", "whole", before, unit.with_unit(before)),
            Step {
                from: after.min(before),
                ..Step::of("identified springs", "removed", after.max(before), removed)
            },
            Step::of("remains, held out", "left", after, unit.with_unit(after)),
            Step::of("noise", "noise", floor, unit.with_unit(floor)),
        ]
    }

    /// What only a page has room for.
    fn details(&self) -> Vec<Block> {
        let places = shares(&self.experiment(), self.answer);
        let places = places.into_iter().filter_map(|share| Some((share.place, share.share?)));
        let remark = "mean square of what the joint’s correction moves, individually, as a part of the error’s; the \
                      shares overlap";
        let shares = Block::Shares {
            name: "What each correction moves",
            shares: places.collect(),
            remark: remark.to_owned(),
        };
        let poses = match self.data.kind.is_difference() {
            true => "",
            false => {
                "; of poses the mean over the loads of each is subtracted, since only differences between \
                      loads are used"
            }
        };
        vec![
            Block::section("The arm and its error", vec![arm(), shares]),
            Block::Section {
                heading: "Residuals, before and after".to_owned(),
                remark: format!("every row by a fit that has not seen its pose{poses}"),
                blocks: vec![residuals(self.data.rows.len(), Vec::new(), CURVES)],
            },
        ]
    }

    fn settings(&self) -> Vec<(&'static str, String)> {
        let (question, answer) = (self.question, self.answer);
        let mut unknowns = vec!["joints"];
        unknowns.extend(question.links.then_some("links"));
        unknowns.extend(question.base.then_some("base"));
        vec![
            ("stiffarm", env!("CARGO_PKG_VERSION").to_owned()),
            ("robot", self.given.to_owned()),
            ("measurements", self.data.file.clone()),
            ("identified", unknowns.join(", ")),
            ("folds of poses", answer.gap.folds.to_string()),
            ("seed", question.seed.to_string()),
            ("noise", noise_from(answer.noise.from).to_owned()),
            ("degrees of freedom", answer.freedom.to_string()),
            ("condition number of the scaled columns", format!("{:.3}", answer.scaled_condition)),
        ]
    }
}

/// Whether a compliance is that of a translation, m/N.
pub fn is_translation(arm: &Arm, unknown: Unknown) -> bool {
    match unknown {
        Unknown::Joint(j) => {
            arm.joints.get(j - 1).is_some_and(|joint| joint.motion == Motion::Prismatic)
        }
        Unknown::Link(_) => false,
        Unknown::Base(k) => k < 3,
    }
}

/// `1/c`; none where that is not a stiffness.
pub fn stiffness(compliance: f64) -> Option<f64> {
    (compliance > 0.0).then(|| 1.0 / compliance).filter(|k| k.is_finite())
}

/// Links: their flexibility as a multiple of the file's.
fn links(answer: &Answer, said: &[Said]) -> Option<Block> {
    let mut table = Table::new(["", "× the file's", "95 %", ""]);
    let all = answer.parameters.iter().zip(said);
    let links = all.filter(|(p, _)| matches!(p.unknown, Unknown::Link(_)));
    let row = |(_, said): (&Parameter, &Said)| -> Row {
        let cells = [&said.place, &said.found, &said.interval, &said.verdict];
        cells.map(|text| Cell::Text(text.clone())).to_vec()
    };
    table.rows = links.map(row).collect();
    (!table.rows.is_empty()).then(|| Block::section("Flexibility", vec![Block::Table(table)]))
}
