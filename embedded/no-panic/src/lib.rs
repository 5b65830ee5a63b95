//! Every call of the solver, on values the compiler knows nothing about. The panic handler calls a function that is defined
//! nowhere, so a program linked from the functions here exists only if none of them can come to a panic.
#![no_std]

use nalgebra::SVector;
use trunnion_solver::{
    Real,
    lstsq::{Condition, Factor, Order, Solution, SolveError, Subset, student_t_95},
    tilting::{Estimate, Joint, Lengths, TwoStep},
};

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    unsafe extern "C" {
        fn trunnion_can_panic() -> !;
    }
    // SAFETY: never called: it is defined nowhere.
    unsafe { trunnion_can_panic() }
}

const P: usize = 8;
type Steps = Order<P, P, P>;

/// Numbers in, numbers out: anything may come, and everything that is worked out goes.
struct Tape<'a, T> {
    input: &'a [T; P],
    at: usize,
    sum: T,
}

impl<T: Real> Tape<'_, T> {
    fn next(&mut self) -> T {
        self.at = (self.at + 1) % P;
        self.input.get(self.at).copied().unwrap_or(T::zero())
    }

    fn put(&mut self, value: T) {
        self.sum += value;
    }

    fn subset<const N: usize>(&mut self, subset: &Subset<N>) {
        self.put(T::of_count(subset.iter().fold(0, |sum, i| sum ^ (1 << (i & 31)))));
    }

    fn solution<const N: usize>(&mut self, outcome: Result<Solution<T, N>, SolveError<N>>) {
        match outcome {
            Ok(solution) => {
                solution
                    .coefficients
                    .iter()
                    .chain(&solution.covariance)
                    .chain(&solution.std())
                    .for_each(|v| self.put(*v));
                let g = SVector::from([(); N].map(|()| self.next()));
                self.put(solution.value_of(&g).unwrap_or(T::zero()));
                self.put(solution.variance_of(&g).unwrap_or(T::zero()));
                self.put(student_t_95(solution.degrees_of_freedom));
            }
            Err(SolveError::RankDeficient(confounded)) => self.subset(&confounded.involved),
            Err(_) => self.put(T::one()),
        }
    }

    fn condition<const N: usize>(&mut self, condition: &Condition<T, N>) {
        self.put(condition.number);
        self.subset(&condition.weakest);
    }

    fn two_steps(&mut self, order: &Steps, first: &Factor<T, P>, second: &Factor<T, P>, sigma: T) {
        for outcome in [order.solve(first, second), order.solve_with_sigma(first, second, sigma)] {
            self.solution(outcome.map_err(|e| e.why));
        }
        if let Ok(coefficients) = order.coefficients(first, second) {
            coefficients.iter().for_each(|v| self.put(*v));
        }
        if let Ok(sensitivity) = order.sensitivity(first, second) {
            sensitivity.first.iter().chain(&sensitivity.second).for_each(|v| self.put(*v));
        }
        if let Ok(condition) = order.condition(first, second) {
            self.condition(&condition);
        }
    }
}

fn lstsq<T: Real>(
    factor: &mut Factor<T, P>,
    other: &Factor<T, P>,
    order: &mut Steps,
    [own, given, first]: &[[usize; 4]; 3],
    tape: &mut Tape<'_, T>,
) -> u32 {
    if let Ok(new) = Order::new(first, own, given) {
        *order = new;
    }

    let (row, y, weight) = (SVector::from(*tape.input), tape.next(), tape.next());
    let taken = [factor.push(&row, y), factor.push_weighted(&row, y, weight), factor.merge(other)];
    tape.solution(factor.solve());
    tape.solution(factor.solve_with_sigma(weight));
    if let Ok(coefficients) = factor.coefficients() {
        coefficients.iter().for_each(|v| tape.put(*v));
    }
    tape.two_steps(order, factor, other, weight);
    if let Ok(condition) = factor.condition() {
        tape.condition(&condition);
    }
    taken.iter().fold(0, |bits, outcome| bits << 1 | u32::from(outcome.is_ok()))
}

fn tilting<T: Real>(joint: &mut Joint<T>, two_step: &mut TwoStep<T>, tape: &mut Tape<'_, T>) -> u32 {
    let (a, y, [y_a, z_a]) = (tape.next(), tape.next(), [tape.next(), tape.next()]);
    if let Ok(fresh) = Joint::new(Lengths { r: y }) {
        *joint = fresh;
    }
    if let Ok(fresh) = TwoStep::new(Lengths { r: y }) {
        *two_step = fresh;
    }
    let (joint_before, two_step_before) = (*joint, *two_step);
    let taken = [
        joint.push_tilting(a, y, y_a, z_a).is_ok(),
        joint.push_separation(a, y).is_ok(),
        joint.push(&[y; 13], a, z_a).is_ok(),
        joint.merge(&joint_before).is_ok(),
        two_step.push_tilting(a, y, y_a, z_a).is_ok(),
        two_step.push_separation(a, y).is_ok(),
        two_step.merge(&two_step_before).is_ok(),
    ];
    for estimate in [joint.solve().ok(), two_step.solve().ok()].into_iter().flatten() {
        estimated(&estimate, a, tape);
    }
    for condition in [joint.condition().ok(), two_step.condition().ok()].into_iter().flatten() {
        tape.condition(&condition);
    }
    taken.iter().fold(0, |bits, taken| bits << 1 | u32::from(*taken))
}

fn estimated<T: Real>(estimate: &Estimate<T>, a: T, tape: &mut Tape<'_, T>) {
    if let Ok((value, std)) = estimate.e_xa(a) {
        tape.put(value + std);
    }
    tape.put(estimate.lengths().r);
    tape.solution(Ok(estimate.solution));
}

macro_rules! proofs {
    ($($lstsq:ident, $tilting:ident, $t:ty;)*) => {$(
        /// All of `lstsq`.
        #[unsafe(no_mangle)]
        pub extern "C" fn $lstsq(
            f: &mut Factor<$t, P>,
            other: &Factor<$t, P>,
            order: &mut Steps,
            columns: &[[usize; 4]; 3],
            input: &[$t; P],
            sum: &mut $t,
        ) -> u32 {
            let mut tape = Tape { input, at: 0, sum: 0.0 };
            let bits = lstsq(f, other, order, columns, &mut tape);
            *sum = tape.sum;
            bits
        }

        /// All of `tilting`.
        #[unsafe(no_mangle)]
        pub extern "C" fn $tilting(j: &mut Joint<$t>, t: &mut TwoStep<$t>, input: &[$t; P], sum: &mut $t) -> u32 {
            let mut tape = Tape { input, at: 0, sum: 0.0 };
            let bits = tilting(j, t, &mut tape);
            *sum = tape.sum;
            bits
        }
    )*};
}
proofs! {
    proof_lstsq_f32, proof_tilting_f32, f32;
    proof_lstsq_f64, proof_tilting_f64, f64;
}

/// An index that may be out of bounds.
#[cfg(feature = "control")]
#[unsafe(no_mangle)]
pub extern "C" fn proof_control(input: &[u32; P], at: usize) -> u32 {
    input[at]
}
