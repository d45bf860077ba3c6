//! A tree written as LaTeX.

use super::tree::{Function, Tree};

impl Tree {
    /// As LaTeX; what is sined stands by its name in the graph.
    pub fn latex(&self) -> String {
        match self {
            Tree::Number(n) if n.is_integer() => n.to_string(),
            Tree::Number(n) => format!("\\frac{{{}}}{{{}}}", n.numer(), n.denom()),
            Tree::Symbol(name) => name.latex(),
            Tree::Trig(Function::Sin, angle) => format!("\\sin({angle})"),
            Tree::Trig(Function::Cos, angle) => format!("\\cos({angle})"),
            Tree::Sum(terms) => {
                let mut out = String::new();
                for (k, (negative, term)) in terms.iter().enumerate() {
                    out.push_str(match (negative, k) {
                        (true, 0) => "-",
                        (true, _) => " - ",
                        (false, 0) => "",
                        (false, _) => " + ",
                    });
                    out.push_str(&term.inside());
                }
                out
            }
            Tree::Product(factors) => {
                let each: Vec<String> = factors.iter().map(Tree::inside).collect();
                each.iter().map(|f| f.trim()).collect::<Vec<_>>().join(" ")
            }
            Tree::Quotient(a, b) => format!("\\frac{{{}}}{{{}}}", a.latex(), b.latex()),
            Tree::Power(a, n) if (0..10).contains(n) => format!("{}^{n}", a.closed()),
            Tree::Power(a, n) => format!("{}^{{{n}}}", a.closed()),
            Tree::Transpose(a) => match a.as_ref() {
                Tree::Power(a, -1) => format!("{}^{{-T}}", a.closed()),
                a => format!("{}^T", a.closed()),
            },
            Tree::Derivative(a, by) => {
                format!("\\frac{{\\partial {}}}{{\\partial {}}}", a.closed(), by.latex().trim())
            }
            Tree::Integral { body, over, ends } => {
                format!(
                    "\\int_{{{}}}^{{{}}} ({}) d{over}",
                    ends.0.latex(),
                    ends.1.latex(),
                    body.latex()
                )
            }
            Tree::Sqrt(a) => format!("\\sqrt{{{}}}", a.latex()),
            Tree::Trace(a) => format!("\\text{{tr}}({})", a.latex()),
            Tree::Norm(a) => format!("\\|{}\\|", a.latex()),
            Tree::Blocks(rows) => {
                let row =
                    |row: &Vec<Tree>| row.iter().map(Tree::latex).collect::<Vec<_>>().join(" & ");
                let rows: Vec<String> = rows.iter().map(row).collect();
                format!("\\begin{{bmatrix}} {} \\end{{bmatrix}}", rows.join(" \\\\ "))
            }
            Tree::Over(over, body) => format!(
                "(\\prod_{{{}={}}}^{{{}}} {})",
                over.index,
                over.from,
                over.to,
                body.latex()
            ),
        }
    }

    /// As a factor.
    fn inside(&self) -> String {
        match self {
            Tree::Sum(_) => format!("({})", self.latex()),
            _ => self.latex(),
        }
    }

    /// As what a power stands on.
    fn closed(&self) -> String {
        match self {
            Tree::Number(_) | Tree::Symbol(_) | Tree::Blocks(_) => self.latex().trim().to_owned(),
            Tree::Transpose(inner) if matches!(**inner, Tree::Symbol(_)) => self.latex(),
            _ => format!("({})", self.latex()),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::latex::formula::sides;
    use crate::latex::notation::Notation;
    use crate::latex::parser::parse;

    fn back(latex: &str) -> String {
        let read =
            |side: &str| parse(side, &Notation::MATRICES).unwrap_or_else(|m| panic!("{m:?}"));
        let each: Vec<_> = sides(latex).iter().map(|side| read(&side.text).latex()).collect();
        each.join(" = ")
    }

    #[test]
    fn relations_are_read_and_written() {
        for relation in [
            "\\mathbf{K}_X = \\mathbf{J}^{-T} (\\mathbf{K}_\\theta - K_C) \\mathbf{J}^{-1}",
            "\\frac{1}{m} \\sqrt{\\text{tr}(M^T M)} \\|M\\|",
            "{}^Bw = \\begin{bmatrix} {}^BR_E & 0 \\\\ P & R \\end{bmatrix} {}^Ew",
            "T_i = (\\prod_{j=1}^{i-1} K_{j,kin}) \\frac{\\partial K_{i,kin}}{\\partial q_i}",
            "(A B)^3 = \\int_{0}^{L} (a x) dx",
        ] {
            assert_eq!(back(relation), relation);
        }
        assert_eq!(
            back(
                "\\left[\\frac{\\partial \\mathbf{J}^T}{\\partial \\theta_i} \\right] \\mathbf{m}"
            ),
            "\\frac{\\partial \\mathbf{J}^T}{\\partial \\theta_i} \\mathbf{m}"
        );
    }
}
