//! What sets effects apart: their forms, what they go with, what they depend on.

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
    /// Numbers of rows after which something happens: a search begins with some of them, goes on
    /// to all between, and reports the one that it ends with.
    Rows,
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
            Forms::Rows => Some("after"),
            Forms::Numbers(key) => Some(key),
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
