//! A beam's cell: `{ youngs_modulus: 69 GPa, shear_modulus: 26 GPa, section: tube(0.2, 0.18) }`.

use proc_macro2::{Delimiter, TokenTree};

use super::cells::{Raw, group, node, split};
use super::spot::{Spot, flatten, is_sign, is_word};
use crate::robot::problem::{Problem, Report};
use crate::robot::suggest::closest;
use crate::schema::{BOX, Content, Node, TUBE, Table};

const SECTION: &str = "`tube(outer, inner)`, `box([b, h], [b, h])` or \
                       `{ area: …, iy: …, iz: …, j: … }` is expected here";

/// The beam in a cell.
pub(super) fn read(cell: &Raw, report: &mut Report<Spot>) -> Node<Spot> {
    let Some(tokens) = group(cell, Delimiter::Brace) else {
        let problem = Problem::new(cell.at, "a beam in braces is expected here");
        let help = "for example { youngs_modulus: 69 GPa, shear_modulus: 26 GPa, \
                    section: tube(0.2, 0.18) }";
        report.error(problem.help(help));
        return Node::broken(&cell.at);
    };
    fields(&tokens, cell.at, report)
}

/// `key: value, …`.
fn fields(tokens: &[TokenTree], at: Spot, report: &mut Report<Spot>) -> Node<Spot> {
    let mut table = Table::new();
    for field in split(tokens, ',', at) {
        let expected = Problem::new(field.at, "`key: value` is expected here");
        let [key @ TokenTree::Ident(word), colon, rest @ ..] = field.tokens.as_slice() else {
            report.error(expected);
            continue;
        };
        let (word, at) = (word.to_string(), Spot::new(key.span()));
        if !is_sign(colon, ':') {
            table.meant.push(word);
            report.error(expected);
        } else if table.get(&word).is_some() {
            report.error(Problem::new(at, format!("duplicate key `{word}`")));
        } else {
            let value = Raw::new(rest.to_vec(), at);
            let value = if word == "section" { section(&value, report) } else { node(&value) };
            table.put(&word, &at, value);
        }
    }
    Node::made(&at, Content::Table(table))
}

fn section(cell: &Raw, report: &mut Report<Spot>) -> Node<Spot> {
    match group(cell, Delimiter::Brace) {
        Some(tokens) => fields(&tokens, cell.at, report),
        None => shape(cell).unwrap_or_else(|problem| {
            report.error(problem);
            Node::broken(&cell.at)
        }),
    }
}

/// `tube(…)` or `box(…)` as the table that a robot file has in its place.
fn shape(cell: &Raw) -> Result<Node<Spot>, Problem<Spot>> {
    let expected = || Problem::new(cell.at, SECTION);
    let (word, arguments) = match cell.tokens.as_slice() {
        [word @ TokenTree::Ident(_), TokenTree::Group(arguments)]
            if arguments.delimiter() == Delimiter::Parenthesis =>
        {
            (word, arguments)
        }
        _ => return Err(expected()),
    };
    let at = Spot::new(arguments.span());
    let arguments = split(&flatten(arguments.stream()), ',', at);
    let lists = arguments.iter().all(|side| group(side, Delimiter::Bracket).is_some());
    if is_word(word, "box") && !lists {
        let message = "the sides of a box are [b, h], along the beam's y and along its z";
        let help = "write `box([120 mm, 80 mm])`, with a second pair if it is hollow";
        return Err(Problem::new(at, message).help(help));
    }
    let shapes = [("tube", TUBE), ("box", BOX)];
    let known = shapes.into_iter().find(|(name, _)| is_word(word, name));
    let Some((name, keys)) = known.filter(|_| (1..=2).contains(&arguments.len())) else {
        let near = closest(&word.to_string(), ["tube", "box"]).filter(|_| known.is_none());
        return Err(match near {
            Some(near) => expected().help(format!("did you mean `{near}`?")),
            None => expected(),
        });
    };
    let mut table = Table::new();
    table.put(keys[0], &at, Node::text(&Spot::new(word.span()), name));
    for (key, size) in keys[1..].iter().zip(&arguments) {
        table.put(key, &size.at, node(size));
    }
    Ok(Node::made(&cell.at, Content::Table(table)))
}
