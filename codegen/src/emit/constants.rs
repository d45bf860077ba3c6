//! Constants of a table with symbolic parameters: everything that depends on parameters alone is
//! worked out once, when the constants are made, so that kernels stay free of divisions.

use super::literal::constant;
use crate::expr::{Expr, Graph, Node, Symbol};

/// The fields of the generated `Constants`, shared by all functions of a module.
#[derive(Clone, Debug, Default)]
pub(super) struct Constants {
    fields: Vec<Field>,
    in_place: bool,
}

/// A field and the Rust expression, over `p: &Parameters<S>`, that it is made by.
#[derive(Clone, Debug)]
pub(super) struct Field {
    pub name: String,
    pub text: String,
}

impl Constants {
    /// No field but the parameters themselves: what is made of them is written where it is used.
    pub fn written_in_place() -> Self {
        Constants { fields: Vec::new(), in_place: true }
    }

    /// Nodes whose value becomes a field where anything else needs it.
    pub fn hoisted(&self, g: &Graph) -> Vec<bool> {
        if !self.in_place {
            return g.parameter_only();
        }
        let parameter = |node: &Node| match node {
            Node::Symbol(s) => matches!(g.symbol_of(*s), Symbol::Parameter(_)),
            _ => false,
        };
        g.nodes().iter().map(parameter).collect()
    }

    /// The field that holds the value of a parameter-only node, made if it is new.
    pub fn field(&mut self, g: &Graph, node: usize, hint: Option<&str>) -> String {
        let text = text(g, Expr::of_node(node));
        if let Some(known) = self.fields.iter().find(|f| f.text == text) {
            return known.name.clone();
        }
        let parameter = match g.nodes()[node] {
            Node::Symbol(s) => match g.symbol_of(s) {
                Symbol::Parameter(name) => Some(name.clone()),
                _ => None,
            },
            _ => None,
        };
        let wanted = parameter
            .or_else(|| hint.map(str::to_string))
            .unwrap_or_else(|| format!("aux{}", self.fields.len() + 1));
        let name = self.unused(wanted);
        self.fields.push(Field { name: name.clone(), text });
        name
    }

    /// The fields in the order in which they were made.
    pub fn fields(&self) -> &[Field] {
        &self.fields
    }

    fn unused(&self, wanted: String) -> String {
        let taken = |name: &str| self.fields.iter().any(|f| f.name == name);
        if !taken(&wanted) {
            return wanted;
        }
        let numbered = (2..).map(|k| format!("{wanted}_{k}"));
        numbered.into_iter().find(|name| !taken(name)).unwrap_or(wanted)
    }
}

/// The expression written out over `p`.
fn text(g: &Graph, e: Expr) -> String {
    let sign = if e.is_negative() { "-" } else { "" };
    let inner = |e| text(g, e);
    match g.node(e) {
        Node::Number(n) => format!("S::lit({sign}{})", constant(n)),
        Node::Symbol(s) => match g.symbol_of(s) {
            Symbol::Parameter(name) => format!("{sign}p.{name}"),
            other => format!("{other:?}"),
        },
        Node::Add(a, b) if b.is_negative() => format!("{sign}({} - {})", inner(a), inner(-b)),
        Node::Add(a, b) => format!("{sign}({} + {})", inner(a), inner(b)),
        Node::Mul(a, b) => format!("{sign}({} * {})", inner(a), inner(b)),
        Node::Recip(a) => format!("{sign}{}.recip()", inner(a)),
        Node::Sqrt(a) => format!("{sign}{}.sqrt()", inner(a)),
        Node::Sign(a) => format!("{sign}{}.sign()", inner(a)),
        Node::Sin(a) => format!("{sign}S::sin_cos_all([{}]).0[0]", inner(a)),
        Node::Cos(a) => format!("{sign}S::sin_cos_all([{}]).1[0]", inner(a)),
    }
}
