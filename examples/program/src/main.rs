//! Functions of one's own beside an arm's kernels: see `formulas.rs`.
//!
//! ```text
//! cargo run -p stiffarm-program
//! ```

/// The arm of `robots/arms/kuka_kr240.toml`.
#[allow(dead_code)]
mod kr240 {
    include!(concat!(env!("OUT_DIR"), "/kr240.rs"));
}

fn main() {
    println!("{}", kr240::NAME);
}
