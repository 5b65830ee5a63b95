//! The ring test as an NC program for a SINUMERIK 840D sl.

use super::{Compensation, CompensationError};
use std::fmt::Write;
use trunnion_solver::exechon::Machine;

/// Why there is no program.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NcError {
    /// The ring's compensation cannot be computed.
    #[error("{0}\n  expected a ring within the workspace, and at least 7 touches")]
    Compensation(#[from] CompensationError),
    /// The ball does not fit into the ring.
    #[error(
        "the stylus ball and the clearance do not fit into the ring\n  expected a smaller ball, less clearance or a larger ring"
    )]
    NoRoom,
}

/// An NC program that touches a ring from inside and writes the touches to a file.
///
/// `ring` and `ball` are radii in mm. The control computes the spindle angle from the quintic E(10) before each touch.
/// Written from the control's documentation, not run on one: a person who knows the machine edits and proves it.
///
/// # Errors
/// [`NcError`].
pub fn ring_program(
    machine: &Machine<f64>,
    centre: [f64; 3],
    ring: f64,
    ball: f64,
    touches: u32,
    repeats: u32,
    clearance: f64,
) -> Result<String, NcError> {
    let path = ring - ball;
    if !(path > clearance && clearance > 0.0) {
        return Err(NcError::NoRoom);
    }
    let quintic = Compensation::fit(machine, centre, path, touches)?;
    let mut coefficients = String::new();
    for (n, c) in quintic.coefficients.iter().enumerate() {
        // Writing to a string does not fail.
        let _ = writeln!(coefficients, "DEF REAL C{n}={:.12}", c.to_degrees());
    }
    let [x, y, z] = centre;
    let residual = quintic.at_touches.to_degrees();
    Ok(format!(
        "\
; RING TEST with compensation of the dependent rotation (DRM), SINUMERIK 840D sl
; Made by trunnion; NOT RUN ON A CONTROL: check every line marked (*), prove it in single block at low override.
;
; The ring's bore is touched from inside at N angles, REPEATS times. Before each touch the spindle turns to
; PHI(THETA) = C0 + C1*THETA + ... + C5*THETA**5 (degrees, THETA in radians), so that the probe keeps its orientation.
; PHI is within {residual:.4} degrees of the inverse kinematics at these touches.
; For the same test without compensation set COMPENSATE=0; for the reversed spindle set REVERSE=180.

DEF REAL CX={x:.4}, CY={y:.4}, CZ={z:.4} ; centre of the ring, at the ball's height
DEF REAL PATH={path:.4}   ; radius of the ring less that of the ball
DEF REAL CLEAR={clearance:.4}  ; begin of the measuring feed before the wall
DEF REAL OVER=1.0      ; measuring way beyond the wall
DEF REAL SAFE=50.0     ; retract above the ring, along the tool (*)
DEF REAL FMEAS=100.0, FPOS=1000.0 ; mm/min (*) the feed at which the probe is calibrated
DEF INT N={touches}, REPEATS={repeats}, COMPENSATE=1
DEF REAL REVERSE=0.0
{coefficients}DEF INT K, R, ERR
DEF REAL THETA, PHI

G90 G94 G710 G17
; (*) activate here the frame and transformation in which X Y Z are the tool's coordinates at home: G500, TRAORI, …
; (*) switch the probe on: M-function of the machine
G1 F=FPOS X=CX Y=CY Z=CZ-SAFE   ; Z points from the spindle into the work
Z=CZ

FOR R=1 TO REPEATS
  FOR K=0 TO N-1
    THETA=2*3.14159265358979*K/N
    PHI=C0+THETA*(C1+THETA*(C2+THETA*(C3+THETA*(C4+THETA*C5))))
    PHI=PHI*COMPENSATE+REVERSE
    IF PHI<0
      PHI=PHI+360
    ENDIF
    IF PHI>=360
      PHI=PHI-360
    ENDIF
    SPOS=PHI                        ; (*) sense of the spindle angle; SPOS waits until it stands
    G1 F=FPOS X=CX+(PATH-CLEAR)*COS(K*360/N) Y=CY+(PATH-CLEAR)*SIN(K*360/N)
    MEAS=1 G1 F=FMEAS X=CX+(PATH+OVER)*COS(K*360/N) Y=CY+(PATH+OVER)*SIN(K*360/N)
    STOPRE
    IF $AC_MEA[1]==0
      SETAL(65000)                  ; (*) no touch: alarm text of the machine
      STOPRE
      M0
    ENDIF
    ; columns x_mm,y_mm,z_mm,spindle_deg: the file is read by `trunnion exechon ring`
    WRITE(ERR,\"RING_RESULT\",<<$AA_MW[X]<<\",\"<<$AA_MW[Y]<<\",\"<<$AA_MW[Z]<<\",\"<<PHI)
    G1 F=FPOS X=CX Y=CY             ; retract to the centre
  ENDFOR
ENDFOR

G1 F=FPOS Z=CZ-SAFE
; (*) switch the probe off
M30
"
    ))
}
