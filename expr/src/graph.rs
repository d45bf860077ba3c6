//! The arena: nodes are stored once, handles carry a sign.

use rustc_hash::FxHashMap;
use stiffarm_kernels::Input;

use stiffarm_table::number::Number;

/// A handle to a node, with a sign: negation costs nothing and is never a node of its own.
/// The default is the structural zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Expr(u32);

impl Expr {
    /// The structural zero; node 0 of every graph.
    pub const ZERO: Expr = Expr(0);
    /// One; node 1 of every graph.
    pub const ONE: Expr = Expr(2);

    pub(super) fn new(node: usize, negative: bool) -> Expr {
        Expr((node as u32) << 1 | u32::from(negative))
    }

    /// The handle of a node, unsigned.
    pub fn of_node(node: usize) -> Expr {
        Expr::new(node, false)
    }

    /// Index of the node in the arena.
    pub fn node(self) -> usize {
        (self.0 >> 1) as usize
    }

    /// Whether the handle negates its node.
    pub fn is_negative(self) -> bool {
        self.0 & 1 == 1
    }

    /// The same node without the sign.
    pub fn abs(self) -> Expr {
        Expr(self.0 & !1)
    }

    /// Whether the expression is structurally zero.
    pub fn is_zero(self) -> bool {
        self == Expr::ZERO
    }

    /// `-self` if `negative`, else `self`. Zero has no sign.
    pub fn signed(self, negative: bool) -> Expr {
        if self.is_zero() { self } else { Expr(self.0 ^ u32::from(negative)) }
    }
}

impl core::ops::Neg for Expr {
    type Output = Expr;
    fn neg(self) -> Expr {
        self.signed(true)
    }
}

/// What a symbol stands for.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Symbol {
    /// `q_i`, rad or m; joints count from 0 here.
    Joint(usize),
    /// `q̇_i`, rad/s or m/s.
    Rate(usize),
    /// `q̈_i`, rad/s² or m/s².
    Acceleration(usize),
    /// The torque of motor i, N·m or N.
    Torque(usize),
    /// Component 0..6 of the wrench.
    Wrench(usize),
    /// From which side joint i came to rest: −1, 0, 1; joints count from 0 here.
    Side(usize),
    /// How much warmer the arm is than when it is as its table says, K.
    Warming,
    /// What all lengths are of those of the table.
    Growth,
    /// A parameter of the table that stays symbolic.
    Parameter(String),
    /// A component of the displacement at a place of the flexible chain.
    Displacement {
        /// 0 is the base, i stands behind row i, n + 1 behind the tool.
        place: usize,
        /// 0..6: `δx δy δz`, m, and the turns `dψ dβ dφ` about x, y, z, rad.
        component: usize,
    },
    /// An unknown of the linear system of the forward dynamics: the acceleration of a joint, from 0.
    Response(usize),
    /// An unknown of a deflection's linear system.
    Deflection {
        /// The joint, from 0.
        joint: usize,
        /// Whether the links' weights are part of the load.
        weights: bool,
    },
    /// An entry of an input that a program of one's own declares.
    Own {
        /// Which input, in the order of declaration.
        input: usize,
        /// Which of its entries.
        entry: usize,
    },
}

impl Symbol {
    /// Which number of which input it is, if it is one.
    pub fn input(&self) -> Option<(Input, usize)> {
        match self {
            Symbol::Joint(k) => Some((Input::Joints, *k)),
            Symbol::Rate(k) => Some((Input::Rates, *k)),
            Symbol::Acceleration(k) => Some((Input::Accelerations, *k)),
            Symbol::Torque(k) => Some((Input::Torques, *k)),
            Symbol::Wrench(k) => Some((Input::Wrench, *k)),
            Symbol::Parameter(_)
            | Symbol::Displacement { .. }
            | Symbol::Deflection { .. }
            | Symbol::Response(_)
            | Symbol::Side(_)
            | Symbol::Warming
            | Symbol::Growth
            | Symbol::Own { .. } => None,
        }
    }
}

/// A node of the graph. Operands are handles of earlier nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// A constant, never negative (the handle carries the sign).
    Number(Number),
    /// Index into the graph's symbols.
    Symbol(u32),
    /// `a + b` or `a - b`: `a` unsigned and first in canonical order (constants, then older nodes).
    Add(Expr, Expr),
    /// `a · b`, both unsigned, `a` first in canonical order.
    Mul(Expr, Expr),
    /// `1/a`.
    Recip(Expr),
    /// `√a`.
    Sqrt(Expr),
    /// 1, 0 or −1 as `a`, unsigned, is above, at or below zero.
    Sign(Expr),
    /// `sin a`, `a` unsigned.
    Sin(Expr),
    /// `cos a`, `a` unsigned.
    Cos(Expr),
    /// The angle of the direction (x, y), −π to π, 0 where both are zero; y first, both unsigned.
    Atan2(Expr, Expr),
    /// The second where the first is above zero, else the third.
    Select(Expr, Expr, Expr),
}

impl Node {
    /// The operands, if any.
    pub fn operands(self) -> impl DoubleEndedIterator<Item = Expr> {
        let all = match self {
            Node::Number(_) | Node::Symbol(_) => [None; 3],
            Node::Recip(a) | Node::Sqrt(a) | Node::Sign(a) | Node::Sin(a) | Node::Cos(a) => {
                [Some(a), None, None]
            }
            Node::Add(a, b) | Node::Mul(a, b) | Node::Atan2(a, b) => [Some(a), Some(b), None],
            Node::Select(a, b, c) => [a, b, c].map(Some),
        };
        all.into_iter().flatten()
    }
}

/// The arena. Expressions are made by the constructors in `fold`, which keep every node canonical.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    nodes: Vec<Node>,
    index: FxHashMap<Node, u32>,
    symbols: Vec<Symbol>,
    names: FxHashMap<usize, String>,
}

impl Graph {
    /// A graph that holds 0 and 1.
    pub fn new() -> Self {
        let mut graph = Graph::default();
        graph.intern(Node::Number(Number::ZERO));
        graph.intern(Node::Number(Number::ONE));
        graph
    }

    /// All nodes, operands before their uses.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// The node behind a handle.
    pub fn node(&self, e: Expr) -> Node {
        self.nodes[e.node()]
    }

    /// What symbol number `index` of a [`Node::Symbol`] stands for.
    pub fn symbol_of(&self, index: u32) -> &Symbol {
        &self.symbols[index as usize]
    }

    /// The symbol that a node is, if it is one.
    pub fn symbol_at(&self, node: usize) -> Option<&Symbol> {
        match self.nodes[node] {
            Node::Symbol(index) => Some(self.symbol_of(index)),
            _ => None,
        }
    }

    /// The expression of a symbol.
    pub fn symbol(&mut self, symbol: Symbol) -> Expr {
        let known = self.symbols.iter().position(|s| *s == symbol);
        let index = known.unwrap_or_else(|| {
            self.symbols.push(symbol);
            self.symbols.len() - 1
        });
        self.intern(Node::Symbol(index as u32))
    }

    /// The value of a constant, sign included.
    pub fn number_of(&self, e: Expr) -> Option<Number> {
        match self.node(e) {
            Node::Number(n) => Some(if e.is_negative() { -n } else { n }),
            _ => None,
        }
    }

    /// Gives a computed node a name of the field's notation (`z3x`, `kc_31`). The first name stays; a
    /// leaf, and a node that is the negative of what the name means, get none.
    pub fn name(&mut self, e: Expr, name: impl FnOnce() -> String) {
        let leaf = matches!(self.node(e), Node::Number(_) | Node::Symbol(_));
        if !leaf && !e.is_negative() {
            self.names.entry(e.node()).or_insert_with(name);
        }
    }

    /// The name given to a node.
    pub fn name_of(&self, node: usize) -> Option<&str> {
        self.names.get(&node).map(String::as_str)
    }

    pub(super) fn intern(&mut self, node: Node) -> Expr {
        let next = self.nodes.len() as u32;
        let at = *self.index.entry(node).or_insert(next);
        if at == next {
            self.nodes.push(node);
        }
        Expr::new(at as usize, false)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_nodes_are_one_node() {
        let mut g = Graph::new();
        let q = g.symbol(Symbol::Joint(0));
        assert_eq!(q, g.symbol(Symbol::Joint(0)));
        assert_ne!(q, g.symbol(Symbol::Joint(1)));
        assert_eq!(g.number(Number::ZERO), Expr::ZERO);
        assert_eq!(g.number(Number::ONE), Expr::ONE);
    }

    #[test]
    fn signs_live_in_handles() {
        let mut g = Graph::new();
        let q = g.symbol(Symbol::Joint(0));
        assert_eq!(-(-q), q);
        assert_eq!((-q).node(), q.node());
        assert_eq!(-Expr::ZERO, Expr::ZERO);
    }

    #[test]
    fn names_go_to_computed_nodes_of_the_right_sign() {
        let mut g = Graph::new();
        let (a, b) = (g.symbol(Symbol::Joint(0)), g.symbol(Symbol::Joint(1)));
        let sum = g.add(a, b);
        g.name(-sum, || "minus".into());
        assert_eq!(g.name_of(sum.node()), None);
        g.name(sum, || "first".into());
        g.name(sum, || "second".into());
        assert_eq!(g.name_of(sum.node()), Some("first"));
        g.name(a, || "leaf".into());
        assert_eq!(g.name_of(a.node()), None);
    }
}
