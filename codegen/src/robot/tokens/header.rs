//! The settings before the table: `name: "…"; convention: modified_dh; …`.

use proc_macro2::{Delimiter, Spacing, TokenTree};
use syn::ext::IdentExt;
use syn::parse::Parser;
use syn::{Ident, LitStr, Path};

use super::super::dimension::Dimension;
use super::super::draft::{
    Cell, Draft, DraftFrame, DraftJoint, DraftMarker, DraftNamedFrame, DraftPayload, JointName,
    Vector,
};
use super::super::frames::Asked;
use super::super::model::{Convention, Output, Value};
use super::super::problem::{Problem, Report};
use super::super::suggest::{advice, closest};
use super::cells::{Raw, known_lengths, rotation, split, values};
use super::payload;
use super::spot::{Spot, is_sign, is_word};

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

const CONVENTIONS: [(&str, Convention); 4] = [
    ("standard_dh", Convention::Standard),
    ("modified_dh", Convention::Modified),
    // The words of the robot file do as well.
    ("standard", Convention::Standard),
    ("modified", Convention::Modified),
];

/// What the settings say.
#[derive(Default)]
pub(super) struct Settings {
    name: Option<Cell<String, Spot>>,
    convention: Option<Cell<Convention, Spot>>,
    gravity: Option<Vector<Value, Spot>>,
    base: DraftFrame<Spot>,
    tool: DraftFrame<Spot>,
    frames: Vec<DraftNamedFrame<Spot>>,
    markers: Vec<DraftMarker<Spot>>,
    payloads: Vec<DraftPayload<Spot>>,
    /// The payload that hangs on the tool.
    pub carries: Option<Cell<String, Spot>>,
    /// What is to be generated; every output of the tool if there are none of it.
    pub outputs: Vec<Cell<Asked, Spot>>,
    /// Whether products are fused into sums.
    pub fused: bool,
    /// Where the generated code finds the kernels.
    pub kernels: Option<Path>,
    /// The settings that were made, with the places of their names.
    seen: Vec<(&'static str, Spot)>,
    /// Settings that an unknown one was probably meant to be: these are not also missing.
    meant: Vec<&'static str>,
}

/// Reads all settings; the rest is the table.
pub(super) fn read<'t>(
    mut tokens: &'t [TokenTree],
    report: &mut Report<Spot>,
) -> (Settings, &'t [TokenTree]) {
    let mut settings = Settings::default();
    while !tokens.is_empty() && !starts_table(tokens) {
        let end = (1..tokens.len())
            .find(|i| {
                let rest = &tokens[*i..];
                is_sign(&tokens[*i], ';') || starts_table(rest) || starts_setting(rest)
            })
            .unwrap_or(tokens.len());
        let (setting, rest) = tokens.split_at(end);
        if !starts_setting(setting) {
            settings.meant.extend(closest(&setting[0].to_string(), KEYS));
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
            self.meant.extend(closest(&word, KEYS));
            let problem = Problem::new(at, format!("unknown setting `{word}`"));
            report.error(problem.help(advice(&word, &KEYS)));
            return;
        };
        if !["frame", "marker", "payload"].contains(&known)
            && self.seen.iter().any(|(seen, _)| *seen == known)
        {
            report.error(Problem::new(at, format!("`{known}` stands here for the second time")));
            return;
        }
        self.seen.push((known, at));
        let cell = Raw::new(value.to_vec(), at);
        match known {
            "name" => self.name = Some(string(&cell, report)),
            "convention" => self.convention = Some(convention(&cell, report)),
            "gravity" => self.gravity = Some(values(&cell, Dimension::Acceleration, report)),
            "base" => {
                self.base = frame(&cell, report, |cell, report| {
                    let reason = "where the base stands cannot stay symbolic";
                    known_lengths(cell, reason, report)
                })
            }
            "tool" => {
                self.tool =
                    frame(&cell, report, |cell, report| values(cell, Dimension::Length, report))
            }
            "frame" => self.frames.extend(named_frame(&cell, report)),
            "marker" => self.markers.extend(marker(&cell, report)),
            "payload" => self.payloads.extend(payload::read(&cell, report)),
            "carries" => self.carries = Some(payload::name(&cell, report)),
            "outputs" => self.outputs = outputs(&cell, report),
            "products" => self.fused = fused(&cell, report),
            _ => self.kernels = path(&cell, report),
        }
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

    /// The draft of these settings and rows; a missing convention is reported.
    pub fn into_draft(
        self,
        module: &Ident,
        joints: Vec<DraftJoint<Spot>>,
        report: &mut Report<Spot>,
    ) -> Draft<Spot> {
        let at = Spot::new(module.span());
        if self.convention.is_none() && !self.meant.contains(&"convention") {
            let problem = Problem::new(at, "`convention` is missing");
            let help = "write `convention: standard_dh;` or `convention: modified_dh;`";
            report.error(problem.help(help));
        }
        Draft {
            name: Some(self.name.unwrap_or_else(|| Cell::new(module.unraw().to_string(), at))),
            convention: self.convention,
            gravity: self.gravity,
            torque_side: None,
            joints,
            base: self.base,
            tool: self.tool,
            frames: self.frames,
            markers: self.markers,
            effects: Vec::new(),
            payloads: self.payloads,
            carries: self.carries,
            outputs: self.outputs,
        }
    }
}

/// `translation [x, y, z] rotation [rx, ry, rz]`, either part and in either order.
fn frame(
    cell: &Raw,
    report: &mut Report<Spot>,
    lengths: impl Fn(&Raw, &mut Report<Spot>) -> Vector<Value, Spot>,
) -> DraftFrame<Spot> {
    let mut found = DraftFrame::default();
    let expected = "`translation [x, y, z]` or `rotation [rx, ry, rz]` is expected here";
    if cell.tokens.is_empty() {
        report.error(Problem::new(cell.at, expected));
    }
    let mut rest = cell.tokens.as_slice();
    while let Some((word, after)) = rest.split_first() {
        let part = match after.first() {
            Some(TokenTree::Group(g)) if g.delimiter() == Delimiter::Bracket => {
                Raw::new(after[..1].to_vec(), cell.at)
            }
            _ => {
                report.error(Problem::new(Spot::new(word.span()), expected));
                return found;
            }
        };
        if is_word(word, "translation") && found.translation.is_none() {
            found.translation = Some(lengths(&part, report));
        } else if is_word(word, "rotation") && found.rotation.is_none() {
            found.rotation = Some(rotation(&part, report));
        } else {
            let problem = Problem::new(Spot::new(word.span()), expected);
            let parts = ["translation", "rotation"];
            let help = closest(&word.to_string(), parts);
            report.error(match help {
                Some(near) if is_word(word, near) => problem.help("each part stands once"),
                Some(near) => problem.help(format!("did you mean `{near}`?")),
                None => problem,
            });
            return found;
        }
        rest = &after[1..];
        if let Some((comma, after)) = rest.split_first().filter(|(t, _)| is_sign(t, ',')) {
            rest = after;
            if rest.is_empty() {
                report.error(Problem::new(Spot::new(comma.span()), expected));
            }
        }
    }
    found
}

/// A string in quotes.
pub(super) fn string(cell: &Raw, report: &mut Report<Spot>) -> Cell<String, Spot> {
    let tokens = cell.tokens.iter().cloned().collect();
    let read = syn::parse2::<LitStr>(tokens).map(|text| text.value());
    let expected = |_| Problem::new(cell.at, "a text in quotes is expected here");
    Cell { value: report.keep(read.map_err(expected)), at: cell.at }
}

fn convention(cell: &Raw, report: &mut Report<Spot>) -> Cell<Convention, Spot> {
    let found: String = cell.tokens.iter().map(ToString::to_string).collect();
    let choice = CONVENTIONS.iter().find(|(word, _)| *word == found).map(|(_, choice)| *choice);
    if choice.is_none() {
        let message = "`standard_dh` or `modified_dh` is expected here";
        let problem = Problem::new(cell.at, message);
        report.error(match closest(&found, CONVENTIONS[..2].iter().map(|(word, _)| *word)) {
            Some(near) => problem.help(format!("did you mean `{near}`?")),
            None => problem,
        });
    }
    Cell { value: choice, at: cell.at }
}

/// `name on 3 translation [x, y, z] rotation [rx, ry, rz]`, either part of the frame or neither.
fn named_frame(cell: &Raw, report: &mut Report<Spot>) -> Option<DraftNamedFrame<Spot>> {
    let (name, joint, rest) = match cell.tokens.as_slice() {
        [TokenTree::Ident(name), word, joint, rest @ ..] if is_word(word, "on") => {
            (name, joint, rest)
        }
        _ => {
            let message =
                "`name on 3 translation [x, y, z] rotation [rx, ry, rz]` is expected here";
            report.error(Problem::new(cell.at, message));
            return None;
        }
    };
    let text = joint.to_string();
    let told = text.parse().map_or(JointName::Label(text), JointName::Number);
    let frame = match rest {
        [] => DraftFrame::default(),
        _ => frame(&Raw::new(rest.to_vec(), cell.at), report, |cell, report| {
            known_lengths(cell, "a frame's place cannot stay symbolic", report)
        }),
    };
    Some(DraftNamedFrame {
        name: Cell::new(name.to_string(), Spot::new(name.span())),
        joint: Cell::new(told, Spot::new(joint.span())),
        frame,
    })
}

/// `name`, or `name [x, y, z]`.
fn marker(cell: &Raw, report: &mut Report<Spot>) -> Option<DraftMarker<Spot>> {
    let expected = || Problem::new(cell.at, "`name` or `name [x, y, z]` is expected here");
    let (name, rest) = match cell.tokens.split_first() {
        Some((TokenTree::Ident(name), rest)) => {
            (Cell::new(name.to_string(), Spot::new(name.span())), rest)
        }
        Some((name @ TokenTree::Literal(_), rest)) => {
            (string(&Raw::new(vec![name.clone()], cell.at), report), rest)
        }
        _ => {
            report.error(expected());
            return None;
        }
    };
    let translation = match rest {
        [] => None,
        _ => {
            let reason = "leave the place out where a marker's place is unknown";
            Some(known_lengths(&Raw::new(rest.to_vec(), cell.at), reason, report))
        }
    };
    Some(DraftMarker { name, translation })
}

/// `pose, jacobian at elbow`: one or more.
fn outputs(cell: &Raw, report: &mut Report<Spot>) -> Vec<Cell<Asked, Spot>> {
    let mut found = split(&cell.tokens, ',', cell.at);
    if found.is_empty() {
        found.push(cell.clone());
    }
    let asked = |Raw { tokens, at }: Raw| {
        let words: Vec<String> = tokens.iter().map(ToString::to_string).collect();
        let read = match words.is_empty() {
            true => {
                let known = Output::EACH.map(Output::name).join(", ");
                let problem = Problem::new(at, "the name of an output is expected here");
                Err(problem.help(format!("known here: {known}")))
            }
            false => Asked::read(&words.join(" "))
                .map_err(|no| Problem::new(at, no.message).help(no.help)),
        };
        Cell { value: report.keep(read), at }
    };
    found.into_iter().map(asked).collect()
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
