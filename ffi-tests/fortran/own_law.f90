! The shims for LS-DYNA with the law of examples/own_law, taken by its name, with the default kinds of the build. A stretch along the
! fibre has closed forms; what is not to be read is NaN.
program own_law_test
  use, intrinsic :: iso_c_binding, only: c_int64_t
  use cases
  implicit none
  external :: umat41, umat41v, utan41, utan41v
  integer, parameter :: nhv = 4, nlq = 5
  real, parameter :: mu = 1000, lambda = 3000, k = 20000
  real, parameter :: one(9) = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
  real, parameter :: turned(9) = [0.5, 0.866, 0.0, -0.866, 0.5, 0.0, 0.0, 0.0, 1.0]
  real :: cm(48), nan(9), tolerance, hsv(nhv + 9), hsvs(nlq, nhv + 9), sig(6), sigs(nlq, 6), es(6, 6), dsave(nlq, 6, 6)
  logical :: failel, failels(nlq)
  integer :: i

  call read_cases
  call put_nan(nan(1))
  nan = nan(1)
  tolerance = 1e4 * epsilon(tolerance)
  close (6)
  open (unit=6, status='scratch')
  cm = nan(1)
  cm(1:7) = [mu, lambda, k, 0.0, 1.0, 0.0, 0.0]
  hsv = 0
  hsvs = 0
  do i = 1, 2
    call put(one)
    hsv(nhv + 1) = 1 + 0.01 * real(i)
    hsvs(:, nhv + 1) = hsv(nhv + 1)
    call evaluate(1.0)
    call compare(hsv(nhv + 1))
  end do
  call check(stops == 0, 'no stop', 0)

  ! At time 0, F is a rotation where the elements have material axes: their first one is the fibre.
  call put(turned)
  call evaluate(0.0)
  call check(stops == 0, 'axes along the fibre', 0)
  cm(5:7) = [0.0, 1.0, 0.0]
  call evaluate(0.0)
  call check(stops == 2, 'other axes', stops)
  call check_written(6, 'of which the fibre is the first: its direction must be 1, 0, 0, and IHYPER -1')
  cm(5:7) = [1.0, 0.0, 0.0]
  cm(1) = -1
  call evaluate(1.0)
  call check(stops == 4, 'a property', stops)
  call check_written(6, 'property 1 (mu, shear modulus of the solid) is -1')
  call finish

contains

  ! The elements at the start of their lives, with this F.
  subroutine put(f)
    real, intent(in) :: f(9)
    hsv(nhv + 1:) = f
    hsvs(:, nhv + 1:) = spread(f, 1, nlq)
  end subroutine

  subroutine evaluate(time)
    real, intent(in) :: time
    integer :: nnpcrv(1)
    logical :: reject
    reject = .false.
    nnpcrv = 0
    failel = .true.
    failels = .true.
    call umat41(cm, nan, sig, nan, hsv, nan, nan, 'solid', time, nan, failel, nan, nnpcrv, nan, nan, nan, 1_c_int64_t, reject)
    call umat41v(cm, nan, nan, nan, nan, nan, nan, sigs(:, 1), sigs(:, 2), sigs(:, 3), sigs(:, 4), sigs(:, 5), sigs(:, 6), nan, &
      hsvs, 2, 4, nan, nan, 'solid', time, nan, failels, nlq, nan, nnpcrv, nan, nan, nan, [1_c_int64_t], reject)
  end subroutine

  ! Stress, state and tangents of a stretch by l.
  subroutine compare(l)
    real, intent(in) :: l
    integer :: nnpcrv(1)
    logical :: unsym
    real :: wanted, modulus
    unsym = .false.
    nnpcrv = 0
    wanted = (mu * (l**2 - 1) + lambda * log(l) + 2 * k * (l**2 - 1) * l**2) / l
    call check(abs(sig(1) - wanted) < tolerance * wanted, 'stress', 0)
    call check(all(abs(sigs(2:4, 1) - wanted) < tolerance * wanted), 'stress of a vector', 0)
    call check(abs(hsv(2) - l) < tolerance .and. all(abs(hsvs(2:4, 2) - l) < tolerance), 'stretch', 0)
    call check(.not. failel .and. all(failels .eqv. [.true., .false., .false., .false., .true.]), 'failed', 0)
    ! The derivative by ln l, minus the stress.
    modulus = (2 * mu * l**2 + lambda + 2 * k * (4 * l**4 - 2 * l**2)) / l - 2 * wanted
    call utan41(cm, nan, nan, nan, hsv, nan, unsym, nan, 'solid', nan, nan, es, nan, nnpcrv, failel, nan, nan)
    call utan41v(cm, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, hsvs, unsym, 2, 4, nan, nan, 'solid', nan, &
      nan, dsave, nlq, nan, nnpcrv, failels, nan, nan)
    call check(abs(es(1, 1) - modulus) < 10 * tolerance * modulus, 'es', 0)
    call check(all(abs(dsave(2:4, 1, 1) - modulus) < 10 * tolerance * modulus), 'dsave', 0)
  end subroutine
end program
