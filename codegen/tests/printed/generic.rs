//! The Rust that is printed: the checked-in file is what is printed today, and computes what the graph does.

use std::path::Path;

use quote::quote;
use trunnion_codegen::emit::rust::{self, Support};

use super::compare::{STRUT, STRUT_SCALE, TILTING, assert_close, points, tilting_scale};
use super::functions::{strut, tilting};
use super::generated;

/// With `UPDATE_GENERATED` set the file is written instead.
#[test]
fn the_checked_in_file_is_what_is_printed() {
    let printed = rust::source(
        &[tilting().function, strut().function],
        "tests/printed/functions.rs",
        &Support::in_file(&quote!(super::support)),
    );
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/printed/generated.rs");
    if std::env::var_os("UPDATE_GENERATED").is_some() {
        std::fs::write(path, printed).unwrap();
    } else {
        assert_eq!(std::fs::read_to_string(path).unwrap(), printed, "set UPDATE_GENERATED to write it anew");
    }
}

#[test]
fn rust_computes_the_row() {
    let case = tilting();
    for point in points(&TILTING, 1000) {
        let doubles = generated::tilting(point[0], point[1]);
        for (index, (actual, expected)) in doubles.into_iter().zip(case.expected(&point)).enumerate() {
            assert_close(actual, expected, tilting_scale(index, &point), f64::EPSILON, &format!("f64 {index}"));
        }
        let single = [point[0] as f32, point[1] as f32];
        let rounded = single.map(f64::from);
        let singles = generated::tilting(single[0], single[1]);
        for (index, (actual, expected)) in singles.into_iter().zip(case.expected(&rounded)).enumerate() {
            let scale = tilting_scale(index, &rounded);
            assert_close(actual.into(), expected, scale, f32::EPSILON.into(), &format!("f32 {index}"));
        }
    }
}

#[test]
fn rust_computes_residual_and_jacobian() {
    let case = strut();
    for point in points(&STRUT, 1000) {
        let (residual, jacobian, lean) = generated::strut(point[0], point[1], point[2], point[3], point[4]);
        let actual = residual.into_iter().chain(jacobian.into_iter().flatten()).chain(lean);
        for (index, (actual, expected)) in actual.zip(case.expected(&point)).enumerate() {
            assert_close(actual, expected, STRUT_SCALE, f64::EPSILON, &format!("output {index}"));
        }
    }
}
