//! Robot arms.
