//! Whether the ways of computing an arm's outputs agree: what was generated from the table, the
//! textbook ([`crate::generic`]), differences of the textbook, and dual numbers. Shares nothing with
//! the generator.
//!
//! [`agreement`] draws postures and loads and keeps the largest deviation of every output by every
//! way, relative to the output's [`scale`].

mod differences;
pub mod draw;
mod dual;
mod motion;
pub mod scale;

use std::num::NonZero;
use std::vec::Vec;

use crate::generic::Arm;
use crate::{Error, Kernels, Output, Scalar, Unstable};

use draw::Sample;

/// What the generated output is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comparison {
    /// The textbook runtime.
    Textbook,
    /// The textbook runtime, of what was generated in single precision.
    Single,
    /// Central differences of another output of the textbook.
    Differences,
    /// Derivatives of the forward kinematics by dual numbers, and what d'Alembert's principle makes of them.
    Dual,
}

impl Comparison {
    /// Every comparison, as the columns stand.
    pub const EACH: [Comparison; 4] =
        [Comparison::Textbook, Comparison::Single, Comparison::Differences, Comparison::Dual];

    /// The largest deviation, relative to the output's scale, that the arithmetic accounts for.
    pub const fn limit(self) -> f64 {
        match self {
            Comparison::Textbook | Comparison::Dual => 1e-12,
            Comparison::Single => 2e-6,
            Comparison::Differences => 1e-7,
        }
    }
}

/// An implementation: an output as one column-major block, at a state, under a wrench.
pub type Evaluate<'a> = dyn Fn(Output, &[f64], &[f64; 6]) -> Result<Vec<f64>, Unstable> + Sync + 'a;

/// Compiled kernels of any scalar as such an implementation; `back` makes a double of their numbers.
///
/// # Panics
/// The implementation does where joint values are not the arm's, or its module lacks the output.
pub fn compiled<S: Scalar>(
    kernels: &(dyn Kernels<S> + Sync),
    back: impl Fn(S) -> f64 + Sync,
) -> impl Fn(Output, &[f64], &[f64; 6]) -> Result<Vec<f64>, Unstable> + Sync {
    move |output, q, w| {
        let (rows, columns) = output.shape(kernels.dof());
        let mut out = vec![S::lit(0.0); rows * columns];
        let q: Vec<S> = q.iter().map(|x| S::lit(*x)).collect();
        match kernels.evaluate(output, &q, &w.map(S::lit), &mut out) {
            Ok(()) => Ok(out.into_iter().map(&back).collect()),
            Err(Error::Unstable) => Err(Unstable),
            Err(wrong) => panic!("{}: {wrong}", output.name()),
        }
    }
}

/// What an output must be by the differences of another; `None` where none says it.
pub type Slopes<'a> = dyn Fn(Output, &[f64], &[f64; 6]) -> Option<Vec<f64>> + Sync + 'a;

/// An implementation that does not tell every output.
pub type Tells<'a> =
    dyn Fn(Output, &[f64], &[f64; 6]) -> Result<Option<Vec<f64>>, Unstable> + Sync + 'a;

/// What stands in the place of the textbook, of an arm that is more than its table.
pub struct Beyond<'a> {
    /// Its outputs.
    pub evaluate: &'a Tells<'a>,
    /// Differences of these.
    pub slopes: &'a Slopes<'a>,
}

/// What is to be compared.
pub struct Subject<'a> {
    /// What is compared.
    pub outputs: &'a [Output],
    /// The arm as the textbook has it.
    pub arm: &'a Arm,
    /// What it is compared with in place of the textbook: dual numbers know the table alone.
    pub beyond: Option<Beyond<'a>>,
    /// The generated implementation.
    pub generated: &'a Evaluate<'a>,
    /// The same in single precision, where there is one; it is given numbers that single precision has.
    pub single: Option<&'a Evaluate<'a>>,
}

/// The largest deviations of one output, relative to its scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Which output.
    pub output: Output,
    /// One per [`Comparison::EACH`]; `None` where it does not apply.
    pub worst: [Option<f64>; 4],
}

impl Line {
    /// The comparisons that are beyond their limits.
    pub fn exceeded(&self) -> impl Iterator<Item = Comparison> + '_ {
        let pairs = Comparison::EACH.into_iter().zip(self.worst);
        pairs.filter(|(c, worst)| worst.is_some_and(|w| w > c.limit())).map(|(c, _)| c)
    }

    fn note(&mut self, comparison: usize, deviation: f64) {
        let worst = &mut self.worst[comparison];
        *worst = Some(worst.map_or(deviation, |w| w.max(deviation)));
    }
}

/// The result over all postures.
pub struct Agreement {
    /// One per output of the subject.
    pub lines: Vec<Line>,
    /// Evaluations left out since the textbook finds the arm unstable there.
    pub unstable: usize,
    /// Evaluations in which the textbook's numbers are too large for a double.
    pub too_large: usize,
}

/// Compares everything at `count` random postures and wrenches; `done` is told as they are done.
pub fn agreement(
    subject: &Subject<'_>,
    count: usize,
    seed: u64,
    done: &(dyn Fn(usize) + Sync),
) -> Agreement {
    let samples = draw::samples(subject.arm, count, seed);
    let threads = std::thread::available_parallelism().map_or(1, NonZero::get);
    let share = count.div_ceil(threads).max(1);
    let parts: Vec<Agreement> = std::thread::scope(|scope| {
        let spawn = |part| scope.spawn(move || over(subject, part, done));
        let running: Vec<_> = samples.chunks(share).map(spawn).collect();
        // A panic in a thread is a defect: it goes on here.
        let join = |thread: std::thread::ScopedJoinHandle<'_, _>| {
            thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        };
        running.into_iter().map(join).collect()
    });
    parts.into_iter().fold(Agreement::none(subject), Agreement::and)
}

impl Agreement {
    fn none(subject: &Subject<'_>) -> Agreement {
        let line = |output: &Output| Line { output: *output, worst: [None; 4] };
        Agreement { lines: subject.outputs.iter().map(line).collect(), unstable: 0, too_large: 0 }
    }

    fn and(mut self, other: Agreement) -> Agreement {
        self.unstable += other.unstable;
        self.too_large += other.too_large;
        for (line, more) in self.lines.iter_mut().zip(other.lines) {
            for (k, worst) in more.worst.into_iter().enumerate() {
                worst.into_iter().for_each(|w| line.note(k, w));
            }
        }
        self
    }
}

/// Samples between two messages of progress.
const MESSAGE: usize = 16;

fn over(subject: &Subject<'_>, samples: &[Sample], done: &(dyn Fn(usize) + Sync)) -> Agreement {
    let mut result = Agreement::none(subject);
    let mut arm = subject.arm.clone();
    for part in samples.chunks(MESSAGE) {
        for sample in part {
            at(subject, &mut arm, sample, &mut result);
        }
        done(part.len());
    }
    result
}

/// `arm` is the subject's, to be changed and changed back.
fn at(subject: &Subject<'_>, arm: &mut Arm, Sample { state, w }: &Sample, result: &mut Agreement) {
    let beyond = subject.beyond.as_ref();
    let dual = beyond.is_none().then(|| dual::Derivatives::at(arm, &state[..arm.dof()], w));
    for line in &mut result.lines {
        let output = line.output;
        let q = &state[..output.state(arm.dof())];
        let textbook = match beyond {
            Some(beyond) => (beyond.evaluate)(output, q, w),
            None => arm.evaluate(output, q, w).map(Some),
        };
        let Ok(textbook) = textbook else {
            result.unstable += 1;
            continue;
        };
        let is_too_large = |numbers: &Vec<f64>| !numbers.iter().all(|x| x.is_finite());
        result.too_large += usize::from(textbook.as_ref().is_some_and(is_too_large));
        let terms = scale::terms(arm, output, q, w);
        let fine = |a: &[f64], b: &[f64]| scale::deviation(a, b, scale::CANCELLED * terms);
        let generated = (subject.generated)(output, q, w).unwrap_or_default();
        if let Some(textbook) = &textbook {
            line.note(0, fine(&generated, textbook));
        }
        if let (Some(single), Some(textbook)) = (subject.single, &textbook) {
            let got = single(output, q, w).unwrap_or_default();
            let floor = scale::CANCELLED_SINGLE * terms;
            line.note(1, scale::deviation(&got, textbook, floor));
        }
        let slopes = match beyond {
            Some(beyond) => (beyond.slopes)(output, q, w),
            None => differences::of(arm, output, q, w),
        };
        if let Some(slopes) = slopes {
            line.note(2, fine(&generated, &slopes));
        }
        let slopes =
            dual.as_ref().and_then(|dual| dual.of(output).or_else(|| motion::of(arm, output, q)));
        if let Some(slopes) = slopes {
            line.note(3, fine(&generated, &slopes));
        }
    }
}
