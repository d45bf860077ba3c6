//! A real arm without a tracker: a Franka Panda with a ball in printed sockets, at three places.
//!
//! The data are not part of this repository. The test looks for `sockets/panda_1` in the directory that
//! `STIFFARM_DATA` names, or in `shared/data` beside the checkout; it is ignored unless `-- --ignored` asks for it.

use serde_json::Value;

use crate::support::{self, list, number, stiffarm};

fn file(name: &str) -> String {
    support::data(&format!("sockets/panda_1/{name}"))
}

/// Found at one place, held out there and predicted at the others, mm rms. The limits are what was reached and a
/// tenth more.
#[test]
#[ignore = "reads sockets that are not part of the repository: STIFFARM_DATA"]
fn a_panda_is_calibrated_by_sockets() {
    let places = ["front", "right", "back-high"];
    let limits = [[0.30, 0.53, 1.14], [0.51, 0.37, 1.24], [1.42, 1.17, 0.45]];
    for (at, limits) in places.iter().zip(limits) {
        for (other, limit) in places.iter().zip(limits) {
            let [data, check, bench] =
                [format!("{at}.csv"), format!("{other}.csv"), "bench.toml".into()]
                    .map(|name| file(&name));
            let sockets = ["--bench", &bench, "--nuisance", "tool_frame", "--check", &check];
            let run = [&["diagnose", "panda", &data], &sockets[..], &["--quiet", "--json", "-"]];
            let found = stiffarm(&run.concat()).json();
            let held_out = &found["gap"]["after"];
            let gap = if at == other { held_out } else { &found["check"]["all"][1] };
            let rms = 1e3 * number(&gap["position_rms"]);
            assert!(rms < limit, "{at} to {other}: {rms} mm");
            // The sockets of a place are 50 mm apart, printed to a tenth of a millimetre; those of back-high come out
            // 0.43 mm too near.
            let apart = number(&found["pairs"][0]["fitted"]);
            assert!((apart - 0.05).abs() < 5e-4, "{at}: {apart}");
            let zero = |f: &Value| f["effect"] == "geometry";
            assert!(list(&found["findings"]).iter().any(zero), "{at}");
        }
    }
}
