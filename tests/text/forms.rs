//! The macro's two forms and the build script give what `emit::rust` returns.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use proc_macro2::{TokenStream, TokenTree};
use stiffarm_codegen::emit::{RustOptions, rust};
use stiffarm_codegen::robot::Robot;
use stiffarm_codegen::robot::urdf::{Chain, Table, read, robot_file};
use stiffarm_codegen::{expand, generate_to_out_dir};

use crate::tables::{collection, invocations, table};

/// The items of the module that an expansion ends with.
fn items(expansion: TokenStream) -> String {
    match expansion.into_iter().last() {
        Some(TokenTree::Group(module)) => module.stream().to_string(),
        other => panic!("no module: {other:?}"),
    }
}

fn tokens(text: &str) -> String {
    text.parse::<TokenStream>().expect("the text is Rust").to_string()
}

#[test]
fn an_inline_table_expands_to_the_text() {
    for input in invocations() {
        let robot = table(input.clone());
        let text = rust(&robot, &RustOptions::default());
        assert!(items(expand(input, Path::new(""))) == tokens(&text), "{}", robot.name);
    }
}

#[test]
fn a_robot_file_expands_to_the_text_and_is_watched() {
    for (id, _, robot) in collection() {
        let invocation = format!("mod arm from \"robots/arms/{id}.toml\"; crate: ::here;");
        let expansion = expand(invocation.parse().expect("tokens"), Path::new("."));
        let text = rust(&robot, &RustOptions { kernels: "::here".to_owned(), fused: false });
        let items = items(expansion);
        let watched = items.strip_suffix(&tokens(&text)).expect("the text ends the module");
        let file = format!("\"./robots/arms/{id}.toml\"");
        assert!(watched.contains("include_bytes") && watched.contains(&file), "{watched}");
    }
}

#[test]
fn fused_products_are_written_where_they_are_asked_for() {
    let expansion = |settings: &str| {
        let file = "robots/arms/kuka_kr240.toml";
        let invocation = format!("mod arm from \"{file}\"; {settings} crate: ::here;");
        items(expand(invocation.parse().expect("tokens"), Path::new(".")))
    };
    let (_, _, robot) =
        collection().into_iter().find(|(id, _, _)| *id == "kuka_kr240").expect("in the collection");
    let options = |fused| RustOptions { kernels: "::here".to_owned(), fused };
    let [plain, fused] = [false, true].map(|fused| rust(&robot, &options(fused)));
    assert!(!plain.contains("mul_add") && plain.contains(" solve::<S, 6, 5>(stiffness"));
    assert!(fused.contains("S::mul_add(") && fused.contains(" solve_fused::<S, 6, 5>("));
    assert!(fused.contains("`stiffarm generate ROBOT --fused --check FILE`"));
    assert!(expansion("").ends_with(&tokens(&plain)));
    assert!(expansion("products: separate;").ends_with(&tokens(&plain)));
    assert!(expansion("products: fused;").ends_with(&tokens(&fused)));
}

/// What is not asked for is not printed; `all` holds what is asked for and can be had together.
#[test]
fn outputs_are_printed_as_they_are_asked_for() {
    let file = "robots/arms/kuka_kr240.toml";
    let expansion = |said: &str| {
        let invocation = format!("mod arm from \"{file}\"; {said} crate: ::here;");
        items(expand(invocation.parse().expect("tokens"), Path::new(".")))
    };
    let text = std::fs::read_to_string(file).expect("the file is here");
    let options = RustOptions { kernels: "::here".to_owned(), fused: false };
    let of = |outputs: &str| {
        let said = format!("outputs = [{outputs}]\n{text}");
        rust(&Robot::from_toml(&said, file).expect("a valid file").0, &options)
    };
    let functions = |text: &str| -> Vec<String> {
        let heads = text.lines().filter_map(|line| line.strip_prefix("pub fn "));
        heads.filter_map(|head| head.split('<').next()).map(str::to_owned).collect()
    };
    let two = of("'jacobian', 'pose', 'jacobian'");
    assert_eq!(functions(&two), ["pose", "jacobian", "all"]);
    assert!(two.contains("generate ROBOT --outputs pose,jacobian --check FILE"));
    assert!(expansion("outputs: jacobian, pose;").ends_with(&tokens(&two)));
    let one = of("'deflection'");
    assert_eq!(functions(&one), ["deflection"]);
    assert!(expansion("outputs: deflection;").ends_with(&tokens(&one)));
    assert_eq!(functions(&of("'frames', 'weight_torque'")), ["frames", "weight_torque"]);
    // A posture of no more than they need, and each function as it is among all.
    let all = rust(&Robot::from_toml(&text, file).expect("a valid file").0, &options);
    let jacobian = |text: &str| {
        let from = text.find("    pub const SPARSITY: [[bool; 6]; 6]").expect("the Jacobian's");
        text[from..]
            .split("\n}\n")
            .next()
            .map(|part| part.replace(", .. } = *posture", " } = *posture"))
    };
    assert_eq!(jacobian(&of("'jacobian'")), jacobian(&all));
    assert!(!of("'jacobian'").contains("s6") && all.contains("pub s6: S"));
}

/// A URDF's chain as a table, as the command imports it.
#[test]
fn a_urdf_expands_to_its_table() {
    let expansion = |said: &str| {
        let invocation = format!("mod arm from {said}; crate: ::here;");
        expand(invocation.parse().expect("tokens"), Path::new("tests/data/urdf"))
    };
    let said = "\"ur5.urdf\", base \"base_link_inertia\", tip \"tool0\"";
    let urdf = read(include_str!("../data/urdf/ur5.urdf"), false).expect("a URDF");
    let chain = Chain::new(&urdf.robot, Some("base_link_inertia"), Some("tool0")).expect("a chain");
    let robot = robot_file(&chain, &Table::new(&chain));
    let text = rust(&robot, &RustOptions { kernels: "::here".to_owned(), fused: false });
    assert!(items(expansion(said)).ends_with(&tokens(&text)));
    let documentation = expansion(said).to_string();
    assert!(documentation.contains("From `ur5.urdf`: link `base_link_inertia` to link `tool0`."));
    // Where its first axis leans, the base is moved.
    let oblique = expansion("\"oblique.urdf\", base \"foot\", tip \"needle\"").to_string();
    assert!(!oblique.contains("compile_error") && oblique.contains("pub fn pose"), "{oblique}");
    for (said, told) in [
        ("\"ur5.urdf\", tip \"tool1\"", "tool1"),
        ("\"ur5.urdf\", tipp \"tool0\"", "each once, behind the name of a URDF"),
        ("\"ur5.urdf\", tip \"tool0\", tip \"tool0\"", "each once, behind the name of a URDF"),
        ("\"ur5.toml\", tip \"tool0\"", "each once, behind the name of a URDF"),
        ("\"ur5.urfd\"", "did you mean `ur5.urdf`"),
    ] {
        let found = expansion(said).to_string();
        assert!(found.contains("compile_error") && found.contains(told), "{said}: {found}");
    }
}

/// Set in the process that plays the build script.
const CHILD: &str = "STIFFARM_TEXT_CHILD";

fn out_dir() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("text")
}

/// The build script is this test in a process of its own: with `OUT_DIR`, and with hash seeds of its
/// own, so that a text that hangs on the order of a map would differ.
#[test]
fn a_build_script_writes_the_text() {
    let options = RustOptions::default();
    if env::var_os(CHILD).is_some() {
        for (id, _, _) in collection() {
            generate_to_out_dir(format!("robots/arms/{id}.toml"), &options).expect("written");
        }
        return;
    }
    fs::create_dir_all(out_dir()).expect("a folder for the output");
    let child = Command::new(env::current_exe().expect("this test"))
        .args(["--exact", "forms::a_build_script_writes_the_text", "--nocapture"])
        .env(CHILD, "1")
        .env("OUT_DIR", out_dir())
        .output()
        .expect("the process runs");
    let said = String::from_utf8_lossy(&child.stdout);
    assert!(child.status.success(), "{said}");
    for (id, _, robot) in collection() {
        let written = fs::read(out_dir().join(id).with_extension("rs")).expect("the output");
        assert!(written == rust(&robot, &options).into_bytes(), "{id}");
        assert!(said.contains(&format!("cargo::rerun-if-changed=robots/arms/{id}.toml")), "{said}");
    }
}

#[test]
fn the_same_table_gives_the_same_bytes() {
    for (id, toml, robot) in collection() {
        let (again, _) = stiffarm_codegen::robot::Robot::from_toml(toml, id).expect("a valid file");
        let options = RustOptions::default();
        assert!(rust(&robot, &options) == rust(&again, &options), "{id}");
    }
}

#[test]
fn a_build_script_without_out_dir_says_so() {
    let error = stiffarm_codegen::BuildError::NoOutDir;
    let shown = "OUT_DIR is not set: call this from build.rs";
    assert_eq!((error.to_string().as_str(), format!("{error:?}").trim()), (shown, shown));
}
