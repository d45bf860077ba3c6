//! A function: formulas, laid out in the frame of the chain in which they cost least.

use super::formulas::Formulas;
use super::mistake::Refused;
use crate::derive::{
    Block, Held, Own, OwnInput, Passes, Program, Quantity, Readings, Way, cheapest,
};
use crate::expr::{OpCount, Symbol};
use crate::robot::Robot;
use crate::term::Mistake;

/// A function of one's own: several results that share what they have in common.
#[derive(Clone, Debug)]
pub struct Function {
    pub(super) program: Program,
    own: Own,
}

impl Function {
    /// The function `name`, which computes what `sentence` says, as `formulas` writes it down. They are asked several
    /// times, with the arm laid out in one frame of its chain after the other, and must write the same each time;
    /// the cheapest is kept.
    ///
    /// # Errors
    /// [`Refused`] with every mistake in the formulas, at its line: a name that cannot be one, a number that is not
    /// finite, a division by zero, a derivative by what is no variable, no result.
    pub fn new(
        robot: &Robot,
        name: &str,
        sentence: &str,
        formulas: impl Fn(&Formulas<'_>),
    ) -> Result<Self, Refused> {
        let laid_out = |way: Way| {
            let written = Formulas::new(way.lay_out(robot));
            formulas(&written);
            Self::of(written, way, (name, sentence), robot)
        };
        let refused = |mistakes| Refused { function: name.to_owned(), mistakes };
        let first = laid_out(Way::PLAIN).map_err(refused)?;
        let cost = |way| laid_out(way).map_or(u32::MAX, |function| function.ops().cost());
        let ways = cheapest(robot, 1, Passes::ALL, |way| vec![cost(way)]);
        let found = ways.first().map(|way| [*way, way.by_bodies()]);
        let best = found.and_then(|ways| ways.into_iter().min_by_key(|way| cost(*way)));
        Ok(best.and_then(|way| laid_out(way).ok()).unwrap_or(first))
    }

    fn of(
        written: Formulas,
        way: Way,
        (name, sentence): (&str, &str),
        robot: &Robot,
    ) -> Result<Self, Vec<Mistake>> {
        let (inputs, results) = (written.inputs.into_inner(), written.results.into_inner());
        let graph = written.sheet.graph.into_inner();
        let mut mistakes = written.sheet.mistakes.into_inner();
        let own =
            Own { name: name.to_owned(), sentence: sentence.to_owned(), inputs, finite: false };
        names(&own, results.iter().map(|(quantity, _)| quantity), &mut mistakes);
        let blocks = results.into_iter();
        let blocks = blocks.map(|(quantity, entries)| Block { held: Held::Own(quantity), entries });
        let program = Program {
            graph,
            blocks: blocks.collect(),
            solves: Vec::new(),
            cut: way.cut(),
            dof: robot.dof(),
            readings: Readings::of(robot),
            own: Some(own.clone()),
        };
        if mistakes.is_empty() { Ok(Function { program, own }) } else { Err(mistakes) }
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.own.name
    }

    /// Its inputs beside the joint values.
    pub fn inputs(&self) -> &[OwnInput] {
        &self.own.inputs
    }

    /// What it returns.
    pub fn results(&self) -> impl Iterator<Item = &Quantity> {
        self.program.blocks.iter().filter_map(|block| match &block.held {
            Held::Own(quantity) => Some(quantity),
            Held::Output(_) => None,
        })
    }

    /// Operations of all results together.
    pub fn ops(&self) -> OpCount {
        self.program.ops()
    }

    /// The frame in which it is worked out, in words.
    pub fn frame(&self) -> String {
        self.program.frame()
    }

    /// The value of each result, column by column, by evaluation of the graph, which shares nothing with the printed
    /// text. Of each of its own inputs as many numbers as it has; `given` tells what the arm's are: rates, wrench,
    /// parameters. An entry that is missing is NaN.
    pub fn evaluate(
        &self,
        q: &[f64],
        inputs: &[&[f64]],
        given: impl Fn(&Symbol) -> f64,
    ) -> Vec<Vec<f64>> {
        let value = |symbol: &Symbol| match symbol {
            Symbol::Joint(joint) => q.get(*joint).copied().unwrap_or(f64::NAN),
            Symbol::Own { input, entry } => {
                inputs.get(*input).and_then(|input| input.get(*entry)).copied().unwrap_or(f64::NAN)
            }
            symbol => given(symbol),
        };
        let blocks = self.program.blocks.iter();
        blocks.map(|block| self.program.graph.evaluate(&block.entries, value)).collect()
    }
}

/// Checks that every name can stand in Rust and in C, and means nothing else there.
fn names<'a>(
    own: &'a Own,
    results: impl Iterator<Item = &'a Quantity> + Clone,
    mistakes: &mut Vec<Mistake>,
) {
    let mut wrong = |text: String| mistakes.push(Mistake { at: None, text });
    if results.clone().next().is_none() {
        wrong("found no result, expected one at least".to_owned());
    }
    let of_results: Vec<&str> = results.map(|quantity| quantity.name.as_str()).collect();
    let of_inputs: Vec<&str> = own.inputs.iter().map(|input| input.name.as_str()).collect();
    for (what, names) in
        [("function", &[own.name.as_str()][..]), ("input", &of_inputs), ("result", &of_results)]
    {
        for (k, name) in names.iter().enumerate() {
            if let Some(why) = refused(name) {
                wrong(format!("found the {what} name `{name}`, {why}"));
            }
            if names[..k].contains(name) {
                wrong(format!("found two {what}s called `{name}`, expected a name for each"));
            }
        }
    }
}

/// Names that the generated text gives to other things.
const TAKEN: [&str; 24] = [
    "all",
    "angles",
    "arm",
    "constants",
    "cosines",
    "double",
    "fx",
    "fy",
    "fz",
    "given",
    "int",
    "live",
    "long",
    "mx",
    "my",
    "mz",
    "out",
    "own",
    "posture",
    "q",
    "sines",
    "status",
    "wrench",
    "zero",
];

/// Why a name cannot be one.
fn refused(name: &str) -> Option<&'static str> {
    let letters = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    let plain = name.starts_with(|c: char| c.is_ascii_lowercase()) && name.chars().all(letters);
    // `s23`, `c4`, `q2`, `dq3`, `sa1`: sines, cosines, joint values and what they are worked out from.
    let stem = name.split(|c: char| c.is_ascii_digit()).next().unwrap_or_default();
    let of_arm =
        stem.len() < name.len() && ["s", "c", "q", "dq", "dqg", "sa", "ca"].contains(&stem);
    if !plain {
        Some("expected lower-case letters, digits and `_`, a letter first")
    } else if of_arm || TAKEN.contains(&name) {
        Some("which the generated text gives to something else: expected another one")
    } else if crate::robot::is_keyword(name)
        || ["char", "float", "short", "signed", "switch", "void"].contains(&name)
    {
        Some("a keyword: expected another one")
    } else {
        None
    }
}
