//! What finds a sphere's centre, in the words of each control.

use super::Control;

/// What has to stand before everything else.
pub(super) fn declared(control: Control) -> &'static [&'static str] {
    if control == Control::Sinumerik { &["DEF INT ERR"] } else { &[] }
}

/// What is set at a program's beginning, with what each value is: a register of its own on controls whose variables have no names.
pub(super) fn setting(control: Control, place: usize, name: &str, value: f64, what: &str) -> String {
    let register = 101 + place;
    match control {
        Control::LinuxCnc => format!("#<_{name}> = {value} ; {what}"),
        Control::Sinumerik => format!("R{register}={value} ; {what}"),
        Control::Heidenhain => format!("Q{register} = {value} ; {what}"),
        Control::Fanuc => format!("#{register}={value:.3} ({})", what.to_ascii_uppercase()),
    }
}

/// What was tried of these programs.
pub(super) fn tried(control: Control) -> &'static str {
    match control {
        Control::LinuxCnc => "run in LinuxCNC's simulation, NOT ON A MACHINE",
        _ => "UNVERIFIED TEMPLATE, written from manuals: NOT RUN ON A CONTROL",
    }
}

/// Millimetres, absolute; each block to its end.
pub(super) fn prepare(control: Control) -> &'static [&'static str] {
    match control {
        Control::LinuxCnc => &["G21 G90 G94 G17 G40 G49 G61"],
        Control::Sinumerik => &["G710 G90 G94 G17 G40 G60"],
        Control::Heidenhain => &[],
        Control::Fanuc => &["G21 G90 G94 G17 G40 G49 G61"],
    }
}

/// Up to the height at which the rotary axes turn.
pub(super) fn safe(control: Control) -> &'static str {
    match control {
        Control::LinuxCnc => "G0 Z#<_safe>",
        Control::Sinumerik => "G0 Z=R106",
        Control::Heidenhain => "L Z+Q106 R0 FMAX",
        Control::Fanuc => "G0 Z#106",
    }
}

/// What writes the readings' header.
pub(super) fn begin(control: Control, name: &str, header: &str) -> Vec<String> {
    match control {
        Control::LinuxCnc => vec![format!("(LOGOPEN,{name}.csv)"), format!("(LOG,{header})")],
        Control::Sinumerik => vec![format!("WRITE(ERR,\"{}\",\"{header}\")", file(name))],
        Control::Heidenhain => Vec::new(),
        Control::Fanuc => vec!["POPEN".to_owned()],
    }
}

/// Finds the centre that nominally is at a place, mm, at a sweep, degrees, and writes the reading.
pub(super) fn find(control: Control, name: &str, place: [f64; 4]) -> Vec<String> {
    let [x, y, z, sweep] = place.map(|value| format!("{:.6}", value + 0.0));
    match control {
        Control::LinuxCnc => vec![format!("o300 call [{x}] [{y}] [{z}] [{sweep}]")],
        Control::Sinumerik => vec![
            format!("R1={x} R2={y} R3={z} R4={sweep}"),
            "REPEAT FIND FOUND".to_owned(),
            format!("WRITE(ERR,\"{}\",\"\"<<R4<<\",\"<<R13<<\",\"<<R14<<\",\"<<R10)", file(name)),
        ],
        Control::Heidenhain => {
            let set = |(at, value): (usize, &String)| format!("Q{} = {value}", at + 1);
            let set = [x, y, z, sweep].iter().enumerate().map(set).collect::<Vec<_>>();
            [set, vec!["CALL LBL 1".to_owned()]].concat()
        }
        Control::Fanuc => vec![format!("G65 P9001 X{x} Y{y} Z{z} S{sweep}")],
    }
}

/// Ends the readings.
pub(super) fn end(control: Control) -> &'static [&'static str] {
    match control {
        Control::LinuxCnc => &["(LOGCLOSE)"],
        Control::Sinumerik | Control::Heidenhain => &[],
        Control::Fanuc => &["PCLOS"],
    }
}

/// The part that is the same for all positions, where it has to stand before them.
pub(super) fn before(control: Control) -> &'static str {
    if control == Control::LinuxCnc { include_str!("sphere/linuxcnc.ngc") } else { "" }
}

/// The program's end, and the same part where it stands behind that.
pub(super) fn behind(control: Control) -> &'static str {
    match control {
        Control::LinuxCnc => "M2",
        Control::Sinumerik => include_str!("sphere/sinumerik.mpf"),
        Control::Heidenhain => include_str!("sphere/heidenhain.h"),
        Control::Fanuc => include_str!("sphere/fanuc.nc"),
    }
}

/// A file's name on a SINUMERIK.
fn file(name: &str) -> String {
    let letters = name.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_uppercase() } else { '_' });
    format!("{}_CSV", letters.collect::<String>())
}
