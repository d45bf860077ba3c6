//! What a fleet knows of its arms against what the plant was made of, which shares no code with the diagnosis.

use std::path::Path;
use std::sync::Arc;

use stiffarm_fleet::arms::Arms;
use stiffarm_fleet::report::{Columns, Fleet, Kind, campaigns};
use stiffarm_fleet::session::Engine;

use crate::campaigns::{Campaign, simulated, write};
use crate::diagnoses::table;

const ARMS: usize = 24;
/// Springs of joint 2, rad/(N·m): the middle one, and how far arms differ.
const USUAL: f64 = 2e-6;
const SPREAD: f64 = 4e-8;
/// A tracker so coarse that a campaign of 36 rows tells a spring no better than arms differ.
const NOISE: &str = "200um";
/// By how much the last arm's spring changes between its campaigns.
const CHANGE: f64 = 5e-7;

/// Normal numbers without rng: the quantiles of the middles of as many parts, in an order that mixes them.
fn drawn(arm: usize) -> f64 {
    use statrs::distribution::{ContinuousCDF, Normal};
    let part = (7 * arm % ARMS) as f64;
    Normal::standard().inverse_cdf((part + 0.5) / ARMS as f64)
}

fn truth(arm: usize) -> f64 {
    USUAL + SPREAD * drawn(arm)
}

fn made(folder: &Path) {
    let campaign = |arm: usize, name: &str, spring: f64, seed| {
        let effect = format!("joint_compliance@joint 2={spring:e}");
        Campaign {
            arm: format!("{arm:02}"),
            name: name.to_owned(),
            robot: "kuka_kr240",
            text: simulated("kuka_kr240", &effect, 12, NOISE, seed),
        }
    };
    let each = (0..=ARMS).flat_map(|arm| {
        let then = if arm < ARMS { truth(arm) } else { USUAL };
        let now = if arm < ARMS { then } else { then + CHANGE };
        [campaign(arm, "2026-Q1", then, arm), campaign(arm, "2026-Q2", now, 1000 + arm)]
    });
    write(folder, &each.collect::<Vec<_>>());
}

async fn known(folder: &Path) -> Fleet {
    let session = Engine::default().session(&Arc::new(Arms::default()), &[table(folder)]).await;
    let columns = Columns {
        arm: "arm".to_owned(),
        campaign: "campaign".to_owned(),
        robot: "robot".to_owned(),
        one_robot: None,
        options: format!("--noise-position {NOISE} --effects joint_compliance"),
    };
    Fleet::of(&campaigns(&session.unwrap(), "runs", &columns).await.unwrap())
}

/// Each arm's number is drawn towards those of the others, which have not seen it: it comes nearer to the truth, by
/// as much as the page says of arms whose truth it does not know.
#[tokio::test(flavor = "multi_thread")]
async fn the_others_tell_an_arm_better() {
    let folder = tempfile::tempdir().unwrap();
    made(folder.path());
    let fleet = known(folder.path()).await;
    assert_eq!((fleet.campaigns, fleet.without.len()), (2 * (ARMS + 1), 0));
    let of = |place: &str| fleet.pooled.iter().find(|number| number.what.place == place);
    let springs = of("joint 2").expect("every arm has it");
    assert_eq!(springs.arms.len(), ARMS + 1);
    let mut squares = [0.0; 2];
    for (arm, estimates) in springs.arms.iter().filter(|(arm, _)| arm.as_str() != "24") {
        let truth = truth(arm.parse().unwrap());
        for (square, estimate) in squares.iter_mut().zip(estimates) {
            *square += (estimate.value - truth).powi(2) / ARMS as f64;
        }
    }
    let [alone, pooled] = squares.map(f64::sqrt);
    let gain = springs.gain.expect("every arm has two campaigns");
    println!("from the truth: {alone:.3e} alone, {pooled:.3e} drawn; usual {:?}", springs.pool);
    println!("from the next campaign, as the page has it: {gain:?}");
    println!("{} of {} numbers changed: {:#?}", fleet.changes.len(), fleet.compared, fleet.changes);
    assert!(pooled < alone, "{pooled} {alone}");
    assert!(gain.pooled < gain.alone, "{gain:?}");
    let changed =
        |arm: &str| fleet.changes.iter().find(|c| c.arm == arm && c.what.place == "joint 2");
    let last = changed("24").expect("the last arm's spring is another").kind;
    let Kind::Changed { difference: [low, high], .. } = last else { panic!("{last:?}") };
    assert!(low > 0.0 && (low..high).contains(&CHANGE), "{low} {high}");
}
