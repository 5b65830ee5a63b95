component sphere """A touch probe and a sphere on a cradle whose axes are not where they should be.

Written down from the 4x4 products alone: it shares nothing with the program that it proves.""";
pin in float motor-#[5] "X, Y, Z in mm, A, C in degrees: where the drives are";
pin out bit touched;
pin out float off-#[3] "the probe's ball against the sphere, mm";
param rw float zero-#[3] "where the machine's zero is for the cradle's axes, mm";
param rw float ball-#[3] "the sphere on the table, mm";
param rw float sense = 1 "how A and C turn: 1 is right-handed";
param rw float touch-mm = 15 "the centres' distance at a touch";
param rw float ey0a; param rw float ez0a; param rw float eb0a; param rw float ec0a;
param rw float ex0c; param rw float ey0c; param rw float ea0c; param rw float eb0c;
param rw float ec0y "squareness, rad"; param rw float eb0z; param rw float ea0z;
param rw float scale-#[3] "of X, Y and Z";
function _ fp;
license "GPL";
;;
#include <rtapi_math.h>

/* Turns a place about x, y or z. */
static void turned(double p[3], int about, double angle)
{
    int i = (about + 1) % 3, j = (about + 2) % 3;
    double s = sin(angle), c = cos(angle), u = p[i], v = p[j];
    p[i] = c * u - s * v;
    p[j] = s * u + c * v;
}

static void tilted(double p[3], double a, double b, double c)
{
    turned(p, 0, a);
    turned(p, 1, b);
    turned(p, 2, c);
}

FUNCTION(_)
{
    const double rad = M_PI / 180;
    double p[3] = {ball(0), ball(1), ball(2)}, t[3], d = 0;
    int i;

    /* On C, on A, in the machine. */
    turned(p, 2, sense * motor(4) * rad);
    tilted(p, ea0c, eb0c, 0);
    p[0] += ex0c;
    p[1] += ey0c;
    turned(p, 0, sense * motor(3) * rad);
    tilted(p, 0, eb0a, ec0a);
    p[1] += ey0a;
    p[2] += ez0a;

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
