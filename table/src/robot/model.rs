//! What a robot file or an inline table says: one model for both, in SI units.

use core::ops::Range;

use num_rational::Ratio;
pub use stiffarm_kernels::{Convention, Motion, Output};

use super::beyond::Beyond;
use super::closed_form::{ClosedForm, Redundancy};
use super::nearest::STEPPED;
use crate::number::Number;

/// A serial arm as its Denavit-Hartenberg table describes it.
#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    /// The arm's name, as its maker or paper writes it.
    pub name: String,
    /// Which of the two Denavit-Hartenberg conventions the rows follow.
    pub convention: Convention,
    /// Gravity in base axes, m/s².
    pub gravity: [Value; 3],
    /// Where the torques of a log of it are measured: `motor`, `link`, `current`, `commanded` or `external`;
    /// `None` where the file does not say.
    pub torque_side: Option<&'static str>,
    /// The rows of the table, base to tip.
    pub joints: Vec<Joint>,
    /// The fixed transform from the world, in which poses are told, to frame 0; the identity if the
    /// file has none.
    pub base: Frame,
    /// The fixed transform from the last frame to the tool; the identity if the file has none.
    pub tool: Frame,
    /// Frames with names, on any link.
    pub frames: Vec<NamedFrame>,
    /// Measured points other than the tool origin.
    pub markers: Vec<Marker>,
    /// What the real arm does beyond the table.
    pub effects: Vec<Effect>,
    /// The same as kernels understand it, where they are to be made of it: [`Robot::with_effects`].
    pub beyond: Beyond,
    /// Loads that rows of data name.
    pub payloads: Vec<Payload>,
    /// The outputs that are generated of its tool; every one if there are none.
    pub outputs: Vec<Output>,
    /// The outputs that are generated of named frames and markers.
    pub at: Vec<At>,
    /// What of seven joints its inverse kinematics is given, where that is chosen.
    pub redundancy: Option<Redundancy>,
    /// The closed form of its inverse kinematics, where that is generated: its table's or the nearest table's.
    pub inverse_kinematics: Option<ClosedForm>,
}

/// One row of the table, with what hangs on it; by default a revolute joint of which nothing is told.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Joint {
    /// The row's label (`a2`); `joint 2` where the table gives none.
    pub name: String,
    /// Revolute or prismatic.
    pub motion: Motion,
    /// For a revolute joint the offset added to `q`, rad.
    pub theta: Angle,
    /// For a prismatic joint the offset added to `q`, m.
    pub d: Value,
    /// The common normal's length, m.
    pub a: Value,
    /// The twist, rad.
    pub alpha: Angle,
    /// Hayati's angle about y behind the twist, rad; 0 in a table of Denavit and Hartenberg's.
    pub beta: Angle,
    /// N·m/rad, or N/m for a prismatic joint; `None` is rigid.
    pub stiffness: Option<Value>,
    /// Mass of the link that this joint moves, kg; `None` is weightless.
    pub mass: Option<Value>,
    /// Its centre of mass in the row's own frame, m.
    pub com: [Value; 3],
    /// Its moments of inertia about that centre in the row's own axes: xx, xy, xz, yy, yz, zz of the
    /// tensor, kg·m²; `None` is a point mass.
    pub inertia: Option<[Value; 6]>,
    /// What turns the joint, and what holds it back.
    pub drive: Drive,
    /// Joint limits, rad or m.
    pub limits: Option<[f64; 2]>,
    /// Where the row's numbers come from.
    pub source: Option<String>,
    /// The link as a beam from the previous frame's origin to this one's.
    pub beam: Option<Beam>,
}

/// Motor, gear and friction of a joint.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drive {
    /// Turns of the motor per turn of the joint; rad/m of a prismatic joint. `None` is 1.
    pub gear: Option<Value>,
    /// Moment of inertia of all that turns with the motor, at the motor, kg·m².
    pub rotor_inertia: Option<Value>,
    /// Friction that knows the direction alone, at the joint: N·m, N of a prismatic joint.
    pub coulomb: Option<Value>,
    /// Friction in proportion to the rate, at the joint: N·m·s/rad, N·s/m of a prismatic joint.
    pub viscous: Option<Value>,
}

/// A prismatic elastic beam.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Beam {
    /// E, Pa.
    pub youngs_modulus: Value,
    /// G, Pa.
    pub shear_modulus: Value,
    /// The cross-section's constants.
    pub section: Section,
    /// kg/m³; `None` is weightless.
    pub density: Option<Value>,
    /// Timoshenko's shear coefficient κ; `None` neglects shear (Euler-Bernoulli).
    pub shear_coefficient: Option<Value>,
}

/// A cross-section: area and second moments. The beam's x runs along the chord between the two
/// frame origins; z is the part of the previous joint's axis that is perpendicular to the chord
/// (the plane in which that joint swings the link is then the x-y plane, bent about z).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Section {
    /// A, m².
    pub area: Value,
    /// Second moment about the beam's y axis, m⁴.
    pub iy: Value,
    /// Second moment about the beam's z axis, m⁴.
    pub iz: Value,
    /// Torsion constant, m⁴.
    pub j: Value,
}

/// A fixed transform: translation, then rotation, in the frame that it begins in.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// The origin that it leads to, m.
    pub translation: [Value; 3],
    /// Rotation vector (axis × angle).
    pub rotation: [Angle; 3],
}

/// A frame with a name, fixed in the frame of a row as a link's mass is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NamedFrame {
    /// Its name, which becomes a module's.
    pub name: String,
    /// The row, from 0.
    pub row: usize,
    /// The frame in the row's own; numbers, no parameters.
    pub frame: Frame,
}

/// An output of a named frame or a marker: that of the arm whose tool is there.
#[derive(Clone, Debug, PartialEq)]
pub struct At {
    /// The name of the frame or of the marker.
    pub place: String,
    /// The output.
    pub output: Output,
}

/// A measured point on the tool.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Marker {
    /// The name that measurement files use.
    pub name: String,
    /// In the tool frame, m; `None` is unknown.
    pub translation: Option<[Value; 3]>,
}

/// What the real arm does beyond the table: an effect of a catalogue at a place, with its numbers.
/// The catalogue is another package's: this is what stands in the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Effect {
    /// Where the table stands.
    pub at: Spot,
    /// The catalogue's name for it.
    pub id: Entry<String>,
    /// Where it acts: `joint 2`.
    pub place: Entry<String>,
    /// Everything else that the table holds, in the order of its keys.
    pub numbers: Vec<Entry<Quantity>>,
}

/// A key with its value.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry<T> {
    /// The key.
    pub key: String,
    /// The value.
    pub value: T,
    /// Where the value stands.
    pub at: Spot,
}

/// What an entry of an effect holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Quantity {
    /// In SI units.
    Si(f64),
    /// A number with its unit, or a word, as it stands.
    Text(String),
}

/// A place in a robot file. Two robots are equal wherever their entries stand: so are two places.
#[derive(Clone, Debug, Default)]
pub struct Spot {
    /// Bytes of the file.
    pub span: Range<usize>,
    /// The line of the first of them, from 1; 0 of what stands in no file.
    pub line: usize,
}

impl PartialEq for Spot {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// A load that rows of data name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Payload {
    /// Its name.
    pub name: String,
    /// kg.
    pub mass: Value,
    /// Its centre of mass in the tool frame, m.
    pub com: [Value; 3],
    /// Its moments of inertia about that centre in the tool's axes, as a link's; `None` is a point mass.
    pub inertia: Option<[Value; 6]>,
}

/// A number in SI units, or a parameter that stays symbolic.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Value {
    /// Known when the code is generated.
    Number(Number),
    /// A field of the generated `Parameters`.
    Symbol(String),
}

/// An angle: an exact multiple of π, a number of radians, or a symbolic parameter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Angle {
    /// `r·π`, exactly.
    Pi(Ratio<i64>),
    /// Radians that are no simple multiple of π.
    Radians(Number),
    /// A field of the generated `Parameters`.
    Symbol(String),
}

impl Value {
    /// Zero.
    pub const ZERO: Value = Value::Number(Number::ZERO);

    /// Whether the value is known to be exactly zero.
    pub fn is_zero(&self) -> bool {
        matches!(self, Value::Number(n) if n.is_zero())
    }

    /// The number, unless the value is symbolic.
    pub fn number(&self) -> Option<Number> {
        match self {
            Value::Number(n) => Some(*n),
            Value::Symbol(_) => None,
        }
    }

    /// The number as a double; a symbol counts as zero.
    pub fn or_zero(&self) -> f64 {
        self.number().map_or(0.0, Number::to_f64)
    }
}

impl Angle {
    /// Zero.
    pub const ZERO: Angle = Angle::Pi(Ratio::new_raw(0, 1));

    /// Whether the angle is known to be exactly zero.
    pub fn is_zero(&self) -> bool {
        match self {
            Angle::Pi(r) => *r.numer() == 0,
            Angle::Radians(n) => n.is_zero(),
            Angle::Symbol(_) => false,
        }
    }

    /// The angle in radians; a symbol counts as zero.
    pub fn or_zero(&self) -> f64 {
        self.radians().unwrap_or_default()
    }

    /// The angle in radians, unless it is symbolic.
    pub fn radians(&self) -> Option<f64> {
        match self {
            Angle::Pi(r) => Some(*r.numer() as f64 * core::f64::consts::PI / *r.denom() as f64),
            Angle::Radians(n) => Some(n.to_f64()),
            Angle::Symbol(_) => None,
        }
    }
}

impl Default for Robot {
    /// A robot without joints, under standard gravity.
    fn default() -> Self {
        let down = Value::Number(Number::ratio(-980_665, 100_000));
        Robot {
            name: String::new(),
            convention: Convention::Standard,
            gravity: [Value::ZERO, Value::ZERO, down],
            torque_side: None,
            joints: Vec::new(),
            base: Frame::default(),
            tool: Frame::default(),
            frames: Vec::new(),
            markers: Vec::new(),
            effects: Vec::new(),
            beyond: Beyond::default(),
            payloads: Vec::new(),
            outputs: Vec::new(),
            at: Vec::new(),
            redundancy: None,
            inverse_kinematics: None,
        }
    }
}

impl Default for Value {
    fn default() -> Self {
        Value::ZERO
    }
}

impl Default for Angle {
    fn default() -> Self {
        Angle::ZERO
    }
}

impl Robot {
    /// Number of joints.
    pub fn dof(&self) -> usize {
        self.joints.len()
    }

    /// What is generated, each output once, in the order of [`Output::EACH`]: what is asked for, or else
    /// every output but those that are [on request](Output::is_on_request), those of dynamics where the file says of
    /// some link more than its mass. The steps behind the closed form of another table take pose and Jacobian.
    pub fn generated(&self) -> Vec<Output> {
        let moves = self.joints.iter().any(|joint| joint.inertia.is_some());
        let exact = self.is_as_its_table() && self.closed_form().is_ok();
        let steps = self.inverse_kinematics.is_some() && !exact;
        let stepped = |output: &Output| steps && STEPPED.contains(output);
        let asked = |output: &Output| match self.outputs.as_slice() {
            [] => !output.is_on_request() && (moves || !output.is_of_motion()),
            asked => asked.contains(output) || stepped(output),
        };
        Output::EACH.into_iter().filter(asked).collect()
    }
}
