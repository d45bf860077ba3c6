//! The data file of a paper.
//!
//! ```toml
//! paper = "dumas2011"                  # short name
//! title = "Dumas et al. 2011, Joint stiffness identification …"
//!
//! [notation]
//! sine = { s = '\theta' }              # s_{23} is the sine of θ2 + θ3
//! cosine = { c = '\theta' }
//! names = ['RL', '\delta x']           # names of more than one letter
//! slash = "product"                    # a/bc is a/(bc)
//!
//! [[robot]]                            # a robot file, with symbolic lengths
//! name = "arm"
//! table = '''…'''
//!
//! [where]                              # what symbols stand for
//! '\rho_1' = 'W_1/(A_1 g)'
//!
//! [[equation]]
//! number = "(31) J_{32}"
//! latex = '''J_{32} = …'''             # as printed
//! robot = "arm"
//! of = "jacobian[3][2]"                # what it is an equation of
//! ```
//!
//! Instead of `of`, `truth` gives a formula in the same notation, whose names may be given derived
//! values by `let`; `correct` gives what should have been printed where no small change mends it
//! (it is checked as well); `definition` says why there is nothing that could be wrong.
//!
//! A relation between matrices has `matrices`, a table of what its symbols stand for:
//!
//! ```toml
//! [[equation]]
//! number = "(8)"
//! latex = '''K_\theta = K_C + J^T K_X J'''
//! robot = "arm"
//! matrices = { J = "jacobian", w = "wrench", K_C = "complementary_stiffness",
//!   'K_\theta' = "stiffness", K_X = '= J^{-T} (K_\theta - \frac{\partial (J^T w)}{\partial \theta}) J^{-1}' }
//! ```
//!
//! an output of the robot, a random matrix of some shape, or a formula of the others; `truth` may
//! then give the value of the left side, or an equation that it has to fulfil.
//!
//! A `table` has a `column` for each of its columns: `symbol` names what its cells are values of,
//! `formula` what they should follow, `computed` a method that works them out, `why` says why they
//! do not follow. A cell such as `≤ 0.5` is a bound.

mod equation;
mod formulas;
mod notes;
mod read;
mod table;

use std::collections::{BTreeMap, HashMap};

pub use read::read;
pub use table::{Column, Table};

use crate::exact::derived::{Setting, Shared};
use crate::latex::formula::Piece;
use crate::latex::notation::Notation;
use crate::matrix::Relation;
use stiffarm_codegen::robot::Robot;

/// A paper's data file.
#[derive(Clone, Debug, Default)]
pub struct Paper {
    /// Short name.
    pub id: String,
    /// Authors, year, title.
    pub title: String,
    /// How its formulas are read.
    pub notation: Notation,
    /// Robots by name.
    pub robots: BTreeMap<String, Robot>,
    /// Values of symbols for witnesses and tables; angles in radians.
    pub values: HashMap<String, f64>,
    /// The printed equations.
    pub equations: Vec<Equation>,
    /// Quantities that tables refer to and that are not printed as equations.
    pub quantities: Vec<Equation>,
    /// The printed tables.
    pub tables: Vec<Table>,
}

impl Paper {
    /// What its equations share.
    pub fn shared(&self) -> Shared<'_> {
        Shared { robots: &self.robots, notation: &self.notation }
    }

    /// Adds what another file says of the same paper.
    pub fn join(&mut self, other: Paper) {
        self.equations.extend(other.equations);
        self.quantities.extend(other.quantities);
        self.tables.extend(other.tables);
        self.robots.extend(other.robots);
        self.values.extend(other.values);
        if self.title.is_empty() {
            self.title = other.title;
        }
    }
}

/// A printed equation.
#[derive(Clone, Debug, Default)]
pub struct Equation {
    /// The paper's number, with a name where the number covers several.
    pub number: String,
    /// As printed.
    pub latex: Piece,
    /// What it is an equation of.
    pub about: About,
    /// What its derivation refers to.
    pub setting: Setting,
    /// Derived values of names in `truth`.
    pub lets: Vec<(String, Piece)>,
    /// Entries among which labels may be confused.
    pub group: Option<String>,
    /// A remark for the ledger.
    pub note: Option<String>,
    /// What stands in the paper, where `latex` is only the part of it that is judged.
    pub printed: Option<String>,
    /// What should have been printed, where no small change of it does; checked like the equation.
    pub correct: Option<Piece>,
}

/// What an equation is an equation of.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum About {
    /// Nothing that could be wrong, and why.
    #[default]
    Nothing,
    /// The same with the reason.
    Definition(String),
    /// A derived quantity.
    Path(Piece),
    /// A formula.
    Formula(Piece),
    /// A relation between matrices.
    Relation(Relation),
}
