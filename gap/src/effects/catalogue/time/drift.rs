use crate::effects::prelude::*;

/// Rates of the measuring frame's displacement, base axes.
#[derive(Clone, Copy, Debug)]
pub struct Drift;

const AT_REST: &Facts = &Facts {
    identifier: "drift",
    reality: "The measuring frame creeps with time: a tripod that settles, a floor that warms.",
    signature: "A rigid motion of all poses in proportion to `time`, or to the number of the row \
        where there is no time; it begins anew with each `session`.",
    confused_with: "`thermal_growth` where temperature rises evenly; whatever else the order of \
        the poses follows.",
    separated_by: "The first poses once more at the end.",
    formula: "T → E(t) T, E in proportion to t",
    parameters: &displacement(Quantity::LengthRate, Quantity::AngleRate),
    at: At::Base,
    moves: Moves::Base,
    idle: "no time passes",
    group: Some(Group::Time),
    depends: Depends::Session,
    ..Facts::NONE
};

impl Law for Drift {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for Drift {
    fn moves_by(&self, _: &Row, when: &Moment, _: Spot, each: &mut dyn FnMut(f64)) {
        each(when.clock);
    }

    fn sentence(&self, _: &Told<'_>) -> String {
        "the measuring frame drifts with time".to_owned()
    }

    /// The usual sizes by the end of the session.
    fn draw(&self, from: &mut Draw<'_>) -> Vec<(String, f64)> {
        let parameters = self.parameters(from.arm, Spot::at(from.place));
        let elapsed = from.elapsed().max(1.0);
        from.sizes(&parameters, elapsed)
    }
}
