use trunnion_solver::Machine;

#[derive(Machine)]
#[machine(caption = "A table under two slides", constants(R, L), estimate(ECC))]
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

fn main() {}
