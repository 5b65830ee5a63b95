//! Two least-squares problems, one after the other: what the first estimates is given to the second.
//!
//! The first factor estimates k. The second has columns for its own unknowns e and for those of k it sees; with R, D and q
//! split into their blocks, the least-squares solution for fixed k and its residuals are
//!
//! ```text
//! e   = R_EE⁻¹ (q_E − R_EK k)
//! rss = rss + (q_K − R_KK k)' D_K (q_K − R_KK k)
//! ```
//!
//! e is linear in k with G = ∂e/∂k = −R_EE⁻¹ R_EK, so with `cov k = s₁² (K'WK)⁻¹` and `E'WE = R_EE' D_E R_EE`
//!
//! ```text
//! cov(e, k) = G cov k
//! cov e     = s₂² (E'WE)⁻¹ + G cov k G'
//! ```

use super::residual::Residual;
use super::triangle::Triangle;
use super::{Condition, Factor, Order, Real, Solution, SolveError, Step, TwoStepError};
use nalgebra::{SMatrix, SVector};

/// How the estimate moves with the readings: by `w · first · r` per unit of the reading of a sample of the first step with
/// weight w and regressors r, placed at the base parameters' positions; by `w · second · r` for one of the second step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensitivity<T, const P: usize> {
    /// In the columns of the first step: (K'WK)⁻¹ and, in the rows of the second step's own, G (K'WK)⁻¹. Zero elsewhere.
    pub first: SMatrix<T, P, P>,
    /// (E'WE)⁻¹ at the second step's own. Zero elsewhere.
    pub second: SMatrix<T, P, P>,
}

impl<const P: usize, const F: usize, const S: usize> Order<P, F, S> {
    /// The estimate of all base parameters, the covariance of each step from its residuals. The factors must not share
    /// samples. `residual_std` and `degrees_of_freedom` are those of the second step. The given columns need not be
    /// independent in the second step.
    ///
    /// # Errors
    /// [`TwoStepError`]: the step that failed, and why, as of [`Factor::solve`].
    #[inline]
    pub fn solve<T: Real>(
        &self,
        first: &Factor<T, F>,
        second: &Factor<T, S>,
    ) -> Result<Solution<T, P>, TwoStepError<P>> {
        self.estimate(first, second, None)
    }

    /// As [`solve`](Self::solve), with the standard deviation `sigma` of a sample of weight one known beforehand, in both
    /// parts. Needs only as many samples as there are coefficients.
    ///
    /// # Errors
    /// As [`solve`](Self::solve); [`SolveError::NotFinite`] also for a `sigma` that is not finite.
    pub fn solve_with_sigma<T: Real>(
        &self,
        first: &Factor<T, F>,
        second: &Factor<T, S>,
        sigma: T,
    ) -> Result<Solution<T, P>, TwoStepError<P>> {
        self.estimate(first, second, Some(sigma * sigma))
    }

    /// The coefficients of [`solve_with_sigma`](Self::solve_with_sigma) alone, in a fraction of its time.
    ///
    /// # Errors
    /// As [`solve_with_sigma`](Self::solve_with_sigma).
    pub fn coefficients<T: Real>(
        &self,
        first: &Factor<T, F>,
        second: &Factor<T, S>,
    ) -> Result<SVector<T, P>, TwoStepError<P>> {
        let (k, e) = self.determined(first, second, Some(T::one()))?;
        let k = k.back_substitute(first.q);
        let e = e.back_substitute(self.given(second, &k).0);
        let mut coefficients = [T::zero(); P];
        scatter(&mut coefficients, self.first(), &k);
        scatter(&mut coefficients, self.own(), &e);
        if T::all_finite(&coefficients) {
            Ok(SVector::from(coefficients))
        } else {
            Err(self.second_failed(SolveError::NotFinite))
        }
    }

    /// How the estimate moves with the readings.
    ///
    /// # Errors
    /// As [`solve_with_sigma`](Self::solve_with_sigma).
    pub fn sensitivity<T: Real>(
        &self,
        first: &Factor<T, F>,
        second: &Factor<T, S>,
    ) -> Result<Sensitivity<T, P>, TwoStepError<P>> {
        let one = T::one();
        let (k, e) = self.determined(first, second, Some(one))?;

        let (mut cov_k, mut cov_e) = (k.inverse(), e.inverse());
        k.covariance(&mut cov_k, one);
        e.covariance(&mut cov_e, one);
        let cross = self.cross(&self.gain(second, &e), &cov_k);
        let mut sensitivity = [[[T::zero(); P]; P]; 2];
        let [of_first, of_second] = &mut sensitivity;
        place(of_first, self.first(), self.first(), &cov_k);
        place_transposed(of_first, self.own(), self.first(), &cross);
        place(of_second, self.own(), self.own(), &cov_e);
        if !sensitivity.iter().flatten().all(|column| T::all_finite(column)) {
            return Err(self.second_failed(SolveError::NotFinite));
        }
        let [first, second] = sensitivity.map(SMatrix::from);
        Ok(Sensitivity { first, second })
    }

    /// Condition of the step that separates its own coefficients worse.
    ///
    /// # Errors
    /// As [`Factor::condition`], with the step that failed.
    pub fn condition<T: Real>(
        &self,
        first: &Factor<T, F>,
        second: &Factor<T, S>,
    ) -> Result<Condition<T, P>, TwoStepError<P>> {
        let of_first = first.condition_of_first(self.first().len()).map_err(|e| self.first_failed(e))?;
        let of_second = second.condition_of_first(self.own().len()).map_err(|e| self.second_failed(e))?;
        Ok(if of_second.number > of_first.number {
            Condition { number: of_second.number, weakest: of_second.weakest.placed(self.own()) }
        } else {
            Condition { number: of_first.number, weakest: of_first.weakest.placed(self.first()) }
        })
    }

    /// The columns that each step estimates, if its samples determine them.
    #[inline]
    fn determined<'a, T: Real>(
        &self,
        first: &'a Factor<T, F>,
        second: &'a Factor<T, S>,
        variance: Option<T>,
    ) -> Result<(Triangle<'a, T, F>, Triangle<'a, T, S>), TwoStepError<P>> {
        let k = Triangle::leading(first, self.first().len());
        k.determined(variance).map_err(|e| self.first_failed(e))?;
        let e = Triangle::leading(second, self.own().len());
        e.determined(variance).map_err(|e| self.second_failed(e))?;
        Ok((k, e))
    }

    #[inline]
    fn estimate<T: Real>(
        &self,
        first: &Factor<T, F>,
        second: &Factor<T, S>,
        variance: Option<T>,
    ) -> Result<Solution<T, P>, TwoStepError<P>> {
        let (k, e) = self.determined(first, second, variance)?;

        let (mut cov_k, mut cov_e) = (k.inverse(), e.inverse());
        let residual = Residual::new(first.rss, first.samples, self.first().len());
        k.covariance(&mut cov_k, variance.unwrap_or(residual.variance));
        let k = k.back_substitute(first.q);

        let (rest, rss) = self.given(second, &k);
        let residual = Residual::new(rss, second.samples, self.own().len());
        e.covariance(&mut cov_e, variance.unwrap_or(residual.variance));
        let gain = self.gain(second, &e);
        let e = e.back_substitute(rest);
        let cross = self.cross(&gain, &cov_k);
        self.widen(&mut cov_e, &cross, &gain);

        let (mut coefficients, mut covariance) = ([T::zero(); P], [[T::zero(); P]; P]);
        scatter(&mut coefficients, self.first(), &k);
        scatter(&mut coefficients, self.own(), &e);
        place(&mut covariance, self.first(), self.first(), &cov_k);
        place(&mut covariance, self.own(), self.first(), &cross);
        place_transposed(&mut covariance, self.own(), self.first(), &cross);
        place(&mut covariance, self.own(), self.own(), &cov_e);
        Solution::finite(coefficients, covariance, residual).ok_or(self.second_failed(SolveError::NotFinite))
    }

    /// ∂e/∂k for each column of the second factor that is given; zero for its own.
    #[inline]
    fn gain<T: Real>(&self, second: &Factor<T, S>, e: &Triangle<'_, T, S>) -> [[T; S]; S] {
        let mut gain = [[T::zero(); S]; S];
        for (column, (gain, &source)) in gain.iter_mut().zip(&self.source).enumerate() {
            if source < F {
                for ((gain, row), _) in gain.iter_mut().zip(&second.dr).zip(self.own()) {
                    *gain = row.get(column).map_or(T::zero(), |&r| -r);
                }
                *gain = e.back_substitute(*gain);
            }
        }
        gain
    }

    /// G cov k for all of k, a row for each own column.
    #[inline]
    fn cross<T: Real>(&self, gain: &[[T; S]; S], cov_k: &[[T; F]; F]) -> [[T; F]; S] {
        let mut cross = [[T::zero(); F]; S];
        for (gain, &source) in gain.iter().zip(&self.source) {
            let Some(cov) = cov_k.get(source) else { continue };
            for ((cross, &g), _) in cross.iter_mut().zip(gain).zip(self.own()) {
                for (cross, &c) in cross.iter_mut().zip(cov) {
                    *cross += g * c;
                }
            }
        }
        cross
    }

    /// Adds G cov k G', given G cov k.
    #[inline]
    fn widen<T: Real>(&self, cov_e: &mut [[T; S]; S], cross: &[[T; F]; S], gain: &[[T; S]; S]) {
        let own = self.own_count.min(S);
        for i in 0..own {
            let cross = self.given_of(&cross[i]);
            for j in i..own {
                let mut sum = cov_e[i][j];
                for l in own..S {
                    sum += cross[l] * gain[l][j];
                }
                cov_e[i][j] = sum;
                cov_e[j][i] = sum;
            }
        }
    }

    /// What the columns of the second factor are given of `k`, a value for each column of the first; zero for its own.
    #[inline]
    fn given_of<T: Real>(&self, k: &[T; F]) -> [T; S] {
        self.source.map(|column| k.get(column).copied().unwrap_or(T::zero()))
    }

    /// Right-hand side and residual sum of squares of the second step with `k` put in.
    #[inline]
    fn given<T: Real>(&self, second: &Factor<T, S>, k: &[T; F]) -> ([T; S], T) {
        let (own, k) = (self.own_count.min(S), self.given_of(k));
        let (mut rest, mut rss) = (second.q, second.rss);
        for i in 0..S {
            for j in own.max(i + 1)..S {
                rest[i] -= second.dr[i][j] * k[j];
            }
            if i >= own {
                let rest = rest[i] - k[i];
                rss += second.d(i) * rest * rest;
            }
        }
        (rest, rss)
    }

    fn first_failed(&self, error: SolveError<F>) -> TwoStepError<P> {
        TwoStepError { step: Step::First, why: error.placed(self.first()) }
    }

    fn second_failed(&self, error: SolveError<S>) -> TwoStepError<P> {
        TwoStepError { step: Step::Second, why: error.placed(self.own()) }
    }
}

/// Puts `values` at the places `at`.
#[inline]
fn scatter<T: Copy, const P: usize>(to: &mut [T; P], at: &[usize], values: &[T]) {
    for (&at, &value) in at.iter().zip(values) {
        if let Some(to) = to.get_mut(at) {
            *to = value;
        }
    }
}

/// Puts the rows of a block at the places `rows` of `to`, its columns at `columns`.
#[inline]
fn place<T: Copy, const P: usize, const W: usize>(
    to: &mut [[T; P]; P],
    rows: &[usize],
    columns: &[usize],
    block: &[[T; W]],
) {
    for (&row, values) in rows.iter().zip(block) {
        if let Some(to) = to.get_mut(row) {
            scatter(to, columns, values);
        }
    }
}

/// As [`place`], with rows and columns exchanged.
#[inline]
fn place_transposed<T: Copy, const P: usize, const W: usize>(
    to: &mut [[T; P]; P],
    rows: &[usize],
    columns: &[usize],
    block: &[[T; W]],
) {
    for (&row, values) in rows.iter().zip(block) {
        for (&column, &value) in columns.iter().zip(values) {
            if let Some(to) = to.get_mut(column).and_then(|to| to.get_mut(row)) {
                *to = value;
            }
        }
    }
}
