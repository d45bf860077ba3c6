//! The printer of Python: a module of functions on NumPy's arrays, whose leading axes are batches.

#[path = "numpy/as_it_is.rs"]
mod as_it_is;

use stiffarm_kernels::Form;

use super::asked;
use super::cells::world;
use super::docs::{ALL_ZERO, docs, inputs};
use super::hash::provenance;
use super::legend::legend;
use super::lines::{Lines, WIDTH};
use super::literal::constant;
use crate::derive::{Held, Program, Size};
use crate::ir::{Angle, Function, Module, Operation, Plain, Solve, Statement, Style, Term};
use crate::number::Number;
use crate::robot::Robot;

/// The kernels of a robot as a module of Python that needs NumPy alone. The same table always gives the same bytes.
pub fn python(robot: &Robot) -> String {
    python_with(robot, &[])
}

/// The same with functions of one's own.
pub(crate) fn python_with(robot: &Robot, own: &[&Program]) -> String {
    let module = Module::new(robot, own, false);
    let mut out = Lines::default();
    head(&module, &mut out);
    if module.is_symbolic() {
        constants(&module, &mut out);
    }
    if module.readings.moves {
        joints(&module, &mut out);
    }
    for of in module.functions() {
        Printer { of, module: &module, at_joints: false }.function(&mut out);
    }
    as_it_is::functions(&module, &mut out);
    out.finish()
}

/// How Python spells terms; `constants` stands before a field of the constants.
struct Python {
    constants: &'static str,
}

const IN_FUNCTION: Python = Python { constants: "constants." };

/// Names of a table or of one's own functions that mean something else in the text.
const TAKEN: [&str; 25] = [
    "False", "None", "True", "and", "assert", "batch", "class", "def", "del", "elif", "except",
    "finally", "from", "global", "import", "is", "joints", "lambda", "nonlocal", "not", "np", "or",
    "pass", "raise", "with",
];

/// A name that is none of these.
fn name(name: &str) -> String {
    if TAKEN.contains(&name) { format!("{name}_") } else { name.to_owned() }
}

impl Style for Python {
    fn number(&self, n: Number) -> String {
        let text = constant(n);
        if text.contains('/') || text.starts_with('-') { format!("({text})") } else { text }
    }
    fn local(&self, local: &str) -> String {
        name(local)
    }
    fn constant(&self, field: &str) -> String {
        format!("{}{}", self.constants, name(field))
    }
    fn entry(&self, array: &str, at: &[usize]) -> String {
        let at: Vec<String> = at.iter().map(usize::to_string).collect();
        format!("{array}[..., {}]", at.join(", "))
    }
    fn of(&self, operation: Operation, numbers: &[String]) -> String {
        let a = &numbers[0];
        match operation {
            Operation::Reciprocal => format!("(1.0 / ({a}))"),
            Operation::Root => format!("np.sqrt({a})"),
            Operation::Sign => format!("np.sign({a})"),
            Operation::Sine => format!("np.sin({a})"),
            Operation::Cosine => format!("np.cos({a})"),
            Operation::Atan2 => format!("np.arctan2(({a}) + 0.0, {})", numbers[1]),
            Operation::Select => format!("np.where(({a}) > 0.0, {}, {})", numbers[1], numbers[2]),
        }
    }
}

/// An assignment; too long a one continues within brackets.
fn assign(out: &mut Lines, to: &str, value: &str) {
    let line = format!("{to} = {value}");
    if 4 * out.depth + line.chars().count() > WIDTH {
        out.code(&format!("{to} = ({value})"));
    } else {
        out.code(&line);
    }
}

/// Text that may stand between the quotation marks of a docstring.
fn quoted(text: &str) -> String {
    let visible = |c: char| if c.is_control() { ' ' } else { c };
    text.chars().map(visible).collect::<String>().replace('\\', "/").replace('"', "'")
}

fn docstring(out: &mut Lines, paragraphs: &[String]) {
    let start = out.text.len();
    for (k, paragraph) in paragraphs.iter().enumerate() {
        if k > 0 {
            out.blank();
        }
        out.wrapped(&quoted(paragraph), "");
    }
    let at = start + 4 * out.depth;
    out.text.insert_str(at, "\"\"\"");
    if paragraphs.len() > 1 {
        out.code("\"\"\"");
    } else {
        out.text.truncate(out.text.trim_end().len());
        out.text.push_str("\"\"\"\n");
    }
}

fn head(module: &Module, out: &mut Lines) {
    let robot = module.robot;
    let unstable = module.functions().any(Function::fallible).then(|| {
        "Where a load leaves no stable equilibrium, or a joint moves no mass, what depends on it is nan.".to_owned()
    });
    let readings = module.readings.moves.then(|| {
        "The functions take readings; joints() tells the joint values that they mean, to which columns and torques belong."
            .to_owned()
    });
    let paragraphs: Vec<String> = [
        format!("{}: closed-form kernels for NumPy. {}", robot.name, provenance(robot)),
        format!(
            "Not to be edited: stiffarm generate ROBOT --emit python{} --check FILE compares it with the table.",
            asked(robot)
        ),
        "Every function takes arrays of doubles whose last axis is named below, and gives arrays with rows and columns \
         last. Leading axes are batches and broadcast."
            .to_owned(),
    ]
    .into_iter()
    .chain(world(robot))
    .chain(readings)
    .chain(unstable)
    .chain([legend(module)])
    .collect();
    docstring(out, &paragraphs);
    out.blank();
    out.code("import numpy as np");
    out.blank();
    out.code(&format!("NAME = \"{}\"", quoted(&robot.name)));
    out.code(&format!("N = {}", robot.dof()));
    out.verbatim(GIVEN);
    if module.functions().any(|function| function.solves().next().is_some()) {
        out.verbatim(SOLVE);
    }
}

/// Checks shapes, and the shape of what is given to one function together.
const GIVEN: &str = include_str!("numpy/given.py");

/// The kernels' solve, over a batch.
const SOLVE: &str = include_str!("numpy/solve.py");

/// The class of what the functions need of the symbolic parameters.
fn constants(module: &Module, out: &mut Lines) {
    let symbols = module.robot.symbols();
    out.verbatim("\n\n");
    out.code("class Constants:");
    out.indent();
    let said = symbols.iter().map(|s| format!("{}: {}", name(&s.name), s.dimension.unit()));
    let said = said.collect::<Vec<_>>().join("; ");
    docstring(
        out,
        &[format!("What the functions need of the table's symbolic parameters. {said}.")],
    );
    out.blank();
    let names: Vec<String> = symbols.iter().map(|symbol| name(&symbol.name)).collect();
    out.code(&format!("def __init__(self, *, {}):", names.join(", ")));
    out.indent();
    for field in module.constants.fields() {
        let value = field.value.print(&Python { constants: "" });
        assign(out, &format!("self.{}", name(&field.name)), &value);
    }
    out.dedent();
    out.dedent();
}

/// The parameters for what is given of the arm's state: readings, and what is given beside them.
fn of_state(module: &Module) -> Vec<(String, Option<usize>)> {
    let n = module.robot.dof();
    let extras = module.readings.extras.iter().map(|extra| match extra {
        crate::ir::Extra::Sides => ("sides".to_owned(), Some(n)),
        crate::ir::Extra::Warming => ("warming".to_owned(), None),
    });
    core::iter::once(("q".to_owned(), Some(n))).chain(extras).collect()
}

fn parameters(given: &[(String, Option<usize>)]) -> String {
    given.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>().join(", ")
}

/// The inputs as arrays of doubles, and `batch`.
fn check(out: &mut Lines, given: &[(String, Option<usize>)]) {
    let pairs = given.iter().map(|(name, size)| format!("{name}=({name}, {})", size.unwrap_or(0)));
    let pairs = pairs.collect::<Vec<_>>().join(", ");
    assign(out, &format!("{}, batch", parameters(given)), &format!("_given({pairs})"));
}

fn sines(out: &mut Lines, angles: &[Angle], style: &Python) {
    for angle in angles {
        let sum = angle.sum.print(style);
        for (name, function) in angle.names().into_iter().zip(["np.sin", "np.cos"]) {
            if let Some(name) = name {
                assign(out, &name, &format!("{function}({sum})"));
            }
        }
    }
}

/// The function from readings to joint values.
fn joints(module: &Module, out: &mut Lines) {
    let given = of_state(module);
    out.verbatim("\n\n");
    out.code(&format!("def joints({}):", parameters(&given)));
    out.indent();
    docstring(
        out,
        &["The joint values that readings mean, base to tip, in rad (prismatic joint: m)."
            .to_owned()],
    );
    check(out, &given);
    sines(out, &module.readings.angles, &IN_FUNCTION);
    out.code(&format!("out = np.empty((*batch, {}))", module.robot.dof()));
    for (joint, value) in module.readings.joints.iter().enumerate() {
        assign(out, &format!("out[..., {joint}]"), &value.print(&IN_FUNCTION));
    }
    out.code("return out");
    out.dedent();
}

/// How the array of a result is shaped.
struct Shape {
    sizes: Vec<usize>,
    /// Rows of entries, of each matrix.
    rows: usize,
    /// Of a pose, whose last row is 0, 0, 0, 1.
    homogeneous: bool,
}

impl Shape {
    fn of(held: &Held, n: usize) -> Shape {
        let (rows, columns) = held.shape(n);
        let (sizes, homogeneous) = match held {
            Held::Output(output) => match output.form() {
                Form::Pose => (vec![4, 4], true),
                Form::Poses => (vec![n, 4, 4], true),
                Form::Vector => (vec![rows], false),
                Form::Matrix => (vec![rows, columns], false),
                Form::Stack => (vec![n, rows, output.columns().each().count(n)], false),
            },
            Held::Own(quantity) => match quantity.size {
                Size::Scalar => (Vec::new(), false),
                Size::Vector(rows) => (vec![rows], false),
                Size::Matrix { .. } => (vec![rows, columns], false),
            },
        };
        Shape { sizes, rows, homogeneous }
    }

    /// The indices of a column-major entry.
    fn index(&self, entry: usize) -> String {
        let (row, column) = (entry % self.rows, entry / self.rows);
        match self.sizes[..] {
            [] => "...".to_owned(),
            [_] => format!("..., {entry}"),
            [_, _] => format!("..., {row}, {column}"),
            [.., each] => format!("..., {}, {row}, {}", column / each, column % each),
        }
    }
}

/// Prints one function.
struct Printer<'a> {
    of: &'a Function,
    module: &'a Module<'a>,
    /// Whether it takes joint values, not readings, and is for this module alone.
    at_joints: bool,
}

impl Printer<'_> {
    fn function(&self, out: &mut Lines) {
        let mut given = of_state(self.module);
        given.extend(self.of.arguments.iter().map(|a| (name(&a.name), a.size)));
        let first = if self.module.is_symbolic() { "constants, " } else { "" };
        out.verbatim("\n\n");
        let name = match self.at_joints {
            true => format!("_{}_at", self.of.full_name()),
            false => self.of.full_name(),
        };
        out.code(&format!("def {name}({first}{}):", parameters(&given)));
        out.indent();
        match self.at_joints {
            true => docstring(out, &["The same at joint values, not at readings.".to_owned()]),
            false => docstring(out, &self.docs()),
        }
        check(out, &given);
        self.inputs(out);
        for block in self.of.blocks() {
            let Shape { sizes, homogeneous, .. } = Shape::of(&block.held, self.of.program.dof);
            let array = self.array(&block.held);
            let sizes: Vec<String> = sizes.iter().map(usize::to_string).collect();
            out.code(&format!("{array} = np.zeros([*batch, {}])", sizes.join(", ")));
            if homogeneous {
                out.code(&format!("{array}[..., 3, 3] = 1.0"));
            }
        }
        self.of.body.iter().for_each(|step| self.statement(out, step));
        match self.of.blocks() {
            [_] => out.code("return out"),
            blocks => {
                let each = blocks.iter().map(|b| format!("\"{0}\": out_{0}", b.held.name()));
                out.code(&format!("return {{{}}}", each.collect::<Vec<_>>().join(", ")));
            }
        }
        out.dedent();
    }

    fn array(&self, held: &Held) -> String {
        match self.of.blocks() {
            [_] => "out".to_owned(),
            _ => format!("out_{}", held.name()),
        }
    }

    fn docs(&self) -> Vec<String> {
        let n = self.of.program.dof;
        let own = self.of.own().map(|own| format!("{}.", own.sentence.trim_end_matches('.')));
        let mut said: Vec<String> = own.into_iter().collect();
        match self.of.blocks() {
            [block] => said.extend(docs(&block.held, n, "")),
            blocks => said.extend(blocks.iter().map(|block| {
                format!("{}: {}", block.held.name(), docs(&block.held, n, "")[..2].join(" "))
            })),
        }
        if self.of.blocks().iter().any(|block| Shape::of(&block.held, n).homogeneous) {
            said.push("Of a pose the last row, 0, 0, 0, 1, stands in the array, too.".to_owned());
        }
        if let Some(place) = &self.of.place {
            said.push(format!("What is said of the tool here is of {place}: the tool is there."));
        }
        let given = inputs(self.of.program.inputs(), self.of.own());
        let extras = self.module.readings.extras.iter();
        let extras: String = extras.map(|e| format!(" {}: {}.", e.name(), e.sentence())).collect();
        said.push(format!("{}{extras}", given.replace('`', "")));
        said.push(format!("Worked out in {}.", self.of.program.frame()));
        said.extend(self.of.is_zero().then(|| ALL_ZERO.to_owned()));
        said
    }

    /// What the function reads of its arguments, by name.
    fn inputs(&self, out: &mut Lines) {
        let readings = &self.module.readings;
        let posture = &self.of.posture;
        if readings.moves && !self.at_joints && posture.reads_joints() {
            out.code(&format!("q = joints(q{})", readings.handed_on()));
        }
        sines(out, &self.of.angles, &IN_FUNCTION);
        for plain in &self.of.plain {
            let from = if *plain == Plain::Growth { &readings.growth } else { &plain.source() };
            out.code(&format!("{} = {}", plain.field(), from.print(&IN_FUNCTION)));
        }
        for argument in self.of.arguments.iter().filter(|argument| argument.size.is_some()) {
            let entries = argument.entries.iter().zip(&argument.read).enumerate();
            for (k, (entry, _)) in entries.filter(|(_, (_, read))| **read) {
                out.code(&format!("{} = {}[..., {k}]", name(entry), name(&argument.name)));
            }
        }
    }

    fn statement(&self, out: &mut Lines, step: &Statement) {
        match step {
            Statement::Let(to, value) => assign(out, &name(to), &value.print(&IN_FUNCTION)),
            Statement::Store { block, entry, value } => {
                let held = &self.of.blocks()[*block].held;
                let index = Shape::of(held, self.of.program.dof).index(*entry);
                let to = format!("{}[{index}]", self.array(held));
                assign(out, &to, &value.print(&IN_FUNCTION));
            }
            Statement::SinCos(angles) => sines(out, angles, &IN_FUNCTION),
            Statement::Solve(solve) => self.solve(out, solve),
        }
    }

    fn solve(&self, out: &mut Lines, Solve { matrix, right, unknowns, leading, .. }: &Solve) {
        let list = |terms: &[Term]| {
            terms.iter().map(|term| term.print(&IN_FUNCTION)).collect::<Vec<_>>().join(", ")
        };
        out.within("matrix = [", "]", |out| {
            matrix.chunks(right.len()).for_each(|column| out.code(&format!("{},", list(column))))
        });
        assign(out, "right", &format!("[{}]", list(right)));
        let names = unknowns.iter().map(|name| name.as_deref().unwrap_or("_"));
        let names = names.collect::<Vec<_>>().join(", ");
        out.code(&format!("[{names}] = _solve(batch, matrix, right, {leading})"));
    }
}
