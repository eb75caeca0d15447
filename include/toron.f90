! toron: the interface of toron.h for Fortran 2018. Generated from that header: do not edit.
!
! The header says what every function does and returns; numbers, orders and units are the same. What may be null there
! may be left out here, by the name of the argument. Names and messages are C strings: end them with c_null_char. Status
! codes are toron_status_... and the interface's number toron_module_abi_version: in C, some differ from a function by
! case alone.
module toron
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_float, c_int, c_int32_t, c_null_ptr, c_ptr, c_size_t
  implicit none

  integer(c_int32_t), parameter :: toron_status_ok = 0
  integer(c_int32_t), parameter :: toron_status_null_argument = -101
  integer(c_int32_t), parameter :: toron_status_bad_count = -102
  integer(c_int32_t), parameter :: toron_status_bad_leading_dimension = -103
  integer(c_int32_t), parameter :: toron_status_unknown_name = -104
  integer(c_int32_t), parameter :: toron_status_bad_argument = -105
  integer(c_int32_t), parameter :: toron_status_no_deformation_gradient = -106
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
  integer(c_int32_t), parameter :: toron_module_abi_version = 1
  integer(c_int32_t), parameter :: toron_hyperelastic = 0
  integer(c_int32_t), parameter :: toron_linear_elastic = 1
  integer(c_int32_t), parameter :: toron_hyperelastic_properties = 11
  integer(c_int32_t), parameter :: toron_hyperelastic_state = 11
  integer(c_int32_t), parameter :: toron_linear_elastic_properties = 10
  integer(c_int32_t), parameter :: toron_linear_elastic_state = 10
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

  type, bind(c) :: toron_table_row
    character(kind=c_char) :: name(24)
    character(kind=c_char) :: symbol(24)
    character(kind=c_char) :: unit(24)
    integer(c_int32_t) :: mass
    integer(c_int32_t) :: length
    integer(c_int32_t) :: time
    integer(c_int32_t) :: has_default
    real(c_double) :: default_value
    real(c_double) :: minimum
    real(c_double) :: maximum
    integer(c_int32_t) :: minimum_excluded
    character(kind=c_char) :: allowed(80)
    character(kind=c_char) :: meaning(96)
  end type

  type, bind(c) :: toron_block_f64
    integer(c_size_t) :: n
    integer(c_size_t) :: leading_dimension
    type(c_ptr) :: deformation_gradient = c_null_ptr
    type(c_ptr) :: fibre = c_null_ptr
    type(c_ptr) :: energies_old = c_null_ptr
    type(c_ptr) :: invariants_old = c_null_ptr
    type(c_ptr) :: failure_old = c_null_ptr
    real(c_double) :: density
    type(c_ptr) :: stress = c_null_ptr
    type(c_ptr) :: energies = c_null_ptr
    type(c_ptr) :: invariants = c_null_ptr
    type(c_ptr) :: failure = c_null_ptr
    type(c_ptr) :: modes = c_null_ptr
    type(c_ptr) :: wave_speed = c_null_ptr
    type(c_ptr) :: status = c_null_ptr
    type(c_ptr) :: active = c_null_ptr
    integer(c_int32_t) :: level = toron_level_best
  end type

  type, bind(c) :: toron_block_f32
    integer(c_size_t) :: n
    integer(c_size_t) :: leading_dimension
    type(c_ptr) :: deformation_gradient = c_null_ptr
    type(c_ptr) :: fibre = c_null_ptr
    type(c_ptr) :: energies_old = c_null_ptr
    type(c_ptr) :: invariants_old = c_null_ptr
    type(c_ptr) :: failure_old = c_null_ptr
    real(c_float) :: density
    type(c_ptr) :: stress = c_null_ptr
    type(c_ptr) :: energies = c_null_ptr
    type(c_ptr) :: invariants = c_null_ptr
    type(c_ptr) :: failure = c_null_ptr
    type(c_ptr) :: modes = c_null_ptr
    type(c_ptr) :: wave_speed = c_null_ptr
    type(c_ptr) :: status = c_null_ptr
    type(c_ptr) :: active = c_null_ptr
    integer(c_int32_t) :: level = toron_level_best
  end type

  type, bind(c) :: toron_linear_block_f64
    integer(c_size_t) :: n
    integer(c_size_t) :: leading_dimension
    type(c_ptr) :: f_old = c_null_ptr
    type(c_ptr) :: f_new = c_null_ptr
    type(c_ptr) :: axes = c_null_ptr
    type(c_ptr) :: state_old = c_null_ptr
    type(c_ptr) :: state_new = c_null_ptr
    type(c_ptr) :: stress = c_null_ptr
    type(c_ptr) :: status = c_null_ptr
    integer(c_int32_t) :: level = toron_level_best
  end type

  type, bind(c) :: toron_linear_block_f32
    integer(c_size_t) :: n
    integer(c_size_t) :: leading_dimension
    type(c_ptr) :: f_old = c_null_ptr
    type(c_ptr) :: f_new = c_null_ptr
    type(c_ptr) :: axes = c_null_ptr
    type(c_ptr) :: state_old = c_null_ptr
    type(c_ptr) :: state_new = c_null_ptr
    type(c_ptr) :: stress = c_null_ptr
    type(c_ptr) :: status = c_null_ptr
    integer(c_int32_t) :: level = toron_level_best
  end type

  type, bind(c) :: toron_vumat_f64
    integer(c_int32_t) :: nblock
    integer(c_int32_t) :: ndir
    integer(c_int32_t) :: nshr
    integer(c_int32_t) :: nstatev
    integer(c_int32_t) :: nprops
    real(c_double) :: step_time
    real(c_double) :: total_time
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
    integer(c_int32_t) :: nblock
    integer(c_int32_t) :: ndir
    integer(c_int32_t) :: nshr
    integer(c_int32_t) :: nstatev
    integer(c_int32_t) :: nprops
    real(c_float) :: step_time
    real(c_float) :: total_time
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

  interface
    function toron_version() bind(c)
      import
      type(c_ptr) :: toron_version
    end function

    function toron_abi_version() bind(c)
      import
      integer(c_int32_t) :: toron_abi_version
    end function

    function toron_status_message(status, buffer, capacity) bind(c)
      import
      integer(c_int32_t), value :: status
      character(kind=c_char), intent(inout), optional :: buffer(*)
      integer(c_size_t), value :: capacity
      integer(c_size_t) :: toron_status_message
    end function

    function toron_property_count(law) bind(c)
      import
      integer(c_int32_t), value :: law
      integer(c_int32_t) :: toron_property_count
    end function

    function toron_property(law, index, row) bind(c)
      import
      integer(c_int32_t), value :: law
      integer(c_int32_t), value :: index
      type(toron_table_row), intent(inout), optional :: row
      integer(c_int32_t) :: toron_property
    end function

    function toron_property_index(law, property) bind(c)
      import
      integer(c_int32_t), value :: law
      character(kind=c_char), intent(in), optional :: property(*)
      integer(c_int32_t) :: toron_property_index
    end function

    function toron_state_count(law) bind(c)
      import
      integer(c_int32_t), value :: law
      integer(c_int32_t) :: toron_state_count
    end function

    function toron_state_variable(law, index, row) bind(c)
      import
      integer(c_int32_t), value :: law
      integer(c_int32_t), value :: index
      type(toron_table_row), intent(inout), optional :: row
      integer(c_int32_t) :: toron_state_variable
    end function

    function toron_state_index(law, variable) bind(c)
      import
      integer(c_int32_t), value :: law
      character(kind=c_char), intent(in), optional :: variable(*)
      integer(c_int32_t) :: toron_state_index
    end function

    function toron_preset_f64(preset, units, values, count, density) bind(c)
      import
      character(kind=c_char), intent(in), optional :: preset(*)
      character(kind=c_char), intent(in), optional :: units(*)
      real(c_double), intent(inout), optional :: values(*)
      integer(c_size_t), value :: count
      real(c_double), intent(inout), optional :: density
      integer(c_int32_t) :: toron_preset_f64
    end function

    function toron_preset_f32(preset, units, values, count, density) bind(c)
      import
      character(kind=c_char), intent(in), optional :: preset(*)
      character(kind=c_char), intent(in), optional :: units(*)
      real(c_float), intent(inout), optional :: values(*)
      integer(c_size_t), value :: count
      real(c_float), intent(inout), optional :: density
      integer(c_int32_t) :: toron_preset_f32
    end function

    function toron_hyperelastic_validate_f64(values, count, message, capacity, status) bind(c)
      import
      real(c_double), intent(in), optional :: values(*)
      integer(c_size_t), value :: count
      character(kind=c_char), intent(inout), optional :: message(*)
      integer(c_size_t), value :: capacity
      integer(c_int32_t), intent(inout), optional :: status
      integer(c_size_t) :: toron_hyperelastic_validate_f64
    end function

    function toron_hyperelastic_validate_f32(values, count, message, capacity, status) bind(c)
      import
      real(c_float), intent(in), optional :: values(*)
      integer(c_size_t), value :: count
      character(kind=c_char), intent(inout), optional :: message(*)
      integer(c_size_t), value :: capacity
      integer(c_int32_t), intent(inout), optional :: status
      integer(c_size_t) :: toron_hyperelastic_validate_f32
    end function

    function toron_hyperelastic_point_f64(values, count, deformation_gradient, fibre, state_old, state_new, &
        stress, modes, density, wave_speed) bind(c)
      import
      real(c_double), intent(in), optional :: values(*)
      integer(c_size_t), value :: count
      real(c_double), intent(in), optional :: deformation_gradient(*)
      real(c_double), intent(in), optional :: fibre(*)
      real(c_double), intent(in), optional :: state_old(*)
      real(c_double), intent(inout), optional :: state_new(*)
      real(c_double), intent(inout), optional :: stress(*)
      real(c_double), intent(inout), optional :: modes(*)
      real(c_double), value :: density
      real(c_double), intent(inout), optional :: wave_speed
      integer(c_int32_t) :: toron_hyperelastic_point_f64
    end function

    function toron_hyperelastic_point_f32(values, count, deformation_gradient, fibre, state_old, state_new, &
        stress, modes, density, wave_speed) bind(c)
      import
      real(c_float), intent(in), optional :: values(*)
      integer(c_size_t), value :: count
      real(c_float), intent(in), optional :: deformation_gradient(*)
      real(c_float), intent(in), optional :: fibre(*)
      real(c_float), intent(in), optional :: state_old(*)
      real(c_float), intent(inout), optional :: state_new(*)
      real(c_float), intent(inout), optional :: stress(*)
      real(c_float), intent(inout), optional :: modes(*)
      real(c_float), value :: density
      real(c_float), intent(inout), optional :: wave_speed
      integer(c_int32_t) :: toron_hyperelastic_point_f32
    end function

    function toron_hyperelastic_point_tangent_f64(values, count, deformation_gradient, fibre, state_old, state_new, &
        stress, measure, tangent) bind(c)
      import
      real(c_double), intent(in), optional :: values(*)
      integer(c_size_t), value :: count
      real(c_double), intent(in), optional :: deformation_gradient(*)
      real(c_double), intent(in), optional :: fibre(*)
      real(c_double), intent(in), optional :: state_old(*)
      real(c_double), intent(inout), optional :: state_new(*)
      real(c_double), intent(inout), optional :: stress(*)
      integer(c_int32_t), value :: measure
      real(c_double), intent(inout), optional :: tangent(*)
      integer(c_int32_t) :: toron_hyperelastic_point_tangent_f64
    end function

    function toron_hyperelastic_point_tangent_f32(values, count, deformation_gradient, fibre, state_old, state_new, &
        stress, measure, tangent) bind(c)
      import
      real(c_float), intent(in), optional :: values(*)
      integer(c_size_t), value :: count
      real(c_float), intent(in), optional :: deformation_gradient(*)
      real(c_float), intent(in), optional :: fibre(*)
      real(c_float), intent(in), optional :: state_old(*)
      real(c_float), intent(inout), optional :: state_new(*)
      real(c_float), intent(inout), optional :: stress(*)
      integer(c_int32_t), value :: measure
      real(c_float), intent(inout), optional :: tangent(*)
      integer(c_int32_t) :: toron_hyperelastic_point_tangent_f32
    end function

    function toron_hyperelastic_least_acoustic_eigenvalue_f64(values, count, deformation_gradient, fibre, least, direction) bind(c)
      import
      real(c_double), intent(in), optional :: values(*)
      integer(c_size_t), value :: count
      real(c_double), intent(in), optional :: deformation_gradient(*)
      real(c_double), intent(in), optional :: fibre(*)
      real(c_double), intent(inout), optional :: least
      real(c_double), intent(inout), optional :: direction(*)
      integer(c_int32_t) :: toron_hyperelastic_least_acoustic_eigenvalue_f64
    end function

    function toron_hyperelastic_block_tangent_f64(values, count, block, measure, tangent) bind(c)
      import
      real(c_double), intent(in), optional :: values(*)
      integer(c_size_t), value :: count
      type(toron_block_f64), intent(in), optional :: block
      integer(c_int32_t), value :: measure
      real(c_double), intent(inout), optional :: tangent(*)
      integer(c_int32_t) :: toron_hyperelastic_block_tangent_f64
    end function

    function toron_hyperelastic_block_tangent_f32(values, count, block, measure, tangent) bind(c)
      import
      real(c_float), intent(in), optional :: values(*)
      integer(c_size_t), value :: count
      type(toron_block_f32), intent(in), optional :: block
      integer(c_int32_t), value :: measure
      real(c_float), intent(inout), optional :: tangent(*)
      integer(c_int32_t) :: toron_hyperelastic_block_tangent_f32
    end function

    function toron_hyperelastic_block_f64(values, count, block) bind(c)
      import
      real(c_double), intent(in), optional :: values(*)
      integer(c_size_t), value :: count
      type(toron_block_f64), intent(in), optional :: block
      integer(c_int32_t) :: toron_hyperelastic_block_f64
    end function

    function toron_hyperelastic_block_f32(values, count, block) bind(c)
      import
      real(c_float), intent(in), optional :: values(*)
      integer(c_size_t), value :: count
      type(toron_block_f32), intent(in), optional :: block
      integer(c_int32_t) :: toron_hyperelastic_block_f32
    end function

    function toron_linear_elastic_validate_f64(values, count, message, capacity, status) bind(c)
      import
      real(c_double), intent(in), optional :: values(*)
      integer(c_size_t), value :: count
      character(kind=c_char), intent(inout), optional :: message(*)
      integer(c_size_t), value :: capacity
      integer(c_int32_t), intent(inout), optional :: status
      integer(c_size_t) :: toron_linear_elastic_validate_f64
    end function

    function toron_linear_elastic_axes_f64(values, count, axes) bind(c)
      import
      real(c_double), intent(in), optional :: values(*)
      integer(c_size_t), value :: count
      real(c_double), intent(inout), optional :: axes(*)
      integer(c_int32_t) :: toron_linear_elastic_axes_f64
    end function

    function toron_linear_elastic_step_f64(values, count, f_old, f_new, state_old, state_new, &
        stress, rotation, criterion, axes) bind(c)
      import
      real(c_double), intent(in), optional :: values(*)
      integer(c_size_t), value :: count
      real(c_double), intent(in), optional :: f_old(*)
      real(c_double), intent(in), optional :: f_new(*)
      real(c_double), intent(in), optional :: state_old(*)
      real(c_double), intent(inout), optional :: state_new(*)
      real(c_double), intent(inout), optional :: stress(*)
      integer(c_int32_t), value :: rotation
      integer(c_int32_t), value :: criterion
      real(c_double), intent(inout), optional :: axes(*)
      integer(c_int32_t) :: toron_linear_elastic_step_f64
    end function

    function toron_linear_elastic_step_tangent_f64(values, count, f_old, f_new, state_old, state_new, &
        stress, rotation, criterion, axes, measure, tangent) bind(c)
      import
      real(c_double), intent(in), optional :: values(*)
      integer(c_size_t), value :: count
      real(c_double), intent(in), optional :: f_old(*)
      real(c_double), intent(in), optional :: f_new(*)
      real(c_double), intent(in), optional :: state_old(*)
      real(c_double), intent(inout), optional :: state_new(*)
      real(c_double), intent(inout), optional :: stress(*)
      integer(c_int32_t), value :: rotation
      integer(c_int32_t), value :: criterion
      real(c_double), intent(inout), optional :: axes(*)
      integer(c_int32_t), value :: measure
      real(c_double), intent(inout), optional :: tangent(*)
      integer(c_int32_t) :: toron_linear_elastic_step_tangent_f64
    end function

    function toron_linear_elastic_increment_f64(values, count, strain, jacobian, state_old, state_new, &
        stress, criterion) bind(c)
      import
      real(c_double), intent(in), optional :: values(*)
      integer(c_size_t), value :: count
      real(c_double), intent(in), optional :: strain(*)
      real(c_double), value :: jacobian
      real(c_double), intent(in), optional :: state_old(*)
      real(c_double), intent(inout), optional :: state_new(*)
      real(c_double), intent(inout), optional :: stress(*)
      integer(c_int32_t), value :: criterion
      integer(c_int32_t) :: toron_linear_elastic_increment_f64
    end function

    function toron_linear_elastic_block_f64(values, count, block, rotation, criterion) bind(c)
      import
      real(c_double), intent(in), optional :: values(*)
      integer(c_size_t), value :: count
      type(toron_linear_block_f64), intent(in), optional :: block
      integer(c_int32_t), value :: rotation
      integer(c_int32_t), value :: criterion
      integer(c_int32_t) :: toron_linear_elastic_block_f64
    end function

    function toron_linear_elastic_block_f32(values, count, block, rotation, criterion) bind(c)
      import
      real(c_float), intent(in), optional :: values(*)
      integer(c_size_t), value :: count
      type(toron_linear_block_f32), intent(in), optional :: block
      integer(c_int32_t), value :: rotation
      integer(c_int32_t), value :: criterion
      integer(c_int32_t) :: toron_linear_elastic_block_f32
    end function

    function toron_abaqus_umat_tangent_f64(stress, statev, ddsdde, sse, pnewdt, dfgrd1, &
        props, nprops, nstatv, ndi, nshr, nlgeom) bind(c)
      import
      real(c_double), intent(inout), optional :: stress(*)
      real(c_double), intent(inout), optional :: statev(*)
      real(c_double), intent(inout), optional :: ddsdde(*)
      real(c_double), intent(inout), optional :: sse
      real(c_double), intent(inout), optional :: pnewdt
      real(c_double), intent(in), optional :: dfgrd1(*)
      real(c_double), intent(in), optional :: props(*)
      integer(c_int32_t), value :: nprops
      integer(c_int32_t), value :: nstatv
      integer(c_int32_t), value :: ndi
      integer(c_int32_t), value :: nshr
      integer(c_int32_t), value :: nlgeom
      integer(c_int32_t) :: toron_abaqus_umat_tangent_f64
    end function

    function toron_abaqus_umat_f64(stress, statev, sse, pnewdt, dfgrd1, props, &
        nprops, nstatv, ndi, nshr, nlgeom) bind(c)
      import
      real(c_double), intent(inout), optional :: stress(*)
      real(c_double), intent(inout), optional :: statev(*)
      real(c_double), intent(inout), optional :: sse
      real(c_double), intent(inout), optional :: pnewdt
      real(c_double), intent(in), optional :: dfgrd1(*)
      real(c_double), intent(in), optional :: props(*)
      integer(c_int32_t), value :: nprops
      integer(c_int32_t), value :: nstatv
      integer(c_int32_t), value :: ndi
      integer(c_int32_t), value :: nshr
      integer(c_int32_t), value :: nlgeom
      integer(c_int32_t) :: toron_abaqus_umat_f64
    end function

    function toron_abaqus_vumat_f64(block) bind(c)
      import
      type(toron_vumat_f64), intent(in), optional :: block
      integer(c_int32_t) :: toron_abaqus_vumat_f64
    end function

    function toron_abaqus_vumat_f32(block) bind(c)
      import
      type(toron_vumat_f32), intent(in), optional :: block
      integer(c_int32_t) :: toron_abaqus_vumat_f32
    end function

    function toron_lsdyna_umat_f64(cm, sig, hsv, nhv, failel) bind(c)
      import
      real(c_double), intent(in), optional :: cm(*)
      real(c_double), intent(inout), optional :: sig(*)
      real(c_double), intent(inout), optional :: hsv(*)
      integer(c_int32_t), value :: nhv
      integer(c_int), intent(inout), optional :: failel
      integer(c_int32_t) :: toron_lsdyna_umat_f64
    end function

    function toron_lsdyna_umat_f32(cm, sig, hsv, nhv, failel) bind(c)
      import
      real(c_float), intent(in), optional :: cm(*)
      real(c_float), intent(inout), optional :: sig(*)
      real(c_float), intent(inout), optional :: hsv(*)
      integer(c_int32_t), value :: nhv
      integer(c_int), intent(inout), optional :: failel
      integer(c_int32_t) :: toron_lsdyna_umat_f32
    end function

    function toron_lsdyna_umat_vector_f64(cm, sig1, sig2, sig3, sig4, sig5, &
        sig6, hsvs, nhv, lft, llt, nlq, &
        failels) bind(c)
      import
      real(c_double), intent(in), optional :: cm(*)
      real(c_double), intent(inout), optional :: sig1(*)
      real(c_double), intent(inout), optional :: sig2(*)
      real(c_double), intent(inout), optional :: sig3(*)
      real(c_double), intent(inout), optional :: sig4(*)
      real(c_double), intent(inout), optional :: sig5(*)
      real(c_double), intent(inout), optional :: sig6(*)
      real(c_double), intent(inout), optional :: hsvs(*)
      integer(c_int32_t), value :: nhv
      integer(c_int32_t), value :: lft
      integer(c_int32_t), value :: llt
      integer(c_int32_t), value :: nlq
      integer(c_int), intent(inout), optional :: failels(*)
      integer(c_int32_t) :: toron_lsdyna_umat_vector_f64
    end function

    function toron_lsdyna_umat_vector_f32(cm, sig1, sig2, sig3, sig4, sig5, &
        sig6, hsvs, nhv, lft, llt, nlq, &
        failels) bind(c)
      import
      real(c_float), intent(in), optional :: cm(*)
      real(c_float), intent(inout), optional :: sig1(*)
      real(c_float), intent(inout), optional :: sig2(*)
      real(c_float), intent(inout), optional :: sig3(*)
      real(c_float), intent(inout), optional :: sig4(*)
      real(c_float), intent(inout), optional :: sig5(*)
      real(c_float), intent(inout), optional :: sig6(*)
      real(c_float), intent(inout), optional :: hsvs(*)
      integer(c_int32_t), value :: nhv
      integer(c_int32_t), value :: lft
      integer(c_int32_t), value :: llt
      integer(c_int32_t), value :: nlq
      integer(c_int), intent(inout), optional :: failels(*)
      integer(c_int32_t) :: toron_lsdyna_umat_vector_f32
    end function

    function toron_lsdyna_utan_f64(cm, hsv, nhv, es) bind(c)
      import
      real(c_double), intent(in), optional :: cm(*)
      real(c_double), intent(in), optional :: hsv(*)
      integer(c_int32_t), value :: nhv
      real(c_double), intent(inout), optional :: es(*)
      integer(c_int32_t) :: toron_lsdyna_utan_f64
    end function

    function toron_lsdyna_utan_f32(cm, hsv, nhv, es) bind(c)
      import
      real(c_float), intent(in), optional :: cm(*)
      real(c_float), intent(in), optional :: hsv(*)
      integer(c_int32_t), value :: nhv
      real(c_float), intent(inout), optional :: es(*)
      integer(c_int32_t) :: toron_lsdyna_utan_f32
    end function

    function toron_lsdyna_utan_vector_f64(cm, hsvs, nhv, lft, llt, nlq, &
        dsave) bind(c)
      import
      real(c_double), intent(in), optional :: cm(*)
      real(c_double), intent(in), optional :: hsvs(*)
      integer(c_int32_t), value :: nhv
      integer(c_int32_t), value :: lft
      integer(c_int32_t), value :: llt
      integer(c_int32_t), value :: nlq
      real(c_double), intent(inout), optional :: dsave(*)
      integer(c_int32_t) :: toron_lsdyna_utan_vector_f64
    end function

    function toron_lsdyna_utan_vector_f32(cm, hsvs, nhv, lft, llt, nlq, &
        dsave) bind(c)
      import
      real(c_float), intent(in), optional :: cm(*)
      real(c_float), intent(in), optional :: hsvs(*)
      integer(c_int32_t), value :: nhv
      integer(c_int32_t), value :: lft
      integer(c_int32_t), value :: llt
      integer(c_int32_t), value :: nlq
      real(c_float), intent(inout), optional :: dsave(*)
      integer(c_int32_t) :: toron_lsdyna_utan_vector_f32
    end function

    function toron_lsdyna_bulk_and_shear_f64(values, count, bulk, shear) bind(c)
      import
      real(c_double), intent(in), optional :: values(*)
      integer(c_size_t), value :: count
      real(c_double), intent(inout), optional :: bulk
      real(c_double), intent(inout), optional :: shear
      integer(c_int32_t) :: toron_lsdyna_bulk_and_shear_f64
    end function
  end interface
end module
