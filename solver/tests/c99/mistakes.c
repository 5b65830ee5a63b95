/* Mistakes, made once each: 0 if every one is answered by its status. */
#include "tilting_table_a.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static int wrong;

#define CHECK(what) ((what) ? 0 : (wrong++, printf("line %d: " #what "\n", __LINE__)))
#define EXPECT(call, status) CHECK((call) == TILTING_TABLE_A_##status)

int main(void)
{
    static tilting_table_a_fit fit, other, before;
    static tilting_table_a_estimate estimate;
    const REAL nan = (REAL)NAN, inf = (REAL)INFINITY;
    REAL row[TILTING_TABLE_A_UNKNOWNS] = {1}, value, std;
    int i;

    EXPECT(tilting_table_a_init(NULL), NULL_POINTER);
    EXPECT(tilting_table_a_push(NULL, row, 1, 1), NULL_POINTER);
    memset(&fit, 0xff, sizeof fit);
    EXPECT(tilting_table_a_push(&fit, row, 1, 1), NOT_INITIALISED);
    EXPECT(tilting_table_a_solve(&fit, &estimate), NOT_INITIALISED);
    EXPECT(tilting_table_a_value_of_e_xa(&estimate, 150, 1, &value, &std), NOT_INITIALISED);
    EXPECT(tilting_table_a_merge(&fit, &fit), NOT_INITIALISED);

    EXPECT(tilting_table_a_init(&fit), OK);
    EXPECT(tilting_table_a_merge(&fit, NULL), NULL_POINTER);
    EXPECT(tilting_table_a_merge(&fit, &other), NOT_INITIALISED);
    EXPECT(tilting_table_a_solve(&fit, NULL), NULL_POINTER);
    EXPECT(tilting_table_a_solve(&fit, &estimate), TOO_FEW_SAMPLES);
    EXPECT(tilting_table_a_push(&fit, NULL, 1, 1), NULL_POINTER);
    for (i = 0; i < 40; i++) {
        EXPECT(tilting_table_a_push_tilting(&fit, 150, 1, 0, 0, 0), OK);
        EXPECT(tilting_table_a_push_separation(&fit, 150, 1, 0), OK);
    }
    EXPECT(tilting_table_a_solve(&fit, &estimate), CONFOUNDED);
    CHECK(estimate.confounded[0] || estimate.confounded[1]);

    before = fit;
    row[3] = nan;
    EXPECT(tilting_table_a_push(&fit, row, 1, 1), NOT_FINITE);
    row[3] = inf;
    EXPECT(tilting_table_a_push(&fit, row, 1, 1), NOT_FINITE);
    row[3] = 0;
    EXPECT(tilting_table_a_push(&fit, row, nan, 1), NOT_FINITE);
    EXPECT(tilting_table_a_push(&fit, row, 1, nan), BAD_WEIGHT);
    EXPECT(tilting_table_a_push(&fit, row, 1, -1), BAD_WEIGHT);
    EXPECT(tilting_table_a_push(&fit, row, 1, 0), OK);
    EXPECT(tilting_table_a_push(&fit, row, MAXIMUM, 1), OVERFLOW);
    EXPECT(tilting_table_a_push_tilting(&fit, 150, nan, 0, 0, 0), NOT_FINITE);
    EXPECT(tilting_table_a_push_tilting(&fit, inf, 1, 0, 0, 0), NOT_FINITE);
    EXPECT(tilting_table_a_push_tilting(&fit, MAXIMUM, 1, 0, 0, 0), NOT_FINITE);
    EXPECT(tilting_table_a_push_tilting(&fit, 150, 1, 0, inf, 0), NOT_FINITE);
    /* So many turns that nothing is known of the angle. */
    EXPECT(tilting_table_a_push_tilting(&fit, 150, (REAL)1e9, 0, 0, 0), NOT_FINITE);
    EXPECT(tilting_table_a_push_separation(&fit, 150, 1, -inf), NOT_FINITE);
    CHECK(memcmp(&before, &fit, sizeof fit) == 0);

    EXPECT(tilting_table_a_init(&fit), OK);
    for (i = 0; i < 360; i++) {
        EXPECT(tilting_table_a_push_tilting(&fit, 150, (REAL)(i * 0.0174), 0, 0, 0), OK);
        EXPECT(tilting_table_a_push_separation(&fit, 150, (REAL)(i * 0.0174), 0), OK);
    }
    EXPECT(tilting_table_a_solve(&fit, &estimate), OK);
    EXPECT(tilting_table_a_value_of_e_xa(&estimate, 150, nan, &value, &std), NOT_FINITE);
    EXPECT(tilting_table_a_value_of_e_xa(&estimate, 150, (REAL)1e9, &value, &std), NOT_FINITE);
    EXPECT(tilting_table_a_value_of_e_xa(&estimate, 150, 1, NULL, &std), NULL_POINTER);
    EXPECT(tilting_table_a_value_of_e_xa(&estimate, 150, 1, &value, &std), OK);
    CHECK(value == 0 && std == 0);
    return wrong != 0;
}
