//! Joint logs as text.

use proptest::prelude::*;
use proptest::sample::select;
use stiffarm_draws::texts::{PIECES_OF_TABLES, answered, mutated};
use stiffarm_gap::io::Map;
use stiffarm_gap::log::{Log, Names, Run};
use stiffarm_kernels::Motion;

const ARM: [Motion; 2] = [Motion::Revolute, Motion::Prismatic];

/// Every kind of column, comment, separator and damage.
const CORPUS: [&str; 6] = [
    include_str!("../../../tests/data/logs/expected.csv"),
    "\u{feff}# a log\r\n# torque_side = link. Behind the gear.\r\n\r\n\
     t[ms],q1[deg],q2[mm],qd1[deg/s],qd2[m/s],tau1[N*m],tau2[N],temp1[degC],temp2[degC],fx,payload,run,contact,note\r\n\
     0,180,5,1,0.1,1.5,2,20,21,0,5kg,a,0,x\r\n2,90,6,1,0.1,2.5,3,20,21,0,5kg,a,1,\r\n\
     # between\r\n4,nan,6,1,0.1,2.5\r\n2,90,6,1,0.1,2.5,3,20,21,0,,b,0,\"y,\"\"z\"\r\n",
    "timestamp actual_q_0 actual_q_1 actual_current_0 actual_current_1\n\
     1.7e9 0.1 0.2 1 2\n1700000000.008 0.1 0.2 1 2\n",
    "timestamp;observation.state;action;episode_index\n0;\"[1, 2]\";[1,2];0\n0.1;[1, 2];[1];1\n",
    "t,q_shoulder,q_elbow,tau_shoulder,tau_elbow\n0,1,2,3,4\n0,1,2,3,4\n-1,1,2,3,4\n1e12,1,2,3,4\n",
    "t\tq1\tq2\ti1\ti2\n0\t1\t2\t3\t4\n",
];

const MAPS: [&str; 4] = [
    "",
    "[columns]\nt = { column = \"t\", unit = \"ms\" }\ntau1 = { column = \"q2\", factor = -1, offset = 1e300 }\n",
    "[columns]\nq1 = \"A1\"\nspeed = \"t\"\n",
    "[columns]\nq99999 = \"q1\"\n",
];

/// What is read is finite and in order, what is refused is said.
fn reads(bytes: &[u8], names: &Names) -> Result<(), TestCaseError> {
    match Log::from_bytes("log.csv", bytes, &ARM, names) {
        Ok(log) => {
            prop_assert!(!log.runs.is_empty());
            prop_assert_eq!(
                log.samples,
                log.runs.iter().map(|r| r.t.len() + r.clock.repeated).sum::<usize>()
            );
            log.runs.iter().try_for_each(is_sound)?;
            prop_assert!(log.damaged.iter().all(|damaged| damaged.line > 0));
            prop_assert!(log.period().is_finite() && !log.remarks().iter().any(String::is_empty));
        }
        Err(error) => prop_assert!(error.to_string().len() > 20),
    }
    Ok(())
}

fn is_sound(run: &Run) -> Result<(), TestCaseError> {
    let finite = |numbers: &[f64]| numbers.iter().all(|x| x.is_finite());
    prop_assert!(finite(&run.t) && run.t.windows(2).all(|pair| pair[0] < pair[1]));
    prop_assert_eq!(run.contact.len(), run.t.len());
    for joints in run.signals.values() {
        prop_assert_eq!(joints.len(), ARM.len());
        prop_assert!(joints.iter().all(|of| of.len() == run.t.len() && finite(of)));
    }
    Ok(())
}

fn fuzz(cases: u32) {
    let own = Names::own(vec!["shoulder".to_owned(), "elbow".to_owned()]);
    let all: Vec<Names> = std::iter::once(own.clone())
        .chain(Names::formats().filter_map(|format| own.clone().of_format(format)))
        .chain(
            MAPS.iter().filter_map(|map| Some(own.clone().mapped(Map::read("m.toml", map).ok()?))),
        )
        .collect();
    let texts = mutated(&CORPUS, usize::MAX, &PIECES_OF_TABLES);
    answered(cases, &(texts, select(all.clone())), |(text, names)| reads(text.as_bytes(), &names));
    let bytes = prop::collection::vec(any::<u8>(), 0..300);
    answered(cases / 10, &(bytes, select(all)), |(bytes, names)| reads(&bytes, &names));
}

#[test]
fn any_log_is_answered() {
    fuzz(1000);
}

#[test]
#[ignore = "a million inputs take minutes"]
fn a_million_logs_are_answered() {
    fuzz(1_000_000);
}
