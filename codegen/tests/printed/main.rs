//! Everything printed is compiled, run, and compared with the graph's own evaluation.

mod compare;
mod functions;
mod native;
mod python;
/// What stands for `trunnion_solver::generated`, which depends on this crate.
mod support {
    pub trait Number: num_traits::Float {
        fn of(x: f64) -> Self;
        fn whole_turns(self) -> Self {
            self.floor()
        }
        fn sine_cosine(self) -> (Self, Self) {
            self.sin_cos()
        }
    }
    impl Number for f32 {
        fn of(x: f64) -> Self {
            x as f32
        }
    }
    impl Number for f64 {
        fn of(x: f64) -> Self {
            x
        }
    }
}
/// Printed by the test below and checked in, so that the compiler reads it.
mod generated {
    include!("generated.rs");
}
mod generic;
