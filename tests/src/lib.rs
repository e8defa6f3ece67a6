//! End-to-end tests of Lightbench; see `tests/`.
