//! What commands print and what they refuse, all of it: sessions.txt.

use crate::support::{Folder, read, stiffarm, words};
use crate::workbench::same;

const SESSIONS: &str = "cli/tests/cli/sessions.txt";

/// Files that are no text.
const BINARY: [(&str, &[u8]); 3] = [
    ("binary.toml", b"name = \"a\"\n\xff\xfe"),
    ("binary.csv", b"q1,q2,dx\n0.1,\xff,1\n"),
    ("garbage", b"\xff\xfe\x00\x9fnot,a\ntext"),
];

#[test]
fn sessions_are_as_they_were() {
    let folder = Folder::new();
    BINARY.iter().for_each(|(name, content)| drop(folder.file(name, content)));
    let text = read(SESSIONS);
    let (files, commands) = text.split_once("\n$ ").expect("commands");
    for file in files.split("\n-- ").skip(1) {
        let (name, content) = file.split_once(" --\n").expect("a name");
        let (name, first) = name.split_once(" + ").unwrap_or((name, ""));
        let first = match first.strip_prefix('@') {
            Some(own) => read(&folder.name(own)) + "\n",
            None if first.is_empty() => String::new(),
            None => read(first) + "\n",
        };
        folder.file(name, first + content);
    }
    // Nothing is written, also not over what is there.
    let all = || -> Vec<_> {
        folder
            .names()
            .into_iter()
            .map(|name| (std::fs::read(folder.path(&name)).ok(), name))
            .collect()
    };
    let (before, place) = (all(), folder.name(""));
    let mut said = files.to_owned();
    for session in commands.split("\n$ ") {
        let line = session.lines().next().unwrap_or_default();
        // Bags are a feature.
        if line.contains("/ros2.") && !cfg!(feature = "logs") {
            said.push_str(&format!("\n$ {session}"));
            continue;
        }
        let words = words(line);
        let words: Vec<String> = (words.iter().skip(1))
            .map(|word| word.strip_prefix('@').map_or(word.clone(), |name| place.clone() + name))
            .collect();
        let run = stiffarm(&words);
        let printed = match run.status {
            0 => format!("{}{}", run.out, run.err),
            _ => run.refused(),
        };
        said.push_str(&format!("\n$ {line}\n{}", printed.replace(&place, "@")));
    }
    assert!(all() == before, "{:?}", folder.names());
    same(SESSIONS, &said);
}
