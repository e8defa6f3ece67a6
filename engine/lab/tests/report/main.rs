//! The report of a study as a whole: the page in a browser, the data for other programs, and the
//! example that reads it.
#![allow(clippy::unwrap_used)]

mod browser;
mod data;
mod example;
mod page;
mod schema;
