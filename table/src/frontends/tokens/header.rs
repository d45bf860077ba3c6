//! The settings before the table: `name: "…"; convention: modified_dh; …`.

use proc_macro2::{Spacing, TokenTree};
use syn::ext::IdentExt;
use syn::parse::Parser;
use syn::{Ident, Path};

use super::cells::{self, Raw};
use super::parts;
use super::spot::{Spot, is_sign, is_word};
use crate::robot::problem::{Problem, Report};
use crate::robot::suggest::{advice, closest};
use crate::schema::{Content, Node, Table};

const KEYS: [&str; 12] = [
    "name",
    "convention",
    "gravity",
    "base",
    "tool",
    "frame",
    "marker",
    "payload",
    "carries",
    "outputs",
    "products",
    "crate",
];

const CONVENTIONS: [(&str, &str); 4] = [
    ("standard_dh", "standard"),
    ("modified_dh", "modified"),
    // The words of the robot file do as well.
    ("standard", "standard"),
    ("modified", "modified"),
];

/// What the settings say.
pub(super) struct Settings {
    /// What they say of the robot, but for lists of parts.
    root: Table<Spot>,
    /// Frames, markers and payloads.
    parts: [(&'static str, Vec<Node<Spot>>); 3],
    /// Whether products are fused into sums.
    pub fused: bool,
    /// Where the generated code finds the kernels.
    pub kernels: Option<Path>,
    /// The settings that were made, with the places of their names.
    seen: Vec<(&'static str, Spot)>,
}

/// Reads all settings; the rest is the table.
pub(super) fn read<'t>(
    mut tokens: &'t [TokenTree],
    report: &mut Report<Spot>,
) -> (Settings, &'t [TokenTree]) {
    let mut settings = Settings {
        root: Table::new(),
        parts: ["frame", "marker", "payload"].map(|key| (key, Vec::new())),
        fused: false,
        kernels: None,
        seen: Vec::new(),
    };
    while !tokens.is_empty() && !starts_table(tokens) {
        let end = (1..tokens.len())
            .find(|i| {
                let rest = &tokens[*i..];
                is_sign(&tokens[*i], ';') || starts_table(rest) || starts_setting(rest)
            })
            .unwrap_or(tokens.len());
        let (setting, rest) = tokens.split_at(end);
        if !starts_setting(setting) {
            settings.meant(&setting[0].to_string());
            let message = "a setting such as `convention: modified_dh;`, or the table's header \
                           `joint | theta | …`, is expected here";
            report.error(Problem::new(Spot::new(setting[0].span()), message));
        } else {
            settings.set(&setting[0], &setting[2..], report);
            if !rest.first().is_some_and(|token| is_sign(token, ';')) {
                let last = Spot::new(setting[setting.len() - 1].span());
                report.error(Problem::new(last, "expected `;` behind this setting"));
            }
        }
        let closed = rest.first().is_some_and(|token| is_sign(token, ';'));
        tokens = if closed { &rest[1..] } else { rest };
    }
    (settings, tokens)
}

/// `joint …` or `word | …`, or a `|` where no setting can stand.
fn starts_table(tokens: &[TokenTree]) -> bool {
    match tokens {
        [first, ..] if is_sign(first, '|') => true,
        [TokenTree::Ident(_), next, ..] if is_sign(next, '|') => true,
        [first, next, ..] => is_word(first, "joint") && !is_sign(next, ':'),
        [first] => is_word(first, "joint"),
        [] => false,
    }
}

/// `word: …`, not `word::…`.
fn starts_setting(tokens: &[TokenTree]) -> bool {
    matches!(tokens, [TokenTree::Ident(_), TokenTree::Punct(colon), ..]
        if colon.as_char() == ':'
            && !(colon.spacing() == Spacing::Joint
                && tokens.get(2).is_some_and(|next| is_sign(next, ':'))))
}

impl Settings {
    fn set(&mut self, key: &TokenTree, value: &[TokenTree], report: &mut Report<Spot>) {
        let (word, at) = (key.to_string(), Spot::new(key.span()));
        let Some(known) = KEYS.into_iter().find(|known| *known == word) else {
            self.meant(&word);
            let problem = Problem::new(at, format!("unknown setting `{word}`"));
            report.error(problem.help(advice(&word, &KEYS)));
            return;
        };
        let cell = Raw::new(value.to_vec(), at);
        if let Some((_, parts)) = self.parts.iter_mut().find(|(key, _)| *key == known) {
            self.seen.push((known, at));
            parts.extend(report.keep(match known {
                "frame" => parts::named_frame(&cell),
                "marker" => parts::marker(&cell),
                _ => parts::payload(&cell),
            }));
            return;
        }
        if self.seen.iter().any(|(seen, _)| *seen == known) {
            report.error(Problem::new(at, format!("duplicate setting `{known}`")));
            return;
        }
        self.seen.push((known, at));
        let value = match known {
            "convention" => convention(&cell, report),
            "base" | "tool" => parts::frame(&cell, report),
            "carries" => cells::name(&cell),
            "outputs" => parts::outputs(&cell, report),
            "products" => return self.fused = fused(&cell, report),
            "crate" => return self.kernels = path(&cell, report),
            _ => cells::node(&cell),
        };
        self.root.put(known, &at, value);
    }

    /// The setting that a word was probably meant to be is not also missing.
    fn meant(&mut self, word: &str) {
        self.root.meant.extend(closest(word, KEYS).map(str::to_owned));
    }

    /// What is said of the robot under a key.
    pub fn take(&mut self, key: &str) -> Option<Node<Spot>> {
        let index = self.root.pairs.iter().position(|pair| pair.key == key)?;
        Some(self.root.pairs.remove(index).value)
    }

    /// A file says everything about its robot itself.
    pub fn refuse_for_a_file(&self, report: &mut Report<Spot>) {
        let of_the_text = |key: &str| matches!(key, "carries" | "crate" | "outputs" | "products");
        for (key, at) in self.seen.iter().filter(|(key, _)| !of_the_text(key)) {
            let message = format!("`{key}` belongs into the robot file");
            let help = "beside a file only `carries`, `crate`, `outputs` and `products` can be set";
            report.error(Problem::new(*at, message).help(help));
        }
    }

    /// The robot of these settings and rows, as a robot file has it; a missing convention is reported.
    pub fn into_robot(
        self,
        module: &Ident,
        joints: Vec<Node<Spot>>,
        report: &mut Report<Spot>,
    ) -> Node<Spot> {
        let (at, mut root) = (Spot::new(module.span()), self.root);
        let convention = "convention".to_owned();
        if root.get(&convention).is_none() && !root.meant.contains(&convention) {
            let problem = Problem::new(at, "`convention` is missing");
            let help = "write `convention: standard_dh;` or `convention: modified_dh;`";
            report.error(problem.help(help));
        }
        if root.get("name").is_none() {
            root.put("name", &at, Node::text(&at, module.unraw().to_string()));
        }
        // Why there is no row has been reported with the table.
        root.meant.extend([convention, "joint".to_owned()]);
        let parts = self.parts.into_iter().chain([("joint", joints)]);
        for (key, nodes) in parts.filter(|(_, nodes)| !nodes.is_empty()) {
            root.put(key, &at, Node::made(&at, Content::List(nodes)));
        }
        Node::made(&at, Content::Table(root))
    }
}

/// A convention in the words of a robot file.
fn convention(cell: &Raw, report: &mut Report<Spot>) -> Node<Spot> {
    let found: String = cell.tokens.iter().map(ToString::to_string).collect();
    if let Some((_, word)) = CONVENTIONS.iter().find(|(known, _)| *known == found) {
        return Node::text(&cell.at, *word);
    }
    let problem = Problem::new(cell.at, "`standard_dh` or `modified_dh` is expected here");
    report.error(match closest(&found, CONVENTIONS[..2].iter().map(|(word, _)| *word)) {
        Some(near) => problem.help(format!("did you mean `{near}`?")),
        None => problem,
    });
    Node::broken(&cell.at)
}

/// `fused`, or `separate`, which is what they are otherwise.
fn fused(cell: &Raw, report: &mut Report<Spot>) -> bool {
    const CHOICES: [&str; 2] = ["fused", "separate"];
    let found: String = cell.tokens.iter().map(ToString::to_string).collect();
    if !CHOICES.contains(&found.as_str()) {
        let problem = Problem::new(cell.at, "`fused` or `separate` is expected here");
        report.error(match closest(&found, CHOICES) {
            Some(near) => problem.help(format!("did you mean `{near}`?")),
            None => problem,
        });
    }
    found == CHOICES[0]
}

fn path(cell: &Raw, report: &mut Report<Spot>) -> Option<Path> {
    let tokens = cell.tokens.iter().cloned().collect();
    let read = Path::parse_mod_style.parse2(tokens);
    report.keep(read.map_err(|_| {
        let message = "the path of the kernels' crate is expected here";
        Problem::new(cell.at, message).help("for example `crate: ::stiffarm::kernels;`")
    }))
}
