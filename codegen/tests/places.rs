//! An output is described once. Its identifier stands in the table, beside its derivation and beside its
//! textbook definition, and nowhere else in the generator and the kernels; its name as text in the table
//! alone. Independent ways to some outputs (`kernels/src/parity`: differences, dual numbers) name the ones
//! that they know; no other needs an entry there.

use std::fs;
use std::path::{Path, PathBuf};

use stiffarm_kernels::Output;

/// A file and its code, without comments and tests.
struct Source {
    path: String,
    text: String,
}

fn sources() -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the workspace's folder");
    let mut folders: Vec<PathBuf> =
        vec![root.join("codegen/src"), root.join("table/src"), root.join("kernels/src")];
    let mut found = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder of sources") {
            let path = entry.expect("a file of sources").path();
            if path.is_dir() && !path.ends_with("tests") && !path.ends_with("parity") {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "rs")
                && !path.ends_with("tests.rs")
            {
                let text = fs::read_to_string(&path).expect("a source is text");
                let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
                let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
                let text = code.collect::<Vec<_>>().join("\n");
                let path = path.strip_prefix(root).expect("below the root");
                let path = path.to_string_lossy().replace('\\', "/");
                found.push(Source { path, text });
            }
        }
    }
    assert!(found.len() > 100, "{} sources", found.len());
    found
}

/// Whether `word` stands in `text` as a whole.
fn names(text: &str, word: &str) -> bool {
    let part = |c: char| c.is_alphanumeric() || c == '_';
    text.match_indices(word).any(|(at, _)| !text[at + word.len()..].starts_with(part))
}

#[test]
fn an_output_stands_in_three_places() {
    let sources = sources();
    // The flexible chain gives a pose, too; a URDF's table is compared with the URDF by its pose; the inverse of an arm takes
    // three outputs of it, and in NumPy two.
    let apart = [
        ("codegen/src/derive/flexible.rs", Output::Pose),
        ("codegen/src/expand/urdf.rs", Output::Pose),
        ("table/src/robot/nearest.rs", Output::Pose),
        ("table/src/robot/nearest.rs", Output::Jacobian),
        ("table/src/robot/nearest.rs", Output::DeflectionWithGravity),
        ("codegen/src/emit/numpy/as_it_is.rs", Output::Pose),
        ("codegen/src/emit/numpy/as_it_is.rs", Output::Jacobian),
    ];
    for output in Output::EACH {
        let identifier = format!("Output::{output:?}");
        let mut places: Vec<&str> = sources
            .iter()
            .filter(|source| names(&source.text, &identifier))
            .map(|source| source.path.as_str())
            .filter(|path| !apart.contains(&(*path, output)))
            .collect();
        places.sort_unstable();
        let [derivation, textbook] = places.as_slice() else {
            panic!("{identifier} stands in {places:?}, not in two files");
        };
        assert!(derivation.starts_with("codegen/src/derive/outputs/"), "{derivation}");
        assert!(textbook.starts_with("kernels/src/generic/"), "{textbook}");

        let (quoted, row) = (format!("{:?}", output.name()), format!("name: {},", output.name()));
        let named: Vec<&str> = sources
            .iter()
            // A number of an effect may be called as an output is.
            .filter(|source| !source.path.starts_with("table/src/robot/beyond/"))
            .filter(|source| source.text.contains(&quoted) || source.text.contains(&row))
            .map(|source| source.path.as_str())
            .collect();
        assert_eq!(named, ["kernels/src/output/table.rs"], "{quoted}");
    }
}
