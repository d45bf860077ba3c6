//! Whether the ways of computing an arm's outputs agree: what was generated from the table, the
//! textbook, differences of the textbook, and dual numbers.

mod differences;
mod draw;
mod dual;
mod scale;

use std::num::NonZero;

use stiffarm_kernels::generic::Arm;
use stiffarm_kernels::{Kernels, Output, Unstable};

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
    /// Derivatives of the forward kinematics by dual numbers.
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

/// An implementation: an output as one column-major block, at joint values, under a wrench.
pub type Evaluate<'a> = dyn Fn(Output, &[f64], &[f64; 6]) -> Result<Vec<f64>, Unstable> + Sync + 'a;

/// What is to be compared.
pub struct Subject<'a> {
    /// The arm as the textbook has it.
    pub arm: &'a Arm,
    /// The generated implementation.
    pub generated: &'a Evaluate<'a>,
    /// The same in single precision, where there is one.
    pub single: Option<&'static (dyn Kernels<f32> + Sync)>,
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
    /// One per output, in the order of [`Output::EACH`].
    pub lines: Vec<Line>,
    /// Evaluations left out since the textbook finds the arm unstable there.
    pub unstable: usize,
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
    parts.into_iter().fold(Agreement::none(), Agreement::and)
}

impl Agreement {
    fn none() -> Agreement {
        let line = |output| Line { output, worst: [None; 4] };
        Agreement { lines: Output::EACH.map(line).to_vec(), unstable: 0 }
    }

    fn and(mut self, other: Agreement) -> Agreement {
        self.unstable += other.unstable;
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
    let mut result = Agreement::none();
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
fn at(subject: &Subject<'_>, arm: &mut Arm, Sample { q, w }: &Sample, result: &mut Agreement) {
    let dual = dual::Derivatives::at(arm, q, w);
    for line in &mut result.lines {
        let output = line.output;
        let Ok(textbook) = arm.evaluate(output, q, w) else {
            result.unstable += 1;
            continue;
        };
        let terms = scale::terms(arm, output, q, w);
        let fine = |a: &[f64], b: &[f64]| scale::deviation(a, b, scale::CANCELLED * terms);
        let generated = (subject.generated)(output, q, w).unwrap_or_default();
        line.note(0, fine(&generated, &textbook));
        if let Some(kernels) = subject.single {
            let got = single(kernels, output, q, w).unwrap_or_default();
            let floor = scale::CANCELLED_SINGLE * terms;
            line.note(1, scale::deviation(&got, &textbook, floor));
        }
        if let Some(slopes) = differences::of(arm, output, q, w) {
            line.note(2, fine(&generated, &slopes));
        }
        if let Some(slopes) = dual.of(output) {
            line.note(3, fine(&generated, &slopes));
        }
    }
}

fn single(kernels: &dyn Kernels<f32>, output: Output, q: &[f64], w: &[f64; 6]) -> Option<Vec<f64>> {
    let (rows, columns) = output.shape(kernels.dof());
    let mut out = vec![0.0; rows * columns];
    let q: Vec<f32> = q.iter().map(|x| *x as f32).collect();
    kernels.evaluate(output, &q, &w.map(|x| x as f32), &mut out).ok()?;
    Some(out.into_iter().map(f64::from).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The textbook against itself, but for what `change` does to one of its outputs.
    fn checked(output: Output, change: fn(&mut Vec<f64>)) -> Agreement {
        let file = stiffarm_robots::arm("kuka_kr240").unwrap();
        let (robot, _) = stiffarm_codegen::robot::Robot::from_toml(file.toml, file.id).unwrap();
        let arm = stiffarm_gap::robot::arm(&robot).unwrap();
        let generated = |asked, q: &[f64], w: &[f64; 6]| {
            let mut block = arm.evaluate(asked, q, w)?;
            if asked == output {
                change(&mut block);
            }
            Ok(block)
        };
        let subject = Subject { arm: &arm, generated: &generated, single: None };
        agreement(&subject, 20, 0, &|_| {})
    }

    #[test]
    fn a_small_mistake_is_found_by_every_comparison() {
        let found = checked(Output::Jacobian, |block| block[1] += 1e-6);
        for line in &found.lines {
            let exceeded: Vec<Comparison> = line.exceeded().collect();
            if line.output == Output::Jacobian {
                let each = [Comparison::Textbook, Comparison::Differences, Comparison::Dual];
                assert_eq!(exceeded, each);
            } else {
                assert_eq!(exceeded, [], "{line:?}");
            }
        }
    }

    #[test]
    fn what_cannot_be_compared_does_not_agree() {
        let changes: [fn(&mut Vec<f64>); 2] = [Vec::clear, |block| block[0] = f64::NAN];
        for change in changes {
            let found = checked(Output::Pose, change);
            assert_eq!(found.lines[0].worst[0], Some(f64::INFINITY));
            assert_eq!(found.lines[0].exceeded().count(), 1);
        }
    }
}
