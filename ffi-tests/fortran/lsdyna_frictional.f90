! The shims for LS-DYNA with the law with friction, as material 44, with the default kinds of the build. A section that is pressed in one
! step has closed forms; what is not to be read is NaN.
program lsdyna_frictional
  use, intrinsic :: iso_c_binding, only: c_int64_t
  use cases
  implicit none
  external :: umat44, umat44v, utan44, utan44v
  integer, parameter :: nhv = 15, nlq = 5
  real, parameter :: k_tc = 1055, p = 2.2, k_td = 650, mu = 0.1, c = 0.25, height = 0.8
  real, parameter :: pressed(9) = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, height]
  real, parameter :: turned(9) = [0.5, 0.866, 0.0, -0.866, 0.5, 0.0, 0.0, 0.0, 1.0]
  real :: cm(48), nan(9), tolerance, hsv(nhv + 9), hsvs(nlq, nhv + 9), sig(6), sigs(nlq, 6), es(6, 6), dsave(nlq, 6, 6)
  real :: i_td, pressure, held, lost
  logical :: failel, failels(nlq)

  call read_cases
  call put_nan(nan(1))
  nan = nan(1)
  tolerance = 1e4 * epsilon(tolerance)
  close (6)
  open (unit=6, status='scratch')
  cm = nan(1)
  cm(1:13) = [82341.0, k_tc, p, k_td, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, mu, c]
  i_td = -log(height) / 2
  pressure = p / 2 * k_tc * i_td**(p - 1)
  held = mu * pressure + c
  lost = 2 * held * (i_td - 2 * held / k_td)
  call start(pressed)
  call evaluate(1.0)
  call check(stops == 0, 'no stop', 0)
  call check(2 * held / k_td < i_td, 'the fibres slide', 0)
  call check(abs(sig(2) - (held - pressure) / height) < tolerance * pressure, 'stress 22', 0)
  call check(abs(sig(3) + (held + pressure) / height) < tolerance * pressure, 'stress 33', 0)
  call check(all(abs(sigs(2:4, 3) - sig(3)) < tolerance * pressure), 'stress of a vector', 0)
  call check(abs(hsv(9) - lost) < tolerance * lost .and. all(abs(hsvs(2:4, 9) - lost) < tolerance * lost), 'energy lost', 0)
  call check(abs(hsv(10) - 2 * held / k_td) < tolerance .and. abs(hsv(15) - 1) < tolerance, 'what is held, alive', 0)
  call check(.not. failel .and. all(failels .eqv. [.true., .false., .false., .false., .true.]), 'failed', 0)
  call tangents
  call check(all(abs(dsave(3, :, :) - es) <= tolerance * maxval(abs(es))), 'tangents', 0)
  call check(all(abs(es - transpose(es)) <= tolerance * maxval(abs(es))) .and. es(3, 3) > 0, 'a symmetric tangent', 0)

  ! At time 0, F is a rotation where the elements have material axes: their first one is the fibre.
  call start(turned)
  call evaluate(0.0)
  call check(stops == 0, 'axes along the fibre', 0)
  cm(9:11) = [0.0, 1.0, 0.0]
  call evaluate(0.0)
  call check(stops == 2, 'other axes', stops)
  cm(9:11) = [1.0, 0.0, 0.0]
  cm(12) = 1
  call evaluate(1.0)
  call check(stops == 4, 'a property', stops)
  call check_written(6, 'property 12 (mu, friction of the section')
  call finish

contains

  ! The elements at the start of their lives, with this F.
  subroutine start(f)
    real, intent(in) :: f(9)
    hsv = 0
    hsv(nhv + 1:) = f
    hsvs = spread(hsv, 1, nlq)
  end subroutine

  subroutine evaluate(time)
    real, intent(in) :: time
    integer :: nnpcrv(1)
    logical :: reject
    reject = .false.
    nnpcrv = 0
    failel = .true.
    failels = .true.
    call umat44(cm, nan, sig, nan, hsv, nan, nan, 'solid', time, nan, failel, nan, nnpcrv, nan, nan, nan, 1_c_int64_t, reject)
    call umat44v(cm, nan, nan, nan, nan, nan, nan, sigs(:, 1), sigs(:, 2), sigs(:, 3), sigs(:, 4), sigs(:, 5), sigs(:, 6), nan, &
      hsvs, 2, 4, nan, nan, 'solid', time, nan, failels, nlq, nan, nnpcrv, nan, nan, nan, [1_c_int64_t], reject)
  end subroutine

  subroutine tangents
    integer :: nnpcrv(1)
    logical :: unsym
    unsym = .false.
    nnpcrv = 0
    call utan44(cm, nan, nan, nan, hsv, nan, unsym, nan, 'solid', nan, nan, es, nan, nnpcrv, failel, nan, nan)
    call utan44v(cm, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, hsvs, unsym, 2, 4, nan, nan, 'solid', nan, &
      nan, dsave, nlq, nan, nnpcrv, failels, nan, nan)
  end subroutine
end program
