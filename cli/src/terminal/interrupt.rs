//! Ctrl-C ends a long search, and leaves what was found.

use stiffarm_gap::diagnose::Stop;

use crate::inside::host;

/// What a shell makes of a program that an interrupt has ended.
const INTERRUPTED: i32 = 130;

/// What a search is told to stop by. The first Ctrl-C asks for its end, the second ends the program; inside
/// another program, that program asks.
pub fn stop() -> Stop {
    if let Some(host) = host() {
        return host.stop();
    }
    let search = Stop::default();
    let stop = search.clone();
    let handler = move || {
        if search.is_asked() {
            std::process::exit(INTERRUPTED);
        }
        search.ask();
    };
    // Where no handler can be set, the first Ctrl-C ends the program, as it always does.
    ctrlc::set_handler(handler).unwrap_or_default();
    stop
}
