//! Ctrl-C ends a long search, and leaves what was found.

use std::sync::OnceLock;

use stiffarm_gap::diagnose::Stop;

/// The exit status of a program that an interrupt has ended, as a shell has it.
pub const INTERRUPTED: u8 = 130;

/// What the search of this program is told to stop by.
static SEARCH: OnceLock<Stop> = OnceLock::new();

/// What a search at a terminal is told to stop by. The first Ctrl-C asks for its end, the second ends the program.
pub fn stop() -> Stop {
    let begin = || {
        // Where no handler can be set, the first Ctrl-C ends the program, as it always does.
        #[cfg(not(target_family = "wasm"))]
        ctrlc::set_handler(interrupted).unwrap_or_default();
        Stop::default()
    };
    SEARCH.get_or_init(begin).clone()
}

#[cfg(not(target_family = "wasm"))]
fn interrupted() {
    if is_asked() {
        std::process::exit(INTERRUPTED.into());
    }
    SEARCH.get().into_iter().for_each(Stop::ask);
}

/// Whether Ctrl-C has asked for the end.
pub fn is_asked() -> bool {
    SEARCH.get().is_some_and(Stop::is_asked)
}
