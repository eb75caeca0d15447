/* toron: a transversely isotropic hyperelastic yarn law, and its linear elastic baseline.
 *
 * Generated from the library's source: do not edit. docs/guides/c.md shows how it is used.
 *
 * Deformation gradients are passed by columns, F11 F21 F31 F12 F22 F32 F13 F23 F33; stresses as 11 22 33 12 23 31 unless a host has
 * its own order. Status codes: 0 is success, a negative number an error; functions that return a count or an index return that, or
 * a negative number. Every function may be called from any thread; none allocates, locks or keeps a pointer. Arrays must not
 * overlap, except that the old and the new state may be the same array. The reference placement is the undeformed one.
 *
 * A structure begins with its size, which the caller sets, and 0 stands for what is left out:
 *     toron_block_f64 block = {.size = sizeof block, .n = n, ...};
 *
 * The last two arguments of every function that can fail are a buffer for a message and its size: at most `capacity` bytes are
 * written, with a terminating null, and only if there is an error; null and 0 for none. TORON_MESSAGE_CAPACITY is always enough.
 */

#ifndef TORON_H
#define TORON_H

#include <stddef.h>
#include <stdint.h>

/*
 Everything went well.
 */
#define TORON_OK 0

/*
 An argument that must not be null is null.
 */
#define TORON_NULL_ARGUMENT -101

/*
 A count (of points, components or stress entries) is not one that this function supports.
 */
#define TORON_BAD_COUNT -102

/*
 The leading dimension of component-major arrays is less than the number of points.
 */
#define TORON_BAD_LEADING_DIMENSION -103

/*
 A name, index, law, preset or unit system that does not exist.
 */
#define TORON_UNKNOWN_NAME -104

/*
 A scalar argument (density, option, …) outside what is allowed.
 */
#define TORON_BAD_ARGUMENT -105

/*
 The host passes no deformation gradient: a small-strain analysis, F = 0, or F not stored where it is read.
 */
#define TORON_NO_DEFORMATION_GRADIENT -106

/*
 A prepared law that its prepare function has not written, or that of another law or precision.
 */
#define TORON_NOT_PREPARED -107

/*
 The size of a structure is not set, or is not that of any version of the structure.
 */
#define TORON_BAD_SIZE -108

/*
 A structure of a newer interface requests what this version of the library does not know.
 */
#define TORON_UNKNOWN_FIELD -109

/*
 The number of properties differs from that in the table of properties.
 */
#define TORON_PROPERTY_COUNT -201

/*
 A property is NaN or infinite.
 */
#define TORON_PROPERTY_NOT_FINITE -202

/*
 A property is outside its bounds.
 */
#define TORON_PROPERTY_OUT_OF_BOUNDS -203

/*
 A direction among the properties has no length, or is parallel to the one it must differ from.
 */
#define TORON_PROPERTY_DIRECTION -204

/*
 The fibre direction is neither in the plane of a two-dimensional element nor normal to it.
 */
#define TORON_FIBRE_OUT_OF_PLANE -205

/*
 There are fewer state variables than the law needs.
 */
#define TORON_STATE_COUNT -211

/*
 The deformation gradient has a determinant ≤ 0 (or one that underflows), or maps the fibre to zero length: an
 inverted element.
 */
#define TORON_INVERTED -301

/*
 The deformation gradient, or the strain increment, has an entry that is NaN or infinite.
 */
#define TORON_NOT_FINITE -302

/*
 The deformation is too large or too small to evaluate, or a result does not fit the number format.
 */
#define TORON_OVERFLOW -303

/*
 An old state variable is NaN or infinite.
 */
#define TORON_STATE_NOT_FINITE -304

/*
 The fibre direction given for this point is zero, NaN or infinite, or along the second axis of the linear elastic
 law.
 */
#define TORON_FIBRE_DIRECTION -305

/*
 The step is too large to integrate: a stretch by a factor of ten or more, or a half-turn.
 */
#define TORON_INCREMENT_TOO_LARGE -306

/*
 The material axes given for this point, for the frame of the spin, are not orthonormal.
 */
#define TORON_MATERIAL_AXES -307

/*
 The failure limit given for this point is negative, NaN or infinite.
 */
#define TORON_LIMIT -308

/*
 The law itself cannot evaluate the point, for instance since an iteration does not converge.
 */
#define TORON_LAW -309

/*
 The law can only evaluate the point in smaller steps.
 */
#define TORON_SMALLER_STEP -310

/*
 Version of the binary interface. A program built against it runs with every later library of the same number.
 */
#define TORON_ABI_VERSION 2

/*
 Selects the hyperelastic yarn law in the functions for tables.
 */
#define TORON_HYPERELASTIC 0

/*
 Selects the linear elastic orthotropic law in these functions.
 */
#define TORON_LINEAR_ELASTIC 1

/*
 Selects the yarn law with friction in these functions.
 */
#define TORON_FRICTIONAL 2

/*
 Number of properties and of state variables of the hyperelastic law.
 */
#define TORON_HYPERELASTIC_PROPERTIES 11

#define TORON_HYPERELASTIC_STATE 11

/*
 Number of properties and of state variables of the linear elastic law.
 */
#define TORON_LINEAR_ELASTIC_PROPERTIES 10

#define TORON_LINEAR_ELASTIC_STATE 10

/*
 Number of properties and of state variables of the law with friction.
 */
#define TORON_FRICTIONAL_PROPERTIES 13

#define TORON_FRICTIONAL_STATE 15

/*
 Linear elastic law: the material frame follows the fibre.
 */
#define TORON_ROTATION_FIBRE 0

/*
 Linear elastic law: the material frame follows the rotation R of F = R U.
 */
#define TORON_ROTATION_POLAR 1

/*
 Linear elastic law: the material frame follows the spin (Jaumann rate).
 */
#define TORON_ROTATION_SPIN 2

/*
 Linear elastic law: failure by the largest principal stress.
 */
#define TORON_CRITERION_PRINCIPAL 0

/*
 Linear elastic law: failure by the stress along the fibre.
 */
#define TORON_CRITERION_FIBRE 1

/*
 Tangent dS/dE: derivative of the second Piola-Kirchhoff stress with respect to the Green-Lagrange strain, reference
 axes; 6 x 6.
 */
#define TORON_TANGENT_MATERIAL 0

/*
 Tangent for the Truesdell rate of the Cauchy stress: dS/dE pushed forward and divided by J; 6 x 6.
 */
#define TORON_TANGENT_TRUESDELL 1

/*
 Tangent for the Jaumann rate of the Kirchhoff stress, divided by J (Abaqus's DDSDDE); 6 x 6.
 */
#define TORON_TANGENT_JAUMANN 2

/*
 Tangent dP/dF: derivative of the first Piola-Kirchhoff stress with respect to the deformation gradient, both in the
 order 11 21 31 12 22 32 13 23 33; 9 x 9.
 */
#define TORON_TANGENT_NOMINAL 3

/*
 Instruction set for a block: the widest that the processor supports.
 */
#define TORON_LEVEL_BEST 0

/*
 Only instructions that every processor of the architecture has (SSE2 on x86-64).
 */
#define TORON_LEVEL_BASELINE 1

/*
 At most AVX2 with fused multiply-add.
 */
#define TORON_LEVEL_AVX2 2

/*
 At most AVX-512.
 */
#define TORON_LEVEL_AVX512 3

/*
 Room for any message, its terminating null included.
 */
#define TORON_MESSAGE_CAPACITY 512

/*
 A row of the tables of properties and state variables. Set `size`; the rest is written. Texts are null-terminated
 UTF-8.
 */
typedef struct toron_table_row {
  /*
   The size of this structure.
   */
  size_t size;
  /*
   The name used in decks and messages, and the symbol used in the documentation.
   */
  char name[24];
  char symbol[24];
  /*
   The physical dimension in words ("stress", "energy/volume", "-"), and as exponents of mass, length and time.
   */
  char unit[24];
  int32_t mass;
  int32_t length;
  int32_t time;
  /*
   1 if there is a default, else 0; and the default. For state variables the initial value, 0.
   */
  int32_t has_default;
  double default_value;
  /*
   The least and the greatest allowed value (infinite if there is no bound); minimum_excluded is 1 if the least
   value itself is not allowed.
   */
  double minimum;
  double maximum;
  int32_t minimum_excluded;
  /*
   The allowed values in words, and the meaning of the quantity.
   */
  char allowed[80];
  char meaning[100];
} toron_table_row;

/*
 The hyperelastic law, prepared by `toron_hyperelastic_prepare_f64` or `_f32`: numbers only, without a pointer. It
 may be copied, shared by threads and sent to other processes of the same byte order, and needs no release. Its
 content is the library's own; its size is the same in all versions of this interface.
 */
typedef struct toron_hyperelastic_f64 {
  /*
   Tells law, precision and layout; the size of the structure; the library's own numbers.
   */
  uint64_t tag;
  uint64_t size;
  double values[62];
} toron_hyperelastic_f64;

/*
 The hyperelastic law, prepared by `toron_hyperelastic_prepare_f64` or `_f32`: numbers only, without a pointer. It
 may be copied, shared by threads and sent to other processes of the same byte order, and needs no release. Its
 content is the library's own; its size is the same in all versions of this interface.
 */
typedef struct toron_hyperelastic_f32 {
  /*
   Tells law, precision and layout; the size of the structure; the library's own numbers.
   */
  uint64_t tag;
  uint64_t size;
  float values[62];
} toron_hyperelastic_f32;

/*
 A point of the hyperelastic law or of the law with friction. Set `size`, and what is wanted; the rest is 0: an array
 that is null is left out, and an output that is left out is not computed. The arrays of the old and the new state
 may be the same.
 */
typedef struct toron_point_f64 {
  /*
   The size of this structure.
   */
  size_t size;
  /*
   In: which tangent, one of `TORON_TANGENT_...`; read if `tangent` is not null.
   */
  int32_t measure;
  /*
   In: the instruction set to use, one of `TORON_LEVEL_...`; if the processor lacks it, the best one below it.
   */
  int32_t level;
  /*
   In: reference density; read if `wave_speed` is not null.
   */
  double density;
  /*
   In, 9: F by columns. Must not be null.
   */
  const double *deformation_gradient;
  /*
   In, 3: the fibre direction, of any length; if null, that of the properties.
   */
  const double *fibre;
  /*
   In, 11 (15 of the law with friction): the old state; if null, all 0.
   */
  const double *state_old;
  /*
   Out, as many: the new state. If null, the point does not fail, but stays failed if its old state has the flag
   set.
   */
  double *state_new;
  /*
   Out, 6: Cauchy stress 11 22 33 12 23 31.
   */
  double *stress;
  /*
   Out, 24: S_el, S_tc, S_td, S_ld, second Piola-Kirchhoff, each 11 22 33 12 23 31.
   */
  double *modes;
  /*
   Out, 1: an upper bound of the wave speed, to be used with current element lengths; never below the speed along a
   fibre at rest. It is meant for the stable time step; a bulk viscosity computed with it damps more than with the
   exact speed.
   */
  double *wave_speed;
  /*
   Out, 36 (81 for `TORON_TANGENT_NOMINAL`): the tangent, entry (row, column), counted from 0, at 6 row + column (9
   row + column); a symmetric matrix, but where the fibres of the law with friction slide. Rows and columns are in
   the order 11 22 33 12 23 31, with derivatives with respect to engineering shears; for `TORON_TANGENT_NOMINAL` 11
   21 31 12 22 32 13 23 33.

   The call that detects failure returns that of the intact material, later calls return zeros. At a kink (I_el = 0
   or I_tc = 0) it is that of loading.
   */
  double *tangent;
  /*
   In, 1: the true fibre strain at failure, ln(1 + eps_lim), in place of that of the properties; if null or 0, that
   of the properties. Read if `state_new` is not null.
   */
  const double *limit;
} toron_point_f64;

/*
 A point of the hyperelastic law or of the law with friction. Set `size`, and what is wanted; the rest is 0: an array
 that is null is left out, and an output that is left out is not computed. The arrays of the old and the new state
 may be the same.
 */
typedef struct toron_point_f32 {
  /*
   The size of this structure.
   */
  size_t size;
  /*
   In: which tangent, one of `TORON_TANGENT_...`; read if `tangent` is not null.
   */
  int32_t measure;
  /*
   In: the instruction set to use, one of `TORON_LEVEL_...`; if the processor lacks it, the best one below it.
   */
  int32_t level;
  /*
   In: reference density; read if `wave_speed` is not null.
   */
  double density;
  /*
   In, 9: F by columns. Must not be null.
   */
  const float *deformation_gradient;
  /*
   In, 3: the fibre direction, of any length; if null, that of the properties.
   */
  const float *fibre;
  /*
   In, 11 (15 of the law with friction): the old state; if null, all 0.
   */
  const float *state_old;
  /*
   Out, as many: the new state. If null, the point does not fail, but stays failed if its old state has the flag
   set.
   */
  float *state_new;
  /*
   Out, 6: Cauchy stress 11 22 33 12 23 31.
   */
  float *stress;
  /*
   Out, 24: S_el, S_tc, S_td, S_ld, second Piola-Kirchhoff, each 11 22 33 12 23 31.
   */
  float *modes;
  /*
   Out, 1: an upper bound of the wave speed, to be used with current element lengths; never below the speed along a
   fibre at rest. It is meant for the stable time step; a bulk viscosity computed with it damps more than with the
   exact speed.
   */
  float *wave_speed;
  /*
   Out, 36 (81 for `TORON_TANGENT_NOMINAL`): the tangent, entry (row, column), counted from 0, at 6 row + column (9
   row + column); a symmetric matrix, but where the fibres of the law with friction slide. Rows and columns are in
   the order 11 22 33 12 23 31, with derivatives with respect to engineering shears; for `TORON_TANGENT_NOMINAL` 11
   21 31 12 22 32 13 23 33.

   The call that detects failure returns that of the intact material, later calls return zeros. At a kink (I_el = 0
   or I_tc = 0) it is that of loading.
   */
  float *tangent;
  /*
   In, 1: the true fibre strain at failure, ln(1 + eps_lim), in place of that of the properties; if null or 0, that
   of the properties. Read if `state_new` is not null.
   */
  const float *limit;
} toron_point_f32;

/*
 Where the entries of an array are: component c of point i at `c * leading_dimension + i * stride`, in numbers. All
 0: as the block says.
 */
typedef struct toron_layout {
  /*
   From one component to the next; 0: that of the block, or 1 if the stride is more than 1 (points in rows). Not
   read where every component has a pointer.
   */
  size_t leading_dimension;
  /*
   From one point to the next; 0: 1. Points next to each other take the least time: others are copied part by part.
   */
  size_t stride;
} toron_layout;

/*
 A block of points of the hyperelastic law or of the law with friction. Set `size`, `n`, and what is wanted; the rest
 is 0: an array that is null is left out, and an output that is left out is not computed.

 Component c of point i is at `c * leading_dimension + i`, unless the layout of the array says otherwise. F, fibre
 and stress have a pointer for each component, so that they may be in separate arrays; if only the first is set, the
 others follow it by the layout. The arrays of the old and the new state may be the same; otherwise arrays must not
 overlap. Energies, invariants and failure may be parts of one array of 11 components (15 of the law with friction),
 starting at components 0, 4 and 8.
 */
typedef struct toron_block_f64 {
  /*
   The size of this structure.
   */
  size_t size;
  /*
   The number of points.
   */
  size_t n;
  /*
   In numbers, from one component to the next; 0: n.
   */
  size_t leading_dimension;
  /*
   In: which tangent, one of `TORON_TANGENT_...`; read if `tangent` is not null.
   */
  int32_t measure;
  /*
   In: the instruction set to use, one of `TORON_LEVEL_...`; if the processor lacks it, the best one below it. AVX2
   and AVX-512 give identical bits; the baseline differs in the last digits.
   */
  int32_t level;
  /*
   In: reference density; read if `wave_speed` is not null.
   */
  double density;
  /*
   In, 9 components: F by columns. The first must not be null.
   */
  const double *deformation_gradient[9];
  /*
   In, 3 components: the fibre direction of each point, of any length; if null, that of the properties.
   */
  const double *fibre[3];
  /*
   In, 4, 4 and 3 components: the old state; if null, all 0. The failure has 7 of the law with friction.
   */
  const double *energies_old;
  const double *invariants_old;
  const double *failure_old;
  /*
   Out, 6 components: Cauchy stress 11 22 33 12 23 31.
   */
  double *stress[6];
  /*
   Out, 4: W_el W_tc W_td W_ld.
   */
  double *energies;
  /*
   Out, 4: I_el I_tc I_td I_ld.
   */
  double *invariants;
  /*
   Out, 3: failure index, failed, alive; of the law with friction 7, before these the energy lost, I_te and the two
   components of the slip. If null, no point fails, but a point whose old failure flag is set stays failed.
   */
  double *failure;
  /*
   Out, 24: S_el, S_tc, S_td, S_ld, second Piola-Kirchhoff, each 11 22 33 12 23 31.
   */
  double *modes;
  /*
   Out, 36 components (81 for `TORON_TANGENT_NOMINAL`): entry (row, column), counted from 0, is component 6 row +
   column (9 row + column); else as in `toron_point_f64`.
   */
  double *tangent;
  /*
   Out, a number for each point: an upper bound of the wave speed, as in `toron_point_f64`.
   */
  double *wave_speed;
  /*
   Out, a number for each point: 1, or 0 if it has failed or cannot be evaluated: what a solver deletes elements
   by.
   */
  double *active;
  /*
   Out, a number for each point: its status code.
   */
  int32_t *status;
  /*
   Where the entries of these arrays are. That of the state holds for energies, invariants and failure, old and
   new.
   */
  struct toron_layout deformation_gradient_layout;
  struct toron_layout fibre_layout;
  struct toron_layout state_layout;
  struct toron_layout stress_layout;
  struct toron_layout modes_layout;
  struct toron_layout tangent_layout;
  /*
   In, a number for each point: the true fibre strain at failure, ln(1 + eps_lim), in place of that of the
   properties; 0: that of the properties. If null, that of the properties. Read if `failure` is not null.
   */
  const double *limit;
  struct toron_layout limit_layout;
} toron_block_f64;

/*
 A block of points of the hyperelastic law or of the law with friction. Set `size`, `n`, and what is wanted; the rest
 is 0: an array that is null is left out, and an output that is left out is not computed.

 Component c of point i is at `c * leading_dimension + i`, unless the layout of the array says otherwise. F, fibre
 and stress have a pointer for each component, so that they may be in separate arrays; if only the first is set, the
 others follow it by the layout. The arrays of the old and the new state may be the same; otherwise arrays must not
 overlap. Energies, invariants and failure may be parts of one array of 11 components (15 of the law with friction),
 starting at components 0, 4 and 8.
 */
typedef struct toron_block_f32 {
  /*
   The size of this structure.
   */
  size_t size;
  /*
   The number of points.
   */
  size_t n;
  /*
   In numbers, from one component to the next; 0: n.
   */
  size_t leading_dimension;
  /*
   In: which tangent, one of `TORON_TANGENT_...`; read if `tangent` is not null.
   */
  int32_t measure;
  /*
   In: the instruction set to use, one of `TORON_LEVEL_...`; if the processor lacks it, the best one below it. AVX2
   and AVX-512 give identical bits; the baseline differs in the last digits.
   */
  int32_t level;
  /*
   In: reference density; read if `wave_speed` is not null.
   */
  double density;
  /*
   In, 9 components: F by columns. The first must not be null.
   */
  const float *deformation_gradient[9];
  /*
   In, 3 components: the fibre direction of each point, of any length; if null, that of the properties.
   */
  const float *fibre[3];
  /*
   In, 4, 4 and 3 components: the old state; if null, all 0. The failure has 7 of the law with friction.
   */
  const float *energies_old;
  const float *invariants_old;
  const float *failure_old;
  /*
   Out, 6 components: Cauchy stress 11 22 33 12 23 31.
   */
  float *stress[6];
  /*
   Out, 4: W_el W_tc W_td W_ld.
   */
  float *energies;
  /*
   Out, 4: I_el I_tc I_td I_ld.
   */
  float *invariants;
  /*
   Out, 3: failure index, failed, alive; of the law with friction 7, before these the energy lost, I_te and the two
   components of the slip. If null, no point fails, but a point whose old failure flag is set stays failed.
   */
  float *failure;
  /*
   Out, 24: S_el, S_tc, S_td, S_ld, second Piola-Kirchhoff, each 11 22 33 12 23 31.
   */
  float *modes;
  /*
   Out, 36 components (81 for `TORON_TANGENT_NOMINAL`): entry (row, column), counted from 0, is component 6 row +
   column (9 row + column); else as in `toron_point_f64`.
   */
  float *tangent;
  /*
   Out, a number for each point: an upper bound of the wave speed, as in `toron_point_f64`.
   */
  float *wave_speed;
  /*
   Out, a number for each point: 1, or 0 if it has failed or cannot be evaluated: what a solver deletes elements
   by.
   */
  float *active;
  /*
   Out, a number for each point: its status code.
   */
  int32_t *status;
  /*
   Where the entries of these arrays are. That of the state holds for energies, invariants and failure, old and
   new.
   */
  struct toron_layout deformation_gradient_layout;
  struct toron_layout fibre_layout;
  struct toron_layout state_layout;
  struct toron_layout stress_layout;
  struct toron_layout modes_layout;
  struct toron_layout tangent_layout;
  /*
   In, a number for each point: the true fibre strain at failure, ln(1 + eps_lim), in place of that of the
   properties; 0: that of the properties. If null, that of the properties. Read if `failure` is not null.
   */
  const float *limit;
  struct toron_layout limit_layout;
} toron_block_f32;

/*
 The law with friction, prepared by `toron_frictional_prepare_f64` or `_f32`; as `toron_hyperelastic_f64` else.
 */
typedef struct toron_frictional_f64 {
  /*
   Tells law, precision and layout; the size of the structure; the library's own numbers.
   */
  uint64_t tag;
  uint64_t size;
  double values[62];
} toron_frictional_f64;

/*
 The law with friction, prepared by `toron_frictional_prepare_f64` or `_f32`; as `toron_hyperelastic_f64` else.
 */
typedef struct toron_frictional_f32 {
  /*
   Tells law, precision and layout; the size of the structure; the library's own numbers.
   */
  uint64_t tag;
  uint64_t size;
  float values[62];
} toron_frictional_f32;

/*
 The linear elastic law, prepared by `toron_linear_elastic_prepare_f64` or `_f32`; as `toron_hyperelastic_f64` else.
 */
typedef struct toron_linear_elastic_f64 {
  /*
   Tells law, precision and layout; the size of the structure; the library's own numbers.
   */
  uint64_t tag;
  uint64_t size;
  double values[30];
} toron_linear_elastic_f64;

/*
 The linear elastic law, prepared by `toron_linear_elastic_prepare_f64` or `_f32`; as `toron_hyperelastic_f64` else.
 */
typedef struct toron_linear_elastic_f32 {
  /*
   Tells law, precision and layout; the size of the structure; the library's own numbers.
   */
  uint64_t tag;
  uint64_t size;
  float values[30];
} toron_linear_elastic_f32;

/*
 A point of the linear elastic law. Set `size`, and what is wanted; the rest is 0: an array that is null is left out,
 and an output that is left out is not computed. The arrays of the old and the new state may be the same.
 */
typedef struct toron_linear_point_f64 {
  /*
   The size of this structure.
   */
  size_t size;
  /*
   In: the frame that turns with the material, one of `TORON_ROTATION_...` (0, the fibre's, is right for a yarn),
   and the stress that is compared with the strength, one of `TORON_CRITERION_...`.
   */
  int32_t rotation;
  int32_t criterion;
  /*
   In: which tangent, one of `TORON_TANGENT_...`; read if `tangent` is not null.
   */
  int32_t measure;
  /*
   In: the instruction set to use, one of `TORON_LEVEL_...`, as in `toron_block_f64`.
   */
  int32_t level;
  /*
   In: reference density; read if `wave_speed` is not null.
   */
  double density;
  /*
   In, 9 each: F by columns at both ends of the step. Must not be null.
   */
  const double *f_old;
  const double *f_new;
  /*
   In, 3 each, of any length: the fibre direction and the second material axis in the reference placement; if null,
   those of the properties. The second axis may be 0 if any will do. Not read for `TORON_ROTATION_SPIN`.
   */
  const double *fibre;
  const double *second_axis;
  /*
   In and out, 9: the current material axes in global coordinates, one after the other. Must not be null for
   `TORON_ROTATION_SPIN`, and start with those of `toron_linear_elastic_axes_f64`; not used for the other frames.
   They are checked: with Q the matrix of the axes, `TORON_MATERIAL_AXES` is returned and nothing changed where the
   norm of QᵀQ − 1 exceeds 0.01; a smaller deviation is corrected.
   */
  double *axes;
  /*
   In, 10: the old state; if null, all 0.
   */
  const double *state_old;
  /*
   Out, 10: the new state. If null, the point does not fail, but stays failed if its old state has the flag set.
   */
  double *state_new;
  /*
   Out, 6: Cauchy stress in global axes, 11 22 33 12 23 31.
   */
  double *stress;
  /*
   Out, 1: an upper bound of the wave speed at the end of the step, to be used with current element lengths.
   */
  double *wave_speed;
  /*
   Out, 36 (81 for `TORON_TANGENT_NOMINAL`): the tangent consistent with the step, as in `toron_point_f64`, but not
   symmetric. `TORON_TANGENT_JAUMANN` gives the entries of Abaqus's DDSDDE, but in the order 11 22 33 12 23 31. It
   is computed in double precision, and so are then all other results.
   */
  double *tangent;
  /*
   In, 1: the strength, in place of that of the properties; if null or 0, that of the properties. Read if
   `state_new` is not null.
   */
  const double *limit;
} toron_linear_point_f64;

/*
 A point of the linear elastic law. Set `size`, and what is wanted; the rest is 0: an array that is null is left out,
 and an output that is left out is not computed. The arrays of the old and the new state may be the same.
 */
typedef struct toron_linear_point_f32 {
  /*
   The size of this structure.
   */
  size_t size;
  /*
   In: the frame that turns with the material, one of `TORON_ROTATION_...` (0, the fibre's, is right for a yarn),
   and the stress that is compared with the strength, one of `TORON_CRITERION_...`.
   */
  int32_t rotation;
  int32_t criterion;
  /*
   In: which tangent, one of `TORON_TANGENT_...`; read if `tangent` is not null.
   */
  int32_t measure;
  /*
   In: the instruction set to use, one of `TORON_LEVEL_...`, as in `toron_block_f64`.
   */
  int32_t level;
  /*
   In: reference density; read if `wave_speed` is not null.
   */
  double density;
  /*
   In, 9 each: F by columns at both ends of the step. Must not be null.
   */
  const float *f_old;
  const float *f_new;
  /*
   In, 3 each, of any length: the fibre direction and the second material axis in the reference placement; if null,
   those of the properties. The second axis may be 0 if any will do. Not read for `TORON_ROTATION_SPIN`.
   */
  const float *fibre;
  const float *second_axis;
  /*
   In and out, 9: the current material axes in global coordinates, one after the other. Must not be null for
   `TORON_ROTATION_SPIN`, and start with those of `toron_linear_elastic_axes_f64`; not used for the other frames.
   They are checked: with Q the matrix of the axes, `TORON_MATERIAL_AXES` is returned and nothing changed where the
   norm of QᵀQ − 1 exceeds 0.01; a smaller deviation is corrected.
   */
  float *axes;
  /*
   In, 10: the old state; if null, all 0.
   */
  const float *state_old;
  /*
   Out, 10: the new state. If null, the point does not fail, but stays failed if its old state has the flag set.
   */
  float *state_new;
  /*
   Out, 6: Cauchy stress in global axes, 11 22 33 12 23 31.
   */
  float *stress;
  /*
   Out, 1: an upper bound of the wave speed at the end of the step, to be used with current element lengths.
   */
  float *wave_speed;
  /*
   Out, 36 (81 for `TORON_TANGENT_NOMINAL`): the tangent consistent with the step, as in `toron_point_f64`, but not
   symmetric. `TORON_TANGENT_JAUMANN` gives the entries of Abaqus's DDSDDE, but in the order 11 22 33 12 23 31. It
   is computed in double precision, and so are then all other results.
   */
  float *tangent;
  /*
   In, 1: the strength, in place of that of the properties; if null or 0, that of the properties. Read if
   `state_new` is not null.
   */
  const float *limit;
} toron_linear_point_f32;

/*
 A strain increment of the linear elastic law, in material axes that the caller updates. Set `size`, and what is
 wanted; the rest is 0.
 */
typedef struct toron_linear_increment_f64 {
  /*
   The size of this structure.
   */
  size_t size;
  /*
   In: one of `TORON_CRITERION_...`.
   */
  int32_t criterion;
  /*
   0.
   */
  int32_t reserved;
  /*
   In: the volume ratio J, a factor of the work per reference volume; 0: 1, not known.
   */
  double jacobian;
  /*
   In, 6: tensor components 11 22 33 12 23 31 (half the engineering shears) in the material axes. Must not be null.
   */
  const double *strain;
  /*
   In, 10: the old state; if null, all 0.
   */
  const double *state_old;
  /*
   Out, 10: the new state; null: it is not returned.
   */
  double *state_new;
  /*
   Out, 6: Cauchy stress in the material axes.
   */
  double *stress;
} toron_linear_increment_f64;

/*
 A strain increment of the linear elastic law, in material axes that the caller updates. Set `size`, and what is
 wanted; the rest is 0.
 */
typedef struct toron_linear_increment_f32 {
  /*
   The size of this structure.
   */
  size_t size;
  /*
   In: one of `TORON_CRITERION_...`.
   */
  int32_t criterion;
  /*
   0.
   */
  int32_t reserved;
  /*
   In: the volume ratio J, a factor of the work per reference volume; 0: 1, not known.
   */
  double jacobian;
  /*
   In, 6: tensor components 11 22 33 12 23 31 (half the engineering shears) in the material axes. Must not be null.
   */
  const float *strain;
  /*
   In, 10: the old state; if null, all 0.
   */
  const float *state_old;
  /*
   Out, 10: the new state; null: it is not returned.
   */
  float *state_new;
  /*
   Out, 6: Cauchy stress in the material axes.
   */
  float *stress;
} toron_linear_increment_f32;

/*
 A block of points of the linear elastic law. Set `size`, `n`, and what is wanted; the rest is 0: an array that is
 null is left out, and an output that is left out is not computed.

 Entries are placed as in `toron_block_f64`; the arrays hold what they hold in `toron_linear_point_f64`.
 */
typedef struct toron_linear_block_f64 {
  /*
   The size of this structure.
   */
  size_t size;
  /*
   The number of points.
   */
  size_t n;
  /*
   In numbers, from one component to the next; 0: n.
   */
  size_t leading_dimension;
  /*
   In: one of `TORON_ROTATION_...`, `TORON_CRITERION_...`, `TORON_TANGENT_...` and `TORON_LEVEL_...`.
   */
  int32_t rotation;
  int32_t criterion;
  int32_t measure;
  int32_t level;
  /*
   In: reference density; read if `wave_speed` is not null.
   */
  double density;
  /*
   In, 9 components each: F by columns at both ends of the step. The first must not be null.
   */
  const double *f_old[9];
  const double *f_new[9];
  /*
   In, 3 components each: fibre direction and second axis of each point.
   */
  const double *fibre[3];
  const double *second_axis[3];
  /*
   In and out, 9 components: the current material axes, for `TORON_ROTATION_SPIN`, which are checked as
   those of `toron_linear_point_f64`: the code of a point whose axes are not orthonormal is `TORON_MATERIAL_AXES`.
   */
  double *axes;
  /*
   In, 10 components: the old state; if null, all 0.
   */
  const double *state_old;
  /*
   Out, 10 components: the new state.
   */
  double *state_new;
  /*
   Out, 6 components: Cauchy stress in global axes, 11 22 33 12 23 31.
   */
  double *stress[6];
  /*
   Out, 36 components (81 for `TORON_TANGENT_NOMINAL`): the tangent.
   */
  double *tangent;
  /*
   Out, a number for each point: an upper bound of the wave speed.
   */
  double *wave_speed;
  /*
   Out, a number for each point: 1, or 0 if it has failed or cannot be evaluated.
   */
  double *active;
  /*
   Out, a number for each point: its status code.
   */
  int32_t *status;
  /*
   Where the entries of these arrays are. That of F holds for both ends, that of the fibre for the second axis too,
   that of the state for the old and the new one.
   */
  struct toron_layout deformation_gradient_layout;
  struct toron_layout fibre_layout;
  struct toron_layout axes_layout;
  struct toron_layout state_layout;
  struct toron_layout stress_layout;
  struct toron_layout tangent_layout;
  /*
   In, a number for each point: the strength in place of that of the properties; if null or 0, that of the
   properties. Read if `state_new` is not null.
   */
  const double *limit;
  struct toron_layout limit_layout;
} toron_linear_block_f64;

/*
 A block of points of the linear elastic law. Set `size`, `n`, and what is wanted; the rest is 0: an array that is
 null is left out, and an output that is left out is not computed.

 Entries are placed as in `toron_block_f64`; the arrays hold what they hold in `toron_linear_point_f64`.
 */
typedef struct toron_linear_block_f32 {
  /*
   The size of this structure.
   */
  size_t size;
  /*
   The number of points.
   */
  size_t n;
  /*
   In numbers, from one component to the next; 0: n.
   */
  size_t leading_dimension;
  /*
   In: one of `TORON_ROTATION_...`, `TORON_CRITERION_...`, `TORON_TANGENT_...` and `TORON_LEVEL_...`.
   */
  int32_t rotation;
  int32_t criterion;
  int32_t measure;
  int32_t level;
  /*
   In: reference density; read if `wave_speed` is not null.
   */
  double density;
  /*
   In, 9 components each: F by columns at both ends of the step. The first must not be null.
   */
  const float *f_old[9];
  const float *f_new[9];
  /*
   In, 3 components each: fibre direction and second axis of each point.
   */
  const float *fibre[3];
  const float *second_axis[3];
  /*
   In and out, 9 components: the current material axes, for `TORON_ROTATION_SPIN`, which are checked as
   those of `toron_linear_point_f64`: the code of a point whose axes are not orthonormal is `TORON_MATERIAL_AXES`.
   */
  float *axes;
  /*
   In, 10 components: the old state; if null, all 0.
   */
  const float *state_old;
  /*
   Out, 10 components: the new state.
   */
  float *state_new;
  /*
   Out, 6 components: Cauchy stress in global axes, 11 22 33 12 23 31.
   */
  float *stress[6];
  /*
   Out, 36 components (81 for `TORON_TANGENT_NOMINAL`): the tangent.
   */
  float *tangent;
  /*
   Out, a number for each point: an upper bound of the wave speed.
   */
  float *wave_speed;
  /*
   Out, a number for each point: 1, or 0 if it has failed or cannot be evaluated.
   */
  float *active;
  /*
   Out, a number for each point: its status code.
   */
  int32_t *status;
  /*
   Where the entries of these arrays are. That of F holds for both ends, that of the fibre for the second axis too,
   that of the state for the old and the new one.
   */
  struct toron_layout deformation_gradient_layout;
  struct toron_layout fibre_layout;
  struct toron_layout axes_layout;
  struct toron_layout state_layout;
  struct toron_layout stress_layout;
  struct toron_layout tangent_layout;
  /*
   In, a number for each point: the strength in place of that of the properties; if null or 0, that of the
   properties. Read if `state_new` is not null.
   */
  const float *limit;
  struct toron_layout limit_layout;
} toron_linear_block_f32;

/*
 The arguments of a VUMAT that the laws use, stored as in Abaqus: arrays are (nblock, components), column-major.
 */
typedef struct toron_vumat_f64 {
  /*
   The size of this structure.
   */
  size_t size;
  /*
   Numbers of points, of direct components (3), of shear components (3; 1 for plane strain and axisymmetric solids,
   which the caller has to tell from plane stress: Abaqus passes the same numbers), of state variables (the law's,
   or more) and of properties (the law's, or one more).
   */
  int32_t nblock;
  int32_t ndir;
  int32_t nshr;
  int32_t nstatev;
  int32_t nprops;
  /*
   In: the instruction set to use, one of `TORON_LEVEL_...`; 0: the best.
   */
  int32_t level;
  /*
   If both are 0, this is Abaqus's data check, and an elastic stress for `strain_inc` is returned.
   */
  double step_time;
  double total_time;
  /*
   In: properties, nprops; behind them may stand the number of the state variable with each point's failure limit.
   */
  const double *props;
  /*
   In, 1: current density at the middle of the step.
   */
  const double *density;
  /*
   In, 6 (or 4, as all tensors of plane elements): increment of strain, tensor components; read in the data check
   only.
   */
  const double *strain_inc;
  /*
   In, 6 components each: the right stretch U at the start and at the end of the increment, 11 22 33 12 23 31.
   */
  const double *stretch_old;
  const double *stretch_new;
  /*
   In, with 6, nstatev, 1 and 1 components.
   */
  const double *stress_old;
  const double *state_old;
  const double *ener_intern_old;
  const double *ener_inelas_old;
  /*
   Out, with 6, nstatev, 1 and 1 components.
   */
  double *stress_new;
  double *state_new;
  double *ener_intern_new;
  double *ener_inelas_new;
} toron_vumat_f64;

/*
 The arguments of a VUMAT that the laws use, stored as in Abaqus: arrays are (nblock, components), column-major.
 */
typedef struct toron_vumat_f32 {
  /*
   The size of this structure.
   */
  size_t size;
  /*
   Numbers of points, of direct components (3), of shear components (3; 1 for plane strain and axisymmetric solids,
   which the caller has to tell from plane stress: Abaqus passes the same numbers), of state variables (the law's,
   or more) and of properties (the law's, or one more).
   */
  int32_t nblock;
  int32_t ndir;
  int32_t nshr;
  int32_t nstatev;
  int32_t nprops;
  /*
   In: the instruction set to use, one of `TORON_LEVEL_...`; 0: the best.
   */
  int32_t level;
  /*
   If both are 0, this is Abaqus's data check, and an elastic stress for `strain_inc` is returned.
   */
  double step_time;
  double total_time;
  /*
   In: properties, nprops; behind them may stand the number of the state variable with each point's failure limit.
   */
  const float *props;
  /*
   In, 1: current density at the middle of the step.
   */
  const float *density;
  /*
   In, 6 (or 4, as all tensors of plane elements): increment of strain, tensor components; read in the data check
   only.
   */
  const float *strain_inc;
  /*
   In, 6 components each: the right stretch U at the start and at the end of the increment, 11 22 33 12 23 31.
   */
  const float *stretch_old;
  const float *stretch_new;
  /*
   In, with 6, nstatev, 1 and 1 components.
   */
  const float *stress_old;
  const float *state_old;
  const float *ener_intern_old;
  const float *ener_inelas_old;
  /*
   Out, with 6, nstatev, 1 and 1 components.
   */
  float *stress_new;
  float *state_new;
  float *ener_intern_new;
  float *ener_inelas_new;
} toron_vumat_f32;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/*
 The version of the library as a null-terminated static string; do not free it.
 */
const char *toron_version(void);

/*
 The version of the binary interface with which the library was built. It must equal `TORON_ABI_VERSION`.
 */
int32_t toron_abi_version(void);

/*
 Writes the meaning of a status code as a sentence to `message`.

 Returns 0, or `TORON_UNKNOWN_NAME` if there is no such code, which the text then says.
 */
int32_t toron_status_message(int32_t status, char *message, size_t capacity);

/*
 The number of properties of a law (`TORON_HYPERELASTIC`, `TORON_LINEAR_ELASTIC`, `TORON_FRICTIONAL`), or
 `TORON_UNKNOWN_NAME`.
 */
int32_t toron_property_count(int32_t law, char *message, size_t capacity);

/*
 Writes the table row of property `index`, counted from 0, to `row`, whose `size` is set.

 Returns 0, `TORON_UNKNOWN_NAME`, `TORON_NULL_ARGUMENT` or `TORON_BAD_SIZE`.
 */
int32_t toron_property(int32_t law, int32_t index, struct toron_table_row *row, char *message, size_t capacity);

/*
 The index, counted from 0, of the property with this name, or `TORON_UNKNOWN_NAME` or `TORON_NULL_ARGUMENT`.
 */
int32_t toron_property_index(int32_t law, const char *property, char *message, size_t capacity);

/*
 The number of state variables of a law, or `TORON_UNKNOWN_NAME`.
 */
int32_t toron_state_count(int32_t law, char *message, size_t capacity);

/*
 Writes the state variable of this index, from 0, to `row`; as `toron_property`.
 */
int32_t toron_state_variable(int32_t law, int32_t index, struct toron_table_row *row, char *message, size_t capacity);

/*
 The index, from 0, of the state variable of this name; as `toron_property_index`.
 */
int32_t toron_state_index(int32_t law, const char *variable, char *message, size_t capacity);

/*
 The properties and the reference density of a preset, in the units of the user's model.

 - `preset`: "kevlar-km2-600" or "kevlar-km2-600-linear"; `units`: a unit of length, one of mass and one of time,
   joined by "-", such as "m-kg-s" (or "si"), "mm-tonne-s", "mm-kg-ms", "cm-g-us".
 - `properties`: array for the properties; `count` must equal the law's number of properties. `density`: one value,
   out, or null.

 Returns 0, `TORON_UNKNOWN_NAME`, `TORON_NULL_ARGUMENT` or `TORON_PROPERTY_COUNT`.
 */
int32_t toron_preset_f64(const char *preset,
                         const char *units,
                         double *properties,
                         size_t count,
                         double *density,
                         char *message,
                         size_t capacity);

/*
 As `toron_preset_f64`, rounded to single precision.
 */
int32_t toron_preset_f32(const char *preset,
                         const char *units,
                         float *properties,
                         size_t count,
                         float *density,
                         char *message,
                         size_t capacity);

/*
 Checks the properties of the hyperelastic law, and prepares the law from them.

 - `law`: out; `size`: `sizeof *law`.
 - `properties`, `count`: the properties in the table's order.

 Returns 0; or `TORON_NULL_ARGUMENT`, `TORON_BAD_SIZE` or a −2xx code, and nothing is written: the message names the
 wrong property, its value and the allowed values.
 */
int32_t toron_hyperelastic_prepare_f64(struct toron_hyperelastic_f64 *law,
                                       size_t size,
                                       const double *properties,
                                       size_t count,
                                       char *message,
                                       size_t capacity);

/*
 As `toron_hyperelastic_prepare_f64`, in single precision.
 */
int32_t toron_hyperelastic_prepare_f32(struct toron_hyperelastic_f32 *law,
                                       size_t size,
                                       const float *properties,
                                       size_t count,
                                       char *message,
                                       size_t capacity);

/*
 The hyperelastic law at one point, with or without a tangent: see `toron_point_f64`.

 Returns 0, a −1xx or −2xx code (nothing is written), or a −3xx code (stress, modes and tangent are 0, the wave
 speed is that of a yarn at rest, the state is unchanged but for `alive`, which is 1 - failed).
 */
int32_t toron_hyperelastic_point_f64(const struct toron_hyperelastic_f64 *law,
                                     const struct toron_point_f64 *point,
                                     char *message,
                                     size_t capacity);

/*
 As `toron_hyperelastic_point_f64`, in single precision.
 */
int32_t toron_hyperelastic_point_f32(const struct toron_hyperelastic_f32 *law,
                                     const struct toron_point_f32 *point,
                                     char *message,
                                     size_t capacity);

/*
 As `toron_hyperelastic_point_f64`, with the properties in the table's order, which are checked in every call, in
 place of a law that has been prepared. That takes longer; the results may differ in the last digits.
 */
int32_t toron_hyperelastic_point_with_properties_f64(const double *properties,
                                                     size_t count,
                                                     const struct toron_point_f64 *point,
                                                     char *message,
                                                     size_t capacity);

/*
 As `toron_hyperelastic_point_with_properties_f64`, in single precision.
 */
int32_t toron_hyperelastic_point_with_properties_f32(const float *properties,
                                                     size_t count,
                                                     const struct toron_point_f32 *point,
                                                     char *message,
                                                     size_t capacity);

/*
 The hyperelastic law at a block of points, with or without a tangent: see `toron_block_f64`.

 Returns 0; or the most negative −3xx code of the points (a point with such a code has zero stress and keeps its
 state; the other points are not affected), and the message names the first point with that code (without `status`
 only if its F and fibre still tell it); or a −1xx or −2xx code, and then nothing is written.
 */
int32_t toron_hyperelastic_block_f64(const struct toron_hyperelastic_f64 *law,
                                     const struct toron_block_f64 *block,
                                     char *message,
                                     size_t capacity);

/*
 As `toron_hyperelastic_block_f64`, in single precision.
 */
int32_t toron_hyperelastic_block_f32(const struct toron_hyperelastic_f32 *law,
                                     const struct toron_block_f32 *block,
                                     char *message,
                                     size_t capacity);

/*
 As `toron_hyperelastic_block_f64`, with the properties in the table's order, which are checked in every call, in
 place of a law that has been prepared. The results are the same bits.
 */
int32_t toron_hyperelastic_block_with_properties_f64(const double *properties,
                                                     size_t count,
                                                     const struct toron_block_f64 *block,
                                                     char *message,
                                                     size_t capacity);

/*
 As `toron_hyperelastic_block_with_properties_f64`, in single precision.
 */
int32_t toron_hyperelastic_block_with_properties_f32(const float *properties,
                                                     size_t count,
                                                     const struct toron_block_f32 *block,
                                                     char *message,
                                                     size_t capacity);

/*
 Stability check: the smallest eigenvalue, over all wave directions, of the acoustic tensor times the reference
 density.

 If it is negative, the material has lost ellipticity: wave speeds are imaginary and results depend on the mesh.
 Without k_ld it is 0 to rounding in stable states: compare it with −1e-9 k_el.

 - `point`: its `deformation_gradient` and `fibre` are read.
 - `least`: the eigenvalue, out, in units of stress; `direction`: 3 values, out, the unit normal of that wave in
   global axes, or null.

 Returns 0; a −1xx or −3xx code, and nothing is written.
 */
int32_t toron_hyperelastic_least_acoustic_eigenvalue_f64(const struct toron_hyperelastic_f64 *law,
                                                         const struct toron_point_f64 *point,
                                                         double *least,
                                                         double *direction,
                                                         char *message,
                                                         size_t capacity);

/*
 Checks the properties of the law with friction, and prepares the law from them; as `toron_hyperelastic_prepare_f64`.
 */
int32_t toron_frictional_prepare_f64(struct toron_frictional_f64 *law,
                                     size_t size,
                                     const double *properties,
                                     size_t count,
                                     char *message,
                                     size_t capacity);

/*
 As `toron_frictional_prepare_f64`, in single precision.
 */
int32_t toron_frictional_prepare_f32(struct toron_frictional_f32 *law,
                                     size_t size,
                                     const float *properties,
                                     size_t count,
                                     char *message,
                                     size_t capacity);

/*
 The law with friction over a step at one point, with or without a tangent: see `toron_point_f64`; its arrays of the
 state have 15 values. The step goes from the slip of the old state to the deformation gradient.

 Returns 0, a −1xx or −2xx code (nothing is written), or a −3xx code (stress, modes and tangent are 0, the wave speed
 is that of a yarn at rest, the state is unchanged but for `alive`, which is 1 - failed, and for numbers that are not
 finite, which become 0: after −304 a slip that was NaN is forgotten).
 */
int32_t toron_frictional_point_f64(const struct toron_frictional_f64 *law,
                                   const struct toron_point_f64 *point,
                                   char *message,
                                   size_t capacity);

/*
 As `toron_frictional_point_f64`, in single precision.
 */
int32_t toron_frictional_point_f32(const struct toron_frictional_f32 *law,
                                   const struct toron_point_f32 *point,
                                   char *message,
                                   size_t capacity);

/*
 As `toron_frictional_point_f64`, with the properties in the table's order in place of a law that has been prepared.
 The results are the same bits.
 */
int32_t toron_frictional_point_with_properties_f64(const double *properties,
                                                   size_t count,
                                                   const struct toron_point_f64 *point,
                                                   char *message,
                                                   size_t capacity);

/*
 As `toron_frictional_point_with_properties_f64`, in single precision.
 */
int32_t toron_frictional_point_with_properties_f32(const float *properties,
                                                   size_t count,
                                                   const struct toron_point_f32 *point,
                                                   char *message,
                                                   size_t capacity);

/*
 The law with friction over a step at a block of points, with or without a tangent: see `toron_block_f64`; its arrays
 of the failure have 7 components.

 Returns the worst status code of the points: 0, or the most negative −3xx code (that point carries no stress and
 keeps its state; the others are not affected; the message names the first one, without `status` only if its F and
 fibre still tell it); or a −1xx or −2xx code, and nothing is written.
 */
int32_t toron_frictional_block_f64(const struct toron_frictional_f64 *law,
                                   const struct toron_block_f64 *block,
                                   char *message,
                                   size_t capacity);

/*
 As `toron_frictional_block_f64`, in single precision.
 */
int32_t toron_frictional_block_f32(const struct toron_frictional_f32 *law,
                                   const struct toron_block_f32 *block,
                                   char *message,
                                   size_t capacity);

/*
 As `toron_frictional_block_f64`, with the properties in the table's order in place of a law that has been prepared.
 The results are the same bits.
 */
int32_t toron_frictional_block_with_properties_f64(const double *properties,
                                                   size_t count,
                                                   const struct toron_block_f64 *block,
                                                   char *message,
                                                   size_t capacity);

/*
 As `toron_frictional_block_with_properties_f64`, in single precision.
 */
int32_t toron_frictional_block_with_properties_f32(const float *properties,
                                                   size_t count,
                                                   const struct toron_block_f32 *block,
                                                   char *message,
                                                   size_t capacity);

/*
 Checks the properties of the linear elastic law, and prepares the law from them; as
 `toron_hyperelastic_prepare_f64`.
 */
int32_t toron_linear_elastic_prepare_f64(struct toron_linear_elastic_f64 *law,
                                         size_t size,
                                         const double *properties,
                                         size_t count,
                                         char *message,
                                         size_t capacity);

/*
 As `toron_linear_elastic_prepare_f64`, in single precision.
 */
int32_t toron_linear_elastic_prepare_f32(struct toron_linear_elastic_f32 *law,
                                         size_t size,
                                         const float *properties,
                                         size_t count,
                                         char *message,
                                         size_t capacity);

/*
 The material axes of the linear elastic law in the undeformed state: the initial value of `axes` for
 `TORON_ROTATION_SPIN`.

 - `fibre`, `second_axis`: 3 values each, those of a point, of any length; null: those of the properties. The second
   axis may be 0 if any will do.
 - `axes`: 9 values, out, the three axes one after the other.

 Returns 0, `TORON_NULL_ARGUMENT`, `TORON_NOT_PREPARED`, or `TORON_FIBRE_DIRECTION` if there are no such axes.
 */
int32_t toron_linear_elastic_axes_f64(const struct toron_linear_elastic_f64 *law,
                                      const double *fibre,
                                      const double *second_axis,
                                      double *axes,
                                      char *message,
                                      size_t capacity);

/*
 As `toron_linear_elastic_axes_f64`, in single precision.
 */
int32_t toron_linear_elastic_axes_f32(const struct toron_linear_elastic_f32 *law,
                                      const float *fibre,
                                      const float *second_axis,
                                      float *axes,
                                      char *message,
                                      size_t capacity);

/*
 The linear elastic law over a step at one point, from the deformation gradients at both ends: see
 `toron_linear_point_f64`.

 Returns 0, a −1xx or −2xx code (nothing is written), or a −3xx code (stress and tangent are 0, the state is
 unchanged but for `alive`).
 */
int32_t toron_linear_elastic_point_f64(const struct toron_linear_elastic_f64 *law,
                                       const struct toron_linear_point_f64 *point,
                                       char *message,
                                       size_t capacity);

/*
 As `toron_linear_elastic_point_f64`, in single precision.
 */
int32_t toron_linear_elastic_point_f32(const struct toron_linear_elastic_f32 *law,
                                       const struct toron_linear_point_f32 *point,
                                       char *message,
                                       size_t capacity);

/*
 As `toron_linear_elastic_point_f64`, with the properties in the table's order in place of a law that has been
 prepared. The results are the same bits.
 */
int32_t toron_linear_elastic_point_with_properties_f64(const double *properties,
                                                       size_t count,
                                                       const struct toron_linear_point_f64 *point,
                                                       char *message,
                                                       size_t capacity);

/*
 As `toron_linear_elastic_point_with_properties_f64`, in single precision.
 */
int32_t toron_linear_elastic_point_with_properties_f32(const float *properties,
                                                       size_t count,
                                                       const struct toron_linear_point_f32 *point,
                                                       char *message,
                                                       size_t capacity);

/*
 The linear elastic law for a strain increment in material axes that the host updates: see
 `toron_linear_increment_f64`.

 The result is only as good as the axes: if they follow the polar rotation or the spin, the stiff direction drifts
 away from a sheared fibre. Returns the same codes as `toron_linear_elastic_point_f64`.
 */
int32_t toron_linear_elastic_increment_f64(const struct toron_linear_elastic_f64 *law,
                                           const struct toron_linear_increment_f64 *increment,
                                           char *message,
                                           size_t capacity);

/*
 As `toron_linear_elastic_increment_f64`, in single precision.
 */
int32_t toron_linear_elastic_increment_f32(const struct toron_linear_elastic_f32 *law,
                                           const struct toron_linear_increment_f32 *increment,
                                           char *message,
                                           size_t capacity);

/*
 The linear elastic law over a step at a block of points: see `toron_linear_block_f64`.

 Returns the worst status code of the points: 0, or the most negative −3xx code (that point carries no stress and
 keeps its state and axes; the others are not affected; the message names the first one, without `status` only if its
 F and directions still tell it); or a −1xx or −2xx code, and nothing is written.
 */
int32_t toron_linear_elastic_block_f64(const struct toron_linear_elastic_f64 *law,
                                       const struct toron_linear_block_f64 *block,
                                       char *message,
                                       size_t capacity);

/*
 As `toron_linear_elastic_block_f64`, in single precision.
 */
int32_t toron_linear_elastic_block_f32(const struct toron_linear_elastic_f32 *law,
                                       const struct toron_linear_block_f32 *block,
                                       char *message,
                                       size_t capacity);

/*
 As `toron_linear_elastic_block_f64`, with the properties in the table's order in place of a law that has been
 prepared. The results are the same bits.
 */
int32_t toron_linear_elastic_block_with_properties_f64(const double *properties,
                                                       size_t count,
                                                       const struct toron_linear_block_f64 *block,
                                                       char *message,
                                                       size_t capacity);

/*
 As `toron_linear_elastic_block_with_properties_f64`, in single precision.
 */
int32_t toron_linear_elastic_block_with_properties_f32(const float *properties,
                                                       size_t count,
                                                       const struct toron_linear_block_f32 *block,
                                                       char *message,
                                                       size_t capacity);

/*
 The hyperelastic law as a UMAT of Abaqus/Standard.

 The arguments are those of a UMAT with the same names: `stress` (`ntens` = `ndi` + `nshr`, out), `statev` (`nstatv`
 ≥ 11, in and out), `ddsdde` (`ntens` × `ntens`, out, symmetric, engineering shears; if null, it is not computed),
 `sse` (out), `pnewdt` (in and out), `dfgrd1` (9, in), `props` (`nprops` = 11, in, or 12: the last one is the number
 of the state variable that holds the point's own limit, ln(1 + eps_lim), or 0), `ndi` = 3, `nshr` = 3, or 1 for
 plane strain and axisymmetric solids, whose fibre lies in the plane or normal to it, and `nlgeom`: JSTEP(3) of
 Abaqus, which is not 0 with NLGEOM=YES; without it there is no F. No pointer other than `ddsdde` may be null.

 DDSDDE is the modulus of the Jaumann rate of the Kirchhoff stress, over J. The call that detects failure returns the
 intact tangent, later calls return zeros.

 Returns 0; a −1xx code (`TORON_NO_DEFORMATION_GRADIENT` where `nlgeom` is 0, `TORON_BAD_ARGUMENT` for a limit of the
 point that is negative, NaN or infinite) or a −2xx code (`TORON_FIBRE_OUT_OF_PLANE` among them), and nothing is
 written; or a −3xx code: stress and tangent are 0, the state is unchanged, `pnewdt` is reduced to at most 0.25.
 */
int32_t toron_abaqus_umat_tangent_f64(double *stress,
                                      double *statev,
                                      double *ddsdde,
                                      double *sse,
                                      double *pnewdt,
                                      const double *dfgrd1,
                                      const double *props,
                                      int32_t nprops,
                                      int32_t nstatv,
                                      int32_t ndi,
                                      int32_t nshr,
                                      int32_t nlgeom,
                                      char *message,
                                      size_t capacity);

/*
 As `toron_abaqus_umat_tangent_f64` without DDSDDE, for hosts that want none.
 */
int32_t toron_abaqus_umat_f64(double *stress,
                              double *statev,
                              double *sse,
                              double *pnewdt,
                              const double *dfgrd1,
                              const double *props,
                              int32_t nprops,
                              int32_t nstatv,
                              int32_t ndi,
                              int32_t nshr,
                              int32_t nlgeom,
                              char *message,
                              size_t capacity);

/*
 The linear elastic law as a UMAT of Abaqus/Standard.

 The arguments are those of `toron_abaqus_umat_tangent_f64`, and `dfgrd0` (9, in), F at the start of the increment;
 `nstatv` ≥ 10, `nprops` = 10, or 11: the last one is the number of the state variable that holds the point's own
 strength, or 0. The material axes follow the fibre, and the largest principal stress is compared with σ_lim. DDSDDE
 is not symmetric: `*USER MATERIAL, UNSYMM`; Abaqus takes its symmetric part otherwise. In plane strain and
 axisymmetric solids both axes lie in the plane or normal to it.

 Returns as `toron_abaqus_umat_tangent_f64` does, and `TORON_INCREMENT_TOO_LARGE` for a step that cannot be
 integrated.
 */
int32_t toron_abaqus_linear_umat_f64(double *stress,
                                     double *statev,
                                     double *ddsdde,
                                     double *sse,
                                     double *pnewdt,
                                     const double *dfgrd0,
                                     const double *dfgrd1,
                                     const double *props,
                                     int32_t nprops,
                                     int32_t nstatv,
                                     int32_t ndi,
                                     int32_t nshr,
                                     int32_t nlgeom,
                                     char *message,
                                     size_t capacity);

/*
 The law with friction as a UMAT of Abaqus/Standard.

 The arguments are those of `toron_abaqus_umat_tangent_f64`, and `spd` (out): the energy lost per current volume;
 `nstatv` ≥ 15, `nprops` = 13, or 14: the last one is the number of the state variable that holds the point's own
 limit, or 0. DDSDDE is not symmetric where the fibres slide: `*USER MATERIAL, UNSYMM`; Abaqus takes its symmetric
 part otherwise.

 Returns as `toron_abaqus_umat_tangent_f64` does.
 */
int32_t toron_abaqus_frictional_umat_f64(double *stress,
                                         double *statev,
                                         double *ddsdde,
                                         double *sse,
                                         double *spd,
                                         double *pnewdt,
                                         const double *dfgrd1,
                                         const double *props,
                                         int32_t nprops,
                                         int32_t nstatv,
                                         int32_t ndi,
                                         int32_t nshr,
                                         int32_t nlgeom,
                                         char *message,
                                         size_t capacity);

/*
 The hyperelastic law as a VUMAT of Abaqus/Explicit, for jobs in double precision.

 `block` holds the VUMAT's arguments; their shapes are given in `toron_vumat_f64`. All pointers are the caller's and
 not null. The law reads U, not F, so that the stress is the corotational one that Abaqus wants. In the data check
 (`step_time` = `total_time` = 0) the answer is elastic and nothing fails. State variable 11, "alive", deletes the
 element.

 Returns the worst status: 0; a −1xx or −2xx code (`TORON_BAD_ARGUMENT` among them, in the data check for a limit of
 a point that is negative, NaN or infinite), and nothing is written; or the most negative −3xx code: a point with
 such a code has zero stress, keeps its energies and invariants, and is marked as failed and deleted. State variables
 behind those of the law are copied; `ener_inelas_new` is `ener_inelas_old`, or 0 where that is not finite.
 */
int32_t toron_abaqus_vumat_f64(const struct toron_vumat_f64 *block, char *message, size_t capacity);

/*
 As `toron_abaqus_vumat_f64`, for jobs in single precision.
 */
int32_t toron_abaqus_vumat_f32(const struct toron_vumat_f32 *block, char *message, size_t capacity);

/*
 The linear elastic law as a VUMAT of Abaqus/Explicit, for jobs in double precision: as `toron_abaqus_vumat_f64`,
 with 10 properties and 10 state variables or more, of which number 10, "alive", deletes the element. It reads U at
 both ends of the increment.
 */
int32_t toron_abaqus_linear_vumat_f64(const struct toron_vumat_f64 *block, char *message, size_t capacity);

/*
 As `toron_abaqus_linear_vumat_f64`, for jobs in single precision.
 */
int32_t toron_abaqus_linear_vumat_f32(const struct toron_vumat_f32 *block, char *message, size_t capacity);

/*
 The law with friction as a VUMAT of Abaqus/Explicit, for jobs in double precision: as `toron_abaqus_vumat_f64`, with
 13 properties and 15 state variables or more, of which number 15, "alive", deletes the element. `ener_inelas_new` is
 the energy lost per mass.
 */
int32_t toron_abaqus_frictional_vumat_f64(const struct toron_vumat_f64 *block, char *message, size_t capacity);

/*
 As `toron_abaqus_frictional_vumat_f64`, for jobs in single precision.
 */
int32_t toron_abaqus_frictional_vumat_f32(const struct toron_vumat_f32 *block, char *message, size_t capacity);

/*
 The hyperelastic law as a scalar user material of LS-DYNA, in double precision.

 `cm`: at least 11 values, the properties; `sig`: 6 values, the Cauchy stress, out; `hsv`: `nhv` = 11 state
 variables, in and out, followed by the 9 entries of F by columns, in; `failel`: out, 1 where the element has failed
 or could not be evaluated, else 0. None may be null.

 Returns 0; `TORON_NULL_ARGUMENT`, `TORON_STATE_COUNT`, `TORON_NO_DEFORMATION_GRADIENT` (F = 0 or stored elsewhere:
 check IHYPER and NHV on the card) or a −2xx code, and nothing is written; or a −3xx code: the stress is 0, energies
 and invariants are unchanged, and the element is marked as failed.
 */
int32_t toron_lsdyna_umat_f64(const double *cm,
                              double *sig,
                              double *hsv,
                              int32_t nhv,
                              int *failel,
                              char *message,
                              size_t capacity);

/*
 As `toron_lsdyna_umat_f64`, in single precision.
 */
int32_t toron_lsdyna_umat_f32(const float *cm,
                              float *sig,
                              float *hsv,
                              int32_t nhv,
                              int *failel,
                              char *message,
                              size_t capacity);

/*
 The hyperelastic law as a vectorised user material of LS-DYNA, in double precision.

 `cm`: 11 properties or more; `sig1` … `sig6`: `nlq` each, out; `hsvs`: (`nlq`, 20), `nhv` = 11 state variables, in
 and out, then F, in; `failels`: `nlq`, out, 1 where an element has failed or could not be evaluated, else 0.
 Elements `lft` to `llt`, counted from 1, are evaluated; the others are not touched. No pointer may be null.

 Returns the worst status: 0; `TORON_NULL_ARGUMENT`, `TORON_BAD_COUNT`, `TORON_BAD_LEADING_DIMENSION`,
 `TORON_STATE_COUNT`, `TORON_NO_DEFORMATION_GRADIENT` (of the first element, as in `toron_lsdyna_umat_f64`) or a −2xx
 code, and nothing is written; or the most negative −3xx code of the elements: an element with such a code has zero
 stress, keeps its energies and invariants, and is marked as failed.
 */
int32_t toron_lsdyna_umat_vector_f64(const double *cm,
                                     double *sig1,
                                     double *sig2,
                                     double *sig3,
                                     double *sig4,
                                     double *sig5,
                                     double *sig6,
                                     double *hsvs,
                                     int32_t nhv,
                                     int32_t lft,
                                     int32_t llt,
                                     int32_t nlq,
                                     int *failels,
                                     char *message,
                                     size_t capacity);

/*
 As `toron_lsdyna_umat_vector_f64`, in single precision.
 */
int32_t toron_lsdyna_umat_vector_f32(const float *cm,
                                     float *sig1,
                                     float *sig2,
                                     float *sig3,
                                     float *sig4,
                                     float *sig5,
                                     float *sig6,
                                     float *hsvs,
                                     int32_t nhv,
                                     int32_t lft,
                                     int32_t llt,
                                     int32_t nlq,
                                     int *failels,
                                     char *message,
                                     size_t capacity);

/*
 The tangent of the hyperelastic law for LS-DYNA's scalar user routine `utan`, in double precision.

 `cm`: 11 properties or more; `hsv`: `nhv` = 11 state variables, then 9 entries of F, in, as written by the material
 routine; `es`: 6 × 6, out, the Truesdell modulus of the Cauchy stress, 11 22 33 12 23 31, engineering shears,
 symmetric. None may be null.

 Returns 0; `TORON_NULL_ARGUMENT`, `TORON_STATE_COUNT`, `TORON_NO_DEFORMATION_GRADIENT` or a −2xx code, and nothing
 is written; or a −3xx code, and then `es` is 0. For a failed element `es` is 0 as well.
 */
int32_t toron_lsdyna_utan_f64(const double *cm,
                              const double *hsv,
                              int32_t nhv,
                              double *es,
                              char *message,
                              size_t capacity);

/*
 As `toron_lsdyna_utan_f64`, in single precision.
 */
int32_t toron_lsdyna_utan_f32(const float *cm,
                              const float *hsv,
                              int32_t nhv,
                              float *es,
                              char *message,
                              size_t capacity);

/*
 The tangent of the hyperelastic law as LS-DYNA's vectorised `utan` wants it, in double precision.

 `cm`, `nhv`, `lft`, `llt`, `nlq` as for `toron_lsdyna_umat_vector_f64`; `hsvs`: (`nlq`, 20), in; `dsave`: (`nlq`, 6,
 6), out, as `es` of `toron_lsdyna_utan_f64`. Elements `lft` to `llt`, counted from 1, are evaluated; the others are
 not touched.

 Returns the worst status, as `toron_lsdyna_umat_vector_f64` does; the tangent is 0 for an element that cannot be
 evaluated or has failed.
 */
int32_t toron_lsdyna_utan_vector_f64(const double *cm,
                                     const double *hsvs,
                                     int32_t nhv,
                                     int32_t lft,
                                     int32_t llt,
                                     int32_t nlq,
                                     double *dsave,
                                     char *message,
                                     size_t capacity);

/*
 As `toron_lsdyna_utan_vector_f64`, in single precision.
 */
int32_t toron_lsdyna_utan_vector_f32(const float *cm,
                                     const float *hsvs,
                                     int32_t nhv,
                                     int32_t lft,
                                     int32_t llt,
                                     int32_t nlq,
                                     float *dsave,
                                     char *message,
                                     size_t capacity);

/*
 Computes the bulk and shear modulus to be entered as cm(12) and cm(13), to which IBULK = 12 and IG = 13 on the card
 refer.

 LS-DYNA computes its time step from K + 4G/3. With these values it equals k_el, and the wave along a stretched fibre
 is never faster than √(k_el/ρ). `bulk`, `shear`: one value each, out. Returns 0, `TORON_NULL_ARGUMENT` or a −2xx
 code.
 */
int32_t toron_lsdyna_bulk_and_shear_f64(const double *values,
                                        size_t count,
                                        double *bulk,
                                        double *shear,
                                        char *message,
                                        size_t capacity);

/*
 The linear elastic law as a scalar user material of LS-DYNA, in double precision.

 As `toron_lsdyna_umat_f64`, with `cm`: at least 10 values, the properties; `hsv`: `nhv` = 19 variables, the law's 10
 state variables and the 9 entries of F of the last step by columns, in and out, followed by the 9 entries of F, in.
 The material axes follow the fibre, and the largest principal stress is compared with σ_lim.
 */
int32_t toron_lsdyna_linear_umat_f64(const double *cm,
                                     double *sig,
                                     double *hsv,
                                     int32_t nhv,
                                     int *failel,
                                     char *message,
                                     size_t capacity);

/*
 As `toron_lsdyna_linear_umat_f64`, in single precision.
 */
int32_t toron_lsdyna_linear_umat_f32(const float *cm,
                                     float *sig,
                                     float *hsv,
                                     int32_t nhv,
                                     int *failel,
                                     char *message,
                                     size_t capacity);

/*
 The linear elastic law as a vectorised user material of LS-DYNA, in double precision: as
 `toron_lsdyna_umat_vector_f64`, with `hsvs`: (`nlq`, 28), ordered as `hsv` of `toron_lsdyna_linear_umat_f64`.
 */
int32_t toron_lsdyna_linear_umat_vector_f64(const double *cm,
                                            double *sig1,
                                            double *sig2,
                                            double *sig3,
                                            double *sig4,
                                            double *sig5,
                                            double *sig6,
                                            double *hsvs,
                                            int32_t nhv,
                                            int32_t lft,
                                            int32_t llt,
                                            int32_t nlq,
                                            int *failels,
                                            char *message,
                                            size_t capacity);

/*
 As `toron_lsdyna_linear_umat_vector_f64`, in single precision.
 */
int32_t toron_lsdyna_linear_umat_vector_f32(const float *cm,
                                            float *sig1,
                                            float *sig2,
                                            float *sig3,
                                            float *sig4,
                                            float *sig5,
                                            float *sig6,
                                            float *hsvs,
                                            int32_t nhv,
                                            int32_t lft,
                                            int32_t llt,
                                            int32_t nlq,
                                            int *failels,
                                            char *message,
                                            size_t capacity);

/*
 The tangent of the linear elastic law for LS-DYNA's scalar user routine `utan`, in double precision: as
 `toron_lsdyna_utan_f64`, with `hsv` of `toron_lsdyna_linear_umat_f64`.

 It is that of a further, infinitesimal step from the state that the material routine has written, its symmetric
 part.
 */
int32_t toron_lsdyna_linear_utan_f64(const double *cm,
                                     const double *hsv,
                                     int32_t nhv,
                                     double *es,
                                     char *message,
                                     size_t capacity);

/*
 As `toron_lsdyna_linear_utan_f64`, in single precision.
 */
int32_t toron_lsdyna_linear_utan_f32(const float *cm,
                                     const float *hsv,
                                     int32_t nhv,
                                     float *es,
                                     char *message,
                                     size_t capacity);

/*
 As `toron_lsdyna_linear_utan_f64`, for LS-DYNA's vectorised `utan`: arguments as of `toron_lsdyna_utan_vector_f64`,
 with `hsvs`: (`nlq`, 28).
 */
int32_t toron_lsdyna_linear_utan_vector_f64(const double *cm,
                                            const double *hsvs,
                                            int32_t nhv,
                                            int32_t lft,
                                            int32_t llt,
                                            int32_t nlq,
                                            double *dsave,
                                            char *message,
                                            size_t capacity);

/*
 As `toron_lsdyna_linear_utan_vector_f64`, in single precision.
 */
int32_t toron_lsdyna_linear_utan_vector_f32(const float *cm,
                                            const float *hsvs,
                                            int32_t nhv,
                                            int32_t lft,
                                            int32_t llt,
                                            int32_t nlq,
                                            float *dsave,
                                            char *message,
                                            size_t capacity);

/*
 As `toron_lsdyna_bulk_and_shear_f64`, for the linear elastic law: cm(11) and cm(12), IBULK = 11 and IG = 12. K +
 4G/3 is the largest of E1, E2 and 2G.
 */
int32_t toron_lsdyna_linear_bulk_and_shear_f64(const double *values,
                                               size_t count,
                                               double *bulk,
                                               double *shear,
                                               char *message,
                                               size_t capacity);

/*
 The law with friction as a scalar user material of LS-DYNA, in double precision.

 As `toron_lsdyna_umat_f64`, with `cm`: at least 13 values, the properties; `hsv`: `nhv` = 15 state variables, in and
 out, followed by the 9 entries of F by columns, in.
 */
int32_t toron_lsdyna_frictional_umat_f64(const double *cm,
                                         double *sig,
                                         double *hsv,
                                         int32_t nhv,
                                         int *failel,
                                         char *message,
                                         size_t capacity);

/*
 As `toron_lsdyna_frictional_umat_f64`, in single precision.
 */
int32_t toron_lsdyna_frictional_umat_f32(const float *cm,
                                         float *sig,
                                         float *hsv,
                                         int32_t nhv,
                                         int *failel,
                                         char *message,
                                         size_t capacity);

/*
 The law with friction as a vectorised user material of LS-DYNA, in double precision: as
 `toron_lsdyna_umat_vector_f64`, with `hsvs`: (`nlq`, 24), ordered as `hsv` of `toron_lsdyna_frictional_umat_f64`.
 */
int32_t toron_lsdyna_frictional_umat_vector_f64(const double *cm,
                                                double *sig1,
                                                double *sig2,
                                                double *sig3,
                                                double *sig4,
                                                double *sig5,
                                                double *sig6,
                                                double *hsvs,
                                                int32_t nhv,
                                                int32_t lft,
                                                int32_t llt,
                                                int32_t nlq,
                                                int *failels,
                                                char *message,
                                                size_t capacity);

/*
 As `toron_lsdyna_frictional_umat_vector_f64`, in single precision.
 */
int32_t toron_lsdyna_frictional_umat_vector_f32(const float *cm,
                                                float *sig1,
                                                float *sig2,
                                                float *sig3,
                                                float *sig4,
                                                float *sig5,
                                                float *sig6,
                                                float *hsvs,
                                                int32_t nhv,
                                                int32_t lft,
                                                int32_t llt,
                                                int32_t nlq,
                                                int *failels,
                                                char *message,
                                                size_t capacity);

/*
 The tangent of the law with friction for LS-DYNA's scalar user routine `utan`, in double precision: as
 `toron_lsdyna_utan_f64`, with `hsv` of `toron_lsdyna_frictional_umat_f64`.

 It is that of a further, infinitesimal step from the state that the material routine has written, where the fibres
 hold: that of unloading where they have slid in the step.
 */
int32_t toron_lsdyna_frictional_utan_f64(const double *cm,
                                         const double *hsv,
                                         int32_t nhv,
                                         double *es,
                                         char *message,
                                         size_t capacity);

/*
 As `toron_lsdyna_frictional_utan_f64`, in single precision.
 */
int32_t toron_lsdyna_frictional_utan_f32(const float *cm,
                                         const float *hsv,
                                         int32_t nhv,
                                         float *es,
                                         char *message,
                                         size_t capacity);

/*
 As `toron_lsdyna_frictional_utan_f64`, for LS-DYNA's vectorised `utan`: arguments as of
 `toron_lsdyna_utan_vector_f64`, with `hsvs`: (`nlq`, 24).
 */
int32_t toron_lsdyna_frictional_utan_vector_f64(const double *cm,
                                                const double *hsvs,
                                                int32_t nhv,
                                                int32_t lft,
                                                int32_t llt,
                                                int32_t nlq,
                                                double *dsave,
                                                char *message,
                                                size_t capacity);

/*
 As `toron_lsdyna_frictional_utan_vector_f64`, in single precision.
 */
int32_t toron_lsdyna_frictional_utan_vector_f32(const float *cm,
                                                const float *hsvs,
                                                int32_t nhv,
                                                int32_t lft,
                                                int32_t llt,
                                                int32_t nlq,
                                                float *dsave,
                                                char *message,
                                                size_t capacity);

/*
 As `toron_lsdyna_bulk_and_shear_f64`, for the law with friction: cm(14) and cm(15), IBULK = 14 and IG = 15.
 */
int32_t toron_lsdyna_frictional_bulk_and_shear_f64(const double *values,
                                                   size_t count,
                                                   double *bulk,
                                                   double *shear,
                                                   char *message,
                                                   size_t capacity);

/*
 The starter's routine of a user material of OpenRadioss, `LECMUSERnn`, in double precision.

 `number`: nn, 1 for the hyperelastic law, 2 for the linear elastic one and 3 for that with friction; `values`:
 `count` numbers of the card behind the density, the law's properties and then the options; `uparam`: `maxuparam`
 values, out; `nuparam`, `nuvar`: out; `parmat`: out, 1 value, the modulus of the fastest wave at rest. None may be
 null.

 Returns 0, or a code with which the starter is to be stopped, and nothing is written: a −1xx code
 (`TORON_BAD_ARGUMENT` for a number or an option among them) or a −2xx code.
 */
int32_t toron_openradioss_lecm_f64(int32_t number,
                                   const double *values,
                                   size_t count,
                                   double *uparam,
                                   int32_t maxuparam,
                                   int32_t *nuparam,
                                   int32_t *nuvar,
                                   double *parmat,
                                   char *message,
                                   size_t capacity);

/*
 A line of what the starter's listing says of a material of OpenRadioss: what its elements need, the values of the
 card, and the names of the user variables.

 `uparam`: `nuparam` values, as `toron_openradioss_lecm_f64` has written them; `line`: counted from 0; `text`: at
 most `capacity` bytes, out, with the terminating null. Returns 0, `TORON_UNKNOWN_NAME` behind the last line, or
 another code if `uparam` is not such an array.
 */
int32_t toron_openradioss_listing_f64(const double *uparam, int32_t nuparam, int32_t line, char *text, size_t capacity);

/*
 The engine's routine of a user material of OpenRadioss, `LUSERnn`, for solids, in double precision.

 `nel` elements; `uparam`: `nuparam` values; `time`: 0 in the first cycle; `ngl`: `nel` numbers of elements for
 messages, or null; `rho0`: the reference density, 1 value; `fpsxx` … `fpsxz`: `nel` each, the deformation gradient;
 `signxx` … `signzx`: `nel` each, out, the Cauchy stress; `sigvxx` … `sigvzx` and `viscmax`: out, 0, or null;
 `soundsp`: `nel`, out, a bound of the wave speed; `uvar`: (`nel`, `nuvar`), in and out; `off`: `nel`, in and out, 0
 where a point has failed or cannot be evaluated; `nodes`: (`nel`, 8, 3), what MAT_SOLID_GET_NOD_X gives, or null;
 read at time 0 if the fibre comes from the nodes.

 A point with `off` below 1 has no stress and keeps its state; `off` never rises. The variable `deleted` says why it
 is out: 1 failed, 2 by the solver, or the −3xx code of the reason why it could not be evaluated.

 Returns 0, or a code with which the run is to be stopped: a −1xx code (`TORON_NO_DEFORMATION_GRADIENT` where Ismstr
 is not 10) or a −2xx code, and nothing is written; or `TORON_FIBRE_DIRECTION` or `TORON_LIMIT` of an element.
 */
int32_t toron_openradioss_luser_f64(int32_t nel,
                                    int32_t nuparam,
                                    int32_t nuvar,
                                    double time,
                                    const double *uparam,
                                    const int32_t *ngl,
                                    const double *rho0,
                                    const double *fpsxx,
                                    const double *fpsyy,
                                    const double *fpszz,
                                    const double *fpsxy,
                                    const double *fpsyz,
                                    const double *fpszx,
                                    const double *fpsyx,
                                    const double *fpszy,
                                    const double *fpsxz,
                                    double *signxx,
                                    double *signyy,
                                    double *signzz,
                                    double *signxy,
                                    double *signyz,
                                    double *signzx,
                                    double *sigvxx,
                                    double *sigvyy,
                                    double *sigvzz,
                                    double *sigvxy,
                                    double *sigvyz,
                                    double *sigvzx,
                                    double *soundsp,
                                    double *viscmax,
                                    double *uvar,
                                    double *off,
                                    const double *nodes,
                                    char *message,
                                    size_t capacity);

/*
 As `toron_openradioss_lecm_f64`, in single precision.
 */
int32_t toron_openradioss_lecm_f32(int32_t number,
                                   const float *values,
                                   size_t count,
                                   float *uparam,
                                   int32_t maxuparam,
                                   int32_t *nuparam,
                                   int32_t *nuvar,
                                   float *parmat,
                                   char *message,
                                   size_t capacity);

/*
 As `toron_openradioss_listing_f64`, in single precision.
 */
int32_t toron_openradioss_listing_f32(const float *uparam, int32_t nuparam, int32_t line, char *text, size_t capacity);

/*
 As `toron_openradioss_luser_f64`, in single precision.
 */
int32_t toron_openradioss_luser_f32(int32_t nel,
                                    int32_t nuparam,
                                    int32_t nuvar,
                                    float time,
                                    const float *uparam,
                                    const int32_t *ngl,
                                    const float *rho0,
                                    const float *fpsxx,
                                    const float *fpsyy,
                                    const float *fpszz,
                                    const float *fpsxy,
                                    const float *fpsyz,
                                    const float *fpszx,
                                    const float *fpsyx,
                                    const float *fpszy,
                                    const float *fpsxz,
                                    float *signxx,
                                    float *signyy,
                                    float *signzz,
                                    float *signxy,
                                    float *signyz,
                                    float *signzx,
                                    float *sigvxx,
                                    float *sigvyy,
                                    float *sigvzz,
                                    float *sigvxy,
                                    float *sigvyz,
                                    float *sigvzx,
                                    float *soundsp,
                                    float *viscmax,
                                    float *uvar,
                                    float *off,
                                    const float *nodes,
                                    char *message,
                                    size_t capacity);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* TORON_H */
