//! How an effect acts on an arm at rest.

use nalgebra::{Matrix6xX, Vector6};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Joint};

use super::{
    Carrier, Curve, Depends, Draw, Facts, Forms, Group, Law, Moves, Parameter, ParameterReport,
    Place, RobotFile, Scene, Spot, Told,
};
use crate::displacement::Displacement;
use crate::measurement::{Measurements, Row};
use crate::simulate::{Actual, Moment, Site, axis};

/// How a joint gives under its torque.
pub type Gives = Box<dyn Fn(f64) -> f64 + Send + Sync>;

/// An effect of reality at places of an arm at rest.
///
/// [`AtRest::alter`] is the exact model: the arm of a row as it is *with* the effect, to be brought
/// to rest like any other. [`AtRest::block`] is its linearisation; the fit iterates between the
/// two. What only moves its joint, or a frame, tells both at once: as [`AtRest::moves_by`], or by the joint's torque
/// as [`AtRest::gives`].
pub trait AtRest: Law {
    /// Its parameters; all zero is no effect.
    fn parameters(&self, arm: &Arm, spot: Spot) -> Vec<Parameter> {
        let Facts { parameters, moves, .. } = self.facts();
        let slides = || arm.joints[spot.row()].motion == Motion::Prismatic;
        if *moves == Moves::Joint && slides() {
            return parameters.iter().map(Parameter::of_shift).collect();
        }
        parameters.to_vec()
    }

    /// Where on this arm it may act.
    fn places(&self, arm: &Arm) -> Vec<Place> {
        self.facts().at.places(arm)
    }

    /// What such a place has that others lack; empty where all have it.
    fn acts_at(&self) -> &'static str {
        ""
    }

    /// How it moves its carrier, whatever the load: the motion per unit of each parameter; of a frame, of all six.
    fn moves_by(&self, _: &Row, _: &Moment, _: Spot, _each: &mut dyn FnMut(f64)) {}

    /// Where the effect's one number is what a joint turns by per turn of another one, or of its own reading.
    fn turns_with(&self, _joint: usize, _of: usize) -> Option<Spot> {
        None
    }

    /// How its joint gives under its torque: the motion per unit of the one parameter.
    fn gives(&self, _: &Row, _: Spot) -> Option<Gives> {
        None
    }

    /// Puts the effect with these values into the arm of a row.
    fn alter(&self, actual: &mut Actual<'_>, row: &Row, when: &Moment, spot: Spot, values: &[f64]) {
        if let Some(gives) = self.gives(row, spot) {
            let (axis, value) = (axis(actual.arm.joints[spot.row()].motion), values[0]);
            let law = move |load: &Vector6<f64>| Vector6::ith(axis, value * gives(load[axis]));
            actual.laws.push((Site::Joint(spot.row()), Box::new(law)));
            return;
        }
        let (mut each, mut sum, mut last) = (values.iter(), 0.0, 0.0);
        let mut add = |unit: f64| {
            sum += each.next().map_or(0.0, |value| value * unit);
            last = unit;
        };
        self.moves_by(row, when, spot, &mut add);
        match self.carrier(spot) {
            Some(Carrier::Joint(row)) => actual.turn(row, sum),
            Some(frame) if last != 0.0 => {
                let moved = Vector6::from_column_slice(values) * last;
                match frame {
                    Carrier::Tool => *actual.fixed_at(Site::Tool) += moved,
                    _ => actual.base *= Displacement::new(&moved).transform(),
                }
            }
            _ => {}
        }
    }

    /// Why data shows nothing of it where its block is zero everywhere.
    fn idle(&self) -> &'static str {
        self.facts().idle
    }

    // Its linearisation.

    /// What the effect moves, if that is one thing and all that it does is to move it: most effects
    /// move a joint or shift a frame, each by another law. Any other tells its [`AtRest::block`].
    fn carrier(&self, spot: Spot) -> Option<Carrier> {
        match self.facts().moves {
            Moves::Several => None,
            Moves::Joint => Some(Carrier::Joint(spot.row())),
            Moves::Base => Some(Carrier::Base),
            Moves::Tool => Some(Carrier::Tool),
        }
    }

    /// Adds how far the carrier moves per unit of each parameter; of a frame, of each six.
    fn motions(&self, scene: &Scene<'_>, spot: Spot, motions: &mut Vec<f64>) {
        match self.gives(scene.row, spot) {
            Some(gives) => motions.push(gives(scene.state.torque[spot.row()])),
            None => self.moves_by(scene.row, scene.when, spot, &mut |unit| motions.push(unit)),
        }
    }

    /// Adds the motions of several spots of one place.
    fn motions_of(&self, scene: &Scene<'_>, spots: &[Spot], motions: &mut Vec<f64>) {
        spots.iter().for_each(|spot| self.motions(scene, *spot, motions));
    }

    /// Twist of the tool, base axes, at the tool origin, per unit of each parameter, 6×p, to first
    /// order at a state of the arm.
    fn block(&self, scene: &Scene<'_>, spot: Spot) -> Matrix6xX<f64> {
        let mut motions = Vec::new();
        self.motions(scene, spot, &mut motions);
        scene.moved(self.carrier(spot), &motions)
    }

    /// Its values after a small step of what the block is told by. Numbers add up; displacements of one frame
    /// follow one another, else a fit would not find one that turns it far.
    fn stepped(&self, _: Spot, values: &[f64], step: &[f64]) -> Vec<f64> {
        values.iter().zip(step).map(|(value, step)| value + step).collect()
    }

    // Its forms.

    /// What its forms at one place are.
    fn forms_are(&self) -> Forms {
        Forms::One
    }

    /// Those that may be named where there is no data.
    fn named_forms(&self, _: &Arm, _: Place) -> Vec<usize> {
        vec![0]
    }

    /// Those that this data may show. Each is tried by itself.
    fn forms(&self, arm: &Arm, place: Place, _: &Measurements) -> Vec<usize> {
        self.named_forms(arm, place)
    }

    /// The form with all numbers of what this form leaves some out of.
    fn whole(&self, _form: usize) -> usize {
        0
    }

    // Its verdict.

    /// With what it goes, for the parts of a gap; `None` if with none of them alone.
    fn group(&self) -> Option<Group> {
        self.facts().group
    }

    /// Whether it is a matter of lengths and angles alone, the same at every load, moment and
    /// direction: what calibration would take up.
    fn is_geometry(&self) -> bool {
        self.facts().is_geometry
    }

    /// Whether it says where gravity points, which the measuring frame may say itself.
    fn tilts_gravity(&self) -> bool {
        false
    }

    /// Whether each of its numbers is held to what makers tolerate.
    fn is_tolerated(&self) -> bool {
        false
    }

    /// How many times less likely than others it is beforehand, where nothing is known of the arm.
    fn odds(&self) -> usize {
        self.facts().odds
    }

    /// Why it cannot be there at all with this data; `None` if it can.
    fn excluded(&self, _: &Measurements) -> Option<&'static str> {
        None
    }

    /// Why data that excites it may still not show it beside all of the arm's geometry.
    fn hidden(&self) -> &'static str {
        if self.depends() == Depends::Direction {
            return "always approached from one side, or so unevenly that the zero of the joint does \
                    the same";
        }
        "not distinguishable from lengths, twists, zeros and frames of the arm on these data"
    }

    /// What must be known of a row, beyond readings and load, to predict and to compensate it.
    fn depends(&self) -> Depends {
        self.facts().depends
    }

    // Its words.

    /// What reality does, in half a sentence with its size: `joint 2 has 0.3 mrad of backlash`.
    fn sentence(&self, told: &Told<'_>) -> String {
        format!("{} at {}", self.identifier().replace('_', " "), told.place)
    }

    /// The unit in which its numbers of this SI unit are shown: of a plain number, of what to what
    /// it is.
    fn shown_in<'a>(&self, unit: &'a str) -> &'a str {
        unit
    }

    /// The joint whose spring its number adds to; the spring as a whole is then told too.
    fn spring<'a>(&self, _: &'a Arm, _: Place) -> Option<&'a Joint> {
        None
    }

    /// The joint's motion as a function of one thing, if it is one.
    fn curve<'a>(&self, _: &'a [ParameterReport]) -> Option<Curve<'a>> {
        None
    }

    // Its place in a robot file.

    /// Puts its values at a spot into the file's own entries, and names them; `None` if these hold
    /// no such thing: it stands in an `[[effect]]` table then.
    fn write(&self, file: &mut RobotFile<'_>, spot: Spot, values: &[f64]) -> Option<String> {
        let parameters = self.parameters(file.arm(), spot);
        let keys = parameters.iter().map(|parameter| parameter.key);
        let values: Vec<_> = keys.zip(values.iter().copied()).collect();
        file.fold(self.identifier(), spot.place, &values)
    }

    // Its cases when it is withheld.

    /// Numbers of about the size that arms have, of one of its forms.
    fn draw(&self, from: &mut Draw<'_>) -> Vec<(String, f64)> {
        let forms = self.forms(from.arm, from.place, from.session);
        let form = if forms.len() > 1 { forms[from.below(forms.len())] } else { 0 };
        let parameters = self.parameters(from.arm, Spot { place: from.place, form });
        from.sizes(&parameters, 1.0)
    }

    /// Whether it has the size that it has, and is not made larger for a case.
    fn has_one_size(&self) -> bool {
        false
    }
}
