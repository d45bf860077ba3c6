//! The `robot!` macro: a shim over `stiffarm-codegen`.
