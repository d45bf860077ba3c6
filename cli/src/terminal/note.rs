//! Remarks on standard error: what a user should know, and `--quiet` leaves out.

use std::io::Write as _;

use console::style;

use crate::inside::host;

/// Prints a remark, unless `quiet`; where standard error is closed there is no one to tell.
pub fn note(text: &str, quiet: bool) {
    if quiet {
        return;
    }
    if let Some(host) = host() {
        host.remark(text);
    } else {
        let head = style("note").for_stderr().cyan().bold();
        let _ = std::io::stderr().write_all(format!("{head}: {text}\n").as_bytes());
    }
}
