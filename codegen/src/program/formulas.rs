//! What the formulas of one function are written with: its inputs, the arm's geometry, derivatives, results.

use core::cell::{Cell, RefCell};
use core::mem::{swap, take};

use super::entries::Entries;
use super::geometry::{Frame, Point, Vector};
use crate::derive::{
    Chain, Levers, OwnInput, Point as Place, Quantity, ROW, Size, derived, tool_offsets, twists,
};
use crate::expr::{Expr, Node, Symbol, Twist, Vec3};
use crate::robot::Output;
use crate::term::{Sheet, Term, cross, plus};

/// Where a function is written down: see the [module](super). What it returns lives as long as it does.
pub struct Formulas<'r> {
    pub(super) sheet: Sheet,
    /// Its graph is the sheet's while it is asked.
    chain: RefCell<Chain<'r>>,
    pub(super) inputs: RefCell<Vec<OwnInput>>,
    pub(super) results: RefCell<Vec<(Quantity, Vec<Expr>)>>,
    /// Variations declared so far.
    variations: Cell<usize>,
}

/// The number of the input that variations are entries of: no declared one has it.
const VARIATION: usize = usize::MAX;

/// Whether a symbol is a variation.
pub(super) fn is_variation(symbol: &Symbol) -> bool {
    matches!(symbol, Symbol::Own { input: VARIATION, .. })
}

impl<'r> Formulas<'r> {
    pub(super) fn new(mut chain: Chain<'r>) -> Self {
        Formulas {
            sheet: Sheet::new(take(&mut chain.g)),
            chain: RefCell::new(chain),
            inputs: RefCell::default(),
            results: RefCell::default(),
            variations: Cell::new(0),
        }
    }

    fn ask<T>(&self, question: impl FnOnce(&mut Chain<'r>) -> T) -> T {
        let mut chain = self.chain.borrow_mut();
        swap(&mut chain.g, &mut self.sheet.graph.borrow_mut());
        let answer = question(&mut chain);
        swap(&mut chain.g, &mut self.sheet.graph.borrow_mut());
        answer
    }

    fn symbol(&self, symbol: Symbol) -> Term<'_> {
        self.sheet.symbol(symbol)
    }

    fn vector_of(&self, v: Vec3) -> Vector<'_> {
        Vector { v, sheet: &self.sheet }
    }

    /// An input that is one number: its name in the generated code, its unit (`1` if it has none), what it is.
    pub fn scalar(&self, name: &str, unit: &str, sentence: &str) -> Term<'_> {
        self.symbol(self.input(name, unit, sentence, None)(0))
    }

    /// An input of K numbers, `&[S; K]`.
    pub fn vector<const K: usize>(&self, name: &str, unit: &str, sentence: &str) -> [Term<'_>; K] {
        let symbol = self.input(name, unit, sentence, Some(K));
        core::array::from_fn(|entry| self.symbol(symbol(entry)))
    }

    fn input(
        &self,
        name: &str,
        unit: &str,
        sentence: &str,
        size: Option<usize>,
    ) -> impl Fn(usize) -> Symbol {
        let mut inputs = self.inputs.borrow_mut();
        let input = inputs.len();
        let [name, unit, sentence] = [name, unit, sentence].map(str::to_owned);
        inputs.push(OwnInput { name, unit, sentence, size });
        move |entry| Symbol::Own { input, entry }
    }

    /// K quantities that are zero in every result, and only there to differentiate by: how a result changes along a
    /// way of one's choice, such as [`Frame::displaced`].
    pub fn variation<const K: usize>(&self) -> [Term<'_>; K] {
        let first = self.variations.replace(self.variations.get() + K);
        core::array::from_fn(|k| self.symbol(Symbol::Own { input: VARIATION, entry: first + k }))
    }

    /// A constant; the decimal as it is written is taken exactly.
    #[track_caller]
    pub fn number(&self, x: f64) -> Term<'_> {
        self.sheet.number(x)
    }

    /// Constants.
    #[track_caller]
    pub fn numbers<const K: usize>(&self, numbers: [f64; K]) -> [Term<'_>; K] {
        numbers.map(|x| self.sheet.number(x))
    }

    /// The joint values, rad (prismatic joint: m): what to differentiate by.
    pub fn joints(&self) -> Vec<Term<'_>> {
        self.of_joints(Symbol::Joint)
    }

    /// The joints' rates, rad/s (m/s): an input like that of the arm's outputs.
    pub fn rates(&self) -> Vec<Term<'_>> {
        self.of_joints(Symbol::Rate)
    }

    /// The joints' accelerations, rad/s² (m/s²): an input like that of the arm's outputs.
    pub fn accelerations(&self) -> Vec<Term<'_>> {
        self.of_joints(Symbol::Acceleration)
    }

    fn of_joints(&self, symbol: fn(usize) -> Symbol) -> Vec<Term<'_>> {
        let n = self.chain.borrow().dof();
        (0..n).map(|joint| self.symbol(symbol(joint))).collect()
    }

    /// The wrench on the tool, N and N·m, base axes, at the tool's origin: an input like that of the arm's outputs.
    pub fn wrench(&self) -> [Term<'_>; 6] {
        core::array::from_fn(|k| self.symbol(Symbol::Wrench(k)))
    }

    /// A parameter that stays symbolic in the arm's table.
    #[track_caller]
    pub fn parameter(&self, name: &str) -> Term<'_> {
        let known: Vec<String> =
            self.chain.borrow().robot.symbols().into_iter().map(|symbol| symbol.name).collect();
        if !known.iter().any(|parameter| parameter == name) {
            self.sheet.mistake(format!(
                "found no parameter `{name}` in the table, expected one of: {}",
                known.join(", ")
            ));
            return self.sheet.number(0.0);
        }
        self.symbol(Symbol::Parameter(name.to_owned()))
    }

    /// The frame in which poses are told: the base, or the world in which the robot file has it stand.
    pub fn base(&self) -> Frame<'_> {
        let axes = [0, 1, 2].map(|axis| {
            let unit = |k| if k == axis { Expr::ONE } else { Expr::ZERO };
            self.vector_of(self.ask(|chain| chain.in_frame([0, 1, 2].map(unit))))
        });
        let origin = self.at(0, [(Expr::ZERO, [Expr::ZERO; 3]); 3]);
        let frame = Frame { axes, origin, displaced: None };
        let stands = self.ask(|chain| {
            let base = chain.robot.base.translation.clone();
            base.map(|length| -chain.value(&length))
        });
        Frame { origin: frame.point(stands.map(|e| self.sheet.term(e))), ..frame }
    }

    /// Frame `row` of the chain: 0 stands before the first row, n behind the last.
    #[track_caller]
    pub fn frame(&self, row: usize) -> Frame<'_> {
        let n = self.chain.borrow().dof();
        if row > n {
            self.sheet.mistake(format!("found frame {row}, expected one from 0 to {n}"));
            return self.base();
        }
        let axes = self.ask(|chain| chain.axes(ROW * row)).map(|axis| self.vector_of(axis));
        let origin = self.at(ROW * row, [(Expr::ZERO, [Expr::ZERO; 3]); 3]);
        Frame { axes, origin, displaced: None }
    }

    /// The tool's frame.
    pub fn tool(&self) -> Frame<'_> {
        let (end, offsets) = self.ask(|chain| (chain.steps().len(), tool_offsets(chain)));
        let axes = self.chain.borrow().tool_axes().map(|axis| self.vector_of(axis));
        Frame { axes, origin: self.at(end, offsets), displaced: None }
    }

    fn at(&self, boundary: usize, offsets: [(Expr, Vec3); 3]) -> Point<'_> {
        Point { boundary, offsets, beyond: self.vector_of([Expr::ZERO; 3]) }
    }

    /// The vector from one point to another. Only the part of the chain between them enters.
    pub fn lever<'f>(&'f self, from: Point<'f>, to: Point<'f>) -> Vector<'f> {
        if to.boundary < from.boundary {
            return -self.lever(to, from);
        }
        let inwards: Vec<_> =
            from.offsets.iter().rev().map(|(length, axis)| (-*length, *axis)).collect();
        let outer = self.ask(|chain| {
            let levers = Levers::to(chain, to.boundary, &to.offsets, to.beyond.v);
            levers.extended(&mut chain.g, Place::Boundary(from.boundary), &inwards, None)
        });
        self.vector_of(outer) - from.beyond
    }

    /// Coordinates of a point in a frame, m.
    pub fn coordinates<'f>(&'f self, point: Point<'f>, frame: Frame<'f>) -> [Term<'f>; 3] {
        let undisplaced = frame.axes.map(|axis| axis.dot(self.lever(frame.origin, point)));
        match frame.displaced {
            None => undisplaced,
            Some([shift, turn]) => {
                let moved = plus(undisplaced, shift.map(|c| -c));
                plus(moved, cross(moved, turn))
            }
        }
    }

    /// By joint, the velocity of a point of the arm and the angular velocity of the frame that it moves with, per unit
    /// of the joint's rate: the columns of its Jacobian as vectors.
    pub fn twists<'f>(&'f self, point: Point<'f>) -> Vec<[Vector<'f>; 2]> {
        let twists = self.ask(|chain| twists_at(chain, &point));
        twists.into_iter().map(|(v, w)| [self.vector_of(v), self.vector_of(w)]).collect()
    }

    /// An output of the arm, column by column.
    #[track_caller]
    pub fn output(&self, output: Output) -> Vec<Term<'_>> {
        let found = self.ask(|chain| derived(chain, output));
        if found.solve.is_some() {
            self.sheet.mistake(format!(
                "found the output `{}`, which solves a linear system, expected one that does not",
                output.name()
            ));
        }
        found.entries.into_iter().map(|e| self.sheet.term(e)).collect()
    }

    /// `∂term/∂by`, a column for each of `by`, which are inputs, joint values, components of the wrench or
    /// variations. Worked out on the graph, forwards or backwards, whichever is shorter.
    #[track_caller]
    pub fn derivatives<'f>(&'f self, of: &[Term<'f>], by: &[Term<'f>]) -> Vec<Vec<Term<'f>>> {
        let mut g = self.sheet.graph.borrow_mut();
        let mut symbols = Vec::new();
        for (k, term) in by.iter().enumerate() {
            match g.node(term.e) {
                Node::Symbol(s) if !term.e.is_negative() => symbols.push(g.symbol_of(s).clone()),
                _ => {
                    self.sheet.mistake(format!(
                        "found an expression as number {k} (from 0) of what to differentiate by, expected an \
                         input, a joint value or a variation"
                    ));
                    symbols.push(Symbol::Own { input: VARIATION, entry: VARIATION });
                }
            }
        }
        let of: Vec<Expr> = of.iter().map(|term| term.e).collect();
        let columns = g.derivatives(&of, &symbols);
        let terms = |column: Vec<Expr>| column.into_iter().map(|e| self.sheet.term(e)).collect();
        columns.into_iter().map(terms).collect()
    }

    /// `∂term/∂by` of one expression.
    #[track_caller]
    pub fn gradient<'f>(&'f self, of: Term<'f>, by: &[Term<'f>]) -> Vec<Term<'f>> {
        self.derivatives(&[of], by).into_iter().flatten().collect()
    }

    /// Something that the function returns: its name in the generated code, its unit, what it is, its value: a term, an
    /// array of them, or columns. All results of a function share what they have in common.
    #[track_caller]
    pub fn result<'f>(
        &'f self,
        name: &str,
        unit: &str,
        sentence: &str,
        value: impl Into<Entries<'f>>,
    ) {
        let Entries { size, terms } = value.into();
        if size.is_none_or(|size| size.count() == 0) {
            self.sheet.mistake(format!(
                "found a result `{name}` without entries, or columns of different lengths, expected a rectangle"
            ));
        }
        let entries: Vec<Expr> = terms.into_iter().map(|term| term.e).collect();
        let Some(entries) = self.sheet.graph.borrow_mut().at_zero(&entries, is_variation) else {
            return self.sheet.mistake(format!(
                "found that the result `{name}` has no value where the variations are zero"
            ));
        };
        let [name, unit, sentence] = [name, unit, sentence].map(str::to_owned);
        let size = size.unwrap_or(Size::Scalar);
        self.results.borrow_mut().push((Quantity { name, unit, sentence, size }, entries));
    }
}

/// Twists of a point that moves with a frame of the chain.
fn twists_at(chain: &mut Chain, point: &Point) -> Vec<Twist> {
    let tool = (chain.steps().len(), tool_offsets(chain), [Expr::ZERO; 3]);
    if (point.boundary, point.offsets, point.beyond.v) == tool {
        return twists(chain);
    }
    let levers = Levers::to(chain, point.boundary, &point.offsets, point.beyond.v);
    let twist = |chain: &mut Chain, joint: usize| {
        let step = chain.joint_step(joint);
        if step >= point.boundary {
            return Twist::default();
        }
        let (z, turns) = (chain.joint_axis(joint), chain.revolute(joint));
        levers.twist(&mut chain.g, Place::Step(step), z, turns)
    };
    (0..chain.dof()).map(|joint| twist(chain, joint)).collect()
}
