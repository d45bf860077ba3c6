//! What a function does, step by step.

use std::collections::HashSet;

use super::angle::Angle;
use super::term::{Name, Term};
use crate::number::Number;

/// A step of a function.
#[derive(Clone, Debug)]
pub(crate) enum Statement {
    /// Gives a value a name.
    Let(Name, Term),
    /// Stores a value as an entry of a result.
    Store {
        /// Which of the function's blocks.
        block: usize,
        /// Column-major.
        entry: usize,
        value: Term,
    },
    /// Takes the sines and cosines of angles that are not the posture's, all at once.
    SinCos(Vec<Angle>),
    /// Solves a linear system.
    Solve(Solve),
}

/// `matrix · unknowns = right`, column-major, where the symmetric part of the matrix is positive definite.
#[derive(Clone, Debug)]
pub(crate) struct Solve {
    pub matrix: Vec<Term>,
    pub right: Vec<Term>,
    /// `None` of an unknown that nothing uses.
    pub unknowns: Vec<Option<Name>>,
    /// Size of the leading block, whose unknowns are solved for together; each other one follows from its row.
    pub leading: usize,
    /// Force and moment within whose ellipsoid the matrix is surely positive definite.
    pub margin: Option<[Number; 2]>,
    /// Whether it is that of the accelerations, not of a deflection.
    pub of_motion: bool,
}

impl Statement {
    /// The expressions that it reads.
    pub fn terms(&self) -> impl Iterator<Item = &Term> {
        let (one, angles, system) = match self {
            Statement::Let(_, value) | Statement::Store { value, .. } => (Some(value), None, None),
            Statement::SinCos(angles) => (None, Some(angles), None),
            Statement::Solve(solve) => (None, None, Some(solve)),
        };
        let angles = angles.into_iter().flatten().map(|angle| &angle.sum);
        let system = system.into_iter().flat_map(|solve| solve.matrix.iter().chain(&solve.right));
        one.into_iter().chain(angles).chain(system)
    }

    /// The locals that it makes.
    pub fn defines(&self) -> Vec<Name> {
        match self {
            Statement::Let(name, _) => vec![name.clone()],
            Statement::Store { .. } => Vec::new(),
            Statement::SinCos(angles) => angles.iter().flat_map(Angle::needed).collect(),
            Statement::Solve(solve) => solve.unknowns.iter().flatten().cloned().collect(),
        }
    }

    pub fn is_solve(&self) -> bool {
        matches!(self, Statement::Solve(_))
    }
}

/// The locals that statements read.
pub(crate) fn read<'s>(statements: impl IntoIterator<Item = &'s Statement>) -> HashSet<&'s str> {
    let mut names = HashSet::new();
    for term in statements.into_iter().flat_map(Statement::terms) {
        term.leaves(&mut |leaf| {
            if let Term::Local(name) = leaf {
                names.insert(&**name);
            }
        });
    }
    names
}
