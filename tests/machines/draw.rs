//! Machines drawn at random: directions, axes, functions, and runs that their linear axes can follow.

use super::machine::{
    Assumed, Axis, Ball, Function, KNOWN, Machine, OF_ANGLES, OF_TRAVELS, Place, Reading, Run, ZERO, carried,
};
use super::wave::{LENGTHS, Ratio, Wave, Waves, along, dot, sum};
use rand::seq::{IndexedRandom, SliceRandom};
use rand::{Rng, RngExt};
use std::array::from_fn;

type Direction = [Ratio; 3];

/// Three directions square to each other, over their common length.
const FRAMES: [([[i64; 3]; 3], i64); 5] = [
    ([[1, 0, 0], [0, 1, 0], [0, 0, 1]], 1),
    ([[3, 4, 0], [-4, 3, 0], [0, 0, 5]], 5),
    ([[0, 5, 12], [13, 0, 0], [0, -12, 5]], 13),
    ([[1, 2, 2], [2, 1, -2], [2, -2, 1]], 3),
    ([[2, 3, 6], [3, -6, 2], [6, 2, -3]], 7),
];

/// Every machine has a run: what its axes cannot follow is drawn again.
pub fn draw(random: &mut impl Rng) -> Machine {
    loop {
        if let Some(machine) = attempt(random) {
            return machine;
        }
    }
}

fn frame(random: &mut impl Rng) -> [Direction; 3] {
    let (rows, length) = FRAMES.choose(random).unwrap();
    let mut frame = rows.map(|row| row.map(|n| Ratio::new(n, *length)));
    frame.shuffle(random);
    let turned = random.random_bool(0.5);
    frame.map(|direction| if turned { direction.map(Ratio::negated) } else { direction })
}

fn attempt(random: &mut impl Rng) -> Option<Machine> {
    let own = frame(random);
    let mut sides = [Vec::new(), Vec::new()];
    // Linear axes next to the base follow what the rest does; one between rotary axes is moved by the run.
    // Three follow paths so manifold that cubes of them take the derivation seconds.
    let linear = random.random_range(0..=3);
    let travels = if linear == 3 { &OF_TRAVELS[..3] } else { &OF_TRAVELS };
    for (name, direction) in ["X", "Y", "Z"].into_iter().zip(own).take(linear) {
        sides[random.random_range(0..2)].push(axis(name, travels, direction, random));
    }
    for name in ["A", "B", "C"].into_iter().take(random.random_range(1..=3)) {
        let direction = if random.random_bool(0.6) { *own.choose(random)? } else { frame(random)[0] };
        sides[random.random_range(0..2)].push(axis(name, &OF_ANGLES, direction, random));
    }
    for side in &mut sides {
        if random.random_bool(0.15) && side.len() > 1 && !side[0].rotary {
            side.rotate_left(1);
        }
    }
    let mut machine = Machine { sides, runs: Vec::new(), assumed: Vec::new() };
    let runs = random.random_range(1..=3);
    for _ in 0..60 {
        if machine.runs.len() < runs {
            let next = run(&machine, &own, random);
            machine.runs.extend(next);
        }
    }
    let found = machine.axes().any(|a| a.estimated.contains(&true));
    (found && !machine.runs.is_empty()).then(|| assume(machine, random))
}

fn axis(name: &'static str, listed: &'static [Function], direction: Direction, random: &mut impl Rng) -> Axis {
    let rotary = "ABC".contains(name);
    let motion: [&Function; 6] = from_fn(|_| match random.random_range(0..20) {
        0 => &KNOWN,
        1..9 => &ZERO,
        _ => listed.choose(random).unwrap_or(&ZERO),
    });
    let wanted = if rotary { 0.4 } else { 0.1 };
    let estimated = motion.map(|f| !f.suffixes.is_empty() && random.random_bool(wanted));
    Axis { name, rotary, direction, location: from_fn(|_| random.random_bool(0.5)), motion, estimated }
}

/// A run whose balls are where the instrument wants them, if the linear axes next to the base can bring them there.
fn run(machine: &Machine, own: &[Direction; 3], random: &mut impl Rng) -> Option<Run> {
    let [workpiece, tool] = &machine.sides;
    let followers = [workpiece, tool].map(|side| side.iter().take_while(|a| !a.rotary).count());
    let mut at: Vec<Place> = machine.axes().map(|axis| place(axis, random)).collect();
    let tool_at = workpiece.len();
    let outer = (0..followers[0]).map(|i| (i, -1)).chain((0..followers[1]).map(|i| (tool_at + i, 1)));
    let outer: Vec<(usize, i64)> = outer.collect();
    for (i, _) in &outer {
        at[*i] = Place::Travelled(Wave::default());
    }
    let stands =
        at[tool_at..].iter().zip(tool).all(|(p, a)| !a.rotary || matches!(p, Place::Rest | Place::Turned(0, 0)));
    let at_workpiece = ball(machine, own, random);
    let mut at_tool = if stands { Waves::default() } else { ball(machine, own, random) };
    let there = carried(workpiece, &at[..tool_at], &at_workpiece);
    let (bar, reading) = instrument(machine, &at[..tool_at], own, random);
    let here = carried(tool, &at[tool_at..], &at_tool);
    let mut left = sum(&sum(&there, &bar), &here.map(|w| w.scaled(Ratio::new(-1, 1))));
    if stands && random.random_bool(0.8) {
        at_tool = left.each_ref().map(Wave::constant);
        left = sum(&left, &at_tool.each_ref().map(|w| w.scaled(Ratio::new(-1, 1))));
    }
    for (i, sign) in outer {
        let direction = machine.axes().nth(i)?.direction;
        let by = dot(&left, &direction);
        left = sum(&left, &along(&direction.map(Ratio::negated), &by));
        let still = by.is_zero() && random.random_bool(0.7);
        at[i] = if still { Place::Rest } else { Place::Travelled(by.scaled(Ratio::new(sign, 1))) };
    }
    let follows = left.iter().all(Wave::is_zero) && at.iter().any(Place::moves);
    let mut setup = |side: usize| {
        let used = machine.runs.iter().filter_map(|r| r.balls[side].setup).max().map_or(0, |n| n + 1);
        random.random_bool(0.9).then(|| random.random_range(0..=used))
    };
    let setups = [setup(0), setup(1)];
    let balls = [Ball { at: at_workpiece, setup: setups[0] }, Ball { at: at_tool, setup: setups[1] }];
    follows.then_some(Run { at, balls, reading })
}

/// Where an axis that follows nothing is along a run.
fn place(axis: &Axis, random: &mut impl Rng) -> Place {
    match (axis.rotary, random.random_range(0..10)) {
        (_, 0..3) => Place::Rest,
        (true, 3) => Place::Turned(0, 0),
        (true, 4) => Place::Turned(0, random.random_range(1..4)),
        (true, 5) => Place::Turned(*[-1, 2, -2, 3].choose(random).unwrap_or(&2), random.random_range(0..4)),
        (true, _) => Place::Turned(1, 0),
        (false, 3..6) => Place::Travelled(Wave::default()),
        (false, _) => Place::Travelled(Wave::length(2, Ratio::ONE)),
    }
}

/// A ball near, on, or away from the axes.
fn ball(machine: &Machine, own: &[Direction; 3], random: &mut impl Rng) -> Waves {
    let length = random.random_range(1..LENGTHS.len());
    let directions: Vec<Direction> = machine.axes().filter(|a| a.rotary).map(|a| a.direction).chain(*own).collect();
    match random.random_range(0..8) {
        0 => Waves::default(),
        1 => from_fn(|i| Wave::length(1 + i % 2, Ratio::new(1, 1 + i as i64))),
        _ => directions.choose(random).map_or_else(Waves::default, |d| along(d, &Wave::length(length, Ratio::ONE))),
    }
}

/// From the workpiece's ball to the tool's, and what is read.
fn instrument(machine: &Machine, at: &[Place], own: &[Direction; 3], random: &mut impl Rng) -> (Waves, Reading) {
    let bar = Wave::length(0, Ratio::ONE);
    let circle = |length: &Wave, random: &mut _| {
        let [cos, sin] = Wave::turn(*[1, 1, -1, 2].choose(random).unwrap_or(&1), 0);
        sum(&along(&own[0], &length.times(&cos)), &along(&own[1], &length.times(&sin)))
    };
    let fixed = |random: &mut _| along(own.choose(random).unwrap_or(&own[0]), &bar);
    match random.random_range(0..8) {
        0 => (circle(&bar, random), Reading::Bar),
        1 | 2 => (fixed(random), Reading::Bar),
        3..6 => {
            let nominal = fixed(random);
            let axes = machine.sides[0].iter().zip(at).filter(|(axis, _)| axis.rotary);
            (axes.rev().fold(nominal, |p, (axis, place)| axis.carried(place, &p)), Reading::Bar)
        }
        6 => (Waves::default(), Reading::Probe(along(&frame(random)[0], &Wave::number(Ratio::ONE)))),
        _ => {
            let [cos, sin] = Wave::turn(1, 0);
            let probe = sum(&along(&own[0], &cos), &along(&own[1], &sin));
            (Waves::default(), Reading::Probe(probe))
        }
    }
}

/// Now and then something is assumed.
fn assume(mut machine: Machine, random: &mut impl Rng) -> Machine {
    let mut assumed: Vec<Assumed> = Vec::new();
    for axis in machine.axes() {
        let located = (0..6).filter(|c| axis.location[*c]).map(|c| axis.location_name(c));
        let coefficients: Vec<String> = (0..6).flat_map(|c| axis.coefficients(c)).collect();
        let names: Vec<String> = located.chain(coefficients.iter().cloned()).collect();
        match random.random_range(0..12) {
            0 => assumed.extend(
                names
                    .choose(random)
                    .map(|name| Assumed { line: format!("{name} = \"0\""), terms: vec![(name.clone(), Ratio::ONE)] }),
            ),
            1 if coefficients.len() > 1 => {
                let factor = Ratio::new(random.random_range(1..4), random.random_range(-3..0));
                let mut pair = coefficients.clone();
                pair.shuffle(random);
                assumed.push(Assumed {
                    line: format!("{} = \"{factor}*{}\"", pair[0], pair[1]),
                    terms: vec![(pair[0].clone(), Ratio::ONE), (pair[1].clone(), factor.negated())],
                });
            }
            2 => {
                let waves = (0..6).find(|c| axis.motion[*c].suffixes.first() == Some(&"_cos1"));
                assumed.extend(waves.map(|c| Assumed {
                    line: format!("{} = \"0 at {} = 0\"", axis.motion_name(c), axis.name.to_lowercase()),
                    terms: axis.coefficients(c).filter(|n| n.contains("cos")).map(|n| (n, Ratio::ONE)).collect(),
                }));
            }
            _ => {}
        }
    }
    machine.assumed = assumed;
    machine
}
