//! Instruments of the firmware: instructions and stack, counted on the target itself.
#![no_std]

pub mod clock;
pub mod stack;
