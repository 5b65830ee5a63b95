// A machine of a tilting table A and slides Y, Z, and what a bar on it reads: every pose by products of 4x4 matrices with all
// errors in them, rotations whole. Written from the paper's equations (1) to (4) by hand; shares nothing with what it tests.
component plant "A tilting table with errors, and a ball-bar on it";

pin in float a-cmd "degrees";
pin in float y-cmd "mm";
pin in float z-cmd "mm";
pin in float a-motor "Where the control has sent A to, degrees";
pin in float y-motor "mm";
pin in float z-motor "mm";
pin in bit tilting "Record this run";
pin in bit separation "Record this run";

pin out bit at-tilting "A sample of this run";
pin out bit at-separation "A sample of this run";
pin out bit at-any "A sample";
pin out float sweep-deg "Of the run, as commanded";
pin out float dr-um "What the bar reads";
pin out float dya-um "d_ya where A is commanded to be, measured otherwise";
pin out float dza-um "d_za there";
pin out float error-urad "How far the table is turned beyond what is commanded";
pin out s32 way "1 where the sweep increases, -1 where it decreases";

param rw float radius-mm = 150;
param rw float noise-um = 0.1 "Readings are wrong by at most this";
param rw u32 seed = 1;
param rw float hysteresis-urad = 0 "Difference of A's angular error between the directions";
param rw float ripple-urad = 0 "Amplitude of an error of A in sin(12 a), which the model does not have";
param rw float setup-## [9] "mm: ball on the table in either run, ball of the tool";
param rw float location-## [7] "mm or rad: EY0A, EZ0A, EB0A, EC0A, EC0Y, EA0Z, EB0Z";
param rw float a-## [22] "mm or rad: EXA, EBA, ECA, each of cos a - 1, sin a, cos 2a - 1, sin 2a; EYA, EZA the same; EAA of both quartics";
param rw float y-## [12] "1, 1/mm: EXY, EYY, EZY, EAY, EBY, ECY, each of y, y^2";
param rw float z-## [12] "the same of Z";

variable int going = 1;
variable double last_a = 0;
variable double unwrapped = 0;
variable unsigned drawn = 0;
function _ fp;
license "MIT OR Apache-2.0";
;;
#include <math.h>

typedef struct { double m[4][4]; } Pose;

static Pose moved(double x, double y, double z)
{
    Pose p = {{{1, 0, 0, x}, {0, 1, 0, y}, {0, 0, 1, z}, {0, 0, 0, 1}}};
    return p;
}

/* About axis 0, 1, 2 = x, y, z. */
static Pose turned(int axis, double angle)
{
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    Pose p = moved(0, 0, 0);
    p.m[i][i] = p.m[j][j] = cos(angle);
    p.m[i][j] = -sin(angle);
    p.m[j][i] = sin(angle);
    return p;
}

static Pose times(Pose a, Pose b)
{
    Pose p;
    int i, j, k;
    for (i = 0; i < 4; i++)
        for (j = 0; j < 4; j++)
            for (p.m[i][j] = 0, k = 0; k < 4; k++) p.m[i][j] += a.m[i][k] * b.m[k][j];
    return p;
}

/* Six errors: along x, y, z, then about them. */
static Pose wrong(const double e[6])
{
    return times(moved(e[0], e[1], e[2]), times(turned(2, e[5]), times(turned(1, e[4]), turned(0, e[3]))));
}

static double distance(Pose a, Pose b)
{
    return sqrt(pow(a.m[0][3] - b.m[0][3], 2) + pow(a.m[1][3] - b.m[1][3], 2) + pow(a.m[2][3] - b.m[2][3], 2));
}

static double whole_turn(double t) { return t - 2 * M_PI * floor(t / (2 * M_PI)); }

/* Four functions of a that vanish at 0. */
static double fourier(struct __comp_state *__comp_inst, int first, double t)
{
    return a(first) * (cos(t) - 1) + a(first + 1) * sin(t) + a(first + 2) * (cos(2 * t) - 1) + a(first + 3) * sin(2 * t);
}

/* The paper's equation (10), in a polynomial's nested form. */
static double quartic(struct __comp_state *__comp_inst, double t)
{
    const double p = M_PI;
    t = whole_turn(t);
    return a(20) * t * (4 * p * p * p + t * (-2 * p * p + t * (-2 * p + t))) + a(21) * t * (2 * p * p + t * (-3 * p + t));
}

static double uniform(unsigned *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state / 2147483648.0 - 1;
}

/* The table where A was sent: (1). */
static __attribute__((noinline)) Pose table_of(struct __comp_state *__comp_inst, double t)
{
    const double e[6] = {
        fourier(__comp_inst, 0, t), fourier(__comp_inst, 12, t), fourier(__comp_inst, 16, t),
        quartic(__comp_inst, t) + ripple_urad * 1e-6 * sin(12 * t) + going * hysteresis_urad * 0.5e-6,
        fourier(__comp_inst, 4, t), fourier(__comp_inst, 8, t),
    };
    Pose p = moved(0, location(0), location(1));
    p = times(p, turned(2, location(3)));
    p = times(p, turned(1, location(2)));
    p = times(p, wrong(e));
    return times(p, turned(0, t));
}

/* The tool where Y and Z were sent: (2), and its ball. */
static __attribute__((noinline)) Pose tool_of(struct __comp_state *__comp_inst, double y_at, double z_at)
{
    double ey[6], ez[6];
    Pose p = turned(2, location(4));
    int i;

    for (i = 0; i < 6; i++) {
        ey[i] = y_at * (y(2 * i) + y_at * y(2 * i + 1));
        ez[i] = z_at * (z(2 * i) + z_at * z(2 * i + 1));
    }
    p = times(p, moved(0, y_at, 0));
    p = times(p, wrong(ey));
    p = times(p, turned(1, location(6)));
    p = times(p, turned(0, location(5)));
    p = times(p, moved(0, 0, z_at));
    p = times(p, wrong(ez));
    return times(p, moved(setup(6), setup(7), setup(8)));
}

FUNCTION(_)
{
    const double rad = M_PI / 180, r = radius_mm;
    double before, step, turn;
    Pose table, tool, ball;
    int inside;

    if (a_cmd != last_a) going = a_cmd > last_a ? 1 : -1;
    table = table_of(__comp_inst, a_motor * rad);
    tool = tool_of(__comp_inst, y_motor, z_motor);

    /* The angle by which the table's y is turned about the machine's x. */
    turn = atan2(table.m[2][1], table.m[1][1]) - a_cmd * rad;
    error_urad = (turn - 2 * M_PI * round(turn / (2 * M_PI))) * 1e6;
    dya_um = fourier(__comp_inst, 12, a_cmd * rad) * 1e3;
    dza_um = fourier(__comp_inst, 16, a_cmd * rad) * 1e3;

    /* The separation's sweep is where the tool is on its circle, whole turns counted. */
    before = unwrapped;
    step = atan2(z_cmd, y_cmd) - unwrapped;
    unwrapped += step - 2 * M_PI * round(step / (2 * M_PI));
    sweep_deg = tilting ? a_cmd : unwrapped / rad;
    step = tilting ? a_cmd - last_a : unwrapped - before;
    way = step > 0 ? 1 : step < 0 ? -1 : 0;
    last_a = a_cmd;

    ball = tilting ? moved(setup(0), r + setup(1), r + setup(2)) : moved(setup(3), setup(4), setup(5));
    dr_um = (distance(times(table, ball), tool) - r) * 1e3;

    inside = way != 0 && sweep_deg >= 0 && sweep_deg <= 360;
    at_tilting = tilting && inside;
    at_separation = !tilting && separation && inside;
    at_any = at_tilting || at_separation;
    /* Drawn for samples alone, so that every session has the same. */
    if (!drawn) drawn = seed;
    if (at_any) dr_um += noise_um * uniform(&drawn);
}
