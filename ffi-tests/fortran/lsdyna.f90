! The shims lsdyna_umat.F, lsdyna_umatv.F, lsdyna_utan.F and lsdyna_utanv.F, called as LS-DYNA does, with the
! default kinds of the build.
program lsdyna_test
  use, intrinsic :: iso_c_binding, only: c_double, c_float, c_int64_t
  use cases
  implicit none
  external :: umat41, umat41v, utan41, utan41v

  real, parameter :: mark = -7.25
  logical, parameter :: single = kind(mark) == c_float
  integer, parameter :: nhv = 11, history = nhv + 9, before = 4, behind = 2
  ! All state variables 0, F = 1.
  real, parameter :: rest(history) = [spread(0.0, 1, nhv), 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
  real, allocatable :: sig(:, :), hsvs(:, :)
  logical, allocatable :: failels(:)
  real :: cm(48)
  integer :: first, last, i

  call read_cases
  close (6)
  open (unit=6, status='scratch')
  do i = 1, number_of_cases
    call scalar(table(i))
  end do
  first = 1
  do while (first <= number_of_cases)
    last = last_of_run(first)
    call compare
    first = last + 1
  end do
  call bad_element
  call check(stops == 0, 'no stop', 0)

  cm(1:11) = real(table(1)%properties)
  cm(3) = 0.5
  call refused('property 3 (p, transverse compaction exponent) is 0.5; allowed: a number > 1, at most 40', rest)
  cm(3) = 2
  cm(9:11) = 0
  call refused('properties 9 to 11 (fibre direction) are 0.0, 0.0, 0.0; allowed: any vector but zero', rest)
  ! With IHYPER = 0 nobody writes F: all of the history is as at the start.
  cm(1:11) = real(table(1)%properties)
  call refused('IHYPER', 0 * rest)
  call another_nhv
  call finish

contains

  ! One element between marks.
  subroutine scalar(t)
    type(truth), intent(in) :: t
    real :: stress(1 - before:6 + behind), hsv(1 - before:history + behind)
    logical :: failel(3)
    cm = mark
    cm(1:11) = real(t%properties)
    stress = mark
    hsv = mark
    hsv(1:nhv) = 0
    hsv(nhv + 1:history) = real(t%f)
    failel = [.true., .true., .false.]
    call call_scalar(stress(1), hsv(1), failel(2))
    call check_answer(t, real(stress(1:6), c_double), real(hsv(1:nhv), c_double), single)
    call check(failel(2) .eqv. hsv(10) > 0.5, 'failel', t%id)
    call check(all(hsv(nhv + 1:history) == real(t%f)), 'F is read only', t%id)
    call check(all(stress(:0) == mark) .and. all(stress(7:) == mark), 'around sig', t%id)
    call check(all(hsv(:0) == mark) .and. all(hsv(history + 1:) == mark), 'around hsv', t%id)
    call check(failel(1) .and. .not. failel(3), 'around failel', t%id)
    call tangent(t, real(stress(1:6), c_double), hsv(1))
  end subroutine

  ! The tangent of an element that has not failed before.
  subroutine tangent(t, stress, hsv)
    type(truth), intent(in) :: t
    real(c_double), intent(in) :: stress(6)
    real, intent(inout) :: hsv(*)
    real :: es(1 - before:36 + behind)
    es = mark
    hsv(10:11) = [0.0, 1.0]
    call call_scalar_tangent(hsv, es(1))
    call check_tangent(t, jaumann(real(es(1:36), c_double), stress), single)
    call check(all(es(:0) == mark) .and. all(es(37:) == mark), 'around es', t%id)
    hsv(10:11) = [1.0, 0.0]
    call call_scalar_tangent(hsv, es(1))
    call check(all(es(1:36) == 0), 'a failed element has no stiffness', t%id)
  end subroutine

  ! DDSDDE of a Truesdell modulus: c_ijkl + (d_ik s_jl + d_jl s_ik + d_il s_jk + d_jk s_il)/2, with 13 and 23 in its order.
  function jaumann(es, stress) result(ddsdde)
    real(c_double), intent(in) :: es(36), stress(6)
    real(c_double) :: ddsdde(6, 6), c(6, 6), s(3, 3)
    integer, parameter :: order(6) = [1, 2, 3, 4, 6, 5], one(6) = [1, 2, 3, 1, 1, 2], two(6) = [1, 2, 3, 2, 3, 3]
    integer :: p, q
    s = reshape(stress([1, 4, 6, 4, 2, 5, 6, 5, 3]), [3, 3])
    c = reshape(es, [6, 6])
    c = c(order, order)
    do q = 1, 6
      do p = 1, 6
        ddsdde(p, q) = c(p, q) + 0.5_c_double * (part(one(p), one(q), s(two(p), two(q))) + part(two(p), two(q), &
          s(one(p), one(q))) + part(one(p), two(q), s(two(p), one(q))) + part(two(p), one(q), s(one(p), two(q))))
      end do
    end do
  end function

  real(c_double) function part(i, k, s)
    integer, intent(in) :: i, k
    real(c_double), intent(in) :: s
    part = merge(s, 0.0_c_double, i == k)
  end function

  subroutine call_scalar(stress, hsv, failel)
    real, intent(inout) :: stress(*), hsv(*)
    logical, intent(inout) :: failel
    real :: zero(9)
    integer :: nnpcrv(1)
    logical :: reject
    zero = 0
    nnpcrv = 0
    reject = .false.
    call umat41(cm, zero, stress, zero, hsv, zero, zero, 'solid', 1.0, zero, failel, zero, nnpcrv, zero, zero, zero, &
      1_c_int64_t, reject)
    call check(.not. reject, 'reject', 0)
  end subroutine

  subroutine call_scalar_tangent(hsv, es)
    real, intent(inout) :: hsv(*), es(*)
    real :: zero(9)
    logical :: unsym, failel
    integer :: nnpcrv(1)
    zero = 0
    nnpcrv = 0
    unsym = .false.
    failel = .false.
    call utan41(cm, zero, zero, zero, hsv, zero, unsym, zero, 'solid', 1.0, zero, es, zero, nnpcrv, failel, zero, zero)
    call check(.not. unsym .and. .not. failel, 'unsym, failel', 0)
  end subroutine

  ! Elements before + 1 .. before + n of arrays that have more.
  subroutine prepare(n)
    integer, intent(in) :: n
    integer :: k
    if (allocated(sig)) deallocate (sig, hsvs, failels)
    allocate (sig(before + n + behind, 6), hsvs(before + n + behind, history), source=mark)
    allocate (failels(before + n + behind), source=.true.)
    cm(1:11) = real(table(first)%properties)
    do k = 1, n
      hsvs(before + k, :nhv) = 0
      hsvs(before + k, nhv + 1:) = real(table(first + k - 1)%f)
    end do
  end subroutine

  subroutine call_vector(n)
    integer, intent(in) :: n
    real, allocatable :: zero(:)
    integer(c_int64_t), allocatable :: idelev(:)
    integer :: nnpcrv(1), nlq
    logical :: reject
    nlq = size(failels)
    allocate (zero(9 * nlq), source=0.0)
    allocate (idelev(nlq), source=1_c_int64_t)
    nnpcrv = 0
    reject = .false.
    call umat41v(cm, zero, zero, zero, zero, zero, zero, sig(:, 1), sig(:, 2), sig(:, 3), sig(:, 4), sig(:, 5), &
      sig(:, 6), zero, hsvs, before + 1, before + n, zero, zero, 'solid', 1.0, zero, failels, nlq, zero, nnpcrv, zero, &
      zero, zero, idelev, reject)
    call check(all(sig(:before, :) == mark) .and. all(sig(before + n + 1:, :) == mark), 'sig outside', first)
    call check(all(hsvs(:before, :) == mark) .and. all(hsvs(before + n + 1:, :) == mark), 'hsvs outside', first)
    call check(all(failels(:before)) .and. all(failels(before + n + 1:)), 'failels outside', first)
    call check(.not. reject, 'reject', 0)
  end subroutine

  subroutine compare
    integer :: n, k, element
    n = last - first + 1
    call prepare(n)
    call call_vector(n)
    do k = 1, n
      element = before + k
      call check_answer(table(first + k - 1), real(sig(element, :), c_double), real(hsvs(element, :nhv), c_double), single)
      call check(failels(element) .eqv. hsvs(element, 10) > 0.5, 'failels', table(first + k - 1)%id)
    end do
    call tangents(n)
  end subroutine

  subroutine tangents(n)
    integer, intent(in) :: n
    real, allocatable :: dsave(:, :)
    integer :: k
    hsvs(before + 1:before + n, 10) = 0
    hsvs(before + 1:before + n, 11) = 1
    call call_vector_tangent(n, dsave)
    do k = 1, n
      call check_tangent(table(first + k - 1), jaumann(real(dsave(before + k, :), c_double), &
        real(sig(before + k, :), c_double)), single)
    end do
    call check(all(dsave(:before, :) == mark) .and. all(dsave(before + n + 1:, :) == mark), 'dsave outside', first)
  end subroutine

  subroutine call_vector_tangent(n, dsave)
    integer, intent(in) :: n
    real, allocatable, intent(out) :: dsave(:, :)
    real, allocatable :: zero(:)
    logical :: unsym
    integer :: nnpcrv(1), nlq
    nlq = size(failels)
    allocate (dsave(nlq, 36), source=mark)
    allocate (zero(9 * nlq), source=0.0)
    nnpcrv = 0
    unsym = .false.
    call utan41v(cm, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, hsvs, unsym, &
      before + 1, before + n, zero, zero, 'solid', 1.0, zero, dsave, nlq, zero, nnpcrv, failels, zero, zero)
    call check(.not. unsym, 'unsym', first)
  end subroutine

  ! An element that is inverted, not a number or too large fails; its neighbours do not notice, and the job goes on.
  subroutine bad_element
    real :: stress(3, 6)
    real, allocatable :: dsave(:, :)
    integer :: way
    first = 1
    call prepare(3)
    call call_vector(3)
    stress = sig(before + 1:before + 3, :)
    do way = 1, 3
      call prepare(3)
      if (way == 1) hsvs(before + 2, nhv + 1:nhv + 3) = -hsvs(before + 2, nhv + 1:nhv + 3)
      if (way == 2) call put_nan(hsvs(before + 2, nhv + 5))
      if (way == 3) hsvs(before + 2, nhv + 1:) = sqrt(huge(mark)) * hsvs(before + 2, nhv + 1:)
      call call_vector(3)
      call check(all(failels(before + 1:before + 3) .eqv. [.false., .true., .false.]), 'it fails', way)
      call check(all(sig(before + 2, :) == 0), 'it has no stress', way)
      call check(all(sig([before + 1, before + 3], :) == stress([1, 3], :)), 'its neighbours', way)
      call call_vector_tangent(3, dsave)
      call check(all(dsave(before + 2, :) == 0), 'it has no stiffness', way)
    end do
  end subroutine

  ! A wrong deck stops the job with this message in all four, and nothing is written; `start` is an element's history.
  subroutine refused(message, start)
    character(len=*), intent(in) :: message
    real, intent(in) :: start(history)
    real :: kept(11), stress(6), hsv(history), es(36)
    real, allocatable :: dsave(:, :)
    logical :: failel
    integer :: k
    stress = mark
    hsv = start
    es = mark
    failel = .false.
    stops = 0
    call call_scalar(stress, hsv, failel)
    call check_stop('umat41: ', message)
    call check(all(stress == mark) .and. all(hsv == start) .and. .not. failel, 'nothing is written: ' // message, 1)
    call call_scalar_tangent(hsv, es)
    call check_stop('utan41: ', message)
    call check(all(es == mark) .and. all(hsv == start), 'nothing is written: ' // message, 2)
    kept = cm(1:11)
    first = 1
    call prepare(3)
    cm(1:11) = kept
    hsvs(before + 1:before + 3, :) = spread(start, 1, 3)
    call call_vector(3)
    call check_stop('umat41v: ', message)
    call check(all(sig == mark) .and. all(failels), 'nothing is written: ' // message, 3)
    do k = 1, 3
      call check(all(hsvs(before + k, :) == start), 'nothing is written: ' // message, 3)
    end do
    call call_vector_tangent(3, dsave)
    call check_stop('utan41v: ', message)
    call check(all(dsave == mark), 'nothing is written: ' // message, 4)
  end subroutine

  ! What an element's history is before the first call if the card's NHV is not 11: F stands elsewhere. At rest F is 1, or the
  ! rotation into the material axes where IHYPER is -1, and LS-DYNA has updated it once already: nothing, or a little.
  subroutine another_nhv
    real, parameter :: step(2) = [0.0, 0.01], c = 0.6, s = 0.8
    real :: f(3, 3), start(60), turn(3, 3, 4), d(3, 3)
    integer :: card, k, j
    turn(:, :, 1) = reshape([1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0], [3, 3])
    turn(:, :, 2) = reshape([c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0], [3, 3])
    turn(:, :, 3) = reshape([0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0], [3, 3])
    turn(:, :, 4) = matmul(turn(:, :, 2), matmul(turn(:, :, 3), turn(:, :, 2)))
    d = reshape([0.3, -0.7, 0.2, 0.9, -0.4, 0.5, -0.1, 0.6, 0.8], [3, 3])
    do card = 0, 40
      if (card == nhv .or. (card >= 14 .and. card <= 19)) cycle ! those cannot be told from a flat element
      do k = 1, size(turn, 3)
        do j = 1, size(step)
          ! Shifted by one a turn of zeros and ones is another one.
          if (card == 10 .and. k == 3 .and. step(j) == 0) cycle
          f = matmul(turn(:, :, 1) + step(j) * d, turn(:, :, k))
          start = 0
          start(card + 1:card + 9) = reshape(f, [9])
          call refused('NHV', start(:history))
        end do
      end do
    end do
  end subroutine

  ! One stop since the last look, with this message.
  subroutine check_stop(routine, message)
    character(len=*), intent(in) :: routine, message
    call check(stops == 1, routine // message, stops)
    call check_written(6, message)
    stops = 0
    close (6)
    open (unit=6, status='scratch')
  end subroutine
end program
