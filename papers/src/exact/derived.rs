//! What a printed equation should say: an entry of what the generator derives of a robot, or of a
//! product of elementary transforms.

use std::collections::BTreeMap;

use super::arithmetic::Arithmetic;
use super::forms::Forms;
use super::product::{Matrix, product, transport};
use super::reading::Reading;
use crate::latex::notation::Notation;
use crate::latex::tree::{Angle, Tree};
use stiffarm_codegen::derive::{Displacements, Form, Output, Program, derive_in, flexible};
use stiffarm_codegen::robot::Robot;

/// What the equations of a paper share.
#[derive(Clone, Copy, Debug)]
pub struct Shared<'p> {
    /// The robots of the file.
    pub robots: &'p BTreeMap<String, Robot>,
    /// The paper's notation.
    pub notation: &'p Notation,
}

/// What an equation's derivation may refer to.
#[derive(Clone, Debug, Default)]
pub struct Setting {
    /// The robot that the equation is about.
    pub robot: Option<String>,
    /// Angles of its joints; `theta1`, `theta2`, … where none are given.
    pub joints: Option<Vec<Angle>>,
    /// The wrench on its tool.
    pub wrench: Vec<Tree>,
    /// The equation's product of transforms.
    pub product: Vec<String>,
    /// What names stand for, in the formulas and in the robot's table; each may use those before it.
    pub defined: Vec<(String, Tree)>,
    /// Symbols that grow without bounds: what they divide vanishes.
    pub infinite: Vec<String>,
}

/// A path such as `jacobian[3][2]`, `compliance[1][1] of joint 2`, `arm: pose[1][4]`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Path<'p> {
    robot: Option<&'p str>,
    /// Of what is derived.
    pub name: &'p str,
    /// From 0.
    indices: Vec<usize>,
    joint: Option<usize>,
}

impl<'p> Path<'p> {
    pub fn read(text: &'p str) -> Result<Self, String> {
        let (robot, rest) = match text.split_once(':') {
            Some((robot, rest)) => (Some(robot.trim()), rest.trim()),
            None => (None, text.trim()),
        };
        let (rest, joint) = match rest.split_once(" of joint ") {
            Some((rest, joint)) => (rest.trim(), Some(index(joint)?)),
            None => (rest, None),
        };
        let (name, brackets) = rest.split_at(rest.find('[').unwrap_or(rest.len()));
        let mut indices = Vec::new();
        let mut brackets = brackets;
        while let Some(inner) = brackets.strip_prefix('[') {
            let (number, rest) = inner.split_once(']').ok_or("`[` is never closed")?;
            indices.push(index(number)?);
            brackets = rest;
        }
        if !brackets.is_empty() || indices.len() > 2 {
            return Err(format!("`{text}` is no path like jacobian[3][2]"));
        }
        Ok(Path { robot, name: name.trim(), indices, joint })
    }

    /// The entry of a matrix of some shape that the path names, none if all of it; a vector's entry
    /// has one index.
    pub fn entry(&self, (rows, columns): (usize, usize)) -> Result<Option<(usize, usize)>, String> {
        let entry = match self.indices.as_slice() {
            [] => return Ok(None),
            [row] if columns == 1 => (*row, 0),
            [row, column] => (*row, *column),
            _ => (rows, columns),
        };
        let inside = entry.0 < rows && entry.1 < columns;
        let wrong = || format!("the index lies outside of {rows}×{columns}");
        inside.then_some(Some(entry)).ok_or_else(wrong)
    }

    /// What the path names of a matrix.
    fn of(&self, whole: Matrix) -> Result<Matrix, String> {
        Ok(match self.entry(whole.shape())? {
            None => whole,
            Some(entry) => Matrix::from_element(1, 1, whole[entry]),
        })
    }
}

fn index(text: &str) -> Result<usize, String> {
    let number = text.trim().parse::<usize>().ok().filter(|n| (1..=1000).contains(n));
    number.map(|n| n - 1).ok_or_else(|| format!("`{text}` is no index counted from 1"))
}

/// Derives what a path names: a matrix, or a single entry as a 1×1 matrix.
///
/// # Errors
/// Why it cannot be derived.
pub fn derived(
    path: &str,
    setting: &Setting,
    shared: Shared<'_>,
    forms: &Forms,
) -> Result<Matrix, String> {
    let path = Path::read(path)?;
    let product = || product(&setting.product, shared.notation, forms);
    let whole = match path.name {
        "product" => product()?,
        "transport" => transport(&product()?, forms)?,
        "transport_transposed" => transport(&product()?, forms)?.transpose(),
        name => return output(name, &path, setting, shared.robots, forms),
    };
    path.of(whole)
}

/// What of a robot's derivation a path names.
enum Derivation {
    Output(Output),
    /// The pose with displacements in the chain: `flexible_published(dx,dy,dphi)`.
    Flexible(Form, String),
}

impl Derivation {
    fn read(name: &str) -> Result<Self, String> {
        if let Some((form, list)) = name.strip_suffix(')').and_then(|name| name.split_once('(')) {
            let form = form.strip_prefix("flexible_");
            let known = Form::EACH.into_iter().find(|known| form == Some(known.name()));
            if let Some(known) = known {
                return Ok(Derivation::Flexible(known, list.to_owned()));
            }
        }
        let output = Output::EACH.into_iter().find(|output| output.name() == name);
        output.map(Derivation::Output).ok_or_else(|| {
            let names: Vec<&str> = Output::EACH.iter().map(|o| o.name()).collect();
            format!(
                "`{name}` is none of product, transport, transport_transposed, {}, or a pose with \
                 displacements such as flexible_exact(dx,dy,dphi), flexible_published(…), \
                 flexible_first_order(…)",
                names.join(", ")
            )
        })
    }

    fn derive(&self, robot: &Robot) -> Result<Program, String> {
        Ok(match self {
            Derivation::Output(output) => derive_in(robot, &[*output], 0),
            Derivation::Flexible(form, list) => {
                flexible(robot, &Displacements::read(list, robot.dof())?, *form)
            }
        })
    }
}

fn output(
    name: &str,
    path: &Path<'_>,
    setting: &Setting,
    robots: &BTreeMap<String, Robot>,
    forms: &Forms,
) -> Result<Matrix, String> {
    let derivation = Derivation::read(name)?;
    let which = path.robot.or(setting.robot.as_deref()).ok_or("no robot is named")?;
    let mut robot =
        robots.get(which).cloned().ok_or_else(|| format!("there is no robot `{which}`"))?;
    if let Some(joint) = path.joint {
        for (row, j) in robot.joints.iter_mut().enumerate() {
            j.beam = None;
            j.stiffness = j.stiffness.take().filter(|_| row == joint);
        }
    }
    let n = robot.dof();
    let program = derivation.derive(&robot)?;
    let (rows, columns) = program.blocks[0].held.shape(n);
    let joints = match &setting.joints {
        Some(joints) => joints.clone(),
        None => (1..=n).map(|k| Angle::single(&format!("theta{k}"))).collect(),
    };
    if joints.len() != n {
        return Err(format!("{} angles are given for {n} joints", joints.len()));
    }
    let wrench = setting.wrench.iter().map(|tree| forms.tree(tree)).collect::<Result<_, _>>()?;
    let entries = &program.blocks[0].entries[..rows * columns];
    let named = path.of(Matrix::from_column_slice(rows, columns, entries))?;
    let values = Reading { joints, wrench }.values(forms, &program.graph, named.as_slice())?;
    Ok(Matrix::from_vec(named.nrows(), named.ncols(), values))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::latex::parser::parse;

    const ARM: &str = "name = \"x\"\nconvention = \"standard\"\n\
        [[joint]]\ntype = \"revolute\"\na = \"L1\"\nstiffness = \"k1\"\n\
        [[joint]]\ntype = \"revolute\"\na = \"L2\"\nstiffness = \"k2\"\n";

    fn of(path: &str, forms: &Forms) -> Result<Matrix, String> {
        let robots = BTreeMap::from([("arm".to_owned(), Robot::from_toml(ARM, "x").unwrap().0)]);
        let setting = Setting {
            robot: Some("arm".into()),
            product: vec!["Rz(\\theta_1)".into(), "Tx(L_1)".into()],
            ..Setting::default()
        };
        derived(path, &setting, Shared { robots: &robots, notation: &Notation::default() }, forms)
    }

    #[test]
    fn paths_name_entries() {
        for (path, text) in [
            ("jacobian[1][2]", "-L_2\\sin(\\theta_1+\\theta_2)"),
            ("arm: compliance[1][1] of joint 2", "\\frac{L_2^2\\sin(\\theta_1+\\theta_2)^2}{k_2}"),
            ("product[2][4]", "L_1\\sin\\theta_1"),
        ] {
            let forms = Forms::new(&[], &[]).unwrap();
            let entry = of(path, &forms).unwrap()[0];
            let wanted = forms.tree(&parse(text, &Notation::default()).unwrap()).unwrap();
            let apart = forms.sub(entry, wanted).unwrap();
            let truth = forms.truth(1, vec![apart]).unwrap();
            assert!(truth.form(truth.entries[0]).is_zero(), "{path}");
        }
        assert_eq!(of("pose", &Forms::new(&[], &[]).unwrap()).unwrap().nrows(), 3);
    }

    #[test]
    fn what_cannot_be_derived_says_why() {
        let why = |path: &str| of(path, &Forms::new(&[], &[]).unwrap()).unwrap_err();
        assert!(why("jacobain[1][1]").contains("is none of"));
        assert!(why("jacobian[7][1]").contains("outside of 6×2"));
        assert!(why("jacobian[0][1]").contains("counted from 1"));
        assert!(why("other: pose").contains("no robot `other`"));
        assert!(why("product[1").contains("never closed"));
    }
}
