//! The foundation gives under load: it turns by the moment about the base's origin, and shifts by the force.
//!
//! It may turn about all axes alike. Or it rocks about x and y, each by its own; a turn about z of its own would be
//! joint 1's compliance and is left to that. Under loads that hardly change only the turn shows, which are forms of
//! their own.

use crate::effects::prelude::*;

/// Its numbers.
const ROCK_X: usize = 0;
const ROCK_Y: usize = 1;
const GIVE: usize = 2;
const ROCK: usize = 3;

/// Those of each form: all, which a file may name, and of what is sought rocking about x and y and shift, rocking alone,
/// a turn about all axes alike and shift, that turn alone.
const FORMS: [&[usize]; 5] = [
    &[ROCK_X, ROCK_Y, GIVE, ROCK],
    &[ROCK_X, ROCK_Y, GIVE],
    &[ROCK_X, ROCK_Y],
    &[ROCK, GIVE],
    &[ROCK],
];
const ROCKS: usize = 1;
const TURNS: usize = 3;

/// Rows that are looked at, and the part of a moment that tips.
const LOOKED_AT: usize = 64;
const LEAST_TIPPED: f64 = 1e-6;

/// The turn about the base's axes per moment, and shift per force.
#[derive(Clone, Copy, Debug)]
pub struct BaseCompliance;

const AT_REST: &Facts = &Facts {
    identifier: "base_compliance",
    reality: "The foundation gives under load: by the moment about the base's origin it rocks \
        about x and y, each by its own, or turns about all three axes alike, and it shifts by the \
        force.",
    signature: "The whole arm moves as one, by the load's moment about the base, however the arm \
        stands.",
    confused_with: "`bearing_compliance` at joint 1, which turns with the joint; under loads that \
        hardly change only the rocking shows.",
    separated_by: "One load with joint 1 turned through its range: the bearing's tilt turns \
        along, the rocking does not.",
    formula: "turn = (rock_x · mₓ, rock_y · m_y) + rock · m; shift = give · f",
    at: At::Base,
    idle: "no load of this data reaches the base",
    group: Some(Group::Elastic),
    ..Facts::NONE
};

impl Law for BaseCompliance {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for BaseCompliance {
    fn parameters(&self, _: &Arm, spot: Spot) -> Vec<Parameter> {
        let parameter = |number: &usize| {
            let turn = Quantity::AnglePerMoment;
            let names = [
                ("rock_x", turn),
                ("rock_y", turn),
                ("give", Quantity::LengthPerForce),
                ("rock", turn),
            ];
            let (name, quantity) = names[*number];
            Parameter::at_least(name, quantity, 0.0)
        };
        FORMS[spot.form].iter().map(parameter).collect()
    }

    /// Where no load tips the base a turn about all axes is joint 1's compliance, too.
    fn forms(&self, arm: &Arm, _: Place, data: &Measurements) -> Vec<usize> {
        (ROCKS..if is_tipped(arm, data) { FORMS.len() } else { TURNS }).collect()
    }

    fn whole(&self, form: usize) -> usize {
        if form < TURNS { form.min(ROCKS) } else { TURNS }
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, spot: Spot, v: &[f64]) {
        let each: Vector6<f64> =
            FORMS[spot.form].iter().zip(v).map(|(number, v)| *v * shape(*number)).sum();
        let law = move |w: &Vector6<f64>| each.component_mul(w);
        actual.laws.push((Site::Base, Box::new(law)));
    }

    fn block(&self, scene: &Scene<'_>, spot: Spot) -> Matrix6xX<f64> {
        let w = scene.state.load(Site::Base);
        let all = FORMS[spot.form].iter().map(|number| w.component_mul(&shape(*number)));
        scene.carried(Site::Base, &all.collect::<Vec<_>>())
    }

    /// As many turn about all axes alike as rock; none does so without a shift.
    fn draw(&self, from: &mut Draw<'_>) -> Vec<(String, f64)> {
        let form = if from.sign() < 0.0 { ROCKS } else { TURNS };
        let whole = self.parameters(from.arm, Spot { place: from.place, form });
        from.sizes(&whole, 1.0)
    }

    fn sentence(&self, _: &Told<'_>) -> String {
        "the foundation is compliant".to_owned()
    }
}

/// Whether a load of the rows, or weight, has a moment about the base's x or y.
fn is_tipped(arm: &Arm, data: &Measurements) -> bool {
    let tips = |row: &Row| {
        let state = equilibrium(arm, &row.q, &row.wrench).ok()?;
        let moment = state.load(Site::Base).fixed_rows::<3>(3).into_owned();
        Some(moment.xy().norm() > LEAST_TIPPED * moment.norm())
    };
    let every = data.rows.len().div_ceil(LOOKED_AT).max(1);
    data.rows.iter().step_by(every).any(|row| tips(row) == Some(true))
}

/// What a unit of a number does to each component of a unit load.
fn shape(number: usize) -> Vector6<f64> {
    match number {
        ROCK_X => Vector6::ith(3, 1.0),
        ROCK_Y => Vector6::ith(4, 1.0),
        GIVE => Vector6::new(1.0, 1.0, 1.0, 0.0, 0.0, 0.0),
        _ => Vector6::new(0.0, 0.0, 0.0, 1.0, 1.0, 1.0),
    }
}
