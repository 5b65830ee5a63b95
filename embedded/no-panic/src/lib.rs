//! Every call of the solver, on values the compiler knows nothing about. The panic handler calls a function that is defined
//! nowhere, so a program linked from the functions here exists only if none of them can come to a panic.
#![no_std]

use nalgebra::{SMatrix, SVector};
use num_traits::{AsPrimitive, FloatConst};
use trunnion_solver::{
    Real,
    lstsq::{Factor, Solution, SolveError, Subset, student_t_95},
    tilting::{Estimate, Joint, TwoStep},
    trig::Float,
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
}

fn lstsq<T: Real>(factor: &mut Factor<T, P>, other: &Factor<T, P>, tape: &mut Tape<'_, T>) -> u32 {
    let (row, y, weight) = (SVector::from(*tape.input), tape.next(), tape.next());
    let taken = [factor.push(&row, y), factor.push_weighted(&row, y, weight), factor.merge(other)];
    tape.solution(factor.solve());
    tape.solution(factor.solve_with_sigma(weight));
    let (k, covariance) = (SVector::from([y, weight, y]), SMatrix::from([[y; 3]; 3]));
    tape.solution(factor.solve_given::<5, 3>(&k, &covariance));
    if let Ok(condition) = factor.condition() {
        tape.put(condition.number);
        tape.subset(&condition.weakest);
    }
    taken.iter().fold(0, |bits, outcome| bits << 1 | u32::from(outcome.is_ok()))
}

fn tilting<T: Real + FloatConst + 'static>(
    joint: &mut Joint<T>,
    two_step: &mut TwoStep<T>,
    tape: &mut Tape<'_, T>,
) -> u32
where
    f64: AsPrimitive<T>,
{
    let (a, y, known) = (tape.next(), tape.next(), [tape.next(), tape.next()]);
    let (sin, cos) = Float::sin_cos(a);
    tape.put(sin + cos);
    if let Ok(fresh) = Joint::new(y) {
        *joint = fresh;
    }
    if let Ok(fresh) = TwoStep::new(y) {
        *two_step = fresh;
    }
    let copy = *joint;
    let taken = [
        joint.push_tilting(a, y, known),
        joint.push_separation(a, y),
        joint.merge(&copy),
        two_step.push_tilting(a, y, known),
        two_step.push_separation(a, y),
    ];
    if let Ok(estimate) = joint.solve() {
        estimated(&estimate, a, tape);
    }
    if let Ok(condition) = joint.condition() {
        tape.subset(&condition.weakest);
    }
    if let Ok(estimate) = two_step.solve() {
        estimated(&estimate, a, tape);
    }
    taken.iter().fold(0, |bits, outcome| bits << 1 | u32::from(outcome.is_ok()))
}

fn estimated<T: Real + FloatConst + 'static, const N: usize>(estimate: &Estimate<T, N>, a: T, tape: &mut Tape<'_, T>)
where
    f64: AsPrimitive<T>,
{
    tape.put(estimate.eps_xa(a).map_or(T::zero(), |(value, std)| value + std));
    tape.put(estimate.band(a).unwrap_or(T::zero()));
    tape.solution(Ok(estimate.solution));
}

macro_rules! proofs {
    ($($lstsq:ident, $tilting:ident, $t:ty;)*) => {$(
        /// All of `lstsq`.
        #[unsafe(no_mangle)]
        pub extern "C" fn $lstsq(f: &mut Factor<$t, P>, other: &Factor<$t, P>, input: &[$t; P], sum: &mut $t) -> u32 {
            let mut tape = Tape { input, at: 0, sum: 0.0 };
            let bits = lstsq(f, other, &mut tape);
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
