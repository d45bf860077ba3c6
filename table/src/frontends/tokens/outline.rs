//! What a rejected table seems to describe, so that the stub of its module fits the code that uses it.

use proc_macro2::{Delimiter, TokenTree};
use stiffarm_kernels::Output;
use toml::Value;

use super::cells::split;
use super::rows;
use super::spot::{Spot, flatten, is_sign, is_word, words};
use super::table::columns;
use crate::robot::beyond::{SIDED, WARMED};
use crate::robot::lexeme::{Kind, Lexeme, lex};
use crate::robot::problem::Place;
use crate::robot::quantity::symbol;
use crate::robot::suggest::closest;
use crate::robot::units::expression;
use crate::schema::{BEAM, SECTION, keys};

/// Columns whose cells hold no parameters.
const WITHOUT_PARAMETERS: [&str; 3] = ["joint", "limits", "source"];
/// Tables of a robot file whose strings hold no parameters.
const WITHOUT_VALUES: [&str; 4] = ["name", "type", "limits", "source"];

/// The joints and the parameters of a table, as far as its mistakes leave them visible. Nothing is
/// checked and nothing reported: the mistakes have been.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Outline {
    /// Number of rows; `None` where no row can be seen.
    pub joints: Option<usize>,
    /// What seems to be a parameter, each once, in order of appearance.
    pub symbols: Vec<String>,
    /// Whether some joint's angle seems to have a parameter in its offset.
    pub offsets: bool,
    /// The outputs that seem to be asked for of the tool; all of them if there are none.
    pub asked: Vec<Output>,
    /// What seem to be frames and markers.
    pub places: Vec<String>,
    /// Whether some effect depends on the side from which a joint came.
    pub sides: bool,
    /// Whether some effect depends on how warm the arm is.
    pub warming: bool,
}

impl Outline {
    /// The outline of an inline table and of the settings before it.
    pub(super) fn of_table(settings: &[TokenTree], table: &[TokenTree]) -> Self {
        let mut outline = Outline::default();
        // Where a frame is on its link is told in numbers.
        let mut numbers = false;
        for (i, token) in settings.iter().enumerate() {
            let behind = |word: &str, back: usize| i >= back && is_word(&settings[i - back], word);
            let set = |word: &str| behind(word, 2) && is_sign(&settings[i - 1], ':');
            numbers = (numbers || set("frame")) && !is_sign(token, ';');
            if !numbers && (behind("translation", 1) || set("gravity")) {
                outline.cell(std::slice::from_ref(token));
            }
            if set("frame") || set("marker") {
                outline.place(&token.to_string());
            }
            if set("outputs") {
                let list = settings[i..].iter().take_while(|token| !is_sign(token, ';'));
                let list: Vec<String> = list.map(ToString::to_string).collect();
                list.split(|word| word == ",").for_each(|words| outline.ask(&words.join(" ")));
            }
        }
        let rows = rows::split(table);
        let Some((header, rows)) = rows.split_first().filter(|_| !table.is_empty()) else {
            return outline;
        };
        let nowhere = Spot::new(proc_macro2::Span::call_site());
        let columns: Vec<Option<&str>> = split(header, '|', nowhere)
            .iter()
            .map(|cell| closest(&cell.tokens.first()?.to_string(), columns()))
            .collect();
        outline.joints = Some(rows.len()).filter(|n| *n > 0);
        for row in rows {
            for (cell, column) in split(row, '|', nowhere).iter().zip(&columns) {
                if column.is_some_and(|name| !WITHOUT_PARAMETERS.contains(&name)) {
                    outline.cell(&cell.tokens);
                }
                if *column == Some("theta") && cell.tokens.iter().any(|token| is_word(token, "q")) {
                    let mut theta = Outline::default();
                    theta.cell(&cell.tokens);
                    outline.offsets |= !theta.symbols.is_empty();
                }
            }
        }
        outline
    }

    /// The outline of a robot file.
    pub fn of_file(text: &str) -> Self {
        let mut outline = Outline::default();
        let Ok(table) = text.parse::<toml::Table>() else { return outline };
        let joints = table.get("joint").and_then(Value::as_array);
        outline.joints = joints.map(Vec::len).filter(|n| *n > 0);
        for key in ["gravity", "joint", "tool"] {
            table.get(key).into_iter().for_each(|value| outline.value(value));
        }
        let revolute =
            |joint: &&Value| joint.get("type").and_then(Value::as_str) != Some("prismatic");
        for joint in joints.into_iter().flatten().filter(revolute) {
            let mut theta = Outline::default();
            joint.get("theta").into_iter().for_each(|value| theta.value(value));
            outline.offsets |= !theta.symbols.is_empty();
        }
        let asked = table.get("outputs").and_then(Value::as_array).into_iter().flatten();
        asked.filter_map(Value::as_str).for_each(|name| outline.ask(name));
        let places = ["frame", "marker"].into_iter().filter_map(|key| table.get(key)?.as_array());
        let names = places.flatten().filter_map(|place| place.get("name")?.as_str());
        names.for_each(|name| outline.place(name));
        let effects = table.get("effect").and_then(Value::as_array).into_iter().flatten();
        let ids: Vec<&str> = effects.filter_map(|effect| effect.get("id")?.as_str()).collect();
        outline.sides = ids.iter().any(|id| SIDED.contains(id));
        outline.warming = ids.iter().any(|id| WARMED.contains(id));
        outline
    }

    /// An output of the tool, where `name` is one's.
    fn ask(&mut self, name: &str) {
        self.asked.extend(Output::EACH.into_iter().find(|output| output.name() == name));
    }

    /// A frame or marker, where its name can be a module's.
    fn place(&mut self, name: &str) {
        if syn::parse_str::<syn::Ident>(name).is_ok() && self.places.iter().all(|p| p != name) {
            self.places.push(name.to_owned());
        }
    }

    /// A cell of the inline table: words, a list, or a beam in braces.
    fn cell(&mut self, tokens: &[TokenTree]) {
        match tokens {
            [TokenTree::Group(group)] => {
                let nowhere = Spot::new(group.span());
                for entry in split(&flatten(group.stream()), ',', nowhere) {
                    match (group.delimiter(), entry.tokens.as_slice()) {
                        (Delimiter::Brace, [key, _, value @ ..]) => self.field(key, value),
                        (Delimiter::Bracket, entry) => self.cell(entry),
                        _ => {}
                    }
                }
            }
            tokens => self.words(&words(tokens)),
        }
    }

    /// A field of a beam, or of its section's constants.
    fn field(&mut self, key: &TokenTree, value: &[TokenTree]) {
        let known = keys(BEAM).into_iter().chain(keys(SECTION));
        match closest(&key.to_string(), known) {
            // The sizes of a tube or a box are numbers.
            Some("section") if !matches!(value, [TokenTree::Group(_)]) => {}
            Some(_) => self.cell(value),
            None => {}
        }
    }

    fn value(&mut self, value: &Value) {
        match value {
            Value::String(text) => self.words(&lex(text, |at| at)),
            Value::Array(entries) => entries.iter().for_each(|entry| self.value(entry)),
            Value::Table(table) => table
                .iter()
                .filter(|(key, _)| !WITHOUT_VALUES.contains(&key.as_str()))
                .for_each(|(_, value)| self.value(value)),
            _ => {}
        }
    }

    /// The names in a cell that are neither a unit nor a word of the table's language.
    fn words<L: Place>(&mut self, words: &[Lexeme<L>]) {
        let mut in_unit = false;
        for (i, word) in words.iter().enumerate() {
            let behind = i.checked_sub(1).map(|before| &words[before].kind);
            in_unit &= !(word.is('+') || word.is('-'));
            let Some(name) = word.name() else { continue };
            in_unit |= matches!(behind, Some(Kind::Number(_)));
            let called = matches!(words.get(i + 1).map(|w| &w.kind), Some(Kind::Other(_)));
            let unit = in_unit || (words.len() > 1 && expression(&words[i..=i]).is_ok());
            let word_of_table = ["q", "rigid"].contains(&name);
            let field = syn::parse_str::<syn::Ident>(name).is_ok() && symbol(name, word).is_ok();
            let new = !self.symbols.iter().any(|known| known == name);
            if field && new && !unit && !called && !word_of_table {
                self.symbols.push(name.to_owned());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use proc_macro2::TokenStream;

    use super::*;
    use crate::robot::problem::Report;

    fn table(text: &str) -> Outline {
        let tokens = flatten(text.parse::<TokenStream>().unwrap());
        let (_, table) = super::super::header::read(&tokens, &mut Report::new());
        Outline::of_table(&tokens[..tokens.len() - table.len()], table)
    }

    #[test]
    fn rows_and_names_show_through_mistakes() {
        let outline = table(
            "gravity: [0, g_y, 0]; outputs: pose, jacobian at smr1, compliance; frame: elbow no 3; marker: smr1 [0, 1]; tool: translation [0, 2*t, 0] rotatoin [r, 0, 0];\n\
             joint | theta  | d      | alhpa | kind | stiffness | com | beam\n\
             a1 | q + t1 | 350 mn | 2*al  | big  | k1 N*m    | [c, 0] | { youngs_modulus: E, colour: red, section: tube }\n\
             a2 | q      | d2/2 | 0 | - | type | - | -\n\
             a3 | q | 3e5 N/rda + e",
        );
        assert_eq!(outline.joints, Some(3));
        assert_eq!(outline.symbols, ["g_y", "t", "t1", "al", "k1", "c", "E", "d2", "e"]);
        assert_eq!(outline.places, ["elbow", "smr1"]);
        assert_eq!(
            (outline.offsets, outline.asked),
            (true, vec![Output::Pose, Output::Compliance])
        );
    }

    #[test]
    fn a_file_shows_the_same() {
        let text = "name = \"arm\"\noutputs = [\"jacobian\", \"pose at elbow\"]\n[[joint]]\ntype = \"revolut\"\na = \"2*a1\"\nd = \"3 furlong\"\n\
                    [joint.beam]\nsection = { area = \"A\" }\n[[joint]]\ntheta = \"t\"\nsource = \"x\"\n\
                    [[frame]]\nname = \"elbow\"\n[[marker]]\nname = \"a b\"";
        let outline = Outline::of_file(text);
        assert_eq!((outline.joints, outline.symbols.join(" ")), (Some(2), "a1 A t".to_owned()));
        assert_eq!(outline.places, ["elbow"]);
        assert_eq!((outline.offsets, outline.asked), (true, vec![Output::Jacobian]));
        assert_eq!(Outline::of_file("not toml"), Outline::default());
    }
}
