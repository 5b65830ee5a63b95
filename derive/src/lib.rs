//! Macros that turn a user's own machine into a generated, `no_std` measurement model.
