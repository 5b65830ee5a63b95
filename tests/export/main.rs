//! Compensation tables: what a control makes of them, and what then remains of the error.

mod machine;
mod readers;
mod signs;
