! toron: the interface of toron.h for Fortran 2018. Generated from that header: do not edit.
!
! The header says what every function does and returns, and what the members of the structures are. In Fortran
! - a variable of a structure's type has its size set, and everything else is left out: set what is wanted, arrays by
!   c_loc, which needs their attribute target. Procedures of your own with such a structure among their arguments must
!   declare it a target too: a compiler may else not see that the arrays change;
! - names without _f64 and _f32 stand for both precisions: toron_hyperelastic_point(law, point);
! - texts are character strings. The last argument of every function that can fail may be left out; it is
!       character(toron_message_capacity) :: message
!   blank if there is no error, and cut off if the text is longer;
! - the number of values in an array, and the size of a structure, are not passed;
! - indices and points count from 0, as in C;
! - status codes are toron_status_..., and TORON_ABI_VERSION is toron_module_abi_version: in C, some names of constants
!   differ from those of functions by case alone.
!
! Every function returns a status code, 0 or negative; those that look up a count or an index return that, or a negative
! code.
module toron
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_f_pointer, c_float, c_int, c_int32_t, c_int64_t, &
    c_null_char, c_null_ptr, c_ptr, c_size_t, c_sizeof
  implicit none
  private :: room, end_message

  integer(c_int32_t), parameter :: toron_status_ok = 0
  integer(c_int32_t), parameter :: toron_status_null_argument = -101
  integer(c_int32_t), parameter :: toron_status_bad_count = -102
  integer(c_int32_t), parameter :: toron_status_bad_leading_dimension = -103
  integer(c_int32_t), parameter :: toron_status_unknown_name = -104
  integer(c_int32_t), parameter :: toron_status_bad_argument = -105
  integer(c_int32_t), parameter :: toron_status_no_deformation_gradient = -106
  integer(c_int32_t), parameter :: toron_status_not_prepared = -107
  integer(c_int32_t), parameter :: toron_status_bad_size = -108
  integer(c_int32_t), parameter :: toron_status_unknown_field = -109
  integer(c_int32_t), parameter :: toron_status_property_count = -201
  integer(c_int32_t), parameter :: toron_status_property_not_finite = -202
  integer(c_int32_t), parameter :: toron_status_property_out_of_bounds = -203
  integer(c_int32_t), parameter :: toron_status_property_direction = -204
  integer(c_int32_t), parameter :: toron_status_fibre_out_of_plane = -205
  integer(c_int32_t), parameter :: toron_status_state_count = -211
  integer(c_int32_t), parameter :: toron_status_inverted = -301
  integer(c_int32_t), parameter :: toron_status_not_finite = -302
  integer(c_int32_t), parameter :: toron_status_overflow = -303
  integer(c_int32_t), parameter :: toron_status_state_not_finite = -304
  integer(c_int32_t), parameter :: toron_status_fibre_direction = -305
  integer(c_int32_t), parameter :: toron_status_increment_too_large = -306
  integer(c_int32_t), parameter :: toron_status_material_axes = -307
  integer(c_int32_t), parameter :: toron_status_limit = -308
  integer(c_int32_t), parameter :: toron_status_law = -309
  integer(c_int32_t), parameter :: toron_status_smaller_step = -310
  integer(c_int32_t), parameter :: toron_module_abi_version = 2
  integer(c_int32_t), parameter :: toron_hyperelastic = 0
  integer(c_int32_t), parameter :: toron_linear_elastic = 1
  integer(c_int32_t), parameter :: toron_frictional = 2
  integer(c_int32_t), parameter :: toron_hyperelastic_properties = 11
  integer(c_int32_t), parameter :: toron_hyperelastic_state = 11
  integer(c_int32_t), parameter :: toron_linear_elastic_properties = 10
  integer(c_int32_t), parameter :: toron_linear_elastic_state = 10
  integer(c_int32_t), parameter :: toron_frictional_properties = 13
  integer(c_int32_t), parameter :: toron_frictional_state = 15
  integer(c_int32_t), parameter :: toron_rotation_fibre = 0
  integer(c_int32_t), parameter :: toron_rotation_polar = 1
  integer(c_int32_t), parameter :: toron_rotation_spin = 2
  integer(c_int32_t), parameter :: toron_criterion_principal = 0
  integer(c_int32_t), parameter :: toron_criterion_fibre = 1
  integer(c_int32_t), parameter :: toron_tangent_material = 0
  integer(c_int32_t), parameter :: toron_tangent_truesdell = 1
  integer(c_int32_t), parameter :: toron_tangent_jaumann = 2
  integer(c_int32_t), parameter :: toron_tangent_nominal = 3
  integer(c_int32_t), parameter :: toron_level_best = 0
  integer(c_int32_t), parameter :: toron_level_baseline = 1
  integer(c_int32_t), parameter :: toron_level_avx2 = 2
  integer(c_int32_t), parameter :: toron_level_avx512 = 3
  integer(c_int32_t), parameter :: toron_message_capacity = 512

  type, bind(c) :: toron_table_row
    integer(c_size_t) :: size = 304
    character(kind=c_char) :: name(24) = c_null_char
    character(kind=c_char) :: symbol(24) = c_null_char
    character(kind=c_char) :: unit(24) = c_null_char
    integer(c_int32_t) :: mass = 0
    integer(c_int32_t) :: length = 0
    integer(c_int32_t) :: time = 0
    integer(c_int32_t) :: has_default = 0
    real(c_double) :: default_value = 0
    real(c_double) :: minimum = 0
    real(c_double) :: maximum = 0
    integer(c_int32_t) :: minimum_excluded = 0
    character(kind=c_char) :: allowed(80) = c_null_char
    character(kind=c_char) :: meaning(100) = c_null_char
  end type

  type, bind(c) :: toron_hyperelastic_f64
    integer(c_int64_t) :: tag = 0
    integer(c_int64_t) :: size = 0
    real(c_double) :: values(62) = 0
  end type

  type, bind(c) :: toron_hyperelastic_f32
    integer(c_int64_t) :: tag = 0
    integer(c_int64_t) :: size = 0
    real(c_float) :: values(62) = 0
  end type

  type, bind(c) :: toron_point_f64
    integer(c_size_t) :: size = 96
    integer(c_int32_t) :: measure = 0
    integer(c_int32_t) :: level = 0
    real(c_double) :: density = 0
    type(c_ptr) :: deformation_gradient = c_null_ptr
    type(c_ptr) :: fibre = c_null_ptr
    type(c_ptr) :: state_old = c_null_ptr
    type(c_ptr) :: state_new = c_null_ptr
    type(c_ptr) :: stress = c_null_ptr
    type(c_ptr) :: modes = c_null_ptr
    type(c_ptr) :: wave_speed = c_null_ptr
    type(c_ptr) :: tangent = c_null_ptr
    type(c_ptr) :: limit = c_null_ptr
  end type

  type, bind(c) :: toron_point_f32
    integer(c_size_t) :: size = 96
    integer(c_int32_t) :: measure = 0
    integer(c_int32_t) :: level = 0
    real(c_double) :: density = 0
    type(c_ptr) :: deformation_gradient = c_null_ptr
    type(c_ptr) :: fibre = c_null_ptr
    type(c_ptr) :: state_old = c_null_ptr
    type(c_ptr) :: state_new = c_null_ptr
    type(c_ptr) :: stress = c_null_ptr
    type(c_ptr) :: modes = c_null_ptr
    type(c_ptr) :: wave_speed = c_null_ptr
    type(c_ptr) :: tangent = c_null_ptr
    type(c_ptr) :: limit = c_null_ptr
  end type

  type, bind(c) :: toron_layout
    integer(c_size_t) :: leading_dimension = 0
    integer(c_size_t) :: stride = 0
  end type

  type, bind(c) :: toron_block_f64
    integer(c_size_t) :: size = 392
    integer(c_size_t) :: n = 0
    integer(c_size_t) :: leading_dimension = 0
    integer(c_int32_t) :: measure = 0
    integer(c_int32_t) :: level = 0
    real(c_double) :: density = 0
    type(c_ptr) :: deformation_gradient(9) = c_null_ptr
    type(c_ptr) :: fibre(3) = c_null_ptr
    type(c_ptr) :: energies_old = c_null_ptr
    type(c_ptr) :: invariants_old = c_null_ptr
    type(c_ptr) :: failure_old = c_null_ptr
    type(c_ptr) :: stress(6) = c_null_ptr
    type(c_ptr) :: energies = c_null_ptr
    type(c_ptr) :: invariants = c_null_ptr
    type(c_ptr) :: failure = c_null_ptr
    type(c_ptr) :: modes = c_null_ptr
    type(c_ptr) :: tangent = c_null_ptr
    type(c_ptr) :: wave_speed = c_null_ptr
    type(c_ptr) :: active = c_null_ptr
    type(c_ptr) :: status = c_null_ptr
    type(toron_layout) :: deformation_gradient_layout
    type(toron_layout) :: fibre_layout
    type(toron_layout) :: state_layout
    type(toron_layout) :: stress_layout
    type(toron_layout) :: modes_layout
    type(toron_layout) :: tangent_layout
    type(c_ptr) :: limit = c_null_ptr
    type(toron_layout) :: limit_layout
  end type

  type, bind(c) :: toron_block_f32
    integer(c_size_t) :: size = 392
    integer(c_size_t) :: n = 0
    integer(c_size_t) :: leading_dimension = 0
    integer(c_int32_t) :: measure = 0
    integer(c_int32_t) :: level = 0
    real(c_double) :: density = 0
    type(c_ptr) :: deformation_gradient(9) = c_null_ptr
    type(c_ptr) :: fibre(3) = c_null_ptr
    type(c_ptr) :: energies_old = c_null_ptr
    type(c_ptr) :: invariants_old = c_null_ptr
    type(c_ptr) :: failure_old = c_null_ptr
    type(c_ptr) :: stress(6) = c_null_ptr
    type(c_ptr) :: energies = c_null_ptr
    type(c_ptr) :: invariants = c_null_ptr
    type(c_ptr) :: failure = c_null_ptr
    type(c_ptr) :: modes = c_null_ptr
    type(c_ptr) :: tangent = c_null_ptr
    type(c_ptr) :: wave_speed = c_null_ptr
    type(c_ptr) :: active = c_null_ptr
    type(c_ptr) :: status = c_null_ptr
    type(toron_layout) :: deformation_gradient_layout
    type(toron_layout) :: fibre_layout
    type(toron_layout) :: state_layout
    type(toron_layout) :: stress_layout
    type(toron_layout) :: modes_layout
    type(toron_layout) :: tangent_layout
    type(c_ptr) :: limit = c_null_ptr
    type(toron_layout) :: limit_layout
  end type

  type, bind(c) :: toron_frictional_f64
    integer(c_int64_t) :: tag = 0
    integer(c_int64_t) :: size = 0
    real(c_double) :: values(62) = 0
  end type

  type, bind(c) :: toron_frictional_f32
    integer(c_int64_t) :: tag = 0
    integer(c_int64_t) :: size = 0
    real(c_float) :: values(62) = 0
  end type

  type, bind(c) :: toron_linear_elastic_f64
    integer(c_int64_t) :: tag = 0
    integer(c_int64_t) :: size = 0
    real(c_double) :: values(30) = 0
  end type

  type, bind(c) :: toron_linear_elastic_f32
    integer(c_int64_t) :: tag = 0
    integer(c_int64_t) :: size = 0
    real(c_float) :: values(30) = 0
  end type

  type, bind(c) :: toron_linear_point_f64
    integer(c_size_t) :: size = 120
    integer(c_int32_t) :: rotation = 0
    integer(c_int32_t) :: criterion = 0
    integer(c_int32_t) :: measure = 0
    integer(c_int32_t) :: level = 0
    real(c_double) :: density = 0
    type(c_ptr) :: f_old = c_null_ptr
    type(c_ptr) :: f_new = c_null_ptr
    type(c_ptr) :: fibre = c_null_ptr
    type(c_ptr) :: second_axis = c_null_ptr
    type(c_ptr) :: axes = c_null_ptr
    type(c_ptr) :: state_old = c_null_ptr
    type(c_ptr) :: state_new = c_null_ptr
    type(c_ptr) :: stress = c_null_ptr
    type(c_ptr) :: wave_speed = c_null_ptr
    type(c_ptr) :: tangent = c_null_ptr
    type(c_ptr) :: limit = c_null_ptr
  end type

  type, bind(c) :: toron_linear_point_f32
    integer(c_size_t) :: size = 120
    integer(c_int32_t) :: rotation = 0
    integer(c_int32_t) :: criterion = 0
    integer(c_int32_t) :: measure = 0
    integer(c_int32_t) :: level = 0
    real(c_double) :: density = 0
    type(c_ptr) :: f_old = c_null_ptr
    type(c_ptr) :: f_new = c_null_ptr
    type(c_ptr) :: fibre = c_null_ptr
    type(c_ptr) :: second_axis = c_null_ptr
    type(c_ptr) :: axes = c_null_ptr
    type(c_ptr) :: state_old = c_null_ptr
    type(c_ptr) :: state_new = c_null_ptr
    type(c_ptr) :: stress = c_null_ptr
    type(c_ptr) :: wave_speed = c_null_ptr
    type(c_ptr) :: tangent = c_null_ptr
    type(c_ptr) :: limit = c_null_ptr
  end type

  type, bind(c) :: toron_linear_increment_f64
    integer(c_size_t) :: size = 56
    integer(c_int32_t) :: criterion = 0
    integer(c_int32_t) :: reserved = 0
    real(c_double) :: jacobian = 0
    type(c_ptr) :: strain = c_null_ptr
    type(c_ptr) :: state_old = c_null_ptr
    type(c_ptr) :: state_new = c_null_ptr
    type(c_ptr) :: stress = c_null_ptr
  end type

  type, bind(c) :: toron_linear_increment_f32
    integer(c_size_t) :: size = 56
    integer(c_int32_t) :: criterion = 0
    integer(c_int32_t) :: reserved = 0
    real(c_double) :: jacobian = 0
    type(c_ptr) :: strain = c_null_ptr
    type(c_ptr) :: state_old = c_null_ptr
    type(c_ptr) :: state_new = c_null_ptr
    type(c_ptr) :: stress = c_null_ptr
  end type

  type, bind(c) :: toron_linear_block_f64
    integer(c_size_t) :: size = 464
    integer(c_size_t) :: n = 0
    integer(c_size_t) :: leading_dimension = 0
    integer(c_int32_t) :: rotation = 0
    integer(c_int32_t) :: criterion = 0
    integer(c_int32_t) :: measure = 0
    integer(c_int32_t) :: level = 0
    real(c_double) :: density = 0
    type(c_ptr) :: f_old(9) = c_null_ptr
    type(c_ptr) :: f_new(9) = c_null_ptr
    type(c_ptr) :: fibre(3) = c_null_ptr
    type(c_ptr) :: second_axis(3) = c_null_ptr
    type(c_ptr) :: axes = c_null_ptr
    type(c_ptr) :: state_old = c_null_ptr
    type(c_ptr) :: state_new = c_null_ptr
    type(c_ptr) :: stress(6) = c_null_ptr
    type(c_ptr) :: tangent = c_null_ptr
    type(c_ptr) :: wave_speed = c_null_ptr
    type(c_ptr) :: active = c_null_ptr
    type(c_ptr) :: status = c_null_ptr
    type(toron_layout) :: deformation_gradient_layout
    type(toron_layout) :: fibre_layout
    type(toron_layout) :: axes_layout
    type(toron_layout) :: state_layout
    type(toron_layout) :: stress_layout
    type(toron_layout) :: tangent_layout
    type(c_ptr) :: limit = c_null_ptr
    type(toron_layout) :: limit_layout
  end type

  type, bind(c) :: toron_linear_block_f32
    integer(c_size_t) :: size = 464
    integer(c_size_t) :: n = 0
    integer(c_size_t) :: leading_dimension = 0
    integer(c_int32_t) :: rotation = 0
    integer(c_int32_t) :: criterion = 0
    integer(c_int32_t) :: measure = 0
    integer(c_int32_t) :: level = 0
    real(c_double) :: density = 0
    type(c_ptr) :: f_old(9) = c_null_ptr
    type(c_ptr) :: f_new(9) = c_null_ptr
    type(c_ptr) :: fibre(3) = c_null_ptr
    type(c_ptr) :: second_axis(3) = c_null_ptr
    type(c_ptr) :: axes = c_null_ptr
    type(c_ptr) :: state_old = c_null_ptr
    type(c_ptr) :: state_new = c_null_ptr
    type(c_ptr) :: stress(6) = c_null_ptr
    type(c_ptr) :: tangent = c_null_ptr
    type(c_ptr) :: wave_speed = c_null_ptr
    type(c_ptr) :: active = c_null_ptr
    type(c_ptr) :: status = c_null_ptr
    type(toron_layout) :: deformation_gradient_layout
    type(toron_layout) :: fibre_layout
    type(toron_layout) :: axes_layout
    type(toron_layout) :: state_layout
    type(toron_layout) :: stress_layout
    type(toron_layout) :: tangent_layout
    type(c_ptr) :: limit = c_null_ptr
    type(toron_layout) :: limit_layout
  end type

  type, bind(c) :: toron_vumat_f64
    integer(c_size_t) :: size = 152
    integer(c_int32_t) :: nblock = 0
    integer(c_int32_t) :: ndir = 0
    integer(c_int32_t) :: nshr = 0
    integer(c_int32_t) :: nstatev = 0
    integer(c_int32_t) :: nprops = 0
    integer(c_int32_t) :: level = 0
    real(c_double) :: step_time = 0
    real(c_double) :: total_time = 0
    type(c_ptr) :: props = c_null_ptr
    type(c_ptr) :: density = c_null_ptr
    type(c_ptr) :: strain_inc = c_null_ptr
    type(c_ptr) :: stretch_old = c_null_ptr
    type(c_ptr) :: stretch_new = c_null_ptr
    type(c_ptr) :: stress_old = c_null_ptr
    type(c_ptr) :: state_old = c_null_ptr
    type(c_ptr) :: ener_intern_old = c_null_ptr
    type(c_ptr) :: ener_inelas_old = c_null_ptr
    type(c_ptr) :: stress_new = c_null_ptr
    type(c_ptr) :: state_new = c_null_ptr
    type(c_ptr) :: ener_intern_new = c_null_ptr
    type(c_ptr) :: ener_inelas_new = c_null_ptr
  end type

  type, bind(c) :: toron_vumat_f32
    integer(c_size_t) :: size = 152
    integer(c_int32_t) :: nblock = 0
    integer(c_int32_t) :: ndir = 0
    integer(c_int32_t) :: nshr = 0
    integer(c_int32_t) :: nstatev = 0
    integer(c_int32_t) :: nprops = 0
    integer(c_int32_t) :: level = 0
    real(c_double) :: step_time = 0
    real(c_double) :: total_time = 0
    type(c_ptr) :: props = c_null_ptr
    type(c_ptr) :: density = c_null_ptr
    type(c_ptr) :: strain_inc = c_null_ptr
    type(c_ptr) :: stretch_old = c_null_ptr
    type(c_ptr) :: stretch_new = c_null_ptr
    type(c_ptr) :: stress_old = c_null_ptr
    type(c_ptr) :: state_old = c_null_ptr
    type(c_ptr) :: ener_intern_old = c_null_ptr
    type(c_ptr) :: ener_inelas_old = c_null_ptr
    type(c_ptr) :: stress_new = c_null_ptr
    type(c_ptr) :: state_new = c_null_ptr
    type(c_ptr) :: ener_intern_new = c_null_ptr
    type(c_ptr) :: ener_inelas_new = c_null_ptr
  end type

  interface toron_preset
    procedure toron_preset_f64, toron_preset_f32
  end interface

  interface toron_hyperelastic_prepare
    procedure toron_hyperelastic_prepare_f64, toron_hyperelastic_prepare_f32
  end interface

  interface toron_hyperelastic_point
    procedure toron_hyperelastic_point_f64, toron_hyperelastic_point_f32
  end interface

  interface toron_hyperelastic_point_with_properties
    procedure toron_hyperelastic_point_with_properties_f64, toron_hyperelastic_point_with_properties_f32
  end interface

  interface toron_hyperelastic_block
    procedure toron_hyperelastic_block_f64, toron_hyperelastic_block_f32
  end interface

  interface toron_hyperelastic_block_with_properties
    procedure toron_hyperelastic_block_with_properties_f64, toron_hyperelastic_block_with_properties_f32
  end interface

  interface toron_hyperelastic_least_acoustic_eigenvalue
    procedure toron_hyperelastic_least_acoustic_eigenvalue_f64
  end interface

  interface toron_frictional_prepare
    procedure toron_frictional_prepare_f64, toron_frictional_prepare_f32
  end interface

  interface toron_frictional_point
    procedure toron_frictional_point_f64, toron_frictional_point_f32
  end interface

  interface toron_frictional_point_with_properties
    procedure toron_frictional_point_with_properties_f64, toron_frictional_point_with_properties_f32
  end interface

  interface toron_frictional_block
    procedure toron_frictional_block_f64, toron_frictional_block_f32
  end interface

  interface toron_frictional_block_with_properties
    procedure toron_frictional_block_with_properties_f64, toron_frictional_block_with_properties_f32
  end interface

  interface toron_linear_elastic_prepare
    procedure toron_linear_elastic_prepare_f64, toron_linear_elastic_prepare_f32
  end interface

  interface toron_linear_elastic_axes
    procedure toron_linear_elastic_axes_f64, toron_linear_elastic_axes_f32
  end interface

  interface toron_linear_elastic_point
    procedure toron_linear_elastic_point_f64, toron_linear_elastic_point_f32
  end interface

  interface toron_linear_elastic_point_with_properties
    procedure toron_linear_elastic_point_with_properties_f64, toron_linear_elastic_point_with_properties_f32
  end interface

  interface toron_linear_elastic_increment
    procedure toron_linear_elastic_increment_f64, toron_linear_elastic_increment_f32
  end interface

  interface toron_linear_elastic_block
    procedure toron_linear_elastic_block_f64, toron_linear_elastic_block_f32
  end interface

  interface toron_linear_elastic_block_with_properties
    procedure toron_linear_elastic_block_with_properties_f64, toron_linear_elastic_block_with_properties_f32
  end interface

  interface toron_abaqus_umat_tangent
    procedure toron_abaqus_umat_tangent_f64
  end interface

  interface toron_abaqus_umat
    procedure toron_abaqus_umat_f64
  end interface

  interface toron_abaqus_linear_umat
    procedure toron_abaqus_linear_umat_f64
  end interface

  interface toron_abaqus_frictional_umat
    procedure toron_abaqus_frictional_umat_f64
  end interface

  interface toron_abaqus_vumat
    procedure toron_abaqus_vumat_f64, toron_abaqus_vumat_f32
  end interface

  interface toron_abaqus_linear_vumat
    procedure toron_abaqus_linear_vumat_f64, toron_abaqus_linear_vumat_f32
  end interface

  interface toron_abaqus_frictional_vumat
    procedure toron_abaqus_frictional_vumat_f64, toron_abaqus_frictional_vumat_f32
  end interface

  interface toron_lsdyna_umat
    procedure toron_lsdyna_umat_f64, toron_lsdyna_umat_f32
  end interface

  interface toron_lsdyna_umat_vector
    procedure toron_lsdyna_umat_vector_f64, toron_lsdyna_umat_vector_f32
  end interface

  interface toron_lsdyna_utan
    procedure toron_lsdyna_utan_f64, toron_lsdyna_utan_f32
  end interface

  interface toron_lsdyna_utan_vector
    procedure toron_lsdyna_utan_vector_f64, toron_lsdyna_utan_vector_f32
  end interface

  interface toron_lsdyna_bulk_and_shear
    procedure toron_lsdyna_bulk_and_shear_f64
  end interface

  interface toron_lsdyna_linear_umat
    procedure toron_lsdyna_linear_umat_f64, toron_lsdyna_linear_umat_f32
  end interface

  interface toron_lsdyna_linear_umat_vector
    procedure toron_lsdyna_linear_umat_vector_f64, toron_lsdyna_linear_umat_vector_f32
  end interface

  interface toron_lsdyna_linear_utan
    procedure toron_lsdyna_linear_utan_f64, toron_lsdyna_linear_utan_f32
  end interface

  interface toron_lsdyna_linear_utan_vector
    procedure toron_lsdyna_linear_utan_vector_f64, toron_lsdyna_linear_utan_vector_f32
  end interface

  interface toron_lsdyna_linear_bulk_and_shear
    procedure toron_lsdyna_linear_bulk_and_shear_f64
  end interface

  interface toron_lsdyna_frictional_umat
    procedure toron_lsdyna_frictional_umat_f64, toron_lsdyna_frictional_umat_f32
  end interface

  interface toron_lsdyna_frictional_umat_vector
    procedure toron_lsdyna_frictional_umat_vector_f64, toron_lsdyna_frictional_umat_vector_f32
  end interface

  interface toron_lsdyna_frictional_utan
    procedure toron_lsdyna_frictional_utan_f64, toron_lsdyna_frictional_utan_f32
  end interface

  interface toron_lsdyna_frictional_utan_vector
    procedure toron_lsdyna_frictional_utan_vector_f64, toron_lsdyna_frictional_utan_vector_f32
  end interface

  interface toron_lsdyna_frictional_bulk_and_shear
    procedure toron_lsdyna_frictional_bulk_and_shear_f64
  end interface

  interface toron_openradioss_lecm
    procedure toron_openradioss_lecm_f64, toron_openradioss_lecm_f32
  end interface

  interface toron_openradioss_listing
    procedure toron_openradioss_listing_f64, toron_openradioss_listing_f32
  end interface

  interface toron_openradioss_luser
    procedure toron_openradioss_luser_f64, toron_openradioss_luser_f32
  end interface

contains

  function toron_abi_version() result(status)
    integer(c_int32_t) :: status
    interface
      function c_abi_version() bind(c, name='toron_abi_version') result(status)
        import
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_abi_version()
  end function

  function toron_property_count(law, message) result(status)
    integer(c_int32_t), intent(in) :: law
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_property_count(law, message, capacity) bind(c, name='toron_property_count') result(status)
        import
        integer(c_int32_t), value :: law
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_property_count(law, message, room(message))
    call end_message(status, message)
  end function

  function toron_property(law, index, row, message) result(status)
    integer(c_int32_t), intent(in) :: law, index
    type(toron_table_row), intent(out) :: row
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_property(law, index, row, message, capacity) bind(c, name='toron_property') result(status)
        import
        integer(c_int32_t), value :: law, index
        type(toron_table_row), intent(inout) :: row
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_property(law, index, row, message, room(message))
    call end_message(status, message)
  end function

  function toron_property_index(law, property, message) result(status)
    integer(c_int32_t), intent(in) :: law
    character(*), intent(in) :: property
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_property_index(law, property, message, &
        capacity) bind(c, name='toron_property_index') result(status)
        import
        integer(c_int32_t), value :: law
        character(kind=c_char), intent(in) :: property(*)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_property_index(law, trim(property) // c_null_char, message, room(message))
    call end_message(status, message)
  end function

  function toron_state_count(law, message) result(status)
    integer(c_int32_t), intent(in) :: law
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_state_count(law, message, capacity) bind(c, name='toron_state_count') result(status)
        import
        integer(c_int32_t), value :: law
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_state_count(law, message, room(message))
    call end_message(status, message)
  end function

  function toron_state_variable(law, index, row, message) result(status)
    integer(c_int32_t), intent(in) :: law, index
    type(toron_table_row), intent(out) :: row
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_state_variable(law, index, row, message, &
        capacity) bind(c, name='toron_state_variable') result(status)
        import
        integer(c_int32_t), value :: law, index
        type(toron_table_row), intent(inout) :: row
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_state_variable(law, index, row, message, room(message))
    call end_message(status, message)
  end function

  function toron_state_index(law, variable, message) result(status)
    integer(c_int32_t), intent(in) :: law
    character(*), intent(in) :: variable
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_state_index(law, variable, message, capacity) bind(c, name='toron_state_index') result(status)
        import
        integer(c_int32_t), value :: law
        character(kind=c_char), intent(in) :: variable(*)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_state_index(law, trim(variable) // c_null_char, message, room(message))
    call end_message(status, message)
  end function

  function toron_preset_f64(preset, units, properties, density, message) result(status)
    character(*), intent(in) :: preset, units
    real(c_double), intent(out), contiguous :: properties(:)
    real(c_double), intent(out), optional :: density
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_preset_f64(preset, units, properties, count, density, message, &
        capacity) bind(c, name='toron_preset_f64') result(status)
        import
        character(kind=c_char), intent(in) :: preset(*), units(*)
        real(c_double), intent(inout) :: properties(*)
        integer(c_size_t), value :: count
        real(c_double), intent(inout), optional :: density
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_preset_f64(trim(preset) // c_null_char, trim(units) // c_null_char, properties, &
      size(properties, kind=c_size_t), density, message, room(message))
    call end_message(status, message)
  end function

  function toron_preset_f32(preset, units, properties, density, message) result(status)
    character(*), intent(in) :: preset, units
    real(c_float), intent(out), contiguous :: properties(:)
    real(c_float), intent(out), optional :: density
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_preset_f32(preset, units, properties, count, density, message, &
        capacity) bind(c, name='toron_preset_f32') result(status)
        import
        character(kind=c_char), intent(in) :: preset(*), units(*)
        real(c_float), intent(inout) :: properties(*)
        integer(c_size_t), value :: count
        real(c_float), intent(inout), optional :: density
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_preset_f32(trim(preset) // c_null_char, trim(units) // c_null_char, properties, &
      size(properties, kind=c_size_t), density, message, room(message))
    call end_message(status, message)
  end function

  function toron_hyperelastic_prepare_f64(law, properties, message) result(status)
    type(toron_hyperelastic_f64), intent(out) :: law
    real(c_double), intent(in), contiguous :: properties(:)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_hyperelastic_prepare_f64(law, size, properties, count, message, &
        capacity) bind(c, name='toron_hyperelastic_prepare_f64') result(status)
        import
        type(toron_hyperelastic_f64), intent(inout) :: law
        integer(c_size_t), value :: size
        real(c_double), intent(in) :: properties(*)
        integer(c_size_t), value :: count
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_hyperelastic_prepare_f64(law, c_sizeof(law), properties, size(properties, kind=c_size_t), message, &
      room(message))
    call end_message(status, message)
  end function

  function toron_hyperelastic_prepare_f32(law, properties, message) result(status)
    type(toron_hyperelastic_f32), intent(out) :: law
    real(c_float), intent(in), contiguous :: properties(:)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_hyperelastic_prepare_f32(law, size, properties, count, message, &
        capacity) bind(c, name='toron_hyperelastic_prepare_f32') result(status)
        import
        type(toron_hyperelastic_f32), intent(inout) :: law
        integer(c_size_t), value :: size
        real(c_float), intent(in) :: properties(*)
        integer(c_size_t), value :: count
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_hyperelastic_prepare_f32(law, c_sizeof(law), properties, size(properties, kind=c_size_t), message, &
      room(message))
    call end_message(status, message)
  end function

  function toron_hyperelastic_point_f64(law, point, message) result(status)
    type(toron_hyperelastic_f64), intent(in) :: law
    type(toron_point_f64), target, intent(in) :: point
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_hyperelastic_point_f64(law, point, message, &
        capacity) bind(c, name='toron_hyperelastic_point_f64') result(status)
        import
        type(toron_hyperelastic_f64), intent(in) :: law
        type(toron_point_f64), target, intent(in) :: point
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_hyperelastic_point_f64(law, point, message, room(message))
    call end_message(status, message)
  end function

  function toron_hyperelastic_point_f32(law, point, message) result(status)
    type(toron_hyperelastic_f32), intent(in) :: law
    type(toron_point_f32), target, intent(in) :: point
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_hyperelastic_point_f32(law, point, message, &
        capacity) bind(c, name='toron_hyperelastic_point_f32') result(status)
        import
        type(toron_hyperelastic_f32), intent(in) :: law
        type(toron_point_f32), target, intent(in) :: point
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_hyperelastic_point_f32(law, point, message, room(message))
    call end_message(status, message)
  end function

  function toron_hyperelastic_point_with_properties_f64(properties, point, message) result(status)
    real(c_double), intent(in), contiguous :: properties(:)
    type(toron_point_f64), target, intent(in) :: point
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_hyperelastic_point_with_properties_f64(properties, count, point, message, &
        capacity) bind(c, name='toron_hyperelastic_point_with_properties_f64') result(status)
        import
        real(c_double), intent(in) :: properties(*)
        integer(c_size_t), value :: count
        type(toron_point_f64), target, intent(in) :: point
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_hyperelastic_point_with_properties_f64(properties, size(properties, kind=c_size_t), point, message, &
      room(message))
    call end_message(status, message)
  end function

  function toron_hyperelastic_point_with_properties_f32(properties, point, message) result(status)
    real(c_float), intent(in), contiguous :: properties(:)
    type(toron_point_f32), target, intent(in) :: point
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_hyperelastic_point_with_properties_f32(properties, count, point, message, &
        capacity) bind(c, name='toron_hyperelastic_point_with_properties_f32') result(status)
        import
        real(c_float), intent(in) :: properties(*)
        integer(c_size_t), value :: count
        type(toron_point_f32), target, intent(in) :: point
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_hyperelastic_point_with_properties_f32(properties, size(properties, kind=c_size_t), point, message, &
      room(message))
    call end_message(status, message)
  end function

  function toron_hyperelastic_block_f64(law, block, message) result(status)
    type(toron_hyperelastic_f64), intent(in) :: law
    type(toron_block_f64), target, intent(in) :: block
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_hyperelastic_block_f64(law, block, message, &
        capacity) bind(c, name='toron_hyperelastic_block_f64') result(status)
        import
        type(toron_hyperelastic_f64), intent(in) :: law
        type(toron_block_f64), target, intent(in) :: block
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_hyperelastic_block_f64(law, block, message, room(message))
    call end_message(status, message)
  end function

  function toron_hyperelastic_block_f32(law, block, message) result(status)
    type(toron_hyperelastic_f32), intent(in) :: law
    type(toron_block_f32), target, intent(in) :: block
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_hyperelastic_block_f32(law, block, message, &
        capacity) bind(c, name='toron_hyperelastic_block_f32') result(status)
        import
        type(toron_hyperelastic_f32), intent(in) :: law
        type(toron_block_f32), target, intent(in) :: block
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_hyperelastic_block_f32(law, block, message, room(message))
    call end_message(status, message)
  end function

  function toron_hyperelastic_block_with_properties_f64(properties, block, message) result(status)
    real(c_double), intent(in), contiguous :: properties(:)
    type(toron_block_f64), target, intent(in) :: block
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_hyperelastic_block_with_properties_f64(properties, count, block, message, &
        capacity) bind(c, name='toron_hyperelastic_block_with_properties_f64') result(status)
        import
        real(c_double), intent(in) :: properties(*)
        integer(c_size_t), value :: count
        type(toron_block_f64), target, intent(in) :: block
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_hyperelastic_block_with_properties_f64(properties, size(properties, kind=c_size_t), block, message, &
      room(message))
    call end_message(status, message)
  end function

  function toron_hyperelastic_block_with_properties_f32(properties, block, message) result(status)
    real(c_float), intent(in), contiguous :: properties(:)
    type(toron_block_f32), target, intent(in) :: block
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_hyperelastic_block_with_properties_f32(properties, count, block, message, &
        capacity) bind(c, name='toron_hyperelastic_block_with_properties_f32') result(status)
        import
        real(c_float), intent(in) :: properties(*)
        integer(c_size_t), value :: count
        type(toron_block_f32), target, intent(in) :: block
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_hyperelastic_block_with_properties_f32(properties, size(properties, kind=c_size_t), block, message, &
      room(message))
    call end_message(status, message)
  end function

  function toron_hyperelastic_least_acoustic_eigenvalue_f64(law, point, least, direction, message) result(status)
    type(toron_hyperelastic_f64), intent(in) :: law
    type(toron_point_f64), target, intent(in) :: point
    real(c_double), intent(out) :: least
    real(c_double), intent(out), optional :: direction(3)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_hyperelastic_least_acoustic_eigenvalue_f64(law, point, least, direction, message, &
        capacity) bind(c, name='toron_hyperelastic_least_acoustic_eigenvalue_f64') result(status)
        import
        type(toron_hyperelastic_f64), intent(in) :: law
        type(toron_point_f64), target, intent(in) :: point
        real(c_double), intent(inout) :: least
        real(c_double), intent(inout), optional :: direction(3)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_hyperelastic_least_acoustic_eigenvalue_f64(law, point, least, direction, message, room(message))
    call end_message(status, message)
  end function

  function toron_frictional_prepare_f64(law, properties, message) result(status)
    type(toron_frictional_f64), intent(out) :: law
    real(c_double), intent(in), contiguous :: properties(:)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_frictional_prepare_f64(law, size, properties, count, message, &
        capacity) bind(c, name='toron_frictional_prepare_f64') result(status)
        import
        type(toron_frictional_f64), intent(inout) :: law
        integer(c_size_t), value :: size
        real(c_double), intent(in) :: properties(*)
        integer(c_size_t), value :: count
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_frictional_prepare_f64(law, c_sizeof(law), properties, size(properties, kind=c_size_t), message, &
      room(message))
    call end_message(status, message)
  end function

  function toron_frictional_prepare_f32(law, properties, message) result(status)
    type(toron_frictional_f32), intent(out) :: law
    real(c_float), intent(in), contiguous :: properties(:)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_frictional_prepare_f32(law, size, properties, count, message, &
        capacity) bind(c, name='toron_frictional_prepare_f32') result(status)
        import
        type(toron_frictional_f32), intent(inout) :: law
        integer(c_size_t), value :: size
        real(c_float), intent(in) :: properties(*)
        integer(c_size_t), value :: count
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_frictional_prepare_f32(law, c_sizeof(law), properties, size(properties, kind=c_size_t), message, &
      room(message))
    call end_message(status, message)
  end function

  function toron_frictional_point_f64(law, point, message) result(status)
    type(toron_frictional_f64), intent(in) :: law
    type(toron_point_f64), target, intent(in) :: point
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_frictional_point_f64(law, point, message, &
        capacity) bind(c, name='toron_frictional_point_f64') result(status)
        import
        type(toron_frictional_f64), intent(in) :: law
        type(toron_point_f64), target, intent(in) :: point
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_frictional_point_f64(law, point, message, room(message))
    call end_message(status, message)
  end function

  function toron_frictional_point_f32(law, point, message) result(status)
    type(toron_frictional_f32), intent(in) :: law
    type(toron_point_f32), target, intent(in) :: point
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_frictional_point_f32(law, point, message, &
        capacity) bind(c, name='toron_frictional_point_f32') result(status)
        import
        type(toron_frictional_f32), intent(in) :: law
        type(toron_point_f32), target, intent(in) :: point
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_frictional_point_f32(law, point, message, room(message))
    call end_message(status, message)
  end function

  function toron_frictional_point_with_properties_f64(properties, point, message) result(status)
    real(c_double), intent(in), contiguous :: properties(:)
    type(toron_point_f64), target, intent(in) :: point
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_frictional_point_with_properties_f64(properties, count, point, message, &
        capacity) bind(c, name='toron_frictional_point_with_properties_f64') result(status)
        import
        real(c_double), intent(in) :: properties(*)
        integer(c_size_t), value :: count
        type(toron_point_f64), target, intent(in) :: point
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_frictional_point_with_properties_f64(properties, size(properties, kind=c_size_t), point, message, &
      room(message))
    call end_message(status, message)
  end function

  function toron_frictional_point_with_properties_f32(properties, point, message) result(status)
    real(c_float), intent(in), contiguous :: properties(:)
    type(toron_point_f32), target, intent(in) :: point
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_frictional_point_with_properties_f32(properties, count, point, message, &
        capacity) bind(c, name='toron_frictional_point_with_properties_f32') result(status)
        import
        real(c_float), intent(in) :: properties(*)
        integer(c_size_t), value :: count
        type(toron_point_f32), target, intent(in) :: point
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_frictional_point_with_properties_f32(properties, size(properties, kind=c_size_t), point, message, &
      room(message))
    call end_message(status, message)
  end function

  function toron_frictional_block_f64(law, block, message) result(status)
    type(toron_frictional_f64), intent(in) :: law
    type(toron_block_f64), target, intent(in) :: block
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_frictional_block_f64(law, block, message, &
        capacity) bind(c, name='toron_frictional_block_f64') result(status)
        import
        type(toron_frictional_f64), intent(in) :: law
        type(toron_block_f64), target, intent(in) :: block
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_frictional_block_f64(law, block, message, room(message))
    call end_message(status, message)
  end function

  function toron_frictional_block_f32(law, block, message) result(status)
    type(toron_frictional_f32), intent(in) :: law
    type(toron_block_f32), target, intent(in) :: block
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_frictional_block_f32(law, block, message, &
        capacity) bind(c, name='toron_frictional_block_f32') result(status)
        import
        type(toron_frictional_f32), intent(in) :: law
        type(toron_block_f32), target, intent(in) :: block
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_frictional_block_f32(law, block, message, room(message))
    call end_message(status, message)
  end function

  function toron_frictional_block_with_properties_f64(properties, block, message) result(status)
    real(c_double), intent(in), contiguous :: properties(:)
    type(toron_block_f64), target, intent(in) :: block
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_frictional_block_with_properties_f64(properties, count, block, message, &
        capacity) bind(c, name='toron_frictional_block_with_properties_f64') result(status)
        import
        real(c_double), intent(in) :: properties(*)
        integer(c_size_t), value :: count
        type(toron_block_f64), target, intent(in) :: block
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_frictional_block_with_properties_f64(properties, size(properties, kind=c_size_t), block, message, &
      room(message))
    call end_message(status, message)
  end function

  function toron_frictional_block_with_properties_f32(properties, block, message) result(status)
    real(c_float), intent(in), contiguous :: properties(:)
    type(toron_block_f32), target, intent(in) :: block
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_frictional_block_with_properties_f32(properties, count, block, message, &
        capacity) bind(c, name='toron_frictional_block_with_properties_f32') result(status)
        import
        real(c_float), intent(in) :: properties(*)
        integer(c_size_t), value :: count
        type(toron_block_f32), target, intent(in) :: block
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_frictional_block_with_properties_f32(properties, size(properties, kind=c_size_t), block, message, &
      room(message))
    call end_message(status, message)
  end function

  function toron_linear_elastic_prepare_f64(law, properties, message) result(status)
    type(toron_linear_elastic_f64), intent(out) :: law
    real(c_double), intent(in), contiguous :: properties(:)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_linear_elastic_prepare_f64(law, size, properties, count, message, &
        capacity) bind(c, name='toron_linear_elastic_prepare_f64') result(status)
        import
        type(toron_linear_elastic_f64), intent(inout) :: law
        integer(c_size_t), value :: size
        real(c_double), intent(in) :: properties(*)
        integer(c_size_t), value :: count
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_linear_elastic_prepare_f64(law, c_sizeof(law), properties, size(properties, kind=c_size_t), message, &
      room(message))
    call end_message(status, message)
  end function

  function toron_linear_elastic_prepare_f32(law, properties, message) result(status)
    type(toron_linear_elastic_f32), intent(out) :: law
    real(c_float), intent(in), contiguous :: properties(:)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_linear_elastic_prepare_f32(law, size, properties, count, message, &
        capacity) bind(c, name='toron_linear_elastic_prepare_f32') result(status)
        import
        type(toron_linear_elastic_f32), intent(inout) :: law
        integer(c_size_t), value :: size
        real(c_float), intent(in) :: properties(*)
        integer(c_size_t), value :: count
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_linear_elastic_prepare_f32(law, c_sizeof(law), properties, size(properties, kind=c_size_t), message, &
      room(message))
    call end_message(status, message)
  end function

  function toron_linear_elastic_axes_f64(law, fibre, second_axis, axes, message) result(status)
    type(toron_linear_elastic_f64), intent(in) :: law
    real(c_double), intent(in), optional :: fibre(3), second_axis(3)
    real(c_double), intent(out) :: axes(9)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_linear_elastic_axes_f64(law, fibre, second_axis, axes, message, &
        capacity) bind(c, name='toron_linear_elastic_axes_f64') result(status)
        import
        type(toron_linear_elastic_f64), intent(in) :: law
        real(c_double), intent(in), optional :: fibre(3), second_axis(3)
        real(c_double), intent(inout) :: axes(9)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_linear_elastic_axes_f64(law, fibre, second_axis, axes, message, room(message))
    call end_message(status, message)
  end function

  function toron_linear_elastic_axes_f32(law, fibre, second_axis, axes, message) result(status)
    type(toron_linear_elastic_f32), intent(in) :: law
    real(c_float), intent(in), optional :: fibre(3), second_axis(3)
    real(c_float), intent(out) :: axes(9)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_linear_elastic_axes_f32(law, fibre, second_axis, axes, message, &
        capacity) bind(c, name='toron_linear_elastic_axes_f32') result(status)
        import
        type(toron_linear_elastic_f32), intent(in) :: law
        real(c_float), intent(in), optional :: fibre(3), second_axis(3)
        real(c_float), intent(inout) :: axes(9)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_linear_elastic_axes_f32(law, fibre, second_axis, axes, message, room(message))
    call end_message(status, message)
  end function

  function toron_linear_elastic_point_f64(law, point, message) result(status)
    type(toron_linear_elastic_f64), intent(in) :: law
    type(toron_linear_point_f64), target, intent(in) :: point
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_linear_elastic_point_f64(law, point, message, &
        capacity) bind(c, name='toron_linear_elastic_point_f64') result(status)
        import
        type(toron_linear_elastic_f64), intent(in) :: law
        type(toron_linear_point_f64), target, intent(in) :: point
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_linear_elastic_point_f64(law, point, message, room(message))
    call end_message(status, message)
  end function

  function toron_linear_elastic_point_f32(law, point, message) result(status)
    type(toron_linear_elastic_f32), intent(in) :: law
    type(toron_linear_point_f32), target, intent(in) :: point
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_linear_elastic_point_f32(law, point, message, &
        capacity) bind(c, name='toron_linear_elastic_point_f32') result(status)
        import
        type(toron_linear_elastic_f32), intent(in) :: law
        type(toron_linear_point_f32), target, intent(in) :: point
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_linear_elastic_point_f32(law, point, message, room(message))
    call end_message(status, message)
  end function

  function toron_linear_elastic_point_with_properties_f64(properties, point, message) result(status)
    real(c_double), intent(in), contiguous :: properties(:)
    type(toron_linear_point_f64), target, intent(in) :: point
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_linear_elastic_point_with_properties_f64(properties, count, point, message, &
        capacity) bind(c, name='toron_linear_elastic_point_with_properties_f64') result(status)
        import
        real(c_double), intent(in) :: properties(*)
        integer(c_size_t), value :: count
        type(toron_linear_point_f64), target, intent(in) :: point
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_linear_elastic_point_with_properties_f64(properties, size(properties, kind=c_size_t), point, &
      message, room(message))
    call end_message(status, message)
  end function

  function toron_linear_elastic_point_with_properties_f32(properties, point, message) result(status)
    real(c_float), intent(in), contiguous :: properties(:)
    type(toron_linear_point_f32), target, intent(in) :: point
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_linear_elastic_point_with_properties_f32(properties, count, point, message, &
        capacity) bind(c, name='toron_linear_elastic_point_with_properties_f32') result(status)
        import
        real(c_float), intent(in) :: properties(*)
        integer(c_size_t), value :: count
        type(toron_linear_point_f32), target, intent(in) :: point
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_linear_elastic_point_with_properties_f32(properties, size(properties, kind=c_size_t), point, &
      message, room(message))
    call end_message(status, message)
  end function

  function toron_linear_elastic_increment_f64(law, increment, message) result(status)
    type(toron_linear_elastic_f64), intent(in) :: law
    type(toron_linear_increment_f64), target, intent(in) :: increment
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_linear_elastic_increment_f64(law, increment, message, &
        capacity) bind(c, name='toron_linear_elastic_increment_f64') result(status)
        import
        type(toron_linear_elastic_f64), intent(in) :: law
        type(toron_linear_increment_f64), target, intent(in) :: increment
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_linear_elastic_increment_f64(law, increment, message, room(message))
    call end_message(status, message)
  end function

  function toron_linear_elastic_increment_f32(law, increment, message) result(status)
    type(toron_linear_elastic_f32), intent(in) :: law
    type(toron_linear_increment_f32), target, intent(in) :: increment
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_linear_elastic_increment_f32(law, increment, message, &
        capacity) bind(c, name='toron_linear_elastic_increment_f32') result(status)
        import
        type(toron_linear_elastic_f32), intent(in) :: law
        type(toron_linear_increment_f32), target, intent(in) :: increment
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_linear_elastic_increment_f32(law, increment, message, room(message))
    call end_message(status, message)
  end function

  function toron_linear_elastic_block_f64(law, block, message) result(status)
    type(toron_linear_elastic_f64), intent(in) :: law
    type(toron_linear_block_f64), target, intent(in) :: block
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_linear_elastic_block_f64(law, block, message, &
        capacity) bind(c, name='toron_linear_elastic_block_f64') result(status)
        import
        type(toron_linear_elastic_f64), intent(in) :: law
        type(toron_linear_block_f64), target, intent(in) :: block
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_linear_elastic_block_f64(law, block, message, room(message))
    call end_message(status, message)
  end function

  function toron_linear_elastic_block_f32(law, block, message) result(status)
    type(toron_linear_elastic_f32), intent(in) :: law
    type(toron_linear_block_f32), target, intent(in) :: block
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_linear_elastic_block_f32(law, block, message, &
        capacity) bind(c, name='toron_linear_elastic_block_f32') result(status)
        import
        type(toron_linear_elastic_f32), intent(in) :: law
        type(toron_linear_block_f32), target, intent(in) :: block
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_linear_elastic_block_f32(law, block, message, room(message))
    call end_message(status, message)
  end function

  function toron_linear_elastic_block_with_properties_f64(properties, block, message) result(status)
    real(c_double), intent(in), contiguous :: properties(:)
    type(toron_linear_block_f64), target, intent(in) :: block
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_linear_elastic_block_with_properties_f64(properties, count, block, message, &
        capacity) bind(c, name='toron_linear_elastic_block_with_properties_f64') result(status)
        import
        real(c_double), intent(in) :: properties(*)
        integer(c_size_t), value :: count
        type(toron_linear_block_f64), target, intent(in) :: block
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_linear_elastic_block_with_properties_f64(properties, size(properties, kind=c_size_t), block, &
      message, room(message))
    call end_message(status, message)
  end function

  function toron_linear_elastic_block_with_properties_f32(properties, block, message) result(status)
    real(c_float), intent(in), contiguous :: properties(:)
    type(toron_linear_block_f32), target, intent(in) :: block
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_linear_elastic_block_with_properties_f32(properties, count, block, message, &
        capacity) bind(c, name='toron_linear_elastic_block_with_properties_f32') result(status)
        import
        real(c_float), intent(in) :: properties(*)
        integer(c_size_t), value :: count
        type(toron_linear_block_f32), target, intent(in) :: block
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_linear_elastic_block_with_properties_f32(properties, size(properties, kind=c_size_t), block, &
      message, room(message))
    call end_message(status, message)
  end function

  function toron_abaqus_umat_tangent_f64(stress, statev, ddsdde, sse, pnewdt, dfgrd1, props, nprops, nstatv, ndi, &
    nshr, nlgeom, message) result(status)
    real(c_double), intent(inout) :: stress(*), statev(*)
    real(c_double), intent(inout), optional :: ddsdde(*)
    real(c_double), intent(inout) :: sse, pnewdt
    real(c_double), intent(in) :: dfgrd1(*), props(*)
    integer(c_int32_t), intent(in) :: nprops, nstatv, ndi, nshr, nlgeom
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_abaqus_umat_tangent_f64(stress, statev, ddsdde, sse, pnewdt, dfgrd1, props, nprops, nstatv, ndi, &
        nshr, nlgeom, message, capacity) bind(c, name='toron_abaqus_umat_tangent_f64') result(status)
        import
        real(c_double), intent(inout) :: stress(*), statev(*)
        real(c_double), intent(inout), optional :: ddsdde(*)
        real(c_double), intent(inout) :: sse, pnewdt
        real(c_double), intent(in) :: dfgrd1(*), props(*)
        integer(c_int32_t), value :: nprops, nstatv, ndi, nshr, nlgeom
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_abaqus_umat_tangent_f64(stress, statev, ddsdde, sse, pnewdt, dfgrd1, props, nprops, nstatv, ndi, &
      nshr, nlgeom, message, room(message))
    call end_message(status, message)
  end function

  function toron_abaqus_umat_f64(stress, statev, sse, pnewdt, dfgrd1, props, nprops, nstatv, ndi, nshr, nlgeom, &
    message) result(status)
    real(c_double), intent(inout) :: stress(*), statev(*), sse, pnewdt
    real(c_double), intent(in) :: dfgrd1(*), props(*)
    integer(c_int32_t), intent(in) :: nprops, nstatv, ndi, nshr, nlgeom
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_abaqus_umat_f64(stress, statev, sse, pnewdt, dfgrd1, props, nprops, nstatv, ndi, nshr, nlgeom, &
        message, capacity) bind(c, name='toron_abaqus_umat_f64') result(status)
        import
        real(c_double), intent(inout) :: stress(*), statev(*), sse, pnewdt
        real(c_double), intent(in) :: dfgrd1(*), props(*)
        integer(c_int32_t), value :: nprops, nstatv, ndi, nshr, nlgeom
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_abaqus_umat_f64(stress, statev, sse, pnewdt, dfgrd1, props, nprops, nstatv, ndi, nshr, nlgeom, &
      message, room(message))
    call end_message(status, message)
  end function

  function toron_abaqus_linear_umat_f64(stress, statev, ddsdde, sse, pnewdt, dfgrd0, dfgrd1, props, nprops, nstatv, &
    ndi, nshr, nlgeom, message) result(status)
    real(c_double), intent(inout) :: stress(*), statev(*)
    real(c_double), intent(inout), optional :: ddsdde(*)
    real(c_double), intent(inout) :: sse, pnewdt
    real(c_double), intent(in) :: dfgrd0(*), dfgrd1(*), props(*)
    integer(c_int32_t), intent(in) :: nprops, nstatv, ndi, nshr, nlgeom
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_abaqus_linear_umat_f64(stress, statev, ddsdde, sse, pnewdt, dfgrd0, dfgrd1, props, nprops, nstatv, &
        ndi, nshr, nlgeom, message, capacity) bind(c, name='toron_abaqus_linear_umat_f64') result(status)
        import
        real(c_double), intent(inout) :: stress(*), statev(*)
        real(c_double), intent(inout), optional :: ddsdde(*)
        real(c_double), intent(inout) :: sse, pnewdt
        real(c_double), intent(in) :: dfgrd0(*), dfgrd1(*), props(*)
        integer(c_int32_t), value :: nprops, nstatv, ndi, nshr, nlgeom
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_abaqus_linear_umat_f64(stress, statev, ddsdde, sse, pnewdt, dfgrd0, dfgrd1, props, nprops, nstatv, &
      ndi, nshr, nlgeom, message, room(message))
    call end_message(status, message)
  end function

  function toron_abaqus_frictional_umat_f64(stress, statev, ddsdde, sse, spd, pnewdt, dfgrd1, props, nprops, &
    nstatv, ndi, nshr, nlgeom, message) result(status)
    real(c_double), intent(inout) :: stress(*), statev(*)
    real(c_double), intent(inout), optional :: ddsdde(*)
    real(c_double), intent(inout) :: sse
    real(c_double), intent(inout), optional :: spd
    real(c_double), intent(inout) :: pnewdt
    real(c_double), intent(in) :: dfgrd1(*), props(*)
    integer(c_int32_t), intent(in) :: nprops, nstatv, ndi, nshr, nlgeom
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_abaqus_frictional_umat_f64(stress, statev, ddsdde, sse, spd, pnewdt, dfgrd1, props, nprops, &
        nstatv, ndi, nshr, nlgeom, message, &
        capacity) bind(c, name='toron_abaqus_frictional_umat_f64') result(status)
        import
        real(c_double), intent(inout) :: stress(*), statev(*)
        real(c_double), intent(inout), optional :: ddsdde(*)
        real(c_double), intent(inout) :: sse
        real(c_double), intent(inout), optional :: spd
        real(c_double), intent(inout) :: pnewdt
        real(c_double), intent(in) :: dfgrd1(*), props(*)
        integer(c_int32_t), value :: nprops, nstatv, ndi, nshr, nlgeom
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_abaqus_frictional_umat_f64(stress, statev, ddsdde, sse, spd, pnewdt, dfgrd1, props, nprops, nstatv, &
      ndi, nshr, nlgeom, message, room(message))
    call end_message(status, message)
  end function

  function toron_abaqus_vumat_f64(block, message) result(status)
    type(toron_vumat_f64), target, intent(in) :: block
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_abaqus_vumat_f64(block, message, capacity) bind(c, name='toron_abaqus_vumat_f64') result(status)
        import
        type(toron_vumat_f64), target, intent(in) :: block
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_abaqus_vumat_f64(block, message, room(message))
    call end_message(status, message)
  end function

  function toron_abaqus_vumat_f32(block, message) result(status)
    type(toron_vumat_f32), target, intent(in) :: block
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_abaqus_vumat_f32(block, message, capacity) bind(c, name='toron_abaqus_vumat_f32') result(status)
        import
        type(toron_vumat_f32), target, intent(in) :: block
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_abaqus_vumat_f32(block, message, room(message))
    call end_message(status, message)
  end function

  function toron_abaqus_linear_vumat_f64(block, message) result(status)
    type(toron_vumat_f64), target, intent(in) :: block
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_abaqus_linear_vumat_f64(block, message, &
        capacity) bind(c, name='toron_abaqus_linear_vumat_f64') result(status)
        import
        type(toron_vumat_f64), target, intent(in) :: block
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_abaqus_linear_vumat_f64(block, message, room(message))
    call end_message(status, message)
  end function

  function toron_abaqus_linear_vumat_f32(block, message) result(status)
    type(toron_vumat_f32), target, intent(in) :: block
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_abaqus_linear_vumat_f32(block, message, &
        capacity) bind(c, name='toron_abaqus_linear_vumat_f32') result(status)
        import
        type(toron_vumat_f32), target, intent(in) :: block
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_abaqus_linear_vumat_f32(block, message, room(message))
    call end_message(status, message)
  end function

  function toron_abaqus_frictional_vumat_f64(block, message) result(status)
    type(toron_vumat_f64), target, intent(in) :: block
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_abaqus_frictional_vumat_f64(block, message, &
        capacity) bind(c, name='toron_abaqus_frictional_vumat_f64') result(status)
        import
        type(toron_vumat_f64), target, intent(in) :: block
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_abaqus_frictional_vumat_f64(block, message, room(message))
    call end_message(status, message)
  end function

  function toron_abaqus_frictional_vumat_f32(block, message) result(status)
    type(toron_vumat_f32), target, intent(in) :: block
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_abaqus_frictional_vumat_f32(block, message, &
        capacity) bind(c, name='toron_abaqus_frictional_vumat_f32') result(status)
        import
        type(toron_vumat_f32), target, intent(in) :: block
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_abaqus_frictional_vumat_f32(block, message, room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_umat_f64(cm, sig, hsv, nhv, failel, message) result(status)
    real(c_double), intent(in) :: cm(*)
    real(c_double), intent(inout) :: sig(*), hsv(*)
    integer(c_int32_t), intent(in) :: nhv
    integer(c_int), intent(inout) :: failel
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_umat_f64(cm, sig, hsv, nhv, failel, message, &
        capacity) bind(c, name='toron_lsdyna_umat_f64') result(status)
        import
        real(c_double), intent(in) :: cm(*)
        real(c_double), intent(inout) :: sig(*), hsv(*)
        integer(c_int32_t), value :: nhv
        integer(c_int), intent(inout) :: failel
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_umat_f64(cm, sig, hsv, nhv, failel, message, room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_umat_f32(cm, sig, hsv, nhv, failel, message) result(status)
    real(c_float), intent(in) :: cm(*)
    real(c_float), intent(inout) :: sig(*), hsv(*)
    integer(c_int32_t), intent(in) :: nhv
    integer(c_int), intent(inout) :: failel
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_umat_f32(cm, sig, hsv, nhv, failel, message, &
        capacity) bind(c, name='toron_lsdyna_umat_f32') result(status)
        import
        real(c_float), intent(in) :: cm(*)
        real(c_float), intent(inout) :: sig(*), hsv(*)
        integer(c_int32_t), value :: nhv
        integer(c_int), intent(inout) :: failel
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_umat_f32(cm, sig, hsv, nhv, failel, message, room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_umat_vector_f64(cm, sig1, sig2, sig3, sig4, sig5, sig6, hsvs, nhv, lft, llt, nlq, failels, &
    message) result(status)
    real(c_double), intent(in) :: cm(*)
    real(c_double), intent(inout) :: sig1(*), sig2(*), sig3(*), sig4(*), sig5(*), sig6(*), hsvs(*)
    integer(c_int32_t), intent(in) :: nhv, lft, llt, nlq
    integer(c_int), intent(inout) :: failels(*)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_umat_vector_f64(cm, sig1, sig2, sig3, sig4, sig5, sig6, hsvs, nhv, lft, llt, nlq, failels, &
        message, capacity) bind(c, name='toron_lsdyna_umat_vector_f64') result(status)
        import
        real(c_double), intent(in) :: cm(*)
        real(c_double), intent(inout) :: sig1(*), sig2(*), sig3(*), sig4(*), sig5(*), sig6(*), hsvs(*)
        integer(c_int32_t), value :: nhv, lft, llt, nlq
        integer(c_int), intent(inout) :: failels(*)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_umat_vector_f64(cm, sig1, sig2, sig3, sig4, sig5, sig6, hsvs, nhv, lft, llt, nlq, failels, &
      message, room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_umat_vector_f32(cm, sig1, sig2, sig3, sig4, sig5, sig6, hsvs, nhv, lft, llt, nlq, failels, &
    message) result(status)
    real(c_float), intent(in) :: cm(*)
    real(c_float), intent(inout) :: sig1(*), sig2(*), sig3(*), sig4(*), sig5(*), sig6(*), hsvs(*)
    integer(c_int32_t), intent(in) :: nhv, lft, llt, nlq
    integer(c_int), intent(inout) :: failels(*)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_umat_vector_f32(cm, sig1, sig2, sig3, sig4, sig5, sig6, hsvs, nhv, lft, llt, nlq, failels, &
        message, capacity) bind(c, name='toron_lsdyna_umat_vector_f32') result(status)
        import
        real(c_float), intent(in) :: cm(*)
        real(c_float), intent(inout) :: sig1(*), sig2(*), sig3(*), sig4(*), sig5(*), sig6(*), hsvs(*)
        integer(c_int32_t), value :: nhv, lft, llt, nlq
        integer(c_int), intent(inout) :: failels(*)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_umat_vector_f32(cm, sig1, sig2, sig3, sig4, sig5, sig6, hsvs, nhv, lft, llt, nlq, failels, &
      message, room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_utan_f64(cm, hsv, nhv, es, message) result(status)
    real(c_double), intent(in) :: cm(*), hsv(*)
    integer(c_int32_t), intent(in) :: nhv
    real(c_double), intent(inout) :: es(*)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_utan_f64(cm, hsv, nhv, es, message, &
        capacity) bind(c, name='toron_lsdyna_utan_f64') result(status)
        import
        real(c_double), intent(in) :: cm(*), hsv(*)
        integer(c_int32_t), value :: nhv
        real(c_double), intent(inout) :: es(*)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_utan_f64(cm, hsv, nhv, es, message, room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_utan_f32(cm, hsv, nhv, es, message) result(status)
    real(c_float), intent(in) :: cm(*), hsv(*)
    integer(c_int32_t), intent(in) :: nhv
    real(c_float), intent(inout) :: es(*)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_utan_f32(cm, hsv, nhv, es, message, &
        capacity) bind(c, name='toron_lsdyna_utan_f32') result(status)
        import
        real(c_float), intent(in) :: cm(*), hsv(*)
        integer(c_int32_t), value :: nhv
        real(c_float), intent(inout) :: es(*)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_utan_f32(cm, hsv, nhv, es, message, room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_utan_vector_f64(cm, hsvs, nhv, lft, llt, nlq, dsave, message) result(status)
    real(c_double), intent(in) :: cm(*), hsvs(*)
    integer(c_int32_t), intent(in) :: nhv, lft, llt, nlq
    real(c_double), intent(inout) :: dsave(*)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_utan_vector_f64(cm, hsvs, nhv, lft, llt, nlq, dsave, message, &
        capacity) bind(c, name='toron_lsdyna_utan_vector_f64') result(status)
        import
        real(c_double), intent(in) :: cm(*), hsvs(*)
        integer(c_int32_t), value :: nhv, lft, llt, nlq
        real(c_double), intent(inout) :: dsave(*)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_utan_vector_f64(cm, hsvs, nhv, lft, llt, nlq, dsave, message, room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_utan_vector_f32(cm, hsvs, nhv, lft, llt, nlq, dsave, message) result(status)
    real(c_float), intent(in) :: cm(*), hsvs(*)
    integer(c_int32_t), intent(in) :: nhv, lft, llt, nlq
    real(c_float), intent(inout) :: dsave(*)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_utan_vector_f32(cm, hsvs, nhv, lft, llt, nlq, dsave, message, &
        capacity) bind(c, name='toron_lsdyna_utan_vector_f32') result(status)
        import
        real(c_float), intent(in) :: cm(*), hsvs(*)
        integer(c_int32_t), value :: nhv, lft, llt, nlq
        real(c_float), intent(inout) :: dsave(*)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_utan_vector_f32(cm, hsvs, nhv, lft, llt, nlq, dsave, message, room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_bulk_and_shear_f64(values, bulk, shear, message) result(status)
    real(c_double), intent(in), contiguous :: values(:)
    real(c_double), intent(inout) :: bulk, shear
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_bulk_and_shear_f64(values, count, bulk, shear, message, &
        capacity) bind(c, name='toron_lsdyna_bulk_and_shear_f64') result(status)
        import
        real(c_double), intent(in) :: values(*)
        integer(c_size_t), value :: count
        real(c_double), intent(inout) :: bulk, shear
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_bulk_and_shear_f64(values, size(values, kind=c_size_t), bulk, shear, message, room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_linear_umat_f64(cm, sig, hsv, nhv, failel, message) result(status)
    real(c_double), intent(in) :: cm(*)
    real(c_double), intent(inout) :: sig(*), hsv(*)
    integer(c_int32_t), intent(in) :: nhv
    integer(c_int), intent(inout) :: failel
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_linear_umat_f64(cm, sig, hsv, nhv, failel, message, &
        capacity) bind(c, name='toron_lsdyna_linear_umat_f64') result(status)
        import
        real(c_double), intent(in) :: cm(*)
        real(c_double), intent(inout) :: sig(*), hsv(*)
        integer(c_int32_t), value :: nhv
        integer(c_int), intent(inout) :: failel
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_linear_umat_f64(cm, sig, hsv, nhv, failel, message, room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_linear_umat_f32(cm, sig, hsv, nhv, failel, message) result(status)
    real(c_float), intent(in) :: cm(*)
    real(c_float), intent(inout) :: sig(*), hsv(*)
    integer(c_int32_t), intent(in) :: nhv
    integer(c_int), intent(inout) :: failel
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_linear_umat_f32(cm, sig, hsv, nhv, failel, message, &
        capacity) bind(c, name='toron_lsdyna_linear_umat_f32') result(status)
        import
        real(c_float), intent(in) :: cm(*)
        real(c_float), intent(inout) :: sig(*), hsv(*)
        integer(c_int32_t), value :: nhv
        integer(c_int), intent(inout) :: failel
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_linear_umat_f32(cm, sig, hsv, nhv, failel, message, room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_linear_umat_vector_f64(cm, sig1, sig2, sig3, sig4, sig5, sig6, hsvs, nhv, lft, llt, nlq, &
    failels, message) result(status)
    real(c_double), intent(in) :: cm(*)
    real(c_double), intent(inout) :: sig1(*), sig2(*), sig3(*), sig4(*), sig5(*), sig6(*), hsvs(*)
    integer(c_int32_t), intent(in) :: nhv, lft, llt, nlq
    integer(c_int), intent(inout) :: failels(*)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_linear_umat_vector_f64(cm, sig1, sig2, sig3, sig4, sig5, sig6, hsvs, nhv, lft, llt, nlq, &
        failels, message, capacity) bind(c, name='toron_lsdyna_linear_umat_vector_f64') result(status)
        import
        real(c_double), intent(in) :: cm(*)
        real(c_double), intent(inout) :: sig1(*), sig2(*), sig3(*), sig4(*), sig5(*), sig6(*), hsvs(*)
        integer(c_int32_t), value :: nhv, lft, llt, nlq
        integer(c_int), intent(inout) :: failels(*)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_linear_umat_vector_f64(cm, sig1, sig2, sig3, sig4, sig5, sig6, hsvs, nhv, lft, llt, nlq, &
      failels, message, room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_linear_umat_vector_f32(cm, sig1, sig2, sig3, sig4, sig5, sig6, hsvs, nhv, lft, llt, nlq, &
    failels, message) result(status)
    real(c_float), intent(in) :: cm(*)
    real(c_float), intent(inout) :: sig1(*), sig2(*), sig3(*), sig4(*), sig5(*), sig6(*), hsvs(*)
    integer(c_int32_t), intent(in) :: nhv, lft, llt, nlq
    integer(c_int), intent(inout) :: failels(*)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_linear_umat_vector_f32(cm, sig1, sig2, sig3, sig4, sig5, sig6, hsvs, nhv, lft, llt, nlq, &
        failels, message, capacity) bind(c, name='toron_lsdyna_linear_umat_vector_f32') result(status)
        import
        real(c_float), intent(in) :: cm(*)
        real(c_float), intent(inout) :: sig1(*), sig2(*), sig3(*), sig4(*), sig5(*), sig6(*), hsvs(*)
        integer(c_int32_t), value :: nhv, lft, llt, nlq
        integer(c_int), intent(inout) :: failels(*)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_linear_umat_vector_f32(cm, sig1, sig2, sig3, sig4, sig5, sig6, hsvs, nhv, lft, llt, nlq, &
      failels, message, room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_linear_utan_f64(cm, hsv, nhv, es, message) result(status)
    real(c_double), intent(in) :: cm(*), hsv(*)
    integer(c_int32_t), intent(in) :: nhv
    real(c_double), intent(inout) :: es(*)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_linear_utan_f64(cm, hsv, nhv, es, message, &
        capacity) bind(c, name='toron_lsdyna_linear_utan_f64') result(status)
        import
        real(c_double), intent(in) :: cm(*), hsv(*)
        integer(c_int32_t), value :: nhv
        real(c_double), intent(inout) :: es(*)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_linear_utan_f64(cm, hsv, nhv, es, message, room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_linear_utan_f32(cm, hsv, nhv, es, message) result(status)
    real(c_float), intent(in) :: cm(*), hsv(*)
    integer(c_int32_t), intent(in) :: nhv
    real(c_float), intent(inout) :: es(*)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_linear_utan_f32(cm, hsv, nhv, es, message, &
        capacity) bind(c, name='toron_lsdyna_linear_utan_f32') result(status)
        import
        real(c_float), intent(in) :: cm(*), hsv(*)
        integer(c_int32_t), value :: nhv
        real(c_float), intent(inout) :: es(*)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_linear_utan_f32(cm, hsv, nhv, es, message, room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_linear_utan_vector_f64(cm, hsvs, nhv, lft, llt, nlq, dsave, message) result(status)
    real(c_double), intent(in) :: cm(*), hsvs(*)
    integer(c_int32_t), intent(in) :: nhv, lft, llt, nlq
    real(c_double), intent(inout) :: dsave(*)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_linear_utan_vector_f64(cm, hsvs, nhv, lft, llt, nlq, dsave, message, &
        capacity) bind(c, name='toron_lsdyna_linear_utan_vector_f64') result(status)
        import
        real(c_double), intent(in) :: cm(*), hsvs(*)
        integer(c_int32_t), value :: nhv, lft, llt, nlq
        real(c_double), intent(inout) :: dsave(*)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_linear_utan_vector_f64(cm, hsvs, nhv, lft, llt, nlq, dsave, message, room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_linear_utan_vector_f32(cm, hsvs, nhv, lft, llt, nlq, dsave, message) result(status)
    real(c_float), intent(in) :: cm(*), hsvs(*)
    integer(c_int32_t), intent(in) :: nhv, lft, llt, nlq
    real(c_float), intent(inout) :: dsave(*)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_linear_utan_vector_f32(cm, hsvs, nhv, lft, llt, nlq, dsave, message, &
        capacity) bind(c, name='toron_lsdyna_linear_utan_vector_f32') result(status)
        import
        real(c_float), intent(in) :: cm(*), hsvs(*)
        integer(c_int32_t), value :: nhv, lft, llt, nlq
        real(c_float), intent(inout) :: dsave(*)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_linear_utan_vector_f32(cm, hsvs, nhv, lft, llt, nlq, dsave, message, room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_linear_bulk_and_shear_f64(values, bulk, shear, message) result(status)
    real(c_double), intent(in), contiguous :: values(:)
    real(c_double), intent(inout) :: bulk, shear
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_linear_bulk_and_shear_f64(values, count, bulk, shear, message, &
        capacity) bind(c, name='toron_lsdyna_linear_bulk_and_shear_f64') result(status)
        import
        real(c_double), intent(in) :: values(*)
        integer(c_size_t), value :: count
        real(c_double), intent(inout) :: bulk, shear
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_linear_bulk_and_shear_f64(values, size(values, kind=c_size_t), bulk, shear, message, &
      room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_frictional_umat_f64(cm, sig, hsv, nhv, failel, message) result(status)
    real(c_double), intent(in) :: cm(*)
    real(c_double), intent(inout) :: sig(*), hsv(*)
    integer(c_int32_t), intent(in) :: nhv
    integer(c_int), intent(inout) :: failel
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_frictional_umat_f64(cm, sig, hsv, nhv, failel, message, &
        capacity) bind(c, name='toron_lsdyna_frictional_umat_f64') result(status)
        import
        real(c_double), intent(in) :: cm(*)
        real(c_double), intent(inout) :: sig(*), hsv(*)
        integer(c_int32_t), value :: nhv
        integer(c_int), intent(inout) :: failel
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_frictional_umat_f64(cm, sig, hsv, nhv, failel, message, room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_frictional_umat_f32(cm, sig, hsv, nhv, failel, message) result(status)
    real(c_float), intent(in) :: cm(*)
    real(c_float), intent(inout) :: sig(*), hsv(*)
    integer(c_int32_t), intent(in) :: nhv
    integer(c_int), intent(inout) :: failel
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_frictional_umat_f32(cm, sig, hsv, nhv, failel, message, &
        capacity) bind(c, name='toron_lsdyna_frictional_umat_f32') result(status)
        import
        real(c_float), intent(in) :: cm(*)
        real(c_float), intent(inout) :: sig(*), hsv(*)
        integer(c_int32_t), value :: nhv
        integer(c_int), intent(inout) :: failel
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_frictional_umat_f32(cm, sig, hsv, nhv, failel, message, room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_frictional_umat_vector_f64(cm, sig1, sig2, sig3, sig4, sig5, sig6, hsvs, nhv, lft, llt, &
    nlq, failels, message) result(status)
    real(c_double), intent(in) :: cm(*)
    real(c_double), intent(inout) :: sig1(*), sig2(*), sig3(*), sig4(*), sig5(*), sig6(*), hsvs(*)
    integer(c_int32_t), intent(in) :: nhv, lft, llt, nlq
    integer(c_int), intent(inout) :: failels(*)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_frictional_umat_vector_f64(cm, sig1, sig2, sig3, sig4, sig5, sig6, hsvs, nhv, lft, llt, &
        nlq, failels, message, capacity) bind(c, name='toron_lsdyna_frictional_umat_vector_f64') result(status)
        import
        real(c_double), intent(in) :: cm(*)
        real(c_double), intent(inout) :: sig1(*), sig2(*), sig3(*), sig4(*), sig5(*), sig6(*), hsvs(*)
        integer(c_int32_t), value :: nhv, lft, llt, nlq
        integer(c_int), intent(inout) :: failels(*)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_frictional_umat_vector_f64(cm, sig1, sig2, sig3, sig4, sig5, sig6, hsvs, nhv, lft, llt, nlq, &
      failels, message, room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_frictional_umat_vector_f32(cm, sig1, sig2, sig3, sig4, sig5, sig6, hsvs, nhv, lft, llt, &
    nlq, failels, message) result(status)
    real(c_float), intent(in) :: cm(*)
    real(c_float), intent(inout) :: sig1(*), sig2(*), sig3(*), sig4(*), sig5(*), sig6(*), hsvs(*)
    integer(c_int32_t), intent(in) :: nhv, lft, llt, nlq
    integer(c_int), intent(inout) :: failels(*)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_frictional_umat_vector_f32(cm, sig1, sig2, sig3, sig4, sig5, sig6, hsvs, nhv, lft, llt, &
        nlq, failels, message, capacity) bind(c, name='toron_lsdyna_frictional_umat_vector_f32') result(status)
        import
        real(c_float), intent(in) :: cm(*)
        real(c_float), intent(inout) :: sig1(*), sig2(*), sig3(*), sig4(*), sig5(*), sig6(*), hsvs(*)
        integer(c_int32_t), value :: nhv, lft, llt, nlq
        integer(c_int), intent(inout) :: failels(*)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_frictional_umat_vector_f32(cm, sig1, sig2, sig3, sig4, sig5, sig6, hsvs, nhv, lft, llt, nlq, &
      failels, message, room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_frictional_utan_f64(cm, hsv, nhv, es, message) result(status)
    real(c_double), intent(in) :: cm(*), hsv(*)
    integer(c_int32_t), intent(in) :: nhv
    real(c_double), intent(inout) :: es(*)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_frictional_utan_f64(cm, hsv, nhv, es, message, &
        capacity) bind(c, name='toron_lsdyna_frictional_utan_f64') result(status)
        import
        real(c_double), intent(in) :: cm(*), hsv(*)
        integer(c_int32_t), value :: nhv
        real(c_double), intent(inout) :: es(*)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_frictional_utan_f64(cm, hsv, nhv, es, message, room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_frictional_utan_f32(cm, hsv, nhv, es, message) result(status)
    real(c_float), intent(in) :: cm(*), hsv(*)
    integer(c_int32_t), intent(in) :: nhv
    real(c_float), intent(inout) :: es(*)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_frictional_utan_f32(cm, hsv, nhv, es, message, &
        capacity) bind(c, name='toron_lsdyna_frictional_utan_f32') result(status)
        import
        real(c_float), intent(in) :: cm(*), hsv(*)
        integer(c_int32_t), value :: nhv
        real(c_float), intent(inout) :: es(*)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_frictional_utan_f32(cm, hsv, nhv, es, message, room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_frictional_utan_vector_f64(cm, hsvs, nhv, lft, llt, nlq, dsave, message) result(status)
    real(c_double), intent(in) :: cm(*), hsvs(*)
    integer(c_int32_t), intent(in) :: nhv, lft, llt, nlq
    real(c_double), intent(inout) :: dsave(*)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_frictional_utan_vector_f64(cm, hsvs, nhv, lft, llt, nlq, dsave, message, &
        capacity) bind(c, name='toron_lsdyna_frictional_utan_vector_f64') result(status)
        import
        real(c_double), intent(in) :: cm(*), hsvs(*)
        integer(c_int32_t), value :: nhv, lft, llt, nlq
        real(c_double), intent(inout) :: dsave(*)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_frictional_utan_vector_f64(cm, hsvs, nhv, lft, llt, nlq, dsave, message, room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_frictional_utan_vector_f32(cm, hsvs, nhv, lft, llt, nlq, dsave, message) result(status)
    real(c_float), intent(in) :: cm(*), hsvs(*)
    integer(c_int32_t), intent(in) :: nhv, lft, llt, nlq
    real(c_float), intent(inout) :: dsave(*)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_frictional_utan_vector_f32(cm, hsvs, nhv, lft, llt, nlq, dsave, message, &
        capacity) bind(c, name='toron_lsdyna_frictional_utan_vector_f32') result(status)
        import
        real(c_float), intent(in) :: cm(*), hsvs(*)
        integer(c_int32_t), value :: nhv, lft, llt, nlq
        real(c_float), intent(inout) :: dsave(*)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_frictional_utan_vector_f32(cm, hsvs, nhv, lft, llt, nlq, dsave, message, room(message))
    call end_message(status, message)
  end function

  function toron_lsdyna_frictional_bulk_and_shear_f64(values, bulk, shear, message) result(status)
    real(c_double), intent(in), contiguous :: values(:)
    real(c_double), intent(inout) :: bulk, shear
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_lsdyna_frictional_bulk_and_shear_f64(values, count, bulk, shear, message, &
        capacity) bind(c, name='toron_lsdyna_frictional_bulk_and_shear_f64') result(status)
        import
        real(c_double), intent(in) :: values(*)
        integer(c_size_t), value :: count
        real(c_double), intent(inout) :: bulk, shear
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_lsdyna_frictional_bulk_and_shear_f64(values, size(values, kind=c_size_t), bulk, shear, message, &
      room(message))
    call end_message(status, message)
  end function

  function toron_openradioss_lecm_f64(number, values, uparam, maxuparam, nuparam, nuvar, parmat, &
    message) result(status)
    integer(c_int32_t), intent(in) :: number
    real(c_double), intent(in), contiguous :: values(:)
    real(c_double), intent(inout) :: uparam(*)
    integer(c_int32_t), intent(in) :: maxuparam
    integer(c_int32_t), intent(inout) :: nuparam, nuvar
    real(c_double), intent(inout) :: parmat(*)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_openradioss_lecm_f64(number, values, count, uparam, maxuparam, nuparam, nuvar, parmat, message, &
        capacity) bind(c, name='toron_openradioss_lecm_f64') result(status)
        import
        integer(c_int32_t), value :: number
        real(c_double), intent(in) :: values(*)
        integer(c_size_t), value :: count
        real(c_double), intent(inout) :: uparam(*)
        integer(c_int32_t), value :: maxuparam
        integer(c_int32_t), intent(inout) :: nuparam, nuvar
        real(c_double), intent(inout) :: parmat(*)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_openradioss_lecm_f64(number, values, size(values, kind=c_size_t), uparam, maxuparam, nuparam, nuvar, &
      parmat, message, room(message))
    call end_message(status, message)
  end function

  function toron_openradioss_listing_f64(uparam, nuparam, line, text) result(status)
    real(c_double), intent(in) :: uparam(*)
    integer(c_int32_t), intent(in) :: nuparam, line
    character(*), intent(out) :: text
    integer(c_int32_t) :: status
    interface
      function c_openradioss_listing_f64(uparam, nuparam, line, text, &
        capacity) bind(c, name='toron_openradioss_listing_f64') result(status)
        import
        real(c_double), intent(in) :: uparam(*)
        integer(c_int32_t), value :: nuparam, line
        character(kind=c_char), intent(inout) :: text(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_openradioss_listing_f64(uparam, nuparam, line, text, room(text))
    call end_message(-1_c_int32_t, text)
  end function

  function toron_openradioss_luser_f64(nel, nuparam, nuvar, time, uparam, ngl, rho0, fpsxx, fpsyy, fpszz, fpsxy, &
    fpsyz, fpszx, fpsyx, fpszy, fpsxz, signxx, signyy, signzz, signxy, signyz, signzx, sigvxx, sigvyy, sigvzz, &
    sigvxy, sigvyz, sigvzx, soundsp, viscmax, uvar, off, nodes, message) result(status)
    integer(c_int32_t), intent(in) :: nel, nuparam, nuvar
    real(c_double), intent(in) :: time, uparam(*)
    integer(c_int32_t), intent(in), optional :: ngl(*)
    real(c_double), intent(in) :: rho0(*), fpsxx(*), fpsyy(*), fpszz(*), fpsxy(*), fpsyz(*), fpszx(*), fpsyx(*), &
      fpszy(*), fpsxz(*)
    real(c_double), intent(inout) :: signxx(*), signyy(*), signzz(*), signxy(*), signyz(*), signzx(*), sigvxx(*), &
      sigvyy(*), sigvzz(*), sigvxy(*), sigvyz(*), sigvzx(*), soundsp(*), viscmax(*), uvar(*), off(*)
    real(c_double), intent(in), optional :: nodes(*)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_openradioss_luser_f64(nel, nuparam, nuvar, time, uparam, ngl, rho0, fpsxx, fpsyy, fpszz, fpsxy, &
        fpsyz, fpszx, fpsyx, fpszy, fpsxz, signxx, signyy, signzz, signxy, signyz, signzx, sigvxx, sigvyy, sigvzz, &
        sigvxy, sigvyz, sigvzx, soundsp, viscmax, uvar, off, nodes, message, &
        capacity) bind(c, name='toron_openradioss_luser_f64') result(status)
        import
        integer(c_int32_t), value :: nel, nuparam, nuvar
        real(c_double), value :: time
        real(c_double), intent(in) :: uparam(*)
        integer(c_int32_t), intent(in), optional :: ngl(*)
        real(c_double), intent(in) :: rho0(*), fpsxx(*), fpsyy(*), fpszz(*), fpsxy(*), fpsyz(*), fpszx(*), &
          fpsyx(*), fpszy(*), fpsxz(*)
        real(c_double), intent(inout) :: signxx(*), signyy(*), signzz(*), signxy(*), signyz(*), signzx(*), &
          sigvxx(*), sigvyy(*), sigvzz(*), sigvxy(*), sigvyz(*), sigvzx(*), soundsp(*), viscmax(*), uvar(*), off(*)
        real(c_double), intent(in), optional :: nodes(*)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_openradioss_luser_f64(nel, nuparam, nuvar, time, uparam, ngl, rho0, fpsxx, fpsyy, fpszz, fpsxy, &
      fpsyz, fpszx, fpsyx, fpszy, fpsxz, signxx, signyy, signzz, signxy, signyz, signzx, sigvxx, sigvyy, sigvzz, &
      sigvxy, sigvyz, sigvzx, soundsp, viscmax, uvar, off, nodes, message, room(message))
    call end_message(status, message)
  end function

  function toron_openradioss_lecm_f32(number, values, uparam, maxuparam, nuparam, nuvar, parmat, &
    message) result(status)
    integer(c_int32_t), intent(in) :: number
    real(c_float), intent(in), contiguous :: values(:)
    real(c_float), intent(inout) :: uparam(*)
    integer(c_int32_t), intent(in) :: maxuparam
    integer(c_int32_t), intent(inout) :: nuparam, nuvar
    real(c_float), intent(inout) :: parmat(*)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_openradioss_lecm_f32(number, values, count, uparam, maxuparam, nuparam, nuvar, parmat, message, &
        capacity) bind(c, name='toron_openradioss_lecm_f32') result(status)
        import
        integer(c_int32_t), value :: number
        real(c_float), intent(in) :: values(*)
        integer(c_size_t), value :: count
        real(c_float), intent(inout) :: uparam(*)
        integer(c_int32_t), value :: maxuparam
        integer(c_int32_t), intent(inout) :: nuparam, nuvar
        real(c_float), intent(inout) :: parmat(*)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_openradioss_lecm_f32(number, values, size(values, kind=c_size_t), uparam, maxuparam, nuparam, nuvar, &
      parmat, message, room(message))
    call end_message(status, message)
  end function

  function toron_openradioss_listing_f32(uparam, nuparam, line, text) result(status)
    real(c_float), intent(in) :: uparam(*)
    integer(c_int32_t), intent(in) :: nuparam, line
    character(*), intent(out) :: text
    integer(c_int32_t) :: status
    interface
      function c_openradioss_listing_f32(uparam, nuparam, line, text, &
        capacity) bind(c, name='toron_openradioss_listing_f32') result(status)
        import
        real(c_float), intent(in) :: uparam(*)
        integer(c_int32_t), value :: nuparam, line
        character(kind=c_char), intent(inout) :: text(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_openradioss_listing_f32(uparam, nuparam, line, text, room(text))
    call end_message(-1_c_int32_t, text)
  end function

  function toron_openradioss_luser_f32(nel, nuparam, nuvar, time, uparam, ngl, rho0, fpsxx, fpsyy, fpszz, fpsxy, &
    fpsyz, fpszx, fpsyx, fpszy, fpsxz, signxx, signyy, signzz, signxy, signyz, signzx, sigvxx, sigvyy, sigvzz, &
    sigvxy, sigvyz, sigvzx, soundsp, viscmax, uvar, off, nodes, message) result(status)
    integer(c_int32_t), intent(in) :: nel, nuparam, nuvar
    real(c_float), intent(in) :: time, uparam(*)
    integer(c_int32_t), intent(in), optional :: ngl(*)
    real(c_float), intent(in) :: rho0(*), fpsxx(*), fpsyy(*), fpszz(*), fpsxy(*), fpsyz(*), fpszx(*), fpsyx(*), &
      fpszy(*), fpsxz(*)
    real(c_float), intent(inout) :: signxx(*), signyy(*), signzz(*), signxy(*), signyz(*), signzx(*), sigvxx(*), &
      sigvyy(*), sigvzz(*), sigvxy(*), sigvyz(*), sigvzx(*), soundsp(*), viscmax(*), uvar(*), off(*)
    real(c_float), intent(in), optional :: nodes(*)
    character(*), intent(out), optional :: message
    integer(c_int32_t) :: status
    interface
      function c_openradioss_luser_f32(nel, nuparam, nuvar, time, uparam, ngl, rho0, fpsxx, fpsyy, fpszz, fpsxy, &
        fpsyz, fpszx, fpsyx, fpszy, fpsxz, signxx, signyy, signzz, signxy, signyz, signzx, sigvxx, sigvyy, sigvzz, &
        sigvxy, sigvyz, sigvzx, soundsp, viscmax, uvar, off, nodes, message, &
        capacity) bind(c, name='toron_openradioss_luser_f32') result(status)
        import
        integer(c_int32_t), value :: nel, nuparam, nuvar
        real(c_float), value :: time
        real(c_float), intent(in) :: uparam(*)
        integer(c_int32_t), intent(in), optional :: ngl(*)
        real(c_float), intent(in) :: rho0(*), fpsxx(*), fpsyy(*), fpszz(*), fpsxy(*), fpsyz(*), fpszx(*), fpsyx(*), &
          fpszy(*), fpsxz(*)
        real(c_float), intent(inout) :: signxx(*), signyy(*), signzz(*), signxy(*), signyz(*), signzx(*), &
          sigvxx(*), sigvyy(*), sigvzz(*), sigvxy(*), sigvyz(*), sigvzx(*), soundsp(*), viscmax(*), uvar(*), off(*)
        real(c_float), intent(in), optional :: nodes(*)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: status
      end function
    end interface
    status = c_openradioss_luser_f32(nel, nuparam, nuvar, time, uparam, ngl, rho0, fpsxx, fpsyy, fpszz, fpsxy, &
      fpsyz, fpszx, fpsyx, fpszy, fpsxz, signxx, signyy, signzz, signxy, signyz, signzx, sigvxx, sigvyy, sigvzz, &
      sigvxy, sigvyz, sigvzx, soundsp, viscmax, uvar, off, nodes, message, room(message))
    call end_message(status, message)
  end function

  ! The version of the library.
  function toron_version() result(text)
    character(:), allocatable :: text
    character(kind=c_char), pointer :: characters(:)
    type(c_ptr) :: start
    interface
      function c_version() bind(c, name='toron_version') result(start)
        import
        type(c_ptr) :: start
      end function
      function c_length(start) bind(c, name='strlen') result(length)
        import
        type(c_ptr), value :: start
        integer(c_size_t) :: length
      end function
    end interface
    start = c_version()
    call c_f_pointer(start, characters, [c_length(start)])
    text = toron_text(characters)
  end function

  ! The meaning of a status code.
  function toron_status_message(status) result(text)
    integer(c_int32_t), intent(in) :: status
    character(:), allocatable :: text
    character(kind=c_char) :: message(toron_message_capacity)
    integer(c_int32_t) :: unknown
    interface
      function c_status_message(status, message, capacity) bind(c, name='toron_status_message') result(unknown)
        import
        integer(c_int32_t), value :: status
        character(kind=c_char), intent(inout) :: message(*)
        integer(c_size_t), value :: capacity
        integer(c_int32_t) :: unknown
      end function
    end interface
    ! An unknown code has a message too, which says so.
    unknown = c_status_message(status, message, size(message, kind=c_size_t))
    text = toron_text(message)
  end function

  ! The text in an array of characters that ends with a null, such as the name in a table's row.
  pure function toron_text(characters) result(text)
    character(kind=c_char), intent(in) :: characters(:)
    character(:), allocatable :: text
    integer :: length, i
    length = 0
    do while (length < size(characters))
      if (characters(length + 1) == c_null_char) exit
      length = length + 1
    end do
    allocate (character(length) :: text)
    do i = 1, length
      text(i:i) = characters(i)
    end do
  end function

  ! How many characters the library may write to a message.
  pure function room(message)
    character(*), intent(in), optional :: message
    integer(c_size_t) :: room
    room = 0
    if (present(message)) room = len(message, kind=c_size_t)
  end function

  ! Blanks a message from the null that the library ends it with, or all of it if there is no error.
  pure subroutine end_message(status, message)
    integer(c_int32_t), intent(in) :: status
    character(*), intent(inout), optional :: message
    if (.not. present(message)) return
    if (status < 0) then
      message(max(1, index(message, c_null_char)):) = ''
    else
      message = ''
    end if
  end subroutine
end module
