//! Where an arm rests in a joint log: the postures of a recording that went on while it was moved and held.

use crate::io::Fault;
use crate::log::{Log, Run, Signal};
use stiffarm_kernels::Motion;

/// Joints that stay within so much, rad or m, are at rest: a hand that holds a ball in its socket moves them by less, and
/// an arm that goes anywhere by more in a few milliseconds. Their mean is nearer by far.
const STILL: f64 = 2e-3;

/// A table of the postures in which an arm rests for so long, s, a row each: the mean of the middle half of the rest.
///
/// # Errors
/// [`Fault`]: it never rests so long.
pub fn rests(log: &Log, motions: &[Motion], hold: f64) -> Result<String, Fault> {
    let unit = |motion: &Motion| if *motion == Motion::Revolute { "rad" } else { "m" };
    let named =
        motions.iter().enumerate().map(|(k, motion)| format!("q{}[{}]", k + 1, unit(motion)));
    let mut text = format!("time[s],{}\n", named.collect::<Vec<_>>().join(","));
    let mut count = 0;
    for run in &log.runs {
        for (first, last) in of_run(run, hold) {
            let quarter = (last - first) / 4;
            let middle = first + quarter..last - quarter;
            let mean = |of: &[f64]| of[middle.clone()].iter().sum::<f64>() / middle.len() as f64;
            let cells = core::iter::once(&run.t).chain(&run.signals[&Signal::Q]).map(|of| mean(of));
            text += &cells.map(|x| x.to_string()).collect::<Vec<_>>().join(",");
            text.push('\n');
            count += 1;
        }
    }
    if count == 0 {
        let found =
            format!("no rest of {hold} s in which every joint stays within {STILL} rad or m");
        let help = "hold each posture for longer, or give a shorter one by --still";
        return Err(Fault::new(found, "postures that are held", help));
    }
    Ok(text)
}

/// The samples of each rest, from one to before another.
fn of_run(run: &Run, hold: f64) -> Vec<(usize, usize)> {
    let joints = &run.signals[&Signal::Q];
    let mut rests = Vec::new();
    let mut first = 0;
    let mut ranges: Vec<[f64; 2]> = Vec::new();
    for now in 0..=run.t.len() {
        let stays = now < run.t.len() && {
            ranges.resize(joints.len(), [f64::INFINITY, f64::NEG_INFINITY]);
            for ([low, high], q) in ranges.iter_mut().zip(joints) {
                (*low, *high) = (low.min(q[now]), high.max(q[now]));
            }
            ranges.iter().all(|[low, high]| high - low <= STILL)
        };
        if stays {
            continue;
        }
        if now > first && run.t[now - 1] - run.t[first] >= hold {
            rests.push((first, now));
        }
        first = now;
        ranges.clear();
        if let Some(q) = joints.iter().map(|q| q.get(now).copied()).collect::<Option<Vec<f64>>>() {
            ranges.extend(q.iter().map(|q| [*q; 2]));
        }
    }
    rests
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::log::Names;

    /// A joint that goes from one posture to the next, trembles there by half a milliradian, and goes on.
    fn log(held: f64) -> Log {
        let (step, motion) = (0.01, 1.0);
        let mut text = "t[s],q1[rad],q2[m]\n".to_owned();
        let mut t = 0.0_f64;
        for posture in 0..4 {
            let (here, next) = (0.4 * f64::from(posture), 0.4);
            let mut at = 0.0;
            while at < held + motion {
                let part = ((at - held) / motion).max(0.0);
                let tremble = 5e-4 * (7.0 * t).sin();
                let q = here + next * part + tremble;
                text += &format!("{t},{q},{}\n", 0.1 * q);
                (at, t) = (at + step, t + step);
            }
        }
        let names = Names::default().of_motion();
        let motions = [Motion::Revolute, Motion::Prismatic];
        Log::from_bytes("log.csv", text.as_bytes(), &motions, &names).expect("a log")
    }

    #[test]
    fn a_row_is_made_of_each_rest() {
        let motions = [Motion::Revolute, Motion::Prismatic];
        let text = rests(&log(2.0), &motions, 0.5).expect("rests");
        let rows: Vec<Vec<f64>> = (text.lines().skip(1))
            .map(|line| line.split(',').map(|cell| cell.parse().expect("a number")).collect())
            .collect();
        assert_eq!(text.lines().next(), Some("time[s],q1[rad],q2[m]"));
        assert_eq!(rows.len(), 4, "{text}");
        for (posture, row) in rows.iter().enumerate() {
            let was = 0.4 * posture as f64;
            assert!((row[1] - was).abs() < 5e-4 && (row[2] - 0.1 * was).abs() < 5e-5, "{row:?}");
        }
        let error = rests(&log(0.2), &motions, 0.5).unwrap_err().to_string();
        assert!(error.contains("no rest of 0.5 s"), "{error}");
    }
}
