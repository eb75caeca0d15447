! What the solver itself has.
module solver_side
  implicit none
  ! How often the nodes of a group have been asked for: of two elements, then of three.
  integer :: node_calls = 0
end module

subroutine arret(code)
  use cases, only: check, stops
  implicit none
  integer, intent(in) :: code
  call check(code == 2, 'ARRET', code)
  stops = stops + 1
end subroutine

! Bricks that go from y = 0 to y = 3.
subroutine mat_solid_get_nod_x(x)
  use law_userso, only: my_real
  use solver_side
  implicit none
  real(my_real), intent(inout) :: x(*)
  integer :: i, node, n
  node_calls = node_calls + 1
  n = merge(2, 3, node_calls == 1)
  do node = 0, 7
    do i = 1, n
      x(i + n * node) = mod(node, 2)
      x(i + n * (node + 8)) = merge(0, 3, node < 4)
      x(i + n * (node + 16)) = mod(node / 2, 2)
    end do
  end do
end subroutine

! The shims openradioss_lecmuser.f and openradioss_luser.f, called as OpenRadioss's SDK does, in the build's kind of reals.
program openradioss_test
  use, intrinsic :: iso_c_binding, only: c_double, c_float, c_int32_t
  use cases
  use law_user, only: ulawbuf
  use law_userso, only: my_real, mvsiz, ulawintbuf
  use solver_side
  implicit none
  external :: lecmuser01, lecmuser02, luser01, luser02

  real(my_real), parameter :: mark = -7.25
  logical, parameter :: single = my_real == c_float
  integer, parameter :: nuvar = 18, room = 40
  character(len=20), parameter :: full(5) = [character(len=20) :: '8.2341000000000D+04', '1.055000000000000e03', '2.2', &
    '649.74', '']
  type(ulawintbuf) :: userbuf
  type(ulawbuf) :: starterbuf
  real(my_real) :: uparam(room), parmat(100)
  integer :: nuparam, first, last

  close (6)
  open (unit=6, status='scratch')
  call read_cases
  call materials
  first = 1
  do while (first <= number_of_cases)
    last = min(last_of_run(first), first + 127)
    call compare
    first = last + 1
  end do
  call check(stops == 0, 'no stop', 0)
  call no_gradient
  call from_nodes
  call finish

contains

  ! A card as the starter's scratch file has it; returns the number of state variables.
  integer function read_material(number, lines) result(variables)
    integer, intent(in) :: number
    character(len=*), intent(in) :: lines(:)
    integer :: ifunc(1), nfunc, i
    open (unit=30, status='scratch')
    do i = 1, size(lines)
      write (30, '(a)') trim(lines(i))
    end do
    rewind (30)
    uparam = mark
    parmat = mark
    variables = -1
    nfunc = -1
    if (number == 1) call lecmuser01(30, 31, uparam, room, nuparam, variables, ifunc, 1, nfunc, parmat, starterbuf)
    if (number == 2) call lecmuser02(30, 31, uparam, room, nuparam, variables, ifunc, 1, nfunc, parmat, starterbuf)
    if (stops == 0) call check(nfunc == 0, 'nfunc', number)
    close (30)
  end function

  subroutine materials
    character(len=100) :: lines(3)
    open (unit=31, status='scratch')
    write (lines(1), '(5a20)') full
    write (lines(2), '(5a20)') '0.0458', '1.8', '', '1', ''
    lines(3) = ''
    call check(read_material(1, lines) == nuvar .and. nuparam == 14, 'the hyperelastic card', 1)
    call check(all(abs(uparam(1:14) - real([1., 82341., 1055., 2.2, 649.74, 0., 0.0458, 1.8, &
      0., 1., 0., 0., 0., 0.], my_real)) &
      < 1e-3), 'UPARAM', 1)
    call check(all(uparam(15:) == mark), 'behind UPARAM', 1)
    call check(abs(parmat(1) - 82341) < 0.1 .and. all(parmat(2:) == mark), 'PARMAT', 1)
    call check_written(31, 'hyperelastic yarn law')
    call check_written(31, '/PROP/TYPE14 (/PROP/SOLID) with Isolid = 1, Ismstr = 10, Iframe = 1')
    call check_written(31, '15 deleted')
    write (lines(1), '(5a20)') '79414', '794', '126', '3637', '1'
    call check(read_material(2, lines(:2)) == 26 .and. nuparam == 15, 'the linear elastic card', 2)
    call check_written(31, '23 F33_old')
    call check(stops == 0, 'no stop', 1)
    write (lines(1), '(5a20)') full
    write (lines(2), '(5a20)') '0.0458', '1.8 0', '', '1', ''
    call check(read_material(1, lines) == -1, 'a blank in a number', 1)
    call check_stop('the card has "1.8 0" in a field of 20 columns; allowed: one number')
    write (lines(1), '(5a20)') '82341', '1055', '0.5', '649.74', ''
    write (lines(2), '(5a20)') '0.0458', '1.8', '', '1', ''
    call check(read_material(1, lines) == -1, 'a wrong property', 1)
    call check_stop('property 3 (p, transverse compaction exponent) is 0.5; allowed: a number > 1, at most 40')
    close (31)
  end subroutine

  ! A group as the engine passes it: what is not read is no number, what is beyond the group a mark.
  subroutine call_engine(number, nel, variables, uvar, soundsp, off, time)
    integer, intent(in) :: number, nel, variables
    real(my_real), intent(inout) :: uvar(*), soundsp(*), off(*)
    real(my_real), intent(in) :: time
    real(my_real) :: nan(mvsiz), step, viscmax(nel)
    integer :: ngl(nel), ifunc(1), npf(1), i
    call put_nan(nan(1))
    nan = nan(1)
    step = 0
    viscmax = mark
    ngl = [(5000 + i, i=1, nel)]
    if (number == 1) call luser01(nel, nuparam, variables, 0, ifunc, npf, nan, time, step, uparam, nan, nan, nan, ngl, &
      soundsp, viscmax, uvar, off, nan, nan, userbuf)
    if (number == 2) call luser02(nel, nuparam, variables, 0, ifunc, npf, nan, time, step, uparam, nan, nan, nan, ngl, &
      soundsp, viscmax, uvar, off, nan, nan, userbuf)
    if (stops == 0) call check(all(viscmax == 0) .and. all(userbuf%sigvzz(:nel) == 0), 'viscosity', nel)
  end subroutine

  ! F by columns of element i.
  subroutine set_gradient(i, f)
    integer, intent(in) :: i
    real(c_double), intent(in) :: f(9)
    userbuf%fpsxx(i) = real(f(1), my_real)
    userbuf%fpsyx(i) = real(f(2), my_real)
    userbuf%fpszx(i) = real(f(3), my_real)
    userbuf%fpsxy(i) = real(f(4), my_real)
    userbuf%fpsyy(i) = real(f(5), my_real)
    userbuf%fpszy(i) = real(f(6), my_real)
    userbuf%fpsxz(i) = real(f(7), my_real)
    userbuf%fpsyz(i) = real(f(8), my_real)
    userbuf%fpszz(i) = real(f(9), my_real)
  end subroutine

  subroutine mark_stress
    userbuf%signxx = mark
    userbuf%signyy = mark
    userbuf%signzz = mark
    userbuf%signxy = mark
    userbuf%signyz = mark
    userbuf%signzx = mark
    userbuf%sigvzz = mark
    userbuf%rho0 = 1
  end subroutine

  function stress_of(i) result(stress)
    integer, intent(in) :: i
    real(c_double) :: stress(6)
    stress = real([userbuf%signxx(i), userbuf%signyy(i), userbuf%signzz(i), userbuf%signxy(i), userbuf%signyz(i), &
      userbuf%signzx(i)], c_double)
  end function

  ! Cases of the truth with the same properties, as a group.
  subroutine compare
    real(my_real) :: uvar(last - first + 1, nuvar), soundsp(last - first + 1), off(last - first + 1)
    integer :: n, i
    n = last - first + 1
    nuparam = 14
    uparam(1) = 1
    uparam(2:12) = real(table(first)%properties, my_real)
    uparam(13:14) = 0
    call mark_stress
    do i = 1, n
      call set_gradient(i, table(first + i - 1)%f)
    end do
    uvar = 0
    off = 1
    soundsp = mark
    call call_engine(1, n, nuvar, uvar, soundsp, off, 1e-6_my_real)
    do i = 1, n
      associate (t => table(first + i - 1))
        call check_answer(t, stress_of(i), real(uvar(i, 1:11), c_double), single)
        call check(off(i) == uvar(i, 11) .and. uvar(i, 15) == uvar(i, 10), 'OFF and deleted', t%id)
        call check(soundsp(i) > 0, 'sound speed', t%id)
      end associate
    end do
    call check(all(userbuf%signxx(n + 1:) == mark) .and. all(userbuf%signzx(n + 1:) == mark), 'beyond the group', first)
  end subroutine

  ! Any Ismstr but 10.
  subroutine no_gradient
    real(my_real) :: uvar(2, nuvar), soundsp(2), off(2)
    real(c_double) :: zero(9)
    integer :: i
    zero = 0
    do i = 1, 2
      call set_gradient(i, zero)
    end do
    uvar = 0
    off = 1
    call call_engine(1, 2, nuvar, uvar, soundsp, off, 0.0_my_real)
    call check_stop('/PROP/TYPE14 (/PROP/SOLID) with Isolid = 1, Ismstr = 10, Iframe = 1')
    call check(all(off == 1), 'no element is deleted', 1)
  end subroutine

  ! The fibre from the nodes, along y, and a stretch of 2 % along it in the second cycle, in both laws.
  subroutine from_nodes
    real(my_real) :: uvar(3, 26), soundsp(3), off(3)
    real(c_double) :: f(9), expected, stress(6)
    integer :: i, number, variables, cycle
    do number = 1, 2
      variables = merge(nuvar, 26, number == 1)
      uparam(:14) = merge([1., 82341., 1055., 2.2, 649.74, 0., 0., 0., 0., 1., 0., 0., 1., 0.], &
        [2., 79414., 794., 126., 0., 1., 0., 0., 0., 0., 0., 1., 0., 0.], number == 1)
      uparam(15) = 0
      nuparam = merge(14, 15, number == 1)
      uvar = 0
      off = 1
      do cycle = 0, 1
        f = [1.0_c_double, 0.0_c_double, 0.0_c_double, 0.0_c_double, 1 + 0.02_c_double * cycle, 0.0_c_double, 0.0_c_double, &
          0.0_c_double, 1.0_c_double]
        call mark_stress
        do i = 1, 3
          call set_gradient(i, f)
        end do
        call call_engine(number, 3, variables, uvar, soundsp, off, real(cycle, my_real))
      end do
      expected = merge(82341 / 1.02_c_double, 79414.0_c_double, number == 1) * log(1.02_c_double)
      do i = 1, 3
        stress = stress_of(i)
        call check(abs(stress(2) - expected) < 1e-4 * expected, 'stress along the fibre', number)
      end do
    end do
    call check(node_calls == 3, 'the nodes are asked for in first cycles alone', node_calls)
    call check(stops == 0, 'no stop', 2)
  end subroutine

  ! One stop since the last look, with this message.
  subroutine check_stop(message)
    character(len=*), intent(in) :: message
    call check(stops == 1, message, stops)
    call check_written(6, message)
    stops = 0
    close (6)
    open (unit=6, status='scratch')
  end subroutine
end program
