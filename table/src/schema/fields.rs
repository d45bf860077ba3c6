//! The schema of a robot: one line for each field that a robot file or a `robot!` table may have. The readers, the
//! writer, the list of parameters, the tables of `docs/robot-file.md` and the JSON Schema follow from it.

use super::field::{Field, Slot};
use crate::robot::Dimension::{
    Acceleration, Angle, Area, Density, Inertia, Length, Mass, Pressure, Ratio, SecondMoment,
};
use crate::robot::{Beam, Dimension, Frame, Joint, Marker, NamedFrame, Payload, Robot, Section};

/// The tables: `key: Slot(where in the model).what its values are => "what it is for";`.
macro_rules! tables {
    ($($(#[$doc:meta])* $name:ident: $model:ident {
        $($key:ident: $slot:ident($($path:tt)*) $(.$more:ident($($argument:expr),*))* => $says:literal;)*
    })*) => {$(
        $(#[$doc])*
        pub(crate) const $name: &[Field<$model>] = &[$(
            Field::<$model>::new(stringify!($key), $says, |of| slot!(of $slot $($path)*))
                $(.$more($($argument),*))*,
        )*];
    )*};
}

/// The place of a field in a model.
macro_rules! slot {
    ($of:ident Carries) => {{ let _ = $of; Slot::Carries }};
    ($of:ident Outputs) => { Slot::Outputs($of) };
    ($of:ident Limits $path:ident) => { Slot::Limits(&mut $of.$path, $of.motion) };
    ($of:ident Frame $path:ident, $fields:ident, $name:literal) => {
        Slot::Frame(&mut $of.$path, $fields, $name)
    };
    ($of:ident $slot:ident $($path:ident).+) => { Slot::$slot(&mut $of.$($path).+) };
}

tables! {
    /// The file itself.
    ROBOT: Robot {
        name: Text(name).needed(NAME) => "the arm's name, as its maker or paper writes it";
        convention: Convention(convention).needed(CONVENTION)
            => "standard: a row is Rz(theta) Tz(d) Tx(a) Rx(alpha) Ry(beta); modified: Rx(alpha) Ry(beta) Tx(a) Rz(theta) Tz(d)";
        gravity: Vector(gravity).of(Acceleration).or("[0, 0, -9.80665]").always() => "in base axes";
        torque_side: Side(torque_side).or("not known") => "where logs of the arm measure torques";
        carries: Carries().or("nothing")
            => "the payload that hangs on the tool for good: a part of the last link";
        outputs: Outputs().or("every output of the tool")
            => "what is generated, of the tool (`\"pose\"`) or of a frame or marker (`\"pose at elbow\"`)";
        joint: Joints(joints).needed(ROWS) => "the rows of the table, base to tip";
        base: Frame(base, BASE, "[base]").or("the base is the world")
            => "from the world, in which poses are measured, to the arm's base";
        tool: Frame(tool, TOOL, "[tool]").or("the last frame") => "the tool in the last frame";
        frame: Frames(frames) => "frames with names, on any link";
        marker: Markers(markers) => "measured points in the tool frame";
        effect: Effects(effects) => "the error model: what the arm does beyond the table";
        payload: Payloads(payloads) => "loads that rows of data name";
    }

    /// `[[joint]]`; the macro's columns are these but for `type` and `name`.
    JOINT: Joint {
        type: Motion(motion).needed(TYPE) => "how the joint moves";
        name: Text(name).or("`joint 1`, …") => "a label";
        theta: Angle(theta).of(Angle).or("0").always()
            => "about z; the offset added to q of a revolute joint";
        d: Value(d).of(Length).or("0").always()
            => "along z; the offset added to q of a prismatic joint";
        a: Value(a).of(Length).or("0").always() => "along x: the length of the common normal";
        alpha: Angle(alpha).of(Angle).or("0").always() => "about x: the twist";
        beta: Angle(beta).of(Angle).or("0")
            => "about y behind alpha (Hayati), for axes that are nearly parallel";
        stiffness: Maybe(stiffness).by(Dimension::stiffness).or("rigid").word("rigid")
            .above_zero("the stiffness", "leave it out for a rigid joint")
            => "the joint's spring, or `\"rigid\"`";
        mass: Maybe(mass).of(Mass).or("weightless").not_negative("the mass")
            => "of the link that the joint moves";
        com: Vector(com).of(Length).or("the frame's origin").always_if(|j| j.mass.is_some())
            => "the link's centre of mass in the row's own frame";
        inertia: Tensor(inertia).of(Inertia).or("a point mass")
            => "of the link about its centre of mass, in the row's axes";
        gear: Maybe(drive.gear).by(Dimension::gear).or("1")
            .above_zero("the gear", "leave it out for a motor at the joint")
            => "turns of the motor per turn of the joint";
        rotor_inertia: Maybe(drive.rotor_inertia).of(Inertia).not_negative("the rotor's inertia")
            => "of all that turns with the motor, at the motor";
        coulomb: Maybe(drive.coulomb).by(Dimension::load).not_negative("the dry friction")
            => "dry friction at the joint";
        viscous: Maybe(drive.viscous).by(Dimension::damping).not_negative("the viscous friction")
            => "friction in proportion to the rate, at the joint";
        limits: Limits(limits).by(Dimension::displacement).number("joint limits are numbers")
            => "the joint's lower and upper limit";
        source: MaybeText(source).or("not told") => "where the row's numbers come from";
        beam: Beam(beam).or("a rigid link")
            => "the link as a beam from the previous frame's origin to this one's";
    }

    /// `[joint.beam]`.
    BEAM: Beam {
        youngs_modulus: Value(youngs_modulus).of(Pressure).above_zero("youngs_modulus", "")
            .needed("for example youngs_modulus = \"69 GPa\"") => "E";
        shear_modulus: Value(shear_modulus).of(Pressure).above_zero("shear_modulus", "")
            .needed("for example shear_modulus = \"26 GPa\"") => "G";
        section: Section(section).needed(SHAPES) => "the cross-section: its shape or its constants";
        density: Maybe(density).of(Density).or("weightless").not_negative("the density")
            => "distributed weight";
        shear_coefficient: Maybe(shear_coefficient).of(Ratio).or("Euler-Bernoulli")
            .above_zero("shear_coefficient", "leave it out to neglect shear")
            => "Timoshenko's κ, which adds shear";
    }

    /// The constants of a section that is neither a tube nor a box.
    SECTION: Section {
        area: Value(area).of(Area).needed(SHAPES).above_zero("the section's area", "")
            => "the area";
        iy: Value(iy).of(SecondMoment).needed(SHAPES).above_zero("the section's iy", "")
            => "second moment about the beam's y";
        iz: Value(iz).of(SecondMoment).needed(SHAPES).above_zero("the section's iz", "")
            => "second moment about the beam's z";
        j: Value(j).of(SecondMoment).needed(SHAPES).above_zero("the section's j", "")
            => "the torsion constant";
    }

    /// `[base]`. The world is no part of the arm: where it stands is known when the code is made.
    BASE: Frame {
        translation: Vector(translation).of(Length).or("0").always()
            .number("where the base stands cannot stay symbolic") => "frame 0's origin in the world";
        rotation: Rotation(rotation).of(Angle).or("0").number(TURN) => "its rotation vector";
    }

    /// `[tool]`.
    TOOL: Frame {
        translation: Vector(translation).of(Length).or("0").always()
            => "the tool's origin in the last frame";
        rotation: Rotation(rotation).of(Angle).or("0").number(TURN) => "its rotation vector";
    }

    /// `[[frame]]`.
    FRAME: NamedFrame {
        name: Text(name).needed(NAME)
            => "a lower-case letter, then such letters, digits and `_`: it becomes a module's";
        joint: Row(row).needed(ON) => "the row in whose frame it stands, by its number or name";
        translation: Vector(frame.translation).of(Length).or("0").always()
            .number("a frame's place cannot stay symbolic") => "its origin in the row's frame";
        rotation: Rotation(frame.rotation).of(Angle).or("0").number(TURN) => "its rotation vector";
    }

    /// `[[marker]]`.
    MARKER: Marker {
        name: Text(name).needed(NAME) => "the name that measurement files use";
        translation: MaybeVector(translation).of(Length).or("not known")
            .number("leave the place out where a marker's place is unknown")
            => "its place in the tool frame";
    }

    /// `[[payload]]`.
    PAYLOAD: Payload {
        name: Text(name).needed(NAME) => "the name that data use";
        mass: Value(mass).of(Mass).number(WEIGHED).needed("write mass = 5.0")
            .not_negative("the mass") => "its mass";
        com: Vector(com).of(Length).number(WEIGHED).or("the tool's origin").always()
            => "its centre of mass in the tool frame";
        inertia: Tensor(inertia).of(Inertia).number(WEIGHED).or("a point mass")
            => "about that centre, in the tool's axes";
    }
}

const NAME: &str = "write name = \"…\"";
const CONVENTION: &str = "write convention = \"standard\" or \"modified\"";
const TYPE: &str = "write type = \"revolute\" or \"prismatic\"";
pub(super) const ROWS: &str = "write one [[joint]] table per row, base to tip";
const ON: &str = "write joint = 3, or the name of the joint on whose link the frame is";
const TURN: &str = "a frame's rotation cannot stay symbolic";
const WEIGHED: &str = "a payload is weighed, not chosen: write numbers";
pub(super) const SHAPES: &str = "write section = { shape = \"tube\", … }, { shape = \"box\", … } or \
                                 { area = …, iy = …, iz = …, j = … }";
