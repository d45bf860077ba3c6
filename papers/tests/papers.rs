//! The five papers: their ledger, and what is reproduced of their methods.

mod bicchi;
mod dumas;
mod jweeg;
mod knapczyk;
mod ledger;
mod lin;

fn near(got: f64, want: f64, tolerance: f64) {
    assert!((got - want).abs() <= tolerance, "{got} is not {want} ± {tolerance}");
}
