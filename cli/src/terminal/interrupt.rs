//! Ctrl-C ends a long search, and leaves what was found.

use stiffarm_gap::diagnose::Stop;

/// What a shell makes of a program that an interrupt has ended.
const INTERRUPTED: i32 = 130;

/// The first Ctrl-C asks the search for its end, the second ends the program.
pub fn ends(search: &Stop) {
    let search = search.clone();
    let handler = move || {
        if search.is_asked() {
            std::process::exit(INTERRUPTED);
        }
        search.ask();
    };
    // Where no handler can be set, the first Ctrl-C ends the program, as it always does.
    ctrlc::set_handler(handler).unwrap_or_default();
}
