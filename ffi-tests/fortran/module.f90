! The Fortran module include/toron.f90: points and blocks against the truth, and every other function once.
program module_test
  use, intrinsic :: iso_c_binding
  use cases
  use toron
  implicit none

  ! Stress 11 22 33 12 13 23, Abaqus's order, of the library's 11 22 33 12 23 31.
  integer, parameter :: abaqus(6) = [1, 2, 3, 4, 6, 5]
  character(*), parameter :: wrong_exponent = &
    'property 3 (p, transverse compaction exponent) is 0.5; allowed: a number > 1, at most 40'
  character(*), parameter :: inverted = &
    'the deformation gradient has a determinant <= 0 or maps the fibre to zero length'
  character(toron_message_capacity) :: message
  integer :: i, first, last

  call read_cases
  do i = 1, number_of_cases
    call point(table(i))
    call point_in_single_precision(table(i))
    call fibre_of_the_point(table(i))
  end do
  first = 1
  do while (first <= number_of_cases)
    last = last_of_run(first)
    call block_of_cases(last - first + 1)
    call block_in_single_precision(last - first + 1)
    first = last + 1
  end do
  call the_library_about_itself
  call messages
  call stability
  call linear_elastic
  call linear_elastic_block
  call entries_of_hosts(table(number_of_cases))
  call vumat
  call finish

contains

  subroutine point(t)
    type(truth), intent(in), target :: t
    type(toron_hyperelastic_f64) :: law
    type(toron_point_f64) :: p
    real(c_double), target :: stress(6), state(11), speed, modes(24), tangent(6, 6)
    message = 'left from before'
    call check(toron_hyperelastic_prepare(law, t%properties, message) == toron_status_ok, 'prepare', t%id)
    call check(message == '', 'no error, no message', t%id)
    p%measure = toron_tangent_jaumann
    p%density = 1000
    p%deformation_gradient = c_loc(t%f)
    p%state_new = c_loc(state)
    p%stress = c_loc(stress)
    p%modes = c_loc(modes)
    p%wave_speed = c_loc(speed)
    p%tangent = c_loc(tangent)
    call check(toron_hyperelastic_point(law, p, message) == toron_status_ok .and. message == '', 'point', t%id)
    call check_answer(t, stress, state, .false.)
    call check_tangent(t, tangent(abaqus, abaqus), .false.)
    call check(speed >= sqrt(t%properties(1) / 1000) * (1 - 1e-12_c_double), 'wave speed', t%id)
    if (t%modes_bounded == 1) call check(maxval(abs(modes - t%modes)) <= 1e-9_c_double * t%properties(1), 'modes', t%id)
    p%tangent = c_null_ptr
    call check(toron_hyperelastic_point_with_properties(t%properties, p) == toron_status_ok, 'properties', t%id)
    call check_answer(t, stress, state, .false.)
  end subroutine

  subroutine point_in_single_precision(t)
    type(truth), intent(in) :: t
    type(toron_hyperelastic_f32) :: law
    type(toron_point_f32) :: p
    real(c_float), target :: f(9), stress(6), state(11)
    f = real(t%f, c_float)
    call check(toron_hyperelastic_prepare(law, real(t%properties, c_float)) == toron_status_ok, 'prepare', t%id)
    p%deformation_gradient = c_loc(f)
    p%state_new = c_loc(state)
    p%stress = c_loc(stress)
    call check(toron_hyperelastic_point(law, p) == toron_status_ok, 'point', t%id)
    call check_answer(t, real(stress, c_double), real(state, c_double), .true.)
    call check(toron_hyperelastic_point_with_properties(real(t%properties, c_float), p) == toron_status_ok, &
      'properties', t%id)
    call check_answer(t, real(stress, c_double), real(state, c_double), .true.)
  end subroutine

  ! The fibre direction of the point in place of that of the properties.
  subroutine fibre_of_the_point(t)
    type(truth), intent(in), target :: t
    type(toron_hyperelastic_f64) :: law
    type(toron_point_f64) :: p
    real(c_double), target :: stress(6), state(11)
    real(c_double) :: properties(11)
    properties = [t%properties(1:8), 0.0_c_double, 0.0_c_double, 1.0_c_double]
    call check(toron_hyperelastic_prepare(law, properties) == toron_status_ok, 'prepare', t%id)
    p%deformation_gradient = c_loc(t%f)
    p%fibre = c_loc(t%properties(9))
    p%state_new = c_loc(state)
    p%stress = c_loc(stress)
    call check(toron_hyperelastic_point(law, p) == toron_status_ok, 'fibre', t%id)
    call check_answer(t, stress, state, .false.)
  end subroutine

  ! Cases first .. last. Each component of F has a pointer, and the last comes first; the state is component-major, and
  ! stress and tangent are those of one point after the other.
  subroutine block_of_cases(n)
    integer, intent(in) :: n
    real(c_double), parameter :: mark = -7.25
    real(c_double), allocatable, target :: f(:, :), state(:, :), stress(:, :), tangent(:, :, :), speed(:), active(:)
    integer(c_int32_t), allocatable, target :: status(:)
    type(toron_hyperelastic_f64) :: law
    type(toron_block_f64) :: block
    integer :: c
    allocate (f(n + 3, 9), source=mark)
    allocate (state(n, 11), stress(6, n), tangent(6, 6, n), speed(n), active(n), status(n))
    do i = 1, n
      f(i, :) = table(first + i - 1)%f
    end do
    block%n = n
    block%measure = toron_tangent_jaumann
    block%density = 1000
    block%deformation_gradient = [(c_loc(f(1, 10 - c)), c = 9, 1, -1)]
    block%energies = c_loc(state(1, 1))
    block%invariants = c_loc(state(1, 5))
    block%failure = c_loc(state(1, 9))
    block%stress(1) = c_loc(stress)
    block%stress_layout = toron_layout(leading_dimension=1, stride=6)
    block%tangent = c_loc(tangent)
    block%tangent_layout = toron_layout(leading_dimension=1, stride=36)
    block%wave_speed = c_loc(speed)
    block%active = c_loc(active)
    block%status = c_loc(status)
    call check(toron_hyperelastic_prepare(law, table(first)%properties) == toron_status_ok, 'prepare', first)
    call check(toron_hyperelastic_block(law, block, message) == toron_status_ok .and. message == '', 'block', first)
    do i = 1, n
      call check_answer(table(first + i - 1), stress(:, i), state(i, :), .false.)
      call check_tangent(table(first + i - 1), tangent(abaqus, abaqus, i), .false.)
    end do
    call check(all(status == toron_status_ok), 'codes', first)
    call check(all(abs(active - state(:, 11)) <= 0), 'active', first)
    call check(all(speed >= sqrt(table(first)%properties(1) / 1000) * (1 - 1e-12_c_double)), 'wave speed', first)
    call check(all(abs(f(n + 1:, :) - mark) <= 0), 'F is read only', first)

    call check(toron_hyperelastic_block_with_properties(table(first)%properties, block) == toron_status_ok, &
      'properties', first)
    call check_answer(table(last), stress(:, n), state(n, :), .false.)
    if (n > 1) then
      block%leading_dimension = n - 1
      call check(toron_hyperelastic_block(law, block, message) == toron_status_bad_leading_dimension, message, first)
      block%leading_dimension = 0
    end if
    f(n, 1:3) = -f(n, 1:3)
    call check(toron_hyperelastic_block(law, block, message) == toron_status_inverted, 'inverted', first)
    call check(index(message, ', counted from 0: ' // inverted) > 0, message, first)
    call check(status(n) == toron_status_inverted .and. all(status(:n - 1) == toron_status_ok), 'codes', first)
    call check(all(abs(stress(:, n)) <= 0) .and. abs(active(n)) <= 0, 'an inverted point carries no stress', first)
  end subroutine

  ! All arrays are component-major, with room for more points.
  subroutine block_in_single_precision(n)
    integer, intent(in) :: n
    real(c_float), allocatable, target :: f(:, :), stress(:, :), state(:, :)
    type(toron_hyperelastic_f32) :: law
    type(toron_block_f32) :: block
    allocate (f(n + 2, 9), stress(n + 2, 6), state(n + 2, 11))
    do i = 1, n
      f(i, :) = real(table(first + i - 1)%f, c_float)
    end do
    block%n = n
    block%leading_dimension = n + 2
    block%deformation_gradient(1) = c_loc(f)
    block%stress(1) = c_loc(stress)
    block%energies = c_loc(state(1, 1))
    block%invariants = c_loc(state(1, 5))
    block%failure = c_loc(state(1, 9))
    call check(toron_hyperelastic_prepare(law, real(table(first)%properties, c_float)) == toron_status_ok, &
      'prepare', first)
    call check(toron_hyperelastic_block(law, block) == toron_status_ok, 'block', first)
    call check(toron_hyperelastic_block_with_properties(real(table(first)%properties, c_float), block) &
      == toron_status_ok, 'properties', first)
    do i = 1, n
      call check_answer(table(first + i - 1), real(stress(i, :), c_double), real(state(i, :), c_double), .true.)
    end do
  end subroutine

  subroutine the_library_about_itself
    real(c_double) :: values(toron_hyperelastic_properties), density
    real(c_float) :: single(toron_hyperelastic_properties)
    type(toron_table_row) :: row
    integer(c_int32_t) :: status
    call check(toron_abi_version() == toron_module_abi_version, 'ABI', 0)
    call check(scan(toron_version(), '.') > 1, 'version', 0)
    call check(verify(toron_version(), '0123456789.-abcdefghijklmnopqrstuvwxyz') == 0, toron_version(), 0)
    call check(toron_status_message(toron_status_inverted) == inverted, 'meaning of a code', 0)
    call check(index(toron_status_message(-1), '-1') > 0, 'a code that does not exist', 0)
    call check(toron_property_count(toron_hyperelastic) == size(values), 'count', 0)
    call check(toron_state_count(toron_linear_elastic) == toron_linear_elastic_state, 'count', 0)
    call check(toron_property(toron_hyperelastic, 2, row) == toron_status_ok, 'row', 0)
    call check(toron_text(row%name) == 'p' .and. toron_text(row%meaning) == 'transverse compaction exponent', 'p', 0)
    call check(abs(row%minimum - 1) + abs(row%maximum - 40) <= 0 .and. row%minimum_excluded == 1, 'bounds of p', 0)
    call check(toron_text(['a', 'b']) == 'ab' .and. len(toron_text(row%name)) == 1, 'text', 0)
    call check(toron_property_index(toron_hyperelastic, 'eps_lim') == 5, 'eps_lim', 0)
    call check(toron_state_variable(toron_hyperelastic, 10, row) == toron_status_ok, 'row', 0)
    call check(toron_text(row%name) == 'alive', 'alive', 0)
    call check(toron_state_index(toron_hyperelastic, 'failed  ') == 9, 'failed', 0)

    status = toron_preset('kevlar-km2-600', 'mm-kg-ms', values, density, message)
    call check(status == toron_status_ok .and. message == '', 'preset', 0)
    call check(abs(values(1) - 82.341_c_double) < 1e-14_c_double, 'k_el', 0)
    call check(abs(density - 1.3514e-6_c_double) < 1e-20_c_double, 'density', 0)
    status = toron_preset('kevlar-km2-600', 'si', single)
    call check(status == toron_status_ok .and. abs(single(1) - 82.341e9_c_float) <= 0, 'preset in single precision', 0)
  end subroutine

  subroutine messages
    real(c_double) :: values(toron_hyperelastic_properties)
    real(c_double), target :: rest(9)
    character(12) :: short
    type(toron_hyperelastic_f64) :: law
    type(toron_hyperelastic_f32) :: single
    type(toron_point_f64) :: p
    type(toron_table_row) :: row
    integer(c_int32_t) :: status
    values = table(1)%properties
    values(3) = 0.5
    status = toron_hyperelastic_prepare(law, values, message)
    call check(status == toron_status_property_out_of_bounds .and. message == wrong_exponent, message, 1)
    status = toron_hyperelastic_prepare(single, real(values, c_float), message)
    call check(status == toron_status_property_out_of_bounds .and. message == wrong_exponent, message, 2)
    status = toron_hyperelastic_prepare(law, values, short)
    call check(status == toron_status_property_out_of_bounds .and. short == 'property 3', short, 3)
    status = toron_hyperelastic_prepare(law, values, message(1:0))
    call check(status == toron_status_property_out_of_bounds, 'no room at all', 4)
    status = toron_hyperelastic_prepare(law, values(:10), message)
    call check(status == toron_status_property_count, message, 5)
    call check(message == 'number of properties: 10 given, 11 needed', message, 5)
    status = toron_hyperelastic_point(law, p, message)
    call check(status == toron_status_not_prepared, message, 6)
    call check(message == 'the law has not been prepared by toron_hyperelastic_prepare_f64', message, 6)
    values(3) = 2
    status = toron_hyperelastic_prepare(law, values, message)
    call check(status == toron_status_ok .and. message == '', message, 7)
    status = toron_hyperelastic_point(law, p, message)
    call check(status == toron_status_null_argument .and. index(message, 'deformation_gradient') > 0, message, 8)
    rest = [1, 0, 0, 0, 1, 0, 0, 0, 1]
    p%deformation_gradient = c_loc(rest)
    p%size = 0
    status = toron_hyperelastic_point(law, p, message)
    call check(status == toron_status_bad_size .and. index(message, 'toron_point_f64') > 0, message, 9)
    status = toron_property_count(7, message)
    call check(status == toron_status_unknown_name .and. message == 'argument law is 7; allowed: 0 to 2', message, 10)
    status = toron_property(toron_hyperelastic, 11, row, message)
    call check(status == toron_status_unknown_name, message, 11)
    call check(message == 'argument index is 11; allowed: 0 to 10', message, 11)
    status = toron_state_index(toron_hyperelastic, 'dead', message)
    call check(status == toron_status_unknown_name, message, 12)
    call check(index(message, 'there is no state variable "dead"; ') == 1, message, 12)
    status = toron_preset('kevlar', 'si', values, message=message)
    call check(status == toron_status_unknown_name, message, 13)
    call check(index(message, 'there is no preset "kevlar"; ') == 1, message, 13)
  end subroutine

  subroutine stability
    real(c_double) :: values(toron_hyperelastic_properties), least, direction(3)
    real(c_double), target :: rest(9)
    type(toron_hyperelastic_f64) :: law
    type(toron_point_f64) :: p
    call check(toron_preset('kevlar-km2-600', 'mm-kg-ms', values) == toron_status_ok, 'preset', 0)
    values(5) = 1
    call check(toron_hyperelastic_prepare(law, values) == toron_status_ok, 'prepare', 0)
    rest = [1, 0, 0, 0, 1, 0, 0, 0, 1]
    p%deformation_gradient = c_loc(rest)
    call check(toron_hyperelastic_least_acoustic_eigenvalue(law, p, least) == toron_status_ok, 'eigenvalue', 0)
    call check(toron_hyperelastic_least_acoustic_eigenvalue(law, p, least, direction) == toron_status_ok, 'normal', 0)
    call check(least > -1e-9_c_double * values(1), 'stable at rest', 0)
    call check(abs(norm2(direction) - 1) < 1e-12_c_double, 'a unit normal', 0)
  end subroutine

  subroutine linear_elastic
    real(c_double) :: values(toron_linear_elastic_properties)
    real(c_double), target :: axes(9), state(10), stress(6), strain(6), f(9), rest(9), tangent(6, 6), speed
    real(c_float), target :: single_axes(9), single_f(9), single_rest(9), single_stress(6), single_strain(6)
    type(toron_linear_elastic_f64) :: law
    type(toron_linear_elastic_f32) :: single
    type(toron_linear_point_f64) :: p
    type(toron_linear_point_f32) :: q
    type(toron_linear_increment_f64) :: increment
    type(toron_linear_increment_f32) :: single_increment
    integer :: c
    call check(toron_preset('kevlar-km2-600-linear', 'mm-kg-ms', values) == toron_status_ok, 'preset', 0)
    call check(toron_linear_elastic_prepare(law, values, message) == toron_status_ok .and. message == '', 'prepare', 0)
    call check(toron_linear_elastic_prepare(single, real(values, c_float)) == toron_status_ok, 'prepare', 0)
    call check(toron_linear_elastic_axes(law, axes=axes) == toron_status_ok, 'axes', 0)
    call check(abs(axes(1) - 1) <= 0, 'the first axis is the fibre', 0)
    call check(toron_linear_elastic_axes(single, [0.0_c_float, 2.0_c_float, 0.0_c_float], &
      [0.0_c_float, 0.0_c_float, 1.0_c_float], single_axes) == toron_status_ok, 'axes of a point', 0)
    call check(all(abs(single_axes - [0, 1, 0, 0, 0, 1, 1, 0, 0]) <= 0), 'axes of a point', 0)

    ! The tangent at rest is the stiffness.
    rest = [1, 0, 0, 0, 1, 0, 0, 0, 1]
    f = rest
    p%rotation = toron_rotation_spin
    p%criterion = toron_criterion_principal
    p%measure = toron_tangent_jaumann
    p%density = 1.0e-6_c_double
    p%f_old = c_loc(rest)
    p%f_new = c_loc(f)
    p%axes = c_loc(axes)
    p%state_new = c_loc(state)
    p%stress = c_loc(stress)
    p%wave_speed = c_loc(speed)
    p%tangent = c_loc(tangent)
    call check(toron_linear_elastic_point(law, p, message) == toron_status_ok .and. message == '', 'at rest', 0)
    do c = 1, 6
      tangent(c, c) = tangent(c, c) - values(merge(1, merge(2, 3, c < 4), c == 1))
    end do
    call check(maxval(abs(tangent)) <= 1e-13_c_double, 'tangent', 0)
    call check(speed >= sqrt(values(1) / 1.0e-6_c_double) * (1 - 1e-12_c_double), 'wave speed', 0)

    f(1) = 1.02_c_double
    p%tangent = c_null_ptr
    call check(toron_linear_elastic_point(law, p) == toron_status_ok, 'point', 0)
    call check(abs(stress(1) - values(1) * log(f(1))) < 1e-14_c_double * values(1), 'stress', 0)
    p%rotation = toron_rotation_fibre
    call check(toron_linear_elastic_point_with_properties(values, p) == toron_status_ok, 'properties', 0)
    call check(abs(stress(1) - values(1) * log(f(1))) < 1e-14_c_double * values(1), 'stress', 0)
    single_rest = real(rest, c_float)
    single_f = real(f, c_float)
    q%f_old = c_loc(single_rest)
    q%f_new = c_loc(single_f)
    q%stress = c_loc(single_stress)
    call check(toron_linear_elastic_point(single, q) == toron_status_ok, 'point in single precision', 0)
    call check(abs(single_stress(1) / real(stress(1), c_float) - 1) < 1e-5, 'stress in single precision', 0)
    call check(toron_linear_elastic_point_with_properties(real(values, c_float), q) == toron_status_ok, 'properties', 0)
    call check(abs(single_stress(1) / real(stress(1), c_float) - 1) < 1e-5, 'stress in single precision', 0)

    strain = [1e-3_c_double, 0.0_c_double, 0.0_c_double, 0.0_c_double, 0.0_c_double, 0.0_c_double]
    increment%criterion = toron_criterion_fibre
    increment%strain = c_loc(strain)
    increment%state_new = c_loc(state)
    increment%stress = c_loc(stress)
    call check(toron_linear_elastic_increment(law, increment) == toron_status_ok, 'increment', 0)
    call check(abs(stress(1) - values(1) * 1e-3_c_double) < 1e-15_c_double, 'stress', 0)
    single_strain = real(strain, c_float)
    single_increment%strain = c_loc(single_strain)
    single_increment%stress = c_loc(single_stress)
    call check(toron_linear_elastic_increment(single, single_increment) == toron_status_ok, 'increment', 0)
    call check(abs(single_stress(1) / real(stress(1), c_float) - 1) < 1e-6, 'stress in single precision', 0)
    f(1) = -1
    call check(toron_linear_elastic_point(law, p, message) == toron_status_inverted &
      .and. message == inverted, message, 0)
  end subroutine

  ! Points that are pulled along their own fibre directions: the stress along the fibre is E1 ln lambda.
  subroutine linear_elastic_block
    integer, parameter :: n = 13
    real(c_double) :: values(toron_linear_elastic_properties), angle, m(3), wanted
    real(c_double), target :: rest(9, n), f(9, n), fibre(3, n), stress(n, 6), state(n, 10)
    real(c_float), target :: single_rest(9, n), single_f(9, n), single_fibre(3, n), single_stress(n, 6)
    type(toron_linear_elastic_f64) :: law
    type(toron_linear_elastic_f32) :: single
    type(toron_linear_block_f64) :: block
    type(toron_linear_block_f32) :: single_block
    integer :: c
    call check(toron_preset('kevlar-km2-600-linear', 'mm-kg-ms', values) == toron_status_ok, 'preset', 0)
    values(4) = 0
    call check(toron_linear_elastic_prepare(law, values) == toron_status_ok, 'prepare', 0)
    call check(toron_linear_elastic_prepare(single, real(values, c_float)) == toron_status_ok, 'prepare', 0)
    do i = 1, n
      angle = 0.3_c_double * i
      fibre(:, i) = [cos(angle), sin(angle), 0.0_c_double]
      rest(:, i) = [1, 0, 0, 0, 1, 0, 0, 0, 1]
      ! 1 + 0.001 i m m'
      f(:, i) = rest(:, i) + 1e-3_c_double * i * [(fibre(:, i) * fibre(c, i), c = 1, 3)]
    end do
    block%n = n
    block%f_old(1) = c_loc(rest)
    block%f_new(1) = c_loc(f)
    block%deformation_gradient_layout = toron_layout(1, 9)
    block%fibre(1) = c_loc(fibre)
    block%fibre_layout = toron_layout(1, 3)
    block%state_new = c_loc(state)
    block%stress(1) = c_loc(stress)
    call check(toron_linear_elastic_block(law, block, message) == toron_status_ok, message, 0)
    single_rest = real(rest, c_float)
    single_f = real(f, c_float)
    single_fibre = real(fibre, c_float)
    single_block%n = n
    single_block%f_old(1) = c_loc(single_rest)
    single_block%f_new(1) = c_loc(single_f)
    single_block%deformation_gradient_layout = toron_layout(1, 9)
    single_block%fibre(1) = c_loc(single_fibre)
    single_block%fibre_layout = toron_layout(1, 3)
    single_block%stress(1) = c_loc(single_stress)
    call check(toron_linear_elastic_block(single, single_block, message) == toron_status_ok, message, 0)
    do i = 1, n
      m = fibre(:, i)
      wanted = values(1) * log(1 + 1e-3_c_double * i)
      call check(abs(along(m, stress(i, :)) / wanted - 1) < 1e-12_c_double, 'stress', i)
      call check(abs(along(m, real(single_stress(i, :), c_double)) / wanted - 1) < 1e-3_c_double, 'stress', -i)
    end do
    single_stress = 0
    stress = 0
    call check(toron_linear_elastic_block_with_properties(values, block) == toron_status_ok, 'properties', 0)
    call check(toron_linear_elastic_block_with_properties(real(values, c_float), single_block) == toron_status_ok, &
      'properties', 0)
    call check(abs(along(m, stress(n, :)) / wanted - 1) < 1e-12_c_double, 'stress', n)
    call check(abs(along(m, real(single_stress(n, :), c_double)) / wanted - 1) < 1e-3_c_double, 'stress', -n)
  end subroutine

  ! The stress along a direction.
  real(c_double) function along(m, s)
    real(c_double), intent(in) :: m(3), s(6)
    along = dot_product(m**2, s(1:3)) + 2 * (m(1) * m(2) * s(4) + m(2) * m(3) * s(5) + m(3) * m(1) * s(6))
  end function

  ! The shims have interfaces of their own; here those of the module.
  subroutine entries_of_hosts(t)
    type(truth), intent(in) :: t
    real(c_double) :: stress(6), state(11), sse, pnewdt, zero(11), hsv(20), bulk, shear, tangent(36)
    real(c_float) :: single(6), single_hsv(20), single_tangent(36)
    integer(c_int) :: failel, failels(1)
    zero = 0
    state = 0
    pnewdt = 1
    call check(toron_abaqus_umat(stress, state, sse, pnewdt, t%f, t%properties, 11, 11, 3, 3, 1, message) &
      == toron_status_ok .and. message == '', 'umat', t%id)
    call check_answer(t, stress(abaqus), state, .false.)
    state = 0
    call check(toron_abaqus_umat_tangent(stress, state, tangent, sse, pnewdt, t%f, t%properties, 11, 11, 3, 3, 1) &
      == toron_status_ok, 'umat', t%id)
    call check_answer(t, stress(abaqus), state, .false.)
    call check_tangent(t, reshape(tangent, [6, 6]), .false.)
    call check(toron_abaqus_umat(stress, state, sse, pnewdt, t%f, t%properties, 10, 11, 3, 3, 1, message) &
      == toron_status_property_count .and. message == 'number of properties: 10 given, 11 needed', message, t%id)

    hsv = [zero, t%f]
    call check(toron_lsdyna_umat(t%properties, stress, hsv, 11, failel) == toron_status_ok, 'umat41', t%id)
    call check(failel == t%failed, 'failel', t%id)
    call check_answer(t, stress, hsv(1:11), .false.)
    hsv(10:11) = [0, 1]
    call check(toron_lsdyna_utan(t%properties, hsv, 11, tangent) == toron_status_ok, 'utan41', t%id)
    call check(any(abs(tangent) > 0), 'es', t%id)
    hsv = [zero, t%f]
    call check(toron_lsdyna_umat_vector(t%properties, stress(1:), stress(2:), stress(3:), stress(4:), stress(5:), &
      stress(6:), hsv, 11, 1, 1, 1, failels) == toron_status_ok, 'umat41v', t%id)
    call check(failels(1) == t%failed, 'failels', t%id)
    call check_answer(t, stress, hsv(1:11), .false.)
    hsv(10:11) = [0, 1]
    call check(toron_lsdyna_utan_vector(t%properties, hsv, 11, 1, 1, 1, tangent) == toron_status_ok, 'utan41v', t%id)

    single_hsv = real([zero, t%f], c_float)
    call check(toron_lsdyna_umat(real(t%properties, c_float), single, single_hsv, 11, failel) == toron_status_ok, &
      'umat41 in single precision', t%id)
    call check_answer(t, real(single, c_double), real(single_hsv(1:11), c_double), .true.)
    single_hsv(10:11) = [0, 1]
    call check(toron_lsdyna_utan(real(t%properties, c_float), single_hsv, 11, single_tangent) == toron_status_ok, &
      'utan41 in single precision', t%id)
    single_hsv = real([zero, t%f], c_float)
    call check(toron_lsdyna_umat_vector(real(t%properties, c_float), single(1:), single(2:), single(3:), single(4:), &
      single(5:), single(6:), single_hsv, 11, 1, 1, 1, failels) == toron_status_ok, 'umat41v in single precision', t%id)
    call check_answer(t, real(single, c_double), real(single_hsv(1:11), c_double), .true.)
    single_hsv(10:11) = [0, 1]
    call check(toron_lsdyna_utan_vector(real(t%properties, c_float), single_hsv, 11, 1, 1, 1, single_tangent) &
      == toron_status_ok, 'utan41v in single precision', t%id)

    call check(toron_lsdyna_bulk_and_shear(t%properties, bulk, shear) == toron_status_ok, 'moduli', t%id)
    call check(abs(bulk + 4 * shear / 3 - t%properties(1)) <= 1e-15_c_double * t%properties(1), 'moduli', t%id)
  end subroutine

  ! One point that is pulled by 2 %: the stress along the fibre is k_el ln lambda / J.
  subroutine vumat
    real(c_double), target :: properties(11), rest(6), stretch(6), stress(6), zero(11), state(11), one(1), energy(2)
    real(c_float), target :: single_properties(11), single_rest(6), single_stretch(6), single_stress(6)
    real(c_float), target :: single_zero(11), single_state(11), single_one(1), single_energy(2)
    type(toron_vumat_f64) :: block
    type(toron_vumat_f32) :: single
    properties = table(1)%properties
    properties(9:11) = [1, 0, 0]
    properties(6) = 0
    rest = [1, 1, 1, 0, 0, 0]
    stretch = [1.02_c_double, rest(2:)]
    zero = 0
    one = 1
    block = toron_vumat_f64(nblock=1, ndir=3, nshr=3, nstatev=11, nprops=11, step_time=1.0_c_double, &
      total_time=1.0_c_double, props=c_loc(properties), density=c_loc(one), strain_inc=c_loc(zero), &
      stretch_old=c_loc(rest), stretch_new=c_loc(stretch), stress_old=c_loc(zero), state_old=c_loc(zero), &
      ener_intern_old=c_loc(zero), ener_inelas_old=c_loc(zero), stress_new=c_loc(stress), state_new=c_loc(state), &
      ener_intern_new=c_loc(energy(1)), ener_inelas_new=c_loc(energy(2)))
    call check(toron_abaqus_vumat(block, message) == toron_status_ok .and. message == '', 'vumat', 0)
    call check(abs(stress(1) / (properties(1) * log(1.02_c_double) / 1.02_c_double) - 1) < 1e-12_c_double, 'vumat', 0)
    single_properties = real(properties, c_float)
    single_rest = real(rest, c_float)
    single_stretch = real(stretch, c_float)
    single_zero = 0
    single_one = 1
    single = toron_vumat_f32(nblock=1, ndir=3, nshr=3, nstatev=11, nprops=11, step_time=1.0_c_double, &
      total_time=1.0_c_double, props=c_loc(single_properties), density=c_loc(single_one), &
      strain_inc=c_loc(single_zero), stretch_old=c_loc(single_rest), stretch_new=c_loc(single_stretch), &
      stress_old=c_loc(single_zero), state_old=c_loc(single_zero), ener_intern_old=c_loc(single_zero), &
      ener_inelas_old=c_loc(single_zero), stress_new=c_loc(single_stress), state_new=c_loc(single_state), &
      ener_intern_new=c_loc(single_energy(1)), ener_inelas_new=c_loc(single_energy(2)))
    call check(toron_abaqus_vumat(single) == toron_status_ok, 'vumat in single precision', 0)
    call check(abs(single_stress(1) / real(stress(1), c_float) - 1) < 1e-5, 'vumat in single precision', 0)
    block%nshr = 2
    call check(toron_abaqus_vumat(block, message) == toron_status_bad_count, message, 0)
    call check(index(message, 'NSHR') > 0, message, 0)
  end subroutine
end program
