//! `stiffarm-web-bindgen IN.wasm FOLDER`: what `wasm-bindgen --target no-modules` does, at the version of Cargo.lock and
//! without what that program brings for servers and downloads. The program is packed by Zopfli, which any browser unpacks
//! and which leaves 4 % less than gzip's best.
#![forbid(unsafe_code)]

use std::error::Error;
use std::fs::{self, File};
use std::num::NonZeroU64;
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
    let program = fs::read(folder.join("stiffarm_bg.wasm"))?;
    // Of Zopfli's own fifteen: a round takes seconds.
    let rounds = NonZeroU64::new(5).ok_or("no round")?;
    let options = zopfli::Options { iteration_count: rounds, ..Default::default() };
    let packed = File::create(folder.join("stiffarm_bg.wasm.gz"))?;
    zopfli::compress(options, zopfli::Format::Gzip, program.as_slice(), packed)?;
    Ok(())
}
