//! Texts that a test holds to the letter.

/// Holds what `read` says of wrong files against a text of them: `|` begins a line of a file, `>` one of the file beside
/// it (a map, a bench), and what is said stands below. With `STIFFARM_WRITE_DOCS` set the text is written anew.
#[track_caller]
pub fn says(path: &str, read: impl Fn(&str, &str) -> String) {
    let kept = std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{path}: {e}"));
    let said = kept.trim_end().split("\n\n").map(|case| {
        let is_file = |line: &&str| line.starts_with(['|', '>']);
        let of = |mark: char| -> String {
            let lines = case.lines().filter_map(|line| line.strip_prefix(mark));
            lines.map(|line| format!("{}\n", line.strip_prefix(' ').unwrap_or(line))).collect()
        };
        let files: Vec<&str> = case.lines().filter(is_file).collect();
        [files, vec![&read(&of('|'), &of('>'))]].concat().join("\n")
    });
    let said = said.collect::<Vec<_>>().join("\n\n") + "\n";
    if std::env::var_os("STIFFARM_WRITE_DOCS").is_some() {
        std::fs::write(path, &said).unwrap_or_else(|e| panic!("{path}: {e}"));
    }
    assert!(kept == said, "{path} is not what is said:\n{said}");
}
