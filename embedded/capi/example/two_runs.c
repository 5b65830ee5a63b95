/*
 * The paper's two runs, fitted sample by sample through the C interface: the page to copy from.
 *
 *     two_runs tilting.csv separation.csv table.csv
 *
 * On a machine there are no files: the encoder gives the angle and the ball-bar the reading, in the cyclic task, and one
 * push takes them. The memory of the fit is the variable `fit`; put it where the controller keeps its own.
 */
#include "trunnion.h"

#include <stdio.h>

#define RADIUS_MM 150.0
#define DEGREE 0.017453292519943295

/* The cells of a line `a_deg,x_um[,y_um]`; how many there are, or 0 at the end of the file. */
static int next_line(FILE *file, double *a, double *x, double *y)
{
    char line[200];
    int cells = fgets(line, sizeof line, file) ? sscanf(line, "%lf,%lf,%lf", a, x, y) : 0;
    return cells > 0 ? cells : 0;
}

static int fail(const char *what, TrunnionStatus status)
{
    fprintf(stderr, "%s: status %d\n", what, (int)status);
    return 1;
}

int main(int count, char **names)
{
    static TrunnionJointF64 fit;
    TrunnionEstimateF64 estimate;
    TrunnionStatus status;
    FILE *tilting, *separation, *table;
    double a, reading, unused, known_y, known_z;
    char heading[200];
    int degree;

    if (count != 4) {
        fprintf(stderr, "usage: two_runs tilting.csv separation.csv table.csv\n");
        return 2;
    }
    tilting = fopen(names[1], "r");
    separation = fopen(names[2], "r");
    table = fopen(names[3], "r");
    if (!tilting || !separation || !table || !fgets(heading, sizeof heading, tilting) ||
        !fgets(heading, sizeof heading, separation) || !fgets(heading, sizeof heading, table)) {
        fprintf(stderr, "the runs cannot be read\n");
        return 2;
    }

    /* Before the first sample: what the bar's length is. */
    status = trunnion_joint_f64_init(&fit, RADIUS_MM);
    if (status != TRUNNION_STATUS_OK) {
        return fail("init", status);
    }

    /* Run 1, one call a sample. A sample that is refused (NaN from a loose plug, say) has not touched the fit. */
    while (next_line(tilting, &a, &reading, &unused) == 2 && next_line(table, &unused, &known_y, &known_z) == 3) {
        status = trunnion_joint_f64_push_tilting(&fit, a * DEGREE, reading * 1e-3, known_y * 1e-3, known_z * 1e-3);
        if (status != TRUNNION_STATUS_OK) {
            return fail("tilting", status);
        }
    }
    /* Run 2. */
    while (next_line(separation, &a, &reading, &unused) == 2) {
        status = trunnion_joint_f64_push_separation(&fit, a * DEGREE, reading * 1e-3);
        if (status != TRUNNION_STATUS_OK) {
            return fail("separation", status);
        }
    }

    /* Whenever wanted: the estimate. Too few samples or too short an arc is a status, and `confounded` says what it hides. */
    status = trunnion_joint_f64_solve(&fit, &estimate);
    if (status != TRUNNION_STATUS_OK) {
        fprintf(stderr, "coefficients not separated: 0x%lx\n", (unsigned long)estimate.confounded);
        return fail("solve", status);
    }
    for (degree = 0; degree <= 360; degree += 30) {
        TrunnionEpsXaF64 at;
        status = trunnion_eps_xa_f64(&estimate, degree * DEGREE, &at);
        if (status != TRUNNION_STATUS_OK) {
            return fail("eps_xa", status);
        }
        printf("f64 joint %d = %.9f %.9f\n", degree, at.value * 1e6, at.band * 1e6);
    }
    fclose(tilting);
    fclose(separation);
    fclose(table);
    return 0;
}
