! The shims abaqus_vumat_dp.f and, with -DSINGLE, abaqus_vumat_sp.f, called as Abaqus/Explicit does.
program vumat_test
  use, intrinsic :: iso_c_binding, only: c_double, c_float
  use cases
  implicit none
  external :: vumat

#ifdef SINGLE
  integer, parameter :: wp = c_float
#else
  integer, parameter :: wp = c_double
#endif
  real(wp), parameter :: mark = -7.25
  integer, parameter :: guard = 4, nstatev = 12
  ! Where 11 22 33 12 23 31 stand among the columns of F.
  integer, parameter :: column(6) = [1, 5, 9, 4, 8, 3]
  real(wp), allocatable, dimension(:) :: stretch, density, state_old, stress_new, state_new, energy_new, inelastic_new
  real(wp) :: props(11), step_time
  character(len=80) :: material = 'FIBRE'
  integer, allocatable :: chosen(:)
  integer :: first, last, against_truth, i

  call read_cases
  open (unit=7, status='scratch')
  against_truth = 0
  step_time = 1
  first = 1
  do while (first <= number_of_cases)
    last = last_of_run(first)
    ! U is F where F is symmetric.
    chosen = pack([(i, i = first, last)], [(is_stretch(table(i)), i = first, last)])
    if (size(chosen) > 0) call compare
    against_truth = against_truth + size(chosen)
    first = last + 1
  end do
  call check(against_truth > 40, 'stretches in the truth', against_truth)
  call check(stops == 0, 'no stop', 0)

  ! A point that is inverted, not a number or too large is deleted, and does not stop the job.
  chosen = [1, 1, 1]
  do first = 1, 3
    call prepare
    if (first == 1) stretch(2) = -1
    if (first == 2) call put_nan(stretch(2))
    if (first == 3) stretch(2::3) = sqrt(huge(1.0_wp))
    call call_vumat(11, nstatev, 3)
    call check(stops == 0, 'a bad point does not stop the job', first)
    call check(all(state_new([3 * 9 + 2, 3 * 10 + 2]) == [1.0_wp, 0.0_wp]), 'it is deleted', first)
    call check(state_new(3 * 10 + 1) == 1 .and. state_new(3 * 10 + 3) == 1, 'its neighbours are not', first)
  end do

  ! The data check: the longitudinal wave is the fibre's.
  call prepare
  step_time = 0
  call call_vumat(11, nstatev, 3)
  call check(abs(stress_new(1) / (props(1) * 1e-4_wp) - 1) < 1e-6_wp, 'data check', 0)
  step_time = 1

  props(3) = 0.5
  call refused('property 3 (p, transverse compaction exponent) is 0.5; allowed: a number > 1, at most 40', 11, nstatev, 3)
  call refused('number of properties: 10 given, 11 needed', 10, nstatev, 3)
  props(3) = 2
  call refused('number of state variables (*DEPVAR): 10 given, 11 needed', 11, 10, 3)
  call refused('NSHR (1 for plane strain and axisymmetric solids): 2 given, 3 needed', 11, nstatev, 2)
  call check_written(7, 'material FIBRE:')
  call linear
  call plane
  call finish

contains

  logical function is_stretch(t)
    type(truth), intent(in) :: t
    is_stretch = t%f(2) == t%f(4) .and. t%f(3) == t%f(7) .and. t%f(6) == t%f(8)
  end function

  ! Ten properties and ten state variables: the linear elastic law, of two stretches in one increment.
  subroutine linear
    real(wp) :: along
    chosen = [1, 1]
    call prepare
    props(1:10) = real([79414.0, 794.0, 126.0, 1000.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0], wp)
    stretch = [1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, 1.01_wp, 1.02_wp, spread(0.0_wp, 1, 6)]
    call call_vumat(10, 10, 3)
    along = 79414 * log(1.01_wp)
    call check(abs(stress_new(5) - along) < 1e5_wp * epsilon(along) * along, 'linear: stress', 1)
    call check(abs(stress_new(6) - 79414 * log(1.02_wp)) < 1e5_wp * epsilon(along) * along, 'linear: stress', 2)
    call check(all(abs(stress_new([1, 2, 3, 4, 7, 8, 9, 10, 11, 12])) < 1e-3_wp * along), 'linear: other stress', 0)
    ! Only the second one has reached 1000.
    call check(all(state_new([17, 18, 19, 20]) == [0.0_wp, 1.0_wp, 1.0_wp, 0.0_wp]), 'linear: failed, alive', 0)
  end subroutine

  ! Plane strain: the four components of a stretch in the plane are those of the solid.
  subroutine plane
    real(wp) :: solid(4)
    chosen = [1]
    call prepare
    stretch = real([1.01, 0.95, 1.0, 0.02, 0.0, 0.0], wp)
    props(9:11) = real([1, 0, 0], wp)
    call call_vumat(11, nstatev, 3)
    solid = stress_new(1:4)
    call prepare
    stretch = real([1.01, 0.95, 1.0, 0.02], wp)
    props(9:11) = real([1, 0, 0], wp)
    ! Elements of plane stress and shells have the same numbers.
    stops = 0
    call call_vumat(11, nstatev, 1)
    call check(stops == 1 .and. all(stress_new == mark), 'plane stress', 0)
    call check_written(7, 'let the name of the material end in _PSTRAIN or _AXIS')
    call prepare
    stretch = real([1.01, 0.95, 1.0, 0.02], wp)
    props(9:11) = real([1, 0, 0], wp)
    material = 'YARN_AXIS'
    call call_vumat(11, nstatev, 1)
    call check(all(stress_new(1:4) == solid), 'axisymmetric', 0)
    call prepare
    stretch = real([1.01, 0.95, 1.0, 0.02], wp)
    props(9:11) = real([1, 0, 0], wp)
    material = 'YARN_PSTRAIN'
    call call_vumat(11, nstatev, 1)
    call check(stops == 1, 'plane strain', 0)
    call check(all(stress_new(1:4) == solid) .and. all(stress_new(5:) == mark), 'plane: four components', 0)
    call check(solid(1) > 0, 'plane: stress', 0)
  end subroutine

  subroutine prepare
    integer :: n, k
    n = size(chosen)
    stretch = [((real(table(chosen(i))%f(column(k)), wp), i = 1, n), k = 1, 6)]
    density = [(1.0_wp, i = 1, n)]
    state_old = [(0.0_wp, i = 1, nstatev * n)]
    stress_new = framed(6 * n)
    state_new = framed(nstatev * n)
    energy_new = framed(n)
    inelastic_new = framed(n)
    props = real(table(chosen(1))%properties, wp)
  end subroutine

  ! n values between marks.
  function framed(n) result(array)
    integer, intent(in) :: n
    real(wp), allocatable :: array(:)
    allocate (array(n + 2 * guard), source=mark)
  end function

  ! Checks the marks and drops them.
  subroutine unframe(array)
    real(wp), allocatable, intent(inout) :: array(:)
    integer :: n
    n = size(array) - 2 * guard
    call check(all(array(:guard) == mark) .and. all(array(guard + n + 1:) == mark), 'marks', n)
    array = array(guard + 1:guard + n)
  end subroutine

  subroutine call_vumat(nprops, nstates, nshr)
    integer, intent(in) :: nprops, nstates, nshr
    real(wp), allocatable, dimension(:) :: zero, strain, stretch_old
    integer :: n
    n = size(chosen)
    allocate (zero(9 * n), source=0.0_wp)
    strain = zero
    strain(1:n) = 1e-4_wp
    ! Every increment starts from rest.
    stretch_old = zero
    stretch_old(1:3 * n) = 1
    call vumat(n, 3, nshr, nstates, 0, nprops, 0, step_time, step_time, zero, material, zero, zero, props, density, &
      strain, zero, zero, stretch_old, zero, zero, zero, state_old, zero, zero, zero, stretch, zero, zero, &
      stress_new(guard + 1), state_new(guard + 1), energy_new(guard + 1), inelastic_new(guard + 1))
    call unframe(stress_new)
    call unframe(state_new)
    call unframe(energy_new)
    call unframe(inelastic_new)
  end subroutine

  subroutine compare
    integer :: n, k
    n = size(chosen)
    call prepare
    call call_vumat(11, nstatev, 3)
    do i = 1, n
      call check_answer(table(chosen(i)), real([(stress_new((k - 1) * n + i), k = 1, 6)], c_double), &
        real([(state_new((k - 1) * n + i), k = 1, 11)], c_double), wp == c_float)
    end do
    call check(all(state_new(11 * n + 1:) == 0), 'the state that is not the law''s goes over', 0)
    call check(all(inelastic_new == 0), 'no inelastic energy', 0)
  end subroutine

  subroutine refused(message, nprops, nstates, nshr)
    character(len=*), intent(in) :: message
    integer, intent(in) :: nprops, nstates, nshr
    integer :: before
    real(wp) :: kept(11)
    before = stops
    kept = props
    call prepare
    props = kept
    call call_vumat(nprops, nstates, nshr)
    call check(stops == before + 1, 'stop: ' // message, 0)
    call check_written(7, message)
    call check(all(stress_new == mark), 'nothing is written: ' // message, 0)
  end subroutine
end program
