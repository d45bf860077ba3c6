//! Medians of many rounds, all candidates in turn in each round, so that what disturbs the machine
//! disturbs all of them. Ratios are what counts; the nanoseconds are this machine's.

use std::hint::black_box;
use std::time::Instant;

/// Poses whose results are kept.
const KEPT: usize = 64;

/// Something that works through all poses once.
pub struct Candidate<'a> {
    /// Its column.
    pub name: &'static str,
    /// Poses worked through in one run.
    pub poses: usize,
    /// The work.
    pub run: Box<dyn FnMut() + 'a>,
}

impl<'a> Candidate<'a> {
    /// Work through `poses` poses.
    pub fn run(name: &'static str, poses: usize, run: impl FnMut() + 'a) -> Self {
        Candidate { name, poses, run: Box::new(run) }
    }

    /// Calls `f` for every pair of inputs and stores what it returns; each input holds `lanes` poses. The
    /// results of 64 poses are written over and over, so that they stay in the first cache: it is the
    /// work that is timed and not the memory.
    pub fn new<Q, W, T: Clone + 'a>(
        name: &'static str,
        lanes: usize,
        (q, w): (&'a [Q], &'a [W]),
        f: impl Fn(&Q, &W) -> T + 'a,
    ) -> Self {
        let first = f(&q[0], &w[0]);
        Candidate::writing(name, lanes, (q, w), first, move |q, w, out| *out = f(q, w))
    }

    /// The same of what writes its result; `first` is any.
    pub fn writing<Q, W, T: Clone + 'a>(
        name: &'static str,
        lanes: usize,
        (q, w): (&'a [Q], &'a [W]),
        first: T,
        f: impl Fn(&Q, &W, &mut T) + 'a,
    ) -> Self {
        let kept = KEPT / lanes;
        let mut out = vec![first; kept];
        let run = move || {
            for (q, w) in q.chunks(kept).zip(w.chunks(kept)) {
                for ((q, w), out) in q.iter().zip(w).zip(&mut out) {
                    f(q, w, out);
                }
                black_box(&mut out);
            }
        };
        Candidate { name, poses: lanes * q.len(), run: Box::new(run) }
    }

    /// Calls `f` pose by pose, each call with the first angle of its pose changed by zero times what the
    /// call before gave (`one` of its entries), so that none begins before the last has ended.
    pub fn serial<const N: usize, T: 'a>(
        name: &'static str,
        (q, w): (&'a [[f64; N]], &'a [[f64; 6]]),
        f: impl Fn(&[f64; N], &[f64; 6]) -> T + 'a,
        one: impl Fn(&T) -> f64 + 'a,
    ) -> Self {
        let run = move || {
            let mut last = 0.0;
            for (q, w) in q.iter().zip(w) {
                let mut q = *q;
                q[0] += 0.0 * last;
                let result = f(&q, w);
                last = one(black_box(&result));
            }
            black_box(last);
        };
        Candidate { name, poses: q.len(), run: Box::new(run) }
    }
}

/// Median nanoseconds per pose of each candidate.
pub fn medians(candidates: &mut [Candidate<'_>], rounds: usize) -> Vec<f64> {
    let mut times = vec![Vec::with_capacity(rounds); candidates.len()];
    for round in 0..=rounds {
        for (candidate, times) in candidates.iter_mut().zip(&mut times) {
            let start = Instant::now();
            (candidate.run)();
            let time = start.elapsed().as_secs_f64();
            // The first round warms up.
            if round > 0 {
                times.push(1e9 * time / candidate.poses as f64);
            }
        }
    }
    let median = |mut times: Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    };
    times.into_iter().map(median).collect()
}

/// One row: the output, the first candidate's nanoseconds, and how many times that the others take.
pub fn print(row: &str, candidates: &mut [Candidate<'_>], rounds: usize) {
    let medians = medians(candidates, rounds);
    print!("  {row:<24}");
    for (candidate, median) in candidates.iter().zip(&medians) {
        print!("  {} {median:.1} ({:.2})", candidate.name, median / medians[0]);
    }
    println!();
}
