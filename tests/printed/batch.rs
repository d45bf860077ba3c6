//! Random arms, what their kernels are asked, and what the textbook answers.

use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use stiffarm::kernels::{Input, Output};
use stiffarm_codegen::robot::Robot;

use crate::boundary::{KINDS, around};
use crate::compare::{CANCELLED, Draws, ForArm, relative, terms};
use crate::tables::{Table, table};

/// Some arms that are printed together.
pub struct Batch {
    pub seed: u64,
    pub cases: Vec<Case>,
}

pub struct Case {
    /// Its name in the text.
    pub name: String,
    pub table: Table,
    pub questions: Vec<Question>,
}

/// A state and a load, and the answers of every output, then of those of the fused function.
pub struct Question {
    pub q: Vec<f64>,
    pub wrench: [f64; 6],
    pub answers: Vec<Answer>,
}

pub enum Answer {
    /// Numbers; a deviation is relative to the largest, or to the floor.
    Numbers { output: Output, values: Vec<f64>, floor: f64 },
    /// There is no equilibrium.
    Refused(Output),
    /// There is one, so near to none that its numbers are not known.
    Borne(Output),
    /// Not looked at: so near to the boundary of another output.
    Open,
}

impl Case {
    /// All questions, a line each: the bits of state and load.
    pub fn input(&self) -> String {
        let line = |question: &Question| {
            let numbers = question.q.iter().chain(&question.wrench);
            numbers.map(|x| format!("{:x} ", x.to_bits())).collect::<String>() + "\n"
        };
        self.questions.iter().map(line).collect()
    }
}

/// Sums of some hundred roundings, among them the sines and cosines of a path of sixteen joints.
const TOLERANCE: f64 = 1e-11;

impl Answer {
    /// Compares with a line of a program: 0 and the numbers' bits, or another status.
    pub fn compare(&self, line: &str) -> Result<(), String> {
        let (status, bits) = line.split_once(' ').unwrap_or((line, ""));
        let (output, refused) = match self {
            Answer::Open => return Ok(()),
            Answer::Numbers { output, .. } | Answer::Borne(output) => (output, false),
            Answer::Refused(output) => (output, true),
        };
        if (status != "0") != refused {
            return Err(format!("{} is refused: {}", output.name(), !refused));
        }
        let Answer::Numbers { values, floor, .. } = self else { return Ok(()) };
        let read = |word| u64::from_str_radix(word, 16).map(f64::from_bits);
        let got: Result<Vec<f64>, _> = bits.split_whitespace().map(read).collect();
        let got = got.map_err(|error| format!("{}: {error} in `{line}`", output.name()))?;
        if got.len() != values.len() || got.iter().any(|x| !x.is_finite()) {
            return Err(format!("{}: {got:?} for {values:?}", output.name()));
        }
        let worst = relative(&got, values, *floor);
        match worst <= TOLERANCE {
            true => Ok(()),
            false => Err(format!("{} is off by {worst:e}: {got:?} {values:?}", output.name())),
        }
    }
}

/// How C is optimised: the six of every run are not, which compiles in a fifth of the time.
pub fn level(seed: u64) -> &'static str {
    if seed == 0 { "-O0" } else { "-O1" }
}

/// Every output of an arm, then those of the fused function.
fn outputs(robot: &Robot) -> Vec<Output> {
    robot.generated().into_iter().chain(Output::ALL).collect()
}

impl Batch {
    /// An arm for each of these numbers of joints.
    pub fn new(seed: u64, joints: &[usize]) -> Self {
        let mut bytes = [0; 32];
        bytes[..8].copy_from_slice(&seed.to_le_bytes());
        let random = TestRng::from_seed(RngAlgorithm::ChaCha, &bytes);
        let mut runner = TestRunner::new_with_rng(Config::default(), random);
        let cases = joints.iter().enumerate().map(|(k, joints)| {
            let rows = *joints..=*joints;
            let table = table(rows).new_tree(&mut runner).expect("nothing is filtered").current();
            let questions = questions(&table, seed ^ (k as u64) << 32);
            Case { name: format!("arm_{k}"), table, questions }
        });
        Batch { seed, cases: cases.collect() }
    }
}

fn questions(table: &Table, seed: u64) -> Vec<Question> {
    let (arm, outputs) = (&table.arm(), outputs(&table.robot()));
    let mut draws = Draws::new(seed);
    let mut questions = Vec::new();
    for k in 0..4 {
        let q = if k == 0 { vec![0.0; 3 * arm.dof()] } else { draws.state(arm) };
        let wrench = draws.wrench(arm);
        let answer = |output: &Output| {
            let (output, state) = (*output, &q[..output.state(arm.dof())]);
            match arm.evaluate(output, state, &wrench) {
                Ok(values) => {
                    let floor = CANCELLED * terms(arm, output, state, &wrench);
                    Answer::Numbers { output, values, floor }
                }
                // A mass matrix that is singular but for rounding may be told either way.
                Err(_) if output.takes(Input::Torques) => Answer::Open,
                Err(_) => Answer::Refused(output),
            }
        };
        let answers = outputs.iter().map(answer).collect();
        questions.push(Question { q, wrench, answers });
    }
    for kind in KINDS {
        let (q, direction) = (draws.state(arm), kind.direction(&mut draws));
        for output in [Output::Deflection, Output::DeflectionWithGravity] {
            let loads = around(arm, output, &q[..arm.dof()], &direction, f64::EPSILON);
            let sides: [fn(Output) -> Answer; 2] = [Answer::Borne, Answer::Refused];
            for (wrench, side) in loads.into_iter().flatten().zip(sides) {
                let answer =
                    |asked: &Output| if *asked == output { side(*asked) } else { Answer::Open };
                // The fused function is refused with its deflection.
                let answers = outputs.iter().map(answer).collect();
                questions.push(Question { q: q.clone(), wrench, answers });
            }
        }
    }
    questions
}
