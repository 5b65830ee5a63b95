use trunnion_solver::Machine;

#[derive(Machine)]
pub struct Table(f64);

fn main() {}
