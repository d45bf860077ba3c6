//! Constants of a table with symbolic parameters: everything that depends on parameters alone is
//! worked out once, when the constants are made, so that kernels stay free of divisions.

use std::collections::HashMap;

use super::lower::Lowering;
use super::term::{Name, Term};
use crate::expr::{Expr, Graph, Symbol};

/// The fields of the generated `Constants`, shared by all functions of a module.
#[derive(Clone, Debug, Default)]
pub(crate) struct Constants {
    fields: Vec<Field>,
    in_place: bool,
}

/// A field, and what it is of the parameters.
#[derive(Clone, Debug)]
pub(crate) struct Field {
    pub name: Name,
    pub value: Term,
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
        (0..g.nodes().len()).map(|node| parameter(g, node).is_some()).collect()
    }

    /// The field that holds the value of a parameter-only node, made if it is new.
    pub fn field(&mut self, g: &Graph, node: usize, hint: Option<&str>) -> Name {
        let parameters = (0..g.nodes().len())
            .filter_map(|node| Some((node, Term::Constant(parameter(g, node)?.into()))));
        let names: HashMap<usize, Term> = parameters.collect();
        let value = Lowering { graph: g, names: &names, fused: false }.term(Expr::of_node(node));
        if let Some(known) = self.fields.iter().find(|f| f.value == value) {
            return known.name.clone();
        }
        let wanted = parameter(g, node).or(hint).map(str::to_string);
        let name = self.unused(wanted.unwrap_or_else(|| format!("aux{}", self.fields.len() + 1)));
        self.fields.push(Field { name: name.clone(), value });
        name
    }

    /// The fields in the order in which they were made.
    pub fn fields(&self) -> &[Field] {
        &self.fields
    }

    fn unused(&self, wanted: String) -> Name {
        let taken = |name: &str| self.fields.iter().any(|f| *f.name == *name);
        let numbered = (2..).map(|k| format!("{wanted}_{k}"));
        let mut names = core::iter::once(wanted.clone()).chain(numbered);
        names.find(|name| !taken(name)).unwrap_or(wanted).into()
    }
}

/// The parameter that a node is.
pub(super) fn parameter(g: &Graph, node: usize) -> Option<&str> {
    match g.symbol_at(node)? {
        Symbol::Parameter(name) => Some(name),
        _ => None,
    }
}
