! The shim abaqus_umat.f, called as Abaqus/Standard does.
program umat_test
  use, intrinsic :: iso_c_binding, only: c_double
  use cases
  implicit none
  external :: umat

  real(c_double), parameter :: mark = -7.25
  integer, parameter :: guard = 4
  ! With room around what the routine may touch.
  real(c_double) :: stress(1 - guard:6 + guard), statev(1 - guard:12 + guard), ddsdde(1 - guard:36 + guard)
  real(c_double) :: sse(1 - guard:1 + guard), pnewdt(1 - guard:1 + guard)
  real(c_double) :: props(11), f(9), f_old(9)
  integer :: nlgeom
  integer :: i

  call read_cases
  open (unit=7, status='scratch')
  do i = 1, number_of_cases
    call prepare(table(i))
    call call_umat(11, 12, 3, 3)
    ! Abaqus/Standard has 11 22 33 12 13 23.
    call check_answer(table(i), stress([1, 2, 3, 4, 6, 5]), statev(1:11), .false.)
    call check_guards
    call check_tangent(table(i), reshape(ddsdde(1:36), [6, 6]), .false.)
    call check(all(ddsdde(:0) == mark) .and. all(ddsdde(37:) == mark), 'around DDSDDE', i)
    call check(statev(12) == mark, 'a state variable that is not the law''s', i)
    call check(pnewdt(1) == 1, 'PNEWDT', i)
  end do
  call check(stops == 0, 'no stop', 0)

  ! Plane strain and axisymmetric solids: 11 22 33 12, with the fibre in the plane or normal to it.
  do i = 1, number_of_cases
    call prepare(table(i))
    if (props(11) /= 0 .and. any(props(9:10) /= 0)) cycle
    call call_umat(11, 12, 3, 1)
    call check(all(stress(5:) == mark) .and. all(ddsdde(17:) == mark), 'four components', i)
    call plane(table(i))
  end do

  ! A point that is inverted, not a number or too large asks for a smaller increment and says nothing.
  do i = 1, 3
    call prepare(table(1))
    if (i == 1) f(1:3) = -f(1:3)
    if (i == 2) call put_nan(f(5))
    if (i == 3) f = f * sqrt(huge(f))
    call call_umat(11, 12, 3, 3)
    call check(stops == 0 .and. pnewdt(1) == 0.25, 'a smaller increment', i)
    call check(all(stress(1:6) == 0) .and. all(ddsdde(1:36) == 0), 'no stress, no stiffness', i)
  end do

  call refused('NLGEOM', 11, 12, 3)
  call prepare(table(1))
  props(3) = 0.5
  call refused('property 3 (p, transverse compaction exponent) is 0.5; allowed: a number > 1, at most 40', 11, 12, 3)
  call refused('number of properties: 10 given, 11 needed', 10, 12, 3)
  props(3) = 2
  call refused('number of state variables (*DEPVAR): 10 given, 11 needed', 11, 10, 3)
  call refused('NSHR (1 for plane strain and axisymmetric solids): 2 given, 3 needed', 11, 12, 2)
  props(9:11) = real([0.6, 0.0, 0.8], c_double)
  call refused('; allowed: a direction in the plane (third component 0)', 11, 12, 1)
  call check_written(7, 'material FIBRE:')
  call linear
  call finish

contains

  ! Four components are four of the six.
  subroutine plane(t)
    type(truth), intent(in) :: t
    real(c_double) :: four(4), matrix(4, 4), six(6, 6)
    four = stress(1:4)
    matrix = reshape(ddsdde(1:16), [4, 4])
    call prepare(t)
    call call_umat(11, 12, 3, 3)
    six = reshape(ddsdde(1:36), [6, 6])
    call check(all(four == stress(1:4)) .and. all(matrix == six(1:4, 1:4)), 'of the six', t%id)
  end subroutine

  ! Ten properties and ten state variables: the linear elastic law, which reads F at the start of the increment too. Along the
  ! fibre its stress is E1 ln(lambda), whatever the increments are.
  subroutine linear
    real(c_double), parameter :: stretches(3) = [1.0_c_double, 1.01_c_double, 1.03_c_double]
    real(c_double) :: along
    integer :: step, shear
    stops = 0
    do shear = 3, 1, -2
      call prepare(table(1))
      props(1:10) = [79414.0_c_double, 794.0_c_double, 126.0_c_double, 0.0_c_double, 0.0_c_double, 2.0_c_double, 0.0_c_double, &
        0.0_c_double, 0.0_c_double, 0.0_c_double]
      do step = 1, 2
        f_old = [1, 0, 0, 0, 1, 0, 0, 0, 1]
        f = f_old
        f_old(5) = stretches(step)
        f(5) = stretches(step + 1)
        call call_umat(10, 10, 3, shear)
        along = 79414 * log(stretches(step + 1))
        call check(abs(stress(2) - along) < 1e-12_c_double * along, 'linear: stress', step)
        call check(all(abs(stress([1, 3, 4])) < 1e-12_c_double * along), 'linear: other stress', step)
        call check(abs(ddsdde(shear + 5) - 79414 - along) < 1e-9_c_double * along, 'linear: DDSDDE', step)
        call check(abs(statev(8) - 0.5_c_double * along * log(stretches(step + 1)) * 1.01) < 0.02 * statev(8), 'linear: work', step)
      end do
      call check(all(stress(4 + shear:) == mark), 'linear: four components', shear)
    end do
    call check(stops == 0 .and. pnewdt(1) == 1, 'linear: no stop', 0)
    props(2) = -1
    call refused('property 2 (e_2, ', 10, 10, 3)
    call refused('NDI (solids only): 2 given, 3 needed', 10, 10, -1)
  end subroutine

  subroutine prepare(t)
    type(truth), intent(in) :: t
    stress = mark
    statev = mark
    statev(1:11) = 0
    ddsdde = mark
    sse = mark
    pnewdt = mark
    pnewdt(1) = 1
    props = t%properties
    f = t%f
    f_old = mark
    nlgeom = 1
  end subroutine

  subroutine call_umat(nprops, nstatv, ndi, nshr)
    integer, intent(in) :: nprops, nstatv, ndi, nshr
    real(c_double) :: zero(36)
    integer :: jstep(4)
    character(len=80) :: cmname
    cmname = 'FIBRE'
    zero = 0
    jstep = 1
    jstep(3) = nlgeom
    call umat(stress(1), statev(1), ddsdde(1), sse(1), zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, &
      zero, zero, zero, zero, cmname, ndi, nshr, ndi + nshr, nstatv, props, nprops, zero, zero, pnewdt(1), zero, f_old, &
      f, 1, 1, 1, 1, jstep, 1)
  end subroutine

  subroutine check_guards
    call check(all(stress(:0) == mark) .and. all(stress(7:) == mark), 'around STRESS', 0)
    call check(all(statev(:0) == mark) .and. all(statev(13:) == mark), 'around STATEV', 0)
    call check(all(sse(:0) == mark) .and. all(sse(2:) == mark), 'around SSE', 0)
    call check(all(pnewdt(:0) == mark) .and. all(pnewdt(2:) == mark), 'around PNEWDT', 0)
  end subroutine

  ! A wrong deck stops the job with this message, and nothing is written.
  subroutine refused(message, nprops, nstatv, nshr)
    character(len=*), intent(in) :: message
    integer, intent(in) :: nprops, nstatv, nshr
    integer :: before
    before = stops
    stress = mark
    f = [1, 0, 0, 0, 1, 0, 0, 0, 1]
    nlgeom = merge(0, 1, message == 'NLGEOM')
    ! Plane stress has two direct components.
    call call_umat(nprops, nstatv, merge(2, 3, nshr < 0), abs(nshr))
    call check(stops == before + 1, 'stop: ' // message, 0)
    call check_written(7, message)
    call check(all(stress == mark), 'nothing is written: ' // message, 0)
  end subroutine
end program
