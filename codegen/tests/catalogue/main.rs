//! Every model of the catalogue: its equations for review, and its derivation against numbers.

mod derivative;
mod exact;
mod harmonics;
mod mathml;
mod numbers;
mod printed;
mod rank;
mod snapshots;
mod written;
