! Both laws of the shims for LS-DYNA in one program, the hyperelastic one as umat41 and utan41, the linear elastic one under the number
! OTHER, with the arguments of R7 to R9 if TORON_SHORT_LIST is defined; what is not to be read is NaN. A stretch along the fibre has closed forms.
program lsdyna_variants_test
  use, intrinsic :: iso_c_binding, only: c_double, c_int64_t
  use cases
  implicit none
  external :: umat41, umat41v, utan41, utan41v
  external :: UMAT_OTHER, UMATV_OTHER, UTAN_OTHER, UTANV_OTHER
  real, parameter :: yarn(11) = [82341.0, 1055.0, 2.2, 649.74, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0]
  real, parameter :: elastic(10) = [79414.0, 794.0, 126.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0]
  real, parameter :: one(9) = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
  real :: cm(48), nan(9), tolerance, time
  integer :: step

  call read_cases
  call put_nan(nan(1))
  nan = nan(1)
  tolerance = 1e4 * epsilon(tolerance)
  close (6)
  open (unit=6, status='scratch')
  time = 1
  do step = 1, 2
    call stretched(umat41, umat41v, utan41, utan41v, yarn, 11, step)
    call stretched(UMAT_OTHER, UMATV_OTHER, UTAN_OTHER, UTANV_OTHER, elastic, 19, step)
  end do
  call check(stops == 0, 'no stop', 0)
  call no_solid(umat41, yarn, 11)
  call no_solid(UMAT_OTHER, elastic, 19)
  time = 0
  call axes(umat41, umat41v, yarn, 11, 9)
  call axes(UMAT_OTHER, UMATV_OTHER, elastic, 19, 5)
  call finish

contains

  ! Two increments of a stretch along the fibre, in the scalar and the vectorised routine, and the tangents behind them.
  subroutine stretched(umat, umatv, utan, utanv, properties, nhv, increments)
    external :: umat, umatv, utan, utanv
    integer, intent(in) :: nhv, increments
    real, intent(in) :: properties(:)
    integer, parameter :: nlq = 5
    real :: hsv(nhv + 9), hsvs(nlq, nhv + 9), sig(6), sigs(nlq, 6), es(6, 6), dsave(nlq, 6, 6), wanted, modulus
    logical :: failel, failels(nlq)
    integer :: i
    cm = nan(1)
    cm(:size(properties)) = properties
    hsv = 0
    hsvs = 0
    do i = 1, increments
      hsv(nhv + 1:) = one
      hsv(nhv + 1) = 1 + 0.01 * real(i)
      hsvs(2:4, nhv + 1:) = spread(hsv(nhv + 1:), 1, 3)
      failel = .true.
      failels = .true.
      call scalar(umat, sig, hsv, failel, 'solid')
      call vector(umatv, sigs, hsvs, failels, nlq)
      wanted = properties(1) * log(1 + 0.01 * real(i))
      ! The hyperelastic stress is per current area.
      modulus = properties(1) + wanted
      if (nhv == 11) modulus = (properties(1) - 2 * wanted) / (1 + 0.01 * real(i))
      if (nhv == 11) wanted = wanted / (1 + 0.01 * real(i))
      call check(abs(sig(1) - wanted) < tolerance * wanted, 'stress', nhv)
      call check(all(abs(sig(2:)) < tolerance * wanted), 'other stress', nhv)
      call check(all(abs(sigs(2:4, :) - spread(sig, 1, 3)) < tolerance * wanted), 'stress of a vector', nhv)
      call check(.not. failel .and. all(failels .eqv. [.true., .false., .false., .false., .true.]), 'failed', nhv)
      call scalar_tangent(utan, hsv, es)
      call vector_tangent(utanv, hsvs, dsave, nlq)
      if (nhv == 19) modulus = modulus - 2 * wanted
      call check(abs(es(1, 1) - modulus) < 10 * tolerance * properties(1), 'es', nhv)
      call check(all(abs(dsave(2:4, 1, 1) - modulus) < 10 * tolerance * properties(1)), 'dsave', nhv)
    end do
  end subroutine

  ! Shells hand over another F.
  subroutine no_solid(umat, properties, nhv)
    external :: umat
    real, intent(in) :: properties(:)
    integer, intent(in) :: nhv
    real :: hsv(nhv + 9), sig(6)
    logical :: failel
    cm(:size(properties)) = properties
    hsv = 0
    hsv(nhv + 1:) = one
    stops = 0
    call scalar(umat, sig, hsv, failel, 'shell')
    call check(stops == 1, 'a shell stops the job', nhv)
    call check_written(6, 'solid elements are needed; these are of type shell')
  end subroutine

  ! At time 0, F is a rotation where the elements have material axes: their first one is the fibre.
  subroutine axes(umat, umatv, properties, nhv, fibre)
    external :: umat, umatv
    real, intent(in) :: properties(:)
    integer, intent(in) :: nhv, fibre
    integer, parameter :: nlq = 5
    ! A turn by 60 degrees, nearly, and one by 10.
    real, parameter :: turned(9) = [0.5, 0.866, 0.0, -0.866, 0.5, 0.0, 0.0, 0.0, 1.0]
    real, parameter :: a_little(9) = [0.9848, 0.1736, 0.0, -0.1736, 0.9848, 0.0, 0.0, 0.0, 1.0]
    real :: hsv(nhv + 9), hsvs(nlq, nhv + 9), sig(6), sigs(nlq, 6)
    logical :: failel, failels(nlq)
    integer :: refused
    do refused = 0, 7
      stops = 0
      cm(:size(properties)) = properties
      ! Along the axes; no axes; F missing, which the library reports; another direction, twice; an element that is inverted, much too
      ! large or not a number, which fails.
      if (refused > 0) cm(fibre:fibre + 2) = [0.0, 1.0, 0.0]
      hsv = 0
      hsv(nhv + 1:) = turned
      if (refused == 1) hsv(nhv + 1:) = one
      if (refused == 2) hsv(nhv + 1:) = 0
      if (refused == 4) hsv(nhv + 1:) = a_little
      if (refused > 4) hsv(nhv + 1:) = one
      if (refused == 5) hsv(nhv + 1) = -1
      if (refused == 6) hsv(nhv + 1) = 0.9 * huge(hsv(1))
      if (refused == 7) call put_nan(hsv(nhv + 5))
      hsvs = 0
      hsvs(2:4, :) = spread(hsv, 1, 3)
      call scalar(umat, sig, hsv, failel, 'solid')
      call check(stops == merge(1, 0, refused > 1 .and. refused < 5), 'axes', refused)
      call check(failel .or. refused < 5, 'it fails', refused)
      call vector(umatv, sigs, hsvs, failels, nlq)
      call check(stops == merge(2, 0, refused > 1 .and. refused < 5), 'axes of a vector', refused)
      if (refused == 2) call check_written(6, 'there is no deformation gradient')
      if (refused == 3 .or. refused == 4) call check_written(6, 'm_1, m_2, m_3 must be 1, 0, 0')
    end do
  end subroutine

  subroutine scalar(umat, sig, hsv, failel, etype)
    external :: umat
    real, intent(inout) :: sig(6), hsv(*)
    logical, intent(inout) :: failel
    character(len=5), intent(in) :: etype
    logical :: reject
    integer :: nnpcrv(1)
    reject = .false.
    nnpcrv = 0
#ifdef TORON_SHORT_LIST
    call umat(cm, nan, sig, nan, hsv, nan, nan, etype, time, nan, failel, nan, nan, nan, nan, 1)
#else
    call umat(cm, nan, sig, nan, hsv, nan, nan, etype, time, nan, failel, nan, nnpcrv, nan, nan, nan, 1_c_int64_t, reject)
#endif
  end subroutine

  subroutine vector(umatv, sigs, hsvs, failels, nlq)
    external :: umatv
    integer, intent(in) :: nlq
    real, intent(inout) :: sigs(nlq, 6), hsvs(nlq, *)
    logical, intent(inout) :: failels(nlq)
    logical :: reject
    integer :: nnpcrv(1)
    reject = .false.
    nnpcrv = 0
#ifdef TORON_SHORT_LIST
    call umatv(cm, nan, nan, nan, nan, nan, nan, sigs(1, 1), sigs(1, 2), sigs(1, 3), sigs(1, 4), sigs(1, 5), sigs(1, 6), nan, &
      hsvs, 2, 4, nan, nan, 'solid', time, nan, failels, nlq, nan, nan, nan, nan, [1, 1])
#else
    call umatv(cm, nan, nan, nan, nan, nan, nan, sigs(1, 1), sigs(1, 2), sigs(1, 3), sigs(1, 4), sigs(1, 5), sigs(1, 6), nan, &
      hsvs, 2, 4, nan, nan, 'solid', time, nan, failels, nlq, nan, nnpcrv, nan, nan, nan, [1_c_int64_t], reject)
#endif
  end subroutine

  subroutine scalar_tangent(utan, hsv, es)
    external :: utan
    real, intent(inout) :: hsv(*), es(6, 6)
    logical :: unsym, failel
    integer :: nnpcrv(1)
    unsym = .false.
    failel = .false.
    nnpcrv = 0
#ifdef TORON_SHORT_LIST
    call utan(cm, nan, nan, nan, hsv, nan, nan, 'solid', nan, nan, es, nan, failel, nan, nan)
#else
    call utan(cm, nan, nan, nan, hsv, nan, unsym, nan, 'solid', nan, nan, es, nan, nnpcrv, failel, nan, nan)
#endif
  end subroutine

  subroutine vector_tangent(utanv, hsvs, dsave, nlq)
    external :: utanv
    integer, intent(in) :: nlq
    real, intent(inout) :: hsvs(nlq, *), dsave(nlq, 6, 6)
    logical :: unsym, failels(nlq)
    integer :: nnpcrv(1)
    unsym = .false.
    failels = .false.
    nnpcrv = 0
#ifdef TORON_SHORT_LIST
    call utanv(cm, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, hsvs, 2, 4, nan, nan, 'solid', nan, nan, &
      dsave, nlq, nan, failels, nan, nan)
#else
    call utanv(cm, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, hsvs, unsym, 2, 4, nan, nan, 'solid', nan, &
      nan, dsave, nlq, nan, nnpcrv, failels, nan, nan)
#endif
  end subroutine
end program
