//! Writes the kernels of `elbow.toml` to `OUT_DIR`.

use stiffarm_codegen::emit::RustOptions;
use stiffarm_codegen::{BuildError, generate_to_out_dir};

fn main() -> Result<(), BuildError> {
    let options = RustOptions { kernels: "::stiffarm_kernels".to_owned(), fused: false };
    generate_to_out_dir("../elbow.toml", &options)?;
    Ok(())
}
