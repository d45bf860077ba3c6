//! A printed formula from its LaTeX to a tree.

pub mod formula;
mod letters;
pub mod lexer;
pub mod mistake;
pub mod notation;
pub mod parser;
pub mod token;
pub mod tree;
