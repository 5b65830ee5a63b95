//! A machine of one's own by the builder: its equations are printed.

use trunnion_codegen::emit::equations;
use trunnion_codegen::model::{Draft, DraftAxis, DraftBall, DraftBasis, DraftReading, DraftRun};
use trunnion_codegen::problems::{self, Colour, render};

fn main() -> Result<(), String> {
    let draft = Draft::new("table", "A rotary table and the bar that is held against it")
        .constant("R")
        .on_workpiece(DraftAxis::rotary("C", "z").located(["EX0C", "EY0C"]))
        .run(
            DraftRun::new("along-x", "c", DraftReading::bar("R"))
                .at("C", "c")
                .workpiece_ball(DraftBall::origin().setup(["w_x", "w_y", "w_z"]))
                .tool_ball(DraftBall::at(["R", "0", "0"]).setup(["t_x", "t_y", "t_z"])),
        )
        .function("EXC", DraftBasis::polynomial(4, ["f(0) = 0", "f(2*pi) = f(0)"]))
        .estimate("EXC");
    let told = |problems: Vec<_>| render("table", "", &problems, Colour::Off);
    let model = draft.build().map_err(told)?;
    let derivation = problems::derivation(&model).map_err(told)?;
    let text = equations::text(&model, &derivation);
    print!("{text}");
    assert!(text.contains("EX0C and t_x only appear as −EX0C + t_x (k1)"));
    Ok(())
}
