! umat41 of LS-DYNA for the hyperelastic yarn law of libtoron, one
! element at a time.
!
! Solids; NHV = 11, IHYPER = -1 with IORTHO = 1, or IHYPER = 1 with
! IORTHO = 0, IFAIL = 1: see docs. The kinds of REAL, INTEGER and
! LOGICAL are those of the build, so compile this file with the object
! package's own flags.
!
! The argument list is that of R9.3.1 and of R11 to R13. Packages of
! 2014 and 2015 have no NNPCRV and REJECT, and their IDELE is a default
! INTEGER:
!     subroutine umat41(cm, eps, sig, epsp, hsv, dt1, capa, etype, tt,
!    &  temper, failel, crv, cma, qmat, elsiz, idele)
!
! Fixed form: statements in columns 7 to 72, continued in column 6, and
! nothing beyond. Compile it as .f; free form is not supported.
      subroutine umat41(cm, eps, sig, epsp, hsv, dt1, capa, etype, tt,
     &  temper, failel, crv, nnpcrv, cma, qmat, elsiz, idele, reject)
      use, intrinsic :: iso_c_binding, only: c_char, c_double, c_float,
     &  c_int, c_int32_t, c_int64_t, c_null_char, c_size_t
      implicit none
      real :: cm(*), eps(6), sig(6), epsp, hsv(*), dt1, capa, tt, temper
      real :: crv(*), cma(*), qmat(3, 3), elsiz
      character(len=5) :: etype
      logical :: failel, reject
      integer :: nnpcrv(*)
      integer(c_int64_t) :: idele
!     What the library needs, not what the card says: LS-DYNA hands NHV
!     to no routine. With another one F is not where it is read.
      integer(c_int32_t), parameter :: nhv = 11
      integer(c_int32_t) :: status
      integer(c_int) :: failed
!     Room for any message of the library.
      integer(c_size_t), parameter :: capacity = 512
      character(kind=c_char) :: message(capacity)

!     The default kind of REAL picks the precision.
      interface toron_umat
        function toron_lsdyna_umat_f64(cm, sig, hsv, nhv, failel,
     &    message, capacity) bind(c) result(status)
          import :: c_char, c_double, c_int, c_int32_t, c_size_t
          real(c_double), intent(in) :: cm(*)
          real(c_double), intent(inout) :: sig(*), hsv(*)
          integer(c_int32_t), value :: nhv
          integer(c_int), intent(inout) :: failel
          character(kind=c_char), intent(inout) :: message(*)
          integer(c_size_t), value :: capacity
          integer(c_int32_t) :: status
        end function
        function toron_lsdyna_umat_f32(cm, sig, hsv, nhv, failel,
     &    message, capacity) bind(c) result(status)
          import :: c_char, c_float, c_int, c_int32_t, c_size_t
          real(c_float), intent(in) :: cm(*)
          real(c_float), intent(inout) :: sig(*), hsv(*)
          integer(c_int32_t), value :: nhv
          integer(c_int), intent(inout) :: failel
          character(kind=c_char), intent(inout) :: message(*)
          integer(c_size_t), value :: capacity
          integer(c_int32_t) :: status
        end function
      end interface

      failed = 0
      status = toron_umat(cm, sig, hsv, nhv, failed, message,
     &  capacity)
!     Below -300 the element is at fault, and fails; above, the deck is.
      if (status < 0 .and. status > -300) then
        call refuse
      else
        failel = failed /= 0
      end if

      contains

      subroutine refuse
      integer :: length
      length = 0
      do while (message(length + 1) /= c_null_char)
        length = length + 1
      end do
      write (*, '(1x, *(a))') 'toron: ', message(1:length)
      call adios(2)
      end subroutine
      end subroutine
