//! The LaTeX printer: a document to lay beside a paper's appendix.

use std::fmt::Write as _;
use stiffarm_kernels::{Form, Output};

use super::NotWritten;
use crate::derive::{
    COMPONENTS, Displacements, Form as Flexible, Held, Program, Quantity, Size, derive, flexible,
    inverse,
};
use crate::ir::{Angle, Constants, Function, Operation, Solve, Statement, Style, Term};
use crate::number::Number;
use crate::robot::Robot;

/// A document with the closed form of each of `outputs`, and of the inverse kinematics where the arm is asked for it: what
/// is shared first, then every entry that is not structurally zero. Rows and columns count from 1, as on paper.
///
/// # Errors
/// [`NotWritten`] where the inverse kinematics is no closed form of the arm itself.
pub fn latex(robot: &Robot, outputs: &[Output]) -> Result<String, NotWritten> {
    has_inverse(robot)?;
    let sections = outputs
        .iter()
        .map(|output| section(derive(robot, &[*output]), &output.name().replace('_', " ")));
    let inverse =
        robot.inverse_kinematics.map(|form| section(inverse(robot, form), "inverse kinematics"));
    Ok(document(robot, sections.chain(inverse)))
}

/// Refuses an inverse that is more than formulas.
fn has_inverse(robot: &Robot) -> Result<(), NotWritten> {
    let exact = robot.is_as_its_table() && robot.closed_form().is_ok();
    let is = match robot.inverse_kinematics {
        Some(form) if form.is_search() => "a search, not a closed form",
        Some(_) if !exact => "a closed form of another table with steps behind it",
        _ => return Ok(()),
    };
    Err(NotWritten::Inverse { is, written: "rust, c, cuda or python" })
}

/// A document with the flexible kinematics of a table (Jweeg & Al-Khafaji 2012, eq. 20) in each of
/// its forms: exact, as published, and to the strict first order.
pub fn flexible_latex(robot: &Robot, displacements: &Displacements) -> String {
    let sections = Flexible::EACH.into_iter().map(|form| {
        let title = format!("flexible pose, {}", form.name().replace('_', " "));
        section(flexible(robot, displacements, form), &title)
    });
    document(robot, sections)
}

fn document(robot: &Robot, sections: impl Iterator<Item = String>) -> String {
    let mut text = String::from(
        "\\documentclass{article}\n\\usepackage[a4paper,margin=20mm]{geometry}\n\
         \\usepackage{amsmath}\n\\allowdisplaybreaks\n\\setlength{\\parindent}{0pt}\n\
         \\begin{document}\n",
    );
    let _ = writeln!(text, "\\section*{{{}}}", escaped(&robot.name));
    text.push_str("$s_{23}=\\sin(q_2+q_3)$, $c_{23}=\\cos(q_2+q_3)$, and so on.\n");
    text.extend(sections);
    text.push_str("\\end{document}\n");
    text
}

fn section(program: Program, title: &str) -> String {
    let function = Function::new(program, &mut Constants::written_in_place(), false);
    let mut out = format!("\\subsection*{{{title}}}\n");
    let _ = match &function.program.own {
        Some(own) => writeln!(out, "{}.", escaped(&own.sentence.replace('`', ""))),
        None => writeln!(out, "Worked out in {}.", function.program.frame()),
    };
    for Angle { suffix, sum, .. } in function.angles.iter().filter(|angle| has_offset(&angle.sum)) {
        let sum = sum.print(&Latex).replace(" + ", "+").replace(" - ", "-");
        let _ = writeln!(out, "$s_{{{suffix}}}=\\sin({sum})$, $c_{{{suffix}}}=\\cos({sum})$.");
    }
    let mut lines = Vec::new();
    for step in &function.body {
        match step {
            Statement::Let(name, value) => {
                lines.push(format!("{} &= {}", Latex.local(name), value.print(&Latex)));
            }
            Statement::Store { block, entry, value } => {
                let place = match &function.blocks()[*block].held {
                    Held::Output(output) => place(*output, function.program.dof, *entry),
                    Held::Own(quantity) => own_place(quantity, *entry),
                };
                lines.push(format!("{place} &= {}", value.print(&Latex)));
            }
            Statement::Solve(solve) => lines.extend(system(solve)),
            Statement::SinCos(angles) => lines.extend(angles.iter().flat_map(|angle| {
                let Angle { suffix, sum, .. } = angle;
                let sum = sum.print(&Latex);
                ["sin", "cos"].map(|name| format!("{}_{{{suffix}}} &= \\{name}({sum})", &name[..1]))
            })),
        }
    }
    if lines.is_empty() {
        out.push_str("All entries are zero.\n");
        return out;
    }
    let lines: Vec<String> = lines.iter().map(|line| broken(line)).collect();
    let _ = writeln!(out, "\\begin{{align*}}\n{}\n\\end{{align*}}", lines.join(" \\\\\n"));
    out
}

/// Longest line, in characters of source, that fits the page.
const WIDE: usize = 150;

/// A long equation continued on a further line, broken before an operator outside brackets.
fn broken(line: &str) -> String {
    if line.len() <= WIDE {
        return line.to_string();
    }
    let mut depth = 0usize;
    let mut last = None;
    for (at, c) in line.char_indices().take_while(|(at, _)| *at < WIDE) {
        match c {
            '{' | '(' => depth += 1,
            '}' | ')' => depth = depth.saturating_sub(1),
            '+' | '-' if depth == 0 && line[..at].ends_with(' ') => last = Some(at),
            _ => {}
        }
    }
    match last {
        Some(at) => {
            let (head, rest) = line.split_at(at);
            format!("{} \\\\\n&\\quad {}", head.trim_end(), broken(rest))
        }
        None => line.to_string(),
    }
}

/// `(K_θ − K_C) δq = τ` or `M q̈ = f`, entry by entry.
fn system(solve: &Solve) -> Vec<String> {
    let [matrix, right, unknown] = match solve.of_motion {
        true => ["M", "f", "\\ddot q"],
        false => ["(K_\\theta-K_C)", "\\tau", "\\delta q"],
    };
    let n = solve.right.len();
    let mut lines = Vec::new();
    let zero = Term::Number(Number::ZERO);
    for (at, term) in solve.matrix.iter().enumerate().filter(|(_, term)| **term != zero) {
        let (row, column) = (at % n + 1, at / n + 1);
        lines.push(format!("{matrix}_{{{row}{column}}} &= {}", term.print(&Latex)));
    }
    for (row, term) in solve.right.iter().enumerate() {
        lines.push(format!("{right}_{{{}}} &= {}", row + 1, term.print(&Latex)));
    }
    lines.push(format!("{unknown} &= {matrix}^{{-1}}\\,{right}"));
    lines
}

/// An entry in the papers' notation.
fn place(output: Output, n: usize, entry: usize) -> String {
    let (rows, columns) = output.shape(n);
    let (row, column) = (entry % rows, entry / rows);
    let axis = ["x", "y", "z"];
    let pose = |column: usize, frame: &str| {
        format!("{}^{{{frame}}}_{{{}}}", ["x", "y", "z", "p"][column], axis[row.min(2)])
    };
    let comma = if n > 9 || columns > 9 { "," } else { "" };
    let (i, j, symbol) = (row + 1, column + 1, output.symbol());
    match output.form() {
        Form::Pose => format!("{}_{{{}}}", ["n", "o", "a", "p"][column], axis[row]),
        Form::Poses => pose(column % 4, &(column / 4 + 1).to_string()),
        Form::Vector => format!("[{symbol}]_{{{i}}}"),
        Form::Matrix => format!("[{symbol}]_{{{i}{comma}{j}}}"),
        Form::Stack => {
            let each = output.columns().each().count(n);
            format!("[{symbol}_{{{}}}]_{{{i}{comma}{}}}", column / each + 1, column % each + 1)
        }
    }
}

/// An entry of a result of the inverse.
fn own_place(quantity: &Quantity, entry: usize) -> String {
    let name = match quantity.name.len() {
        1 => quantity.name.clone(),
        _ => format!("\\mathit{{{}}}", quantity.name),
    };
    match quantity.size {
        Size::Scalar => name,
        Size::Vector(_) => format!("{name}^{{({})}}", entry + 1),
        Size::Matrix { rows, .. } => {
            format!("{name}_{{{}}}^{{({})}}", entry % rows + 1, entry / rows + 1)
        }
    }
}

/// Whether an angle is more than a sum of joint angles.
fn has_offset(sum: &Term) -> bool {
    sum.any(|leaf| !matches!(leaf, Term::Entry("q", _)))
}

/// A displacement in the letters of Jweeg & Al-Khafaji.
fn displacement(place: usize, component: usize) -> String {
    let letters = ["\\delta x", "\\delta y", "\\delta z", "d\\psi", "d\\beta", "d\\varphi"];
    format!("{}_{{{place}}}", letters[component])
}

fn escaped(text: &str) -> String {
    text.chars()
        .map(|c| match c {
            '&' | '%' | '$' | '#' | '_' | '{' | '}' => format!("\\{c}"),
            '\\' | '~' | '^' => " ".to_string(),
            c => c.to_string(),
        })
        .collect()
}

struct Latex;

impl Style for Latex {
    fn number(&self, n: Number) -> String {
        if let Some((numerator, denominator)) = n.fraction() {
            return format!("\\tfrac{{{numerator}}}{{{denominator}}}");
        }
        let text = n.to_string();
        match text.split_once('e') {
            Some((mantissa, exponent)) => format!("{mantissa}\\cdot 10^{{{exponent}}}"),
            None => text.strip_suffix(".0").map_or(text.clone(), str::to_string),
        }
    }

    /// `s23` as `s_{23}`, `z3x` as `z_{3x}`, `kc_31` as `kc_{31}`.
    fn local(&self, name: &str) -> String {
        let at = name.find(|c: char| c.is_ascii_digit()).unwrap_or(name.len());
        let component = COMPONENTS.iter().position(|known| *known == &name[..at]);
        if let (Some(component), Ok(place)) = (component, name[at..].parse()) {
            return displacement(place, component);
        }
        for (word, letter) in [("qdd", "\\ddot q"), ("qd", "\\dot q"), ("tau", "\\tau")] {
            if let Some(joint) = name.strip_prefix(word).filter(|k| k.parse::<u32>().is_ok()) {
                return format!("{letter}_{{{joint}}}");
            }
        }
        let split = name.find(|c: char| c.is_ascii_digit() || c == '_').unwrap_or(name.len());
        let axis = name.len() == 2 && "fmnoap".contains(&name[..1]);
        let (letters, rest) = name.split_at(if axis { 1 } else { split });
        let letters = match letters.len() {
            0 | 1 => letters.to_string(),
            _ => format!("\\mathit{{{letters}}}"),
        };
        match rest.trim_start_matches('_') {
            "" => letters,
            rest => format!("{letters}_{{{}}}", rest.replace('_', ",")),
        }
    }

    fn product(&self, a: &str, b: &str) -> String {
        format!("{a}\\,{b}")
    }

    fn bracket(&self, inner: &str) -> String {
        format!("\\left({inner}\\right)")
    }

    fn constant(&self, name: &str) -> String {
        self.local(name)
    }

    fn entry(&self, array: &str, at: &[usize]) -> String {
        match (array, at) {
            ("e", [place, component]) => displacement(*place, *component),
            _ => at.iter().fold(array.to_owned(), |text, k| format!("{text}_{{{}}}", k + 1)),
        }
    }

    fn of(&self, operation: Operation, numbers: &[String]) -> String {
        let a = &numbers[0];
        match operation {
            Operation::Reciprocal => format!("\\frac{{1}}{{{a}}}"),
            Operation::Root => format!("\\sqrt{{{a}}}"),
            Operation::Sign => format!("\\operatorname{{sign}}({a})"),
            Operation::Sine => format!("\\sin({a})"),
            Operation::Cosine => format!("\\cos({a})"),
            Operation::Atan2 => format!("\\operatorname{{atan2}}({a}, {})", numbers[1]),
            Operation::Select => {
                let [b, c] = [&numbers[1], &numbers[2]];
                format!("\\begin{{cases}}{b}&{a}>0\\\\{c}\\end{{cases}}")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_get_the_papers_indices() {
        for (plain, set) in [
            ("s23", "s_{23}"),
            ("z3x", "z_{3x}"),
            ("fx", "f_{x}"),
            ("kc_31", "\\mathit{kc}_{31}"),
            ("L1", "L_{1}"),
            ("t12", "t_{12}"),
        ] {
            assert_eq!(Latex.local(plain), set);
        }
    }

    #[test]
    fn numbers_are_written_as_on_paper() {
        assert_eq!(Latex.number(Number::ratio(7, 20)), "0.35");
        assert_eq!(Latex.number(Number::integer(2)), "2");
        let small = Number::from_decimal("1.5e-7").unwrap();
        assert_eq!(Latex.number(small), "1.5\\cdot 10^{-7}");
    }
}
