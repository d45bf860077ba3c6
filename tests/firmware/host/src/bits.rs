//! Bit for bit: what an image sends against what the host computes.

use stiffarm_firmware_arms::Real;
use stiffarm_firmware_arms::draw::COUNT;
use stiffarm_firmware_arms::outputs::{RESULTS, name};
use stiffarm_firmware_arms::record::{NOT_FINITE, Sink, UNSTABLE};
use stiffarm_firmware_arms::{everything, source, swing};

use crate::Failure;

/// What a kernel or a period gives: numbers, or one of the two refusals.
#[derive(Clone, Debug, PartialEq)]
pub enum Given<S> {
    /// Numbers.
    Numbers(Vec<S>),
    /// There is no stable equilibrium.
    Unstable,
    /// The input is not finite.
    NotFinite,
}

/// Every result of a run, in its order.
pub struct Results<S>(pub Vec<Given<S>>);

/// How many results the kernels have, and how many the loops.
const KERNELS: usize = COUNT as usize * RESULTS;
const SET_POINTS: usize = source::PERIODS as usize;
const LOOPS: usize = SET_POINTS + swing::PERIODS as usize;

impl<S: Real> Sink for Results<S> {
    fn word(&mut self, word: u32) {
        self.0.push(match word {
            UNSTABLE => Given::Unstable,
            NOT_FINITE => Given::NotFinite,
            length => Given::Numbers(Vec::with_capacity(length as usize)),
        });
    }

    fn number<T: Real>(&mut self, number: T) {
        if let Some(Given::Numbers(numbers)) = self.0.last_mut() {
            numbers.push(S::from_bytes(number.bytes()));
        }
    }
}

impl<S: Real> Results<S> {
    /// What the host computes.
    pub fn of_the_host() -> Self {
        let mut results = Results(Vec::with_capacity(KERNELS + LOOPS));
        everything::write::<S>(&mut results);
        results
    }

    /// What an image sent.
    pub fn read(mut bytes: &[u8]) -> Result<Self, Failure> {
        let mut results = Results(Vec::with_capacity(KERNELS + LOOPS));
        while let Some((word, rest)) = bytes.split_first_chunk() {
            bytes = rest;
            let word = u32::from_le_bytes(*word);
            results.word(word);
            let Some(Given::Numbers(numbers)) = results.0.last_mut() else { continue };
            for _ in 0..word {
                let (number, rest) = bytes
                    .split_at_checked(S::BYTES)
                    .ok_or("what the image sent ends within a result")?;
                let mut eight = [0; 8];
                eight[..S::BYTES].copy_from_slice(number);
                numbers.push(S::from_bytes(eight));
                bytes = rest;
            }
        }
        Ok(results)
    }

    /// Whether there are as many results as kernels and periods, and among them refusals of both
    /// kinds and all numbers of every other result.
    pub fn are_whole(&self, with_loops: bool) -> Result<(), Failure> {
        let expected = if with_loops { KERNELS + LOOPS } else { KERNELS };
        if self.0.len() != expected {
            return Err(format!("{} results, expected {expected}", self.0.len()));
        }
        if !self.0.contains(&Given::Unstable) {
            return Err("no load is refused as unstable: the draws do not try it".to_owned());
        }
        if with_loops && !self.0[KERNELS..].contains(&Given::NotFinite) {
            return Err("the loop refuses no reading: its source breaks none".to_owned());
        }
        Ok(())
    }

    /// How many numbers there are.
    pub fn count(&self) -> usize {
        let numbers = |given: &Given<S>| match given {
            Given::Numbers(numbers) => numbers.len(),
            Given::Unstable | Given::NotFinite => 0,
        };
        self.0.iter().map(numbers).sum()
    }

    /// Results alone of the kernels, without the loops'.
    pub fn of_kernels(&self) -> Self {
        Results(self.0[..KERNELS].to_vec())
    }

    /// The first place where the two differ in a bit. Which NaN a NaN is does not count: that is
    /// the processor's choice.
    pub fn difference(&self, other: &Self) -> Option<String> {
        if self.0.len() != other.0.len() {
            return Some(format!("{} results against {}", self.0.len(), other.0.len()));
        }
        let at = self.0.iter().zip(&other.0).position(|(a, b)| !same(a, b))?;
        let (here, there) = (self.0[at].show(), other.0[at].show());
        Some(format!("{}:\n  {here}\n  {there}", place(at)))
    }

    /// The same results with the last bit of one number turned over: what the comparison has to
    /// find.
    pub fn tampered(&self) -> Self {
        let mut results = Results(self.0.clone());
        let late = results.0.len() / 2;
        let number = results.0[late..].iter_mut().find_map(|given| match given {
            Given::Numbers(numbers) => numbers.iter_mut().find(|x| x.is_finite()),
            Given::Unstable | Given::NotFinite => None,
        });
        if let Some(number) = number {
            let mut bytes = number.bytes();
            bytes[0] ^= 1;
            *number = S::from_bytes(bytes);
        }
        results
    }
}

impl<S: Real> Given<S> {
    fn show(&self) -> String {
        let hex = |x: &S| {
            let bytes: Vec<String> =
                x.bytes()[..S::BYTES].iter().rev().map(|byte| format!("{byte:02x}")).collect();
            bytes.concat()
        };
        match self {
            Given::Numbers(numbers) => numbers.iter().map(hex).collect::<Vec<_>>().join(" "),
            Given::Unstable => "unstable".to_owned(),
            Given::NotFinite => "not finite".to_owned(),
        }
    }
}

fn same<S: Real>(a: &Given<S>, b: &Given<S>) -> bool {
    match (a, b) {
        (Given::Numbers(a), Given::Numbers(b)) => {
            let one = |(a, b): (&S, &S)| a.bytes() == b.bytes() || a.is_nan() && b.is_nan();
            a.len() == b.len() && a.iter().zip(b).all(one)
        }
        (Given::Unstable, Given::Unstable) | (Given::NotFinite, Given::NotFinite) => true,
        _ => false,
    }
}

/// What a result is of.
fn place(at: usize) -> String {
    let (output, arm) = name(at % RESULTS);
    match at.checked_sub(KERNELS) {
        None => format!("draw {}, {output} of {arm}", at / RESULTS),
        Some(period @ ..SET_POINTS) => format!("period {period} of the set-points"),
        Some(period) => format!("period {} of the computed torques", period - SET_POINTS),
    }
}
