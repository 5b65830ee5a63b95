component sphere """A touch probe and a sphere on a cradle whose axes are not where they should be.

Written down from the 4x4 products alone: it shares nothing with the program that it proves.""";
pin in float motor-#[5] "X, Y, Z in mm, the axis that tilts and C in degrees: where the drives are";
pin out bit touched;
pin out float off-#[3] "the probe's ball against the sphere, mm";
param rw u32 about "what the axis that tilts turns about: 0 is x, 1 is y";
param rw float zero-#[3] "where the machine's zero is for the cradle's axes, mm";
param rw float ball-#[3] "the sphere on the table, mm";
param rw float sense-#[2] = 1 "how the axis that tilts and C turn: 1 is right-handed";
param rw float touch-mm = 15 "the centres' distance at a touch";
param rw float tilting-#[6] "where the axis that tilts is off: mm along X, Y, Z, rad about them";
param rw float turning-#[6] "the same of C";
param rw float ec0y "squareness, rad"; param rw float eb0z; param rw float ea0z;
param rw float scale-#[3] "of X, Y and Z";
function _ fp;
license "GPL";
;;
#include <rtapi_math.h>

/* Turns a place about x, y or z. */
static void turned(double p[3], int axis, double angle)
{
    int i = (axis + 1) % 3, j = (axis + 2) % 3;
    double s = sin(angle), c = cos(angle), u = p[i], v = p[j];
    p[i] = c * u - s * v;
    p[j] = s * u + c * v;
}

FUNCTION(_)
{
    const double rad = M_PI / 180;
    double p[3] = {ball(0), ball(1), ball(2)}, t[3], d = 0;
    int i;

    /* On C, on the axis that tilts, in the machine. */
    turned(p, 2, sense(1) * motor(4) * rad);
    for (i = 0; i < 3; i++) {
        turned(p, i, turning(i + 3));
    }
    for (i = 0; i < 3; i++) {
        p[i] += turning(i);
    }
    turned(p, about, sense(0) * motor(3) * rad);
    for (i = 0; i < 3; i++) {
        turned(p, i, tilting(i + 3));
    }
    for (i = 0; i < 3; i++) {
        p[i] += tilting(i);
    }

    for (i = 0; i < 3; i++) {
        t[i] = (motor(i) - zero(i)) * (1 + scale(i));
    }
    /* Y leans by EC0Y towards -x, Z by EB0Z towards x and by EA0Z towards -y. */
    t[0] += eb0z * t[2] - ec0y * t[1];
    t[1] -= ea0z * t[2];
    for (i = 0; i < 3; i++) {
        off(i) = t[i] - p[i];
        d += off(i) * off(i);
    }
    touched = d < touch_mm * touch_mm;
}
