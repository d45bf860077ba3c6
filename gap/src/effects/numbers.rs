//! The numbers of an effect by the names in which people write them.

use stiffarm_kernels::generic::Arm;

use super::{AtRest, Forms, MOST_ORDERS, Parameter, Place, Spot};

impl core::fmt::Debug for dyn AtRest + '_ {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(self.identifier())
    }
}

/// Effects are the same if they have one identifier.
impl PartialEq for dyn AtRest + '_ {
    fn eq(&self, other: &Self) -> bool {
        self.identifier() == other.identifier()
    }
}

impl dyn AtRest + '_ {
    /// What stands for the form among the numbers of a finding: `after` of a jump.
    pub fn form_number(&self) -> Option<Parameter> {
        let Forms::Searched { key, quantity, .. } = self.forms_are() else { return None };
        Some(Parameter::free(key, quantity))
    }

    /// All its numbers at a place that may be named without data.
    pub fn numbers(&self, arm: &Arm, place: Place) -> Vec<Parameter> {
        let forms = self.named_forms(arm, place).into_iter();
        let each = forms.flat_map(|form| self.parameters(arm, Spot { place, form }));
        self.form_number().into_iter().chain(each).collect()
    }

    /// The form that a number of this name belongs to, and the number; none if there is no such. A
    /// number that stands for the form itself belongs to none.
    pub fn number(
        &self,
        arm: &Arm,
        place: Place,
        name: &str,
    ) -> Option<(Option<usize>, Parameter)> {
        if let Some(number) = self.form_number().filter(|number| number.name == name) {
            return Some((None, number));
        }
        let order = self.forms_are().order_of(name);
        let forms = match order {
            Some(order) => vec![order],
            None => self.named_forms(arm, place),
        };
        forms.into_iter().find_map(|form| {
            let all = self.parameters(arm, Spot { place, form });
            all.into_iter().find(|p| p.name == name).map(|p| (Some(form), p))
        })
    }

    /// The spots of some named values at a place, each with all of its parameters' values, those not
    /// named as 0; values of one name add up, names that there are not are left out.
    pub fn spots(
        &self,
        arm: &Arm,
        place: Place,
        values: &[(String, f64)],
    ) -> Vec<(Spot, Vec<f64>)> {
        let known = values.iter().filter_map(|(name, value)| {
            let (form, parameter) = self.number(arm, place, name)?;
            Some((form, parameter, *value))
        });
        let known: Vec<(Option<usize>, Parameter, f64)> = known.collect();
        let searched = known.iter().find(|(form, ..)| form.is_none());
        let searched = searched.and_then(|(.., value)| self.forms_are().form(*value));
        let mut spots: Vec<(Spot, Vec<f64>)> = Vec::new();
        for (form, named, value) in known.iter().filter_map(|(form, p, v)| Some(((*form)?, p, v))) {
            let spot = Spot { place, form: searched.unwrap_or(form) };
            let all = self.parameters(arm, spot);
            let at = spots.iter().position(|(there, _)| *there == spot).unwrap_or_else(|| {
                spots.push((spot, vec![0.0; all.len()]));
                spots.len() - 1
            });
            for (slot, parameter) in spots[at].1.iter_mut().zip(&all) {
                if parameter.name == named.name {
                    *slot += value;
                }
            }
        }
        spots
    }

    /// The names of its numbers, as a message lists them.
    pub fn names(&self, arm: &Arm, place: Place) -> String {
        let all = self.numbers(arm, place);
        if let Forms::Orders { .. } = self.forms_are() {
            let mut keys: Vec<&str> = all.iter().map(|p| p.key).collect();
            keys.dedup();
            let first = self.named_forms(arm, place).len().max(1);
            keys.truncate(all.len() / first);
            let each: Vec<String> = keys.iter().map(|key| format!("`{key} k`")).collect();
            return format!("{} with an order k of 1 to {MOST_ORDERS}", each.join(" or "));
        }
        let names: Vec<String> = all.iter().map(|p| format!("`{}`", p.name)).collect();
        match names.as_slice() {
            [only] => only.clone(),
            several => format!("one of {}", several.join(", ")),
        }
    }
}
