//! Every command that the documentation shows is one that the command line takes.

use std::path::{Path, PathBuf};

use clap::CommandFactory as _;
use clap::error::ErrorKind;

use crate::Cli;

const REPOSITORY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

/// The Markdown of the repository's root, of `docs` and of the packages.
fn pages() -> Vec<PathBuf> {
    let folders = [
        "", "docs", "cli", "codegen", "document", "expr", "gap", "kernels", "papers", "python",
        "robots",
    ];
    let markdown = |folder: &&str| {
        let entries = std::fs::read_dir(Path::new(REPOSITORY).join(folder)).expect("a folder");
        entries.map(|entry| entry.expect("an entry").path()).collect::<Vec<_>>()
    };
    let all = folders.iter().flat_map(markdown);
    all.filter(|path| path.extension().is_some_and(|e| e == "md")).collect()
}

/// The commands `stiffarm …` in a page's blocks of shell, with their lines; a command that breaks over lines is one.
fn commands(page: &str) -> Vec<(usize, String)> {
    let (mut found, mut shell, mut begun) = (Vec::new(), false, None::<(usize, String)>);
    for (k, line) in page.lines().enumerate() {
        if let Some(language) = line.trim_start().strip_prefix("```") {
            shell = ["sh", "bash", "console"].contains(&language.trim());
            continue;
        }
        if !shell {
            continue;
        }
        let (number, mut command) = begun.take().unwrap_or((k + 1, String::new()));
        command.push_str(line.trim_end_matches('\\'));
        match line.ends_with('\\') {
            true => begun = Some((number, command)),
            false => found.push((number, command)),
        }
    }
    let ours = |(_, command): &(usize, String)| command.trim_start().starts_with("stiffarm ");
    found.into_iter().filter(ours).collect()
}

/// The words of a command as a shell parts them, up to a pipe, a redirection, a comment or another command.
fn words(command: &str) -> Vec<String> {
    let (mut words, mut word, mut quote) = (Vec::new(), None::<String>, None);
    for c in command.chars() {
        match (quote, c) {
            (Some(q), _) if c == q => quote = None,
            (None, '\'' | '"') => {
                quote = Some(c);
                word.get_or_insert_default();
            }
            (None, ' ') => words.extend(word.take()),
            (None, '|' | '>' | ';' | '&') => break,
            (None, '#') if word.is_none() => break,
            _ => word.get_or_insert_default().push(c),
        }
    }
    words.extend(word);
    words
}

#[test]
fn every_command_of_the_documentation_is_taken() {
    let (mut count, mut wrong) = (0, Vec::new());
    for page in pages() {
        let text = std::fs::read_to_string(&page).expect("a page");
        for (line, command) in commands(&text) {
            count += 1;
            if let Err(error) = Cli::command().try_get_matches_from(words(&command))
                && !matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion)
            {
                wrong.push(format!("{}:{line}: {command}\n{error}", page.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(count > 40, "only {count} commands were found");
}

#[test]
fn words_are_those_of_a_shell() {
    let command = "stiffarm a --b 'c d' --e=\"f g\"h ''  # i";
    assert_eq!(words(command), ["stiffarm", "a", "--b", "c d", "--e=f gh", ""]);
    assert_eq!(words("stiffarm a | less"), ["stiffarm", "a"]);
    assert_eq!(
        commands("```sh\nstiffarm a \\\n  b\n```\nstiffarm c\n"),
        [(2, "stiffarm a   b".to_owned())]
    );
}
