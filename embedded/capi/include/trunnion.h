/*
 * Trunnion in C: the paper's two runs on a tilting table, fitted sample by sample.
 *
 * Give each state memory (a variable of its type), call its ..._init, then ..._push_... for every sample of either run in
 * any order, then ..._solve, then trunnion_eps_xa_... at the angles wanted. Every call answers with a TrunnionStatus.
 * Angles in rad, lengths and readings in mm. A state is used by one thread at a time. Nothing is allocated, nothing is
 * kept between calls but the state, and every call takes a bounded time. Generated; do not edit.
 */

#ifndef TRUNNION_H
#define TRUNNION_H

#include <stdint.h>

/*
 Number of coefficients.
 */
#define TRUNNION_COEFFICIENTS 13

/*
 Size of the state in words of eight bytes.
 */
#define TRUNNION_JOINT_F32_WORDS 100

/*
 Size of the state in words of eight bytes.
 */
#define TRUNNION_JOINT_F64_WORDS 199

/*
 Size of the state in words of eight bytes.
 */
#define TRUNNION_TWO_STEP_F32_WORDS 104

/*
 Size of the state in words of eight bytes.
 */
#define TRUNNION_TWO_STEP_F64_WORDS 206

/*
 What a call answers. Whatever is not `OK` has changed nothing but the result, which is then marked invalid.
 */
enum TrunnionStatus
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /*
   Done.
   */
  TRUNNION_STATUS_OK = 0,
  /*
   A pointer is null.
   */
  TRUNNION_STATUS_NULL_POINTER = 1,
  /*
   A pointer is not aligned for its type.
   */
  TRUNNION_STATUS_MISALIGNED = 2,
  /*
   The state or estimate was never initialised, or is one of another kind.
   */
  TRUNNION_STATUS_NOT_INITIALISED = 3,
  /*
   The bar's nominal length is not a positive finite number.
   */
  TRUNNION_STATUS_IMPOSSIBLE_RADIUS = 4,
  /*
   A value given is NaN or infinite, or a result would be.
   */
  TRUNNION_STATUS_NOT_FINITE = 5,
  /*
   The values are finite, but beyond the range of the arithmetic.
   */
  TRUNNION_STATUS_OVERFLOW = 6,
  /*
   Fewer samples than the coefficients and the residual need.
   */
  TRUNNION_STATUS_TOO_FEW_SAMPLES = 7,
  /*
   The samples do not separate the coefficients named in the estimate's `confounded`.
   */
  TRUNNION_STATUS_CONFOUNDED = 8,
  /*
   The states to merge are of bars of different length.
   */
  TRUNNION_STATUS_DIFFERENT_RADIUS = 9,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum TrunnionStatus TrunnionStatus;
#else
typedef int32_t TrunnionStatus;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/*
 Coefficients with standard deviations in C's layout. The first two are those of ε_xa.

 In order: e_xa1, e_xa2, k1 … k11.
 */
typedef struct {
  /*
   Set by a solve that succeeded.
   */
  uint32_t valid;
  /*
   How many coefficients there are.
   */
  uint32_t count;
  /*
   Samples less coefficients; of the two steps, those of the second.
   */
  uint32_t degrees_of_freedom;
  /*
   If the answer was `Confounded`: bit i is set if coefficient i is one of those that the samples do not separate.
   */
  uint32_t confounded;
  /*
   The bar's nominal length, mm.
   */
  float radius;
  /*
   Standard deviation of the residuals, mm.
   */
  float residual_std;
  /*
   The coefficients; lengths in mm, angles in rad.
   */
  float coefficients[TRUNNION_COEFFICIENTS];
  /*
   Their standard deviations.
   */
  float std[TRUNNION_COEFFICIENTS];
  /*
   Covariance of the first two coefficients: (0, 0), (0, 1), (1, 1).
   */
  float covariance[3];
} TrunnionEstimateF32;

/*
 ε_xa at one angle, rad.
 */
typedef struct {
  /*
   ε_xa.
   */
  float value;
  /*
   Its standard deviation.
   */
  float std;
  /*
   Half the width of its 95 % band.
   */
  float band;
} TrunnionEpsXaF32;

/*
 Coefficients with standard deviations in C's layout. The first two are those of ε_xa.

 In order: e_xa1, e_xa2, k1 … k11.
 */
typedef struct {
  /*
   Set by a solve that succeeded.
   */
  uint32_t valid;
  /*
   How many coefficients there are.
   */
  uint32_t count;
  /*
   Samples less coefficients; of the two steps, those of the second.
   */
  uint32_t degrees_of_freedom;
  /*
   If the answer was `Confounded`: bit i is set if coefficient i is one of those that the samples do not separate.
   */
  uint32_t confounded;
  /*
   The bar's nominal length, mm.
   */
  double radius;
  /*
   Standard deviation of the residuals, mm.
   */
  double residual_std;
  /*
   The coefficients; lengths in mm, angles in rad.
   */
  double coefficients[TRUNNION_COEFFICIENTS];
  /*
   Their standard deviations.
   */
  double std[TRUNNION_COEFFICIENTS];
  /*
   Covariance of the first two coefficients: (0, 0), (0, 1), (1, 1).
   */
  double covariance[3];
} TrunnionEstimateF64;

/*
 ε_xa at one angle, rad.
 */
typedef struct {
  /*
   ε_xa.
   */
  double value;
  /*
   Its standard deviation.
   */
  double std;
  /*
   Half the width of its 95 % band.
   */
  double band;
} TrunnionEpsXaF64;

/*
 The state, in memory that the caller gives. Its contents are nobody else's.
 */
typedef struct {
  uint64_t opaque[TRUNNION_JOINT_F32_WORDS];
} TrunnionJointF32;

/*
 The state, in memory that the caller gives. Its contents are nobody else's.
 */
typedef struct {
  uint64_t opaque[TRUNNION_JOINT_F64_WORDS];
} TrunnionJointF64;

/*
 The state, in memory that the caller gives. Its contents are nobody else's.
 */
typedef struct {
  uint64_t opaque[TRUNNION_TWO_STEP_F32_WORDS];
} TrunnionTwoStepF32;

/*
 The state, in memory that the caller gives. Its contents are nobody else's.
 */
typedef struct {
  uint64_t opaque[TRUNNION_TWO_STEP_F64_WORDS];
} TrunnionTwoStepF64;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/*
 ε_xa at the angle `a`, rad.

 # Safety
 `estimate` is null or readable, `result` null or writable.
 */
TrunnionStatus trunnion_eps_xa_f32(const TrunnionEstimateF32 *estimate, float a, TrunnionEpsXaF32 *result);

/*
 ε_xa at the angle `a`, rad.

 # Safety
 `estimate` is null or readable, `result` null or writable.
 */
TrunnionStatus trunnion_eps_xa_f64(const TrunnionEstimateF64 *estimate, double a, TrunnionEpsXaF64 *result);

/*
 Makes a state of no samples for a bar of nominal length `radius`, mm.

 # Safety
 `state` is null or points to writable memory of its type.
 */
TrunnionStatus trunnion_joint_f32_init(TrunnionJointF32 *state, float radius);

/*
 Takes a sample of run 1 at the angle `a` (rad): the radial deviation and the known δ_ya and δ_za there, mm.

 # Safety
 `state` is null or points to memory of its type that nothing else uses meanwhile.
 */
TrunnionStatus trunnion_joint_f32_push_tilting(TrunnionJointF32 *state,
                                               float a,
                                               float deviation,
                                               float known_y,
                                               float known_z);

/*
 Takes a sample of run 2 at the angle `a` (rad): the radial deviation, mm.

 # Safety
 As [`trunnion_joint_f32_push_tilting`].
 */
TrunnionStatus trunnion_joint_f32_push_separation(TrunnionJointF32 *state, float a, float deviation);

/*
 Adds the samples of `other`, which may be the state itself.

 # Safety
 As [`trunnion_joint_f32_push_tilting`], and `other` is null or points to readable memory of its type.
 */
TrunnionStatus trunnion_joint_f32_merge(TrunnionJointF32 *state, const TrunnionJointF32 *other);

/*
 The estimate from all samples so far. If there is none, the result is marked invalid.

 # Safety
 `state` is null or points to readable memory of its type, `result` null or writable.
 */
TrunnionStatus trunnion_joint_f32_solve(const TrunnionJointF32 *state, TrunnionEstimateF32 *result);

/*
 Makes a state of no samples for a bar of nominal length `radius`, mm.

 # Safety
 `state` is null or points to writable memory of its type.
 */
TrunnionStatus trunnion_joint_f64_init(TrunnionJointF64 *state, double radius);

/*
 Takes a sample of run 1 at the angle `a` (rad): the radial deviation and the known δ_ya and δ_za there, mm.

 # Safety
 `state` is null or points to memory of its type that nothing else uses meanwhile.
 */
TrunnionStatus trunnion_joint_f64_push_tilting(TrunnionJointF64 *state,
                                               double a,
                                               double deviation,
                                               double known_y,
                                               double known_z);

/*
 Takes a sample of run 2 at the angle `a` (rad): the radial deviation, mm.

 # Safety
 As [`trunnion_joint_f64_push_tilting`].
 */
TrunnionStatus trunnion_joint_f64_push_separation(TrunnionJointF64 *state, double a, double deviation);

/*
 Adds the samples of `other`, which may be the state itself.

 # Safety
 As [`trunnion_joint_f64_push_tilting`], and `other` is null or points to readable memory of its type.
 */
TrunnionStatus trunnion_joint_f64_merge(TrunnionJointF64 *state, const TrunnionJointF64 *other);

/*
 The estimate from all samples so far. If there is none, the result is marked invalid.

 # Safety
 `state` is null or points to readable memory of its type, `result` null or writable.
 */
TrunnionStatus trunnion_joint_f64_solve(const TrunnionJointF64 *state, TrunnionEstimateF64 *result);

/*
 Makes a state of no samples for a bar of nominal length `radius`, mm.

 # Safety
 `state` is null or points to writable memory of its type.
 */
TrunnionStatus trunnion_two_step_f32_init(TrunnionTwoStepF32 *state, float radius);

/*
 Takes a sample of run 1 at the angle `a` (rad): the radial deviation and the known δ_ya and δ_za there, mm.

 # Safety
 `state` is null or points to memory of its type that nothing else uses meanwhile.
 */
TrunnionStatus trunnion_two_step_f32_push_tilting(TrunnionTwoStepF32 *state,
                                                  float a,
                                                  float deviation,
                                                  float known_y,
                                                  float known_z);

/*
 Takes a sample of run 2 at the angle `a` (rad): the radial deviation, mm.

 # Safety
 As [`trunnion_two_step_f32_push_tilting`].
 */
TrunnionStatus trunnion_two_step_f32_push_separation(TrunnionTwoStepF32 *state, float a, float deviation);

/*
 The estimate from all samples so far. If there is none, the result is marked invalid.

 # Safety
 `state` is null or points to readable memory of its type, `result` null or writable.
 */
TrunnionStatus trunnion_two_step_f32_solve(const TrunnionTwoStepF32 *state, TrunnionEstimateF32 *result);

/*
 Makes a state of no samples for a bar of nominal length `radius`, mm.

 # Safety
 `state` is null or points to writable memory of its type.
 */
TrunnionStatus trunnion_two_step_f64_init(TrunnionTwoStepF64 *state, double radius);

/*
 Takes a sample of run 1 at the angle `a` (rad): the radial deviation and the known δ_ya and δ_za there, mm.

 # Safety
 `state` is null or points to memory of its type that nothing else uses meanwhile.
 */
TrunnionStatus trunnion_two_step_f64_push_tilting(TrunnionTwoStepF64 *state,
                                                  double a,
                                                  double deviation,
                                                  double known_y,
                                                  double known_z);

/*
 Takes a sample of run 2 at the angle `a` (rad): the radial deviation, mm.

 # Safety
 As [`trunnion_two_step_f64_push_tilting`].
 */
TrunnionStatus trunnion_two_step_f64_push_separation(TrunnionTwoStepF64 *state, double a, double deviation);

/*
 The estimate from all samples so far. If there is none, the result is marked invalid.

 # Safety
 `state` is null or points to readable memory of its type, `result` null or writable.
 */
TrunnionStatus trunnion_two_step_f64_solve(const TrunnionTwoStepF64 *state, TrunnionEstimateF64 *result);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* TRUNNION_H */
