//! The statement tree: what a generated function does, independent of any language.
//!
//! A [`Module`] is built once from a robot: functions with typed arguments and results, the sines and cosines that they
//! share, the constants of symbolic parameters. The body of a [`Function`] is a list of [`Statement`]s over [`Term`]s.
//! The printers of `emit` visit it; none of them reads the graph.

mod angle;
mod blocks;
mod constants;
mod function;
mod lower;
mod module;
mod naming;
mod posture;
mod readings;
mod schedule;
mod statement;
mod term;

pub(crate) use angle::Angle;
pub(crate) use blocks::{Block, blocks, lets, lively};
pub(crate) use constants::Constants;
pub(crate) use function::{Argument, Function, Given};
pub(crate) use module::{Group, Module};
pub(crate) use naming::component;
pub(crate) use posture::{Plain, Posture};
pub(crate) use readings::{Extra, Readings};
pub(crate) use statement::{Solve, Statement, read};
pub(crate) use term::{Name, Operation, Style, Term};
