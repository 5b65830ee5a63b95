M30
; the sphere's centre is nominally at Q1 Q2 Q3, the sweep is Q4
LBL 1
Q11 = Q101 + Q102
Q12 = Q3 + Q11
L X+Q1 Y+Q2 R0 FMAX
L Z+Q12 R0 FMAX
Q5 = 0
Q6 = 0
Q7 = - 1
CALL LBL 3
Q10 = Q23 - Q101
L Z+Q12 R0 FMAX
Q8 = Q1 + Q11
Q9 = Q2
Q5 = - 1
Q7 = 0
CALL LBL 2
Q13 = Q21
Q8 = Q1 - Q11
Q5 = 1
CALL LBL 2
Q13 = ( Q13 + Q21 ) / 2
Q8 = Q13
Q9 = Q2 + Q11
Q5 = 0
Q6 = - 1
CALL LBL 2
Q14 = Q22
Q9 = Q2 - Q11
Q6 = 1
CALL LBL 2
Q15 = ( Q14 - Q22 ) / 2
Q14 = ( Q14 + Q22 ) / 2
L X+Q13 Y+Q14 R0 FMAX
Q6 = 0
Q7 = - 1
CALL LBL 3
; with the radius that the equator has shown
Q10 = Q23 - Q15
L Z+Q106 R0 FMAX
; where the probe should have to go, less where it has to: a row of the readings is Q4, Q31, Q32, Q33
Q31 = Q1 - Q13
Q32 = Q2 - Q14
Q33 = Q3 - Q10
STOP
LBL 0
; from Q8 Q9 at the height Q10 in the direction Q5 Q6, and up to the height Q12
LBL 2
L X+Q8 Y+Q9 R0 FMAX
L Z+Q10 R0 FMAX
CALL LBL 3
L X+Q8 Y+Q9 R0 FQ104
L Z+Q12 R0 FMAX
LBL 0
; touches in the direction Q5 Q6 Q7: the place is in Q21 Q22 Q23
LBL 3
Q16 = 2 * Q102
TCH PROBE 4.0 MEASURING IN 3-D
TCH PROBE 4.1 Q21
TCH PROBE 4.2 IX+Q5 IY+Q6 IZ+Q7
TCH PROBE 4.3 DIST+Q16 FQ105 MB+Q103 REFERENCE SYSTEM:0
LBL 0
