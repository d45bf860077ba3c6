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
    for [at, other] in [[0, 1], [0, 2], [1, 0], [1, 2], [2, 0], [2, 1]] {
        let [data, check, bench] =
            [format!("{}.csv", places[at]), format!("{}.csv", places[other]), "bench.toml".into()]
                .map(|name| file(&name));
        let sockets = ["--bench", &bench, "--nuisance", "tool_frame", "--check", &check];
        let run = [&["diagnose", "panda", &data], &sockets[..], &["--quiet", "--json", "-"]];
        let found = stiffarm(&run.concat()).json();
        for (place, gap) in [(at, &found["gap"]["after"]), (other, &found["check"]["all"][1])] {
            let (rms, limit) = (1e3 * number(&gap["position_rms"]), limits[at][place]);
            assert!(rms < limit, "{} to {}: {rms} mm", places[at], places[place]);
        }
        // The sockets of a place are 50 mm apart, printed to a tenth of a millimetre; those of back-high come out
        // 0.43 mm too near.
        let apart = number(&found["pairs"][0]["fitted"]);
        assert!((apart - 0.05).abs() < 5e-4, "{}: {apart}", places[at]);
        let zero = |f: &Value| f["effect"] == "geometry";
        assert!(list(&found["findings"]).iter().any(zero), "{}", places[at]);
    }
}
