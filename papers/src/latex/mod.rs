//! A printed formula from its LaTeX to a tree.

pub mod formula;
mod letters;
pub mod lexer;
pub mod mistake;
pub mod name;
pub mod notation;
pub mod parser;
pub mod token;
pub mod tree;
pub mod write;
