#![no_std]

extern crate std;

use trunnion_solver::Machine;

#[derive(Machine)]
#[machine(title = "A table under two slides", constants(R, L), estimate(ECC))]
#[run(
    tangential,
    sweep = "c",
    at(C = "c", X = "L*cos(c) - R*sin(c)", Y = "L*sin(c) + R*cos(c)"),
    workpiece_ball(at("L", "0", "0"), setup(w_x, w_y, w_z)),
    tool_ball(setup(t_x, t_y, t_z)),
    bar = "R"
)]
#[function(EXC = known, EYC = known, ECC = fourier(2))]
#[function(EXX = polynomial(2), EYX = polynomial(1), ECX = zero, EXY = zero, EYY = polynomial(2))]
pub struct Table {
    #[workpiece(rotary = "z", location(EX0C, EY0C, EC0C))]
    pub c: f64,
    #[tool(linear = "x")]
    pub x: f64,
    #[tool(linear = "y", location("EC(0X)Y"))]
    pub y: f64,
}

fn main() {
    let (row, known): ([f32; Table::TANGENTIAL.len()], [f32; 2]) = Table::tangential(150.0, 80.0, 0.3);
    assert!(row.iter().chain(&known).all(|v| v.is_finite()));
    assert_eq!(Table::ecc(150.0, 80.0, 0.0_f64), [1.0, 0.0, 1.0, 0.0]);
    assert!(Table::TANGENTIAL.iter().all(|at| *at < Table::NAMES.len()));

    let mut fit: TableJoint<f32> = Table::fit(TableLengths { r: 150.0, l: 80.0 }).unwrap();
    for i in 0..60_u8 {
        fit.push_tangential(f32::from(i) * 0.1, 0.001, 0.0, 0.0).unwrap();
    }
    fit.merge(&fit.clone()).unwrap();
    assert!(Table::fit(TableLengths { r: 150.0, l: -80.0_f64 }).is_err_and(|e| e.name == "L"));
}
