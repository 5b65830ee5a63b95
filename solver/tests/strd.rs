//! The NIST StRD linear-regression sets: digits reached, against the certified values and the table in the docs.
//!
//! "Shifted" is what a user does with a polynomial: x is mapped into [-1, 1] over its range, in the arithmetic under test.
//! The coefficients and covariance in the mapped variable are carried back to the certified ones exactly, in rational
//! arithmetic, so that only the fit is judged. `UPDATE_DIGITS=1` rewrites the table.

use nalgebra::SVector;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero, pow};
use serde_json::Value;
use std::{env, fs, path::Path, str::FromStr};
use trunnion_solver::{
    DoubleDouble, Real,
    lstsq::{Factor, SolveError},
};

/// Certified values have fifteen digits.
const MOST: f64 = 15.0;

/// Digits the coefficients must keep in `f64` on shifted data: those of an ordinary Givens factor with square roots, less
/// the few tenths by which the last bit of an intermediate result moves them either way.
const AT_LEAST: [(&str, f64); 11] = [
    ("Norris", 12.0),
    ("Pontius", 11.0),
    ("NoInt1", 14.0),
    ("NoInt2", 14.0),
    ("Filip", 13.2),
    ("Longley", 12.8),
    ("Wampler1", 9.8),
    ("Wampler2", 12.7),
    ("Wampler3", 9.5),
    ("Wampler4", 9.5),
    ("Wampler5", 7.5),
];

/// Digits that everything certified must have in double-double, on data as they are.
const IN_DOUBLE_DOUBLE: f64 = 13.0;

struct Set {
    y: Vec<String>,
    x: Vec<Vec<String>>,
    polynomial: bool,
    intercept: bool,
    coefficients: Vec<BigRational>,
    std: Vec<BigRational>,
    residual_std: BigRational,
}

impl Set {
    fn load(name: &str) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../tests/reference/strd/{name}.json"));
        let json: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
        let strings = |v: &Value| -> Vec<String> {
            v.as_array().unwrap().iter().map(|v| v.as_str().unwrap().to_owned()).collect()
        };
        let certified = |key: &str| strings(&json["certified"][key]).iter().map(|s| decimal(s)).collect();
        let polynomial = json["model"]["type"] == "polynomial";
        Self {
            y: strings(&json["y"]),
            x: json["x"].as_array().unwrap().iter().map(strings).collect(),
            polynomial,
            intercept: polynomial || json["model"]["intercept"] == true,
            coefficients: certified("coef"),
            std: certified("sd"),
            residual_std: decimal(json["certified"]["residual_sd"].as_str().unwrap()),
        }
    }

    /// Midpoint of each x and the power of two at or above its half range; without an intercept nothing can be shifted,
    /// only scaled.
    fn ranges<T: Real + FromStr>(&self) -> Vec<(T, T)> {
        let two = T::one() + T::one();
        (0..self.x[0].len())
            .map(|k| {
                let column = self.x.iter().map(|row| parse::<T>(&row[k]));
                let low = column.clone().fold(T::infinity(), T::min);
                let high = column.fold(T::neg_infinity(), T::max);
                let (mid, half) = match self.intercept {
                    true => ((low + high) / two, (high - low) / two),
                    false => (T::zero(), low.abs().max(high.abs())),
                };
                (mid, half.log2().ceil().exp2())
            })
            .collect()
    }

    fn row<T: Real + FromStr, const P: usize>(&self, x: &[String], ranges: &[(T, T)]) -> SVector<T, P> {
        let mapped: Vec<T> = x.iter().zip(ranges).map(|(x, &(mid, half))| (parse::<T>(x) - mid) / half).collect();
        let mut row = SVector::from_element(T::one());
        if self.polynomial {
            (1..P).for_each(|j| row[j] = row[j - 1] * mapped[0]);
        } else {
            let first = usize::from(self.intercept);
            mapped.iter().enumerate().for_each(|(k, &t)| row[first + k] = t);
        }
        row
    }

    /// Exact matrix that takes coefficients in the mapped variables to those in x.
    fn back<T: Real>(&self, ranges: &[(T, T)], p: usize) -> Vec<Vec<BigRational>> {
        let mut back = vec![vec![BigRational::zero(); p]; p];
        if self.polynomial {
            let (mid, half) = (exact(ranges[0].0), exact(ranges[0].1));
            // Column j holds ((x − mid) / half)^j.
            back[0][0] = BigRational::one();
            for j in 1..p {
                for i in 0..=j {
                    let raised = if i > 0 { back[i - 1][j - 1].clone() } else { BigRational::zero() };
                    back[i][j] = (raised - &mid * &back[i][j - 1]) / &half;
                }
            }
        } else {
            let first = usize::from(self.intercept);
            if self.intercept {
                back[0][0] = BigRational::one();
            }
            for (k, &(mid, half)) in ranges.iter().enumerate() {
                back[first + k][first + k] = exact(half).recip();
                if self.intercept {
                    back[0][1 + k] = -exact(mid) / exact(half);
                }
            }
        }
        back
    }
}

fn parse<T: FromStr>(text: &str) -> T {
    text.parse().unwrap_or_else(|_| panic!("{text}"))
}

/// A number, exactly: the nearest `f64` and what that leaves out.
fn exact<T: Real>(v: T) -> BigRational {
    let high = v.to_f64().unwrap();
    let low = (v - T::of(high)).to_f64().unwrap();
    BigRational::from_float(high).unwrap() + BigRational::from_float(low).unwrap()
}

/// A printed decimal, exactly.
fn decimal(text: &str) -> BigRational {
    let (mantissa, exponent) = text.split_once('E').unwrap_or((text, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits: BigInt = parse(&format!("{whole}{fraction}"));
    let power = parse::<i32>(exponent) - fraction.len() as i32;
    let ten = pow(BigRational::from_integer(10.into()), power.unsigned_abs() as usize);
    BigRational::from_integer(digits) * if power < 0 { ten.recip() } else { ten }
}

/// Log relative error: the digits of `value` that agree, and of its absolute error where zero is certified.
fn digits(value: &BigRational, certified: &BigRational) -> f64 {
    let mut error = value - certified;
    if !certified.is_zero() {
        error /= certified;
    }
    (-error.to_f64().unwrap().abs().log10()).clamp(0.0, MOST)
}

/// Digits of coefficients, standard deviations and residual standard deviation: the worst of each.
fn reached<T: Real + FromStr, const P: usize>(set: &Set, shifted: bool) -> Result<[f64; 3], SolveError<P>> {
    let ranges = match shifted {
        true => set.ranges::<T>(),
        false => vec![(T::zero(), T::one()); set.x[0].len()],
    };
    let mut factor = Factor::<T, P>::new();
    for (x, y) in set.x.iter().zip(&set.y) {
        factor.push(&set.row(x, &ranges), parse(y)).unwrap();
    }
    let fit = factor.solve()?;

    let square_root = |v: BigRational| exact(v.to_f64().unwrap().sqrt());
    let back = set.back(&ranges, P);
    let worst = |values: Vec<BigRational>, certified: &[BigRational]| {
        values.iter().zip(certified).map(|(v, c)| digits(v, c)).fold(MOST, f64::min)
    };
    let coefficients =
        back.iter().map(|row| row.iter().zip(&fit.coefficients).map(|(m, &b)| m * exact(b)).sum()).collect();
    let std = back
        .iter()
        .map(|row| {
            let terms = (0..P).flat_map(|i| (0..P).map(move |j| (i, j)));
            square_root(terms.map(|(i, j)| &row[i] * &row[j] * exact(fit.covariance[(i, j)])).sum())
        })
        .collect();
    Ok([
        worst(coefficients, &set.coefficients),
        worst(std, &set.std),
        digits(&exact(fit.residual_std), &set.residual_std),
    ])
}

/// A row of the table, and the digits of the coefficients in `f64` on shifted data.
fn table_row<const P: usize>(name: &str) -> (String, f64) {
    let set = Set::load(name);
    let cell = |reached: Result<[f64; 3], SolveError<P>>| match reached {
        Ok(digits) => digits.map(|d| format!("{:.1}", (d * 10.0).floor() / 10.0)).join(" "),
        Err(SolveError::RankDeficient(c)) => format!("refused, rank {}", c.rank),
        Err(e) => panic!("{name}: {e}"),
    };
    let shifted = reached::<f64, P>(&set, true);
    let double = reached::<DoubleDouble, P>(&set, false);
    assert!(double.as_ref().unwrap().iter().all(|&digits| digits >= IN_DOUBLE_DOUBLE), "{name}: {double:?}");
    let cells = [
        cell(reached::<f64, P>(&set, false)),
        cell(shifted),
        cell(reached::<f32, P>(&set, false)),
        cell(reached::<f32, P>(&set, true)),
        cell(double),
    ];
    (format!("| {name} | {P} | {} |\n", cells.join(" | ")), shifted.unwrap()[0])
}

#[test]
fn digits_reached_are_those_in_the_docs() {
    let rows = [
        table_row::<2>("Norris"),
        table_row::<3>("Pontius"),
        table_row::<1>("NoInt1"),
        table_row::<1>("NoInt2"),
        table_row::<11>("Filip"),
        table_row::<7>("Longley"),
        table_row::<6>("Wampler1"),
        table_row::<6>("Wampler2"),
        table_row::<6>("Wampler3"),
        table_row::<6>("Wampler4"),
        table_row::<6>("Wampler5"),
    ];
    let mut table = String::from(
        "| set | unknowns | f64 | f64, shifted | f32 | f32, shifted | double-double |\n|---|---|---|---|---|---|---|\n",
    );
    rows.iter().for_each(|(row, _)| table += row);
    println!("{table}");

    for ((name, at_least), (row, digits)) in AT_LEAST.iter().zip(&rows) {
        assert!(row.contains(name) && digits >= at_least, "{name}: {digits} digits where {at_least} are due");
    }
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/lstsq/digits.md");
    if env::var_os("UPDATE_DIGITS").is_some() {
        fs::write(&docs, &table).unwrap();
    }
    assert_eq!(fs::read_to_string(docs).unwrap(), table, "UPDATE_DIGITS=1 rewrites the table in the docs");
}
