//! The firmware's output: `name = value` a line.

use std::{fs, path::Path, process::Command};

/// Options of the machine. Under `-icount shift=0` an instruction takes one nanosecond of its time.
const OPTIONS: &str = "-M mps2-an386 -nographic -monitor none -serial none -semihosting -icount shift=0 -kernel";

/// What a program prints: run in QEMU if it is one, read if it is text.
pub fn output(file: &Path) -> Result<String, String> {
    let bytes = fs::read(file).map_err(|e| format!("{}: {e}", file.display()))?;
    if !bytes.starts_with(b"\x7fELF") {
        return String::from_utf8(bytes).map_err(|e| format!("{}: {e}", file.display()));
    }
    let run = Command::new("timeout").args(["120", "qemu-system-arm"]).args(OPTIONS.split(' ')).arg(file).output();
    let run = run.map_err(|e| format!("qemu-system-arm: {e}"))?;
    let text = String::from_utf8_lossy(&run.stdout).into_owned();
    if run.status.success() { Ok(text) } else { Err(format!("{}: {}\n{text}", file.display(), run.status)) }
}

/// The lines `name = value`.
pub fn values(text: &str) -> impl Iterator<Item = (&str, &str)> {
    text.lines().filter_map(|line| line.split_once(" = "))
}
