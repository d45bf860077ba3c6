//! What the file of an effect works with.

pub(super) use std::f64::consts::{PI, TAU};

pub(super) use nalgebra::{
    DVector, Matrix6xX, Point3, Rotation3, UnitQuaternion, Vector3, Vector6,
};
pub(super) use stiffarm_kernels::Motion;
pub(super) use stiffarm_kernels::generic::{Arm, Convention, Joint};

pub(super) use super::body::{BODY, units};
pub(super) use super::displacement::{displacement, one_after_other};
pub(super) use super::in_motion::{behind_the_gear, of_drive, weightless};
pub(super) use super::scene::direction;
pub(super) use super::{
    At, AtRest, Carried, Carrier, Curve, Depends, Draw, Facts, Forms, Gives, Group, InMotion, Law,
    Moves, Over, Parameter, ParameterReport, Place, Quantity, RobotFile, Scene, Spot, Told,
    significant,
};
pub(super) use crate::infer::limits::{ROUNDING, SLOPE_STEP, SMALL_MOVE};
pub(super) use crate::log::TorqueSide;
pub(super) use crate::log::pace::{ORDERS, PASSES, Pace, round};
pub(super) use crate::log::rigid::moved;
pub(super) use crate::log::scene::{Column, Scene as LogScene};
pub(super) use crate::measurement::{Measurements, Row};
pub(super) use crate::signal::filter::rate;
pub(super) use crate::simulate::{
    Actual, Moment, Site, beyond_first_order, chord, equilibrium, is_stream, rotation, translation,
};
