//! What a robot file says of the arm in motion beyond its table: `[[effect]]` tables of the effects of logs.
//!
//! A table is one of motion if its identifier is in the catalogue of logs, its place is one of theirs and its
//! keys are that effect's numbers: a coupling is told from that at rest by them. Backlash is both.

use stiffarm_table::robot::{Effect as Table, Entry, Quantity as Given};

use super::model::Acting;
use super::scene::Domain;
use crate::effects::{
    self as files, IN_MOTION, InMotion, KnownError, Parameter, Quantity, Spot, advice, si,
};

/// Whether a table is of motion. Arms have no more joints than places are compared with.
pub fn is_of_motion(table: &Table) -> bool {
    effects(table).next().is_some() && spot(table, MOST).is_some()
}

/// Whether a table is of what drives the joints.
pub fn is_of_torques(table: &Table) -> bool {
    effects(table).any(|effect| effect.domain() == Domain::Torque)
}

/// More joints no table has.
const MOST: usize = 64;

/// What the tables of an arm of so many joints say of these rows; others are left out.
///
/// # Errors
/// What is wrong with a table, and its line.
pub fn terms(tables: &[Table], joints: usize, rows: Domain) -> Result<Vec<Acting>, KnownError> {
    let mut terms = Vec::new();
    for table in tables {
        let Some(effect) = effects(table).find(|e| e.domain() == rows) else { continue };
        let spot = spot(table, joints).ok_or_else(|| {
            let (found, id) = (&table.place.value, &table.id.value);
            let places: Vec<String> = Spot::all(joints).iter().map(Spot::to_string).collect();
            let help = advice(found, places.iter().map(String::as_str));
            KnownError::new(&table.place.at, format!("`{found}` is no place of {id}"), help)
        })?;
        let value = |parameter: &Parameter| {
            let mut told = table.numbers.iter().filter_map(|entry| {
                let (it, times) = effect.number(&entry.key)?;
                (it.key == parameter.key).then_some((entry, times))
            });
            let value = |(entry, times)| Ok(times * number(entry, parameter.quantity)?);
            told.next().map_or(Ok(0.0), value)
        };
        let values: Vec<f64> = effect.parameters().iter().map(value).collect::<Result<_, _>>()?;
        if !effect.is_feasible(&values) {
            let message = format!(
                "found {values:?}, expected numbers that such a thing as {} may have",
                table.id.value
            );
            return Err(KnownError::new(&table.at, message, None));
        }
        terms.push(Acting { effect, spot, values });
    }
    Ok(terms)
}

/// A number in SI, or with its unit where it is of a kind of which others are known.
fn number(entry: &Entry<Given>, quantity: Quantity) -> Result<f64, KnownError> {
    match (&entry.value, quantity) {
        (Given::Si(value), _) if value.is_finite() => Ok(*value),
        (Given::Text(_), quantity) if !matches!(quantity, Quantity::In(_)) => si(entry, quantity),
        _ => {
            let unit = quantity.unit();
            let message = format!("`{}` is no number in {unit}", entry.key);
            let help = format!("write it as a number without a unit, in {unit}");
            Err(KnownError::new(&entry.at, message, Some(help)))
        }
    }
}

/// The table that says a term.
pub fn table(term: &Acting) -> Table {
    let numbers = term.effect.parameters().iter().zip(&term.values);
    let numbers = numbers.map(|(parameter, value)| (parameter.key, Given::Si(*value)));
    files::table(term.effect.identifier(), &term.spot, numbers)
}

/// The effects of a table: those of its identifier that have all its keys, one for torques and one for positions of
/// a latency. A zero is in the angles of the arm already.
fn effects(table: &Table) -> impl Iterator<Item = &'static dyn InMotion> {
    let is = move |effect: &&'static dyn InMotion| {
        effect.identifier() == table.id.value
            && !effect.facts().is_geometry
            && table.numbers.iter().all(|entry| effect.number(&entry.key).is_some())
    };
    IN_MOTION.iter().copied().filter(is)
}

/// The place that is printed so.
fn spot(table: &Table, joints: usize) -> Option<Spot> {
    Spot::all(joints).into_iter().find(|spot| spot.to_string() == table.place.value)
}

#[cfg(test)]
mod tests {
    use stiffarm_table::robot::Robot;

    use super::*;
    use crate::effects::{AtRest, Catalogue, Depends};

    /// What an `[[effect]]` of an arm of two joints says in these rows.
    fn said(effect: &str, rows: Domain) -> Result<Vec<(String, Vec<f64>)>, String> {
        let text = format!(
            "name = \"arm\"\nconvention = \"standard\"\n[[joint]]\ntype = \"revolute\"\na = 1\n\
             [[joint]]\ntype = \"revolute\"\na = 1\n[[effect]]\n{effect}"
        );
        let (robot, _) = Robot::from_toml(&text, "arm.toml").unwrap_or_else(|e| panic!("{e}"));
        let terms = terms(&robot.effects, 2, rows).map_err(|wrong| wrong.in_full())?;
        Ok(terms.into_iter().map(|term| (term.spot.to_string(), term.values)).collect())
    }

    #[test]
    fn numbers_may_have_their_units() {
        for width in ["width = \"1 mrad\"", "half_width = \"0.5 mrad\""] {
            let backlash = format!("id = \"backlash\"\nplace = \"joint 2\"\n{width}\n");
            let found = said(&backlash, Domain::Position);
            assert_eq!(found, Ok(vec![("joint 2".to_owned(), vec![1e-3])]));
            assert_eq!(said(&backlash, Domain::Torque), Ok(Vec::new()));
        }
        let latency = "id = \"latency\"\nplace = \"the interface\"\ndelay = 0.1\n";
        for rows in [Domain::Torque, Domain::Position] {
            assert_eq!(said(latency, rows), Ok(vec![("the interface".to_owned(), vec![0.1])]));
        }
        let viscous = "id = \"viscous_friction\"\nplace = \"joint 1\"\nviscous = ";
        let found = said(&format!("{viscous}12\n"), Domain::Torque);
        assert_eq!(found, Ok(vec![("joint 1".to_owned(), vec![12.0])]));
    }

    /// Each is refused as what it is, none as something unknown, but for the backlash that acts at rest too.
    #[test]
    fn no_kernel_is_made_of_any() {
        let text =
            "name = \"arm\"\nconvention = \"standard\"\n[[joint]]\ntype = \"revolute\"\na = 1\n";
        let (robot, _) = Robot::from_toml(text, "arm.toml").expect("a robot");
        let at_rest = |effect: &&dyn InMotion| {
            let twin = Catalogue::default().named(effect.identifier());
            let kernels = twin.filter(|twin| twin.depends() == Depends::Direction);
            let same =
                |twin: &dyn AtRest| twin.facts().parameters[0].key == effect.parameters()[0].key;
            effect.facts().is_geometry || kernels.is_some_and(same)
        };
        for effect in IN_MOTION.into_iter().filter(|effect| !at_rest(effect)) {
            let values = vec![0.5; effect.parameters().len()];
            let effects = vec![table(&Acting { effect, spot: Spot::of_joint(0), values })];
            let wrong = Robot { effects, ..robot.clone() }.with_effects().expect_err("no kernel");
            let message = &wrong[0].message;
            assert!(message.starts_with("no kernel is made of the "), "{message}");
        }
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        let id = "id = \"coulomb_friction\"\nplace = ";
        let cases = [
            (
                "\"joint 3\"\ncoulomb = 1\n",
                "line 11: `joint 3` is no place of coulomb_friction; did",
            ),
            ("\"joint 1\"\ncoulomb = \"3 mm\"\n", "line 12: `3 mm` is no number and its unit: N*m"),
            ("\"joint 1\"\ncoulomb = -1\n", "line 9: found [-1.0], expected numbers that"),
        ];
        for (text, message) in cases {
            let wrong = said(&format!("{id}{text}"), Domain::Torque).unwrap_err();
            assert!(wrong.starts_with(message), "{wrong}");
        }
        let viscous = "id = \"viscous_friction\"\nplace = \"joint 1\"\nviscous = \"1 N*m\"\n";
        let wrong = said(viscous, Domain::Torque).unwrap_err();
        assert!(wrong.ends_with("write it as a number without a unit, in N·m·s/rad"), "{wrong}");
    }
}
