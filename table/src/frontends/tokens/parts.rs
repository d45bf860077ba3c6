//! What a setting tells in a form of its own, as the table that a robot file has in its place: frames, markers, loads,
//! outputs.

use proc_macro2::{Delimiter, TokenTree};

use super::cells::{Raw, name, node, split};
use super::spot::{Spot, is_sign, is_word, words};
use crate::robot::Output;
use crate::robot::problem::{Problem, Report};
use crate::robot::suggest::closest;
use crate::schema::{Content, Node, Table};

/// One part, or why it is none.
type Part = Result<Node<Spot>, Problem<Spot>>;

const PARTS: [&str; 2] = ["translation", "rotation"];
const PAYLOAD: &str = "`name mass 1.2 kg, com [x, y, z], inertia [xx, xy, xz, yy, yz, zz]` is expected here, the last two if wanted";

/// `translation [x, y, z] rotation [rx, ry, rz]`, either part and in either order.
pub(super) fn frame(cell: &Raw, report: &mut Report<Spot>) -> Node<Spot> {
    let mut table = Table::new();
    if let Err(problem) = put_frame(&mut table, cell) {
        report.error(problem);
    }
    Node::made(&cell.at, Content::Table(table))
}

fn put_frame(table: &mut Table<Spot>, cell: &Raw) -> Result<(), Problem<Spot>> {
    let expected = |at: Spot| {
        Problem::new(at, "`translation [x, y, z]` or `rotation [rx, ry, rz]` is expected here")
    };
    if cell.tokens.is_empty() {
        return Err(expected(cell.at));
    }
    let mut rest = cell.tokens.as_slice();
    while let Some((word, after)) = rest.split_first() {
        let at = Spot::new(word.span());
        let part = match after.first() {
            Some(TokenTree::Group(g)) if g.delimiter() == Delimiter::Bracket => {
                Raw::new(after[..1].to_vec(), cell.at)
            }
            _ => return Err(expected(at)),
        };
        match PARTS.into_iter().find(|known| is_word(word, known)) {
            Some(known) if table.get(known).is_some() => {
                return Err(expected(at).help("each part stands once"));
            }
            Some(known) => table.put(known, &at, node(&part)),
            None => {
                return Err(match closest(&word.to_string(), PARTS) {
                    Some(near) => expected(at).help(format!("did you mean `{near}`?")),
                    None => expected(at),
                });
            }
        }
        rest = &after[1..];
        if let Some((comma, after)) = rest.split_first().filter(|(t, _)| is_sign(t, ',')) {
            rest = after;
            if rest.is_empty() {
                return Err(expected(Spot::new(comma.span())));
            }
        }
    }
    Ok(())
}

/// `name on 3 translation [x, y, z] rotation [rx, ry, rz]`, either part of the frame or neither.
pub(super) fn named_frame(cell: &Raw) -> Part {
    let [TokenTree::Ident(name), on, joint, rest @ ..] = cell.tokens.as_slice() else {
        return Err(no_frame(cell));
    };
    if !is_word(on, "on") {
        return Err(no_frame(cell));
    }
    let mut table = Table::new();
    let at = Spot::new(name.span());
    table.put("name", &at, Node::text(&at, name.to_string()));
    let at = Spot::new(joint.span());
    let words = Some(words(core::slice::from_ref(joint)));
    table.put("joint", &at, Node { at, kind: None, words, content: Content::Cell });
    if !rest.is_empty() {
        put_frame(&mut table, &Raw::new(rest.to_vec(), cell.at))?;
    }
    Ok(Node::made(&cell.at, Content::Table(table)))
}

fn no_frame(cell: &Raw) -> Problem<Spot> {
    let message = "`name on 3 translation [x, y, z] rotation [rx, ry, rz]` is expected here";
    Problem::new(cell.at, message)
}

/// `name`, or `name [x, y, z]`.
pub(super) fn marker(cell: &Raw) -> Part {
    let Some((word @ (TokenTree::Ident(_) | TokenTree::Literal(_)), rest)) =
        cell.tokens.split_first()
    else {
        return Err(Problem::new(cell.at, "`name` or `name [x, y, z]` is expected here"));
    };
    let mut table = Table::new();
    let told = name(&Raw::new(vec![word.clone()], cell.at));
    table.put("name", &cell.at, told);
    if !rest.is_empty() {
        table.put("translation", &cell.at, node(&Raw::new(rest.to_vec(), cell.at)));
    }
    Ok(Node::made(&cell.at, Content::Table(table)))
}

/// `gripper mass 1.2 kg, com [0, 0, 60 mm]`: its name, its mass and, in any order, its centre and its moments of inertia.
pub(super) fn payload(cell: &Raw) -> Part {
    let Some((word, rest)) = cell.tokens.split_first().filter(|(_, rest)| !rest.is_empty()) else {
        return Err(Problem::new(cell.at, PAYLOAD));
    };
    let mut table = Table::new();
    table.put("name", &cell.at, name(&Raw::new(vec![word.clone()], cell.at)));
    for part in split(rest, ',', cell.at) {
        let Some((word, after)) = part.tokens.split_first() else {
            return Err(Problem::new(part.at, PAYLOAD));
        };
        let at = Spot::new(word.span());
        match ["mass", "com", "inertia"].into_iter().find(|known| is_word(word, known)) {
            Some(known) if table.get(known).is_none() => {
                table.put(known, &at, node(&Raw::new(after.to_vec(), part.at)));
            }
            _ => return Err(Problem::new(at, PAYLOAD)),
        }
    }
    if table.get("mass").is_none() {
        return Err(Problem::new(cell.at, "a payload without a mass").help(PAYLOAD));
    }
    Ok(Node::made(&cell.at, Content::Table(table)))
}

/// `pose, jacobian at elbow`: one or more.
pub(super) fn outputs(cell: &Raw, report: &mut Report<Spot>) -> Node<Spot> {
    let mut found = split(&cell.tokens, ',', cell.at);
    if found.is_empty() {
        found.push(cell.clone());
    }
    let mut asked = |Raw { tokens, at }: &Raw| {
        if tokens.is_empty() {
            let known = Output::EACH.map(Output::name).join(", ");
            let problem = Problem::new(*at, "the name of an output is expected here");
            report.error(problem.help(format!("known here: {known}")));
            return Node::broken(at);
        }
        let words: Vec<String> = tokens.iter().map(ToString::to_string).collect();
        Node::text(at, words.join(" "))
    };
    let entries = found.iter().map(&mut asked).collect();
    Node::made(&cell.at, Content::List(entries))
}
