/*
 * Every mistake that the C interface answers, made once. Ends with 0 if each was answered as it should be.
 */
#include "trunnion.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static int wrong;

#define CHECK(what) ((what) ? 0 : (wrong++, printf("line %d: " #what "\n", __LINE__)))
#define EXPECT(call, status) CHECK((call) == TRUNNION_STATUS_##status)

/* All mistakes that can be made with the joint in float. */
static void joint_f32(void)
{
    static TrunnionJointF32 fit, never;
    static TrunnionTwoStepF32 other;
    TrunnionEstimateF32 estimate;
    TrunnionEpsXaF32 at;
    float nan = (float)NAN, inf = (float)INFINITY;
    int i;

    EXPECT(trunnion_joint_f32_init(NULL, 150), NULL_POINTER);
    EXPECT(trunnion_joint_f32_init((TrunnionJointF32 *)(void *)((char *)&fit + 1), 150), MISALIGNED);
    EXPECT(trunnion_joint_f32_init(&fit, 0), IMPOSSIBLE_RADIUS);
    EXPECT(trunnion_joint_f32_init(&fit, -150), IMPOSSIBLE_RADIUS);
    EXPECT(trunnion_joint_f32_init(&fit, nan), IMPOSSIBLE_RADIUS);
    EXPECT(trunnion_joint_f32_init(&fit, inf), IMPOSSIBLE_RADIUS);
    EXPECT(trunnion_joint_f32_push_separation(&fit, 1, 0), NOT_INITIALISED);

    EXPECT(trunnion_joint_f32_push_tilting(&never, 1, 0, 0, 0), NOT_INITIALISED);
    memset(&never, 0xff, sizeof never);
    EXPECT(trunnion_joint_f32_push_tilting(&never, 1, 0, 0, 0), NOT_INITIALISED);
    EXPECT(trunnion_joint_f32_push_separation(&never, 1, 0), NOT_INITIALISED);
    EXPECT(trunnion_joint_f32_solve(&never, &estimate), NOT_INITIALISED);
    EXPECT(trunnion_two_step_f32_init(&other, 150), OK);
    EXPECT(trunnion_joint_f32_solve((TrunnionJointF32 *)(void *)&other, &estimate), NOT_INITIALISED);
    CHECK(!estimate.valid);
    EXPECT(trunnion_eps_xa_f32(&estimate, 1, &at), NOT_INITIALISED);

    EXPECT(trunnion_joint_f32_init(&fit, 150), OK);
    EXPECT(trunnion_joint_f32_solve(&fit, &estimate), TOO_FEW_SAMPLES);
    EXPECT(trunnion_joint_f32_solve(&fit, NULL), NULL_POINTER);
    EXPECT(trunnion_joint_f32_solve(NULL, &estimate), NULL_POINTER);
    EXPECT(trunnion_joint_f32_push_tilting(NULL, 1, 0, 0, 0), NULL_POINTER);
    EXPECT(trunnion_joint_f32_push_separation(NULL, 1, 0), NULL_POINTER);
    EXPECT(trunnion_joint_f32_push_tilting(&fit, nan, 0, 0, 0), NOT_FINITE);
    EXPECT(trunnion_joint_f32_push_tilting(&fit, inf, 0, 0, 0), NOT_FINITE);
    EXPECT(trunnion_joint_f32_push_tilting(&fit, 1, nan, 0, 0), NOT_FINITE);
    EXPECT(trunnion_joint_f32_push_tilting(&fit, 1, 0, inf, 0), NOT_FINITE);
    EXPECT(trunnion_joint_f32_push_tilting(&fit, 1, 0, 0, -inf), NOT_FINITE);
    EXPECT(trunnion_joint_f32_push_separation(&fit, nan, 0), NOT_FINITE);
    EXPECT(trunnion_joint_f32_push_separation(&fit, 1, inf), NOT_FINITE);

    /* All samples at one angle. */
    for (i = 0; i < 100; i++) {
        EXPECT(trunnion_joint_f32_push_tilting(&fit, 1, 0, 0, 0), OK);
        EXPECT(trunnion_joint_f32_push_separation(&fit, 1, 0), OK);
    }
    EXPECT(trunnion_joint_f32_solve(&fit, &estimate), CONFOUNDED);
    CHECK(!estimate.valid);
    CHECK(estimate.confounded != 0);

    /* After all of that the fit still takes samples and gives what they say: nothing. */
    EXPECT(trunnion_joint_f32_init(&fit, 150), OK);
    for (i = 0; i < 360; i++) {
        float a = (float)(i * 0.017453292519943295);
        EXPECT(trunnion_joint_f32_push_tilting(&fit, a, 0, 0, 0), OK);
        EXPECT(trunnion_joint_f32_push_separation(&fit, a, 0), OK);
    }
    EXPECT(trunnion_joint_f32_push_separation(&fit, 1, FLT_MAX), OVERFLOW);
    EXPECT(trunnion_joint_f32_merge(&fit, NULL), NULL_POINTER);
    EXPECT(trunnion_joint_f32_merge(NULL, &fit), NULL_POINTER);
    EXPECT(trunnion_joint_f32_merge(&fit, &never), NOT_INITIALISED);
    EXPECT(trunnion_joint_f32_init(&never, 100), OK);
    EXPECT(trunnion_joint_f32_merge(&fit, &never), DIFFERENT_RADIUS);
    EXPECT(trunnion_joint_f32_merge(&fit, &fit), OK);
    EXPECT(trunnion_joint_f32_solve(&fit, &estimate), OK);
    EXPECT(trunnion_eps_xa_f32(NULL, 1, &at), NULL_POINTER);
    EXPECT(trunnion_eps_xa_f32(&estimate, 1, NULL), NULL_POINTER);
    EXPECT(trunnion_eps_xa_f32(&estimate, nan, &at), NOT_FINITE);
    EXPECT(trunnion_eps_xa_f32(&estimate, FLT_MAX, &at), NOT_FINITE);
    EXPECT(trunnion_eps_xa_f32(&estimate, 1, &at), OK);
    CHECK(at.value == 0 && at.std == 0 && at.band == 0);
}

/* All mistakes that can be made with the joint in double. */
static void joint_f64(void)
{
    static TrunnionJointF64 fit, never;
    static TrunnionTwoStepF64 other;
    TrunnionEstimateF64 estimate;
    TrunnionEpsXaF64 at;
    double nan = (double)NAN, inf = (double)INFINITY;
    int i;

    EXPECT(trunnion_joint_f64_init(NULL, 150), NULL_POINTER);
    EXPECT(trunnion_joint_f64_init((TrunnionJointF64 *)(void *)((char *)&fit + 1), 150), MISALIGNED);
    EXPECT(trunnion_joint_f64_init(&fit, 0), IMPOSSIBLE_RADIUS);
    EXPECT(trunnion_joint_f64_init(&fit, -150), IMPOSSIBLE_RADIUS);
    EXPECT(trunnion_joint_f64_init(&fit, nan), IMPOSSIBLE_RADIUS);
    EXPECT(trunnion_joint_f64_init(&fit, inf), IMPOSSIBLE_RADIUS);
    EXPECT(trunnion_joint_f64_push_separation(&fit, 1, 0), NOT_INITIALISED);

    EXPECT(trunnion_joint_f64_push_tilting(&never, 1, 0, 0, 0), NOT_INITIALISED);
    memset(&never, 0xff, sizeof never);
    EXPECT(trunnion_joint_f64_push_tilting(&never, 1, 0, 0, 0), NOT_INITIALISED);
    EXPECT(trunnion_joint_f64_push_separation(&never, 1, 0), NOT_INITIALISED);
    EXPECT(trunnion_joint_f64_solve(&never, &estimate), NOT_INITIALISED);
    EXPECT(trunnion_two_step_f64_init(&other, 150), OK);
    EXPECT(trunnion_joint_f64_solve((TrunnionJointF64 *)(void *)&other, &estimate), NOT_INITIALISED);
    CHECK(!estimate.valid);
    EXPECT(trunnion_eps_xa_f64(&estimate, 1, &at), NOT_INITIALISED);

    EXPECT(trunnion_joint_f64_init(&fit, 150), OK);
    EXPECT(trunnion_joint_f64_solve(&fit, &estimate), TOO_FEW_SAMPLES);
    EXPECT(trunnion_joint_f64_solve(&fit, NULL), NULL_POINTER);
    EXPECT(trunnion_joint_f64_solve(NULL, &estimate), NULL_POINTER);
    EXPECT(trunnion_joint_f64_push_tilting(NULL, 1, 0, 0, 0), NULL_POINTER);
    EXPECT(trunnion_joint_f64_push_separation(NULL, 1, 0), NULL_POINTER);
    EXPECT(trunnion_joint_f64_push_tilting(&fit, nan, 0, 0, 0), NOT_FINITE);
    EXPECT(trunnion_joint_f64_push_tilting(&fit, inf, 0, 0, 0), NOT_FINITE);
    EXPECT(trunnion_joint_f64_push_tilting(&fit, 1, nan, 0, 0), NOT_FINITE);
    EXPECT(trunnion_joint_f64_push_tilting(&fit, 1, 0, inf, 0), NOT_FINITE);
    EXPECT(trunnion_joint_f64_push_tilting(&fit, 1, 0, 0, -inf), NOT_FINITE);
    EXPECT(trunnion_joint_f64_push_separation(&fit, nan, 0), NOT_FINITE);
    EXPECT(trunnion_joint_f64_push_separation(&fit, 1, inf), NOT_FINITE);

    /* All samples at one angle. */
    for (i = 0; i < 100; i++) {
        EXPECT(trunnion_joint_f64_push_tilting(&fit, 1, 0, 0, 0), OK);
        EXPECT(trunnion_joint_f64_push_separation(&fit, 1, 0), OK);
    }
    EXPECT(trunnion_joint_f64_solve(&fit, &estimate), CONFOUNDED);
    CHECK(!estimate.valid);
    CHECK(estimate.confounded != 0);

    /* After all of that the fit still takes samples and gives what they say: nothing. */
    EXPECT(trunnion_joint_f64_init(&fit, 150), OK);
    for (i = 0; i < 360; i++) {
        double a = (double)(i * 0.017453292519943295);
        EXPECT(trunnion_joint_f64_push_tilting(&fit, a, 0, 0, 0), OK);
        EXPECT(trunnion_joint_f64_push_separation(&fit, a, 0), OK);
    }
    EXPECT(trunnion_joint_f64_push_separation(&fit, 1, DBL_MAX), OVERFLOW);
    EXPECT(trunnion_joint_f64_merge(&fit, NULL), NULL_POINTER);
    EXPECT(trunnion_joint_f64_merge(NULL, &fit), NULL_POINTER);
    EXPECT(trunnion_joint_f64_merge(&fit, &never), NOT_INITIALISED);
    EXPECT(trunnion_joint_f64_init(&never, 100), OK);
    EXPECT(trunnion_joint_f64_merge(&fit, &never), DIFFERENT_RADIUS);
    EXPECT(trunnion_joint_f64_merge(&fit, &fit), OK);
    EXPECT(trunnion_joint_f64_solve(&fit, &estimate), OK);
    EXPECT(trunnion_eps_xa_f64(NULL, 1, &at), NULL_POINTER);
    EXPECT(trunnion_eps_xa_f64(&estimate, 1, NULL), NULL_POINTER);
    EXPECT(trunnion_eps_xa_f64(&estimate, nan, &at), NOT_FINITE);
    EXPECT(trunnion_eps_xa_f64(&estimate, DBL_MAX, &at), NOT_FINITE);
    EXPECT(trunnion_eps_xa_f64(&estimate, 1, &at), OK);
    CHECK(at.value == 0 && at.std == 0 && at.band == 0);
}

/* All mistakes that can be made with the two_step in float. */
static void two_step_f32(void)
{
    static TrunnionTwoStepF32 fit, never;
    static TrunnionJointF32 other;
    TrunnionEstimateF32 estimate;
    TrunnionEpsXaF32 at;
    float nan = (float)NAN, inf = (float)INFINITY;
    int i;

    EXPECT(trunnion_two_step_f32_init(NULL, 150), NULL_POINTER);
    EXPECT(trunnion_two_step_f32_init((TrunnionTwoStepF32 *)(void *)((char *)&fit + 1), 150), MISALIGNED);
    EXPECT(trunnion_two_step_f32_init(&fit, 0), IMPOSSIBLE_RADIUS);
    EXPECT(trunnion_two_step_f32_init(&fit, -150), IMPOSSIBLE_RADIUS);
    EXPECT(trunnion_two_step_f32_init(&fit, nan), IMPOSSIBLE_RADIUS);
    EXPECT(trunnion_two_step_f32_init(&fit, inf), IMPOSSIBLE_RADIUS);
    EXPECT(trunnion_two_step_f32_push_separation(&fit, 1, 0), NOT_INITIALISED);

    EXPECT(trunnion_two_step_f32_push_tilting(&never, 1, 0, 0, 0), NOT_INITIALISED);
    memset(&never, 0xff, sizeof never);
    EXPECT(trunnion_two_step_f32_push_tilting(&never, 1, 0, 0, 0), NOT_INITIALISED);
    EXPECT(trunnion_two_step_f32_push_separation(&never, 1, 0), NOT_INITIALISED);
    EXPECT(trunnion_two_step_f32_solve(&never, &estimate), NOT_INITIALISED);
    EXPECT(trunnion_joint_f32_init(&other, 150), OK);
    EXPECT(trunnion_two_step_f32_solve((TrunnionTwoStepF32 *)(void *)&other, &estimate), NOT_INITIALISED);
    CHECK(!estimate.valid);
    EXPECT(trunnion_eps_xa_f32(&estimate, 1, &at), NOT_INITIALISED);

    EXPECT(trunnion_two_step_f32_init(&fit, 150), OK);
    EXPECT(trunnion_two_step_f32_solve(&fit, &estimate), TOO_FEW_SAMPLES);
    EXPECT(trunnion_two_step_f32_solve(&fit, NULL), NULL_POINTER);
    EXPECT(trunnion_two_step_f32_solve(NULL, &estimate), NULL_POINTER);
    EXPECT(trunnion_two_step_f32_push_tilting(NULL, 1, 0, 0, 0), NULL_POINTER);
    EXPECT(trunnion_two_step_f32_push_separation(NULL, 1, 0), NULL_POINTER);
    EXPECT(trunnion_two_step_f32_push_tilting(&fit, nan, 0, 0, 0), NOT_FINITE);
    EXPECT(trunnion_two_step_f32_push_tilting(&fit, inf, 0, 0, 0), NOT_FINITE);
    EXPECT(trunnion_two_step_f32_push_tilting(&fit, 1, nan, 0, 0), NOT_FINITE);
    EXPECT(trunnion_two_step_f32_push_tilting(&fit, 1, 0, inf, 0), NOT_FINITE);
    EXPECT(trunnion_two_step_f32_push_tilting(&fit, 1, 0, 0, -inf), NOT_FINITE);
    EXPECT(trunnion_two_step_f32_push_separation(&fit, nan, 0), NOT_FINITE);
    EXPECT(trunnion_two_step_f32_push_separation(&fit, 1, inf), NOT_FINITE);

    /* All samples at one angle. */
    for (i = 0; i < 100; i++) {
        EXPECT(trunnion_two_step_f32_push_tilting(&fit, 1, 0, 0, 0), OK);
        EXPECT(trunnion_two_step_f32_push_separation(&fit, 1, 0), OK);
    }
    EXPECT(trunnion_two_step_f32_solve(&fit, &estimate), CONFOUNDED);
    CHECK(!estimate.valid);

    /* After all of that the fit still takes samples and gives what they say: nothing. */
    EXPECT(trunnion_two_step_f32_init(&fit, 150), OK);
    for (i = 0; i < 360; i++) {
        float a = (float)(i * 0.017453292519943295);
        EXPECT(trunnion_two_step_f32_push_tilting(&fit, a, 0, 0, 0), OK);
        EXPECT(trunnion_two_step_f32_push_separation(&fit, a, 0), OK);
    }
    EXPECT(trunnion_two_step_f32_push_separation(&fit, 1, FLT_MAX), OVERFLOW);
    EXPECT(trunnion_two_step_f32_solve(&fit, &estimate), OK);
    EXPECT(trunnion_eps_xa_f32(NULL, 1, &at), NULL_POINTER);
    EXPECT(trunnion_eps_xa_f32(&estimate, 1, NULL), NULL_POINTER);
    EXPECT(trunnion_eps_xa_f32(&estimate, nan, &at), NOT_FINITE);
    EXPECT(trunnion_eps_xa_f32(&estimate, FLT_MAX, &at), NOT_FINITE);
    EXPECT(trunnion_eps_xa_f32(&estimate, 1, &at), OK);
    CHECK(at.value == 0 && at.std == 0 && at.band == 0);
}

/* All mistakes that can be made with the two_step in double. */
static void two_step_f64(void)
{
    static TrunnionTwoStepF64 fit, never;
    static TrunnionJointF64 other;
    TrunnionEstimateF64 estimate;
    TrunnionEpsXaF64 at;
    double nan = (double)NAN, inf = (double)INFINITY;
    int i;

    EXPECT(trunnion_two_step_f64_init(NULL, 150), NULL_POINTER);
    EXPECT(trunnion_two_step_f64_init((TrunnionTwoStepF64 *)(void *)((char *)&fit + 1), 150), MISALIGNED);
    EXPECT(trunnion_two_step_f64_init(&fit, 0), IMPOSSIBLE_RADIUS);
    EXPECT(trunnion_two_step_f64_init(&fit, -150), IMPOSSIBLE_RADIUS);
    EXPECT(trunnion_two_step_f64_init(&fit, nan), IMPOSSIBLE_RADIUS);
    EXPECT(trunnion_two_step_f64_init(&fit, inf), IMPOSSIBLE_RADIUS);
    EXPECT(trunnion_two_step_f64_push_separation(&fit, 1, 0), NOT_INITIALISED);

    EXPECT(trunnion_two_step_f64_push_tilting(&never, 1, 0, 0, 0), NOT_INITIALISED);
    memset(&never, 0xff, sizeof never);
    EXPECT(trunnion_two_step_f64_push_tilting(&never, 1, 0, 0, 0), NOT_INITIALISED);
    EXPECT(trunnion_two_step_f64_push_separation(&never, 1, 0), NOT_INITIALISED);
    EXPECT(trunnion_two_step_f64_solve(&never, &estimate), NOT_INITIALISED);
    EXPECT(trunnion_joint_f64_init(&other, 150), OK);
    EXPECT(trunnion_two_step_f64_solve((TrunnionTwoStepF64 *)(void *)&other, &estimate), NOT_INITIALISED);
    CHECK(!estimate.valid);
    EXPECT(trunnion_eps_xa_f64(&estimate, 1, &at), NOT_INITIALISED);

    EXPECT(trunnion_two_step_f64_init(&fit, 150), OK);
    EXPECT(trunnion_two_step_f64_solve(&fit, &estimate), TOO_FEW_SAMPLES);
    EXPECT(trunnion_two_step_f64_solve(&fit, NULL), NULL_POINTER);
    EXPECT(trunnion_two_step_f64_solve(NULL, &estimate), NULL_POINTER);
    EXPECT(trunnion_two_step_f64_push_tilting(NULL, 1, 0, 0, 0), NULL_POINTER);
    EXPECT(trunnion_two_step_f64_push_separation(NULL, 1, 0), NULL_POINTER);
    EXPECT(trunnion_two_step_f64_push_tilting(&fit, nan, 0, 0, 0), NOT_FINITE);
    EXPECT(trunnion_two_step_f64_push_tilting(&fit, inf, 0, 0, 0), NOT_FINITE);
    EXPECT(trunnion_two_step_f64_push_tilting(&fit, 1, nan, 0, 0), NOT_FINITE);
    EXPECT(trunnion_two_step_f64_push_tilting(&fit, 1, 0, inf, 0), NOT_FINITE);
    EXPECT(trunnion_two_step_f64_push_tilting(&fit, 1, 0, 0, -inf), NOT_FINITE);
    EXPECT(trunnion_two_step_f64_push_separation(&fit, nan, 0), NOT_FINITE);
    EXPECT(trunnion_two_step_f64_push_separation(&fit, 1, inf), NOT_FINITE);

    /* All samples at one angle. */
    for (i = 0; i < 100; i++) {
        EXPECT(trunnion_two_step_f64_push_tilting(&fit, 1, 0, 0, 0), OK);
        EXPECT(trunnion_two_step_f64_push_separation(&fit, 1, 0), OK);
    }
    EXPECT(trunnion_two_step_f64_solve(&fit, &estimate), CONFOUNDED);
    CHECK(!estimate.valid);

    /* After all of that the fit still takes samples and gives what they say: nothing. */
    EXPECT(trunnion_two_step_f64_init(&fit, 150), OK);
    for (i = 0; i < 360; i++) {
        double a = (double)(i * 0.017453292519943295);
        EXPECT(trunnion_two_step_f64_push_tilting(&fit, a, 0, 0, 0), OK);
        EXPECT(trunnion_two_step_f64_push_separation(&fit, a, 0), OK);
    }
    EXPECT(trunnion_two_step_f64_push_separation(&fit, 1, DBL_MAX), OVERFLOW);
    EXPECT(trunnion_two_step_f64_solve(&fit, &estimate), OK);
    EXPECT(trunnion_eps_xa_f64(NULL, 1, &at), NULL_POINTER);
    EXPECT(trunnion_eps_xa_f64(&estimate, 1, NULL), NULL_POINTER);
    EXPECT(trunnion_eps_xa_f64(&estimate, nan, &at), NOT_FINITE);
    EXPECT(trunnion_eps_xa_f64(&estimate, DBL_MAX, &at), NOT_FINITE);
    EXPECT(trunnion_eps_xa_f64(&estimate, 1, &at), OK);
    CHECK(at.value == 0 && at.std == 0 && at.band == 0);
}

int main(void)
{
    joint_f32();
    joint_f64();
    two_step_f32();
    two_step_f64();
    printf("%d mistakes answered wrongly\n", wrong);
    return wrong != 0;
}
