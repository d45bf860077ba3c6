//! Features alone: see the manifest.
