/* Drives a component as two threads of LinuxCNC would, one call after the other. */
#include <stdio.h>

static struct __comp_state inst;

int main(int count, char **names)
{
    FILE *file = count == 2 ? fopen(names[1], "r") : NULL;
    double v[5];
    int i;

    inst._data = calloc(1, __comp_get_data_size());
    if (!file || extra_setup(&inst, 0, 0)) {
        return 1;
    }
    declare(&inst);
    solve(&inst, 0);
    printf("%d %d\n", *inst.solve_status, (int)*inst.solutions);
    *inst.tilting_sample = *inst.separation_sample = 1;
    while (fscanf(file, "%lf %lf %lf %lf %lf", &v[0], &v[1], &v[2], &v[3], &v[4]) == 5) {
        *inst.tilting_at_deg = *inst.separation_at_deg = v[0];
        *inst.tilting_dr_um = v[1];
        *inst.separation_dr_um = v[2];
        *inst.tilting_dya_um = v[3];
        *inst.tilting_dza_um = v[4];
        _(&inst, 0);
    }
    /* One that is refused. */
    *inst.separation_sample = 0;
    *inst.tilting_dr_um = NAN;
    _(&inst, 0);
    *inst.tilting_sample = 0;
    /* The copy is still that of the first call. */
    solve(&inst, 0);
    printf("%d %d\n", *inst.solve_status, (int)*inst.solutions);
    /* Nothing is solved twice of one copy. */
    solve(&inst, 0);
    printf("%d %d\n", *inst.solve_status, (int)*inst.solutions);
    printf("%d %d %d\n", (int)*inst.samples, (int)*inst.refused, *inst.status);
    for (i = 15; i < 360; i += 15) {
        *inst.e_xa_at_deg = i;
        _(&inst, 0);
        solve(&inst, 0);
        printf("%d %.17g %.17g\n", *inst.solve_status, *inst.e_xa_urad, *inst.e_xa_std_urad);
    }
    *inst.reset = 1;
    _(&inst, 0);
    solve(&inst, 0);
    printf("%d %d %d %d\n", (int)*inst.samples, (int)*inst.refused, *inst.status, *inst.solve_status);
    printf("%g %g\n", *inst.e_xa_urad, *inst.residual_um);
    return 0;
}
