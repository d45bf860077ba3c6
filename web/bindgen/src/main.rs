//! `stiffarm-web-bindgen IN.wasm FOLDER`: what `wasm-bindgen --target no-modules` does, at the version of Cargo.lock and
//! without what that program brings for servers and downloads.
#![forbid(unsafe_code)]

use std::error::Error;
use std::path::PathBuf;

use wasm_bindgen_cli_support::Bindgen;

fn main() -> Result<(), Box<dyn Error>> {
    let given: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let [input, folder] = given.as_slice() else {
        return Err("found other arguments, expected IN.wasm FOLDER".into());
    };
    let mut bindgen = Bindgen::new();
    // A worker of a page that was opened as a file cannot load modules.
    bindgen.input_path(input).out_name("stiffarm").no_modules(true)?.typescript(false);
    // Names are a tenth of what is loaded, and serve debuggers alone.
    bindgen.remove_name_section(true).remove_producers_section(true).generate(folder)?;
    Ok(())
}
