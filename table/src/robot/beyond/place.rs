//! Where an effect acts.

use std::fmt;
use std::str::FromStr;

/// Where an effect acts; numbers count from 1 at the base, as they are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Place {
    /// A joint.
    Joint(usize),
    /// A link, that is a row of the table.
    Link(usize),
    /// The base.
    Base,
    /// The tool.
    Tool,
    /// The arm as a whole.
    Arm,
    /// The measuring instrument.
    Instrument,
    /// A motor that turns with the sum of two joints' values (1) or with their difference (−1).
    Pair(usize, usize, i8),
    /// What the tool holds in a run of a log.
    Held(usize),
    /// Between the controller and the arm.
    Interface,
}

impl Place {
    /// Row of the table, from 0; the first for what is not at a row.
    pub fn row(self) -> usize {
        match self {
            Place::Joint(number) | Place::Link(number) | Place::Pair(number, ..) => {
                number.saturating_sub(1)
            }
            _ => 0,
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Joint(i) => write!(f, "joint {i}"),
            Place::Link(i) => write!(f, "link {i}"),
            Place::Base => f.write_str("base"),
            Place::Tool => f.write_str("tool"),
            Place::Arm => f.write_str("arm"),
            Place::Instrument => f.write_str("instrument"),
            Place::Pair(a, b, sum) => {
                write!(f, "joints {a} {} {b}", if *sum > 0 { "+" } else { "−" })
            }
            Place::Held(run) => write!(f, "the tool in run {run}"),
            Place::Interface => f.write_str("the interface"),
        }
    }
}

/// Reads what [`Place`] prints of an arm at rest; spaces are as you like.
impl FromStr for Place {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        let text: String = text.split_whitespace().collect();
        let number = |prefix: &str| -> Option<usize> {
            text.strip_prefix(prefix)?.parse().ok().filter(|number| *number > 0)
        };
        let numbered =
            number("joint").map(Place::Joint).or_else(|| number("link").map(Place::Link));
        let named = [Place::Base, Place::Tool, Place::Arm, Place::Instrument];
        numbered.or_else(|| named.into_iter().find(|p| p.to_string() == text)).ok_or(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_print_as_the_format_has_them() {
        assert_eq!(Place::Joint(2).to_string(), "joint 2");
        assert_eq!(Place::Link(3).to_string(), "link 3");
        assert_eq!(Place::Instrument.to_string(), "instrument");
        for place in [Place::Joint(12), Place::Link(1), Place::Base, Place::Arm] {
            assert_eq!(place.to_string().parse(), Ok(place));
        }
        assert_eq!(("joint3".parse(), "joint 0".parse::<Place>()), (Ok(Place::Joint(3)), Err(())));
        assert_eq!((Place::Link(3).row(), Place::Base.row()), (2, 0));
    }
}
