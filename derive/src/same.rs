//! File, builder and macro describe one machine: the same equations, the same functions.

use super::expand;
use quote::{format_ident, quote};
use syn::parse_quote;
use trunnion_codegen::emit::equations;
use trunnion_codegen::emit::rust::{Owner, Support, model_items};
use trunnion_codegen::model::{Draft, DraftAxis, DraftBall, DraftBasis, DraftReading, DraftRun};
use trunnion_codegen::{catalogue, problems};

const CLOSED: [&str; 3] = ["f(0) = 0", "f(2*pi) = f(0)", "f'(2*pi) = f'(0)"];

fn built() -> Draft {
    let order = ["d_yz2", "e_xy2", "e_xy1", "d_yz1", "d_yy1", "o_ya", "o_za", "w_z1", "w_y2", "w_z2", "d_zz1"];
    let circle = |run: DraftRun| run.at("Y", "R*cos(a)").at("Z", "R*sin(a)");
    let tool = || DraftBall::origin().setup(["t_x1", "t_y1", "t_z1"]);
    let square = || DraftBasis::polynomial(2, [""; 0]);
    Draft::new("tilting-table-a", "Tilting table (axis A) measured with a ball-bar and the linear axes Y and Z")
        .notation("paper")
        .constant("R")
        .on_workpiece(DraftAxis::rotary("A", "x").located(["EY0A", "EZ0A", "EB0A", "EC0A"]))
        .on_tool(DraftAxis::linear("Y", "y").located(["EC0Y"]))
        .on_tool(DraftAxis::linear("Z", "z").located(["EA0Z", "EB0Z"]))
        .rename("EC0Y", "s_xy")
        .estimate("e_xa")
        .order(order)
        .run(
            circle(DraftRun::new("tilting", "a", DraftReading::bar("R")).at("A", "a"))
                .workpiece_ball(DraftBall::at(["0", "R", "R"]).setup(["w_x1", "w_y1", "w_z1"]))
                .tool_ball(tool()),
        )
        .run(
            circle(DraftRun::new("separation", "a", DraftReading::bar("R")).at("A", "rest"))
                .workpiece_ball(DraftBall::origin().setup(["w_x2", "w_y2", "w_z2"]))
                .tool_ball(tool()),
        )
        .function("d_yy", square())
        .function("d_zy", square())
        .function("e_xy", square())
        .function("d_yz", square())
        .function("d_zz", square())
        .function("d_ya", DraftBasis::Known)
        .function("d_za", DraftBasis::Known)
        .function("e_xa", DraftBasis::polynomial(4, CLOSED))
        .assume("s_xz", "0")
}

#[test]
fn file_builder_and_macro_give_the_same_equations() {
    let source = catalogue::source("tilting-table-a").unwrap();
    let (file, derived) = problems::read_and_derive(&format!("{source}\n[assume]\ns_xz = \"0\"\n")).unwrap();
    let builder = built().build().unwrap();
    let from_builder = problems::derivation(&builder).unwrap();
    assert_eq!(equations::json(&builder, &from_builder), equations::json(&file, &derived));

    let expanded = expand(&parse_quote! {
        #[machine(
            notation = "paper",
            constants(R),
            estimate(e_xa),
            order(d_yz2, e_xy2, e_xy1, d_yz1, d_yy1, o_ya, o_za, w_z1, w_y2, w_z2, d_zz1),
            names(EC0Y = "s_xy")
        )]
        #[run(
            tilting,
            sweep = "a",
            at(A = "a", Y = "R*cos(a)", Z = "R*sin(a)"),
            workpiece_ball(at("0", "R", "R"), setup(w_x1, w_y1, w_z1)),
            tool_ball(setup(t_x1, t_y1, t_z1)),
            bar = "R"
        )]
        #[run(
            separation,
            sweep = "a",
            at(A = "rest", Y = "R*cos(a)", Z = "R*sin(a)"),
            workpiece_ball(setup(w_x2, w_y2, w_z2)),
            tool_ball(setup(t_x1, t_y1, t_z1)),
            bar = "R"
        )]
        #[function(d_yy = polynomial(2), d_zy = polynomial(2), e_xy = polynomial(2))]
        #[function(d_yz = polynomial(2), d_zz = polynomial(2), d_ya = known, d_za = known)]
        #[function(e_xa = polynomial(4, "f(0) = 0", "f(2*pi) = f(0)", "f'(2*pi) = f'(0)"))]
        #[assume(s_xz = "0")]
        struct TiltingTable {
            #[workpiece(rotary = "x", location(EY0A, EZ0A, EB0A, EC0A))]
            a: f64,
            #[tool(linear = "y", location(EC0Y))]
            y: f64,
            #[tool(linear = "z", location(EA0Z, EB0Z))]
            z: f64,
        }
    });
    let (owner, support) =
        (Owner::Type(format_ident!("TiltingTable")), Support::in_macro(&quote!(::trunnion_solver::generated)));
    let items = model_items(&file, &derived, &owner, &support).unwrap();
    assert_eq!(expanded.unwrap().to_string(), items.to_string());
}
