//! What statements read of a function's arguments, taken out of them by name.

use super::function::Function;
use crate::emit::lines::Lines;
use crate::ir::{Statement, read};

/// `let Posture { s1, c1, .. } = *posture;` and the other inputs, whatever of them is read.
pub(super) fn open_inputs<'s>(
    out: &mut Lines,
    Function { of, module, .. }: &Function,
    statements: impl IntoIterator<Item = &'s Statement>,
) {
    let names = read(statements);
    let reads = of.reads.iter().filter(|(name, _)| names.contains(&**name));
    let fields: Vec<String> = reads
        .map(|(name, field)| match name == field {
            true => name.to_string(),
            false => format!("{field}: {name}"),
        })
        .collect();
    if !fields.is_empty() {
        let rest = if fields.len() < module.posture.fields().len() { ", .." } else { "" };
        out.code(&format!("let Posture {{ {}{rest} }} = *posture;", fields.join(", ")));
    }
    for argument in of.arguments.iter().filter(|argument| argument.size.is_some()) {
        let entries = argument.entries.iter().map(|name| &**name);
        if entries.clone().any(|name| names.contains(name)) {
            let entries = entries.map(|name| if names.contains(name) { name } else { "_" });
            let entries: Vec<&str> = entries.collect();
            out.code(&format!("let [{}] = *{};", entries.join(", "), argument.name));
        }
    }
}
