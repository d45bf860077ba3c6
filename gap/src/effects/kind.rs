//! What sets effects apart: their forms, what they go with, what they depend on.

use stiffarm_kernels::generic::Arm;

use super::Quantity;

/// The largest order of a periodic effect.
pub const MOST_ORDERS: usize = 1000;

/// What the forms of an effect at one place are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Forms {
    /// There is one, 0, or there are others that leave out some of its numbers.
    One,
    /// The other joints, from 0.
    Joints,
    /// Orders of something periodic: several are found at once, and each is told by its parameters'
    /// names (`cos 2`).
    Orders {
        /// From this one on an order is so particular that nothing else comes near to it.
        fine: usize,
    },
    /// Steps of a number in which nothing is linear: a search begins with some of them, goes on to
    /// all between, and reports the one that it ends with.
    Searched {
        /// What the number is called.
        key: &'static str,
        /// Of what kind it is.
        quantity: Quantity,
        /// Steps in one SI unit.
        steps: usize,
    },
    /// Any other numbers, called so.
    Numbers(&'static str),
}

impl Forms {
    /// What a form is called where it stands beside the parameters' keys.
    pub fn key(self) -> Option<&'static str> {
        match self {
            Forms::One => None,
            Forms::Joints => Some("joint"),
            Forms::Orders { .. } => Some("order"),
            Forms::Searched { key, .. } | Forms::Numbers(key) => Some(key),
        }
    }

    /// The number that stands for a form in files and options.
    pub fn number(self, form: usize) -> f64 {
        match self {
            Forms::Joints => (form + 1) as f64,
            Forms::Searched { steps, .. } => form as f64 / steps as f64,
            _ => form as f64,
        }
    }

    /// The form that a number stands for; `None` if it is none.
    pub fn form(self, number: f64) -> Option<usize> {
        let least = if matches!(self, Forms::One | Forms::Numbers(_)) { 0.0 } else { 1.0 };
        let number = match self {
            Forms::Searched { steps, .. } => {
                let (number, whole) = (number * steps as f64, (number * steps as f64).round());
                // A decimal number times the steps is rounded.
                if (number - whole).abs() <= 4.0 * f64::EPSILON * whole { whole } else { number }
            }
            _ => number,
        };
        let is_one = number.fract() == 0.0 && (least..1e9).contains(&number);
        let form = if self == Forms::Joints { number - 1.0 } else { number };
        is_one.then_some(form as usize)
    }

    /// What its number has to be, as a message says it.
    pub fn expected(self, arm: &Arm) -> String {
        match self {
            Forms::Joints => format!("another joint, 1 to {}", arm.dof()),
            Forms::Orders { .. } => format!("an order of 1 to {MOST_ORDERS}"),
            Forms::Searched { steps: 1, .. } => "the row after which it happens".to_owned(),
            Forms::Searched { quantity, steps, .. } => {
                format!("more than 0 and a multiple of {} {}", 1.0 / steps as f64, quantity.unit())
            }
            Forms::One | Forms::Numbers(_) => "a whole number".to_owned(),
        }
    }

    /// Whether a form is so particular that it need not be held against other effects.
    pub fn is_fine(self, form: usize) -> bool {
        matches!(self, Forms::Orders { fine } if form >= fine)
    }

    /// The order in a parameter's name, `cos 14`.
    pub(crate) fn order_of(self, name: &str) -> Option<usize> {
        let Forms::Orders { .. } = self else { return None };
        let order = name.rsplit_once(' ')?.1.parse().ok()?;
        (1..=MOST_ORDERS).contains(&order).then_some(order)
    }
}

/// With what an effect goes: the parts in which a gap is taken apart, in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// The same at every load, moment and direction.
    Constant,
    /// In proportion to the load.
    Elastic,
    /// With the load, and not in proportion.
    Nonlinear,
    /// With the direction or length of the last move.
    Direction,
    /// With time or temperature.
    Time,
}

impl Group {
    /// All of them.
    pub const ALL: [Group; 5] =
        [Group::Constant, Group::Elastic, Group::Nonlinear, Group::Direction, Group::Time];

    /// As a diagnosis calls its part of the gap.
    pub fn name(self) -> &'static str {
        match self {
            Group::Constant => "constant with load",
            Group::Elastic => "linear in load",
            Group::Nonlinear => "nonlinear in load",
            Group::Direction => "direction-dependent",
            Group::Time => "with time or temperature",
        }
    }
}

/// What must be known, beyond readings and load, for an effect to be predicted and compensated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depends {
    /// Nothing.
    Posture,
    /// From where each joint comes to rest.
    Direction,
    /// How warm the arm is, against the first row.
    Temperature,
    /// The posture before.
    LastMove,
    /// When in its session it was measured: what happened at a time is carried to no other session.
    Session,
}

impl Depends {
    /// Whether it is told by the order in which rows were measured: errors that linger look like it.
    pub fn follows_time(self) -> bool {
        matches!(self, Depends::Temperature | Depends::LastMove | Depends::Session)
    }
}
