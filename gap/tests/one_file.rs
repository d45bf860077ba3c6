//! An effect is one file: its identifier stands there and nowhere else, and nothing asks which effect
//! it has before it.

use std::path::{Path, PathBuf};

use stiffarm_gap::effects::Catalogue;

/// Every Rust file of a folder, with its text up to its own tests.
fn sources(folder: &Path, all: &mut Vec<(PathBuf, String)>) {
    let entries = std::fs::read_dir(folder).expect("a folder of sources");
    for entry in entries {
        let path = entry.expect("an entry").path();
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        if path.is_dir() {
            let is_test = ["tests", "target", "fuzz"].contains(&name.as_str());
            if !is_test && !name.starts_with('.') {
                sources(&path, all);
            }
        } else if name.ends_with(".rs") && name != "tests.rs" {
            let text = std::fs::read_to_string(&path).expect("text");
            let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
            all.push((path, code.to_owned()));
        }
    }
}

/// `joint_offset` as a type.
fn camel(identifier: &str) -> String {
    let capital = |part: &str| part[..1].to_uppercase() + &part[1..];
    identifier.split('_').map(capital).collect()
}

/// Whether a word stands in a text as a word.
fn has_word(text: &str, word: &str) -> bool {
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    text.match_indices(word).any(|(at, _)| {
        let (before, behind) = (&text[..at], &text[at + word.len()..]);
        !before.ends_with(is_name) && !behind.starts_with(is_name)
    })
}

#[test]
fn an_identifier_stands_in_its_own_file_alone() {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let mut all = Vec::new();
    let packages =
        "gap plant compensate study infer io observe table codegen kernels robots cli papers";
    for package in packages.split(' ') {
        if root.join(package).is_dir() {
            sources(&root.join(package), &mut all);
        }
    }
    // Kernels have their own reading of those that they are made of, and the plant in motion its own
    // laws, of which the bench draws the sizes: that doubling is the proof. What is mutated by chance
    // begins with a file that has some.
    let apart = [
        "table/src/robot/beyond",
        "table/src/frontends/fuzz.rs",
        "plant/src/motion",
        "study/src/withhold/motion.rs",
    ];
    let apart = apart.map(|folder| root.join(folder));
    all.retain(|(path, _)| !apart.iter().any(|folder| path.starts_with(folder)));
    let room = root.join("gap/src/effects/catalogue");
    for identifier in Catalogue::default().identifiers() {
        let file = format!("{identifier}.rs");
        let is_own = |path: &&PathBuf| path.starts_with(&room) && path.ends_with(&file);
        let own = all.iter().map(|(path, _)| path).find(is_own);
        let own = own.unwrap_or_else(|| panic!("no file {file}")).clone();
        let holding = |what: &dyn Fn(&str) -> bool| -> Vec<&PathBuf> {
            all.iter().filter(|(_, text)| what(text)).map(|(path, _)| path).collect()
        };
        let quoted = format!("\"{identifier}\"");
        assert_eq!(holding(&|text| text.contains(&quoted)), [&own], "{identifier}");
        // As a type it stands in the catalogue and in the table of the plant's own laws; the frames
        // that may be unknown are effects too, all of the geometry together is offsets and rows, and a
        // foundation that was identified is written as the effect.
        let name = camel(identifier);
        let of_room = own.parent().expect("a room").to_path_buf();
        let allowed = [
            own.clone(),
            of_room.join("mod.rs"),
            room.join("mod.rs"),
            root.join("plant/src/laws.rs"),
        ];
        let also = match name.as_str() {
            "BaseFrame" | "ToolFrame" | "Geometry" => {
                Some(root.join("gap/src/diagnose/options.rs"))
            }
            "BaseCompliance" => Some(root.join("cli/src/identify/corrected.rs")),
            "JointOffset" | "LinkGeometry" => Some(of_room.join("geometry.rs")),
            _ => None,
        };
        // Nuisances are called after the frames.
        let bare = |text: &str| text.replace(&format!("Nuisance::{name}"), "");
        for path in holding(&|text| has_word(&code_of(&bare(text)), &name)) {
            if !["gap", "plant", "compensate", "study", "cli"]
                .iter()
                .any(|here| path.starts_with(root.join(here)))
            {
                continue;
            }
            let known = allowed.iter().chain(&also).any(|allowed| allowed == path);
            assert!(known, "{name} in {}", path.display());
        }
    }
}

/// The text without its comments.
fn code_of(text: &str) -> String {
    text.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n")
}
