! The Fortran module include/toron.f90: points and blocks against the truth, and every other entry once.
program module_test
  use, intrinsic :: iso_c_binding
  use cases
  use toron
  implicit none

  integer(c_size_t), parameter :: properties = toron_hyperelastic_properties, linear = toron_linear_elastic_properties
  integer :: i, first, last

  call read_cases
  do i = 1, number_of_cases
    call point(table(i))
    call point_in_single_precision(table(i))
  end do
  first = 1
  do while (first <= number_of_cases)
    last = last_of_run(first)
    call block_of_cases
    first = last + 1
  end do
  call the_library_about_itself
  call linear_elastic
  call entries_of_hosts(table(number_of_cases))
  call finish

contains

  subroutine point(t)
    type(truth), intent(in) :: t
    real(c_double) :: stress(6), state(11), speed
    integer(c_int32_t) :: status
    status = toron_hyperelastic_point_f64(t%properties, properties, t%f, state_new=state, stress=stress, &
      density=1000.0_c_double, wave_speed=speed)
    call check(status == toron_status_ok, 'status', t%id)
    call check_answer(t, stress, state, .false.)
    call check(speed >= sqrt(t%properties(1) / 1000) * (1 - 1e-12_c_double), 'wave speed', t%id)
  end subroutine

  subroutine point_in_single_precision(t)
    type(truth), intent(in) :: t
    real(c_float) :: stress(6), state(11)
    integer(c_int32_t) :: status
    status = toron_hyperelastic_point_f32(real(t%properties, c_float), properties, real(t%f, c_float), state_new=state, &
      stress=stress, density=1.0_c_float)
    call check(status == toron_status_ok, 'status', t%id)
    call check_answer(t, real(stress, c_double), real(state, c_double), .true.)
  end subroutine

  ! Cases first .. last, point by point along the first index.
  subroutine block_of_cases
    real(c_double), allocatable, target :: f(:, :), stress(:, :), state(:, :)
    type(toron_block_f64) :: block
    integer :: n
    n = last - first + 1
    allocate (f(n, 9), stress(n, 6), state(n, 11))
    do i = 1, n
      f(i, :) = table(first + i - 1)%f
    end do
    block%n = n
    block%leading_dimension = n
    block%density = 1
    block%deformation_gradient = c_loc(f)
    block%stress = c_loc(stress)
    block%energies = c_loc(state(1, 1))
    block%invariants = c_loc(state(1, 5))
    block%failure = c_loc(state(1, 9))
    call check(toron_hyperelastic_block_f64(table(first)%properties, properties, block) == toron_status_ok, 'block', first)
    do i = 1, n
      call check_answer(table(first + i - 1), stress(i, :), state(i, :), .false.)
    end do
    block%leading_dimension = n - 1
    call check(toron_hyperelastic_block_f64(table(first)%properties, properties, block) &
      == toron_status_bad_leading_dimension, 'leading dimension', first)
  end subroutine

  function text(c) result(string)
    character(kind=c_char), intent(in) :: c(:)
    character(len=:), allocatable :: string
    integer :: length
    length = findloc(c, c_null_char, dim=1) - 1
    string = repeat(' ', length)
    string = transfer(c(:length), string)
  end function

  subroutine the_library_about_itself
    real(c_double) :: values(properties), density
    real(c_float) :: single(properties)
    character(kind=c_char) :: message(200)
    type(toron_table_row) :: row
    integer(c_int32_t) :: status
    integer(c_size_t) :: length
    call check(toron_abi_version() == toron_module_abi_version, 'ABI', 0)
    call check(c_associated(toron_version()), 'version', 0)
    length = toron_status_message(toron_status_null_argument, message, 200_c_size_t)
    call check(text(message) == 'an argument that must not be null is null' .and. length == 41, 'message', 0)
    call check(toron_status_message(toron_status_null_argument, capacity=0_c_size_t) == 41, 'length of a message', 0)
    call check(toron_property_count(toron_hyperelastic) == properties, 'count', 0)
    call check(toron_state_count(toron_linear_elastic) == toron_linear_elastic_state, 'count', 0)
    call check(toron_property(toron_hyperelastic, 2, row) == toron_status_ok, 'row', 0)
    call check(text(row%name) == 'p' .and. row%minimum == 1 .and. row%minimum_excluded == 1 .and. row%maximum == 40, 'p', 0)
    call check(text(row%meaning) == 'transverse compaction exponent', 'meaning', 0)
    call check(toron_property_index(toron_hyperelastic, 'eps_lim' // c_null_char) == 5, 'eps_lim', 0)
    call check(toron_state_variable(toron_hyperelastic, 10, row) == toron_status_ok, 'row', 0)
    call check(text(row%name) == 'alive', 'alive', 0)
    call check(toron_state_index(toron_hyperelastic, 'failed' // c_null_char) == 9, 'failed', 0)

    status = toron_preset_f64('kevlar-km2-600' // c_null_char, 'mm-kg-ms' // c_null_char, values, properties, density)
    call check(status == toron_status_ok .and. abs(values(1) - 82.341_c_double) < 1e-14_c_double, 'preset', 0)
    call check(abs(density - 1.3514e-6_c_double) < 1e-20_c_double, 'density', 0)
    status = toron_preset_f32('kevlar-km2-600' // c_null_char, 'si' // c_null_char, single, properties)
    call check(status == toron_status_ok .and. single(1) == 82.341e9_c_float, 'preset in single precision', 0)

    call check(toron_hyperelastic_validate_f64(values, properties, capacity=0_c_size_t) == 0, 'valid', 0)
    single(3) = 0.5
    length = toron_hyperelastic_validate_f32(single, properties, message, 200_c_size_t, status)
    call check(status == toron_status_property_out_of_bounds .and. length == len(text(message)), 'invalid', 0)
    call check(text(message) == 'property 3 (p, transverse compaction exponent) is 0.5; allowed: a number > 1, at most 40', &
      'message', 0)
  end subroutine

  subroutine linear_elastic
    real(c_double) :: values(linear), axes(9), state(10), stress(6), strain(6), f(9), rest(9)
    integer(c_int32_t) :: status
    status = toron_preset_f64('kevlar-km2-600-linear' // c_null_char, 'mm-kg-ms' // c_null_char, values, linear)
    call check(status == toron_status_ok, 'preset', 0)
    call check(toron_linear_elastic_validate_f64(values, linear, capacity=0_c_size_t) == 0, 'valid', 0)
    call check(toron_linear_elastic_axes_f64(values, linear, axes) == toron_status_ok, 'axes', 0)
    rest = [1, 0, 0, 0, 1, 0, 0, 0, 1]
    f = rest
    f(1) = 1.02_c_double
    status = toron_linear_elastic_step_f64(values, linear, rest, f, state_new=state, stress=stress, &
      rotation=toron_rotation_spin, criterion=toron_criterion_principal, axes=axes)
    call check(status == toron_status_ok .and. abs(stress(1) - values(1) * log(f(1))) < 1e-14_c_double * values(1), &
      'step', 0)
    strain = [1e-3_c_double, 0.0_c_double, 0.0_c_double, 0.0_c_double, 0.0_c_double, 0.0_c_double]
    status = toron_linear_elastic_increment_f64(values, linear, strain, 1.0_c_double, state_new=state, stress=stress, &
      criterion=toron_criterion_fibre)
    call check(status == toron_status_ok .and. abs(stress(1) - values(1) * 1e-3_c_double) < 1e-15_c_double, 'increment', 0)
  end subroutine

  ! The shims have interfaces of their own; here those of the module.
  subroutine entries_of_hosts(t)
    type(truth), intent(in) :: t
    real(c_double) :: stress(6), state(11), sse, pnewdt, zero(6), hsv(20), bulk, shear
    real(c_float) :: single(6), single_hsv(20)
    integer(c_int32_t) :: status
    integer(c_int) :: failel, failels(1)
    zero = 0
    state = 0
    pnewdt = 1
    status = toron_abaqus_umat_f64(stress, state, sse, pnewdt, t%f, t%properties, int(properties, c_int32_t), &
      11, 3, 3, 1)
    call check(status == toron_status_ok, 'umat', t%id)
    call check_answer(t, stress([1, 2, 3, 4, 6, 5]), state, .false.)
    hsv = [zero, zero(1:5), t%f]
    status = toron_lsdyna_umat_f64(t%properties, stress, hsv, 11, failel)
    call check(status == toron_status_ok .and. failel == t%failed, 'umat41', t%id)
    call check_answer(t, stress, hsv(1:11), .false.)
    hsv = [zero, zero(1:5), t%f]
    status = toron_lsdyna_umat_vector_f64(t%properties, stress(1:), stress(2:), stress(3:), stress(4:), stress(5:), &
      stress(6:), hsv, 11, 1, 1, 1, failels)
    call check(status == toron_status_ok .and. failels(1) == t%failed, 'umat41v', t%id)
    call check_answer(t, stress, hsv(1:11), .false.)
    single_hsv = real([zero, zero(1:5), t%f], c_float)
    status = toron_lsdyna_umat_f32(real(t%properties, c_float), single, single_hsv, 11, failel)
    call check(status == toron_status_ok, 'umat41 in single precision', t%id)
    call check_answer(t, real(single, c_double), real(single_hsv(1:11), c_double), .true.)
    single_hsv = real([zero, zero(1:5), t%f], c_float)
    status = toron_lsdyna_umat_vector_f32(real(t%properties, c_float), single(1:), single(2:), single(3:), single(4:), &
      single(5:), single(6:), single_hsv, 11, 1, 1, 1, failels)
    call check(status == toron_status_ok, 'umat41v in single precision', t%id)
    call check_answer(t, real(single, c_double), real(single_hsv(1:11), c_double), .true.)
    status = toron_lsdyna_bulk_and_shear_f64(t%properties, properties, bulk, shear)
    call check(abs(bulk + 4 * shear / 3 - t%properties(1)) <= 1e-15_c_double * t%properties(1), 'moduli', t%id)
    ! Null is what is left out.
    call check(toron_abaqus_vumat_f64() == toron_status_null_argument, 'vumat', t%id)
    call check(toron_abaqus_vumat_f32() == toron_status_null_argument, 'vumat in single precision', t%id)
    call check(toron_hyperelastic_block_f32(count=properties) == toron_status_null_argument, 'block', t%id)
  end subroutine
end program
