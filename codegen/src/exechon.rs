//! The Exechon-type parallel machine: its closure equations as expressions, with their derivatives.
//!
//! Equations E(1)–E(5) as mended: joint coordinates are signed, the orientation is a rotation, and E(5) is closed with the A
//! axis' own y direction and its branch sign.
//! Lengths in mm; p = (x, y, z) is the moving platform's origin in base coordinates.

use crate::emit::{Function, Input, Output};
use crate::graph::{Graph, Id, Symbol, Unbound};

type IdVector = [Id; 3];

/// The platform's origin.
const PLATFORM: [&str; 3] = ["x", "y", "z"];

/// What the functions take: dimensions, the point on the spindle axis, the tool's direction, the platform's origin.
#[rustfmt::skip]
const INPUTS: [&str; 16] = [
    "xu", "ys2", "xr", "yr5", "ycp", "zc", "yt", "sx", "sy", "sz", "tx", "ty", "tz", "x", "y", "z",
];

fn symbol(g: &mut Graph, name: &str) -> Id {
    let at = INPUTS.iter().position(|input| *input == name);
    g.symbol(Symbol::Input(at.map_or(u32::MAX, |at| at as u32)))
}

/// The inputs of these names, which are among [`INPUTS`], then the platform's origin.
fn inputs(names: &[&str]) -> Vec<Input> {
    let wanted = names.iter().chain(&PLATFORM);
    wanted.filter_map(|name| Input::all(&INPUTS).into_iter().find(|input| input.name() == *name)).collect()
}

/// The functions of the machine, in the order in which they are printed: `orientation`, `struts`, `closure`.
///
/// # Errors
/// None unless this file is wrong: an output would use a symbol that its function does not take.
pub fn functions() -> Result<[Function; 3], Unbound> {
    Ok([orientation()?, struts()?, closure()?])
}

/// E(4).
fn orientation() -> Result<Function, Unbound> {
    let mut g = Graph::new();
    let axes = axes(&mut g);
    Function::new(
        &g,
        "orientation",
        &["Orientation E(4) of the moving platform: its x, y and z axes, one a row."],
        inputs(&["ys2"]),
        &[Output::matrix("axes", &axes)],
    )
}

/// E(1)–E(3) and their derivatives.
fn struts() -> Result<Function, Unbound> {
    let mut g = Graph::new();
    let [x_axis, y_axis, _] = axes(&mut g);
    let p = PLATFORM.map(|name| symbol(&mut g, name));
    let [xu, ys2, xr, yr5] = ["xu", "ys2", "xr", "yr5"].map(|name| symbol(&mut g, name));
    let lengths = [(x_axis, xr, 0, xu), (y_axis, yr5, 1, ys2), (x_axis, xr, 0, xu)];
    let signs = [-1, 1, 1];
    let mut named = Vec::new();
    for (at, ((axis, joint, along, base), sign)) in lengths.into_iter().zip(signs).enumerate() {
        let sign = g.integer(sign);
        let mut squares = [Id::ZERO; 3];
        for (k, square) in squares.iter_mut().enumerate() {
            let arm = g.product(&[sign, joint, axis[k]]);
            let foot = if k == along { g.product(&[sign, base]) } else { Id::ZERO };
            let end = g.sum(&[p[k], arm]);
            let strut = g.difference(end, foot);
            *square = g.power(strut, 2);
        }
        let square = g.sum(&squares);
        named.push((format!("l{}", at + 1), g.sqrt(square)));
    }
    let outputs: Vec<Id> = named.iter().map(|(_, id)| *id).collect();
    let jacobian = jacobian(&mut g, &[outputs[0], outputs[1], outputs[2]], p);
    Function::new(
        &g,
        "struts",
        &["Strut lengths E(1)-E(3) and their derivatives by the platform's position."],
        inputs(&["xu", "ys2", "xr", "yr5"]),
        &[Output::array("lengths", &named), Output::matrix("jacobian", &jacobian)],
    )
}

/// E(5): v − yt·ŷA, with v = pS − p − R·[0, yCp, zC] and ŷA = σ·(ẑ − (ẑ·t) t)/|ẑ − (ẑ·t) t|.
fn closure() -> Result<Function, Unbound> {
    let mut g = Graph::new();
    let [_, y_axis, z_axis] = axes(&mut g);
    let p = PLATFORM.map(|name| symbol(&mut g, name));
    let t = ["tx", "ty", "tz"].map(|name| symbol(&mut g, name));
    let ps = ["sx", "sy", "sz"].map(|name| symbol(&mut g, name));
    let [ycp, zc, yt] = ["ycp", "zc", "yt"].map(|name| symbol(&mut g, name));

    let along = dot(&mut g, z_axis, t);
    let mut across = [Id::ZERO; 3];
    for (across, (&z, t)) in across.iter_mut().zip(z_axis.iter().zip(t)) {
        let part = g.product(&[along, t]);
        *across = g.difference(z, part);
    }
    let square = dot(&mut g, across, across);
    let norm = g.sqrt(square);
    let mut residual = [Id::ZERO; 3];
    for (k, residual) in residual.iter_mut().enumerate() {
        let from_y = g.product(&[ycp, y_axis[k]]);
        let from_z = g.product(&[zc, z_axis[k]]);
        let arm = g.sum(&[p[k], from_y, from_z]);
        let v = g.difference(ps[k], arm);
        let y_a = g.quotient(across[k], norm);
        let offset = g.product(&[yt, y_a]);
        *residual = g.difference(v, offset);
    }
    let jacobian = jacobian(&mut g, &residual, p);
    let named: Vec<_> = residual.iter().zip(PLATFORM).map(|(&id, name)| (format!("f_{name}"), id)).collect();
    Function::new(
        &g,
        "closure",
        &[
            "Closure E(5) of the tool's loop and its derivatives by the platform's position: zero where the platform",
            "at (x, y, z) lets the A axis point the tool along t with the spindle axis through (sx, sy, sz).",
            "",
            "`yt` carries the branch's sign: the A axis' y offset times the sign of sin A.",
        ],
        inputs(&["ys2", "ycp", "zc", "yt", "sx", "sy", "sz", "tx", "ty", "tz"]),
        &[Output::array("residual", &named), Output::matrix("jacobian", &jacobian)],
    )
}

/// The platform's axes, E(4). The x axis of the base carries the outer gimbals, so ŷ has no x component.
fn axes(g: &mut Graph) -> [IdVector; 3] {
    let [x, y, z] = PLATFORM.map(|name| symbol(g, name));
    let ys2 = symbol(g, "ys2");
    let (yy, zz) = (g.power(y, 2), g.power(z, 2));
    let q_square = g.sum(&[yy, zz]);
    let q = g.sqrt(q_square);
    let lever = g.product(&[ys2, y]);
    let big = g.difference(q_square, lever);
    let (big_square, x_square) = (g.power(big, 2), g.power(x, 2));
    let aside = g.product(&[x_square, q_square]);
    let k1_square = g.sum(&[big_square, aside]);
    let k1 = g.sqrt(k1_square);

    let minus = g.integer(-1);
    let (xy, xz) = (g.product(&[minus, x, y]), g.product(&[minus, x, z]));
    let x_axis = [big, xy, xz].map(|part| g.quotient(part, k1));
    let down = g.product(&[minus, y]);
    let y_axis = [Id::ZERO, z, down].map(|part| g.quotient(part, q));
    let (yp, zp) = (g.product(&[y, big]), g.product(&[z, big]));
    let k1q = g.product(&[k1, q]);
    let across = g.product(&[x, q_square]);
    let z_axis = [across, yp, zp].map(|part| g.quotient(part, k1q));
    [x_axis, y_axis, z_axis]
}

fn dot(g: &mut Graph, a: IdVector, b: IdVector) -> Id {
    let mut terms = [Id::ZERO; 3];
    for (term, (a, b)) in terms.iter_mut().zip(a.into_iter().zip(b)) {
        *term = g.product(&[a, b]);
    }
    g.sum(&terms)
}

/// ∂f/∂p, one row for each of f.
fn jacobian(g: &mut Graph, f: &IdVector, p: IdVector) -> [IdVector; 3] {
    let columns = p.map(|variable| g.derivatives(f, variable));
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| columns[column][row]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_platform_s_axes_are_a_right_handed_rotation() {
        let mut g = Graph::new();
        let axes = axes(&mut g);
        let at = inputs(&["ys2"]).iter().map(Input::symbol).zip([450.0, -235.0, 15.0, 1156.0]).collect::<Vec<_>>();
        let value = |id| g.evaluate(id, &at).unwrap();
        let [x, y, z] = axes.map(|axis| axis.map(value));
        let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        for (a, b, product) in [(x, x, 1.0), (y, y, 1.0), (z, z, 1.0), (x, y, 0.0), (y, z, 0.0), (z, x, 0.0)] {
            assert!((dot(a, b) - product).abs() < 1e-15);
        }
        assert!((x[0] * y[1] - x[1] * y[0] - z[2]).abs() < 1e-15);
    }

    #[test]
    fn the_functions_take_what_they_use() {
        for function in functions().unwrap() {
            let operations = function.program().operations();
            assert!(operations.roots >= 2 && operations.divisions > 0, "{operations:?}");
        }
    }
}
