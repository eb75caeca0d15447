! The truth's cases as `c/tests/c/ffi.rs` writes them, what an answer may be off by, and a count of what is wrong.
module cases
  use, intrinsic :: ieee_exceptions, only: ieee_get_halting_mode, ieee_invalid, ieee_support_halting, ieee_usual
  use, intrinsic :: iso_c_binding, only: c_double, c_float, c_int32_t, c_int64_t
  implicit none

  ! NaN by its bits: arithmetic that makes or compares one would stop a build that traps invalid operations.
  interface put_nan
    module procedure put_nan_64, put_nan_32
  end interface

  ! Stress 11 22 33 12 23 31. A scale is |truth| plus what one rounding of F does.
  type truth
    integer :: id
    real(c_double) :: properties(11), f(9), stress(6), stress_scale
    real(c_double) :: energies(4), energy_scales(4, 2), invariants(4), invariant_scales(4), modes(24)
    integer :: modes_bounded, failed, clear
    ! DDSDDE 11 22 33 12 13 23, and what |error| may be; 1e300 where there is none or the input allows none.
    real(c_double) :: ddsdde(6, 6), ddsdde_allowed
  end type

  integer, parameter :: number_of_cases = 256
  type(truth) :: table(number_of_cases)
  integer :: failures = 0
  ! How often a shim called the solver's own routine for stopping.
  integer :: stops = 0
  ! Which exceptions trap; the intrinsic module has a kind of its own, whatever the build's default.
  integer, parameter :: ieee = kind(ieee_support_halting(ieee_invalid))
  logical(ieee) :: traps(size(ieee_usual))

contains

  subroutine put_nan_64(x)
    real(c_double), intent(out) :: x
    x = transfer(int(z'7FF8000000000000', c_int64_t), x)
  end subroutine

  subroutine put_nan_32(x)
    real(c_float), intent(out) :: x
    x = transfer(int(z'7FC00000', c_int32_t), x)
  end subroutine

  subroutine read_cases
    character(len=1000) :: path
    integer :: i, unit
    call ieee_get_halting_mode(ieee_usual, traps)
    call get_command_argument(1, path)
    open (newunit=unit, file=trim(path), action='read')
    do i = 1, number_of_cases
      read (unit, *) table(i)
    end do
    close (unit)
  end subroutine

  subroutine check(condition, what, id)
    logical, intent(in) :: condition
    character(len=*), intent(in) :: what
    integer, intent(in) :: id
    if (condition) return
    failures = failures + 1
    write (0, '(3a, i0)') 'wrong: ', what, ', case ', id
  end subroutine

  ! An answer against the truth; state as energies, invariants, index, failed, alive.
  subroutine check_answer(t, stress, state, single)
    type(truth), intent(in) :: t
    real(c_double), intent(in) :: stress(6), state(11)
    logical, intent(in) :: single
    real(c_double) :: allowed, difference(6)
    integer :: scales
    allowed = merge(8 * 6e-8_c_double, 5 * 2.0_c_double**(-53), single)
    scales = merge(2, 1, single)
    difference = stress - t%stress
    call check(sqrt(sum(difference(1:3)**2) + 2 * sum(difference(4:6)**2)) <= allowed * t%stress_scale, 'stress', t%id)
    call check(all(abs(state(1:4) - t%energies) <= allowed * t%energy_scales(:, scales)), 'energies', t%id)
    call check(all(abs(state(5:8) - t%invariants) <= allowed * t%invariant_scales), 'invariants', t%id)
    call check(abs(state(10) - t%failed) < 0.5 .or. (single .and. t%clear == 0), 'failed', t%id)
    call check(abs(state(11) - (1 - state(10))) <= 0, 'alive', t%id)
  end subroutine

  ! A tangent 11 22 33 12 13 23, symmetric to the bit, against the truth.
  subroutine check_tangent(t, ddsdde, single)
    type(truth), intent(in) :: t
    real(c_double), intent(in) :: ddsdde(6, 6)
    logical, intent(in) :: single
    real(c_double) :: allowed
    allowed = t%ddsdde_allowed
    ! In single precision the rounding of F decides on which side of a kink a small strain is.
    if (single) allowed = merge(3e-4_c_double * sqrt(sum(t%ddsdde**2)), 1e300_c_double, &
      all(abs(t%invariants(1:2)) > 1e-3) .and. allowed < 1e300_c_double)
    call check(all(abs(ddsdde - transpose(ddsdde)) <= 0), 'symmetric tangent', t%id)
    call check(sqrt(sum((ddsdde - t%ddsdde)**2)) <= allowed, 'tangent', t%id)
  end subroutine

  ! Cases first .. last share their properties: they can go in one block.
  integer function last_of_run(first) result(last)
    integer, intent(in) :: first
    last = first
    do while (last < number_of_cases)
      if (any(table(last + 1)%properties /= table(first)%properties)) exit
      last = last + 1
    end do
  end function

  ! Checks that this text has been written to a unit since it was opened.
  subroutine check_written(unit, text)
    integer, intent(in) :: unit
    character(len=*), intent(in) :: text
    character(len=500) :: line
    logical :: found
    integer :: code
    found = .false.
    rewind (unit)
    do
      read (unit, '(a)', iostat=code) line
      if (code /= 0) exit
      found = found .or. index(line, text) > 0
    end do
    ! Back to where the next line goes.
    backspace (unit)
    call check(found, 'written: ' // text, unit)
  end subroutine

  subroutine finish
    logical(ieee) :: now(size(traps))
    call ieee_get_halting_mode(ieee_usual, now)
    call check(logical(all(now .eqv. traps)), 'the host''s traps are as they were', 0)
    if (failures > 0) error stop 1
  end subroutine
end module

! The solvers' routines for stopping, which here come back.
subroutine xit
  use cases, only: stops
  implicit none
  stops = stops + 1
end subroutine

subroutine xplb_exit
  use cases, only: stops
  implicit none
  stops = stops + 1
end subroutine

subroutine adios(kind)
  use cases, only: check, stops
  implicit none
  integer, intent(in) :: kind
  call check(kind == 2, 'adios', 0)
  stops = stops + 1
end subroutine
