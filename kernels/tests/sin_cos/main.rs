//! Sines and cosines of the scalars against more precise ones.

mod double;
mod single;
