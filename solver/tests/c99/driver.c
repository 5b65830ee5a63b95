/* Fits the samples of a file, once in order and once merged from two halves, and prints what the estimate holds. */
#include "tilting_table_a.h"

#include <math.h>
#include <stdio.h>

static tilting_table_a_status take(tilting_table_a_fit *fit, const double v[5])
{
    const tilting_table_a_status status =
        tilting_table_a_push_tilting(fit, 150, (REAL)v[0], (REAL)v[1], (REAL)v[3], (REAL)v[4]);
    return status ? status : tilting_table_a_push_separation(fit, 150, (REAL)v[0], (REAL)v[2]);
}

static int print(const tilting_table_a_fit *fit)
{
    static tilting_table_a_estimate estimate;
    int i;

    if (tilting_table_a_solve(fit, &estimate)) {
        return 1;
    }
    for (i = 0; i < TILTING_TABLE_A_UNKNOWNS; i++) {
        printf("%.17g\n", (double)estimate.value[i]);
    }
    for (i = 0; i < TILTING_TABLE_A_UNKNOWNS; i++) {
        printf("%.17g\n", sqrt((double)estimate.covariance[i][i]));
    }
    printf("%.17g\n", (double)estimate.residual_std);
    for (i = 0; i <= 360; i += 30) {
        REAL value, std;
        if (tilting_table_a_value_of_e_xa(&estimate, 150, (REAL)(i * 0.017453292519943295), &value, &std)) {
            return 1;
        }
        printf("%.17g\n%.17g\n", (double)value, (double)std);
    }
    return 0;
}

int main(int count, char **names)
{
    static tilting_table_a_fit whole, first, second;
    FILE *file = count == 2 ? fopen(names[1], "r") : NULL;
    double v[5];
    int n = 0, status = tilting_table_a_init(&whole) + tilting_table_a_init(&first) + tilting_table_a_init(&second);

    while (file && fscanf(file, "%lf %lf %lf %lf %lf", &v[0], &v[1], &v[2], &v[3], &v[4]) == 5) {
        status += take(&whole, v) + take(n++ < 180 ? &first : &second, v);
    }
    status += tilting_table_a_merge(&first, &second);
    return status || n != 360 || print(&whole) || print(&first);
}
