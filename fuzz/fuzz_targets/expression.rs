//! Expressions wherever a description has one: read, given a meaning, or told with a place.
#![no_main]

use libfuzzer_sys::fuzz_target;
use trunnion_codegen::model::{Draft, DraftAxis, DraftBall, DraftBasis, DraftReading, DraftRun, parse, parse_equation};
use trunnion_fuzz::repeated;

fuzz_target!(|text: &str| {
    let _ = repeated(|| (parse(text), parse_equation(text)));
    // A path that no machine need have: what an expression means is told before a reading is made of it.
    repeated(|| {
        let ball = DraftBall::at([text, "R", "0"]).setup(["w_x", "w_y", "w_z"]);
        let run = DraftRun::new("one", "a", DraftReading::bar("R"));
        Draft::new("m", "m")
            .constant("R")
            .constant("L")
            .on_workpiece(DraftAxis::rotary("A", "x").along([text, "0", "1"]).located(["EY0A", "EZ0A"]))
            .on_workpiece(DraftAxis::rotary("C", "z"))
            .on_tool(DraftAxis::linear("Y", "y"))
            .run(run.define("d", text).at("A", "a").at("C", text).at("Y", text).workpiece_ball(ball))
            .function("EXA", DraftBasis::polynomial(3, [text]))
            .function("EYA", DraftBasis::Fourier(1))
            .assume("EYA_cos1", text)
            .build()
            .map(|model| format!("{model:?}"))
    })
    .ok();
});
