//! What the macro accepts and how it refuses.

#[test]
fn good_and_bad_use() {
    let cases = trybuild::TestCases::new();
    cases.pass("tests/ui/good.rs");
    cases.compile_fail("tests/ui/bad/*.rs");
}
