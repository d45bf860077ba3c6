//! A `[joint.beam]` table and its section.

use core::ops::Range;

use ::toml::Spanned;
use ::toml::de::DeValue;

use super::super::dimension::Dimension;
use super::super::draft::{Cell, DraftBeam, broken};
use super::super::model::{Section, Value};
use super::super::problem::Problem;
use super::fields::Fields;
use super::reader::Reader;
use crate::number::Number;

type At = Range<usize>;
type Node<'i> = Spanned<DeValue<'i>>;

const KEYS: &[&str] =
    &["youngs_modulus", "shear_modulus", "section", "density", "shear_coefficient"];
const SHAPE_HELP: &str = "write section = { shape = \"tube\", … }, { shape = \"box\", … } or \
                          { area = …, iy = …, iz = …, j = … }";

/// Reads a beam; `None` (and an error) if the value is no table.
pub(super) fn read(reader: &mut Reader<'_>, value: &Node<'_>) -> Option<DraftBeam<At>> {
    let fields = Fields::of(reader, value, "[joint.beam]", KEYS)?;
    let mut modulus = |key, help| match fields.required(reader, key, help) {
        Some(value) => reader.value(value, Dimension::Pressure),
        None => Cell::broken(fields.at()),
    };
    Some(DraftBeam {
        youngs_modulus: modulus("youngs_modulus", "for example youngs_modulus = \"69 GPa\""),
        shear_modulus: modulus("shear_modulus", "for example shear_modulus = \"26 GPa\""),
        section: match fields.required(reader, "section", SHAPE_HELP) {
            Some(value) => section(reader, value),
            None => broken(&fields.at()),
        },
        density: fields.get("density").map(|v| reader.value(v, Dimension::Density)),
        shear_coefficient: fields
            .get("shear_coefficient")
            .map(|v| reader.value(v, Dimension::Ratio)),
        at: fields.at(),
    })
}

#[derive(Clone, Copy)]
enum Shape {
    Tube,
    Box,
}

fn section(reader: &mut Reader<'_>, value: &Node<'_>) -> [Cell<Value, At>; 4] {
    let at = value.span();
    let shape = match value.get_ref() {
        DeValue::Table(table) => {
            table.iter().find(|(key, _)| key.get_ref() == "shape").map(|(_, shape)| shape)
        }
        _ => None,
    };
    let read = match shape {
        None => return constants(reader, value),
        Some(shape) => {
            let shapes = [("tube", Shape::Tube), ("box", Shape::Box)];
            match reader.choice(shape, &shapes).value {
                Some(Shape::Tube) => tube(reader, value),
                Some(Shape::Box) => rectangle(reader, value),
                None => None,
            }
        }
    };
    match read {
        Some(Section { area, iy, iz, j }) => {
            [area, iy, iz, j].map(|constant| Cell::new(constant, at.clone()))
        }
        None => broken(&at),
    }
}

fn constants(reader: &mut Reader<'_>, value: &Node<'_>) -> [Cell<Value, At>; 4] {
    const KEYS: &[&str] = &["area", "iy", "iz", "j", "shape"];
    let Some(fields) = Fields::of(reader, value, "section", KEYS) else {
        return broken(&value.span());
    };
    if fields.misspelt("shape") {
        return broken(&value.span());
    }
    let mut constant = |key: &str, dimension| match fields.required(reader, key, SHAPE_HELP) {
        Some(value) => reader.value(value, dimension),
        None => Cell::broken(fields.at()),
    };
    [
        constant("area", Dimension::Area),
        constant("iy", Dimension::SecondMoment),
        constant("iz", Dimension::SecondMoment),
        constant("j", Dimension::SecondMoment),
    ]
}

fn size(reader: &mut Reader<'_>, value: &Node<'_>) -> Option<Number> {
    let reason = "to keep a section symbolic give its area, iy, iz and j";
    reader.number(value, Dimension::Length, reason).value?.number()
}

fn sides(reader: &mut Reader<'_>, value: &Node<'_>) -> Option<[Number; 2]> {
    let [b, h] = reader.array::<2>(value, "[b, h] (along the beam's y, along its z)")?;
    let (b, h) = (size(reader, b), size(reader, h));
    Some([b?, h?])
}

fn tube(reader: &mut Reader<'_>, value: &Node<'_>) -> Option<Section> {
    const KEYS: &[&str] = &["shape", "outer_diameter", "inner_diameter"];
    let fields = Fields::of(reader, value, "a tube's section", KEYS)?;
    let inner = fields.get("inner_diameter").map(|v| size(reader, v));
    let help = "for example outer_diameter = \"200 mm\"";
    let outer = fields.required(reader, "outer_diameter", help).and_then(|v| size(reader, v))?;
    let inner = inner.unwrap_or(Some(Number::ZERO))?;
    let section = Section::tube(outer, inner);
    if section.is_none() {
        let message = format!(
            "a tube of outer diameter {outer} m and inner diameter {inner} m: the outer one must \
             be above the inner one, and neither below zero"
        );
        reader.report.error(Problem::new(value.span(), message));
    }
    section
}

fn rectangle(reader: &mut Reader<'_>, value: &Node<'_>) -> Option<Section> {
    const KEYS: &[&str] = &["shape", "outer", "inner"];
    let fields = Fields::of(reader, value, "a box's section", KEYS)?;
    let inner = fields.get("inner").map(|v| sides(reader, v));
    let help = "for example outer = [\"100 mm\", \"80 mm\"]";
    let outer = fields.required(reader, "outer", help).and_then(|v| sides(reader, v))?;
    let inner = match inner {
        None => None,
        Some(sides) => Some(sides?).filter(|sides| !sides.iter().all(|side| side.is_zero())),
    };
    let section = Section::rectangle(outer, inner);
    if section.is_none() {
        let message = "a box's sides must be above zero, and each inner side below its outer side";
        reader.report.error(Problem::new(value.span(), message));
    }
    section
}
